// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/scene_page.h"

#include <QLabel>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "camera/cloud_projection.h"
#include "pages/cloud_brush.h"
#include "pages/cloud_pane.h"
#include "pages/image_pane.h"
#include "pages/scene_overlay.h"
#include "pages/selection_bar.h"
#include "style/edits_text.h"
#include "style/texts.h"
#include "views/cloud_view.h"
#include "views/image_view.h"
#include "views/lasso.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr std::size_t kNeighbours = 12;
constexpr double kNeighbourhood_px = 25.0;
constexpr std::size_t kTagPoints = 400;
constexpr std::size_t kMostRings = 400;

// A cloud that lives as long as the result it is part of.
std::shared_ptr<const Cloud> board_points(const std::shared_ptr<const CalibrationResult>& result,
                                          const SceneResult* scene) {
  if (scene == nullptr || scene->board_points.size() == 0) return nullptr;
  return {result, &scene->board_points};
}

}  // namespace

ScenePage::ScenePage(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  refusal_ = new QLabel(this);
  refusal_->setObjectName("scene-refusal");
  refusal_->setWordWrap(true);
  refusal_->setTextFormat(Qt::RichText);
  refusal_->hide();
  connect(refusal_, &QLabel::linkActivated, this, [this] {
    if (scene_ >= 0) Q_EMIT insistWanted(scene_);
  });
  layout->addWidget(refusal_);
  edits_ = new QLabel(this);
  edits_->setObjectName("scene-edits");
  edits_->setWordWrap(true);
  edits_->setTextFormat(Qt::RichText);
  edits_->hide();
  connect(edits_, &QLabel::linkActivated, this, [this] {
    if (scene_ >= 0) Q_EMIT editsChanged(scene_, {});
  });
  layout->addWidget(edits_);
  auto* splitter = new QSplitter(Qt::Horizontal, this);
  splitter->setChildrenCollapsible(false);
  cloud_ = new CloudPane(splitter);
  image_ = new ImagePane(splitter);
  splitter->addWidget(cloud_);
  splitter->addWidget(image_);
  splitter->setStretchFactor(0, 1);
  splitter->setStretchFactor(1, 1);
  splitter->setSizes({1000, 1000});
  layout->addWidget(splitter, 1);
  selection_ = new SelectionBar(this);
  layout->addWidget(selection_);
  connectPanes();
  follow_language(this, [this] {
    clearSelection();
    refresh();
  });
}

ScenePage::~ScenePage() = default;

void ScenePage::connectPanes() {
  connect(cloud_->view(), &CloudView::pointPicked, this, &ScenePage::selectPoint);
  connect(cloud_->view(), &CloudView::nothingPicked, this, &ScenePage::clearSelection);
  connect(cloud_, &CloudPane::sceneShown, this, [this] {
    refreshOverlay();
    showSamples();
  });
  connect(cloud_, &CloudPane::cropApplied, this, [this](const CropBox& box) {
    if (scene_ >= 0) Q_EMIT cropChanged(scene_, box);
  });
  connect(cloud_, &CloudPane::cropCleared, this, [this] {
    if (scene_ >= 0) Q_EMIT cropCleared(scene_);
  });
  connect(cloud_->view(), &CloudView::pointsBrushed, this, &ScenePage::brushPoints);
  connect(image_->view(), &ImageView::brushed, this, &ScenePage::brushImage);
  connect(selection_, &SelectionBar::editsWanted, this, [this](const SceneEdits& edits) {
    if (scene_ >= 0) Q_EMIT editsChanged(scene_, edits);
  });
  connect(selection_, &SelectionBar::patchEverywhereWanted, this, &ScenePage::patchExcluded);
  connect(image_->view(), &ImageView::pixelClicked, this, &ScenePage::selectPixel);
  connect(image_->view(), &ImageView::tagClicked, this, &ScenePage::selectTag);
  connect(image_->view(), &ImageView::circleClicked, this, &ScenePage::selectCircle);
  connect(cloud_->view()->figureActions(), &FigureActions::failed, this, &ScenePage::failed);
  connect(image_->view()->figureActions(), &FigureActions::failed, this, &ScenePage::failed);
}

const SceneResult* ScenePage::current() const {
  if (!result_ || scene_ < 0 || scene_ >= static_cast<int>(result_->scenes.size())) return nullptr;
  return &result_->scenes[static_cast<std::size_t>(scene_)];
}

void ScenePage::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  clearSelection();
  refresh();
}

