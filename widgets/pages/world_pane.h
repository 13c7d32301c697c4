// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "cloud/field_of_view.h"
#include "pages/cloud_brush.h"
#include "pipeline/calibration.h"

class QComboBox;

namespace lvcalib::widgets {

/// All scenes in one world, about the rig that does not move: the boards' points, every board as
/// either sensor sees it, the LiDAR's axes and the pyramids of both views. A click on a board goes
/// to its scene.
class WorldPane : public BrushedCloudPane {
  Q_OBJECT

 public:
  explicit WorldPane(QWidget* parent = nullptr);

  /// Null: nothing is known yet.
  void setResult(std::shared_ptr<const CalibrationResult> result);
  /// A whole scan of the LiDAR, of whatever scene: where it looks.
  void setScan(const std::shared_ptr<const Cloud>& scan);

 Q_SIGNALS:
  /// Index into the result's scenes.
  void sceneActivated(int scene);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void retranslate();
  void rebuild();
  [[nodiscard]] PointsOfScenes byScene(const std::vector<std::uint32_t>& points) const override;

  std::shared_ptr<const CalibrationResult> result_;
  std::shared_ptr<const Cloud> boards_;
  FieldOfView lidar_;
  QComboBox* color_ = nullptr;
};

}  // namespace lvcalib::widgets
