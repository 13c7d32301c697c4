// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/result_actions.h"

#include <QDir>
#include <QFileInfo>

#include "design/lidar_file.h"
#include "dialogs/results_dialog.h"
#include "intrinsics/camera_dialog.h"
#include "tools/check_dialog.h"
#include "tools/compare_dialog.h"
#include "tools/correct_dialog.h"
#include "tools/print_dialog.h"
#include "tools/target_camera_dialog.h"

namespace lvcalib::widgets {

ResultActions::ResultActions(Choices& choices, AppSettings& settings, QWidget& window)
    : QObject(&window), choices_(choices), settings_(settings), window_(window) {
  connect(&report_, &ReportWriter::progressed, this, &ResultActions::progressed);
  connect(&report_, &ReportWriter::written, this,
          [this](const QString& path, const QStringList& warnings) {
            for (const QString& warning : warnings) Q_EMIT logged(warning);
            remember(path);
            Q_EMIT logged(tr("Report written to %1.").arg(path));
            Q_EMIT done(tr("Report written to %1").arg(QFileInfo(path).fileName()));
            Q_EMIT busy_changed();
          });
  connect(&report_, &ReportWriter::cancelled, this, [this] {
    Q_EMIT done(tr("Report cancelled"));
    Q_EMIT busy_changed();
  });
  connect(&report_, &ReportWriter::failed, this, [this](const Error& error) {
    Q_EMIT done(tr("The report could not be written"));
    Q_EMIT busy_changed();
    Q_EMIT failed(error);
  });
}

void ResultActions::set_frames(const FrameNames& names) {
  frames_ = names;
  following_.clear();
  ++opened_;
}

void ResultActions::follow(const std::shared_ptr<const CalibrationResult>& result,
                           const Standing& standing) {
  std::erase_if(following_, [](const auto& dialog) { return dialog == nullptr; });
  if (!result) return;
  for (const auto& dialog : following_) dialog->set_result(result, standing);
}

void ResultActions::show(const std::shared_ptr<const CalibrationResult>& result,
                         const Standing& standing) {
  if (!result) return;
  auto* dialog = new ResultsDialog(result, choices_, settings_.last_folder(), &window_);
  dialog->set_result(result, standing);
  following_.emplace_back(dialog);
  dialog->set_frame_names(QString::fromStdString(frames_.lidar),
                          QString::fromStdString(frames_.camera));
  connect(dialog, &ResultsDialog::frame_names_changed, this,
          [this, opened = opened_](const QString& lidar, const QString& camera) {
            if (opened != opened_) return;
            settings_.set_frame_names(lidar, camera);  // Of the next project, too.
            frames_ = {lidar.toStdString(), camera.toStdString()};
            Q_EMIT frames_changed(frames_);
          });
  connect(dialog, &ResultsDialog::failed, this, &ResultActions::failed);
  connect(dialog, &ResultsDialog::exported, this, [this](const QString& path) {
    remember(path);
    Q_EMIT logged(tr("Exported %1.").arg(path));
    Q_EMIT done(tr("Exported %1").arg(QFileInfo(path).fileName()));
  });
  dialog->show();
}

void ResultActions::write_report(const std::shared_ptr<const CalibrationResult>& result,
                                 const std::shared_ptr<const Discovery>& discovery) {
  if (!result) return;
  const QString suggestion = QDir(settings_.last_folder()).filePath(QStringLiteral("report.html"));
  QString path = choices_.file_to_export(&window_, suggestion, tr("HTML (*.html)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".html");
  report_.write(result, discovery, path, frames_);
  Q_EMIT busy_changed();
}

void ResultActions::correct_clouds(const std::shared_ptr<const CalibrationResult>& result) {
  if (!result) return;
  (new CorrectDialog(result, choices_, settings_.last_folder(), &window_))->show();
}

void ResultActions::compare(const ComparisonBasis& basis) {
  if (!basis.result) return;
  (new CompareDialog(basis, choices_, settings_.last_folder(), &window_))->show();
}

void ResultActions::check(const std::shared_ptr<const CalibrationResult>& result,
                          const Dataset& dataset, const std::optional<Rigid3>& rough,
                          bool decided) {
  CheckedPose pose{CheckedPose::Kind::kNone, forward_looking_mount(), {}};
  // A failed result is no pose to judge, and seldom one to begin with.
  if (result && result->quality != Quality::kFailed) {
    pose = {CheckedPose::Kind::kCalibration, result->extrinsic.camera_from_lidar.transform,
            result->extrinsic.camera_from_lidar.covariance};
  } else if (rough) {
    pose = {CheckedPose::Kind::kRough, *rough, {}};
  }
  std::vector<FilePair> pairs;
  for (const SceneFiles& scene : dataset.scenes) {
    if (!scene.problem) pairs.push_back({scene.name, scene.image, scene.cloud, {}, {}});
  }
  auto* dialog = new CheckDialog({result ? result->camera : dataset.camera, pose, std::move(pairs),
                                  decided, settings_.last_folder()},
                                 choices_, &window_);
  connect(dialog, &CheckDialog::roughPoseWanted, this, &ResultActions::rough_pose_wanted);
  dialog->show();
}

void ResultActions::plan_scenes(const PlanBasis& basis) {
  (new PlanDialog(basis, choices_, settings_.last_folder(), &window_))->show();
}

void ResultActions::edit_target_camera(const QString& folder) {
  auto* dialog = new TargetCameraDialog(
      choices_, folder.isEmpty() ? settings_.last_folder() : folder, &window_);
  const auto saved = [this](const QString& path) {
    remember(path);
    Q_EMIT logged(tr("Written: %1. What is open was read before; open it again to use this file.")
                      .arg(QDir::toNativeSeparators(path)));
  };
  connect(dialog, &TargetCameraDialog::targetSaved, this, saved);
  connect(dialog, &TargetCameraDialog::cameraSaved, this, saved);
  dialog->show();
}

void ResultActions::calibrate_camera() {
  auto* dialog = new CameraDialog(choices_, settings_.last_folder(), &window_);
  connect(dialog, &CameraDialog::cameraSaved, this, &ResultActions::remember);
  dialog->show();
}

void ResultActions::print_board(const std::optional<Target>& present) {
  (new PrintDialog(present, choices_, settings_.last_folder(), &window_))->show();
}

void ResultActions::remember(const QString& path) {
  settings_.set_last_folder(QFileInfo(path).absolutePath());
}

}  // namespace lvcalib::widgets

#include "moc_result_actions.cpp"
