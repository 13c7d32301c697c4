// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dialogs/choices.h"
#include "runner/edge_work.h"
#include "runner/runner.h"
#include "views/color_map.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QGroupBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QSlider;

namespace lvcalib::widgets {

class ImageView;

/// The pose that a check begins with.
struct CheckedPose {
  enum class Kind {
    kCalibration,  ///< Of a result.
    kRough,        ///< Entered, or rig.yaml's.
    kNone,         ///< x forward, y left, z up at the camera's place.
  };
  Kind kind = Kind::kNone;
  Rigid3 camera_from_lidar;
  std::optional<Matrix6d> covariance;
};

/// What a check starts with.
struct CheckStart {
  Camera camera;
  CheckedPose pose;
  std::vector<FilePair> pairs;  ///< Places of what is open, shown first; may be empty.
  bool has_guess = false;       ///< A rough pose is in force.
  QString folder;               ///< Where others are looked for first.
};

/// A pose laid over a picture: the LiDAR's points and edges under a pose that sliders and the mouse
/// move, how well edges agree there, and whether that contradicts the calibration. For fresh data
/// without a board, and to find a rough pose by hand.
class CheckDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this.
  CheckDialog(CheckStart start, Choices& choices, QWidget* parent = nullptr);
  ~CheckDialog() override;

  [[nodiscard]] bool busy() const { return work_.busy(); }
  /// What the sliders show.
  [[nodiscard]] Rigid3 pose() const;

 Q_SIGNALS:
  /// The pose shown is to be the rough one; nothing: none is.
  void roughPoseWanted(const std::optional<lvcalib::Rigid3>& camera_from_lidar);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void build();
  void connectParts();
  void retranslate();
  void openFolder(const QString& folder);
  void takeLoaded(const std::shared_ptr<const EdgePlaces>& places);
  void showPlace();
  void look();
  void drawLook();
  void showLegend(const ColorScale& ranges);
  void drag(const QPointF& from, const QPointF& to, Qt::KeyboardModifiers modifiers);
  void setPose(const Rigid3& pose);
  void setRange();
  void showState();
  [[nodiscard]] QString stateText() const;
  [[nodiscard]] QString checkText(const EdgeCheck& check) const;

  Camera camera_;
  CheckedPose given_;
  std::vector<FilePair> pairs_;
  bool has_guess_;
  Choices& choices_;
  QString folder_;
  std::shared_ptr<const EdgePlaces> places_;
  std::shared_ptr<const EdgeLook> look_;
  std::shared_ptr<const EdgeCheck> check_;
  std::optional<Error> error_;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();   // Rotation vector, camera frame.
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();  // m, camera frame.
  bool moved_by_hand_ = false;

  QLabel* place_label_;
  QComboBox* place_;
  QPushButton* browse_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QLabel* verdict_;
  ImageView* image_;
  QLabel* hint_;
  QCheckBox* points_;
  QCheckBox* edges_;
  QLabel* score_;
  QLabel* legend_;
  QGroupBox* group_;
  QLabel* range_label_;
  QComboBox* range_;
  QLabel* names_[6];
  QSlider* sliders_[6];
  QDoubleSpinBox* boxes_[6];
  QPushButton* reset_;
  QPushButton* best_;
  QPushButton* take_;
  QPushButton* forget_;
  QPushButton* close_;
  Runner loader_;
  EdgeWork work_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
