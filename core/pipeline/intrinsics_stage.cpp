// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/intrinsics_stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "base/text.h"
#include "detection/board_pose.h"
#include "detection/board_view.h"
#include "pipeline/calibration.h"
#include "pipeline/distortion_models.h"
#include "pipeline/forward_stage.h"
#include "pipeline/turned_images.h"

namespace lvcalib {
namespace {

// A first look that clears right intrinsics nine times of ten spares most runs the second solve.
constexpr double kFirstLook = 0.1;
// Standard deviation from which an error between what camera and LiDAR see of a board counts as in
// the model: what is not is held at 1 µm and 1 µrad.
constexpr double kInModel = 4e-12;

// The images of intrinsics/.
std::vector<CornerView> extra_views(const IntrinsicsReport& report) {
  std::vector<CornerView> views;
  for (const BoardImage& image : report.extra_images) {
    if (image.used())
      views.push_back({&image.view->corners, image.view->camera_from_board.transform});
  }
  return views;
}

// Whether a scene's image counts for the camera.
bool image_counts(const SceneResult& scene) {
  return scene.view && !scene.rejected && !scene.turned_image;
}

// The scenes' images first, then those of intrinsics/. Scenes that the solve refused count: what
// their clouds say is another matter, and wrong intrinsics may be why they were refused.
std::vector<CornerView> views_of(const CalibrationResult& result) {
  std::vector<CornerView> views;
  for (const SceneResult& scene : result.scenes) {
    if (image_counts(scene))
      views.push_back({&scene.view->corners, scene.view->camera_from_board.transform});
  }
  const std::vector<CornerView> extra = extra_views(result.intrinsics);
  views.insert(views.end(), extra.begin(), extra.end());
  return views;
}

// The camera that fits all corners, wherever they can tell. Lenses have their principal point near
// the image's middle: where camera.yaml says otherwise, far from there, a fit that starts at it may
// end in focal lengths and distortions that stand for the shift, so one starts in the middle, too.
std::optional<IntrinsicsFit> fit_freely(const std::vector<CornerView>& views, const Camera& given) {
  const IntrinsicsVector wide = wide_intrinsics_sigma(given);
  auto fit = fit_intrinsics(views, given, wide);
  Camera middle = given;
  middle.cx = 0.5 * given.width_px;
  middle.cy = 0.5 * given.height_px;
  if (std::abs(given.cx - middle.cx) <= wide(2) && std::abs(given.cy - middle.cy) <= wide(3))
    return fit;
  std::vector<CornerView> seen = views;
  for (CornerView& view : seen) {
    // Under the given camera the boards are seen elsewhere and tilted otherwise.
    if (const auto pose = estimate_board_pose(*view.corners, middle, DetectionOptions()))
      view.camera_from_board = pose->camera_from_board.transform;
  }
  auto other = fit_intrinsics(seen, middle, wide);
  return other && (!fit || other->sigma_px < fit->sigma_px) ? other : fit;
}

// Leaves out images of intrinsics/ that are of something else; one of them would spoil the camera
// for all scenes. True if there was any.
bool drop_stray_images(CalibrationResult& result, const IntrinsicsFit& fit) {
  const std::vector<CornerView> views = views_of(result);
  const std::size_t scenes = views.size() - extra_views(result.intrinsics).size();
  const std::vector<Message> reasons = strays_among(views, scenes, result.intrinsics.given, fit);
  bool any = false;
  std::size_t next = 0;
  for (BoardImage& image : result.intrinsics.extra_images) {
    if (!image.used()) continue;
    const Message& reason = reasons[next++];
    if (reason.empty()) continue;
    any = true;
    image.reason = reason;
    result.warnings.push_back(Message("%1: %2; left out", extra_image_name(image.path), reason));
  }
  return any;
}

// Standard deviations along the worst axis: of the LiDAR's position (m) and of the rotation (rad).
std::pair<double, double> worst_sigmas(const UncertainRigid3& x) {
  Eigen::Matrix<double, 3, 6> position;
  position << Eigen::Matrix3d::Identity(), -skew(x.transform.translation);
  return {largest_sigma(position * x.covariance * position.transpose()),
          largest_sigma(x.covariance.bottomRightCorner<3, 3>())};
}

// Whether what camera and LiDAR see of the boards disagrees beyond noise in the model of a solve.
bool boards_disagree(const ForwardSolution& forward) {
  for (const SharedError kind :
       {SharedError::kBoardShift, SharedError::kBoardNormal, SharedError::kBoardTilt,
        SharedError::kBoardSpin, SharedError::kSensorRange, SharedError::kSensorDark,
        SharedError::kSensorLine}) {
    if (forward.noise.shared[static_cast<std::size_t>(kind)] > kInModel) return true;
  }
  return false;
}

GlobalPrior prior_with(GlobalPrior prior, const IntrinsicsVector& sigma) {
  prior.sigma.segment<kIntrinsics>(kFirstIntrinsic) = sigma;
  prior.offset.segment<kIntrinsics>(kFirstIntrinsic).setZero();
  return prior;
}

// Of the corners' noise in a joint solve with the intrinsics freed. Of a board's pose the LiDAR
// tells distance and tilt better than its corners do, and these the rest.
double joint_freedom(const std::vector<CornerView>& views, const Camera& camera) {
  double out = -4.0 - camera.distortion_count();
  for (const CornerView& view : views) out += 2.0 * static_cast<double>(view.corners->size()) - 3.0;
  return out;
}

// To first order about a solve with the intrinsics held: does its data ask for others?
bool first_look(const ForwardSolution& forward, const Camera& given, double noise_freedom) {
  if (boards_disagree(forward)) return true;
  const IntrinsicsVector wide = wide_intrinsics_sigma(given);
  std::vector<const GlobalTerm*> terms;
  for (const GlobalTerm& term : forward.terms) terms.push_back(&term);
  const auto step = solve_terms(terms, prior_with(forward.prior, wide));
  if (!step) return false;
  const IntrinsicsVector values = intrinsics_of(given);
  return contrast_intrinsics(values + step->step.segment<kIntrinsics>(kFirstIntrinsic), values,
                             step->covariance, wide, noise_freedom, kFirstLook)
      .contradicts();
}

// The joint solve with the intrinsics freed; it starts from the corners' camera where the given one
// is clearly off or of another model. Nothing where it fails.
std::optional<ForwardSolution> solve_freed(const CalibrationResult& result,
                                           const std::vector<SceneObservations>& observations,
                                           const std::vector<std::size_t>& index,
                                           const ExtrinsicSolution& nodes,
                                           const IntrinsicsFit* corners,
                                           const RunContext& context) {
  ForwardOptions options = result.options.forward;
  options.intrinsics_sigma =
      wide_intrinsics_sigma(corners != nullptr ? corners->camera : result.intrinsics.given);
  options.intrinsics_evidence = result.intrinsics.evidence;
  std::vector<SceneObservations> freed = observations;
  ExtrinsicSolution start = nodes;
  if (corners != nullptr) {
    // Images that no scene in use has count for the camera. What they say holds near where it was
    // linearized.
    std::vector<CornerView> extra;
    std::size_t next = 0;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
      const SceneResult& scene = result.scenes[s];
      if (!image_counts(scene)) continue;
      const Rigid3& pose = corners->camera_from_board[next++];
      const auto at = std::find(index.begin(), index.end(), s);
      if (at != index.end() && observations[static_cast<std::size_t>(at - index.begin())].use) {
        freed[static_cast<std::size_t>(at - index.begin())].camera_from_board = pose;
      } else {
        extra.push_back({&scene.view->corners, pose});
      }
    }
    for (const CornerView& view : extra_views(result.intrinsics))
      extra.push_back({view.corners, corners->camera_from_board[next++]});
    options.first_camera = corners->camera;
    options.intrinsics_evidence = intrinsics_evidence(extra, corners->camera, corners->sigma_px);
    auto solved =
        solve_extrinsic({freed, corners->camera, result.target, result.options.extrinsic});
    if (solved) start = std::move(*solved);
  }
  auto forward = solve_every_return(result, freed, index, start, options, context);
  return forward ? std::optional(std::move(*forward)) : std::nullopt;
}

UncertainRigid3 extrinsic_of(const ForwardSolution& forward) {
  return {forward.state.camera_from_lidar, forward.globals_covariance.topLeftCorner<6, 6>()};
}

struct Move {
  double mm = 0.0;  // Of the LiDAR's position.
  double mrad = 0.0;
  bool matters = false;
};

Move move_between(const UncertainRigid3& from, const UncertainRigid3& to, const QualityOptions& q) {
  const double move_m = translation_distance_m(from.transform.inverse(), to.transform.inverse());
  const double move_rad = rotation_distance_rad(from.transform, to.transform);
  // Misfit widens one's standard deviation; that of the one without it is not spoiled by it.
  const auto a = worst_sigmas(from);
  const auto b = worst_sigmas(to);
  return {
      1e3 * move_m, 1e3 * move_rad,
      move_m > std::max(q.tolerance_m, q.tolerance_sigmas * std::min(a.first, b.first)) ||
          move_rad > std::max(q.tolerance_rad, q.tolerance_sigmas * std::min(a.second, b.second))};
}

void judge_move(const CalibrationResult& result, IntrinsicsContradiction& found) {
  const Move move = move_between(result.extrinsic.camera_from_lidar, *found.camera_from_lidar,
                                 result.options.quality);
  found.move_mm = move.mm;
  found.move_mrad = move.mrad;
  found.matters = move.matters;
}

// Faults that are in the data must lie within the total: with q = mᵀT⁻¹m above one for the move m,
// T + (1 − 1/q) m mᵀ has it at one standard deviation (Sherman–Morrison).
void widen_total(CalibrationResult& result, const Rigid3& freed) {
  const Vector6d m = se3_log(freed * result.extrinsic.camera_from_lidar.transform.inverse());
  const double q = squared_mahalanobis(m, result.covariance_total);
  if (std::isfinite(q) && q > 1.0) result.covariance_total += (1.0 - 1.0 / q) * m * m.transpose();
}

// How estimated intrinsics differ from what camera.yaml says of them, in its own σ.
void check_against_prior(CalibrationResult& result, const std::vector<CornerView>& views) {
  IntrinsicsReport& report = result.intrinsics;
  const IntrinsicsContrast contrast = contrast_intrinsics(
      intrinsics_of(result.camera), intrinsics_of(report.given), result.forward->globals_covariance,
      report.prior_sigma, joint_freedom(views, report.given),
      result.options.intrinsics.false_alarm);
  // The estimate may be off by the prior's spread and by its own; what exceeds both contradicts.
  double chi = 0.0;
  int dof = 0;
  const IntrinsicsVector d = intrinsics_of(result.camera) - intrinsics_of(report.given);
  for (Eigen::Index k = 0; k < kIntrinsics; ++k) {
    if (!(report.prior_sigma(k) > 0.0)) continue;
    chi += std::pow(d(k) / report.prior_sigma(k), 2);
    ++dof;
  }
  if (dof == 0 || chi <= chi_square_gate(dof, result.options.intrinsics.false_alarm)) return;
  IntrinsicsContradiction found;
  found.contrast = contrast;
  found.what = describe(contrast, report.given, views);
  found.camera_from_lidar = result.extrinsic.camera_from_lidar;
  report.contradiction = std::move(found);
}

Message describe_model(const BetterDistortion& better, const Camera& given) {
  return Message("the distortion model %1 predicts images held out to %2 px, %3 only to %4 px",
                 name_of(better.fit.camera.model), formatted("%.3f", better.held_out_px),
                 name_of(given.model), formatted("%.3f", better.given_px));
}

void take_model(const BetterDistortion& better, const Camera& given,
                IntrinsicsContradiction& found) {
  const Message what = describe_model(better, given);
  found.what = found.what.empty() ? what : joined({found.what, what}, "; ");
  found.better_model = better.fit.camera.model;
  found.better_px = better.fit.sigma_px;
}

// Joins what is said of the given model's values: either may be what is wrong, and a camera
// calibrated again in the other model mends both. `with` is solved in the other model, `without`
// has the intrinsics freed in the given one: only what lies between them is due to the model.
void doubt_model(CalibrationResult& result, const BetterDistortion& better,
                 const std::optional<ForwardSolution>& with, const UncertainRigid3& without) {
  IntrinsicsReport& report = result.intrinsics;
  IntrinsicsContradiction found = report.contradiction.value_or(IntrinsicsContradiction());
  const bool mattered = report.contradiction && found.matters;
  take_model(better, report.given, found);
  if (with) {
    found.camera_from_lidar = extrinsic_of(*with);
    judge_move(result, found);
    found.matters =
        mattered || move_between(without, *found.camera_from_lidar, result.options.quality).matters;
  }
  report.contradiction = std::move(found);
}

// 95 % limits of how far the position (m) and the rotation (rad) would move if some intrinsics were
// freed, over three tolerances each; the larger of both.
double open_share(const CalibrationResult& result, const IntrinsicsVector& freed) {
  std::vector<const GlobalTerm*> terms;
  for (const GlobalTerm& term : result.forward->terms) terms.push_back(&term);
  const auto step = solve_terms(terms, prior_with(result.forward->prior, freed));
  if (!step) return std::numeric_limits<double>::infinity();
  const UncertainRigid3& own = result.extrinsic.camera_from_lidar;
  const Vector6d move = step->step.head<6>();
  const Rigid3 other = se3_exp(move) * own.transform;
  const auto spread = worst_sigmas(
      {own.transform, Matrix6d(step->covariance.topLeftCorner<6, 6>() - own.covariance)});
  const auto sigma = worst_sigmas(own);
  const QualityOptions& q = result.options.quality;
  const double limit_m =
      translation_distance_m(own.transform.inverse(), other.inverse()) + kUpper95 * spread.first;
  const double limit_rad = rotation_distance_rad(own.transform, other) + kUpper95 * spread.second;
  return std::max(limit_m / (3.0 * std::max(q.tolerance_m, q.tolerance_sigmas * sigma.first)),
                  limit_rad / (3.0 * std::max(q.tolerance_rad, q.tolerance_sigmas * sigma.second)));
}

// If corners alone contradict the given intrinsics: in words what is wrong.
Message contradicted_by(const std::vector<CornerView>& views, const Camera& given,
                        double false_alarm) {
  const auto fit = fit_freely(views, given);
  if (!fit) return {};
  const IntrinsicsContrast contrast =
      contrast_intrinsics(intrinsics_of(fit->camera), intrinsics_of(given), fit->covariance,
                          wide_intrinsics_sigma(given), fit->freedom, false_alarm);
  return contrast.contradicts() ? describe(contrast, given, views) : Message();
}

// By how many degrees all images must be turned to agree with intrinsics that they contradict as
// they are; 0: by none. Turned, principal point and distortion lie on the other side.
int turn_that_mends(const std::vector<CornerView>& views, const Camera& given, double false_alarm) {
  for (const int degrees : possible_turns_deg(given)) {
    std::vector<std::vector<CornerObservation>> corners;
    corners.reserve(views.size());
    std::vector<CornerView> turned;
    for (const CornerView& view : views) {
      corners.push_back(turned_corners(*view.corners, given, degrees));
      const auto pose = estimate_board_pose(corners.back(), given, DetectionOptions());
      if (!pose) break;
      turned.push_back({&corners.back(), pose->camera_from_board.transform});
    }
    if (turned.size() == views.size() && contradicted_by(turned, given, false_alarm).empty())
      return degrees;
  }
  return 0;
}

}  // namespace

