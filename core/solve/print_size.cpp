// SPDX-License-Identifier: BSD-3-Clause
#include "solve/print_size.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>

#include "base/paired_moments.h"
#include "base/statistics.h"
#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

// Stretch (2), shift (2), spin, white, black.
constexpr int kUnknowns = 7;
using Vector7 = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix7 = Eigen::Matrix<double, kUnknowns, kUnknowns>;
// So many returns tell the size to some 0.02 %, better than a ruler; more would only cost time.
constexpr std::size_t kMostReturns = 4'000;
constexpr double kCoarsest = 0.25;
constexpr double kCoarseStep = 0.015;
constexpr double kLargestSigma = 0.05;

// How the board is seen.
struct SeenBoard {
  const BlurredPrint& print;
  const Rigid3& lidar_from_board;
  const BeamSpread& beam;
  const SceneNoise& noise;
};

// Where a return met the board.
struct Place {
  Eigen::Vector2d board_m;
  double intensity;
  LocalPrint seen = {};  // The print as it was seen here last.
};

struct Places {
  std::vector<Place> list;
  double distance = 1.0;  // Of the white returns, over that of the board as solved.
};

Places places_of(const BoardReturns& returns, const SeenBoard& board, const BoardLevels& levels) {
  const BoardPredictor predictor(board.print, board.lidar_from_board, levels, board.beam);
  const std::size_t stride = std::max<std::size_t>(1, returns.size() / kMostReturns);
  Places out;
  std::vector<double> farther;
  for (std::size_t k = 0; k < returns.size(); k += stride) {
    const Eigen::Vector3d point = returns.point_m(k);
    const auto hit = predictor.hit(point.normalized());
    if (!hit) continue;
    out.list.push_back({hit->board_m, returns.intensity(k), {}});
    if (returns.intensity(k) > 0.5 * (levels.white + levels.black))
      farther.push_back(point.norm() / hit->range_m);
  }
  if (!farther.empty()) out.distance = median(std::move(farther));
  return out;
}

// The stretch, alike in x and y, under which intensities and print correlate best.
double coarse_scale(const std::vector<Place>& places, const BlurredPrint& blurred) {
  const BlurredPrint::Coarse print = blurred.coarse(0.01);
  const Eigen::Vector2d center = blurred.outline().center_m();
  double best = 1.0;
  double largest = 0.0;
  const int steps = static_cast<int>(kCoarsest / kCoarseStep);
  for (int k = -steps; k <= steps; ++k) {
    const double scale = 1.0 + kCoarseStep * k;
    PairedMoments moments;
    const std::size_t stride = std::max<std::size_t>(1, places.size() / 1500);
    for (std::size_t q = 0; q < places.size(); q += stride) {
      moments.add(print.at(center + (places[q].board_m - center) / scale), places[q].intensity);
    }
    const double rho = moments.correlation();
    if (rho > largest) {
      largest = rho;
      best = scale;
    }
  }
  return best;
}

// How the print lies on the board as solved: what is fitted.
struct PrintOnBoard {
  Eigen::Vector2d scale = Eigen::Vector2d::Ones();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  double spin = 0.0;
  BoardLevels levels;

  // Where on the drawing the print at a place of the board comes from.
  [[nodiscard]] Eigen::Vector2d on_drawing(const Eigen::Vector2d& p,
                                           const Eigen::Vector2d& center) const {
    const Eigen::Vector2d d = p - center - shift;
    const double c = std::cos(spin);
    const double s = std::sin(spin);
    return center +
           Eigen::Vector2d(c * d.x() + s * d.y(), -s * d.x() + c * d.y()).cwiseQuotient(scale);
  }
};

struct SizeStep {
  Vector7 step = Vector7::Zero();
  Matrix7 normal = Matrix7::Zero();
  double chi_square = 1.0;
};

