// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>

#include "dialogs/choices.h"
#include "runner/runner.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace lvcalib::widgets {

class CameraPage;

/// A camera alone, without a dataset: a folder of images of the board, target.yaml, and what the
/// page of the camera shows of them.
class CameraDialog : public QDialog {
  Q_OBJECT

 public:
  /// `folder`: where the search for one starts. `choices` must outlive this.
  CameraDialog(Choices& choices, const QString& folder, QWidget* parent = nullptr);
  ~CameraDialog() override;
  [[nodiscard]] CameraPage& page() { return *page_; }
  [[nodiscard]] bool busy() const;

 Q_SIGNALS:
  void cameraSaved(const QString& path);

 private:
  void connectParts();
  /// A chosen path, empty if none was, into its field.
  void take(QLineEdit* field, const QString& path);
  [[nodiscard]] QString startFolder() const;
  /// Reads what the fields name, in a worker thread: a folder of thousands of files takes a while.
  void read();
  void say(const QString& text);
  void retranslate();

  Choices& choices_;
  QString start_folder_;
  QLabel* labels_[4];
  QLineEdit* folder_;
  QPushButton* choose_folder_;
  QLineEdit* target_;
  QPushButton* choose_target_;
  QLineEdit* camera_;
  QPushButton* choose_camera_;
  QComboBox* model_;
  QLabel* text_;
  CameraPage* page_;
  Runner runner_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
