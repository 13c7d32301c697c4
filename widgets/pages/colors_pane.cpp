// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/colors_pane.h"

#include <QVBoxLayout>

#include "pages/scene_overlay.h"
#include "views/cloud_scene_builder.h"
#include "views/cloud_view.h"
#include "views/tool_row.h"

namespace lvcalib::widgets {

ColorsPane::ColorsPane(QWidget* parent)
    : QWidget(parent), view_(new CloudView(this)), builder_(new CloudSceneBuilder(this)) {
  auto* bar = new ToolRow(this);
  for (QAction* action : view_->viewActions()) bar->addTool(action);
  brush_ =
      new CloudBrush(view_, bar, QStringLiteral("colors"),
                     [this](const std::vector<std::uint32_t>& points) { return byScene(points); });
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 4, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(bar);
  layout->addWidget(view_, 1);
  connect(builder_, &CloudSceneBuilder::ready, view_, &CloudView::setScene);
  connect(view_->figureActions(), &FigureActions::failed, this, &ColorsPane::failed);
  connect(brush_, &CloudBrush::excludeWanted, this, &ColorsPane::excludeWanted);
}

bool ColorsPane::busy() const {
  return builder_->busy();
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
  brush_->clear();
  CloudSceneInput input;
  input.color = CloudColor::kCameraColor;
  if (result_ && scene_ >= 0 && has_extrinsic(*result_)) {
    input.full = full_cloud_;
    input.image = image_;
    input.target = result_->target;
    input.camera = result_->camera;
    input.camera_from_lidar = result_->extrinsic.camera_from_lidar.transform;
  }
  builder_->request(std::move(input));
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
