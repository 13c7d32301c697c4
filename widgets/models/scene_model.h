// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractTableModel>
#include <QFontMetrics>
#include <QHash>
#include <QPixmap>
#include <QStringList>
#include <filesystem>
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
  enum Column { kName, kTags, kPoints, kPixels, kMillimetres, kInfluence, kState, kNote, kColumns };
  /// Sorting by number, not by text.
  static constexpr int kSortRole = Qt::UserRole;

  explicit SceneModel(QObject* parent = nullptr);

  /// Other scenes; thumbnails stay while the dataset is the same.
  void set_scenes(const Dataset& dataset, const QStringList& missing);
  void set_decisions(const Decisions& decisions);
  /// Null: nothing has run yet.
  void set_result(const std::shared_ptr<const CalibrationResult>& result);
  /// Whether there are tags on the board.
  [[nodiscard]] bool has_tags() const { return has_tags_; }
  /// True if some scene has a note.
  [[nodiscard]] bool has_notes() const;
  /// Tells views that titles and words are in another language.
  void retranslate();
  void set_thumbnail(const QString& scene, const QImage& image);
  /// Some scene has a picture.
  [[nodiscard]] bool has_thumbnails() const { return !thumbnails_.isEmpty(); }
  /// Pictures are shown this wide, or smaller; 0: none.
  void set_thumbnail_width(int width_px);
  [[nodiscard]] int thumbnail_width() const { return thumbnail_width_; }
  /// The state is said beside its sign as far as it fits into this width: in full, by a word, or
  /// not at all. Its tool tip has it in full always.
  void set_state_room(const QFontMetrics& metrics, int width_px);
  /// The states of all scenes, each by a word.
  [[nodiscard]] QStringList state_names() const;
  /// A file of the scene is missing or cannot be read, in words; empty: no longer.
  void set_problem(const QString& scene, const Message& problem);

  /// Row 0…; −1 if there is no such scene.
  [[nodiscard]] int row_of(const QString& scene) const;
  [[nodiscard]] QString scene_at(int row) const;
  [[nodiscard]] bool is_missing(int row) const;
  /// The program refused the scene, and it has what it takes to be used all the same.
  [[nodiscard]] bool can_be_insisted_on(int row) const;
  /// The user wants it used all the same.
  [[nodiscard]] bool is_insisted_on(int row) const;
  /// True if a file of some scene could not be read.
  [[nodiscard]] bool has_problems() const { return !problems_.isEmpty(); }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation,
                                    int role) const override;
  [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  [[nodiscard]] Qt::DropActions supportedDropActions() const override { return Qt::MoveAction; }
  [[nodiscard]] QStringList mimeTypes() const override;
  [[nodiscard]] QMimeData* mimeData(const QModelIndexList& indexes) const override;
  bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                    const QModelIndex& parent) override;
  /// All scenes with these moved before row `row`.
  [[nodiscard]] QStringList moved(const QStringList& scenes, int row) const;

 Q_SIGNALS:
  void use_wanted(const QString& scene, bool use);
  void note_wanted(const QString& scene, const QString& note);
  /// Scenes were dragged: all of them in their new order.
  void order_wanted(const QStringList& scenes);

 private:
  struct Row {
    QString name;
    bool missing = false;
    bool use = true;
    QString note;
    bool cropped = false;
    // From the result; empty until there is one.
    std::optional<int> tags;
    int refused_tags = 0;  // Of them, by the program.
    std::optional<int> points;
    std::optional<double> rms_px;
    std::optional<double> rms_mm;
    std::optional<double> influence_mm;
    std::optional<double> influence_mrad;
    bool ran = false;
    bool used = false;
    bool insisted = false;
    bool can_be_insisted_on = false;
    Message reason;
    bool rejected = false;  // By the user, in the last run.
    QString edited;         // What is left out by hand, in words.
    QString refused;        // What the program refused of it, in words.
    Message objection;      // What speaks against a scene that the user insists on.
  };
  void fill_result(Row& row, const CalibrationResult& result) const;
  void refill();
  void put_in_order();
  [[nodiscard]] QVariant text(const Row& row, int column) const;
  [[nodiscard]] QVariant number(const Row& row, int column) const;
  [[nodiscard]] QString tool_tip(const Row& row, int column) const;
  [[nodiscard]] QString state_words(const Row& row) const;
  [[nodiscard]] QString state_name(const Row& row) const;
  [[nodiscard]] QString state_said(const Row& row) const;
  [[nodiscard]] Mark mark_of(const Row& row) const;

  std::vector<Row> rows_;
  Decisions decisions_;
  std::shared_ptr<const CalibrationResult> result_;
  std::filesystem::path dataset_;  // Whose scenes these are.
  bool has_tags_ = true;
  QHash<QString, QPixmap> thumbnails_;
  int thumbnail_width_ = 48;
  std::optional<QFontMetrics> metrics_;  // None: as much room as is needed.
  int state_room_px_ = 0;
  QHash<QString, Message> problems_;
};

}  // namespace lvcalib::widgets