void ScenePage::setModel(ModelStepPtr step) {
  if (step == model_) return;
  model_ = std::move(step);
  cloud_->setSurface(surface());
}

// Made by the thread that builds the picture, from what is in force now.
std::function<std::optional<BoardSurface>()> ScenePage::surface() const {
  if (current() == nullptr) return {};
  return [result = result_, place = static_cast<std::size_t>(scene_), step = model_] {
    return board_surface(*result, place, step.get());
  };
}

void ScenePage::setScene(int index) {
  if (index == scene_) return;
  scene_ = index;
  full_cloud_.reset();
  picture_ = {};
  cloud_problem_ = {};
  image_problem_ = {};
  cloud_->setCrop(std::nullopt);
  image_->view()->setImage({});
  clearSelection();
  refresh();
}

void ScenePage::setSceneData(std::shared_ptr<const Cloud> full_cloud, QImage image) {
  full_cloud_ = std::move(full_cloud);
  picture_ = std::move(image);
  image_->view()->setImage(picture_);
  clearSelection();
  refresh();
}

void ScenePage::setTarget(const Target& target) {
  target_ = target;
}

void ScenePage::setProblems(const Message& cloud, const Message& image) {
  cloud_problem_ = cloud;
  image_problem_ = image;
  refresh();
}

void ScenePage::setCropBox(const std::optional<CropBox>& box) {
  cloud_->setCrop(box);
}

void ScenePage::setEdits(const SceneEdits& edits) {
  selection_->setEdits(edits);
}

void ScenePage::refresh() {
  const SceneResult* scene = current();
  CloudSceneInput input;
  input.full = full_cloud_;
  input.board = board_points(result_, scene);
  input.image = picture_;
  input.problem = core_text(cloud_problem_);
  std::vector<CloudLine> lines;
  if (scene != nullptr) {
    input.target = result_->target;
    input.camera = result_->camera;
    input.refinement = scene->refinement;
    input.surface = surface();
    input.unused = [result = result_, place = static_cast<std::size_t>(scene_)] {
      return unused_points(*result, result->scenes[place]);
    };
    if (has_extrinsic(*result_)) {
      input.camera_from_lidar = result_->extrinsic.camera_from_lidar.transform;
    }
    lines = cloud_lines(*result_, *scene);
  } else if (!result_ && target_) {
    input.target = *target_;
    input.seek_board = true;
  }
  const Eigen::Vector3d middle =
      cloud_->view()->scene() ? cloud_->view()->scene()->center_m : Eigen::Vector3d::UnitX();
  cloud_->setSuggestedBox(box_about_board(result_.get(), scene, middle));
  cloud_->setInput(std::move(input), std::move(lines));
  image_->view()->setMessage(scene_ < 0 ? tr("Choose a scene in the list.")
                             : !image_problem_.empty() && image_problem_ == cloud_problem_
                                 ? core_text(image_problem_)  // The scene as such is incomplete.
                             : image_problem_.empty()
                                 ? tr("The image is being loaded …")
                                 : tr("There is no image: %1").arg(core_text(image_problem_)));
  refreshOverlay();
  showRefusal();
}

// What the program refused says so where it is looked at, and how to overrule it.
void ScenePage::showRefusal() {
  const SceneResult* scene = current();
  const QString edits = scene != nullptr ? edits_text(*scene) : QString();
  const QString unused = scene != nullptr ? refusals_text(*result_, scene->name) : QString();
  edits_->setVisible(!edits.isEmpty() || !unused.isEmpty());
  QStringList parts;
  if (!edits.isEmpty())
    parts << QStringLiteral("%1 <a href=\"undo\">%2</a>")
                 .arg(edits.toHtmlEscaped(), tr("As the program would have it"));
  if (!unused.isEmpty()) parts << unused.toHtmlEscaped();
  edits_->setText(parts.join(QLatin1Char(' ')));
  edits_->setToolTip(unused.isEmpty()
                         ? QString()
                         : tr("Drawn in red. A click on one says why, and offers to use "
                              "it all the same where that is possible."));
  const bool refused =
      scene != nullptr && !scene->used && !scene->reason.empty() && !scene->rejected;
  refusal_->setVisible(refused);
  if (!refused) return;
  QString text = QStringLiteral("<b>%1</b> %2")
                     .arg(tr("This scene is left out:").toHtmlEscaped(),
                          core_text(scene->reason).toHtmlEscaped());
  if (can_be_insisted_on(*scene))
    text += QStringLiteral(" <a href=\"insist\">%1</a>").arg(tr("Use it all the same"));
  refusal_->setText(text);
}