IntrinsicsReport start_intrinsics(const Dataset& dataset, IntrinsicsMode mode) {
  IntrinsicsReport report;
  report.mode = mode;
  report.given = dataset.camera;
  report.prior_sigma = typical_intrinsics_sigma(dataset.camera);
  report.stated = dataset.camera_deviations.has_value();
  for (Eigen::Index k = 0; report.stated && k < kIntrinsics; ++k) {
    const double stated = (*dataset.camera_deviations)(k);
    if (stated >= 0.0 && report.prior_sigma(k) > 0.0) report.prior_sigma(k) = stated;
  }
  return report;
}

IntrinsicsVector solve_prior(const IntrinsicsReport& report) {
  switch (report.mode) {
    case IntrinsicsMode::kFixed:
      break;
    case IntrinsicsMode::kPrior:
      return report.prior_sigma;
    case IntrinsicsMode::kFree:
      return wide_intrinsics_sigma(report.given);
  }
  return IntrinsicsVector::Zero();
}

void free_camera(CalibrationResult& result) {
  IntrinsicsReport& report = result.intrinsics;
  report.evidence.reset();
  const bool fixed = report.mode == IntrinsicsMode::kFixed;
  if (fixed && extra_views(report).empty()) return;
  const Camera& given = report.given;
  const IntrinsicsVector prior = fixed ? wide_intrinsics_sigma(given) : solve_prior(report);
  auto fit = fit_intrinsics(views_of(result), given, prior);
  if (fit && drop_stray_images(result, *fit)) fit = fit_intrinsics(views_of(result), given, prior);
  if (!fit) return;
  if (!fixed) {
    result.camera = fit->camera;
    for (SceneResult& scene : result.scenes) {
      if (scene.view) refit_view(*scene.view, fit->camera, result.options.detection);
    }
    for (BoardImage& image : report.extra_images) {
      if (image.view) refit_view(*image.view, fit->camera, result.options.detection);
    }
  }
  report.evidence = intrinsics_evidence(extra_views(report), result.camera, fit->sigma_px);
}

