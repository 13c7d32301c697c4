// SPDX-License-Identifier: BSD-3-Clause
// The part of the verdict that the print on the board speaks for.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/symmetric.h"
#include "base/text.h"
#include "model/board_prediction.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

// Why the intensities of a scene are not used.
enum class PrintState { kSeen, kLeftOut, kNoIntensity, kNoContrast, kOtherPrint };

PrintState print_state(const SceneResult& scene, const ForwardSceneResult& solved,
                       const CloudOptions& clouds) {
  if (!clouds.use_intensity) return PrintState::kLeftOut;
  if (scene.no_contrast) return PrintState::kNoContrast;
  if (!scene.board_points.has_contrast()) return PrintState::kNoIntensity;
  if (solved.print_correlation > 0.0) return PrintState::kSeen;
  return solved.intensity_structure < kPlainStructure ? PrintState::kNoContrast
                                                      : PrintState::kOtherPrint;
}

Message print_problem(PrintState state) {
  switch (state) {
    case PrintState::kLeftOut:
      return Message("the clouds' intensity is left out, as you decided");
    case PrintState::kNoIntensity:
      return Message("the clouds' intensity is missing or the same everywhere");
    case PrintState::kNoContrast:
      return Message("the print has no contrast for this LiDAR");
    default:
      return Message("the clouds' intensities do not follow the target's print");
  }
}

// Where it is so in all scenes.
Message print_problem_everywhere(PrintState state) {
  switch (state) {
    case PrintState::kLeftOut:
      return Message(
          "the clouds' intensity is left out, as you decided: the extrinsic rests on planes and "
          "corners, and the print does not hold it sideways");
    case PrintState::kNoIntensity:
      return Message(
          "the clouds' intensity is missing or the same everywhere: the extrinsic rests on planes "
          "and corners, and the print does not hold it sideways");
    case PrintState::kNoContrast:
      return Message(
          "the print has no contrast for this LiDAR: the extrinsic rests on planes and corners, "
          "and the print does not hold it sideways");
    default:
      return Message(
          "the clouds' intensities do not follow the target's print: the extrinsic rests on planes "
          "and corners, and the print does not hold it sideways; does target.yaml describe this "
          "board?");
  }
}

// Where it is so in some scenes.
Message print_problem_in(PrintState state, const std::string& names) {
  const Message problem = print_problem(state);
  return state == PrintState::kOtherPrint
             ? Message(
                   "%1 in scene %2: planes and corners are used there; does target.yaml describe "
                   "this board?",
                   problem, names)
             : Message("%1 in scene %2: planes and corners are used there", problem, names);
}

// The step that a cloud's coordinates come in, of the axis where it is largest: the smallest gap
// between different values. Of n points that are not rounded it is an n²-th of the board. 0 for few
// points.
double coordinate_step_m(const Cloud& cloud) {
  constexpr std::size_t kFewest = 200;  // Unrounded: 20 µm of a board of 0.8 m.
  constexpr std::size_t kMost = 4000;   // Rounded coordinates show in any of them.
  if (cloud.size() < kFewest) return 0.0;
  const std::size_t stride = (cloud.size() + kMost - 1) / kMost;
  double step = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t k = 0; k < cloud.size(); k += stride)
      values.push_back(static_cast<double>(cloud.points_m[k](axis)));
    std::sort(values.begin(), values.end());
    // Single precision tells no less of some metres.
    constexpr double kSame = 2e-6;
    double gap = HUGE_VAL;
    for (std::size_t k = 1; k < values.size(); ++k) {
      if (values[k] - values[k - 1] > kSame) gap = std::min(gap, values[k] - values[k - 1]);
    }
    if (std::isfinite(gap)) step = std::max(step, gap);
  }
  return step;
}

// By how much rounding to steps h may displace an edge that runs along them: a spot of width s
// spreads it over the steps, which leaves h/π·exp(−2π²s²/h²), the first harmonic of the rounding.
// The width that the solve finds has the rounding's own in it.
double displaced_by_rounding_m(double step_m, const BeamSpread& beam, double range_m) {
  if (!(step_m > 0.0)) return 0.0;
  const double spot2 =
      range_m * range_m * axes_of(beam.blur_rad2).values(0) - step_m * step_m / 12.0;
  return step_m / std::numbers::pi *
         std::exp(-2.0 * std::pow(std::numbers::pi / step_m, 2) * std::max(0.0, spot2));
}

