// SPDX-License-Identifier: BSD-3-Clause
#include "solve/forward_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/device_faults.h"
#include "model/linear_model.h"
#include "model/scan_velocity.h"
#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

// Print plainer than this counts as white or black when their noise is measured: what is left of an
// edge then adds a hundredth of the contrast, less than any intensity noise seen.
constexpr double kPlainShare = 0.01;
// Light changes over a board by some per cent; this is one σ.
constexpr double kSlopeSigma = 0.1;

constexpr Eigen::Index kLidarFixed = 6 + kBlurParameters + kLevelParameters;
// Constant and slopes are the board's own motion.
constexpr Eigen::Index kRangeTerms = 12;
constexpr Eigen::Index kBoardTerms = 6;  // Shift (2), normal (1), tilt (2), spin (1).

// Where everything of one scene stands among the LiDAR's unknowns: pose of the board in the LiDAR
// frame (6), blur (3), levels (4), shared errors.
struct Layout {
  Eigen::Index size = kLidarFixed;
  Eigen::Index range_shape = -1;
  Eigen::Index board = -1;
  Eigen::Index print_patch = -1;
  Eigen::Index line_gain = -1;
  Eigen::Index line_range = -1;
  Eigen::Index corner_group = -1;  // Behind the LiDAR's own,
  Eigen::Index sensor = -1;        // which in its own equations the sensor's errors follow.
  std::map<std::uint16_t, Eigen::Index> sensor_line;
  Eigen::Index corner_groups = 0;
  BoardPatches patches;
  std::map<int, int> corner_group_of;  // feature → group
  std::map<std::uint16_t, int> line_of;
  SharedErrorColumns columns;
};

Layout make_layout(const ForwardScene& scene, const BoardReturns& returns,
                   const BlurredPrint& print, const SensorErrors& sensor,
                   const LinearizationOptions& options) {
  Layout layout;
  if (!options.shared_errors) return layout;
  const BoardOutline& outline = print.outline();
  layout.patches = BoardPatches(outline, options.patch_m);
  const auto place = [&](SharedError kind, Eigen::Index count) {
    const auto k = static_cast<std::size_t>(kind);
    layout.columns.first[k] = layout.size - kLidarFixed;
    layout.columns.count[k] = count;
    const Eigen::Index at = layout.size;
    layout.size += count;
    return at;
  };
  if (returns.cloud->has_line()) {
    std::map<std::uint16_t, std::size_t> rows;
    for (const std::uint32_t i : returns.index) ++rows[returns.cloud->line[i]];
    for (const auto& [line, count] : rows) {
      if (count >= kLineRows) layout.line_of.emplace(line, static_cast<int>(layout.line_of.size()));
    }
    // A single line's gain is the levels', its range the board's.
    if (layout.line_of.size() < 2) layout.line_of.clear();
  }
  const auto lines = static_cast<Eigen::Index>(layout.line_of.size());
  layout.board = place(SharedError::kBoardShift, 2);
  place(SharedError::kBoardNormal, 1);
  place(SharedError::kBoardTilt, 2);
  place(SharedError::kBoardSpin, 1);
  layout.range_shape = place(SharedError::kRangeShape, kRangeTerms);
  layout.line_range = place(SharedError::kLineRange, lines);
  if (returns.has_intensity) {
    layout.print_patch =
        place(SharedError::kPrintPatch, 2 * static_cast<Eigen::Index>(layout.patches.count()));
    layout.line_gain = place(SharedError::kLineGain, lines);
  }
  layout.sensor = layout.size;
  for (std::size_t k = 0; k < sensor.lines.size(); ++k) {
    layout.sensor_line.emplace(
        sensor.lines[k], layout.sensor + SensorErrors::kFirstLine + static_cast<Eigen::Index>(k));
  }
  const bool tags = print.target().has_tags();
  for (const CornerObservation& c : scene.corners) {
    const int feature = tags ? c.feature_id : layout.patches.of(outline, c.board_m);
    layout.corner_group_of.try_emplace(feature, static_cast<int>(layout.corner_group_of.size()));
  }
  layout.corner_groups = static_cast<Eigen::Index>(layout.corner_group_of.size());
  layout.corner_group = place(SharedError::kCornerGroup, 2 * layout.corner_groups);
  layout.columns.total = layout.size - kLidarFixed;
  return layout;
}

