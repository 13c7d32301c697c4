// SPDX-License-Identifier: BSD-3-Clause
// The part of the verdict that compares scenes with each other, and returns within a scan.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "base/text.h"
#include "pipeline/board_agreement.h"
#include "pipeline/diagnosis.h"
#include "pipeline/forward_stage.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

// The extrinsic of some of the scenes, under the model in force.
SubsetSolver subsets_of(const CalibrationResult& result) {
  if (!result.model_fit) return forward_subsets(*result.forward, result.extrinsic);
  return model_subsets(result.model_fit, result.extrinsic.camera_from_lidar.transform,
                       result.extrinsic);
}

std::vector<std::size_t> scenes_in_use(const ExtrinsicSolution& extrinsic) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < extrinsic.scenes.size(); ++k) {
    if (extrinsic.scenes[k].used) out.push_back(k);
  }
  return out;
}

}  // namespace

void judge_leverage(const CalibrationResult& result, Verdict& verdict) {
  if (!result.forward) return;
  const UncertainRigid3& all = result.extrinsic.camera_from_lidar;
  const SubsetSolver subset = subsets_of(result);
  const std::vector<std::size_t> in_use = scenes_in_use(result.extrinsic);
  const std::size_t n = in_use.size();
  // As many tests as scenes, one in a hundred together.
  const double gate =
      f_gate(6, result.forward->dof, 0.01 / static_cast<double>(std::max<std::size_t>(1, n)));
  for (const std::size_t k : in_use) {
    const SceneSolution& scene = result.extrinsic.scenes[k];
    std::vector<std::size_t> others;
    std::copy_if(in_use.begin(), in_use.end(), std::back_inserter(others),
                 [&](std::size_t other) { return other != k; });
    const auto rest = n > 2 ? subset(others) : std::nullopt;
    if (!rest) continue;
    const Vector6d move = se3_log(rest->transform * all.transform.inverse());
    const Vector6d sigma = all.covariance.diagonal().cwiseSqrt();
    if ((move.cwiseAbs() - 3.0 * sigma).maxCoeff() <= 0.0) continue;
    // Both share the other scenes: the move's covariance is the difference of theirs.
    const Matrix6d spread = rest->covariance - all.covariance;
    const double chi = squared_mahalanobis(move, spread);
    const double move_m =
        translation_distance_m(all.transform.inverse(), rest->transform.inverse());
    const double move_rad = rotation_distance_rad(all.transform, rest->transform);
    const QualityOptions& q = result.options.quality;
    if (!(chi > gate) || (move_m < q.tolerance_m && move_rad < q.tolerance_rad)) continue;
    verdict.doubtful(
        Message("without scene %1 the extrinsic moves by %2 mm and %3 mrad, more than three of its "
                "standard deviations: did something move while that scene was taken?",
                scene.name, formatted("%.1f", 1e3 * move_m), formatted("%.2f", 1e3 * move_rad)));
  }
}

namespace {

// What one scene says of the extrinsic at the solution of all, the other globals held there: twice
// the log-likelihood changes by 2 gᵀξ − ξᵀHξ.
struct SceneInformation {
  Matrix6d information;
  Vector6d gradient;
};

std::vector<SceneInformation> scene_information(const CalibrationResult& result) {
  std::vector<SceneInformation> out;
  if (!result.model_fit) {
    for (const GlobalTerm& term : result.forward->terms) {
      if (!term.usable) return {};
      out.push_back({term.information.topLeftCorner<6, 6>(), term.gradient.head<6>()});
    }
    return out;
  }
  const ModelFit& fit = *result.model_fit;
  for (const SceneTerm& term : fit.scenes) {
    out.push_back({term.information.topLeftCorner<6, 6>(),
                   (term.gradient - term.information * fit.solution).head<6>()});
  }
  return out;
}

// By how much χ² falls if scenes choose freely, and in how many directions they can.
struct ChiSquareDrop {
  double chi = 0.0;
  int freedom = 0;
};

template <int N>
ChiSquareDrop chi_square_drop(const Eigen::Matrix<double, N, N>& information,
                              const Eigen::Matrix<double, N, 1>& gradient) {
  constexpr double kRank = 1e-9;  // What rounding leaves of directions that nothing tells.
  const auto axes = axes_of(information);
  ChiSquareDrop out;
  for (Eigen::Index k = 0; k < gradient.size(); ++k) {
    const double told = axes.values(k);
    if (!(told > kRank * axes.values.maxCoeff())) continue;
    out.chi += std::pow(axes.vectors.col(k).dot(gradient), 2) / told;
    ++out.freedom;
  }
  return out;
}

// Ways in which an extrinsic may differ from scene to scene, tried one by one.
class Motions {
 public:
  explicit Motions(std::vector<SceneInformation> scenes) : scenes_(std::move(scenes)) {
    for (const SceneInformation& scene : scenes_) {
      const ChiSquareDrop one = chi_square_drop(scene.information, scene.gradient);
      free_.chi += one.chi;
      free_.freedom += one.freedom;
    }
    common_ = of([](std::size_t) { return true; });
  }

