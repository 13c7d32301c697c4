// SPDX-License-Identifier: BSD-3-Clause
#include "solve/forward_solver.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Eigenvalues>

#include "base/paired_moments.h"
#include "base/parallel.h"
#include "base/statistics.h"

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

class ForwardSolver {
 public:
  ForwardSolver(const std::vector<ForwardScene>& scenes, const BlurredPrint& print,
                const Camera& camera, const ForwardOptions& options, const RunContext& context)
      : scenes_(scenes), print_(print), given_(camera), options_(options), context_(context) {
    solution_.state.camera = options.first_camera.value_or(camera);
  }

  Result<ForwardSolution> run(const Rigid3& start, double corner_sigma_px) {
    prepare(start, corner_sigma_px);
    if (!select()) {
      return Error::untrusted(Message("no LiDAR return lies on the board where the start puts it"),
                              {}, Message("give a rough extrinsic with --init"));
    }
    if (solution_.uses_intensity) {
      prepare_print();
      if (!match()) return Error::cancelled();
    }
    if (!select()) return Error::untrusted(Message("no LiDAR return lies on the board"));
    first_levels();
    if (!coarse()) return failure();
    if (!select(true)) return Error::untrusted(Message("no LiDAR return lies on the board"));
    if (!fine()) return failure();
    if (context_.stopped()) return Error::cancelled();
    last_step();
    finish();
    return std::move(solution_);
  }

 private:
  ForwardState& state() { return solution_.state; }
  ForwardNoise& noise() { return solution_.noise; }

  Error failure() const {
    if (context_.stopped()) return Error::cancelled();
    return Error::untrusted(Message("the joint solve fails on these observations"));
  }

  void prepare(const Rigid3& start, double corner_sigma_px) {
    state().camera_from_lidar = start;
    noise().shared = kAbsentShared;
    noise().corner_px = std::max(options_.sigma_px_floor, corner_sigma_px);
    solution_.scenes.resize(scenes_.size());
    const double blur = options_.first_blur_rad * options_.first_blur_rad;
    state().beam.blur_rad2 = blur * Eigen::Matrix2d::Identity();
    state().beam.jitter_rad2 = 0.1 * blur * Eigen::Matrix2d::Identity();
    for (const ForwardScene& scene : scenes_) {
      state().camera_from_board.push_back(scene.camera_from_board);
      state().levels.push_back({});
      state().shared.emplace_back();
      SceneNoise n;
      n.range_white_m = n.range_black_m = scene.range_sigma_m;
      noise().scenes.push_back(n);
    }
  }

  // `settled`: the boards lie where they are, so that what stands out is something else.
  bool select(bool settled = false) {
    returns_.resize(scenes_.size());
    ReturnSelection how = options_.selection;
    how.covers = how.covers && settled;
    parallel_for(scenes_.size(), context_.thread_count(), [&](std::size_t s) {
      const SceneNoise& n = noise().scenes[s];
      ReturnSelection here = how;
      if (settled && !returns_[s].has_intensity) here.place_m = place_margin_m(s);
      returns_[s] = select_returns(*scenes_[s].board_points, print_, state().lidar_from_board(s),
                                   state().beam, {n.range_white_m, n.range_black_m}, here);
    });
    seen_.clear();
    for (const BoardReturns& r : returns_) seen_.emplace_back(r.size());
    // What does not show the print tells nothing of its place.
    for (std::size_t s = 0; s < print_unseen_.size(); ++s) {
      if (print_unseen_[s]) returns_[s].has_intensity = false;
    }
    solution_.uses_intensity = std::any_of(returns_.begin(), returns_.end(),
                                           [](const auto& r) { return r.has_intensity; });
    return std::any_of(returns_.begin(), returns_.end(),
                       [](const BoardReturns& r) { return r.size() > 0; });
  }