std::optional<CornerMisfit> corner_misfit(const CalibrationResult& result) {
  const double own_px = result.extrinsic.sigma_px;
  if (result.intrinsics.replicate_px > 0.0) {
    const CornerMisfit misfit{own_px, result.intrinsics.replicate_px};
    return misfit.px > kCornersMiss * misfit.noise_px ? std::optional(misfit) : std::nullopt;
  }
  if (!result.forward || result.model_fit) return std::nullopt;
  double rows = 0.0;
  double views = 0.0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.used || !scene.view) continue;
    rows += 2.0 * static_cast<double>(scene.view->corners.size());
    views += 1.0;
  }
  const double freedom = rows - 6.0 * views;
  if (freedom < 1.0) return std::nullopt;
  const CornerMisfit misfit{result.forward->noise.corner_px, own_px};
  const double chance =
      f_gate(static_cast<int>(std::lround(rows)), freedom, result.options.intrinsics.false_alarm) /
      rows;
  const double gate = std::max(kCornersMiss * kCornersMiss, chance);
  return std::pow(misfit.px, 2) > gate * std::pow(own_px, 2) ? std::optional(misfit) : std::nullopt;
}

LeftOutSizes left_out_sizes(const CalibrationResult& result) {
  LeftOutSizes out;
  if (result.intrinsics.mode == IntrinsicsMode::kFixed)
    out.intrinsics = result.intrinsics.prior_sigma;
  // A print of another size is, but for the extrinsic's own length, ranges of another scale.
  out.range_scale = std::hypot(out.range_scale, result.target.size_sigma);
  return out;
}