  // Both the scenes from `first` to before `last` and the others determine the extrinsic.
  [[nodiscard]] bool told(std::size_t first, std::size_t last) const {
    const auto inside = [&](std::size_t s) { return s >= first && s < last; };
    return of(inside).freedom == 6 && of([&](std::size_t s) { return !inside(s); }).freedom == 6;
  }

  // Scenes from `first` to before `last` have an extrinsic of their own.
  [[nodiscard]] double apart(std::size_t first, std::size_t last) const {
    const auto inside = [&](std::size_t s) { return s >= first && s < last; };
    const ChiSquareDrop in = of(inside);
    const ChiSquareDrop out = of([&](std::size_t s) { return !inside(s); });
    // Both sides must determine the extrinsic, else it is not the whole of it that differs.
    if (in.freedom < 6 || out.freedom < 6) return 1.0;
    return chance(in.chi + out.chi);
  }

  // It changes in proportion to something that is known of each scene.
  [[nodiscard]] double along(const std::vector<double>& known) const {
    const auto [information, gradient] = with_rate(known);
    const ChiSquareDrop both = chi_square_drop(information, gradient);
    return both.freedom < 12 ? 1.0 : chance(both.chi);
  }

  // By so much per unit of it.
  [[nodiscard]] Vector6d rate(const std::vector<double>& known) const {
    const auto [information, gradient] = with_rate(known);
    return information.ldlt().solve(gradient).tail<6>();
  }

 private:
  // Of the extrinsic at zero and its rate.
  [[nodiscard]] std::pair<Eigen::MatrixXd, Eigen::VectorXd> with_rate(
      const std::vector<double>& known) const {
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(12, 12);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(12);
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      Eigen::Matrix<double, 6, 12> by;
      by << Matrix6d::Identity(), known[s] * Matrix6d::Identity();
      information += by.transpose() * scenes_[s].information * by;
      gradient += by.transpose() * scenes_[s].gradient;
    }
    return {information, gradient};
  }

  template <class Which>
  [[nodiscard]] ChiSquareDrop of(const Which& which) const {
    SceneInformation sum{Matrix6d::Zero(), Vector6d::Zero()};
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (!which(s)) continue;
      sum.information += scenes_[s].information;
      sum.gradient += scenes_[s].gradient;
    }
    return chi_square_drop(sum.information, sum.gradient);
  }

  // F-test of six more numbers against what scenes differ by beyond them: an effect that is missing
  // makes all differ, a motion makes two groups of scenes that agree.
  [[nodiscard]] double chance(double chi) const {
    const int freedom = free_.freedom - 12;
    if (freedom < 6) return 1.0;
    const double explained = std::max(0.0, chi - common_.chi) / 6.0;
    // Not less than noise: that of few scenes may be small by chance.
    const double left = std::max(1.0, (free_.chi - chi) / freedom);
    return f_tail(6, freedom, explained / left);
  }

  std::vector<SceneInformation> scenes_;
  ChiSquareDrop free_, common_;
};

}  // namespace

bool agrees_with_others(const ForwardSolution& forward, std::size_t scene,
                        const QualityOptions& options) {
  constexpr double kChance = 0.001;  // As unlikely as what is called a motion.
  std::vector<SceneInformation> told;
  for (const GlobalTerm& term : forward.terms) {
    if (!term.usable) return false;
    told.push_back({term.information.topLeftCorner<6, 6>(), term.gradient.head<6>()});
  }
  const Motions motions(std::move(told));
  if (!motions.told(scene, scene + 1)) return false;
  if (!(motions.apart(scene, scene + 1) < kChance)) return true;
  std::vector<bool> own(forward.terms.size(), false);
  own[scene] = true;
  std::vector<bool> others = own;
  others.flip();
  const auto one = solve_subset(forward, own);
  const auto rest = solve_subset(forward, others);
  return one && rest &&
         translation_distance_m(one->transform.inverse(), rest->transform.inverse()) <=
             options.tolerance_m &&
         rotation_distance_rad(one->transform, rest->transform) <= options.tolerance_rad;
}