// The field of target.yaml that states a size, and its present value.
std::pair<const char*, double> size_field(const Target& t, int axis) {
  switch (t.type) {
    case TargetType::kCheckerboard:
      return axis == 0 ? std::pair("colSpacingMeters", t.column_spacing_m)
                       : std::pair("rowSpacingMeters", t.row_spacing_m);
    case TargetType::kCharuco:
      return {"squareSize", t.column_spacing_m};
    default:
      return {"tagSize", t.tag_size_m};
  }
}

// By how much the print is larger than the target's, by the intensities: what the model in force
// says of it is no contradiction any more.
Eigen::Array2d print_size_error(const CalibrationResult& result) {
  return result.forward->print_size.scale.array() - 1.0 - result.modelled_print_scale.array();
}

// A print of another size than the target's.
void judge_print_size(const CalibrationResult& result, const QualityOptions& options,
                      Verdict& verdict) {
  if (!print_size_contradicts(result, options)) return;
  const PrintSize& size = result.forward->print_size;
  const Eigen::Array2d off = print_size_error(result);
  // Tags that lie otherwise than told are told of already, and are of another size for that reason.
  const bool failed = off.abs().maxCoeff() > options.scale_failure;
  if (!failed && !result.intrinsics.spacing.empty()) return;
  std::string fits;
  for (int axis = 0; axis < 2; ++axis) {
    const auto [field, value] = size_field(result.target, axis);
    if (fits.find(field) != std::string::npos) continue;
    fits += (fits.empty() ? "" : ", ") + std::string(field) +
            formatted(": %.5f", value * size.scale(axis));
  }
  // One number where both axes say the same.
  const Eigen::Array2d weight = size.sigma.array().square().inverse();
  const double mean = (weight * off).sum() / weight.sum();
  Message text;
  if (print_is_scaled(result, options)) {
    const std::string percent =
        formatted("%.2f ± %.2f", 100.0 * std::abs(mean), 100.0 / std::sqrt(weight.sum()));
    text = mean > 0 ? Message(
                          "LiDAR and camera disagree on the board's size: the LiDAR sees the print "
                          "%1 % larger than target.yaml says; %2 would fit; measure the print",
                          percent, fits)
                    : Message(
                          "LiDAR and camera disagree on the board's size: the LiDAR sees the print "
                          "%1 % smaller than target.yaml says; %2 would fit; measure the print",
                          percent, fits);
  } else {
    text = Message(
        "LiDAR and camera disagree on the board's size: the LiDAR sees the print %1 % as wide and "
        "%2 % as high as target.yaml says; %3 would fit; measure the print",
        formatted("%.2f ± %.2f", 100.0 * size.scale.x(), 100.0 * size.sigma.x()),
        formatted("%.2f ± %.2f", 100.0 * size.scale.y(), 100.0 * size.sigma.y()), fits);
  }
  if (failed) {
    verdict.failed(text);
  } else {
    verdict.doubtful(text);
  }
}

// Share of the returns on the board that lie on white print, seen through a blur of millimetres.
double white_share(const BlurredPrint& print, const Cloud& points, const Rigid3& lidar_from_board) {
  // A beam of 1.5 mrad at the usual distance; a mean hardly asks.
  constexpr double kBlur_m = 0.004;
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  const BlurredPrint::Coarse blurred = print.coarse(kBlur_m);
  double white = 0.0;
  double count = 0.0;
  for (const Eigen::Vector3f& point : points.points_m) {
    const auto hit = predictor.hit(point.cast<double>().normalized());
    if (!hit || print.inside_m(hit->board_m) <= 0.0) continue;
    white += blurred.at(hit->board_m);
    count += 1.0;
  }
  return count > 0.0 ? white / count : 1.0;
}

}  // namespace

bool print_size_contradicts(const CalibrationResult& result, const QualityOptions& options) {
  if (!result.forward || !result.forward->print_size.measured) return false;
  const Eigen::Array2d off = print_size_error(result).abs();
  return (off > 4.0 * result.forward->print_size.sigma.array() && off > options.scale_warning)
      .any();
}