Message describe_turn(int degrees) {
  return Message("they agree with them once they are turned counterclockwise by %1°", degrees);
}

Message contradicted_by_corners(const CalibrationResult& result) {
  if (result.intrinsics.mode != IntrinsicsMode::kFixed) return {};
  const std::vector<CornerView> views = views_of(result);
  const Camera& given = result.intrinsics.given;
  const double alarm = result.options.intrinsics.false_alarm;
  const Message what = contradicted_by(views, given, alarm);
  const int degrees = what.empty() ? 0 : turn_that_mends(views, given, alarm);
  return degrees > 0 ? describe_turn(degrees) : what;
}

Message better_spacing(const std::vector<CornerView>& views, const Target& target,
                       const Camera& given) {
  // Twice the noise is four times its square: with dozens of corners no chance.
  constexpr double kNotNoise = 2.0;
  if ((target.type != TargetType::kAprilGrid && target.type != TargetType::kAprilGridCircles) ||
      target.tag_count() < 2)
    return {};
  const auto as_given = fit_freely(views, given);
  if (!as_given || !(as_given->replicate_px > 0.0) ||
      as_given->sigma_px < kNotNoise * as_given->replicate_px)
    return {};
  // What is left with another spacing.
  const auto left_px = [&](double spacing) {
    Target other = target;
    other.tag_spacing = spacing;
    std::vector<std::vector<CornerObservation>> corners;
    corners.reserve(views.size());
    std::vector<CornerView> moved = views;
    for (CornerView& view : moved) {
      corners.push_back(*view.corners);
      for (CornerObservation& c : corners.back()) {
        if (const auto tag = other.tag(c.feature_id))
          c.board_m = other.tag_corners_m(*tag)[static_cast<std::size_t>(c.corner)];
      }
      view.corners = &corners.back();
    }
    const auto fit = fit_freely(moved, given);
    return fit ? fit->sigma_px : std::numeric_limits<double>::infinity();
  };
  // Golden section; one minimum, as the misfit grows with the distance from the true spacing.
  double low = 0.5 * target.tag_spacing;
  double high = 2.0 * target.tag_spacing;
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low);
  double b = low + ratio * (high - low);
  double at_a = left_px(a);
  double at_b = left_px(b);
  while (high - low > 1e-4 * target.tag_spacing) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - ratio * (high - low);
      at_a = left_px(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + ratio * (high - low);
      at_b = left_px(b);
    }
  }
  if (!(kNotNoise * std::min(at_a, at_b) < as_given->sigma_px)) return {};
  return Message("%1 would fit (corners then scatter by %2 px, now by %3 px)",
                 formatted("tagSpacing: %.4f", 0.5 * (low + high)),
                 formatted("%.2f", std::min(at_a, at_b)), formatted("%.2f", as_given->sigma_px));
}

