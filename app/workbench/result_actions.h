// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPointer>
#include <memory>
#include <optional>
#include <vector>

#include "dialogs/choices.h"
#include "report/frame_names.h"
#include "runner/comparison_work.h"
#include "runner/report_writer.h"
#include "start/app_settings.h"
#include "tools/plan_dialog.h"
#include "words/quality_text.h"

namespace lvcalib::widgets {

class ResultsDialog;

/// What is done with a result: the results dialog, the report, corrected clouds, a comparison, a
/// plan of more scenes.
class ResultActions : public QObject {
  Q_OBJECT

 public:
  /// `window` owns this and the dialogs; all three must outlive this.
  ResultActions(Choices& choices, AppSettings& settings, QWidget& window);

  /// Something was opened, whose frames are called so.
  void set_frames(const FrameNames& names);
  /// Nothing without a result.
  void show(const std::shared_ptr<const CalibrationResult>& result, const Standing& standing);
  /// What is open now has this result: dialogs that show one of it follow.
  void follow(const std::shared_ptr<const CalibrationResult>& result, const Standing& standing);
  /// Asks for a file and writes the report in the background.
  /// `discovery`: what was found out about the model, may be null.
  void write_report(const std::shared_ptr<const CalibrationResult>& result,
                    const std::shared_ptr<const Discovery>& discovery);
  /// Nothing without a result.
  void correct_clouds(const std::shared_ptr<const CalibrationResult>& result);
  /// Nothing without a result.
  void compare(const ComparisonBasis& basis);
  /// Lays a pose over scenes of what is open and over fresh data. Without a result the pose is the
  /// rough one, or that of a LiDAR that looks ahead. `decided`: the rough pose is the user's.
  void check(const std::shared_ptr<const CalibrationResult>& result, const Dataset& dataset,
             const std::optional<Rigid3>& rough, bool decided);
  void plan_scenes(const PlanBasis& basis);
  /// `folder`: whose target.yaml and camera.yaml are opened; empty: nothing is.
  void edit_target_camera(const QString& folder);
  /// A camera alone, from a folder of images; nothing need be open.
  void calibrate_camera();
  /// `present`: the board of what is open.
  void print_board(const std::optional<Target>& present);
  void cancel() { report_.cancel(); }
  /// A report is being written.
  [[nodiscard]] bool busy() const { return report_.busy(); }

 Q_SIGNALS:
  void progressed(const QString& stage, double fraction, const QString& text);
  /// Something was written or not; a line for the status.
  void done(const QString& message);
  void busy_changed();
  void logged(const QString& line);
  void failed(const lvcalib::Error& error);
  /// The user calls the frames otherwise.
  void frames_changed(const lvcalib::FrameNames& names);
  /// A rough pose was found by hand, or is to be forgotten.
  void rough_pose_wanted(const std::optional<lvcalib::Rigid3>& camera_from_lidar);

 private:
  void remember(const QString& path);

  Choices& choices_;
  AppSettings& settings_;
  QWidget& window_;
  FrameNames frames_;
  std::vector<QPointer<ResultsDialog>> following_;
  int opened_ = 0;  // A dialog of what was open before names nothing of what is open now.
  ReportWriter report_;
};

}  // namespace lvcalib::widgets
