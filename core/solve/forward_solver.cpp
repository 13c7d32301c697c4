// SPDX-License-Identifier: BSD-3-Clause
#include "solve/forward_solver.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/paired_moments.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

// While the poses are still off by millimetres the print is seen through at least this blur.
constexpr double kCoarseBlur_m = 0.008;
// Rows per scene until the end is near; all of them then.
constexpr std::size_t kEarlyRows = 6000;
// While the print is blurred on purpose fewer tell as much as it can.
constexpr std::size_t kCoarseRows = 2000;
constexpr int kCoarseIterations = 6;
// Of re-estimating the shared errors' variances within one linearization; they go on in the next.
constexpr int kVarianceRounds = 12;
// Of estimating the motions of boards, once, to the end.
constexpr int kBoardRounds = 60;
// An error of the whole sensor is nearly a move of the LiDAR: taken in by chance it costs most of
// what ranges say about the extrinsic, some ten standard deviations, where errors of single scenes
// cost next to nothing. So a tenth of the chance.
constexpr double kSensorChance = 0.1;
// Gauss–Newton that converges does better than this.
constexpr double kShrinks = 0.5;
// One error counts as one, rounding aside.
constexpr double kOneError = 0.999;

// What the solve is given, and how it runs.
struct ForwardRun : ForwardInput {
  const ForwardOptions& options;
  const RunContext& context;
};

// Where the iteration stands.
struct Iteration {
  ForwardState state;
  ForwardNoise noise;
  std::vector<BoardReturns> returns;
  std::vector<std::vector<LocalPrint>> seen;  // The print as each return saw it last.
  std::vector<bool> print_unseen;             // Per scene, once the print was looked for.
  std::vector<SceneFit> fits;
  std::vector<SceneEquations> equations;
  SensorErrors before;  // At the linearization of `equations`.
  GlobalPrior prior;
  GlobalSolution last;
  ForwardSolution solution;  // What else is known of it.
};

Iteration started(const ForwardRun& in) {
  Iteration it;
  it.state.camera = in.options.first_camera.value_or(in.camera);
  it.state.camera_from_lidar = in.camera_from_lidar;
  it.noise.shared = kAbsentShared;
  it.noise.corner_px = std::max(in.options.sigma_px_floor, in.corner_sigma_px);
  it.solution.scenes.resize(in.scenes.size());
  const double blur = in.options.first_blur_rad * in.options.first_blur_rad;
  it.state.beam.blur_rad2 = blur * Eigen::Matrix2d::Identity();
  it.state.beam.jitter_rad2 = 0.1 * blur * Eigen::Matrix2d::Identity();
  for (const ForwardScene& scene : in.scenes) {
    it.state.camera_from_board.push_back(scene.camera_from_board);
    it.state.levels.push_back({});
    it.state.shared.emplace_back();
    SceneNoise n;
    n.range_white_m = n.range_black_m = scene.range_sigma_m;
    it.noise.scenes.push_back(n);
  }
  return it;
}

// Planes alone leave a board's place in its plane to what all of them say together: what may lie
// beyond its edge there is left out. Its outline was found, so that most of it is on the board.
double place_margin_m(const BoardOutline& outline, const Rigid3& board,
                      const Eigen::MatrixXd& covariance_of_globals) {
  constexpr double kSigmas = 3.0;  // As for the spot: one in four hundred lies beyond.
  constexpr double kMost = 0.25;   // Of the shorter side.
  const double most = kMost * outline.size_m().minCoeff();
  if (covariance_of_globals.rows() < 6) return most;
  const Eigen::Vector2d c = outline.center_m();
  const Eigen::Vector3d middle = board * Eigen::Vector3d(c.x(), c.y(), 0.0);
  Eigen::Matrix<double, 3, 6> moved;
  moved << Eigen::Matrix3d::Identity(), -skew(middle);
  const Eigen::Matrix<double, 2, 6> in_plane =
      board.rotation.toRotationMatrix().leftCols<2>().transpose() * moved;
  const Eigen::Matrix2d covariance =
      in_plane * covariance_of_globals.topLeftCorner<6, 6>() * in_plane.transpose();
  return std::min(most, kSigmas * std::sqrt(std::max(0.0, covariance.trace())));
}

