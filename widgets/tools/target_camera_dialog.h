// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <optional>
#include <string>

#include "base/error.h"
#include "dialogs/choices.h"

class QLabel;
class QPushButton;
class QTabWidget;

namespace lvcalib::widgets {

class CameraForm;
class TargetForm;

/// Makes and edits target.yaml and camera.yaml. Files are written whole or not at all.
class TargetCameraDialog : public QDialog {
  Q_OBJECT

 public:
  enum class Page { kTarget, kCamera };

  /// `folder`: where files are proposed; what is there is opened. `choices` must outlive this.
  TargetCameraDialog(Choices& choices, const QString& folder, QWidget* parent = nullptr);

  void showPage(Page page);
  void openTarget(const QString& path);
  void openCamera(const QString& path);

 Q_SIGNALS:
  void targetSaved(const QString& path);
  void cameraSaved(const QString& path);

 private:
  void retranslate();
  void browse();
  void save(bool ask);
  void refresh();
  [[nodiscard]] bool onTarget() const;
  [[nodiscard]] std::string textOf(int which) const;
  struct File {
    QString path;      // Empty: none yet.
    std::string text;  // Of the form when it was opened or saved.
    QString written;   // What was done last.
    std::optional<Error> error;
  };
  [[nodiscard]] File& file() { return files_[onTarget() ? 0 : 1]; }

  Choices& choices_;
  QString folder_;
  File files_[2];
  QTabWidget* tabs_;
  TargetForm* target_;
  CameraForm* camera_;
  QLabel* place_;
  QLabel* problem_;
  QPushButton* open_;
  QPushButton* save_;
  QPushButton* save_as_;
  QPushButton* close_;
};

}  // namespace lvcalib::widgets