Message better_spacing(const CalibrationResult& result) {
  return better_spacing(views_of(result), result.target, result.intrinsics.given);
}

void ask_images_again(CalibrationResult& result, const CornersWithout& others,
                      const CornersWithout& all) {
  IntrinsicsReport& report = result.intrinsics;
  const bool fixed = report.mode == IntrinsicsMode::kFixed;
  const bool asked = !report.spacing.empty();
  const bool camera_asked =
      report.contradiction && (fixed || report.contradiction->better_model.has_value());
  if (!asked && !camera_asked) return;
  const std::vector<CornerView> seen = views_of(result);
  using Corners = std::vector<std::vector<CornerObservation>>;
  const auto corners_left = [&](const CornersWithout& without) {
    Corners out;
    for (const CornerView& view : seen)
      out.push_back(without(*view.corners, view.camera_from_board));
    return out;
  };
  const auto views_with = [&](const Corners& corners) {
    std::vector<CornerView> out = seen;
    for (std::size_t v = 0; v < out.size(); ++v) out[v].corners = &corners[v];
    return out;
  };
  const auto differ = [](const std::vector<CornerView>& a, const std::vector<CornerView>& b) {
    return !std::equal(a.begin(), a.end(), b.begin(), [](const CornerView& x, const CornerView& y) {
      return std::equal(x.corners->begin(), x.corners->end(), y.corners->begin(),
                        [](const CornerObservation& p, const CornerObservation& q) {
                          return p.pixel == q.pixel;
                        });
    });
  };
  // What images say against the camera: against its values, and the model that predicts better.
  const auto against = [&](const std::vector<CornerView>& views) {
    std::optional<IntrinsicsContradiction> found;
    const double alarm = result.options.intrinsics.false_alarm;
    if (const Message what = fixed ? contradicted_by(views, report.given, alarm) : Message();
        !what.empty()) {
      found.emplace();
      found->what = what;
    }
    const auto fit = fit_freely(views, report.given);
    const auto better =
        fit ? better_distortion(views, *fit, result.options.detection, alarm, {}) : std::nullopt;
    if (better) {
      if (!found) found.emplace();
      take_model(*better, report.given, *found);
    }
    return found;
  };
  const Corners left = corners_left(others);
  const std::vector<CornerView> views = views_with(left);
  // What still speaks against the target is as it was told of the images themselves.
  if (asked && better_spacing(views, result.target, report.given).empty()) report.spacing = {};
  if ((!fixed && !camera_asked) || !report.spacing.empty()) return;
  if (differ(views, seen)) {
    // Corners that lie otherwise than the target says were not asked about the camera.
    auto found = against(views);
    if (!found) report.contradiction.reset();
    if (found &&
        (!report.contradiction || report.contradiction->better_model != found->better_model))
      report.contradiction = std::move(found);
  }
  if (!report.contradiction) return;
  const Corners none_left = corners_left(all);
  const std::vector<CornerView> without_all = views_with(none_left);
  report.contradiction->modelled = differ(without_all, views) && !against(without_all);
}