void judge_bump(const CalibrationResult& result, Verdict& verdict) {
  if (!result.forward) return;
  const std::vector<std::size_t> in_use = scenes_in_use(result.extrinsic);
  const std::vector<SceneInformation> told = scene_information(result);
  const std::size_t n = in_use.size();
  if (n < 3 || told.size() != n) return;
  const auto name_of = [&](std::size_t k) { return result.extrinsic.scenes[in_use[k]].name; };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return name_of(a) < name_of(b); });
  std::vector<SceneInformation> in_order;
  std::vector<double> clock;  // From 0 to 1.
  std::vector<double> distance_m;
  for (const std::size_t k : order) {
    in_order.push_back(told[k]);
    clock.push_back(static_cast<double>(clock.size()) / static_cast<double>(n - 1));
    distance_m.push_back(result.extrinsic.scenes[in_use[k]].camera_from_board.translation.norm());
  }
  const Motions motions(std::move(in_order));
  // Between any two scenes, in any one scene, or steadily; one in a thousand together. Scenes are
  // often taken from near to far: what goes by the distance as well is an effect, and no motion.
  double least =
      std::min(0.001 / static_cast<double>((n - 1) + (n - 2) + 1), motions.along(distance_m));
  std::size_t first = 0;
  std::size_t last = 0;
  const auto ask = [&](std::size_t from, std::size_t to) {
    const double p = motions.apart(from, to);
    if (p >= least) return;
    least = p;
    first = from;
    last = to;
  };
  for (std::size_t k = 1; k < n; ++k) ask(k, n);
  for (std::size_t k = 1; k + 1 < n; ++k) ask(k, k + 1);
  const QualityOptions& q = result.options.quality;
  if (motions.along(clock) < least) {
    const Vector6d way = motions.rate(clock);
    const Rigid3& mean = result.extrinsic.camera_from_lidar.transform;
    const Rigid3 end = se3_exp(way) * mean;
    const double move_m = translation_distance_m(mean.inverse(), end.inverse());
    const double move_rad = rotation_distance_rad(mean, end);
    if (move_m < q.tolerance_m && move_rad < q.tolerance_rad) return;
    verdict.doubtful(
        Message("the extrinsic moves steadily from scene to scene, by %1 mm and %2 mrad from the "
                "first to the last: does a mount give way?",
                formatted("%.1f", 1e3 * move_m), formatted("%.2f", 1e3 * move_rad)));
    return;
  }
  if (last == 0) return;
  const SubsetSolver subset = subsets_of(result);
  const bool one = last < n;  // A scene between others.
  std::vector<std::size_t> apart;
  std::vector<std::size_t> others;
  std::vector<std::string> names[2];
  for (std::size_t k = 0; k < n; ++k) {
    const bool inside = k >= first && k < last;
    (inside ? apart : others).push_back(in_use[order[k]]);
    names[inside ? 1 : 0].push_back(name_of(order[k]));
  }
  const auto before = subset(others);
  const auto after = subset(apart);
  if (!before || !after) return;
  const double move_m =
      translation_distance_m(before->transform.inverse(), after->transform.inverse());
  const double move_rad = rotation_distance_rad(before->transform, after->transform);
  if (move_m < q.tolerance_m && move_rad < q.tolerance_rad) return;
  verdict.doubtful(
      one ? Message("scene %1 contradicts the others, which agree: it puts the LiDAR %2 mm and %3 "
                    "mrad elsewhere; did the board or a sensor move while it was taken?",
                    name_of(order[first]), formatted("%.1f", 1e3 * move_m),
                    formatted("%.2f", 1e3 * move_rad))
          : describe_bump({names[0], before->transform}, {names[1], after->transform},
                          name_of(order[first - 1]), name_of(order[first])));
}