// One row's non-zero entries.
struct SparseRow {
  static constexpr int kMost = 40;
  // Row times the values u of the unknowns from `first` on.
  [[nodiscard]] double times(const Eigen::VectorXd& u, Eigen::Index first) const {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) {
      const Eigen::Index i = at[static_cast<std::size_t>(k)] - first;
      if (i >= 0 && i < u.size()) sum += value[static_cast<std::size_t>(k)] * u(i);
    }
    return sum;
  }
  std::array<Eigen::Index, kMost> at{};
  std::array<double, kMost> value{};
  int count = 0;
  void add(Eigen::Index i, double v) {
    at[static_cast<std::size_t>(count)] = i;
    value[static_cast<std::size_t>(count)] = v;
    ++count;
  }
};

// What spots that see a share of one print, more or less, say of the noise on that print alone.
class MixedNoise {
 public:
  void add(double share, double z) {
    shares_ += share;
    squares_of_shares_ += share * share;
    cut_squares_ += share * std::min(z * z, kCut * kCut) / kCutMean;
  }
  void add(const MixedNoise& other) {
    shares_ += other.shares_;
    squares_of_shares_ += other.squares_of_shares_;
    cut_squares_ += other.cut_squares_;
  }
  // As many spots that see nothing else would say as much of it: the information on log σ where σ
  // lies geometrically between those of the prints (see noise_between()), against that of one.
  [[nodiscard]] double rows() const { return squares_of_shares_; }
  // σ by which residuals were divided, times this, is the one they say: the step of Fisher's
  // scoring Σ share·(z² − 1)/(2 Σ share²) to first order, exact where all shares are one.
  [[nodiscard]] double factor() const {
    return std::exp(0.5 * std::log(cut_squares_ / shares_) * shares_ / squares_of_shares_);
  }

 private:
  double shares_ = 0.0, squares_of_shares_ = 0.0, cut_squares_ = 0.0;
};

// Upper triangle of the normal matrix, and gradient.
struct Accumulator {
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  SceneFit fit;
  std::array<double, 4> cut_squares{};  // range white, black; intensity white, black
  std::array<double, 4> cut_rows{};
  std::array<MixedNoise, 2> mixed_range{};  // white, black
  double weight = 0.0, sum = 0.0, squares = 0.0, residual_squares = 0.0;
  Eigen::Matrix<double, kFaults, Eigen::Dynamic> by_faults;
  FaultMatrix faults = FaultMatrix::Zero();
  FaultRow fault_gradient = FaultRow::Zero();

  explicit Accumulator(Eigen::Index size, bool with_faults = false)
      : normal(Eigen::MatrixXd::Zero(size, size)),
        gradient(Eigen::VectorXd::Zero(size)),
        by_faults(kFaults, with_faults ? size : 0) {
    by_faults.setZero();
  }

  // What a row that the faults change by `by` says of them.
  void add_faults(const SparseRow& row, const FaultRow& by, double residual, double row_weight) {
    for (int a = 0; a < row.count; ++a) {
      const auto ia = static_cast<std::size_t>(a);
      const double wa = row_weight * row.value[ia];
      by_faults.col(row.at[ia]) += wa * by.transpose();
    }
    faults += row_weight * by.transpose() * by;
    fault_gradient += row_weight * residual * by;
  }

