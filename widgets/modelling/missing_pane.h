// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "modelling/residual_figure.h"
#include "selection/proposals.h"

class QLabel;
class QPushButton;
class QSplitter;
class QTabWidget;
class QTextBrowser;
class QTreeWidget;
class QTreeWidgetItem;
class QUrl;

namespace lvcalib::widgets {

class ResidualPlot;

/// What is missing in the model: effects by rank with verdict and predicted fall of the error, the
/// chosen one in a sentence with its pattern seen and predicted; and what the scenes cannot show.
class MissingPane : public QWidget {
  Q_OBJECT

 public:
  explicit MissingPane(QWidget* parent = nullptr);
  ~MissingPane() override;
  /// `ranking` null: nobody has looked yet (or is looking: `busy`).
  void setRanking(std::shared_ptr<const ModelRanking> ranking, bool has_model, bool busy);
  /// Whether there is a calibration that a model can be fitted to.
  void setCalibrated(bool calibrated);
  /// Why there is no model to look at; empty: there is no calibration yet.
  void setReason(const QString& reason);
  /// What else speaks against the result: nothing is said to be missing beside it without that.
  void setDoubt(const Message& doubt);
  /// The chosen effect's pattern; null: it leaves none.
  void setPattern(const std::shared_ptr<const ResidualFigure>& figure);
  /// The chosen proposal; null if none.
  [[nodiscard]] const EffectProposal* current() const;

 Q_SIGNALS:
  void addWanted(const QString& spec);
  void findAllWanted();
  void lookWanted();
  void cancelWanted();
  /// Another proposal was chosen: by the user, or as the first of a list that is new.
  void chosen(bool by_user);
  /// Structure that no effect explains was chosen.
  void structureChosen(lvcalib::Channel channel, const QString& covariate);
  void curveWanted(lvcalib::Channel channel, const QString& covariate, const QString& second);

 protected:
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void retranslate();
  void fill();
  void fitRows();
  void fillBudget();
  void fillAdvice();
  void addFrom(const QUrl& spec);
  void addProposal(const EffectProposal& proposal, int index);
  void addUnknown(int index);
  void describe(bool by_user = false);
  void updateVerdict();
  void describeStructure(const StructureScore& structure);
  void shareHeight();
  void add();

  std::shared_ptr<const ModelRanking> ranking_;
  QString reason_;
  Message doubt_;
  bool calibrated_ = false;
  bool has_model_ = false;
  bool busy_ = false;
  const void* described_ = nullptr;  // The proposal or structure whose text is shown.
  QLabel* verdict_;
  QSplitter* parts_;          // List, text and pattern, above each other.
  bool parts_moved_ = false;  // By the user: nobody else moves them from then on.
  int longest_text_ = 0;      // Height that the longest text so far takes.
  QTabWidget* tabs_;
  QTreeWidget* list_;
  QTreeWidget* budget_;
  QTextBrowser* advice_;
  QTextBrowser* text_;
  ResidualPlot* pattern_;
  QPushButton* add_;
  QPushButton* all_;
  QPushButton* look_;
};

}  // namespace lvcalib::widgets