void ScenePage::refreshOverlay() {
  const SceneResult* scene = current();
  ImageOverlay overlay = scene != nullptr ? image_overlay(*result_, *scene) : ImageOverlay();
  if (const auto& cloud = cloud_->view()->scene()) {
    if (scene != nullptr) add_unused(overlay, *result_, cloud->unused);
    add_points(overlay, *cloud);
  }
  image_->setOverlay(std::move(overlay));
}

void ScenePage::selectPoint(std::uint32_t point) {
  sample_points_m_.clear();
  sample_pixels_.clear();
  const auto& scene = cloud_->view()->scene();
  if (!scene || !scene->cloud || point >= scene->cloud->size()) return;
  QString text =
      describePoint(*scene->cloud, point) + refusalOfPoint(scene->cloud->points_m[point]);
  std::vector<std::uint32_t> points{point};
  // Its place tells whether it is the point of this number in what is shown now.
  if (picked_ && *picked_ < scene->cloud->size() && *picked_ != point &&
      scene->cloud->points_m[*picked_] == picked_m_) {
    points.push_back(*picked_);
    const Eigen::Vector3f d = scene->cloud->points_m[point] - picked_m_;
    text += QLatin1Char('\n') + tr("%1 m from point %2, picked before: Δx %3, Δy %4, Δz %5 m")
                                    .arg(d.norm(), 0, 'f', 4)
                                    .arg(*picked_)
                                    .arg(d.x(), 0, 'f', 4)
                                    .arg(d.y(), 0, 'f', 4)
                                    .arg(d.z(), 0, 'f', 4);
  }
  picked_ = point;
  picked_m_ = scene->cloud->points_m[point];
  cloud_->view()->setHighlights(points);
  selection_->setText(text);
  selection_->setSelection({aboutBoard({point}), {}, {}}, result_.get(), current());
  std::vector<QPointF> places;
  if (point < scene->pixels.size() && std::isfinite(scene->pixels[point].x())) {
    const Eigen::Vector2d pixel = scene->pixels[point].cast<double>();
    places.emplace_back(pixel.x(), pixel.y());
  }
  image_->view()->overlay().setHighlights(places, -1);
  if (!places.empty()) image_->view()->reveal(places.front());
}

QString ScenePage::describePoint(const Cloud& cloud, std::uint32_t point) const {
  const Eigen::Vector3f& p = cloud.points_m[point];
  const auto number = [](double v, int decimals) { return QString::number(v, 'f', decimals); };
  QString text =
      tr("Point %1: x %2, y %3, z %4 m, range %5 m")
          .arg(point)
          .arg(number(p.x(), 3), number(p.y(), 3), number(p.z(), 3), number(p.norm(), 3));
  if (cloud.has_intensity()) text += tr(", intensity %1").arg(number(cloud.intensity[point], 1));
  if (cloud.has_line()) text += tr(", line %1").arg(cloud.line[point]);
  if (cloud.has_time()) text += tr(", time %1 ms").arg(number(1e3 * cloud.time_s[point], 2));
  const SceneResult* scene = current();
  if (scene != nullptr && scene->refinement) {
    const auto off = scene->refinement->plane.range_residual_m(p.cast<double>());
    if (off && std::abs(*off) < 0.1) {
      text += tr(", %1 mm beyond the board's plane").arg(number(1e3 * *off, 1));
    }
  }
  const auto& pixels = cloud_->view()->scene()->pixels;
  if (point < pixels.size()) {
    text +=
        std::isfinite(pixels[point].x())
            ? tr(", pixel (%1, %2)").arg(number(pixels[point].x(), 1), number(pixels[point].y(), 1))
            : tr(", not in the image");
  }
  return text;
}

// ", left out: …" of a point that is not used; empty of others.
QString ScenePage::refusalOfPoint(const Eigen::Vector3f& point_m) const {
  const SceneResult* scene = current();
  const auto& shown = cloud_->view()->scene();
  if (scene == nullptr || !scene->refinement || !shown) return {};
  const auto among = [&](const std::vector<Eigen::Vector3f>& points) {
    return std::find(points.begin(), points.end(), point_m) != points.end();
  };
  if (among(shown->unused.left_out_m)) return tr(", left out by hand");
  if (!among(shown->unused.refused_m)) return {};
  Cloud one;
  one.points_m = {point_m};
  for (const BoardPart& part : board_parts(*result_, *scene)) {
    SceneEdits patch;
    patch.patches_m = {part.edge_m};
    if (part.use == BoardPart::Use::kRefused &&
        !left_out_points(one, patch, result_->target, scene->refinement->lidar_from_board).empty())
      return tr(", left out: %1").arg(core_text(part.reason));
  }
  for (const Refusal& refusal : refusals(*result_)) {
    if (refusal.scene == scene->name && refusal.what == Refusal::What::kPoints)
      return tr(", left out: %1").arg(core_text(refusal.reason));
  }
  return {};
}

