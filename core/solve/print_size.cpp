// SPDX-License-Identifier: BSD-3-Clause
#include "solve/print_size.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "base/paired_moments.h"
#include "base/statistics.h"

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

class SizeFit {
 public:
  SizeFit(const BoardReturns& returns, const BlurredPrint& print, const Rigid3& lidar_from_board,
          const BoardLevels& levels, const BeamSpread& beam, const SceneNoise& noise)
      : print_(print),
        lidar_from_board_(lidar_from_board),
        levels_(levels),
        beam_(beam),
        noise_(noise),
        center_(print.outline().center_m()) {
    const BoardPredictor predictor(print, lidar_from_board, levels, beam);
    const std::size_t stride = std::max<std::size_t>(1, returns.size() / kMostReturns);
    std::vector<double> farther;
    for (std::size_t k = 0; k < returns.size(); k += stride) {
      const Eigen::Vector3d point = returns.point_m(k);
      const auto hit = predictor.hit(point.normalized());
      if (!hit) continue;
      places_.push_back({hit->board_m, returns.intensity(k), {}});
      if (returns.intensity(k) > 0.5 * (levels.white + levels.black))
        farther.push_back(point.norm() / hit->range_m);
    }
    if (!farther.empty()) distance_ = median(std::move(farther));
  }

  PrintSize run() {
    PrintSize out;
    if (places_.size() < 10 * kUnknowns) return out;
    scale_ *= coarse_scale();
    constexpr int kIterations = 15;
    bool settled = false;
    for (int i = 0; i < kIterations && !settled; ++i) {
      if (!step()) return out;
      settled = last_.head<2>().norm() < 1e-5;
    }
    if (!settled || (scale_.array() - 1.0).abs().maxCoeff() > 1.5 * kCoarsest) return out;
    const Matrix7 covariance = normal_.ldlt().solve(Matrix7::Identity());
    const double excess = std::max(1.0, chi_square_);
    // Beams tell angles; the board may stand elsewhere than where its returns are, if the joint
    // solve weighs corners against ranges.
    out.scale = distance_ * scale_;
    out.sigma = (excess * noise_.intensity_inflation * covariance.diagonal().head<2>())
                    .cwiseMax(0.0)
                    .cwiseSqrt();
    out.measured =
        out.sigma.allFinite() && out.sigma.minCoeff() > 0.0 && out.sigma.maxCoeff() < kLargestSigma;
    return out;
  }

 private:
  struct Place {
    Eigen::Vector2d board_m;
    double intensity;
    LocalPrint seen = {};  // The print as it was seen here last.
  };

  // Where on the drawing the print at a place of the board comes from.
  [[nodiscard]] Eigen::Vector2d on_drawing(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = p - center_ - shift_;
    const double c = std::cos(spin_);
    const double s = std::sin(spin_);
    return center_ +
           Eigen::Vector2d(c * d.x() + s * d.y(), -s * d.x() + c * d.y()).cwiseQuotient(scale_);
  }

  // The stretch, alike in x and y, under which intensities and print correlate best.
  [[nodiscard]] double coarse_scale() const {
    const BlurredPrint::Coarse print = print_.coarse(0.01);
    double best = 1.0;
    double largest = 0.0;
    const int steps = static_cast<int>(kCoarsest / kCoarseStep);
    for (int k = -steps; k <= steps; ++k) {
      const double scale = 1.0 + kCoarseStep * k;
      PairedMoments moments;
      const std::size_t stride = std::max<std::size_t>(1, places_.size() / 1500);
      for (std::size_t q = 0; q < places_.size(); q += stride) {
        moments.add(print.at(center_ + (places_[q].board_m - center_) / scale),
                    places_[q].intensity);
      }
      const double rho = moments.correlation();
      if (rho > largest) {
        largest = rho;
        best = scale;
      }
    }
    return best;
  }

  bool step() {
    const BoardPredictor predictor(print_, lidar_from_board_, levels_, beam_);
    normal_.setZero();
    Vector7 gradient = Vector7::Zero();
    double squares = 0.0;
    double rows = 0.0;
    for (Place& place : places_) {
      const Eigen::Vector2d q = on_drawing(place.board_m);
      const Eigen::Vector3d at = lidar_from_board_ * Eigen::Vector3d(q.x(), q.y(), 0.0);
      const auto p = predictor.predict(at.normalized(), {}, &place.seen, &place.seen);
      if (!p) continue;
      const double plain = std::exp(p->white * std::log(noise_.intensity_white) +
                                    (1.0 - p->white) * std::log(noise_.intensity_black));
      const double variance = plain * plain + p->intensity_by_angle * beam_.jitter_rad2 *
                                                  p->intensity_by_angle.transpose();
      const double e = place.intensity - p->intensity;
      const double z = e / std::sqrt(variance);
      const double w = huber_weight(z, 3.0) / variance;
      const Eigen::RowVector2d by_shift = p->intensity_by_shift;
      const Eigen::Vector2d d = q - center_;
      Vector7 j;
      j << by_shift(0) * d.x(), by_shift(1) * d.y(), by_shift(0), by_shift(1),
          by_shift(1) * d.x() - by_shift(0) * d.y(), p->intensity_by_levels(0),
          p->intensity_by_levels(1);
      normal_ += w * j * j.transpose();
      gradient += w * e * j;
      squares += std::min(z * z, 9.0);
      rows += 1.0;
    }
    if (rows < 10 * kUnknowns) return false;
    chi_square_ = squares / (rows - kUnknowns);
    const Eigen::LDLT<Matrix7> solver(normal_);
    last_ = solver.solve(gradient);
    if (solver.info() != Eigen::Success || !last_.allFinite()) return false;
    // Beyond a feature's width the slopes say nothing.
    const double most = last_.head<2>().norm() * print_.outline().size_m().norm() / 2.0;
    const double shrink = std::min(1.0, 0.01 / std::max(1e-12, most));
    scale_ += shrink * last_.head<2>();
    shift_ += shrink * last_.segment<2>(2);
    spin_ += shrink * last_(4);
    levels_.white += shrink * last_(5);
    levels_.black += shrink * last_(6);
    return true;
  }

  const BlurredPrint& print_;
  const Rigid3& lidar_from_board_;
  BoardLevels levels_;
  const BeamSpread& beam_;
  const SceneNoise& noise_;
  Eigen::Vector2d center_;
  std::vector<Place> places_;
  Eigen::Vector2d scale_ = Eigen::Vector2d::Ones();
  Eigen::Vector2d shift_ = Eigen::Vector2d::Zero();
  double spin_ = 0.0;
  Matrix7 normal_ = Matrix7::Zero();
  Vector7 last_ = Vector7::Zero();
  double chi_square_ = 1.0;
  double distance_ = 1.0;  // Of the white returns, over that of the board as solved.
};

}  // namespace

PrintSize measure_print_size(const BoardReturns& returns, const BlurredPrint& print,
                             const Rigid3& lidar_from_board, const BoardLevels& levels,
                             const BeamSpread& beam, const SceneNoise& noise) {
  return SizeFit(returns, print, lidar_from_board, levels, beam, noise).run();
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