// The returns on each board; false if there are none on any. `settled`: the boards lie where they
// are, so that what stands out is something else.
bool select(const ForwardRun& in, Iteration& it, bool settled) {
  it.returns.resize(in.scenes.size());
  ReturnSelection how = in.options.selection;
  how.covers = how.covers && settled;
  parallel_for(in.scenes.size(), in.context.thread_count(), [&](std::size_t s) {
    const SceneNoise& n = it.noise.scenes[s];
    ReturnSelection here = how;
    here.uncovered = in.scenes[s].uncovered;
    if (settled && !it.returns[s].has_intensity)
      here.place_m =
          place_margin_m(in.print.outline(), it.state.camera_from_board[s], it.last.covariance);
    it.returns[s] =
        select_returns(*in.scenes[s].board_points, in.print, it.state.lidar_from_board(s),
                       it.state.beam, {n.range_white_m, n.range_black_m}, here);
  });
  it.seen.clear();
  for (const BoardReturns& r : it.returns) it.seen.emplace_back(r.size());
  // What does not show the print tells nothing of its place.
  for (std::size_t s = 0; s < it.print_unseen.size(); ++s) {
    if (it.print_unseen[s]) it.returns[s].has_intensity = false;
  }
  it.solution.uses_intensity = std::any_of(it.returns.begin(), it.returns.end(),
                                           [](const auto& r) { return r.has_intensity; });
  return std::any_of(it.returns.begin(), it.returns.end(),
                     [](const BoardReturns& r) { return r.size() > 0; });
}

// The blurs that most spots will ask for, made on all cores; others are made when they are asked
// for.
void prepare_print(const ForwardRun& in, const ForwardState& state) {
  double nearest = 1e9;
  double farthest = 0.0;
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    const double range = state.lidar_from_board(s).translation.norm();
    nearest = std::min(nearest, range);
    farthest = std::max(farthest, range);
  }
  in.print.prepare(0.6 * in.options.first_blur_rad * nearest,
                   0.8 * in.options.first_blur_rad * farthest, in.context.thread_count());
}

// Where the prints put the boards, before anything else is asked of them.
bool match(const ForwardRun& in, Iteration& it) {
  const auto vote = vote_on_print(it.returns, in.print, it.state.camera_from_board,
                                  it.state.camera_from_lidar, in.options.search, in.context);
  if (!vote) return false;
  it.state.camera_from_lidar = vote->camera_from_lidar;
  it.solution.lattice_margin = vote->margin;
  it.print_unseen.assign(in.scenes.size(), false);
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    ForwardSceneResult& scene = it.solution.scenes[s];
    scene.print_correlation = vote->scenes[s].correlation;
    scene.print_margin = vote->scenes[s].margin;
    it.print_unseen[s] = vote->scenes[s].unseen;
    if (!it.returns[s].has_intensity) continue;
    scene.intensity_structure = intensity_structure(it.returns[s]);
    scene.saturated = it.returns[s].saturated;
  }
  return true;
}