  void add(const SparseRow& row, double residual, double weight) {
    for (int a = 0; a < row.count; ++a) {
      const auto ia = static_cast<std::size_t>(a);
      const double wa = weight * row.value[ia];
      gradient(row.at[ia]) += wa * residual;
      // Entries come in rising order: down a column of the upper triangle, as memory lies.
      double* const column = normal.col(row.at[ia]).data();
      for (int b = 0; b <= a; ++b) {
        const auto ib = static_cast<std::size_t>(b);
        column[row.at[ib]] += wa * row.value[ib];
      }
    }
  }

  void merge(const Accumulator& other) {
    normal += other.normal;
    gradient += other.gradient;
    by_faults += other.by_faults;
    faults += other.faults;
    fault_gradient += other.fault_gradient;
    fit.range_rows += other.fit.range_rows;
    fit.intensity_rows += other.fit.intensity_rows;
    fit.range_squares += other.fit.range_squares;
    fit.intensity_squares += other.fit.intensity_squares;
    fit.jitter.add(other.fit.jitter);
    for (std::size_t k = 0; k < 4; ++k) {
      cut_squares[k] += other.cut_squares[k];
      cut_rows[k] += other.cut_rows[k];
    }
    for (std::size_t k = 0; k < 2; ++k) mixed_range[k].add(other.mixed_range[k]);
    weight += other.weight;
    sum += other.sum;
    squares += other.squares;
    residual_squares += other.residual_squares;
  }
};

class LidarRows {
 public:
  LidarRows(const LinearizationInput& in, std::size_t index, const Layout& layout,
            const LinearizationOptions& options, std::vector<LocalPrint>& seen)
      : returns_(in.returns[index]),
        seen_(seen),
        print_(in.print),
        state_(in.state),
        noise_(in.noise.scenes[index]),
        layout_(layout),
        options_(options),
        lidar_(Eigen::VectorXd::Zero(0)),
        predictor_(print_, state_.lidar_from_board(index), state_.levels[index], state_.beam),
        blur_by_factor_(blur_by_factor(blur_factor(state_.beam.blur_rad2))),
        center_(print_.outline().center_m()),
        half_(0.5 * print_.outline().size_m()),
        has_intensity_(returns_.has_intensity),
        range_z(returns_.size(), kUnused),
        intensity_z(returns_.size(), kUnused) {
    if (options.faults) faults_.emplace();
    if (options.faults && has_intensity_ && returns_.size() > 0)
      scan_rad_s_ = scan_velocities(*returns_.cloud);
    if (layout.sensor < 0) return;
    // The LiDAR's own shared errors and the sensor's, as they stand among its unknowns.
    const Eigen::Index own = layout.sensor - kLidarFixed;
    lidar_ = Eigen::VectorXd::Zero(own + state_.sensor.count());
    if (state_.sensor.values.size() == state_.sensor.count())
      lidar_.tail(state_.sensor.count()) = state_.sensor.values;
    if (index >= state_.shared.size() || state_.shared[index].size() != layout.columns.total)
      return;
    lidar_.head(own) = state_.shared[index].head(own);
    // The board's own motion moves a row as its pose does.
    board_ = board_motion(state_.lidar_from_board(index), center_) *
             lidar_.segment<kBoardTerms>(layout.board - kLidarFixed);
  }

  static constexpr float kUnused = 1e9F;

  void add(std::size_t begin, std::size_t end, Accumulator& out) {
    for (std::size_t k = begin; k < end; k += options_.stride) {
      const Eigen::Vector3d point = returns_.point_m(k);
      const double range = point.norm();
      LocalPrint* const seen = &seen_[k];
      const auto p = predictor_.predict(point / range, {}, seen, seen);
      if (!p) continue;
      const FaultMoves moves = faults_ ? faults_->moves(point) : FaultMoves(FaultMoves::Zero());
      add_range(k, range - p->range_m, *p, moves, out);
      if (has_intensity_) add_intensity(k, returns_.intensity(k) - p->intensity, *p, moves, out);
    }
  }