// One Gauss–Newton step; nothing where it is not solvable.
std::optional<SizeStep> take_step(const SeenBoard& board, std::vector<Place>& places,
                                  PrintOnBoard& on_board) {
  const BoardPredictor predictor(board.print, board.lidar_from_board, on_board.levels, board.beam);
  const Eigen::Vector2d center = board.print.outline().center_m();
  SizeStep out;
  Vector7 gradient = Vector7::Zero();
  double squares = 0.0;
  double rows = 0.0;
  for (Place& place : places) {
    const Eigen::Vector2d q = on_board.on_drawing(place.board_m, center);
    const Eigen::Vector3d at = board.lidar_from_board * Eigen::Vector3d(q.x(), q.y(), 0.0);
    const auto p = predictor.predict(at.normalized(), {}, &place.seen, &place.seen);
    if (!p) continue;
    const double plain =
        noise_between(board.noise.intensity_white, board.noise.intensity_black, p->white);
    const double variance =
        intensity_variance(plain, p->intensity_by_angle, board.beam.jitter_rad2);
    const double e = place.intensity - p->intensity;
    const double z = e / std::sqrt(variance);
    const double w = huber_weight(z, 3.0) / variance;
    const Eigen::RowVector2d by_shift = p->intensity_by_shift;
    const Eigen::Vector2d d = q - center;
    Vector7 j;
    j << by_shift(0) * d.x(), by_shift(1) * d.y(), by_shift(0), by_shift(1),
        by_shift(1) * d.x() - by_shift(0) * d.y(), p->intensity_by_levels(0),
        p->intensity_by_levels(1);
    out.normal += w * j * j.transpose();
    gradient += w * e * j;
    squares += std::min(z * z, 9.0);
    rows += 1.0;
  }
  if (rows < 10 * kUnknowns) return std::nullopt;
  out.chi_square = squares / (rows - kUnknowns);
  const Eigen::LDLT<Matrix7> solver(out.normal);
  out.step = solver.solve(gradient);
  if (solver.info() != Eigen::Success || !out.step.allFinite()) return std::nullopt;
  // Beyond a feature's width the slopes say nothing.
  const double most = out.step.head<2>().norm() * board.print.outline().size_m().norm() / 2.0;
  const double shrink = std::min(1.0, 0.01 / std::max(1e-12, most));
  on_board.scale += shrink * out.step.head<2>();
  on_board.shift += shrink * out.step.segment<2>(2);
  on_board.spin += shrink * out.step(4);
  on_board.levels.white += shrink * out.step(5);
  on_board.levels.black += shrink * out.step(6);
  return out;
}

}  // namespace

PrintSize measure_print_size(const BoardReturns& returns, const BlurredPrint& print,
                             const Rigid3& lidar_from_board, const BoardLevels& levels,
                             const BeamSpread& beam, const SceneNoise& noise) {
  const SeenBoard board{print, lidar_from_board, beam, noise};
  Places places = places_of(returns, board, levels);
  PrintSize out;
  if (places.list.size() < 10 * kUnknowns) return out;
  PrintOnBoard on_board;
  on_board.levels = levels;
  on_board.scale *= coarse_scale(places.list, print);
  constexpr int kIterations = 15;
  SizeStep last;
  bool settled = false;
  for (int i = 0; i < kIterations && !settled; ++i) {
    const auto step = take_step(board, places.list, on_board);
    if (!step) return out;
    last = *step;
    settled = last.step.head<2>().norm() < 1e-5;
  }
  if (!settled || (on_board.scale.array() - 1.0).abs().maxCoeff() > 1.5 * kCoarsest) return out;
  const Matrix7 covariance = last.normal.ldlt().solve(Matrix7::Identity());
  const double excess = std::max(1.0, last.chi_square);
  // Beams tell angles; the board may stand elsewhere than where its returns are, if the joint
  // solve weighs corners against ranges.
  out.scale = places.distance * on_board.scale;
  out.sigma = (excess * noise.intensity_inflation * covariance.diagonal().head<2>())
                  .cwiseMax(0.0)
                  .cwiseSqrt();
  out.measured =
      out.sigma.allFinite() && out.sigma.minCoeff() > 0.0 && out.sigma.maxCoeff() < kLargestSigma;
  return out;
}

