// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>

#include "dialogs/choices.h"
#include "report/exports.h"

class QLabel;
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

  /// Chooses a format by its name; unknown names change nothing.
  void chooseFormat(const QString& name);

 Q_SIGNALS:
  void exported(const QString& path);
  void failed(const lvcalib::Error& error);

 private:
  QWidget* createList();
  QWidget* createPreview();
  void retranslate();
  void preview();
  void readImu();
  void save();

  ExportInput input_;
  Choices& choices_;
  QString folder_;
  QListWidget* formats_ = nullptr;
  QLabel* about_ = nullptr;
  QPlainTextEdit* text_ = nullptr;
  QPushButton* imu_ = nullptr;
  QPushButton* copy_ = nullptr;
  QPushButton* save_ = nullptr;
};

}  // namespace lvcalib::widgets
