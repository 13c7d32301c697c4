// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/colors_pane.h"

#include "pages/scene_overlay.h"
#include "views/cloud_scene_builder.h"

namespace lvcalib::widgets {

ColorsPane::ColorsPane(QWidget* parent) : BrushedCloudPane(parent) {
  addTools(QStringLiteral("colors"));
}

void ColorsPane::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  rebuild();
}

void ColorsPane::setSceneData(int scene, std::shared_ptr<const Cloud> full_cloud, QImage image) {
  scene_ = scene;
  full_cloud_ = std::move(full_cloud);
  image_ = std::move(image);
  rebuild();
}

void ColorsPane::rebuild() {
  brush()->clear();
  CloudSceneInput input;
  input.color = CloudColor::kCameraColor;
  if (result_ && scene_ >= 0 && has_extrinsic(*result_)) {
    input.full = full_cloud_;
    input.image = image_;
    input.target = result_->target;
    input.camera = result_->camera;
    input.camera_from_lidar = result_->extrinsic.camera_from_lidar.transform;
  }
  builder()->request(std::move(input));
}

PointsOfScenes ColorsPane::byScene(const std::vector<std::uint32_t>& points) const {
  if (!result_ || !full_cloud_ || scene_ < 0 || scene_ >= static_cast<int>(result_->scenes.size()))
    return {};
  const SceneResult& scene = result_->scenes[static_cast<std::size_t>(scene_)];
  auto out = points_about_board(scene, *full_cloud_, points);
  if (out.empty()) return {};
  return {{QString::fromStdString(scene.name), std::move(out)}};
}

}  // namespace lvcalib::widgets

#include "moc_colors_pane.cpp"