// Levels by regression of the intensities on the coarse print.
void first_levels(const ForwardRun& in, Iteration& it) {
  const BlurredPrint::Coarse print = in.print.coarse(kCoarseBlur_m);
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    // Of a print that is not seen nobody knows what it does to ranges: it is plain.
    if (!it.returns[s].has_intensity) {
      it.state.levels[s] = {.white = 1.0, .black = 1.0};
      continue;
    }
    const BoardPredictor predictor(in.print, it.state.lidar_from_board(s), {}, {});
    PairedMoments m;
    const std::size_t stride = std::max<std::size_t>(1, it.returns[s].size() / kEarlyRows);
    for (std::size_t k = 0; k < it.returns[s].size(); k += stride) {
      const auto hit = predictor.hit(it.returns[s].point_m(k).normalized());
      if (hit) m.add(print.at(hit->board_m), it.returns[s].intensity(k));
    }
    if (m.n < 3) continue;
    BoardLevels& levels = it.state.levels[s];
    levels.black = (m.y - m.slope() * m.x) / m.n;
    levels.white = levels.black + m.slope();
    const double rest = std::max(1e-12, (m.y_squares() - m.slope() * m.products()) / m.n);
    it.noise.scenes[s].intensity_white = it.noise.scenes[s].intensity_black = std::sqrt(rest);
  }
}

LinearizationOptions early_rows(const ForwardOptions& options,
                                const std::vector<BoardReturns>& returns, std::size_t rows) {
  LinearizationOptions how;
  how.shared_errors = false;
  std::size_t most = 1;
  for (const BoardReturns& r : returns) most = std::max(most, (r.size() + rows - 1) / rows);
  how.stride = most;
  how.robust_threshold = options.robust_threshold;
  how.patch_m = options.patch_m;
  return how;
}

LinearizationOptions final_rows(const ForwardOptions& options) {
  LinearizationOptions how;
  how.robust_threshold = options.robust_threshold;
  how.patch_m = options.patch_m;
  return how;
}

GlobalPrior global_prior(const ForwardRun& in, const Camera& now, bool free_blur,
                         bool free_intrinsics) {
  GlobalPrior prior;
  // Wide: any beam is narrower than 10 mrad; keeps a blur that no edge shows where it is.
  if (free_blur) prior.sigma.segment<kBlurParameters>(6).setConstant(0.01);
  if (free_intrinsics) {
    prior.sigma.segment<kIntrinsics>(kFirstIntrinsic) = in.options.intrinsics_sigma;
    prior.offset.segment<kIntrinsics>(kFirstIntrinsic) << now.fx - in.camera.fx,
        now.fy - in.camera.fy, now.cx - in.camera.cx, now.cy - in.camera.cy,
        now.distortion - in.camera.distortion;
  }
  if (const auto& evidence = in.options.intrinsics_evidence) {
    Eigen::Matrix<double, kIntrinsics, 1> moved;
    moved << now.fx - evidence->at.fx, now.fy - evidence->at.fy, now.cx - evidence->at.cx,
        now.cy - evidence->at.cy, now.distortion - evidence->at.distortion;
    prior.evidence = evidence->information;
    prior.evidence_gradient = evidence->gradient - evidence->information * moved;
  }
  return prior;
}