void verify_intrinsics(CalibrationResult& result) {
  result.verified = false;
  result.unverified = {};
  if (!result.forward || result.intrinsics.contradiction) return;
  result.verified = true;
  if (result.intrinsics.mode != IntrinsicsMode::kFixed) return;
  const IntrinsicsVector wide = wide_intrinsics_sigma(result.intrinsics.given);
  if (open_share(result, wide) <= 1.0) return;
  result.verified = false;
  const std::array what = {
      Message("focal length: a scene with the board tilted by 40° or more and one at twice the "
              "distance"),
      Message(
          "principal point: scenes with the board tilted, and rolled by 90° against each other"),
      Message("distortion: scenes with the board in the corners of the image")};
  std::size_t worst = 0;
  double most = -1.0;
  for (std::size_t part = 0; part < what.size(); ++part) {
    IntrinsicsVector only = IntrinsicsVector::Zero();
    const auto first = static_cast<Eigen::Index>(2 * part);
    const Eigen::Index count = part < 2 ? 2 : 8;
    only.segment(first, count) = wide.segment(first, count);
    const double share = open_share(result, only);
    if (share <= most) continue;
    most = share;
    worst = part;
  }
  result.unverified =
      Message("these scenes cannot verify the camera's intrinsics; most open is the %1 would tell",
              what[worst]);
}

