// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/world_pane.h"

#include <QComboBox>
#include <QEvent>

#include <Eigen/Geometry>

#include "pages/scene_overlay.h"
#include "style/texts.h"
#include "views/cloud_scene_builder.h"
#include "views/cloud_view.h"
#include "views/plot_colors.h"
#include "views/tool_row.h"

namespace lvcalib::widgets {

WorldPane::WorldPane(QWidget* parent) : BrushedCloudPane(parent), color_(new QComboBox(row())) {
  color_->setObjectName(QStringLiteral("world-color"));
  for (const CloudColor color : {CloudColor::kScene, CloudColor::kIntensity, CloudColor::kRange})
    color_->addItem({}, static_cast<int>(color));
  row()->addWidget(color_);
  row()->addSeparator();
  addTools(QStringLiteral("world"));
  connect(color_, &QComboBox::currentIndexChanged, this, &WorldPane::rebuild);
  connect(view(), &CloudView::pointPicked, this, [this](std::uint32_t point) {
    if (boards_ && point < boards_->line.size())
      Q_EMIT sceneActivated(static_cast<int>(boards_->line[point]) - 1);
  });
  follow_language(this, [this] { retranslate(); });
}

void WorldPane::retranslate() {
  const QStringList colors = {tr("Scene"), tr("Intensity"), tr("Range")};
  for (int k = 0; k < colors.size(); ++k) color_->setItemText(k, colors[k]);
  color_->setAccessibleName(tr("Colour of the points"));
  color_->setToolTip(
      tr("What the colours of the points tell. Lines: every board as the LiDAR (orange) and as the "
         "camera sees it (blue), the LiDAR's axes (x red, y green, z blue), the views of both "
         "(pyramids). A click on a board goes to its scene."));
  rebuild();
}

PointsOfScenes WorldPane::byScene(const std::vector<std::uint32_t>& points) const {
  PointsOfScenes out;
  if (!result_) return out;
  for (const std::uint32_t i : points) {
    const std::size_t scene = boards_->line[i] - 1U;
    out[QString::fromStdString(result_->scenes[scene].name)].push_back(boards_->points_m[i]);
  }
  return out;
}

void WorldPane::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  boards_ = result_ ? std::make_shared<const Cloud>(all_boards(*result_)) : nullptr;
  brush()->clear();  // Points of another result.
  view()->setLines(result_ ? world_lines(*result_, lidar_) : std::vector<CloudLine>());
  rebuild();
}

void WorldPane::setScan(const std::shared_ptr<const Cloud>& scan) {
  if (!scan) return;  // What another scene has told still holds.
  lidar_ = field_of_view(*scan);
  if (result_) view()->setLines(world_lines(*result_, lidar_));
}

void WorldPane::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && color_ != nullptr) rebuild();
}

void WorldPane::rebuild() {
  CloudSceneInput input;
  input.color = static_cast<CloudColor>(color_->currentData().toInt());
  input.full = boards_;
  input.landmarks_m = {Eigen::Vector3d::Zero()};
  if (result_) {
    input.target = result_->target;
    const PlotColors colors = PlotColors::of(palette());
    for (const SceneResult& scene : result_->scenes) {
      const auto place = static_cast<int>(input.scenes.size());
      input.scenes.push_back({QString::fromStdString(scene.name), colors.series(place).rgb()});
    }
    for (const Eigen::Vector3d& p : camera_pyramid(*result_)) input.landmarks_m.push_back(p);
    // All boards, also one that stands far behind the others.
    Eigen::AlignedBox3f boards;
    for (const Eigen::Vector3f& p : boards_->points_m) boards.extend(p);
    if (!boards.isEmpty()) {
      for (const Eigen::Vector3f& p : {boards.min(), boards.max()})
        input.landmarks_m.push_back(p.cast<double>());
    }
  } else {
    input.problem = tr("run the calibration first");
  }
  builder()->request(std::move(input));
}

}  // namespace lvcalib::widgets

#include "moc_world_pane.cpp"