  // Planes alone leave a board's place in its plane to what all of them say together: what may lie
  // beyond its edge there is left out. Its outline was found, so that most of it is on the board.
  [[nodiscard]] double place_margin_m(std::size_t s) const {
    constexpr double kSigmas = 3.0;  // As for the spot: one in four hundred lies beyond.
    constexpr double kMost = 0.25;   // Of the shorter side.
    const BoardOutline& outline = print_.outline();
    const double most = kMost * outline.size_m().minCoeff();
    if (last_.covariance.rows() < 6) return most;
    const Rigid3& board = solution_.state.camera_from_board[s];
    const Eigen::Vector2d c = outline.center_m();
    const Eigen::Vector3d middle = board * Eigen::Vector3d(c.x(), c.y(), 0.0);
    Eigen::Matrix<double, 3, 6> moved;
    moved << Eigen::Matrix3d::Identity(), -skew(middle);
    const Eigen::Matrix<double, 2, 6> in_plane =
        board.rotation.toRotationMatrix().leftCols<2>().transpose() * moved;
    const Eigen::Matrix2d covariance =
        in_plane * last_.covariance.topLeftCorner<6, 6>() * in_plane.transpose();
    return std::min(most, kSigmas * std::sqrt(std::max(0.0, covariance.trace())));
  }