PrintSize size_from_places(const std::vector<Rigid3>& camera_from_board,
                           const std::vector<Rigid3>& lidar_from_board,
                           const Rigid3& camera_from_lidar, const Eigen::Vector2d& center_m) {
  PrintSize out;
  const std::size_t n = camera_from_board.size();
  if (n < 3) return out;
  const Eigen::Vector3d middle(center_m.x(), center_m.y(), 0.0);
  const auto columns = static_cast<Eigen::Index>(n);
  Eigen::Matrix3Xd by_camera(3, columns);
  Eigen::Matrix3Xd by_lidar(3, columns);
  for (std::size_t s = 0; s < n; ++s) {
    const auto k = static_cast<Eigen::Index>(s);
    by_camera.col(k) = camera_from_lidar.rotation.inverse() * (camera_from_board[s] * middle);
    by_lidar.col(k) = lidar_from_board[s] * middle;
  }
  by_camera.colwise() -= by_camera.rowwise().mean().eval();
  by_lidar.colwise() -= by_lidar.rowwise().mean().eval();
  const double spread = by_camera.squaredNorm();
  if (!(spread > 0.0)) return out;
  const double scale = by_camera.cwiseProduct(by_lidar).sum() / spread;
  // Three coordinates a board less one translation and one scale.
  const double dof = 3.0 * static_cast<double>(n) - 4.0;
  const double variance = (by_lidar - scale * by_camera).squaredNorm() / (dof - 2.0);
  out.scale.setConstant(scale);
  out.sigma.setConstant(std::sqrt(variance / spread));
  out.measured = out.sigma.allFinite() && out.sigma(0) > 0.0 && out.sigma(0) < kLargestSigma;
  return out;
}

PrintSize combined_print_size(const std::vector<PrintSize>& scenes) {
  PrintSize out;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    double weight = 0.0;
    double sum = 0.0;
    double n = 0.0;
    for (const PrintSize& s : scenes) {
      if (!s.measured) continue;
      const double w = 1.0 / (s.sigma(axis) * s.sigma(axis));
      weight += w;
      sum += w * s.scale(axis);
      n += 1.0;
    }
    if (n == 0.0) return {};
    const double mean = sum / weight;
    double chi = 0.0;
    for (const PrintSize& s : scenes) {
      if (s.measured) chi += std::pow((s.scale(axis) - mean) / s.sigma(axis), 2);
    }
    const double widened = n > 1.0 ? std::max(1.0, chi / (n - 1.0)) : 1.0;
    out.scale(axis) = mean;
    out.sigma(axis) = std::sqrt(widened / weight);
  }
  out.measured = true;
  return out;
}

PrintSize print_size_of(const std::vector<SceneSize>& scenes, const Rigid3& camera_from_lidar,
                        const Eigen::Vector2d& center_m) {
  constexpr double kClear = 4.0;
  constexpr double kUnexplained = 0.5;
  std::vector<PrintSize> by_returns;
  std::vector<Rigid3> by_camera;
  std::vector<Rigid3> by_lidar;
  std::vector<double> left;
  for (const SceneSize& scene : scenes) {
    by_returns.push_back(scene.by_returns);
    by_camera.push_back(scene.camera_from_board);
    by_lidar.push_back(scene.lidar_from_board);
    left.push_back(scene.intensity_left);
  }
  const PrintSize returns = combined_print_size(by_returns);
  const PrintSize places = size_from_places(by_camera, by_lidar, camera_from_lidar, center_m);
  if (!places.measured || std::abs(places.scale(0) - 1.0) < kClear * places.sigma(0))
    return returns;
  return !returns.measured || median(left) > kUnexplained ? places : returns;
}

}  // namespace lvcalib
