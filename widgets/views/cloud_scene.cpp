// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_scene.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "base/statistics.h"
#include "camera/cloud_projection.h"
#include "refinement/node_samples.h"

namespace lvcalib::widgets {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct CloudSceneText {
  Q_DECLARE_TR_FUNCTIONS(CloudSceneText)
};

// Steps through the points by the golden section of their number: every beginning of the order
// covers the whole scan evenly, whatever pattern the scanner has.
void thinning_order(std::vector<std::uint32_t>& indices) {
  const std::size_t n = indices.size();
  if (n < 3) return;
  auto step = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(n));
  while (std::gcd(step, n) != 1) ++step;
  std::vector<std::uint32_t> out(n);
  std::size_t place = 0;
  for (std::size_t i = 0; i < n; ++i) {
    out[i] = indices[place];
    place += step;
    if (place >= n) place -= n;
  }
  indices = std::move(out);
}

class Builder {
 public:
  Builder(const CloudSceneInput& input, std::stop_token stop)
      : in_(input), stop_(std::move(stop)), scene_(std::make_shared<CloudScene>()) {}

  std::shared_ptr<const CloudScene> run() {
    chooseCloud();
    if (in_.refinement) scene_->place_board(in_.refinement->lidar_from_board, in_.target.outline());
    if (in_.unused) scene_->unused = in_.unused();
    if (stop_.stop_requested()) return nullptr;
    if (!scene_->cloud) return scene_;
    choosePoints();
    thinning_order(scene_->order);
    if (stop_.stop_requested()) return nullptr;
    project();
    if (stop_.stop_requested()) return nullptr;
    copyPoints();
    paint();
    if (stop_.stop_requested()) return nullptr;
    return scene_;
  }

 private:
  // How often values occur, beside the colours that they get.
  void count(const std::vector<float>& values) {
    constexpr int kBins = 48;
    scene_->histogram.assign(kBins, 0);
    const double width = scene_->whole.high - scene_->whole.low;
    for (const float value : values) {
      if (!std::isfinite(value) || !(width > 0.0)) continue;
      const double share = (static_cast<double>(value) - scene_->whole.low) / width;
      const int bin = std::clamp(static_cast<int>(share * kBins), 0, kBins - 1);
      ++scene_->histogram[static_cast<std::size_t>(bin)];
    }
  }

  void chooseCloud() {
    const bool board_only =
        in_.filter == CloudFilter::kBoard || in_.filter == CloudFilter::kBoundary;
    scene_->cloud = board_only ? in_.board : in_.full;
    if (!scene_->cloud && !board_only && in_.board) {
      scene_->cloud = in_.board;
      scene_->notice = CloudSceneText::tr("Only the board's points are loaded.");
    }
    if (!scene_->cloud) {
      scene_->notice =
          !in_.problem.isEmpty() ? CloudSceneText::tr("There is no cloud: %1").arg(in_.problem)
          : board_only ? CloudSceneText::tr("No board was found in this scene's cloud yet.")
                       : CloudSceneText::tr("The cloud is not loaded yet.");
    }
  }