void apply(const GlobalSolution& step, Iteration& it) {
  // A step beyond a decimetre or six degrees comes from a linearization that no longer holds.
  double scale = 1.0;
  const auto limit = [&](const Vector6d& xi) {
    scale = std::min({scale, 0.1 / std::max(1e-12, xi.head<3>().norm()),
                      0.1 / std::max(1e-12, xi.tail<3>().norm())});
  };
  limit(step.globals.head<6>());
  it.state.camera_from_lidar =
      se3_exp(scale * Vector6d(step.globals.head<6>())) * it.state.camera_from_lidar;
  Eigen::Vector3d factor = blur_factor(it.state.beam.blur_rad2);
  const Eigen::Vector3d change = scale * step.globals.segment<kBlurParameters>(6);
  const Eigen::VectorXd intrinsics = scale * step.globals.segment<kIntrinsics>(kFirstIntrinsic);

  Camera& camera = it.state.camera;
  camera.fx += intrinsics(0);
  camera.fy += intrinsics(1);
  camera.cx += intrinsics(2);
  camera.cy += intrinsics(3);
  camera.distortion += intrinsics.tail<8>();
  // Widths change by half at most in one step.
  const double most = 0.5 * factor.cwiseAbs().maxCoeff();
  factor += change * std::min(1.0, most / std::max(1e-15, change.norm()));
  factor(0) = std::max(std::abs(factor(0)), 1e-5);
  factor(2) = std::max(std::abs(factor(2)), 1e-5);
  it.state.beam.blur_rad2 = blur_from_factor(factor);
  const Eigen::Index sensor = step.globals.size() - kGlobals;
  it.before = it.state.sensor;
  if (sensor > 0) {
    if (it.state.sensor.values.size() != sensor)
      it.state.sensor.values = Eigen::VectorXd::Zero(sensor);
    it.state.sensor.values += scale * step.globals.tail(sensor);
  }
  for (std::size_t s = 0; s < it.state.levels.size(); ++s) {
    if (step.scenes[s].size() == 0) continue;
    const Eigen::VectorXd local = scale * step.scenes[s].head(kLocals);
    it.state.camera_from_board[s] =
        se3_exp(Vector6d(local.head<6>())) * it.state.camera_from_board[s];
    BoardLevels& levels = it.state.levels[s];
    levels.white += local(6);
    levels.black += local(7);
    levels.slope += local.tail<2>();
    const Eigen::Index shared = step.scenes[s].size() - kLocals;
    if (shared == 0) continue;
    if (it.state.shared[s].size() != shared) it.state.shared[s] = Eigen::VectorXd::Zero(shared);
    it.state.shared[s] += scale * step.scenes[s].tail(shared);
  }
}

// MacKay's fixed point σ² = uᵀu/γ, equal to restricted maximum likelihood where it stands still.
// `boards`: for the motions of boards alone, or for all else.
bool update_shared(const GlobalSolution& step, bool boards, ForwardNoise& noise) {
  bool moved = false;
  for (std::size_t k = 0; k < kSharedErrors; ++k) {
    if (boards != moves_board(k) || !noise.admitted[k] || step.determined[k] < 0.02) continue;
    const double wanted = step.squares[k] / step.determined[k];
    const double bounded = std::clamp(wanted, 0.05 * noise.shared[k], 20.0 * noise.shared[k]);
    const double next = std::max(bounded, kAbsentShared[k]);
    moved = moved || std::abs(std::log(next / noise.shared[k])) > 0.03;
    noise.shared[k] = next;
  }
  return moved;
}

// Score test: with a variance near nothing, T = (Σ score²)/(Σ information) = Σu²/(D·γ) is one on
// average if there is no such error, and n·T about χ² with n the number of errors that count.
// The clearest kind enters; the others are asked again with it in.
bool admit_shared(const GlobalSolution& step, bool boards, double false_alarm,
                  ForwardNoise& noise) {
  std::size_t best = kSharedErrors;
  double largest = 1.0;
  // Where lines are off each by its own, so is their mean, and the price has been paid.
  const bool lines = noise.admitted[static_cast<std::size_t>(SharedError::kSensorLine)];
  const auto costly = [&](std::size_t k) {
    return k >= kSceneErrors &&
           !(lines && k == static_cast<std::size_t>(SharedError::kSensorRange));
  };
  for (std::size_t k = 0; k < kSharedErrors; ++k) {
    if (boards != moves_board(k) || noise.admitted[k] || step.effective[k] < kOneError) continue;
    const double n = step.effective[k];
    const double t = step.squares[k] / (noise.shared[k] * step.determined[k]);
    const double chance = false_alarm * (costly(k) ? kSensorChance : 1.0);
    const double gate = chi_square_gate(static_cast<int>(std::lround(n)), chance) / n;
    if (t / gate > largest) {
      largest = t / gate;
      best = k;
    }
  }
  if (best == kSharedErrors) return false;
  noise.admitted[best] = true;
  // From where half of it would be told: the fixed point is there within a few rounds.
  const double share = step.determined[best] / step.effective[best];
  noise.shared[best] = std::max(noise.shared[best], noise.shared[best] / std::max(share, 1e-12));
  return true;
}

