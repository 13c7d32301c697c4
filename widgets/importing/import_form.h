// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "dialogs/choices.h"
#include "runner/recording_work.h"
#include "target/target.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace lvcalib::widgets {

class BoardChoice;

/// What an import is asked for: topics, intrinsics, board, folder.
class ImportForm : public QWidget {
  Q_OBJECT

 public:
  /// `choices` must outlive this. `recent`: datasets and projects whose boards are offered.
  ImportForm(Choices& choices, const QStringList& recent, QWidget* parent = nullptr);

  void clear();
  void setRecording(const OpenedRecording& opened);
  /// Topics, intrinsics, shortest stretch, replacing; not the times of scenes.
  [[nodiscard]] ImportOptions options() const;
  /// The board; nothing if its file cannot be used (problem() says why).
  [[nodiscard]] const std::optional<Target>& target() const;
  [[nodiscard]] QString folder() const;
  /// Why nothing can be imported; empty: nothing stands in the way.
  [[nodiscard]] QString problem() const;

 Q_SIGNALS:
  /// Other topics: the recording must be looked through again.
  void topicsChanged();
  /// Other limits for the stretches; what was seen stays.
  void limitsChanged();
  /// Another board or camera.
  void boardChanged();
  void changed();

 private:
  void retranslate();
  void fillTopics();
  void fillIntrinsics(bool keep);
  void chooseIntrinsics(int index);
  void useCamera(const QString& path);
  [[nodiscard]] QString placeOfFiles() const;
  void browseFolder();
  void checkFolder();
  [[nodiscard]] QString suggestedFolder() const;

  Choices& choices_;
  std::optional<OpenedRecording> opened_;
  std::optional<Camera> camera_;  // From a file.
  QString camera_path_;
  QString camera_problem_;
  int last_intrinsics_ = 0;

  QComboBox* image_;
  QComboBox* cloud_;
  QComboBox* intrinsics_;
  BoardChoice* board_;
  QDoubleSpinBox* least_;
  QLineEdit* folder_;
  QPushButton* browse_;
  QCheckBox* replace_;
  QLabel* labels_[6];
};

}  // namespace lvcalib::widgets