 private:
  void add_range(std::size_t k, double e, const ReturnPrediction& p, const FaultMoves& moves,
                 Accumulator& out) {
    const double sigma = noise_between(noise_.range_white_m, noise_.range_black_m, p.white);
    SparseRow row;
    for (Eigen::Index i = 0; i < 6; ++i) row.add(i, p.range_by_pose(i));
    if (layout_.range_shape >= 0) {
      const Eigen::Vector2d at = (p.board_m - center_).cwiseQuotient(half_);
      BoardPolynomials terms{};
      board_polynomials(at, terms);
      for (Eigen::Index i = 0; i < kRangeTerms; ++i)
        row.add(layout_.range_shape + i, terms[static_cast<std::size_t>(3 + i)]);
      if (const int line = line_of(k); line >= 0) row.add(layout_.line_range + line, 1.0);
      row.add(layout_.sensor, 1.0);
      row.add(layout_.sensor + 1, 1.0 - p.white);
      // Of one sensor's clouds some may lack the field.
      if (!layout_.sensor_line.empty() && returns_.cloud->has_line()) {
        const auto line = layout_.sensor_line.find(returns_.cloud->line[returns_.index[k]]);
        if (line != layout_.sensor_line.end()) row.add(line->second, 1.0);
      }
    }
    e -= row.times(lidar_, kLidarFixed) + p.range_by_pose * board_;
    const double z = e / sigma;
    range_z[k] = static_cast<float>(z);
    const double robust = huber_weight(z, options_.robust_threshold);
    const double weight = robust / (sigma * sigma * noise_.range_inflation);
    out.add(row, e, weight);
    if (faults_) {
      FaultRow by = FaultRow::Zero();
      // A displaced point moves measured minus predicted by what the board displaced the same way
      // moves the predicted range.
      by.head<kDeviceFaults>() = p.range_by_pose.head<3>() * moves;
      by.segment<kMotionFaults>(kFirstMotion) = time_s(k) * p.range_by_pose.head<kMotionFaults>();
      out.add_faults(row, by, e, weight);
    }
    out.fit.range_squares += robust * z * z;
    ++out.fit.range_rows;
    note_noise(p.white, e, sigma, 0, out);
    out.mixed_range[0].add(p.white, z);
    out.mixed_range[1].add(1.0 - p.white, z);
  }

  void add_intensity(std::size_t k, double e, const ReturnPrediction& p, const FaultMoves& moves,
                     Accumulator& out) {
    const double plain = noise_between(noise_.intensity_white, noise_.intensity_black, p.white);
    const Eigen::RowVector2d& by_angle = p.intensity_by_angle;
    const double variance = intensity_variance(plain, by_angle, state_.beam.jitter_rad2);
    const double sigma = std::sqrt(variance);
    SparseRow row;
    for (Eigen::Index i = 0; i < 6; ++i) row.add(i, p.intensity_by_pose(i));
    const Eigen::RowVector3d by_factor = p.intensity_by_blur * blur_by_factor_;
    for (Eigen::Index i = 0; i < kBlurParameters; ++i) row.add(6 + i, by_factor(i));
    for (Eigen::Index i = 0; i < kLevelParameters; ++i)
      row.add(6 + kBlurParameters + i, p.intensity_by_levels(i));
    if (layout_.print_patch >= 0) {
      const Eigen::Index patch =
          layout_.print_patch + 2 * layout_.patches.of(print_.outline(), p.board_m);
      row.add(patch, p.intensity_by_shift(0));
      row.add(patch + 1, p.intensity_by_shift(1));
      if (const int line = line_of(k); line >= 0) row.add(layout_.line_gain + line, p.intensity);
    }
    e -= row.times(lidar_, kLidarFixed) + p.intensity_by_pose * board_;
    const double z = e / sigma;
    intensity_z[k] = static_cast<float>(z);
    const double robust = huber_weight(z, options_.robust_threshold);
    const double weight = robust / (variance * noise_.intensity_inflation);
    out.add(row, e, weight);
    if (faults_) {
      FaultRow by = FaultRow::Zero();
      // What turns the reported direction away from the spot that was lit.
      const Eigen::Vector3d point = returns_.point_m(k);
      const BeamAxes axes = beam_axes(point.normalized());
      by.head<kDeviceFaults>() =
          (by_angle(0) * axes.horizontal + by_angle(1) * axes.vertical).transpose() * moves /
          -point.norm();
      by.segment<kMotionFaults>(kFirstMotion) =
          time_s(k) * p.intensity_by_pose.head<kMotionFaults>();
      if (!scan_rad_s_.empty()) by(kLagFault) = by_angle.dot(scan_rad_s_[returns_.index[k]]);
      out.add_faults(row, by, e, weight);
    }
    out.fit.intensity_squares += robust * z * z;
    ++out.fit.intensity_rows;
    const double intensity = p.intensity + e;
    out.weight += robust;
    out.sum += robust * intensity;
    out.squares += robust * intensity * intensity;
    out.residual_squares += robust * e * e;
    note_noise(p.white, e, sigma, 2, out);
    out.fit.jitter.add(by_angle, e, plain * plain, variance);
  }

