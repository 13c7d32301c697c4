// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/cloud_brush.h"

#include <QAction>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "style/texts.h"
#include "views/cloud_scene_builder.h"
#include "views/cloud_view.h"
#include "views/tool_row.h"

namespace lvcalib::widgets {

std::vector<Eigen::Vector3f> points_about_board(const SceneResult& scene, const Cloud& cloud,
                                                const std::vector<std::uint32_t>& points) {
  const auto key = [](const Eigen::Vector3f& p) {
    return std::array<float, 3>{p.x(), p.y(), p.z()};
  };
  std::set<std::array<float, 3>> wanted;
  for (const std::uint32_t i : points) {
    if (i < cloud.size()) wanted.insert(key(cloud.points_m[i]));
  }
  std::vector<Eigen::Vector3f> out;
  for (const Cloud* part : {&scene.board_points, &scene.left_out_points}) {
    for (const Eigen::Vector3f& p : part->points_m) {
      if (wanted.contains(key(p))) out.push_back(p);
    }
  }
  return out;
}

std::vector<std::uint32_t> same_directions(const Cloud& cloud,
                                           const std::vector<Eigen::Vector3d>& wanted) {
  static constexpr double kSameDirection =
      1e-5;  // Far below the distance of beams, far above rounding.
  const auto key = [](const Eigen::Vector3d& p) {
    const Eigen::Vector3d d = p.normalized() / kSameDirection;
    return std::array<std::int64_t, 3>{std::llround(d.x()), std::llround(d.y()),
                                       std::llround(d.z())};
  };
  std::set<std::array<std::int64_t, 3>> directions;
  for (const Eigen::Vector3d& p : wanted) directions.insert(key(p));
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (directions.contains(key(cloud.points_m[i].cast<double>())))
      found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

CloudBrush::CloudBrush(CloudView* view, ToolRow* row, const QString& name, ByScene by_scene)
    : QObject(row), view_(view), by_scene_(std::move(by_scene)) {
  brush_ = row->newTool();
  brush_->setObjectName(name + QStringLiteral("-brush"));
  brush_->setCheckable(true);
  brush_->setShortcut(QKeySequence(Qt::Key_L));
  brush_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  brush_->setEnabled(view_->hasOpenGl());
  view_->addAction(brush_);
  text_ = new QLabel(row);
  text_->setObjectName(name + QStringLiteral("-selection"));
  exclude_ = new QToolButton(row);
  exclude_->setObjectName(name + QStringLiteral("-exclude"));
  row->addWidget(text_);
  row->addWidget(exclude_);
  connect(brush_, &QAction::toggled, this, [this](bool on) {
    view_->setBrushing(on);
    if (!on) clear();
  });
  connect(view_, &CloudView::pointsBrushed, this, &CloudBrush::select);
  connect(exclude_, &QToolButton::clicked, this,
          [this] { Q_EMIT excludeWanted(by_scene_(selected_)); });
  follow_language(row, [this] { retranslate(); });
}

void CloudBrush::retranslate() {
  brush_->setText(tr("Brush"));
  brush_->setToolTip(
      tr("Draw a line about points to select them, at whatever depth. With Shift they are added to "
         "those selected"));
  exclude_->setText(tr("Exclude these"));
  exclude_->setToolTip(tr("Leave out what is selected, in every scene, and solve again"));
  select(selected_, false);
}

void CloudBrush::clear() {
  select({}, false);
}

void CloudBrush::select(const std::vector<std::uint32_t>& points, bool add) {
  std::set<std::uint32_t> all(points.begin(), points.end());
  if (add) all.insert(selected_.begin(), selected_.end());
  selected_.assign(all.begin(), all.end());
  view_->setHighlights(selected_);
  std::size_t count = 0;
  if (!selected_.empty()) {
    for (const auto& [scene, of_scene] : by_scene_(selected_)) count += of_scene.size();
  }
  text_->setText(selected_.empty() ? QString()
                 : count == 0      ? tr("none about a board")
                                   : tr("%n points", nullptr, static_cast<int>(count)));
  text_->setToolTip(count == 0 ? tr("Only points about a board play a part.") : QString());
  text_->setVisible(!selected_.empty());
  exclude_->setVisible(count > 0);
}

BrushedCloudPane::BrushedCloudPane(QWidget* parent)
    : QWidget(parent),
      row_(new ToolRow(this)),
      view_(new CloudView(this)),
      builder_(new CloudSceneBuilder(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 4, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(row_);
  layout->addWidget(view_, 1);
  connect(builder_, &CloudSceneBuilder::ready, view_, &CloudView::setScene);
  connect(view_->figureActions(), &FigureActions::failed, this, &BrushedCloudPane::failed);
}

void BrushedCloudPane::addTools(const QString& name) {
  for (QAction* action : view_->viewActions()) row_->addTool(action);
  brush_ = new CloudBrush(view_, row_, name, [this](const std::vector<std::uint32_t>& points) {
    return byScene(points);
  });
  connect(brush_, &CloudBrush::excludeWanted, this, &BrushedCloudPane::excludeWanted);
}

bool BrushedCloudPane::busy() const {
  return builder_->busy();
}

}  // namespace lvcalib::widgets

#include "moc_cloud_brush.cpp"
