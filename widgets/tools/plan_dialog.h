// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>
#include <optional>

#include "dialogs/choices.h"
#include "runner/plan_work.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QListWidget;
class QProgressBar;
class QPushButton;
class QSpinBox;
class QTreeWidget;

namespace lvcalib::widgets {

class BoardSketch;

/// What is open, as a plan needs it; everything may be missing.
struct PlanBasis {
  std::optional<Target> target;
  std::optional<Camera> camera;
  std::optional<Rigid3> rough_camera_from_lidar;  ///< Of rig.yaml.
  std::shared_ptr<const CalibrationResult> result;
  std::filesystem::path cloud;  ///< Of one of its scenes.
};

/// Board poses worth taking, before anybody walks out with the board: for the board, camera and
/// LiDAR that are open or chosen, one pose after the other with what is known once it is taken.
class PlanDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this; `folder`: where files are looked for first.
  PlanDialog(PlanBasis basis, Choices& choices, QString folder, QWidget* parent = nullptr);
  ~PlanDialog() override;

  [[nodiscard]] bool busy() const { return work_.busy(); }
  [[nodiscard]] std::shared_ptr<const ScenePlan> plan() const { return plan_; }

 private:
  QWidget* createForm();
  QWidget* createPlan();
  void connectParts();
  void retranslate();
  void fillLidars();
  void fillEffects();
  void chooseTarget();
  void chooseCamera();
  void takeFile(const QString& path, const std::optional<Error>& error);
  void chooseLidar(int index);
  void start();
  void take(const std::shared_ptr<const ScenePlan>& plan);
  void showPlan();
  void showPose();
  void refresh();
  void save();
  void copy();
  [[nodiscard]] bool ofResult() const;
  [[nodiscard]] QString problem() const;
  [[nodiscard]] QString planText() const;

  PlanBasis basis_;
  Choices& choices_;
  QString folder_;
  std::optional<Target> target_;
  std::optional<Camera> camera_;
  QString target_path_, camera_path_;      // Empty: those of what is open.
  std::optional<LidarDescription> lidar_;  // Of a file.
  QString lidar_path_;
  int last_lidar_ = 0;
  std::optional<Error> error_;
  QString note_;
  std::shared_ptr<const ScenePlan> plan_;

  QLabel* board_label_;
  QLabel* board_;
  QPushButton* browse_board_;
  QLabel* camera_label_;
  QLabel* camera_name_;
  QPushButton* browse_camera_;
  QLabel* lidar_label_;
  QComboBox* lidars_;
  QLabel* scenes_label_;
  QSpinBox* scenes_;
  QCheckBox* go_on_;
  QLabel* effects_label_;
  QListWidget* effects_;
  QPushButton* start_;
  QPushButton* cancel_;
  QProgressBar* progress_;
  QLabel* message_;
  QTreeWidget* table_;
  BoardSketch* sketch_;
  QLabel* pose_;
  QPushButton* save_;
  QPushButton* copy_;
  QPushButton* close_;
  PlanWork work_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