void update_noise(double sigma_px_floor, Iteration& it) {
  JitterRegression jitter;
  double corner = 0.0;
  double rows = 0.0;
  double groups = 0.0;
  for (std::size_t s = 0; s < it.fits.size(); ++s) {
    it.noise.scenes[s] = it.fits[s].noise;
    jitter.add(it.fits[s].jitter);
    corner += it.fits[s].corner_squares;
    rows += static_cast<double>(it.fits[s].corner_rows);
    groups += 6.0;
  }
  if (const auto found = jitter.jitter_rad2(it.state.beam.blur_rad2))
    it.state.beam.jitter_rad2 = *found;
  if (rows > groups + 1.0) {
    it.noise.corner_px =
        std::max(sigma_px_floor, it.noise.corner_px * std::sqrt(corner / (rows - groups)));
  }
}

// The equations about the state as it is; the iteration keeps how well the scenes fit.
std::vector<SceneEquations> linearized(const ForwardRun& in, Iteration& it,
                                       const LinearizationOptions& how) {
  LinearizedScenes out = linearize_scenes({in.scenes, it.returns, in.print, it.state, it.noise},
                                          how, it.seen, in.context.thread_count());
  it.fits = std::move(out.fits);
  return std::move(out.equations);
}

// One Gauss–Newton step; the size of the extrinsic's move in its σ.
std::optional<double> iterate(const ForwardRun& in, Iteration& it, const LinearizationOptions& how,
                              bool free_blur) {
  if (in.context.stopped()) return std::nullopt;
  ++it.solution.iterations;
  const std::vector<SceneEquations> equations = linearized(in, it, how);
  it.prior = global_prior(in, it.state.camera, free_blur, how.stride == 1);
  GlobalSolution step =
      solve_equations(equations, it.prior, it.state.sensor, it.noise.shared,
                      {BoardMotion::kWidens, how.shared_errors, in.context.thread_count()});
  if (!step.solvable) return std::nullopt;
  if (how.shared_errors) {
    for (int round = 0; round < kVarianceRounds; ++round) {
      const bool moved = update_shared(step, false, it.noise);
      if (!moved && !admit_shared(step, false, in.options.false_alarm, it.noise)) break;
      step = solve_equations(equations, it.prior, it.state.sensor, it.noise.shared,
                             {BoardMotion::kWidens, true, in.context.thread_count()});
      if (!step.solvable) return std::nullopt;
    }
    it.equations = std::move(equations);
  }
  apply(step, it);
  update_noise(in.options.sigma_px_floor, it);
  it.last = std::move(step);
  const double squares =
      squared_mahalanobis<6>(it.last.globals.head<6>(), it.last.covariance.topLeftCorner<6, 6>());
  return std::sqrt(std::max(0.0, squares / 6.0));
}

double mean_range_m(const ForwardState& state) {
  double sum = 0.0;
  for (std::size_t s = 0; s < state.camera_from_board.size(); ++s)
    sum += state.lidar_from_board(s).translation.norm();
  return sum / static_cast<double>(state.camera_from_board.size());
}

bool coarse(const ForwardRun& in, Iteration& it) {
  const Eigen::Matrix2d natural = it.state.beam.blur_rad2;
  // Without intensities nobody would bring it back.
  const double wide =
      it.solution.uses_intensity ? std::pow(kCoarseBlur_m / mean_range_m(it.state), 2) : 0.0;
  it.state.beam.blur_rad2 =
      natural + std::max(0.0, wide - natural(0, 0)) * Eigen::Matrix2d::Identity();
  for (int i = 0; i < kCoarseIterations; ++i) {
    const auto step = iterate(in, it, early_rows(in.options, it.returns, kCoarseRows), false);
    if (!step) return false;
    if (*step < 0.3) break;
  }
  return true;
}