Status check_intrinsics(CalibrationResult& result,
                        const std::vector<SceneObservations>& observations,
                        const std::vector<std::size_t>& index, const ExtrinsicSolution& nodes,
                        const RunContext& context) {
  IntrinsicsReport& report = result.intrinsics;
  report.contradiction.reset();
  const std::vector<CornerView> views = views_of(result);
  // Corners that lie otherwise on the board say nothing about the camera.
  report.spacing = better_spacing(views, result.target, report.given);
  if (!report.spacing.empty()) return Done{};
  const Camera& given = report.given;
  const double alarm = result.options.intrinsics.false_alarm;
  const auto corners = fit_freely(views, given);
  std::optional<BetterDistortion> better;
  if (corners)
    better = better_distortion(views, *corners, result.options.detection, alarm, context);
  if (context.stopped()) return Error::cancelled();
  const auto solve = [&](const IntrinsicsFit* start) {
    return result.forward ? solve_freed(result, observations, index, nodes, start, context)
                          : std::nullopt;
  };
  if (report.mode != IntrinsicsMode::kFixed) {
    if (report.mode == IntrinsicsMode::kPrior && result.forward) check_against_prior(result, views);
    if (better)
      doubt_model(result, *better, solve(&better->fit), result.extrinsic.camera_from_lidar);
    return context.stopped() ? Status(Error::cancelled()) : Status(Done{});
  }
  const IntrinsicsVector wide = wide_intrinsics_sigma(given);
  IntrinsicsContrast of_corners;
  if (corners) {
    report.replicate_px = corners->replicate_px;
    of_corners = contrast_intrinsics(intrinsics_of(corners->camera), intrinsics_of(given),
                                     corners->covariance, wide, corners->freedom, alarm);
  }
  const bool clear = of_corners.contradicts();
  const bool open = of_corners.dof > 0 &&
                    of_corners.chi_square > f_gate(of_corners.dof, corners->freedom, kFirstLook);
  const double freedom = joint_freedom(views, given);
  // Few corners' noise holds what the camera is off by, and hides it from a first look.
  const bool few = !(report.replicate_px > 0.0);
  if (!clear && !open && !better && !few &&
      !(result.forward && first_look(*result.forward, given, freedom)))
    return Done{};
  const auto freed = solve(clear ? &*corners : nullptr);
  if (context.stopped()) return Error::cancelled();
  IntrinsicsContrast of_all;
  if (freed)
    of_all = contrast_intrinsics(intrinsics_of(freed->state.camera), intrinsics_of(given),
                                 freed->globals_covariance, wide, freedom, alarm);
  if (clear || of_all.contradicts()) {
    IntrinsicsContradiction found;
    found.contrast = of_all.contradicts() ? of_all : of_corners;
    found.what = describe(found.contrast, given, views);
    found.by_ranges = !clear;
    found.turned_deg = clear ? turn_that_mends(views, given, alarm) : 0;
    if (freed) {
      found.camera_from_lidar = UncertainRigid3{
          se3_exp(of_all.correction) * freed->state.camera_from_lidar, of_all.covariance};
      judge_move(result, found);
    }
    report.contradiction = std::move(found);
  }
  if (better && !(report.contradiction && report.contradiction->turned_deg > 0)) {
    doubt_model(result, *better, solve(&better->fit),
                freed ? extrinsic_of(*freed) : result.extrinsic.camera_from_lidar);
    if (context.stopped()) return Error::cancelled();
  }
  if (report.contradiction && report.contradiction->camera_from_lidar)
    widen_total(result, report.contradiction->camera_from_lidar->transform);
  // Few corners know their noise so badly that intrinsics must be far off to be contradicted. What
  // they do not contradict they do not exclude.
  if (!report.contradiction && few && freed)
    widen_total(result, freed->camera_from_lidar.transform);
  return Done{};
}

}  // namespace lvcalib
