// SPDX-License-Identifier: BSD-3-Clause
#include "solve/board_returns.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lvcalib {
namespace {

// What stands before the board is nearer by more than any range effect moves a return.
constexpr double kCover_m = 0.03;
constexpr double kCoverSpots = 3.0;  // Widths of a Gaussian spot, beyond which 1 % of it lies.

// Square cells over the board that something covers.
class CoveredCells {
 public:
  CoveredCells(const BoardOutline& outline, double cell_m)
      : low_(outline.lower_left_m),
        cell_m_(cell_m),
        columns_(static_cast<int>(std::ceil(outline.size_m().x() / cell_m)) + 1),
        rows_(static_cast<int>(std::ceil(outline.size_m().y() / cell_m)) + 1),
        covered_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

  void cover(const Eigen::Vector2d& p, double radius_m) {
    any_ = true;
    const Eigen::Vector2d a = (p - low_).array() - radius_m;
    const Eigen::Vector2d b = (p - low_).array() + radius_m;
    for (int r = row(a.y()); r <= row(b.y()); ++r) {
      for (int c = column(a.x()); c <= column(b.x()); ++c) at(c, r) = 1;
    }
  }
  [[nodiscard]] bool covers(const Eigen::Vector2d& p) const {
    if (!any_) return false;
    const Eigen::Vector2d d = p - low_;
    return covered_[place(column(d.x()), row(d.y()))] != 0;
  }

 private:
  [[nodiscard]] int column(double x) const {
    return std::clamp(static_cast<int>(std::floor(x / cell_m_)), 0, columns_ - 1);
  }
  [[nodiscard]] int row(double y) const {
    return std::clamp(static_cast<int>(std::floor(y / cell_m_)), 0, rows_ - 1);
  }
  [[nodiscard]] std::size_t place(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c);
  }
  std::uint8_t& at(int c, int r) { return covered_[place(c, r)]; }
  Eigen::Vector2d low_;
  double cell_m_;
  int columns_, rows_;
  std::vector<std::uint8_t> covered_;
  bool any_ = false;
};

// Board coordinates and intensity of one return, for the search.
struct Sample {
  Eigen::Vector2d board_m;
  double intensity;
};

struct Trial {
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;
  double correlation = 0.0;
};

// Correlation of the samples with the print when the board is shifted and turned about its middle.
double correlation(const std::vector<Sample>& samples, const BlurredPrint& print,
                   const Trial& trial, double sigma_m) {
  const Eigen::Vector2d center = print.outline().center_m();
  const double c = std::cos(trial.turn_rad);
  const double s = std::sin(trial.turn_rad);
  double n = 0, a = 0, i = 0, aa = 0, ii = 0, ai = 0;
  for (const Sample& sample : samples) {
    const Eigen::Vector2d d = sample.board_m - center - trial.shift_m;
    const Eigen::Vector2d p =
        center + Eigen::Vector2d(c * d.x() + s * d.y(), -s * d.x() + c * d.y());
    const double white = print.coarse(p, sigma_m);
    n += 1;
    a += white;
    i += sample.intensity;
    aa += white * white;
    ii += sample.intensity * sample.intensity;
    ai += white * sample.intensity;
  }
  const double va = aa - a * a / n;
  const double vi = ii - i * i / n;
  return va > 0.0 && vi > 0.0 ? (ai - a * i / n) / std::sqrt(va * vi) : 0.0;
}

}  // namespace

BoardReturns select_returns(const Cloud& cloud, const BlurredPrint& print,
                            const Rigid3& lidar_from_board, const BeamSpread& beam,
                            double range_sigma_m, const ReturnSelection& selection) {
  const BoardPredictor predictor(print, lidar_from_board, {}, beam);
  const double beam_rad = std::sqrt(beam.blur_rad2.trace());
  BoardReturns out;
  out.cloud = &cloud;
  CoveredCells covered(print.outline(), 0.01);
  const double gate = selection.range_gate * range_sigma_m;
  const double cover = std::max(kCover_m, 2.0 * gate);
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const double range = p.norm();
    const auto hit = predictor.hit(p / range);
    if (!hit) continue;
    const double inside = print.inside_m(hit->board_m);
    if (inside <= 0.0) continue;
    const double off = range - hit->range_m;
    // One spot is wider than the beam's angles span by 1/cos θ at most.
    const double spot = beam_rad * range / 0.5;
    if (off < -cover) {
      covered.cover(hit->board_m, kCoverSpots * spot);
      ++out.on_board;
      ++out.refused;
      continue;
    }
    if (inside < selection.inside_sigmas * beam_rad * range) continue;
    ++out.on_board;
    if (std::abs(off) > gate) {
      ++out.refused;
      continue;
    }
    out.index.push_back(static_cast<std::uint32_t>(i));
    places.push_back(hit->board_m);
  }
  std::size_t kept = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (covered.covers(places[k])) continue;
    out.index[kept] = out.index[k];
    ++kept;
  }
  out.refused += places.size() - kept;
  out.index.resize(kept);

  // Some drivers fill the field with one number.
  out.has_intensity = cloud.has_intensity() && kept > 0 &&
                      std::any_of(out.index.begin(), out.index.end(), [&](std::uint32_t i) {
                        return cloud.intensity[i] != cloud.intensity[out.index.front()];
                      });

  out.successor.assign(kept, BoardReturns::kNone);
  std::map<std::uint16_t, std::uint32_t> last;
  for (std::uint32_t k = 0; k < kept; ++k) {
    const std::uint16_t line = cloud.has_line() ? cloud.line[out.index[k]] : std::uint16_t{0};
    const auto [at, fresh] = last.try_emplace(line, k);
    if (!fresh) {
      out.successor[at->second] = k;
      at->second = k;
    }
  }
  return out;
}