  [[nodiscard]] double time_s(std::size_t k) const {
    if (!returns_.cloud->has_time()) return 0.0;
    const double time = returns_.cloud->time_s[returns_.index[k]];
    return std::isfinite(time) ? time : 0.0;
  }

  [[nodiscard]] int line_of(std::size_t k) const {
    if (layout_.line_of.empty()) return -1;
    const auto line = layout_.line_of.find(returns_.cloud->line[returns_.index[k]]);
    return line == layout_.line_of.end() ? -1 : line->second;
  }

  static void note_noise(double white, double e, double sigma, std::size_t first,
                         Accumulator& out) {
    const bool is_white = white > 1.0 - kPlainShare;
    if (!is_white && white > kPlainShare) return;
    const std::size_t k = first + (is_white ? 0 : 1);
    out.cut_squares[k] += std::min(e * e, kCut * kCut * sigma * sigma);
    out.cut_rows[k] += 1.0;
  }

  const BoardReturns& returns_;
  std::vector<LocalPrint>& seen_;
  const BlurredPrint& print_;
  const ForwardState& state_;
  const SceneNoise& noise_;
  const Layout& layout_;
  const LinearizationOptions& options_;
  Eigen::VectorXd lidar_;
  BoardPredictor predictor_;
  Eigen::Matrix3d blur_by_factor_;
  Eigen::Vector2d center_;
  Eigen::Vector2d half_;
  bool has_intensity_;
  std::optional<DeviceFaults> faults_;       // Where asked for.
  std::vector<Eigen::Vector2d> scan_rad_s_;  // Per point of the cloud; empty where not asked for.
  Vector6d board_ = Vector6d::Zero();        // Left perturbation that the board's own motion makes.

 public:
  std::vector<float> range_z, intensity_z;  // Per return; kUnused where there is no row.
};

// (1 + ρ)/(1 − ρ) from neighbours along a line, where ρ stands clear of chance.
double inflation(const BoardReturns& returns, const std::vector<float>& z) {
  double products = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < returns.size(); ++k) {
    const std::uint32_t next = returns.successor[k];
    if (next == BoardReturns::kNone) continue;
    const double a = z[k];
    const double b = z[next];
    if (std::abs(a) > kCut || std::abs(b) > kCut) continue;
    products += a * b;
    squares += 0.5 * (a * a + b * b);
    count += 1.0;
  }
  if (count < 20.0 || squares <= 0.0) return 1.0;
  const double rho = products / squares;
  if (rho < 2.0 / std::sqrt(count)) return 1.0;
  const double bounded = std::min(rho, 0.9);
  return (1.0 + bounded) / (1.0 - bounded);
}