  void choosePoints() {
    const Cloud& cloud = *scene_->cloud;
    std::vector<std::uint32_t>& order = scene_->order;
    if (in_.filter == CloudFilter::kBoundary) {
      if (in_.refinement) order = boundary_points(cloud, in_.target, *in_.refinement);
      if (order.empty())
        scene_->notice = CloudSceneText::tr("There are no boundary samples in this scene.");
      return;
    }
    const bool crop = in_.filter == CloudFilter::kCrop && in_.crop;
    if (in_.filter == CloudFilter::kCrop && !in_.crop) {
      scene_->notice = CloudSceneText::tr("No crop box is set: all points are shown.");
    }
    order.reserve(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (!crop || in_.crop->contains(cloud.points_m[i].cast<double>())) {
        order.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }

  void project() {
    if (!in_.camera_from_lidar || in_.camera.width_px <= 0) return;
    RunContext context;
    context.stop = stop_;
    scene_->pixels =
        project_points(scene_->cloud->points_m, in_.camera, *in_.camera_from_lidar, context);
  }

  // Of the ranges of the first points: the upper quartile and one and a half times the distance
  // between the quartiles.
  [[nodiscard]] float upper_whisker_m(std::size_t points) const {
    std::vector<double> ranges;
    for (std::size_t k = 0; k < points; ++k)
      ranges.push_back(static_cast<double>(scene_->cloud->points_m[scene_->order[k]].norm()));
    const double lower = quantile(ranges, 0.25);
    const double upper = quantile(std::move(ranges), 0.75);
    // Rounded up: a wall at one range is within.
    return static_cast<float>(upper + 1.5 * (upper - lower)) * (1.0F + 1e-6F);
  }

  void copyPoints() {
    const Cloud& cloud = *scene_->cloud;
    scene_->xyz_m.reserve(3 * scene_->order.size());
    if (scene_->order.empty()) return;
    // The beginning of the order stands for all.
    const std::size_t n = std::min<std::size_t>(scene_->order.size(), 5000);
    const float whisker_m = upper_whisker_m(n);
    Eigen::AlignedBox3f all;
    Eigen::AlignedBox3f most;
    for (const std::uint32_t i : scene_->order) {
      const Eigen::Vector3f& p = cloud.points_m[i];
      scene_->xyz_m.insert(scene_->xyz_m.end(), {p.x(), p.y(), p.z()});
      all.extend(p);
      if (p.norm() <= whisker_m) most.extend(p);
    }
    for (const Eigen::Vector3d& p : in_.landmarks_m) {
      all.extend(p.cast<float>());
      most.extend(p.cast<float>());
    }
    scene_->low_m = all.min().cast<double>();
    scene_->high_m = all.max().cast<double>();
    scene_->most_low_m = most.min().cast<double>();
    scene_->most_high_m = most.max().cast<double>();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (std::size_t k = 0; k < n; ++k) {
        values.push_back(
            static_cast<double>(scene_->xyz_m[3 * k + static_cast<std::size_t>(axis)]));
      }
      scene_->center_m(axis) = median(std::move(values));
    }
  }

  void paint() {
    if (in_.color == CloudColor::kCameraColor && paintFromImage()) return;
    if (in_.color == CloudColor::kScene && paintByScene()) return;
    const std::vector<float> values = quantities();
    scene_->whole = scale_for(
        values, in_.color == CloudColor::kResidual ? ColorMap::kDiverging : ColorMap::kSequential);
    count(values);
    scene_->scale = scene_->whole;
    if (in_.range) {
      scene_->scale.low = in_.range->first;
      scene_->scale.high = in_.range->second;
    }
    scene_->rgb.reserve(3 * values.size());
    for (const float value : values) push(scene_->scale.color(static_cast<double>(value)));
  }

  void push(QRgb color) {
    scene_->rgb.push_back(static_cast<std::uint8_t>(qRed(color)));
    scene_->rgb.push_back(static_cast<std::uint8_t>(qGreen(color)));
    scene_->rgb.push_back(static_cast<std::uint8_t>(qBlue(color)));
  }

  bool paintFromImage() {
    if (in_.image.isNull() || scene_->pixels.empty()) {
      scene_->notice =
          CloudSceneText::tr("Camera colours need an image and an extrinsic; intensity is shown.");
      return false;
    }
    scene_->quantity = CloudSceneText::tr("camera colour (grey: not in the image)");
    scene_->has_scale = false;
    scene_->rgb.reserve(3 * scene_->order.size());
    for (const std::uint32_t i : scene_->order) push(image_color(in_.image, scene_->pixels[i]));
    return true;
  }

  // Scenes have no order that a scale could show.
  bool paintByScene() {
    const Cloud& cloud = *scene_->cloud;
    if (in_.scenes.empty() || !cloud.has_line()) return false;
    scene_->quantity = CloudSceneText::tr("scene");
    scene_->has_scale = false;
    scene_->categories = in_.scenes;
    scene_->rgb.reserve(3 * scene_->order.size());
    for (const std::uint32_t i : scene_->order) {
      const std::size_t place = cloud.line[i];
      const bool known = place >= 1 && place <= in_.scenes.size();
      push(known ? in_.scenes[place - 1].color : qRgb(128, 128, 128));
    }
    return true;
  }

  // The value of every drawn point; also names it.
  std::vector<float> quantities() {
    const Cloud& cloud = *scene_->cloud;
    std::vector<float> out;
    out.reserve(scene_->order.size());
    CloudColor color = in_.color == CloudColor::kCameraColor ? CloudColor::kIntensity : in_.color;
    if (color == CloudColor::kIntensity && !cloud.has_intensity()) {
      scene_->notice = CloudSceneText::tr("This cloud has no intensity; range is shown.");
      color = CloudColor::kRange;
    }
    if (color == CloudColor::kResidual) {
      if (in_.surface) surface_ = in_.surface();
      if (!surface_) {
        scene_->notice =
            CloudSceneText::tr("The board's plane is not known in this scene; range is shown.");
        color = CloudColor::kRange;
      }
    }
    if ((color == CloudColor::kLine || color == CloudColor::kScene) && !cloud.has_line()) {
      scene_->notice = CloudSceneText::tr("This cloud has no line numbers; range is shown.");
      color = CloudColor::kRange;
    }
    if (color == CloudColor::kTime && !cloud.has_time()) {
      scene_->notice = CloudSceneText::tr("This cloud has no times; range is shown.");
      color = CloudColor::kRange;
    }
    for (const std::uint32_t i : scene_->order) out.push_back(quantity(cloud, i, color));
    switch (color) {
      case CloudColor::kHeight:
        scene_->quantity = CloudSceneText::tr("height z (m)");
        break;
      case CloudColor::kRange:
        scene_->quantity = CloudSceneText::tr("range (m)");
        break;
      case CloudColor::kResidual:
        scene_->quantity = residualName();
        break;
      case CloudColor::kLine:
        scene_->quantity = CloudSceneText::tr("scan line");
        break;
      case CloudColor::kScene:
        scene_->quantity = CloudSceneText::tr("scene, counted as in the dataset");
        break;
      case CloudColor::kTime:
        scene_->quantity = CloudSceneText::tr("time (ms)");
        break;
      default:
        scene_->quantity = CloudSceneText::tr("intensity");
    }
    return out;
  }

  [[nodiscard]] QString residualName() const {
    const double cell_mm = 1e3 * surface_->residuals.cell_m();
    switch (surface_->against) {
      case BoardSurface::Against::kModel:
        return CloudSceneText::tr("range beyond the model with its effects, mean over %1 mm (mm)")
            .arg(cell_mm, 0, 'f', 0);
      case BoardSurface::Against::kBase:
        return CloudSceneText::tr("range beyond the base model, mean over %1 mm (mm)")
            .arg(cell_mm, 0, 'f', 0);
      case BoardSurface::Against::kPlane:
        break;
    }
    return CloudSceneText::tr("range beyond the board's plane, mean over %1 mm (mm)")
        .arg(cell_mm, 0, 'f', 0);
  }

  [[nodiscard]] float quantity(const Cloud& cloud, std::uint32_t i, CloudColor color) const {
    const Eigen::Vector3f& p = cloud.points_m[i];
    switch (color) {
      case CloudColor::kHeight:
        return p.z();
      case CloudColor::kRange:
        return p.norm();
      case CloudColor::kResidual: {
        const auto mean = surface_->mean_m(p.cast<double>());
        return mean ? static_cast<float>(1e3 * *mean) : kNan;
      }
      case CloudColor::kLine:
      case CloudColor::kScene:
        return static_cast<float>(cloud.line[i]);
      case CloudColor::kTime:
        return static_cast<float>(1e3 * static_cast<double>(cloud.time_s[i]));
      default:
        return cloud.intensity[i];
    }
  }

  const CloudSceneInput& in_;
  std::stop_token stop_;
  std::shared_ptr<CloudScene> scene_;
  std::optional<BoardSurface> surface_;
};

}  // namespace

QRgb image_color(const QImage& image, const Eigen::Vector2f& pixel) {
  if (!std::isfinite(pixel.x()) || !std::isfinite(pixel.y())) return qRgb(110, 110, 110);
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  return image.valid(x, y) ? image.pixel(x, y) : qRgb(110, 110, 110);
}

void CloudScene::place_board(const Rigid3& lidar_from_board, const BoardOutline& outline) {
  const Eigen::Vector2d middle = outline.center_m();
  board_center_m = lidar_from_board * Eigen::Vector3d(middle.x(), middle.y(), 0.0);
  board_radius_m = 0.5 * outline.size_m().norm();
  board_normal = lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
}

std::shared_ptr<const CloudScene> build_cloud_scene(const CloudSceneInput& input,
                                                    std::stop_token stop) {
  return Builder(input, std::move(stop)).run();
}

}  // namespace lvcalib::widgets