std::optional<PrintMatch> match_print(const BoardReturns& returns, const BlurredPrint& print,
                                      const Rigid3& lidar_from_board, const PrintSearch& search) {
  constexpr std::size_t kFewest = 30;  // A correlation of 0.3, asked for below, is then 1.6 σ.
  if (!returns.has_intensity || returns.size() < kFewest) return std::nullopt;
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  std::vector<Sample> samples;
  const std::size_t stride = std::max<std::size_t>(1, returns.size() / search.samples);
  for (std::size_t k = 0; k < returns.size(); k += stride) {
    const auto hit = predictor.hit(returns.point_m(k).normalized());
    if (hit) samples.push_back({hit->board_m, returns.intensity(k)});
  }
  // Coarse to fine: the first blur joins what a step parts.
  const double radius = 0.5 * print.outline().size_m().norm();
  std::vector<Trial> best{Trial{}};
  double step = 0.0;
  double turn = 0.0;
  std::vector<Trial> coarse;
  for (const double sigma : {0.016, 0.008, 0.004}) {
    const bool first = step == 0.0;
    const double next_step = sigma;
    const double next_turn = std::max(0.002, 1.2 * sigma / radius);
    std::vector<Trial> tried;
    for (const Trial& from : best) {
      const double reach = first ? search.reach_m : step;
      const double turns = first ? search.turn_rad : turn;
      const int n = static_cast<int>(std::ceil(reach / next_step));
      const int m = static_cast<int>(std::ceil(turns / next_turn));
      for (int ix = -n; ix <= n; ++ix) {
        for (int iy = -n; iy <= n; ++iy) {
          for (int it = -m; it <= m; ++it) {
            Trial t = from;
            t.shift_m += next_step * Eigen::Vector2d(ix, iy);
            t.turn_rad += next_turn * it;
            t.correlation = correlation(samples, print, t, sigma);
            tried.push_back(t);
          }
        }
      }
    }
    std::sort(tried.begin(), tried.end(),
              [](const Trial& a, const Trial& b) { return a.correlation > b.correlation; });
    if (first) coarse = tried;
    // A few well apart: neighbours of the best would only repeat it.
    best.clear();
    for (const Trial& t : tried) {
      const bool taken = std::any_of(best.begin(), best.end(), [&](const Trial& other) {
        return (t.shift_m - other.shift_m).norm() < 1.5 * next_step &&
               std::abs(t.turn_rad - other.turn_rad) < 1.5 * next_turn;
      });
      if (!taken) best.push_back(t);
      if (best.size() == (first ? 6U : 2U)) break;
    }
    step = next_step;
    turn = next_turn;
  }
  const Trial& winner = best.front();
  if (!(winner.correlation > 0.3)) return std::nullopt;
  PrintMatch match;
  match.correlation = winner.correlation;
  // Likelihood with the levels fitted: −n/2·ln(1 − ρ²).
  const auto likelihood = [&](double rho) {
    const double r = std::clamp(rho, 0.0, 0.9999);
    return -0.5 * static_cast<double>(samples.size()) * std::log(1.0 - r * r);
  };
  double other = 0.0;
  for (const Trial& t : coarse) {
    if ((t.shift_m - winner.shift_m).norm() < 0.04) continue;
    other = std::max(other, likelihood(correlation(samples, print, t, 0.008)));
    break;
  }
  match.margin = likelihood(winner.correlation) - other;
  const Eigen::Vector2d center = print.outline().center_m();
  const Eigen::Vector3d middle(center.x(), center.y(), 0.0);
  const Eigen::Vector3d shifted =
      middle + Eigen::Vector3d(winner.shift_m.x(), winner.shift_m.y(), 0.0);
  const Eigen::Matrix3d spin = so3_exp({0.0, 0.0, winner.turn_rad}).toRotationMatrix();
  match.lidar_from_board = lidar_from_board * Rigid3::from_matrix(spin, shifted - spin * middle);
  return match;
}

}  // namespace lvcalib
