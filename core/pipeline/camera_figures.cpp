// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/camera_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "detection/board_pose.h"

namespace lvcalib {
namespace {

// The figures while images are added one by one.
class Collector {
 public:
  void begin(CameraFigures::Image image) {
    squares_ = 0.0;
    out_.images.push_back(std::move(image));
  }

  void add(const Eigen::Vector2d& pixel, const Eigen::Vector2d& residual_px) {
    pixels_.push_back(pixel);
    CameraFigures::Image& image = out_.images.back();
    squares_ += residual_px.squaredNorm();
    image.rms_px = std::sqrt(squares_ / static_cast<double>(++image.corners));
    for (int axis = 0; axis < 2; ++axis) {
      out_.corners.value.push_back(static_cast<float>(residual_px(axis)));
      out_.corners.scene.push_back(static_cast<int>(out_.images.size()) - 1);
      out_.corners.component.push_back(axis);
      x_.values.push_back(static_cast<float>(pixel.x()));
      y_.values.push_back(static_cast<float>(pixel.y()));
    }
  }

  // `sigma_px`: stated noise of a coordinate.
  CameraFigures finish(const Camera& camera, double sigma_px) && {
    ResidualColumns& corners = out_.corners;
    corners.channel = Channel::kCorner;
    corners.sigma.assign(corners.size(), static_cast<float>(sigma_px));
    corners.before = corners.value;
    corners.covariates = {std::move(x_), std::move(y_)};
    out_.unreached = unreached_parts(pixels_, camera);
    return std::move(out_);
  }

 private:
  CameraFigures out_;
  Covariate x_{"image x", "px", false, {}};
  Covariate y_{"image y", "px", false, {}};
  std::vector<Eigen::Vector2d> pixels_;
  double squares_ = 0.0;
};

// Images of scenes are all called alike: the folder tells them apart.
std::string name_of(const BoardImage& image) {
  return (image.path.parent_path().filename() / image.path.filename()).string();
}

void add_corners(const std::vector<CornerObservation>& corners, const Camera& camera,
                 const Rigid3& camera_from_board, Collector& out) {
  for (const CornerObservation& corner : corners) {
    const Eigen::Vector3d on_board(corner.board_m.x(), corner.board_m.y(), 0.0);
    const auto predicted = camera.project(camera_from_board * on_board);
    if (predicted) out.add(corner.pixel, corner.pixel - *predicted);
  }
}

// Residuals name their corners; where these were seen, the view knows.
void add_residuals(const BoardView& view, const SceneSolution& solution, Collector& out) {
  std::map<std::pair<int, int>, Eigen::Vector2d> pixels;
  for (const CornerObservation& c : view.corners) pixels[{c.feature_id, c.corner}] = c.pixel;
  for (const CornerResidual& residual : solution.corners) {
    const auto at = pixels.find({residual.feature_id, residual.corner});
    if (residual.used && at != pixels.end()) out.add(at->second, residual.residual_px);
  }
}

}  // namespace

std::vector<Message> unreached_parts(const std::vector<Eigen::Vector2d>& pixels,
                                     const Camera& camera) {
  const std::array names = {Message("top left"),    Message("top"),    Message("top right"),
                            Message("left"),        Message("middle"), Message("right"),
                            Message("bottom left"), Message("bottom"), Message("bottom right")};
  std::array<bool, 9> seen{};
  const auto third = [](double at, int size) {
    return static_cast<std::size_t>(std::clamp(3.0 * (at + 0.5) / size, 0.0, 2.0));
  };
  for (const Eigen::Vector2d& pixel : pixels)
    seen[3 * third(pixel.y(), camera.height_px) + third(pixel.x(), camera.width_px)] = true;
  std::vector<Message> out;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (!seen[k]) out.push_back(names[k]);
  }
  return out;
}

Message describe_unreached(const std::vector<Message>& parts) {
  if (parts.empty()) return {};
  return Message(
      "no board reached these parts of the image: %1; the distortion there is extrapolated",
      joined(parts, ", "));
}

CameraFigures camera_figures(const CameraCalibration& calibration) {
  Collector collected;
  for (const BoardImage& image : calibration.images) {
    collected.begin({name_of(image), image.path, 0, 0.0, image.reason});
    if (image.used())
      add_corners(image.view->corners, calibration.camera, image.view->camera_from_board.transform,
                  collected);
  }
  CameraFigures out = std::move(collected).finish(calibration.camera, calibration.noise_px);
  out.projection = project_intrinsics(calibration.camera, calibration.covariance);
  return out;
}

CameraFigures camera_figures(const CalibrationResult& result) {
  Collector collected;
  for (const SceneResult& scene : result.scenes) {
    collected.begin({scene.name, {}, 0, 0.0, scene.reason});
    const SceneSolution* solution = solution_of(result, scene.name);
    if (solution != nullptr && solution->used && scene.view)
      add_residuals(*scene.view, *solution, collected);
  }
  const IntrinsicsReport& report = result.intrinsics;
  for (const BoardImage& image : report.extra_images) {
    collected.begin({name_of(image), image.path, 0, 0.0, image.reason});
    if (!image.used()) continue;
    // The joint solve has moved the camera since the board's pose was fitted.
    const std::vector<CornerObservation>& corners = image.view->corners;
    const auto pose = estimate_board_pose(corners, result.camera, result.options.detection);
    add_corners(corners, result.camera,
                (pose ? pose->camera_from_board : image.view->camera_from_board).transform,
                collected);
  }
  CameraFigures out = std::move(collected).finish(result.camera, result.extrinsic.sigma_px);
  if (report.mode != IntrinsicsMode::kFixed && result.forward &&
      result.forward->globals_covariance.rows() >= kGlobals) {
    out.projection = project_intrinsics(
        result.camera, result.forward->globals_covariance.block<kIntrinsics, kIntrinsics>(
                           kFirstIntrinsic, kFirstIntrinsic));
  } else if (report.mode == IntrinsicsMode::kFixed && report.stated) {
    out.projection = project_intrinsics(
        result.camera, report.prior_sigma.cwiseAbs2().asDiagonal().toDenseMatrix());
  }
  return out;
}

}  // namespace lvcalib
