// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>

#include "dialogs/choices.h"
#include "report/exports.h"
#include "runner/runner.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPlainTextEdit;
class QPushButton;

namespace lvcalib::widgets {

/// The result in the formats of other tools: a list, a preview, copy and save. A format that needs
/// T_imu_lidar asks for a YAML file with it.
class ExportPane : public QWidget {
  Q_OBJECT

 public:
  /// `folder`: where files are suggested. `choices` must outlive the pane.
  ExportPane(ExportInput input, Choices& choices, QString folder, QWidget* parent);

  /// Another result; the frames' names and T_imu_lidar are the user's and stay.
  void setInput(ExportInput input);
  /// What the frames are called.
  void setFrameNames(const QString& lidar, const QString& camera);
  /// Chooses a format by its name; unknown names change nothing.
  void chooseFormat(const QString& name);

 Q_SIGNALS:
  /// The user calls the frames so; said only of names that exports can hold.
  void frameNamesChanged(const QString& lidar, const QString& camera);
  void exported(const QString& path);
  void failed(const lvcalib::Error& error);

 private:
  QWidget* createList();
  QWidget* createPreview();
  void fillScenes();
  void retranslate();
  void preview();
  void readImu();
  void takeFrameNames();
  void save();
  void saveCloud(const QString& path);

  ExportInput input_;
  Choices& choices_;
  QString folder_;
  QListWidget* formats_ = nullptr;
  QLabel* about_ = nullptr;
  QPlainTextEdit* text_ = nullptr;
  QLabel* frames_ = nullptr;
  QLineEdit* lidar_ = nullptr;
  QLineEdit* camera_ = nullptr;
  QPushButton* imu_ = nullptr;
  QPushButton* copy_ = nullptr;
  QPushButton* save_ = nullptr;
  QComboBox* scene_ = nullptr;  // Of a coloured cloud.
  Runner runner_;               // Writes clouds.
};

}  // namespace lvcalib::widgets
