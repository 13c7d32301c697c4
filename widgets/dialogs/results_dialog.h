// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>

#include "dialogs/choices.h"
#include "pipeline/calibration.h"
#include "report/frame_names.h"
#include "words/quality_text.h"

class QPlainTextEdit;
class QTextBrowser;

namespace lvcalib::widgets {

/// The pose as a 4×4 matrix, row by row, in metres.
QString matrix_text(const CalibrationResult& result);
/// Translation, quaternion, roll–pitch–yaw, each with its standard deviations, quality, warnings.
QString results_html(const CalibrationResult& result, const Standing& standing);

class ExportPane;

/// The result in all usual forms and in the formats of other tools, with export and copy.
class ResultsDialog : public QDialog {
  Q_OBJECT

 public:
  /// `folder`: where exports are suggested to go. `choices` must outlive the dialog.
  ResultsDialog(std::shared_ptr<const CalibrationResult> result, Choices& choices, QString folder,
                QWidget* parent);

  /// The same dialog of another result: what is shown and what is handed on.
  void set_result(std::shared_ptr<const CalibrationResult> result, const Standing& standing);
  /// What exports call the frames.
  void set_frame_names(const QString& lidar, const QString& camera);

 Q_SIGNALS:
  void frame_names_changed(const QString& lidar, const QString& camera);
  void exported(const QString& path);
  void failed(const lvcalib::Error& error);

 private:
  QWidget* create_pose();
  void fill_pose();
  void export_file(const QString& suffix, const QString& filter, const std::string& text);

  std::shared_ptr<const CalibrationResult> result_;
  Standing standing_;
  Choices& choices_;
  QString folder_;
  FrameNames frames_;
  ExportPane* exports_ = nullptr;
  QTextBrowser* text_ = nullptr;
  QPlainTextEdit* matrix_ = nullptr;
};

}  // namespace lvcalib::widgets