// The lines that have an offset of their own in all scenes.
std::vector<std::uint16_t> lines_with_offset(const std::vector<BoardReturns>& returns) {
  std::map<std::uint16_t, std::size_t> rows;
  for (const BoardReturns& r : returns) {
    if (r.cloud == nullptr || !r.cloud->has_line()) continue;
    for (const std::uint32_t i : r.index) ++rows[r.cloud->line[i]];
  }
  std::vector<std::uint16_t> out;
  for (const auto& [line, count] : rows) {
    if (count >= kLineRows) out.push_back(line);
  }
  if (out.size() < 2) out.clear();
  return out;
}

bool fine(const ForwardRun& in, Iteration& it) {
  int rounds_left = in.options.max_iterations;
  // Few rows until the state stands still, then all of them, with shared errors.
  double last = HUGE_VAL;
  for (; rounds_left > 1; --rounds_left) {
    const auto step = iterate(in, it, early_rows(in.options, it.returns, kEarlyRows), true);
    if (!step) return false;
    // Where steps hardly shrink any more it is shared errors that are missing.
    if (*step < 0.5 || *step > kShrinks * last) break;
    last = *step;
  }
  if (!select(in, it, true)) return false;
  it.state.sensor.lines = lines_with_offset(it.returns);
  // Freed intrinsics take out of the corners' noise what it held of their errors, and each step is
  // small beside what is left of that.
  constexpr double kNoiseStands = 0.1;  // Of its logarithm.
  const bool freed = (in.options.intrinsics_sigma.array() > 0.0).any();
  last = HUGE_VAL;
  for (; rounds_left > 0; --rounds_left) {
    const double noise_px = it.noise.corner_px;
    const auto step = iterate(in, it, final_rows(in.options), true);
    if (!step) return false;
    const bool noise_stands =
        !freed || std::abs(std::log(it.noise.corner_px / noise_px)) < kNoiseStands;
    // What is still to come of steps that shrink by a ratio q: the last one's q/(1 − q).
    const double ratio = *step / last;
    const double left = ratio > 0.0 && ratio < kShrinks ? *step * ratio / (1.0 - ratio) : HUGE_VAL;
    if (noise_stands && std::min(*step, left) < in.options.tolerance) {
      it.solution.converged = true;
      break;
    }
    last = *step;
  }
  return true;
}

// How far boards move between camera and LiDAR, all else as it was found; and how well each kind of
// motion is determined.
SharedVariances measure_board_motion(const ForwardRun& in, Iteration& it) {
  SharedVariances determined{};
  for (int round = 0; round < kBoardRounds; ++round) {
    const GlobalSolution step =
        solve_equations(it.equations, it.prior, it.before, it.noise.shared,
                        {BoardMotion::kWeighed, true, in.context.thread_count()});
    if (!step.solvable) break;
    for (std::size_t k = 0; k < kSharedErrors; ++k) {
      if (moves_board(k)) determined[k] = step.determined[k];
    }
    const bool moved = update_shared(step, true, it.noise);
    if (!moved && !admit_shared(step, true, in.options.false_alarm, it.noise)) break;
  }
  return determined;
}

// With the noise found at the solution, and with faults that it does not have.
void last_step(const ForwardRun& in, Iteration& it) {
  LinearizationOptions how = final_rows(in.options);
  how.faults = true;
  it.equations = linearized(in, it, how);
  it.prior = global_prior(in, it.state.camera, true, true);
  it.before = it.state.sensor;
  const SharedVariances boards_determined = measure_board_motion(in, it);
  GlobalSolution step = solve_equations(it.equations, it.prior, it.before, it.noise.shared,
                                        {BoardMotion::kWidens, true, in.context.thread_count()});
  if (!step.solvable) return;
  for (std::size_t k = 0; k < kSharedErrors; ++k) {
    if (moves_board(k)) step.determined[k] = boards_determined[k];
  }
  apply(step, it);
  it.last = std::move(step);
}

