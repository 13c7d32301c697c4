// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>

#include "modelling/residual_figure.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QTabWidget;
class QTextBrowser;

namespace lvcalib::widgets {

class FigureSource;
class ResidualPlot;

/// Chooses what to add to the model: an effect of the catalogue (searched by any of its words, with
/// its physics, formula and the picture of its pattern on these measurements), a formula of the
/// covariates, or a smooth curve of one or two of them.
class AddEffectDialog : public QDialog {
  Q_OBJECT

 public:
  AddEffectDialog(const ModelStepPtr& step, QWidget* parent = nullptr);
  ~AddEffectDialog() override;
  /// Opens on the curve of a covariate.
  void suggestCurve(Channel channel, const QString& covariate, const QString& second = {});

 Q_SIGNALS:
  void addWanted(const QString& spec);

 private:
  enum Tab { kCatalogue, kFormula, kCurve };
  QWidget* createCatalogue();
  QWidget* createFormula();
  QWidget* createCurve();
  void retranslate();
  void filter(const QString& words);
  void describe();
  void fillCovariates();
  void check();
  [[nodiscard]] QString spec() const;

  ModelStepPtr step_;
  std::unique_ptr<FigureSource> source_;
  QTabWidget* tabs_;
  QLineEdit* search_ = nullptr;
  QListWidget* list_ = nullptr;
  QTextBrowser* text_ = nullptr;
  ResidualPlot* pattern_ = nullptr;
  QComboBox* formula_channel_ = nullptr;
  QLineEdit* formula_ = nullptr;
  QLabel* formula_words_ = nullptr;
  QLabel* formula_help_ = nullptr;
  QComboBox* curve_channel_ = nullptr;
  QComboBox* curve_first_ = nullptr;
  QComboBox* curve_second_ = nullptr;
  QLabel* curve_help_ = nullptr;
  QLabel* problem_;
  QPushButton* add_;
};

}  // namespace lvcalib::widgets