bool print_is_scaled(const CalibrationResult& result, const QualityOptions& options) {
  if (!print_size_contradicts(result, options) || !result.forward->uses_intensity) return false;
  const PrintSize& size = result.forward->print_size;
  return std::abs(size.scale.x() - size.scale.y()) < 3.0 * size.sigma.norm();
}

void judge_print(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict) {
  const ForwardSolution& forward = *result.forward;
  std::map<PrintState, std::string> unseen;
  std::string saturated;
  std::string clipped;
  std::string rounded;
  double step_m = 0.0;
  double displaced_m = 0.0;
  std::size_t next = 0;
  std::size_t scenes = 0;
  for (const SceneSolution& solved : result.extrinsic.scenes) {
    if (!solved.used || next >= forward.scenes.size()) continue;
    const auto scene = std::find_if(result.scenes.begin(), result.scenes.end(),
                                    [&](const SceneResult& s) { return s.name == solved.name; });
    const Rigid3 lidar_from_board = forward.state.lidar_from_board(next);
    const ForwardSceneResult& found = forward.scenes[next++];
    if (scene == result.scenes.end()) continue;
    ++scenes;
    const PrintState state = print_state(*scene, found, result.options.clouds);
    if (state != PrintState::kSeen)
      unseen[state] += (unseen[state].empty() ? "" : ", ") + scene->name;
    // Where the median white return is at the ceiling the level of white is not measured, and an
    // edge's middle is taken for where half of the ceiling is.
    if (found.saturated > 0.0 && result.print &&
        found.saturated > 0.5 * white_share(*result.print, scene->board_points, lidar_from_board)) {
      clipped += (clipped.empty() ? "" : ", ") + scene->name +
                 formatted(" (%.0f %%)", 100.0 * found.saturated);
    } else if (found.saturated > 0.0) {
      saturated += (saturated.empty() ? "" : ", ") + scene->name +
                   formatted(" (%.0f %%)", 100.0 * found.saturated);
    }
    const double step = coordinate_step_m(scene->board_points);
    const double displaced =
        displaced_by_rounding_m(step, forward.state.beam, lidar_from_board.translation.norm());
    if (displaced > options.tolerance_m && forward.uses_intensity) {
      rounded += (rounded.empty() ? "" : ", ") + scene->name;
      step_m = std::max(step_m, step);
      displaced_m = std::max(displaced_m, displaced);
    }
    if (found.seen < 0.6) {
      verdict.note(
          Message("scene %1: %2", scene->name,
                  Message("the LiDAR sees %1 % of the board only: something covers it, or it is "
                          "cut off",
                          formatted("%.0f", 100.0 * found.seen))));
    }
  }
  for (const auto& [state, names] : unseen) {
    const bool all = !forward.uses_intensity && unseen.size() == 1;
    const Message text = all ? print_problem_everywhere(state) : print_problem_in(state, names);
    if (state == PrintState::kOtherPrint) {
      verdict.doubtful(text);
    } else {
      verdict.note(text);
    }
  }
  if (!saturated.empty()) {
    verdict.note(
        Message("the intensities are saturated on part of the board: scene %1; lower the LiDAR's "
                "gain or print the white greyer",
                saturated));
  }
  if (!clipped.empty()) {
    verdict.doubtful(
        Message("white print is saturated, so that the place of its edges is not measured: scene "
                "%1; lower the LiDAR's gain or print the white greyer",
                clipped));
  }
  if (!rounded.empty()) {
    verdict.doubtful(
        Message("the clouds' coordinates are rounded to steps of %1 mm, which may displace edges "
                "of the print by %2 mm: scene %3; write them to the millimetre",
                formatted("%.0f", 1e3 * step_m), formatted("%.1f", 1e3 * displaced_m), rounded));
  }
  if (!forward.uses_intensity) return;
  if (forward.lattice_margin < options.min_margin) {
    verdict.doubtful(
        Message("ambiguous: another place of the print on the board fits the intensities of all "
                "scenes nearly as well (log-likelihood %1 less)",
                formatted("%.1f", forward.lattice_margin)));
  }
  judge_print_size(result, options, verdict);
}

}  // namespace lvcalib