// As many residuals as tell the corners' noise, the boards' poses taken off.
double corner_freedom(const std::vector<SceneFit>& fits) {
  constexpr double kPose = 6.0;  // Unknowns of one.
  double freedom = 0.0;
  for (const SceneFit& fit : fits)
    freedom += std::max(0.0, static_cast<double>(fit.corner_rows) - kPose);
  return freedom;
}

// ν = 2v²/Var(v), v the trace of the extrinsic's scaled covariance, whose variance comes from
// that of the estimated variances: Var(D) = 2D²/γ, of shared errors and of the corners' noise.
// That of ranges and intensities is told by hundreds of returns.
double satterthwaite(const ForwardRun& in, Iteration& it) {
  constexpr double kStep = 0.2;
  const auto spread = [](const GlobalSolution& s) {
    // Rotations act over some three metres.
    Vector6d unit;
    unit << 1, 1, 1, 3, 3, 3;
    return (unit.asDiagonal() * s.covariance.topLeftCorner<6, 6>() * unit.asDiagonal()).trace();
  };
  const double v = spread(it.last);
  double variance = 0.0;
  const auto add = [&](const std::vector<SceneEquations>& equations, const SharedVariances& shared,
                       double freedom) {
    const GlobalSolution s =
        solve_equations(equations, it.prior, it.before, shared,
                        {BoardMotion::kWidens, false, in.context.thread_count()});
    if (!s.solvable) return;
    const double slope = (spread(s) - v) / kStep;  // By the logarithm of D.
    variance += slope * slope * 2.0 / std::max(1.0, freedom);
  };
  for (std::size_t k = 0; k < kSharedErrors; ++k) {
    if (!it.noise.admitted[k]) continue;
    SharedVariances varied = it.noise.shared;
    varied[k] *= 1.0 + kStep;
    add(it.equations, varied, it.last.determined[k]);
  }
  // With many residuals the rows need not be linearized once more.
  constexpr double kManyCorners = 200.0;  // Student's 97.5 % is the normal one's to a hundredth.
  if (const double freedom = corner_freedom(it.fits); freedom > 0.0 && freedom < kManyCorners) {
    ForwardNoise varied = it.noise;
    varied.corner_px *= std::sqrt(1.0 + kStep);
    const LinearizedScenes rows =
        linearize_scenes({in.scenes, it.returns, in.print, it.state, varied},
                         final_rows(in.options), it.seen, in.context.thread_count());
    add(rows.equations, it.noise.shared, freedom);
  }
  constexpr double kMany = 1e6;
  return variance > 0.0 ? std::min(kMany, 2.0 * v * v / variance) : kMany;
}

PrintSize print_size(const ForwardRun& in, const Iteration& it) {
  std::vector<SceneSize> scenes;
  for (std::size_t s = 0; s < in.scenes.size(); ++s) {
    const ForwardSceneResult& scene = it.solution.scenes[s];
    scenes.push_back({scene.print_size, scene.intensity_left, in.scenes[s].camera_from_board,
                      in.scenes[s].lidar_from_board});
  }
  return print_size_of(scenes, it.state.camera_from_lidar, in.print.outline().center_m());
}