// A part of the board that something seems to cover or that is left out, with all its points.
void ScenePage::selectPart(const BoardPart& part) {
  const SceneResult& scene = *current();
  const bool by_hand = part.use == BoardPart::Use::kByHand;
  SceneEdits patch;
  patch.patches_m = {part.edge_m};
  const Cloud& cloud = by_hand ? scene.left_out_points : scene.board_points;
  SceneSelection selection;
  for (const std::uint32_t i :
       left_out_points(cloud, patch, result_->target, scene.refinement->lidar_from_board))
    selection.points_m.push_back(cloud.points_m[i]);
  const auto count = static_cast<int>(selection.points_m.size());
  select(std::move(selection), false);
  switch (part.use) {
    case BoardPart::Use::kKept:
      return selection_->setText(tr("Part of the board, used all the same"));
    case BoardPart::Use::kByHand:
      return selection_->setText(
          tr("Part of the board, %n points left out by hand", nullptr, count));
    case BoardPart::Use::kRefused:
      return selection_->setText(
          tr("Part of the board, %n points left out: %1", nullptr, static_cast<int>(part.points))
              .arg(core_text(part.reason)));
  }
}

void ScenePage::selectPixel(const QPointF& pixel) {
  const ImageOverlay& overlay = image_->view()->overlay().overlay();
  const bool shown = image_->view()->overlay().parts().unused;
  for (std::size_t k = 0; shown && k < overlay.parts.size(); ++k) {
    if (!overlay.parts[k].edge.containsPoint(pixel, Qt::OddEvenFill)) continue;
    selectPart(board_parts(*result_, *current())[k]);
    return;
  }
  const auto& scene = cloud_->view()->scene();
  std::vector<QPointF> places{pixel};
  QString text = tr("Pixel (%1, %2)").arg(pixel.x(), 0, 'f', 1).arg(pixel.y(), 0, 'f', 1);
  std::vector<std::uint32_t> near;
  if (scene && !scene->pixels.empty()) {
    near = nearest_pixels(scene->pixels, {pixel.x(), pixel.y()}, kNeighbours, kNeighbourhood_px);
    for (const std::uint32_t i : near) {
      places.emplace_back(static_cast<double>(scene->pixels[i].x()),
                          static_cast<double>(scene->pixels[i].y()));
    }
    text += near.empty() ? tr(": no LiDAR point within %1 px").arg(kNeighbourhood_px)
                         : tr(". Nearest: %1").arg(describePoint(*scene->cloud, near.front()));
  } else {
    text += tr(": LiDAR points are linked once there is an extrinsic");
  }
  cloud_->view()->setHighlights(near);
  image_->view()->overlay().setHighlights(std::move(places), -1);
  selection_->setText(text);
  selection_->setSelection({}, nullptr, nullptr);
}

void ScenePage::selectTag(int id) {
  const auto& scene = cloud_->view()->scene();
  const ImageOverlay& overlay = image_->view()->overlay().overlay();
  QPolygonF edge;
  for (const ImageOverlay::Tag& tag : overlay.tags) {
    if (tag.id == id) edge = tag.corners;
  }
  QStringList residuals;
  for (const ImageOverlay::Corner& c : overlay.corners) {
    if (c.feature_id != id || !c.has_prediction) continue;
    const QPointF r = c.detected - c.predicted;
    residuals.push_back(QStringLiteral("(%1, %2)").arg(r.x(), 0, 'f', 3).arg(r.y(), 0, 'f', 3));
  }
  std::vector<std::uint32_t> inside;
  if (scene && !scene->pixels.empty() && !edge.isEmpty()) {
    const QRectF box = edge.boundingRect();
    const Eigen::Vector2d middle(box.center().x(), box.center().y());
    const double reach = 0.5 * std::hypot(box.width(), box.height());
    for (const std::uint32_t i :
         nearest_pixels(scene->pixels, middle, scene->pixels.size(), reach)) {
      const QPointF p(static_cast<double>(scene->pixels[i].x()),
                      static_cast<double>(scene->pixels[i].y()));
      if (inside.size() < kTagPoints && edge.containsPoint(p, Qt::OddEvenFill)) inside.push_back(i);
    }
  }
  cloud_->view()->setHighlights(inside);
  image_->view()->overlay().setHighlights({}, id);
  QString text = tr("Tag %1").arg(id) + refusalOf(Refusal::What::kTag, id);
  if (!residuals.isEmpty()) text += tr(": corner residuals %1 px").arg(residuals.join(", "));
  if (!inside.empty()) text += tr("; LiDAR points on it: %1").arg(inside.size());
  selection_->setText(text);
  selection_->setSelection({{}, {id}, {}}, result_.get(), current());
}

