// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <optional>

#include "dialogs/choices.h"
#include "runner/recording_work.h"

class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace lvcalib::widgets {

class ImportFoot;
class ImportForm;
class ImportWarnings;
class StretchList;
class TimeLine;
class TopicList;

/// From a recording to a dataset: what was recorded and what stands in the way, where nothing
/// moves, which of these stretches become scenes. All work is done beside the window.
class ImportDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this; `recent`: datasets whose boards are offered.
  ImportDialog(Choices& choices, const QStringList& recent, QWidget* parent = nullptr);
  ~ImportDialog() override;

  /// A file or folder; of a rosbag2 folder its metadata.yaml will do.
  void openRecording(const QString& path);
  [[nodiscard]] bool busy() const { return work_.busy(); }

 Q_SIGNALS:
  /// The dataset is complete and can be opened.
  void imported(const QString& dataset, const lvcalib::ImportSummary& summary);

 private:
  void build();
  void connectParts();
  void retranslate();
  void takeOpened(const OpenedRecording& opened);
  void showGlimpses();
  void takeLook(const RecordingLook& look);
  void takeImported(const ImportSummary& summary, const QString& dataset);
  void lookAgain(bool with_topics);
  [[nodiscard]] ImportOptions options() const;
  void moveEdges(int stretch, double first_s, double last_s);
  void takeAsFound();
  void showEdges();
  void showStretches();
  void takeBackEdges();
  void showPictures();
  void showTaken();
  void showWarnings();
  void showProblem(const std::optional<Error>& error);
  void startImport();
  void refresh();

  Choices& choices_;
  QString path_;
  std::optional<OpenedRecording> opened_;
  std::optional<RecordingLook> look_;
  std::optional<Error> error_;
  std::vector<MovedEdges> moved_;
  std::vector<MovedEdges> moved_shown_;  // Those that the look is of.

  QLabel* title_;
  QPushButton* other_;
  TopicList* topics_;
  ImportForm* form_;
  ImportWarnings* warnings_;
  TimeLine* time_line_;
  StretchList* stretches_;
  QLabel* edges_;
  QDoubleSpinBox* first_;
  QDoubleSpinBox* last_;
  QPushButton* as_found_;
  ImportFoot* foot_;
  RecordingWork work_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