bool judge_scans(const CalibrationResult& result, const QualityOptions& q, Verdict& verdict) {
  if (!result.forward || result.model_fit) return false;
  const UncertainRigid3& solved = result.extrinsic.camera_from_lidar;
  const double sigma_m = std::sqrt(solved.covariance.topLeftCorner<3, 3>().trace());
  const double sigma_rad = std::sqrt(solved.covariance.bottomRightCorner<3, 3>().trace());
  const std::vector<std::size_t> in_use = scenes_in_use(result.extrinsic);
  // A print of another size leaves what angles or another origin would mend a little.
  const bool scaled = print_is_scaled(result, q);
  bool told = false;
  for (const ScanFault& fault : result.forward->scan_faults) {
    if (scaled &&
        (fault.kind == ScanFault::Kind::kAngles || fault.kind == ScanFault::Kind::kOrigin))
      continue;
    const Rigid3 moved = se3_exp(fault.move) * solved.transform;
    const double move_m = translation_distance_m(moved.inverse(), solved.transform.inverse());
    const double move_rad = rotation_distance_rad(moved, solved.transform);
    const bool matters = move_m > std::max(q.tolerance_m, q.tolerance_sigmas * sigma_m) ||
                         move_rad > std::max(q.tolerance_rad, q.tolerance_sigmas * sigma_rad);
    if (!fault.is_there() || !matters) continue;
    told = true;
    const std::string move_mm = formatted("%.1f", 1e3 * move_m);
    const std::string move_mrad = formatted("%.2f", 1e3 * move_rad);
    if (fault.kind == ScanFault::Kind::kLag) {
      verdict.doubtful(Message(
          "the print lies displaced along the scan, by %1 µs of it; with that the extrinsic moves "
          "by %2 mm and %3 mrad: intensity or angle is read too late; find the effect with lvcalib "
          "discover",
          formatted("%.2f ± %.2f", 1e6 * std::abs(fault.size), 1e6 * fault.sigma), move_mm,
          move_mrad));
      continue;
    }
    if (fault.kind == ScanFault::Kind::kAngles) {
      verdict.doubtful(
          Message("the LiDAR's angles do not fit the boards (scale, eccentric encoder or tilted "
                  "axis); with that the extrinsic moves by %1 mm and %2 mrad: find the effect with "
                  "lvcalib discover",
                  move_mm, move_mrad));
      continue;
    }
    const std::string size = formatted("%.1f ± %.1f", 1e3 * fault.size, 1e3 * fault.sigma);
    if (fault.kind == ScanFault::Kind::kOrigin) {
      verdict.doubtful(
          Message("the LiDAR's beams start beside the origin of its frame, by %1 mm; with that the "
                  "extrinsic moves by %2 mm and %3 mrad: are the clouds in another frame, as a "
                  "vehicle's? if not, find the effect with lvcalib discover",
                  size, move_mm, move_mrad));
      continue;
    }
    const bool one = fault.scene && *fault.scene < in_use.size();
    verdict.doubtful(
        one ? Message("the board moves against the LiDAR while it scans, in scene %1, by %2 mm/s; "
                      "with that the extrinsic moves by %3 mm and %4 mrad; let board and rig rest, "
                      "or find the effect with lvcalib discover",
                      result.extrinsic.scenes[in_use[*fault.scene]].name, size, move_mm, move_mrad)
            : Message("the board moves against the LiDAR while it scans, in all scenes alike, by "
                      "%1 mm/s; with that the extrinsic moves by %2 mm and %3 mrad; let board and "
                      "rig rest, or find the effect with lvcalib discover",
                      size, move_mm, move_mrad));
  }
  return told;
}

void judge_splits(const CalibrationResult& result, Verdict& verdict) {
  for (const SplitHalf& split : result.uncertainty.splits) {
    if (split.agrees()) continue;
    verdict.doubtful(Message(
        "the halves of the scenes (%1) differ by %2 mm and %3 mrad, more than noise explains (χ² "
        "%4, at most %5): an effect is missing in the model, or one scene is off",
        split.name, formatted("%.1f", split.translation_mm), formatted("%.1f", split.rotation_mrad),
        formatted("%.0f", split.chi_square), formatted("%.0f", split.gate)));
  }
}

// Without a second one the best extrinsic by other places has the evidence of one scene, of two
// scenes half of all; with one it has nearly all.
void judge_second_board(const CalibrationResult& result, Verdict& verdict) {
  constexpr double kMostOfIt = 0.75;  // Half way between the two.
  const SceneConsensus& consensus = result.consensus;
  if (consensus.agreeing < fewest_agreeing(hypotheses(result), consensus) ||
      !(consensus.score > 0.0))
    return;
  const double share = consensus.elsewhere / consensus.score;
  if (share < kMostOfIt) return;
  verdict.doubtful(
      Message("the clouds hold a second board with this print: another extrinsic has %1 % of the "
              "evidence of this one; take one of the boards away, or give a rough extrinsic with "
              "--init",
              formatted("%.0f", 100.0 * share)));
}

// What localization states holds a systematic part besides its noise, so that nothing but another
// place reaches the gate; added effects may move the extrinsic on purpose.
void judge_place(const CalibrationResult& result, Verdict& verdict) {
  const UncertainRigid3& localized = result.consensus.camera_from_lidar;
  if (!result.model.empty() || !(localized.covariance.diagonal().minCoeff() > 0.0)) return;
  const UncertainRigid3& solved = result.extrinsic.camera_from_lidar;
  const Vector6d move = se3_log(solved.transform * localized.transform.inverse());
  const Matrix6d spread = localized.covariance + solved.covariance;
  // One in ten thousand, as where scenes are compared.
  if (!(squared_mahalanobis(move, spread) > chi_square_gate(6, 1e-4))) return;
  verdict.doubtful(Message(
      "the joint solve puts the LiDAR %1 mm and %2 mrad from where the localized boards put it, "
      "more than both leave open: it may have locked onto another place of the print; add scenes "
      "with the board turned differently",
      formatted("%.0f", 1e3 * translation_distance_m(solved.transform.inverse(),
                                                     localized.transform.inverse())),
      formatted("%.1f", 1e3 * rotation_distance_rad(solved.transform, localized.transform))));
}

}  // namespace lvcalib
