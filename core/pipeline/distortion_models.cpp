// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/distortion_models.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "detection/board_pose.h"
#include "pipeline/board_images.h"

namespace lvcalib {
namespace {

constexpr double kGuessTolerance = 0.03;  // Of the image's width.
// With four or fewer the standard deviation of a gain over images is itself hardly known.
constexpr std::size_t kFewestToDoubt = 5;
constexpr int kFolds = 5;  // As is usual; with the fewest images each is left out alone.

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

std::vector<CornerView> fitted_views(std::vector<CornerView> views, const IntrinsicsFit& fit) {
  for (std::size_t v = 0; v < views.size(); ++v)
    views[v].camera_from_board = fit.camera_from_board[v];
  return views;
}

// Where the fit in another model starts. plumb_bob is rational_polynomial without its denominator.
Camera in_model(Camera camera, DistortionModel model) {
  const bool same_entries =
      camera.model == DistortionModel::kPlumbBob && model == DistortionModel::kRationalPolynomial;
  if (!same_entries) camera.distortion.setZero();
  camera.model = model;
  return camera;
}

// By F-test: with few corners a fit that is better by chance looks much better.
bool fits_better(const IntrinsicsFit& other, const IntrinsicsFit& given, double false_alarm) {
  const double variance = std::pow(std::max(1e-9, other.sigma_px), 2);
  const double squares = given.freedom * std::pow(given.sigma_px, 2) - other.freedom * variance;
  const int more = other.camera.distortion_count() - given.camera.distortion_count();
  return squares > variance * f_gate(std::max(1, more), other.freedom, false_alarm);
}

}  // namespace

DetectionOptions tolerant(DetectionOptions options, int width_px) {
  options.max_reprojection_px = std::max(options.max_reprojection_px, kGuessTolerance * width_px);
  return options;
}

std::vector<CornerView> posed_views(std::vector<CornerView> views, const Camera& camera,
                                    const DetectionOptions& detection, double& misfit_px) {
  double squares = 0.0;
  double count = 0.0;
  const double limit_px = 0.1 * camera.width_px;
  for (CornerView& view : views) {
    const auto fit =
        estimate_board_pose(*view.corners, camera, tolerant(detection, camera.width_px));
    if (fit) view.camera_from_board = fit->camera_from_board.transform;
    for (std::size_t c = 0; c < view.corners->size(); ++c) {
      const double e = fit ? std::min(fit->residual_px[c], limit_px) : limit_px;
      squares += 0.5 * e * e;
      count += 1.0;
    }
  }
  misfit_px = std::sqrt(squares / std::max(1.0, count));
  return views;
}

std::optional<IntrinsicsFit> fit_from(const std::vector<CornerView>& seen, const Camera& start,
                                      const DetectionOptions& detection) {
  double misfit = 0.0;
  std::vector<CornerView> views = posed_views(seen, start, detection, misfit);
  auto fit = fit_intrinsics(views, start, wide_intrinsics_sigma(start));
  if (!fit) return fit;
  // The prior is a thousand times wider than what the images tell: each round leaves a millionth of
  // what the one before moved, and only images that hardly tell anything need more than one.
  constexpr int kRounds = 4;
  constexpr double kSettled = 0.05;  // In standard deviations.
  for (int round = 0; round < kRounds; ++round) {
    views = fitted_views(std::move(views), *fit);
    auto next = fit_intrinsics(views, fit->camera, wide_intrinsics_sigma(fit->camera));
    if (!next) break;
    const IntrinsicsVector moved = intrinsics_of(next->camera) - intrinsics_of(fit->camera);
    fit = std::move(next);
    bool settled = true;
    for (Eigen::Index k = 0; k < kIntrinsics; ++k)
      settled = settled && std::abs(moved(k)) <= kSettled * std::sqrt(fit->covariance(k, k));
    if (settled) break;
  }
  return fit;
}

std::vector<double> held_out_squares(const std::vector<CornerView>& views, const Camera& start,
                                     const DetectionOptions& detection, int folds,
                                     const RunContext& context) {
  const auto parts = std::min(views.size(), static_cast<std::size_t>(std::max(2, folds)));
  std::vector<double> out(views.size(), 0.0);
  for (std::size_t part = 0; part < parts; ++part) {
    if (context.stopped()) return {};
    std::vector<CornerView> kept;
    for (std::size_t k = 0; k < views.size(); ++k) {
      if (k % parts != part) kept.push_back(views[k]);
    }
    const auto fit = fit_from(kept, start, detection);
    if (!fit) return {};
    for (std::size_t k = part; k < views.size(); k += parts) {
      double misfit = 0.0;
      const auto held_out = posed_views({views[k]}, fit->camera, detection, misfit);
      // The pose alone, on all corners: a robust one would forgive a model what it cannot do.
      const auto posed = fit_intrinsics(held_out, fit->camera, IntrinsicsVector::Zero());
      const Rigid3& pose =
          posed ? posed->camera_from_board.front() : held_out.front().camera_from_board;
      out[k] = std::pow(corner_rms_px(*held_out.front().corners, fit->camera, pose), 2);
    }
  }
  return out;
}

double rms_of(const std::vector<double>& squares) {
  return std::sqrt(mean_of(squares));
}

int blind_corners(const Camera& camera) {
  int blind = 0;
  for (const double x : {0.0, camera.width_px - 1.0}) {
    for (const double y : {0.0, camera.height_px - 1.0}) blind += camera.unproject({x, y}) ? 0 : 1;
  }
  return blind;
}

bool predicts_better(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kLeast_px2 = 1e-8;
  std::vector<double> gain;
  for (std::size_t k = 0; k < a.size(); ++k)
    gain.push_back(std::log(std::max(a[k], kLeast_px2) / std::max(b[k], kLeast_px2)));
  const double usual = mean_of(gain);
  double spread = 0.0;
  for (const double g : gain) spread += (g - usual) * (g - usual);
  const auto n = static_cast<double>(gain.size());
  const double sigma = std::sqrt(spread / (n * std::max(1.0, n - 1.0)));
  constexpr double kLeast = 0.02;  // Of the squares: less is no reason to change a camera.
  return usual > 2.0 * sigma && mean_of(b) < (1.0 - kLeast) * mean_of(a);
}

std::optional<BetterDistortion> better_distortion(const std::vector<CornerView>& views,
                                                  const IntrinsicsFit& given,
                                                  const DetectionOptions& detection,
                                                  double false_alarm, const RunContext& context) {
  if (views.size() < kFewestToDoubt) return std::nullopt;
  const auto squares_of = [&](const Camera& camera) {
    return held_out_squares(views, camera, detection, kFolds, context);
  };
  std::optional<std::vector<double>> of_given;
  std::optional<BetterDistortion> best;
  for (const DistortionModel model : kDistortionModels) {
    if (model == given.camera.model) continue;
    auto fit = fit_from(views, in_model(given.camera, model), detection);
    if (!fit || !fits_better(*fit, given, false_alarm) ||
        blind_corners(fit->camera) > blind_corners(given.camera))
      continue;
    if (!of_given) of_given = squares_of(given.camera);
    const auto squares = squares_of(fit->camera);
    if (squares.empty() || (!of_given->empty() && !predicts_better(*of_given, squares))) continue;
    const double held_out_px = rms_of(squares);
    if (best && best->held_out_px <= held_out_px) continue;
    // Where the given model predicts nothing, what it leaves of the images that it is fitted to is
    // less than it would miss.
    best = BetterDistortion{std::move(*fit), of_given->empty() ? given.sigma_px : rms_of(*of_given),
                            held_out_px};
  }
  if (context.stopped()) return std::nullopt;
  return best;
}

}  // namespace lvcalib