void ScenePage::selectCircle(int id) {
  const SceneResult* scene = current();
  if (scene == nullptr || !scene->refinement) return;
  QString text = tr("Circle %1").arg(id) + refusalOf(Refusal::What::kCircle, id);
  for (const RefinedNode& node : scene->refinement->nodes) {
    if (node.id == id && node.valid)
      text += tr(", its centre known to %1 mm").arg(1e3 * node.sigma_m(), 0, 'f', 2);
  }
  QPointF center;
  for (const ImageOverlay::Circle& circle : image_->view()->overlay().overlay().circles) {
    if (circle.id == id) center = circle.center;
  }
  image_->view()->overlay().setHighlights({center}, -1);
  selection_->setText(text);
  selection_->setSelection({{}, {}, {id}}, result_.get(), scene);
}

std::vector<Eigen::Vector3f> ScenePage::aboutBoard(const std::vector<std::uint32_t>& points) const {
  const SceneResult* scene = current();
  const auto& shown = cloud_->view()->scene();
  if (scene == nullptr || !shown || !shown->cloud) return {};
  return points_about_board(*scene, *shown->cloud, points);
}

void ScenePage::brushPoints(const std::vector<std::uint32_t>& points, bool add) {
  SceneSelection selection{aboutBoard(points), {}, {}};
  const bool beside = selection.empty() && !points.empty();
  select(std::move(selection), add);
  if (beside && selection_->selection().empty())
    selection_->setText(tr("None of these points is about the board: they play no part anyway."));
}

// What is shown is selected: tags and circles that lie within the line, and points.
void ScenePage::brushImage(const QPolygonF& line, bool add) {
  const ImageOverlay& overlay = image_->view()->overlay().overlay();
  const OverlayParts& parts = image_->view()->overlay().parts();
  const auto inside = [&](const QPointF& p) { return line.containsPoint(p, Qt::OddEvenFill); };
  SceneSelection selection;
  for (const ImageOverlay::Tag& tag : overlay.tags) {
    if (parts.tags && std::all_of(tag.corners.begin(), tag.corners.end(), inside))
      selection.tags.push_back(tag.id);
  }
  for (const ImageOverlay::Circle& circle : overlay.circles) {
    if (parts.circles && std::all_of(circle.edge.begin(), circle.edge.end(), inside))
      selection.circles.push_back(circle.id);
  }
  const auto& scene = cloud_->view()->scene();
  if (parts.points && scene) {
    std::vector<std::uint32_t> points;
    const LassoMask mask(line);
    for (std::size_t i = 0; i < scene->pixels.size(); ++i) {
      if (mask.contains(static_cast<double>(scene->pixels[i].x()),
                        static_cast<double>(scene->pixels[i].y())))
        points.push_back(static_cast<std::uint32_t>(i));
    }
    selection.points_m = aboutBoard(points);
  }
  select(std::move(selection), add);
}