void update_noise(const SceneNoise& before, const Accumulator& sums, const LidarRows& rows,
                  const BoardReturns& returns, SceneFit& fit) {
  constexpr double kFewest = 20.0;
  const auto sigma = [&](std::size_t k, double old, double floor) {
    const double n = sums.cut_rows[k];
    return n < kFewest ? old : std::max(floor, std::sqrt(sums.cut_squares[k] / (kCutMean * n)));
  };
  fit.noise = before;
  // Ranges on small prints, seen by few spots or none alone, scatter as all spots that see a part
  // of them say. A class with too few rows even so takes the other's.
  const auto range_sigma_m = [&](std::size_t k, double old, double otherwise) {
    if (sums.cut_rows[k] >= kFewest) return sigma(k, old, 1e-5);
    const MixedNoise& mixed = sums.mixed_range[k];
    return mixed.rows() < kFewest ? otherwise : std::max(1e-5, old * mixed.factor());
  };
  fit.noise.range_white_m = range_sigma_m(0, before.range_white_m, before.range_white_m);
  fit.noise.range_black_m = range_sigma_m(1, before.range_black_m, fit.noise.range_white_m);
  // Numbers that come in steps scatter by a step/√12 at least; whole ones, by that.
  const double floor = kRoundingSigma * (returns.intensity_step > 0.0   ? returns.intensity_step
                                         : before.intensity_white > 2.0 ? 1.0
                                                                        : 0.0);
  fit.noise.intensity_white = sigma(2, before.intensity_white, std::max(floor, 1e-9));
  fit.noise.intensity_black = sums.cut_rows[3] < kFewest
                                  ? fit.noise.intensity_white
                                  : sigma(3, before.intensity_black, std::max(floor, 1e-9));
  fit.noise.range_inflation = inflation(returns, rows.range_z);
  fit.noise.intensity_inflation = inflation(returns, rows.intensity_z);
  if (sums.weight > 0.0) {
    const double variance = sums.squares / sums.weight - std::pow(sums.sum / sums.weight, 2);
    if (variance > 0.0)
      fit.intensity_variance_share = sums.residual_squares / sums.weight / variance;
  }
}

}  // namespace

Eigen::Vector3d blur_factor(const Eigen::Matrix2d& blur) {
  const double a = std::sqrt(std::max(1e-14, blur(0, 0)));
  const double b = blur(0, 1) / a;
  return {a, b, std::sqrt(std::max(1e-14, blur(1, 1) - b * b))};
}

Eigen::Matrix2d blur_from_factor(const Eigen::Vector3d& f) {
  Eigen::Matrix2d blur;
  blur << f(0) * f(0), f(0) * f(1), f(0) * f(1), f(1) * f(1) + f(2) * f(2);
  return blur;
}

Eigen::Matrix3d blur_by_factor(const Eigen::Vector3d& f) {
  Eigen::Matrix3d j;
  j << 2 * f(0), 0, 0, f(1), f(0), 0, 0, 2 * f(1), 2 * f(2);
  return j;
}

namespace {

// One scene's linearization in three steps, so that all scenes' rows are worked off side by side.
class SceneLinearization {
 public:
  SceneLinearization(const LinearizationInput& in, std::size_t index,
                     const LinearizationOptions& options, std::vector<LocalPrint>& seen)
      : in_(in),
        index_(index),
        returns_(in.returns[index]),
        options_(options),
        layout_(make_layout(in.scenes[index], returns_, in.print, in.state.sensor, options)),
        rows_(in, index, layout_, options, seen),
        sensor_(layout_.sensor < 0 ? 0 : in.state.sensor.count()),
        own_size_(layout_.sensor < 0 ? layout_.size : layout_.sensor) {
    // Chunks of a fixed size, summed in order: the result does not depend on the threads. With
    // shared errors a sum is some hundred kilobytes, which many small chunks would be busy with.
    const std::size_t rows = options.shared_errors ? 4096 : 1024;
    chunk_ = rows * options.stride;
    parts_.assign((returns_.size() + chunk_ - 1) / chunk_, Accumulator(0));
  }

  [[nodiscard]] std::size_t chunks() const { return parts_.size(); }

