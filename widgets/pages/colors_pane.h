// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <memory>

#include "pages/cloud_brush.h"
#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// A scene's cloud in the camera's colours: the quickest check of an extrinsic by eye. Points about
/// the board can be left out here, too.
class ColorsPane : public BrushedCloudPane {
  Q_OBJECT

 public:
  explicit ColorsPane(QWidget* parent = nullptr);

  /// Null: nothing is known yet.
  void setResult(std::shared_ptr<const CalibrationResult> result);
  /// Cloud and image of the scene that is shown: index into the result's scenes.
  void setSceneData(int scene, std::shared_ptr<const Cloud> full_cloud, QImage image);

 private:
  void rebuild();
  [[nodiscard]] PointsOfScenes byScene(const std::vector<std::uint32_t>& points) const override;

  std::shared_ptr<const CalibrationResult> result_;
  std::shared_ptr<const Cloud> full_cloud_;
  QImage image_;
  int scene_ = -1;
};

}  // namespace lvcalib::widgets
