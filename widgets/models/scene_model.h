// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractTableModel>
#include <QHash>
#include <QPixmap>
#include <QStringList>
#include <optional>
#include <vector>

#include "pipeline/session.h"
#include "style/marks.h"

namespace lvcalib::widgets {

/// The scenes of a dataset as a table: what was found in each and how it fits. Its check boxes ask
/// for a decision (use_wanted) and do not change anything by themselves.
class SceneModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { kName, kTags, kPoints, kPixels, kMillimetres, kInfluence, kState, kColumns };
  /// Sorting by number, not by text.
  static constexpr int kSortRole = Qt::UserRole;

  explicit SceneModel(QObject* parent = nullptr);

  /// Other scenes; thumbnails of scenes with the same name stay.
  void set_scenes(const Dataset& dataset, const QStringList& missing);
  void set_decisions(const Decisions& decisions);
  /// Null: nothing has run yet.
  void set_result(const std::shared_ptr<const CalibrationResult>& result);
  /// Tells views that titles and words are in another language.
  void retranslate();
  void set_thumbnail(const QString& scene, const QImage& image);

  /// Row 0…; −1 if there is no such scene.
  [[nodiscard]] int row_of(const QString& scene) const;
  [[nodiscard]] QString scene_at(int row) const;
  [[nodiscard]] bool is_missing(int row) const;

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                    int role) const override;
  [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 Q_SIGNALS:
  void use_wanted(const QString& scene, bool use);

 private:
  struct Row {
    QString name;
    bool missing = false;
    bool use = true;
    bool cropped = false;
    // From the result; empty until there is one.
    std::optional<int> tags;
    std::optional<int> points;
    std::optional<double> rms_px;
    std::optional<double> rms_mm;
    std::optional<double> influence_mm;
    std::optional<double> influence_mrad;
    bool ran = false;
    bool used = false;
    QString reason;
  };
  void fill_result(Row& row, const CalibrationResult& result) const;
  void refill();
  [[nodiscard]] QVariant text(const Row& row, int column) const;
  [[nodiscard]] QVariant number(const Row& row, int column) const;
  [[nodiscard]] QString tool_tip(const Row& row, int column) const;
  [[nodiscard]] QString state_words(const Row& row) const;
  [[nodiscard]] static Mark mark_of(const Row& row);

  std::vector<Row> rows_;
  Decisions decisions_;
  std::shared_ptr<const CalibrationResult> result_;
  QHash<QString, QPixmap> thumbnails_;
};

}  // namespace lvcalib::widgets