ForwardSolution finished(const ForwardRun& in, Iteration& it) {
  ForwardSolution& out = it.solution;
  const Matrix6d covariance = it.last.covariance.topLeftCorner<6, 6>();
  out.camera_from_lidar = {it.state.camera_from_lidar, covariance};
  const Eigen::Matrix3d by = blur_by_factor(blur_factor(it.state.beam.blur_rad2));
  out.blur_covariance = by * it.last.covariance.block<3, 3>(6, 6) * by.transpose();
  out.dof = satterthwaite(in, it);
  out.terms = it.last.terms;
  // The last step has been taken: what is left of each scene's gradient.
  for (GlobalTerm& term : out.terms) {
    if (term.usable) term.gradient -= term.information * it.last.globals;
  }
  out.prior = it.prior;
  out.prior.set_sensor(it.state.sensor, it.noise.shared);
  out.globals_covariance = it.last.covariance;
  for (const SceneEquations& scene : it.equations)
    out.faults.push_back(fault_term(scene, it.noise.shared, BoardMotion::kWidens));
  out.scan_faults = find_scan_faults(it.equations, it.prior, it.before, it.noise.shared,
                                     in.context.thread_count());
  parallel_for(in.scenes.size(), in.context.thread_count(), [&](std::size_t s) {
    ForwardSceneResult& scene = out.scenes[s];
    const SceneFit& fit = it.fits[s];
    scene.returns = it.returns[s].size();
    scene.on_board = it.returns[s].on_board;
    scene.refused = it.returns[s].refused;
    scene.covered = it.returns[s].covered;
    scene.intensity_left = fit.intensity_variance_share;
    const auto chi = [](double squares, std::size_t rows) {
      return rows > 0 ? std::sqrt(squares / static_cast<double>(rows)) : 0.0;
    };
    scene.range_chi = chi(fit.range_squares, fit.range_rows);
    scene.intensity_chi = chi(fit.intensity_squares, fit.intensity_rows);
    scene.corner_chi = chi(fit.corner_squares, fit.corner_rows);
    scene.noise = fit.noise;
    scene.seen = seen_share(it.returns[s], in.print, it.state.lidar_from_board(s));
    if (it.returns[s].has_intensity && scene.print_correlation > 0.0) {
      scene.print_size = measure_print_size(it.returns[s], in.print, it.state.lidar_from_board(s),
                                            it.state.levels[s], it.state.beam, fit.noise);
    }
  });
  double inflation = 1.0;
  for (const ForwardSceneResult& scene : out.scenes)
    inflation = std::max(inflation, scene.noise.intensity_inflation);
  out.print_size = print_size(in, it);
  out.lattice_margin /= inflation;
  out.state = std::move(it.state);
  out.noise = std::move(it.noise);
  return std::move(out);
}

}  // namespace

std::optional<UncertainRigid3> solve_subset(const ForwardSolution& solution,
                                            const std::vector<bool>& use) {
  std::vector<const GlobalTerm*> terms;
  for (std::size_t s = 0; s < solution.terms.size(); ++s) {
    if (s < use.size() && use[s]) terms.push_back(&solution.terms[s]);
  }
  const auto step = solve_terms(terms, solution.prior);
  if (!step) return std::nullopt;
  return UncertainRigid3{se3_exp(Vector6d(step->step.head<6>())) * solution.state.camera_from_lidar,
                         step->covariance.topLeftCorner<6, 6>()};
}

Result<ForwardSolution> solve_forward(const ForwardInput& input, const ForwardOptions& options,
                                      const RunContext& context) {
  if (input.scenes.empty()) return Error::untrusted(Message("no usable scene is left"));
  const ForwardRun in{input, options, context};
  const auto failure = [&context] {
    if (context.stopped()) return Error::cancelled();
    return Error::untrusted(Message("the joint solve fails on these observations"));
  };
  Iteration it = started(in);
  if (!select(in, it, false)) {
    return Error::untrusted(Message("no LiDAR return lies on the board where the start puts it"),
                            {}, Message("give a rough extrinsic with --init"));
  }
  if (it.solution.uses_intensity) {
    prepare_print(in, it.state);
    if (!match(in, it)) return Error::cancelled();
  }
  if (!select(in, it, false)) return Error::untrusted(Message("no LiDAR return lies on the board"));
  first_levels(in, it);
  if (!coarse(in, it)) return failure();
  if (!select(in, it, true)) return Error::untrusted(Message("no LiDAR return lies on the board"));
  if (!fine(in, it)) return failure();
  if (context.stopped()) return Error::cancelled();
  last_step(in, it);
  return finished(in, it);
}

}  // namespace lvcalib