  void add_chunk(std::size_t c) {
    parts_[c] = Accumulator(lidar_size(), options_.faults);
    rows_.add(c * chunk_, std::min(returns_.size(), (c + 1) * chunk_), parts_[c]);
  }

  SceneEquations finish(SceneFit& fit) {
    Accumulator sums(lidar_size(), options_.faults);
    for (const Accumulator& part : parts_) sums.merge(part);
    sums.normal.triangularView<Eigen::StrictlyLower>() = sums.normal.transpose();
    fit = sums.fit;
    update_noise(in_.noise.scenes[index_], sums, rows_, returns_, fit);

    // From the board's pose in the LiDAR frame to both poses in the camera frame:
    // T_LB = X⁻¹ B, so δ = Ad(X⁻¹)(ξ_B − ξ_X).
    const Matrix6d ad = in_.state.camera_from_lidar.inverse().adjoint();
    const Eigen::Index shared = layout_.size - kLidarFixed;
    const Eigen::Index globals = kGlobals + sensor_;
    const Eigen::Index size = globals + kLocals + shared;
    // The board's pose in the LiDAR frame (6) by both poses and by the board's own motion;
    // everything else only changes its place.
    Eigen::Matrix<double, 6, Eigen::Dynamic> pose = Eigen::MatrixXd::Zero(6, size);
    pose.leftCols<6>() = -ad;
    pose.middleCols<6>(globals) = ad;
    if (layout_.board >= 0) {
      pose.middleCols<kBoardTerms>(globals + kLocals + layout_.board - kLidarFixed) =
          board_motion(in_.state.lidar_from_board(index_), in_.print.outline().center_m());
    }
    const auto place = [&](Eigen::Index i) {
      if (i < 6 + kBlurParameters) return i;
      if (i < kLidarFixed) return globals + i - kBlurParameters;
      if (i < own_size_) return globals + kLocals + i - kLidarFixed;
      return kGlobals + i - own_size_;
    };
    const auto placed = [&](const Eigen::MatrixXd& rows_in) {
      Eigen::MatrixXd moved = pose.transpose() * rows_in.topRows<6>();
      for (Eigen::Index i = 6; i < lidar_size(); ++i) moved.row(place(i)) += rows_in.row(i);
      return moved;
    };
    SceneEquations out;
    out.globals = globals;
    out.columns = layout_.columns;
    out.shared = index_ < in_.state.shared.size() && in_.state.shared[index_].size() == shared
                     ? in_.state.shared[index_]
                     : Eigen::VectorXd(Eigen::VectorXd::Zero(shared));
    out.normal = placed(placed(sums.normal).transpose());
    out.gradient = placed(sums.gradient);
    if (options_.faults) {
      out.by_faults = placed(sums.by_faults.transpose());
      out.faults = sums.faults;
      out.fault_gradient = sums.fault_gradient;
    }
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Eigen::Index at = globals + 6 + 2 + i;
      out.normal(at, at) += 1.0 / (kSlopeSigma * kSlopeSigma);
      out.gradient(at) -= in_.state.levels[index_].slope(i) / (kSlopeSigma * kSlopeSigma);
    }
    add_corners(out, fit);
    return out;
  }