void ScenePage::select(SceneSelection selection, bool add) {
  if (add) {
    const SceneSelection before = selection_->selection();
    const auto join = [](auto& to, const auto& more) {
      for (const auto& item : more) {
        if (std::find(to.begin(), to.end(), item) == to.end()) to.push_back(item);
      }
    };
    join(selection.tags, before.tags);
    join(selection.circles, before.circles);
    selection.points_m.insert(selection.points_m.end(), before.points_m.begin(),
                              before.points_m.end());
  }
  picked_.reset();
  sample_points_m_.clear();
  sample_pixels_.clear();
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& p : selection.points_m) points.push_back(p.cast<double>());
  std::vector<std::uint32_t> found;
  const auto& shown = cloud_->view()->scene();
  if (shown && shown->cloud && !points.empty()) found = same_directions(*shown->cloud, points);
  cloud_->view()->setHighlights(found);
  std::vector<QPointF> places;
  const std::size_t stride = 1 + found.size() / kMostRings;
  for (std::size_t k = 0; k < found.size(); k += stride) {
    if (found[k] >= shown->pixels.size() || !std::isfinite(shown->pixels[found[k]].x())) continue;
    places.emplace_back(static_cast<double>(shown->pixels[found[k]].x()),
                        static_cast<double>(shown->pixels[found[k]].y()));
  }
  const ImageOverlay& overlay = image_->view()->overlay().overlay();
  for (const ImageOverlay::Tag& tag : overlay.tags) {
    if (contains_id(selection.tags, tag.id)) places.push_back(tag.corners.boundingRect().center());
  }
  for (const ImageOverlay::Circle& circle : overlay.circles) {
    if (contains_id(selection.circles, circle.id)) places.push_back(circle.center);
  }
  image_->view()->overlay().setHighlights(std::move(places), -1);
  QStringList parts;
  if (!selection.points_m.empty())
    parts << tr("%n points about the board", nullptr, static_cast<int>(selection.points_m.size()));
  if (!selection.tags.empty()) parts << tr("tag no. %1").arg(ids_text(selection.tags));
  if (!selection.circles.empty()) parts << tr("circle no. %1").arg(ids_text(selection.circles));
  selection_->setText(parts.isEmpty() ? tr("Nothing is selected.")
                                      : tr("Selected: %1").arg(parts.join(tr(", "))));
  selection_->setSelection(std::move(selection), result_.get(), current());
}

// ", left out: …" of a feature of the current scene; empty if it is used.
QString ScenePage::refusalOf(Refusal::What what, int id) const {
  const SceneResult* scene = current();
  if (scene == nullptr) return {};
  for (const Refusal& refusal : refusals(*result_)) {
    if (refusal.scene == scene->name && refusal.what == what && refusal.id == id)
      return tr(", left out: %1").arg(core_text(refusal.reason));
  }
  const auto& left_out = what == Refusal::What::kTag ? scene->edits.tags : scene->edits.circles;
  const auto& kept =
      what == Refusal::What::kTag ? scene->edits.kept_tags : scene->edits.kept_circles;
  if (contains_id(left_out, id)) return tr(", left out by hand");
  if (contains_id(kept, id)) return tr(", used all the same");
  return {};
}

void ScenePage::selectSamples(const std::vector<Eigen::Vector3d>& points_in_lidar_m,
                              const std::vector<Eigen::Vector2d>& pixels) {
  sample_points_m_ = points_in_lidar_m;
  sample_pixels_ = pixels;
  showSamples();
}

// Again when the cloud's picture is ready: its points are known only then.
void ScenePage::showSamples() {
  const std::size_t count = sample_points_m_.size() + sample_pixels_.size();
  if (count == 0) return;
  std::vector<QPointF> places;
  for (const Eigen::Vector2d& pixel : sample_pixels_) {
    if (places.size() < kMostRings) places.emplace_back(pixel.x(), pixel.y());
  }
  std::vector<std::uint32_t> found;
  const auto& scene = cloud_->view()->scene();
  if (scene && scene->cloud && !sample_points_m_.empty()) {
    found = same_directions(*scene->cloud, sample_points_m_);
    const std::size_t stride = 1 + found.size() / kMostRings;
    for (std::size_t k = 0; k < found.size(); k += stride) {
      if (found[k] >= scene->pixels.size() || !std::isfinite(scene->pixels[found[k]].x())) continue;
      places.emplace_back(static_cast<double>(scene->pixels[found[k]].x()),
                          static_cast<double>(scene->pixels[found[k]].y()));
    }
  }
  cloud_->view()->setHighlights(found);
  image_->view()->overlay().setHighlights(std::move(places), -1);
  selection_->setText(
      tr("%n measurements selected on the Model page", nullptr, static_cast<int>(count)));
  selection_->setSelection({aboutBoard(found), {}, {}}, result_.get(), current());
}

void ScenePage::clearSelection() {
  picked_.reset();
  sample_points_m_.clear();
  sample_pixels_.clear();
  cloud_->view()->setHighlights({});
  image_->view()->overlay().setHighlights({}, -1);
  selection_->setText(tr("Click a point, a pixel or a tag to see its values in both views."));
  selection_->setSelection({}, nullptr, nullptr);
}

}  // namespace lvcalib::widgets

#include "moc_scene_page.cpp"