  // The blurs that most spots will ask for, made on all cores; others are made when they are asked
  // for.
  void prepare_print() const {
    double nearest = 1e9;
    double farthest = 0.0;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const double range = solution_.state.lidar_from_board(s).translation.norm();
      nearest = std::min(nearest, range);
      farthest = std::max(farthest, range);
    }
    print_.prepare(0.6 * options_.first_blur_rad * nearest,
                   0.8 * options_.first_blur_rad * farthest, context_.thread_count());
  }

  // Where the prints put the boards, before anything else is asked of them.
  bool match() {
    const auto vote = vote_on_print(returns_, print_, state().camera_from_board,
                                    state().camera_from_lidar, options_.search, context_);
    if (!vote) return false;
    state().camera_from_lidar = vote->camera_from_lidar;
    solution_.lattice_margin = vote->margin;
    print_unseen_.assign(scenes_.size(), false);
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      ForwardSceneResult& scene = solution_.scenes[s];
      scene.print_correlation = vote->scenes[s].correlation;
      scene.print_margin = vote->scenes[s].margin;
      print_unseen_[s] = vote->scenes[s].unseen;
      if (!returns_[s].has_intensity) continue;
      scene.intensity_structure = intensity_structure(returns_[s]);
      scene.saturated = returns_[s].saturated;
    }
    return true;
  }

  // Levels by regression of the intensities on the coarse print.
  void first_levels() {
    const BlurredPrint::Coarse print = print_.coarse(kCoarseBlur_m);
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      // Of a print that is not seen nobody knows what it does to ranges: it is plain.
      if (!returns_[s].has_intensity) {
        state().levels[s] = {.white = 1.0, .black = 1.0};
        continue;
      }
      const BoardPredictor predictor(print_, state().lidar_from_board(s), {}, {});
      PairedMoments m;
      const std::size_t stride = std::max<std::size_t>(1, returns_[s].size() / kEarlyRows);
      for (std::size_t k = 0; k < returns_[s].size(); k += stride) {
        const auto hit = predictor.hit(returns_[s].point_m(k).normalized());
        if (hit) m.add(print.at(hit->board_m), returns_[s].intensity(k));
      }
      if (m.n < 3) continue;
      BoardLevels& levels = state().levels[s];
      levels.black = (m.y - m.slope() * m.x) / m.n;
      levels.white = levels.black + m.slope();
      const double rest = std::max(1e-12, (m.y_squares() - m.slope() * m.products()) / m.n);
      noise().scenes[s].intensity_white = noise().scenes[s].intensity_black = std::sqrt(rest);
    }
  }

  [[nodiscard]] double mean_range_m() const {
    double sum = 0.0;
    for (std::size_t s = 0; s < scenes_.size(); ++s)
      sum += solution_.state.lidar_from_board(s).translation.norm();
    return sum / static_cast<double>(scenes_.size());
  }

  bool coarse() {
    const Eigen::Matrix2d natural = state().beam.blur_rad2;
    // Without intensities nobody would bring it back.
    const double wide =
        solution_.uses_intensity ? std::pow(kCoarseBlur_m / mean_range_m(), 2) : 0.0;
    state().beam.blur_rad2 =
        natural + std::max(0.0, wide - natural(0, 0)) * Eigen::Matrix2d::Identity();
    for (int i = 0; i < kCoarseIterations; ++i) {
      const auto step = iterate(early_rows(kCoarseRows), false);
      if (!step) return false;
      if (*step < 0.3) break;
    }
    return true;
  }

  bool fine() {
    int rounds_left = options_.max_iterations;
    // Few rows until the state stands still, then all of them, with shared errors.
    double last = HUGE_VAL;
    for (; rounds_left > 1; --rounds_left) {
      const auto step = iterate(early_rows(kEarlyRows), true);
      if (!step) return false;
      // Where steps hardly shrink any more it is shared errors that are missing.
      if (*step < 0.5 || *step > kShrinks * last) break;
      last = *step;
    }
    if (!select(true)) return false;
    list_lines();
    last = HUGE_VAL;
    for (; rounds_left > 0; --rounds_left) {
      const auto step = iterate(final_rows(), true);
      if (!step) return false;
      // What is still to come of steps that shrink by a ratio q: the last one's q/(1 − q).
      const double ratio = *step / last;
      const double left =
          ratio > 0.0 && ratio < kShrinks ? *step * ratio / (1.0 - ratio) : HUGE_VAL;
      if (std::min(*step, left) < options_.tolerance) {
        solution_.converged = true;
        break;
      }
      last = *step;
    }
    return true;
  }

  // The lines that have an offset of their own in all scenes.
  void list_lines() {
    std::map<std::uint16_t, std::size_t> rows;
    for (const BoardReturns& r : returns_) {
      if (r.cloud == nullptr || !r.cloud->has_line()) continue;
      for (const std::uint32_t i : r.index) ++rows[r.cloud->line[i]];
    }
    for (const auto& [line, count] : rows) {
      if (count >= kLineRows) state().sensor.lines.push_back(line);
    }
    if (state().sensor.lines.size() < 2) state().sensor.lines.clear();
  }

  [[nodiscard]] LinearizationOptions early_rows(std::size_t rows) const {
    LinearizationOptions how;
    how.shared_errors = false;
    std::size_t most = 1;
    for (const BoardReturns& r : returns_) most = std::max(most, (r.size() + rows - 1) / rows);
    how.stride = most;
    how.robust_threshold = options_.robust_threshold;
    how.patch_m = options_.patch_m;
    return how;
  }

  [[nodiscard]] LinearizationOptions final_rows() const {
    LinearizationOptions how;
    how.robust_threshold = options_.robust_threshold;
    how.patch_m = options_.patch_m;
    return how;
  }

  // One Gauss–Newton step; the size of the extrinsic's move in its σ.
  std::optional<double> iterate(const LinearizationOptions& how, bool free_blur) {
    if (context_.stopped()) return std::nullopt;
    ++solution_.iterations;
    std::vector<SceneEquations> equations = linearize_scenes(
        scenes_, returns_, print_, state(), noise(), how, context_.thread_count(), fits_, seen_);
    prior_ = global_prior(free_blur, how.stride == 1);
    GlobalSolution step =
        solve_equations(equations, prior_, state().sensor, noise().shared, BoardMotion::kWidens,
                        how.shared_errors, context_.thread_count());
    if (!step.solvable) return std::nullopt;
    if (how.shared_errors) {
      for (int round = 0; round < kVarianceRounds; ++round) {
        const bool moved = update_shared(step);
        if (!moved && !admit_shared(step)) break;
        step = solve_equations(equations, prior_, state().sensor, noise().shared,
                               BoardMotion::kWidens, true, context_.thread_count());
        if (!step.solvable) return std::nullopt;
      }
      equations_ = std::move(equations);
    }
    apply(step);
    update_noise();
    last_ = std::move(step);
    const Eigen::VectorXd move = last_.globals.head<6>();
    const Matrix6d covariance = last_.covariance.topLeftCorner<6, 6>();
    return std::sqrt(std::max(0.0, move.dot(covariance.ldlt().solve(move)) / 6.0));
  }

  [[nodiscard]] GlobalPrior global_prior(bool free_blur, bool free_intrinsics) const {
    GlobalPrior prior;
    // Wide: any beam is narrower than 10 mrad; keeps a blur that no edge shows where it is.
    if (free_blur) prior.sigma.segment<kBlurParameters>(6).setConstant(0.01);
    if (free_intrinsics) {
      prior.sigma.segment<kIntrinsics>(kFirstIntrinsic) = options_.intrinsics_sigma;
      const Camera& now = solution_.state.camera;
      prior.offset.segment<kIntrinsics>(kFirstIntrinsic) << now.fx - given_.fx, now.fy - given_.fy,
          now.cx - given_.cx, now.cy - given_.cy, now.distortion - given_.distortion;
    }
    if (const auto& evidence = options_.intrinsics_evidence) {
      const Camera& now = solution_.state.camera;
      Eigen::Matrix<double, kIntrinsics, 1> moved;
      moved << now.fx - evidence->at.fx, now.fy - evidence->at.fy, now.cx - evidence->at.cx,
          now.cy - evidence->at.cy, now.distortion - evidence->at.distortion;
      prior.evidence = evidence->information;
      prior.evidence_gradient = evidence->gradient - evidence->information * moved;
    }
    return prior;
  }

  void apply(const GlobalSolution& step) {
    // A step beyond a decimetre or six degrees comes from a linearization that no longer holds.
    double scale = 1.0;
    const auto limit = [&](const Vector6d& xi) {
      scale = std::min({scale, 0.1 / std::max(1e-12, xi.head<3>().norm()),
                        0.1 / std::max(1e-12, xi.tail<3>().norm())});
    };
    limit(step.globals.head<6>());
    state().camera_from_lidar =
        se3_exp(scale * Vector6d(step.globals.head<6>())) * state().camera_from_lidar;
    Eigen::Vector3d factor = blur_factor(state().beam.blur_rad2);
    const Eigen::Vector3d change = scale * step.globals.segment<kBlurParameters>(6);
    const Eigen::VectorXd intrinsics = scale * step.globals.segment<kIntrinsics>(kFirstIntrinsic);

    Camera& camera = state().camera;
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
    state().beam.blur_rad2 = blur_from_factor(factor);
    const Eigen::Index sensor = step.globals.size() - kGlobals;
    before_ = state().sensor;
    if (sensor > 0) {
      if (state().sensor.values.size() != sensor)
        state().sensor.values = Eigen::VectorXd::Zero(sensor);
      state().sensor.values += scale * step.globals.tail(sensor);
    }
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      if (step.scenes[s].size() == 0) continue;
      const Eigen::VectorXd local = scale * step.scenes[s].head(kLocals);
      state().camera_from_board[s] =
          se3_exp(Vector6d(local.head<6>())) * state().camera_from_board[s];
      BoardLevels& levels = state().levels[s];
      levels.white += local(6);
      levels.black += local(7);
      levels.slope += local.tail<2>();
      const Eigen::Index shared = step.scenes[s].size() - kLocals;
      if (shared == 0) continue;
      if (state().shared[s].size() != shared) state().shared[s] = Eigen::VectorXd::Zero(shared);
      state().shared[s] += scale * step.scenes[s].tail(shared);
    }
  }

  // With the noise found at the solution, and with faults that it does not have.
  void last_step() {
    LinearizationOptions how = final_rows();
    how.faults = true;
    equations_ = linearize_scenes(scenes_, returns_, print_, state(), noise(), how,
                                  context_.thread_count(), fits_, seen_);
    prior_ = global_prior(true, true);
    before_ = state().sensor;
    measure_board_motion();
    GlobalSolution step = solve_equations(equations_, prior_, before_, noise().shared,
                                          BoardMotion::kWidens, true, context_.thread_count());
    if (!step.solvable) return;
    for (std::size_t k = 0; k < kSharedErrors; ++k) {
      if (moves_board(k)) step.determined[k] = board_determined_[k];
    }
    apply(step);
    last_ = std::move(step);
  }

  // How far boards move between camera and LiDAR, all else as it was found.
  void measure_board_motion() {
    asks_boards_ = true;
    for (int round = 0; round < kBoardRounds; ++round) {
      const GlobalSolution step =
          solve_equations(equations_, prior_, before_, noise().shared, BoardMotion::kWeighed, true,
                          context_.thread_count());
      if (!step.solvable) break;
      for (std::size_t k = 0; k < kSharedErrors; ++k) {
        if (moves_board(k)) board_determined_[k] = step.determined[k];
      }
      const bool moved = update_shared(step);
      if (!moved && !admit_shared(step)) break;
    }
  }

  // MacKay's fixed point σ² = uᵀu/γ, equal to restricted maximum likelihood where it stands still.
  bool update_shared(const GlobalSolution& step) {
    bool moved = false;
    for (std::size_t k = 0; k < kSharedErrors; ++k) {
      if (asks_boards_ != moves_board(k) || !noise().admitted[k] || step.determined[k] < 0.02)
        continue;
      const double wanted = step.squares[k] / step.determined[k];
      const double bounded = std::clamp(wanted, 0.05 * noise().shared[k], 20.0 * noise().shared[k]);
      const double next = std::max(bounded, kAbsentShared[k]);
      moved = moved || std::abs(std::log(next / noise().shared[k])) > 0.03;
      noise().shared[k] = next;
    }
    return moved;
  }

  // Score test: with a variance near nothing, T = (Σ score²)/(Σ information) = Σu²/(D·γ) is one on
  // average if there is no such error, and n·T about χ² with n the number of errors that count.
  // The clearest kind enters; the others are asked again with it in.
  bool admit_shared(const GlobalSolution& step) {
    std::size_t best = kSharedErrors;
    double largest = 1.0;
    for (std::size_t k = 0; k < kSharedErrors; ++k) {
      if (asks_boards_ != moves_board(k) || noise().admitted[k] || step.effective[k] < kOneError)
        continue;
      const double n = step.effective[k];
      const double t = step.squares[k] / (noise().shared[k] * step.determined[k]);
      const double chance = options_.false_alarm * (k < kSceneErrors ? 1.0 : kSensorChance);
      const double gate = chi_square_gate(static_cast<int>(std::lround(n)), chance) / n;
      if (t / gate > largest) {
        largest = t / gate;
        best = k;
      }
    }
    if (best == kSharedErrors) return false;
    noise().admitted[best] = true;
    // From where half of it would be told: the fixed point is there within a few rounds.
    const double share = step.determined[best] / step.effective[best];
    noise().shared[best] =
        std::max(noise().shared[best], noise().shared[best] / std::max(share, 1e-12));
    return true;
  }

  void update_noise() {
    std::array<double, 2> sums{};
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    double corner = 0.0;
    double rows = 0.0;
    double groups = 0.0;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      noise().scenes[s] = fits_[s].noise;
      normal += fits_[s].jitter_normal;
      for (std::size_t k = 0; k < 2; ++k) sums[k] += fits_[s].jitter_sums[k];
      corner += fits_[s].corner_squares;
      rows += static_cast<double>(fits_[s].corner_rows);
      groups += 6.0;
    }
    // Jitter per axis by regression, never negative, never more than the whole blur.
    if (normal.trace() > 0.0) {
      Eigen::Vector2d j = normal.ldlt().solve(Eigen::Vector2d(sums[0], sums[1]));
      for (Eigen::Index k = 0; k < 2; ++k) {
        if (j(k) >= 0.0) continue;
        const Eigen::Index other = 1 - k;
        j(k) = 0.0;
        j(other) = std::max(0.0, sums[static_cast<std::size_t>(other)] / normal(other, other));
      }
      const Eigen::Matrix2d& blur = state().beam.blur_rad2;
      state().beam.jitter_rad2 =
          Eigen::Vector2d(std::min(j(0), blur(0, 0)), std::min(j(1), blur(1, 1))).asDiagonal();
    }
    if (rows > groups + 1.0) {
      noise().corner_px = std::max(options_.sigma_px_floor,
                                   noise().corner_px * std::sqrt(corner / (rows - groups)));
    }
  }

  void finish() {
    const Matrix6d covariance = last_.covariance.topLeftCorner<6, 6>();
    solution_.camera_from_lidar = {state().camera_from_lidar, covariance};
    const Eigen::Matrix3d by = blur_by_factor(blur_factor(state().beam.blur_rad2));
    solution_.blur_covariance = by * last_.covariance.block<3, 3>(6, 6) * by.transpose();
    solution_.dof = satterthwaite();
    solution_.terms = last_.terms;
    // The last step has been taken: what is left of each scene's gradient.
    for (GlobalTerm& term : solution_.terms) {
      if (term.usable) term.gradient -= term.information * last_.globals;
    }
    solution_.prior = prior_;
    solution_.prior.set_sensor(state().sensor, noise().shared);
    solution_.globals_covariance = last_.covariance;
    for (const SceneEquations& scene : equations_)
      solution_.faults.push_back(fault_term(scene, noise().shared, BoardMotion::kWidens));
    solution_.scan_faults =
        find_scan_faults(equations_, prior_, before_, noise().shared, context_.thread_count());
    parallel_for(scenes_.size(), context_.thread_count(), [&](std::size_t s) {
      ForwardSceneResult& scene = solution_.scenes[s];
      const SceneFit& fit = fits_[s];
      scene.returns = returns_[s].size();
      scene.on_board = returns_[s].on_board;
      scene.refused = returns_[s].refused;
      scene.covered = returns_[s].covered;
      scene.intensity_left = fit.intensity_variance_share;
      const auto chi = [](double squares, std::size_t rows) {
        return rows > 0 ? std::sqrt(squares / static_cast<double>(rows)) : 0.0;
      };
      scene.range_chi = chi(fit.range_squares, fit.range_rows);
      scene.intensity_chi = chi(fit.intensity_squares, fit.intensity_rows);
      scene.corner_chi = chi(fit.corner_squares, fit.corner_rows);
      scene.noise = fit.noise;
      scene.seen = seen_share(returns_[s], print_, state().lidar_from_board(s));
      if (returns_[s].has_intensity && scene.print_correlation > 0.0) {
        scene.print_size = measure_print_size(returns_[s], print_, state().lidar_from_board(s),
                                              state().levels[s], state().beam, fit.noise);
      }
    });
    double inflation = 1.0;
    for (const ForwardSceneResult& scene : solution_.scenes)
      inflation = std::max(inflation, scene.noise.intensity_inflation);
    solution_.print_size = print_size();
    solution_.lattice_margin /= inflation;
  }

  [[nodiscard]] PrintSize print_size() const {
    std::vector<SceneSize> scenes;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const ForwardSceneResult& scene = solution_.scenes[s];
      scenes.push_back({scene.print_size, scene.intensity_left, scenes_[s].camera_from_board,
                        scenes_[s].lidar_from_board});
    }
    return print_size_of(scenes, solution_.state.camera_from_lidar, print_.outline().center_m());
  }

  // ν = 2v²/Var(v), v the trace of the extrinsic's scaled covariance, whose variance comes from
  // that of the estimated variances: Var(D) = 2D²/γ.
  double satterthwaite() {
    constexpr double kStep = 0.2;
    const auto spread = [](const GlobalSolution& s) {
      // Rotations act over some three metres.
      Vector6d unit;
      unit << 1, 1, 1, 3, 3, 3;
      return (unit.asDiagonal() * s.covariance.topLeftCorner<6, 6>() * unit.asDiagonal()).trace();
    };
    const double v = spread(last_);
    double variance = 0.0;
    for (std::size_t k = 0; k < kSharedErrors; ++k) {
      if (!noise().admitted[k]) continue;
      SharedVariances varied = noise().shared;
      varied[k] *= 1.0 + kStep;
      const GlobalSolution s =
          solve_equations(equations_, prior_, before_, varied, BoardMotion::kWidens, false,
                          context_.thread_count());
      if (!s.solvable) continue;
      const double slope = (spread(s) - v) / kStep;  // By the logarithm of D.
      variance += slope * slope * 2.0 / std::max(1.0, last_.determined[k]);
    }
    constexpr double kMany = 1e6;
    return variance > 0.0 ? std::min(kMany, 2.0 * v * v / variance) : kMany;
  }

  const std::vector<ForwardScene>& scenes_;
  const BlurredPrint& print_;
  const Camera& given_;
  const ForwardOptions& options_;
  const RunContext& context_;
  ForwardSolution solution_;
  std::vector<BoardReturns> returns_;
  std::vector<std::vector<LocalPrint>> seen_;  ///< The print as each return saw it last.
  std::vector<SceneFit> fits_;
  GlobalSolution last_;
  GlobalPrior prior_;
  std::vector<SceneEquations> equations_;
  bool asks_boards_ = false;  ///< Which variances are being estimated.
  SharedVariances board_determined_{};
  SensorErrors before_;             ///< At the linearization of `equations_`.
  std::vector<bool> print_unseen_;  ///< Per scene, once the print was looked for.
};

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

Result<ForwardSolution> solve_forward(const std::vector<ForwardScene>& scenes,
                                      const BlurredPrint& print, const Camera& camera,
                                      const Rigid3& camera_from_lidar, double corner_sigma_px,
                                      const ForwardOptions& options, const RunContext& context) {
  if (scenes.empty()) return Error::untrusted(Message("no usable scene is left"));
  return ForwardSolver(scenes, print, camera, options, context)
      .run(camera_from_lidar, corner_sigma_px);
}

}  // namespace lvcalib
