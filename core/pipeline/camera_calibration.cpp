// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/camera_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/statistics.h"
#include "base/text.h"
#include "pipeline/camera_figures.h"
#include "pipeline/distortion_models.h"

namespace lvcalib {
namespace {

// Focal lengths to start from, in widths of the image: from fisheyes (140° across and more) to
// telephoto lenses. The bundle adjustment bridges the steps.
constexpr std::array kFocalLadder = {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0};
// Of three the median is one of them, and a stray may be it.
constexpr std::size_t kFewestToJudgeStrays = 4;
// Foreshortening, by which the focal length is told from the distance, grows with the sine of the
// turn: at 15° it is a quarter of what 90° would give, and its standard deviation four times that.
constexpr double kAlike_deg = 15.0;
// As many as there are folds of held-out images by default.
constexpr std::size_t kFewImages = 5;
// At twice the noise of replicates three quarters of the variance are misfit; below a tenth of a
// pixel it moves no projection by what a LiDAR would notice.
constexpr double kMisfitFactor = 2.0;
constexpr double kMisfit_px = 0.1;

using Indices = std::vector<std::size_t>;

Camera guessed_camera(int width_px, int height_px, double widths, DistortionModel model) {
  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.fx = camera.fy = widths * width_px;
  camera.cx = 0.5 * (width_px - 1);
  camera.cy = 0.5 * (height_px - 1);
  camera.model = model;
  return camera;
}

std::vector<CornerView> views_of(const std::vector<BoardImage>& images, const Indices& use) {
  std::vector<CornerView> out;
  for (const std::size_t i : use)
    out.push_back({&images[i].view->corners, images[i].view->camera_from_board.transform});
  return out;
}

// Where a bundle adjustment of one model may start, the most promising first.
std::vector<Camera> starts_for(const std::vector<BoardImage>& images, const Indices& use,
                               DistortionModel model, const CameraCalibrationOptions& options) {
  if (options.start && options.start->model == model) return {*options.start};
  const BoardImage& first = images[use.front()];
  std::vector<std::pair<double, Camera>> ladder;
  for (const double widths : kFocalLadder) {
    const Camera camera = guessed_camera(first.width_px, first.height_px, widths, model);
    double misfit = 0.0;
    posed_views(views_of(images, use), camera, options.detection, misfit);
    ladder.emplace_back(misfit, camera);
  }
  std::stable_sort(ladder.begin(), ladder.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Camera> out;
  for (const auto& [misfit, camera] : ladder) out.push_back(camera);
  return out;
}

std::optional<IntrinsicsFit> fit_model(const std::vector<BoardImage>& images, const Indices& use,
                                       DistortionModel model,
                                       const CameraCalibrationOptions& options) {
  // A few: the best by its poses alone need not be where the adjustment ends best.
  constexpr std::size_t kTried = 3;
  std::optional<IntrinsicsFit> best;
  const std::vector<CornerView> views = views_of(images, use);
  const std::vector<Camera> starts = starts_for(images, use, model, options);
  for (std::size_t k = 0; k < starts.size() && (k < kTried || !best); ++k) {
    auto fit = fit_from(views, starts[k], options.detection);
    if (fit && (!best || fit->sigma_px < 0.99 * best->sigma_px)) best = std::move(fit);
  }
  return best;
}

// The best fit over the models in question, and what held-out images say of them.
std::optional<IntrinsicsFit> choose_model(const std::vector<BoardImage>& images, const Indices& use,
                                          const CameraCalibrationOptions& options,
                                          const RunContext& context, CameraCalibration& out) {
  out.predictions.clear();
  if (options.model) return fit_model(images, use, *options.model, options);
  const bool compare = use.size() >= static_cast<std::size_t>(options.fewest_to_compare);
  std::optional<IntrinsicsFit> best;
  std::vector<double> best_squares;
  for (const DistortionModel model : kDistortionModels) {
    if (context.stopped()) return std::nullopt;
    // With too few images to compare the simplest that can be fitted stands.
    if (!compare && best) break;
    auto fit = fit_model(images, use, model, options);
    if (!fit) continue;
    if (!compare) {
      best = std::move(fit);
      continue;
    }
    const auto squares = held_out_squares(views_of(images, use), fit->camera, options.detection,
                                          options.folds, context);
    out.predictions.push_back({model, rms_of(squares)});
    const auto better = [&] {
      if (squares.empty() || best_squares.empty()) return best_squares.empty() && !squares.empty();
      // A distortion that folds back inside the image is wrong there, whatever it predicts
      // elsewhere.
      const bool folds = blind_corners(fit->camera) > 0;
      const bool best_folds = blind_corners(best->camera) > 0;
      if (folds && !best_folds) return false;
      return predicts_better(best_squares, squares) ||
             (best_folds && !folds && !predicts_better(squares, best_squares));
    };
    if (best && !better()) continue;
    best = std::move(fit);
    best_squares = squares;
  }
  return best;
}

// Puts poses and residuals of a fit into the images' views; RMS of a coordinate per image in use.
std::vector<double> take_fit(const IntrinsicsFit& fit, const Indices& use, CameraCalibration& out) {
  std::vector<double> rms;
  double squares = 0.0;
  double corners = 0.0;
  for (std::size_t k = 0; k < use.size(); ++k) {
    BoardView& view = *out.images[use[k]].view;
    view.camera_from_board.transform = fit.camera_from_board[k];
    view.rms_px = corner_rms_px(view.corners, fit.camera, fit.camera_from_board[k]);
    const auto n = static_cast<double>(view.corners.size());
    squares += 2.0 * n * view.rms_px * view.rms_px;
    corners += n;
    rms.push_back(view.rms_px);
  }
  out.camera = fit.camera;
  out.covariance = fit.covariance;
  out.sigma = fit.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  out.noise_px = fit.sigma_px;
  out.replicate_px = fit.replicate_px;
  out.rms_px = std::sqrt(squares / std::max(1.0, corners));
  return rms;
}

Indices in_use(const std::vector<BoardImage>& images) {
  Indices out;
  for (std::size_t k = 0; k < images.size(); ++k) {
    if (images[k].used()) out.push_back(k);
  }
  return out;
}

// An image that is there twice says no more than once.
void leave_out_repeats(std::vector<BoardImage>& images) {
  for (std::size_t b = 1; b < images.size(); ++b) {
    for (std::size_t a = 0; a < b && images[b].used(); ++a) {
      if (images[a].used() && same_corners(*images[a].view, *images[b].view))
        images[b].reason =
            Message("the same image as %1, which counts once", images[a].path.filename().string());
    }
  }
}

// Images whose corners miss the camera of all by far more than the others'.
bool leave_out_strays(const std::vector<double>& rms_px, const Indices& use,
                      std::vector<BoardImage>& images) {
  if (use.size() < kFewestToJudgeStrays) return false;
  const double usual = median(rms_px);
  bool any = false;
  for (std::size_t k = 0; k < use.size(); ++k) {
    images[use[k]].reason = stray_reason(rms_px[k], usual);
    any = any || !images[use[k]].reason.empty();
  }
  return any;
}

// The widest angle between the normals of two boards.
double widest_turn_deg(const std::vector<BoardImage>& images, const Indices& use) {
  double least = 1.0;
  const auto normal = [&](std::size_t i) -> Eigen::Vector3d {
    return images[i].view->camera_from_board.transform.rotation * Eigen::Vector3d::UnitZ();
  };
  for (std::size_t a = 0; a < use.size(); ++a) {
    for (std::size_t b = a + 1; b < use.size(); ++b)
      least = std::min(least, normal(use[a]).dot(normal(use[b])));
  }
  return std::acos(std::clamp(least, -1.0, 1.0)) * 180.0 / M_PI;
}

void judge_views(const Indices& use, CameraCalibration& out) {
  std::vector<Message>& warnings = out.warnings;
  if (use.size() == 1) {
    warnings.push_back(
        Message("one image only: nothing checks it; take ten or more, the board turned differently "
                "in each"));
  } else {
    if (use.size() < kFewImages)
      warnings.push_back(Message(
          "only %1 images: take ten or more, the board turned differently in each", use.size()));
    if (const double turn = widest_turn_deg(out.images, use); turn < kAlike_deg) {
      warnings.push_back(
          Message("the boards are turned by no more than %1° against each other: the focal length "
                  "rests on little; turn the board by 20° to 45°, another way each time",
                  formatted("%.0f", turn)));
    }
  }
  std::vector<Eigen::Vector2d> pixels;
  for (const std::size_t i : use) {
    for (const CornerObservation& c : out.images[i].view->corners) pixels.push_back(c.pixel);
  }
  const Message unreached = describe_unreached(unreached_parts(pixels, out.camera));
  if (!unreached.empty()) warnings.push_back(unreached);
  if (out.replicate_px > 0.0 && out.noise_px > kMisfit_px &&
      out.noise_px > kMisfitFactor * out.replicate_px) {
    warnings.push_back(
        Message("corners miss the camera by %1 px where their noise is %2 px: the board is not "
                "flat, or the lens is not of this distortion model",
                formatted("%.2f", out.noise_px), formatted("%.2f", out.replicate_px)));
  }
  if (const int blind = blind_corners(out.camera); blind > 0) {
    warnings.push_back(
        Message("the distortion folds back inside the image: %1 of its 4 corners have no ray; take "
                "images with the board there",
                blind));
  }
}

Status check_focal_length(const CameraCalibration& out, double largest_share) {
  const double share = std::max(out.sigma(0) / out.camera.fx, out.sigma(1) / out.camera.fy);
  if (share <= largest_share) return Done{};
  return Error::untrusted(
      Message("the images do not determine the focal length: %1 ± %2 px, known to %3 % where %4 % "
              "is the most that counts as a result",
              formatted("%.0f", out.camera.fx), formatted("%.0f", out.sigma(0)),
              formatted("%.0f", 100.0 * share), formatted("%.0f", 100.0 * largest_share)),
      {}, Message("take images of the board turned by 20° to 45°, another way each time"));
}

Error nothing_fits() {
  return Error::untrusted(
      Message("no camera fits the corners of the images"), {},
      Message("check target.yaml, and take more images of the board, turned by 20° to 45°"));
}

Error no_board(const std::vector<BoardImage>& images) {
  for (const BoardImage& image : images) {
    if (!image.reason.empty())
      return Error::input(
          Message("the board is not found in any image; the first: %1", image.reason),
          image.path.string(), Message("check that target.yaml describes this board"));
  }
  return Error::input(Message("there is no image"));
}

// All images must come from one camera at one resolution.
Status check_sizes(const std::vector<BoardImage>& images, const std::optional<Camera>& given) {
  const BoardImage* first = nullptr;
  for (const BoardImage& image : images) {
    if (image.width_px == 0) continue;
    if (first == nullptr) first = &image;
    const int width = given ? given->width_px : first->width_px;
    const int height = given ? given->height_px : first->height_px;
    if (image.width_px == width && image.height_px == height) continue;
    return Error::input(
        given ? Message("the image has %1 × %2 pixels, the given intrinsics are for %3 × %4",
                        image.width_px, image.height_px, width, height)
              : Message("the image has %1 × %2 pixels, %3 has %4 × %5", image.width_px,
                        image.height_px, first->path.filename().string(), width, height),
        image.path.string(), Message("use images of one camera at one resolution"));
  }
  return Done{};
}

}  // namespace

std::size_t CameraCalibration::used_images() const {
  return in_use(images).size();
}

Result<CameraCalibration> calibrate_camera(std::vector<BoardImage> images,
                                           const CameraCalibrationOptions& options,
                                           const RunContext& context) {
  if (Status s = check_sizes(images, options.start); !s) return s.error();
  CameraCalibration out;
  out.images = std::move(images);
  leave_out_repeats(out.images);
  Indices use = in_use(out.images);
  if (use.empty()) return no_board(out.images);
  auto fit = choose_model(out.images, use, options, context, out);
  if (context.stopped()) return Error::cancelled();
  if (!fit) return nothing_fits();
  if (leave_out_strays(take_fit(*fit, use, out), use, out.images)) {
    use = in_use(out.images);
    fit = choose_model(out.images, use, options, context, out);
    if (context.stopped()) return Error::cancelled();
    if (!fit) return nothing_fits();
    take_fit(*fit, use, out);
  }
  if (Status s = check_focal_length(out, options.largest_focal_sigma); !s) return s.error();
  for (const BoardImage& image : out.images) {
    if (!image.reason.empty()) {
      out.warnings.push_back(Message("%1: %2; left out", image.path.string(), image.reason));
    } else {
      for (const Message& warning : image.view->warnings)
        out.warnings.push_back(Message("%1: %2", image.path.string(), warning));
    }
  }
  judge_views(use, out);
  return out;
}

Result<CameraCalibration> calibrate_camera(const std::vector<std::filesystem::path>& paths,
                                           const Target& target,
                                           const CameraCalibrationOptions& options,
                                           const RunContext& context) {
  CameraCalibrationOptions how = options;
  if (!options.start) {
    // The guess finds boards well enough for a first fit; what it misses the second look finds.
    const DistortionModel model = options.model.value_or(DistortionModel::kPlumbBob);
    const auto guess = [&](int width, int height) {
      return guessed_camera(width, height, 1.0, model);
    };
    constexpr int kUsualWidth_px = 1500;
    auto first = look_at_images(paths, target, guess, tolerant(options.detection, kUsualWidth_px),
                                context, {0.0, 0.4});
    if (!first) return first.error();
    if (Status s = check_sizes(*first, options.start); !s) return s.error();
    const auto rough = calibrate_camera(std::move(*first), options, context);
    if (!rough) return rough.error();
    how.start = rough->camera;
  }
  context.report("detect", 0.5, Message("with the camera found"));
  const Camera& camera = *how.start;
  auto images = look_at_images(paths, target, [&](int, int) { return camera; }, options.detection,
                               context, {0.5, 0.9});
  if (!images) return images.error();
  if (Status s = check_sizes(*images, options.start); !s) return s.error();
  context.report("optimize", 0.9, Message("bundle adjustment"));
  auto out = calibrate_camera(std::move(*images), how, context);
  if (out) context.report("optimize", 1.0, Message("done"));
  return out;
}

}  // namespace lvcalib