 private:
  // Adds the corners: unknowns T_camera_board and the group's shift.
  void add_corners(SceneEquations& out, SceneFit& fit) const {
    const double sigma_px = in_.noise.corner_px;
    const Rigid3& camera_from_board = in_.state.camera_from_board[index_];
    const bool tags = in_.print.target().has_tags();
    const Eigen::Index pose = out.globals;
    for (const CornerObservation& c : in_.scenes[index_].corners) {
      const Eigen::Vector3d p =
          camera_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0);
      Eigen::Matrix<double, 2, 3> by_point;
      Eigen::Matrix<double, 2, kIntrinsics> by_intrinsics;
      const auto pixel = in_.state.camera.project(p, &by_point, &by_intrinsics);
      if (!pixel) continue;
      Eigen::Matrix<double, 3, 6> moved;
      moved.leftCols<3>().setIdentity();
      moved.rightCols<3>() = -skew(p);
      const Eigen::Matrix<double, 2, 6> j = by_point * moved;
      Eigen::Vector2d e = c.pixel - *pixel;
      Eigen::Index at = -1;
      if (layout_.corner_group >= 0) {
        const int feature =
            tags ? c.feature_id : layout_.patches.of(in_.print.outline(), c.board_m);
        const Eigen::Index own =
            layout_.corner_group - kLidarFixed + 2 * layout_.corner_group_of.at(feature);
        if (own + 1 < out.shared.size()) e -= out.shared.segment<2>(own);
        at = out.globals + kLocals + own;
      }
      const double size = e.norm() / sigma_px;
      const double w = huber_weight(size, options_.robust_threshold + 1.0) / (sigma_px * sigma_px);
      fit.corner_squares += w * e.squaredNorm();
      fit.corner_rows += 2;
      out.normal.block<6, 6>(pose, pose) += w * j.transpose() * j;
      out.gradient.segment<6>(pose) += w * j.transpose() * e;
      out.normal.block<kIntrinsics, kIntrinsics>(kFirstIntrinsic, kFirstIntrinsic) +=
          w * by_intrinsics.transpose() * by_intrinsics;
      out.normal.block<6, kIntrinsics>(pose, kFirstIntrinsic) += w * j.transpose() * by_intrinsics;
      out.normal.block<kIntrinsics, 6>(kFirstIntrinsic, pose) += w * by_intrinsics.transpose() * j;
      out.gradient.segment<kIntrinsics>(kFirstIntrinsic) += w * by_intrinsics.transpose() * e;
      if (at < 0) continue;
      out.normal.block<2, 6>(at, pose) += w * j;
      out.normal.block<6, 2>(pose, at) += w * j.transpose();
      out.normal.block<2, kIntrinsics>(at, kFirstIntrinsic) += w * by_intrinsics;
      out.normal.block<kIntrinsics, 2>(kFirstIntrinsic, at) += w * by_intrinsics.transpose();
      out.normal(at, at) += w;
      out.normal(at + 1, at + 1) += w;
      out.gradient.segment<2>(at) += w * e;
    }
  }

  // The LiDAR's own unknowns, and with the sensor's errors.
  [[nodiscard]] Eigen::Index lidar_size() const { return own_size_ + sensor_; }

  const LinearizationInput& in_;
  std::size_t index_;
  const BoardReturns& returns_;
  const LinearizationOptions& options_;
  Layout layout_;
  LidarRows rows_;
  Eigen::Index sensor_;
  Eigen::Index own_size_;
  std::size_t chunk_ = 1;
  std::vector<Accumulator> parts_;
};

}  // namespace

LinearizedScenes linearize_scenes(const LinearizationInput& in, const LinearizationOptions& options,
                                  std::vector<std::vector<LocalPrint>>& seen, int threads) {
  const std::size_t scenes = in.scenes.size();
  std::vector<std::unique_ptr<SceneLinearization>> work(scenes);
  parallel_for(scenes, threads, [&](std::size_t s) {
    work[s] = std::make_unique<SceneLinearization>(in, s, options, seen[s]);
  });
  std::vector<std::pair<std::size_t, std::size_t>> chunks;  // Scene and chunk.
  for (std::size_t s = 0; s < scenes; ++s) {
    for (std::size_t c = 0; c < work[s]->chunks(); ++c) chunks.emplace_back(s, c);
  }
  parallel_for(chunks.size(), threads,
               [&](std::size_t k) { work[chunks[k].first]->add_chunk(chunks[k].second); });
  LinearizedScenes out;
  out.equations.resize(scenes);
  out.fits.resize(scenes);
  parallel_for(scenes, threads,
               [&](std::size_t s) { out.equations[s] = work[s]->finish(out.fits[s]); });
  return out;
}

}  // namespace lvcalib
