// SPDX-License-Identifier: BSD-3-Clause
#include "solve/board_returns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

// What stands before the board is nearer by more than any range effect moves a return.
constexpr double kCover_m = 0.03;
constexpr double kCoverSpots = 3.0;  // Widths of a Gaussian spot, beyond which 1 % of it lies.

// Steps and ceiling of the intensities.
void describe_numbers(BoardReturns& returns) {
  // More different values than this are no steps that matter.
  constexpr std::size_t kMostSteps = 64;
  // Numbers pile up at a ceiling if this share of them is there, many times a value's usual share.
  constexpr double kPile = 0.05;
  constexpr double kPileOverUsual = 8.0;
  std::vector<float> values;
  values.reserve(returns.size());
  for (const std::uint32_t i : returns.index) values.push_back(returns.cloud->intensity[i]);
  std::sort(values.begin(), values.end());
  const float largest = values.back();
  const auto first = std::lower_bound(values.begin(), values.end(), largest);
  const double share =
      static_cast<double>(values.end() - first) / static_cast<double>(values.size());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() <= kMostSteps) {
    float step = largest;
    for (std::size_t k = 1; k < values.size(); ++k)
      step = std::min(step, values[k] - values[k - 1]);
    returns.intensity_step = static_cast<double>(step);
  }
  if (share > kPile && share * static_cast<double>(values.size()) > kPileOverUsual)
    returns.saturated = share;
}

}  // namespace

BoardReturns select_returns(const Cloud& cloud, const BlurredPrint& print,
                            const Rigid3& lidar_from_board, const BeamSpread& beam,
                            const RangeNoise& noise, const ReturnSelection& selection) {
  const BoardPredictor predictor(print, lidar_from_board, {}, beam);
  const double beam_rad = std::sqrt(beam.blur_rad2.trace());
  const BoardOutline& outline = print.outline();
  const Eigen::Vector2d center = outline.center_m();
  const double middle_m = (lidar_from_board * Eigen::Vector3d(center.x(), center.y(), 0.0)).norm();
  // One axis of the spot, as the nearest sample of the print need not know better.
  const BlurredPrint::Coarse blurred = print.coarse(beam_rad * middle_m / std::sqrt(2.0));
  BoardReturns out;
  out.cloud = &cloud;
  CoveredCells covered(outline);
  std::vector<PlacedReturn> near;
  std::vector<PlacedReturn> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const double range = p.norm();
    const auto hit = predictor.hit(p / range);
    if (!hit) continue;
    const double inside = print.inside_m(hit->board_m);
    if (inside <= 0.0) continue;
    const double white = blurred.at(hit->board_m);
    PlacedReturn at{static_cast<std::uint32_t>(i), hit->board_m, range - hit->range_m,
                    noise_between(noise.white_m, noise.black_m, white), white,
                    // One spot is wider than the beam's angles span by 1/cos θ at most.
                    kCoverSpots * beam_rad * range / 0.5};
    const double gate = selection.range_gate * at.sigma_m;
    if (selection.added_m && std::abs(at.off_m) > gate) {
      const double off = at.off_m - selection.added_m(at.point);
      if (std::abs(off) < std::abs(at.off_m)) at.off_m = off;
    }
    if (at.off_m < -std::max(kCover_m, 2.0 * gate)) {
      covered.cover(at.board_m, at.reach_m);
      ++out.on_board;
      ++out.refused;
      continue;
    }
    if (at.off_m < -std::max(kCover_m, kTooNear * at.sigma_m)) near.push_back(at);
    if (inside < selection.inside_sigmas * beam_rad * range + selection.place_m) continue;
    ++out.on_board;
    if (std::abs(at.off_m) > gate) {
      ++out.refused;
      continue;
    }
    kept.push_back(at);
  }
  if (selection.covers) {
    cover_crowds(near, kept, outline, covered);
    cover_patches(kept, cloud, outline, covered);
  }
  for (const Eigen::AlignedBox2d& box : covered.patches()) out.covered.push_back({box, 0});
  const auto is_uncovered = [&](const Eigen::Vector2d& place_m) {
    return std::any_of(selection.uncovered.begin(), selection.uncovered.end(),
                       [&](const BoardOutline& part) { return part.contains(place_m); });
  };
  for (const PlacedReturn& r : kept) {
    if (!covered.covers(r.board_m) || is_uncovered(r.board_m)) {
      out.index.push_back(r.point);
      continue;
    }
    ++out.refused;
    for (CoveredPatch& patch : out.covered) {
      if (!patch.board_m.contains(r.board_m)) continue;
      ++patch.returns;
      break;
    }
  }
  std::erase_if(out.covered, [](const CoveredPatch& patch) { return patch.returns == 0; });

  // Some drivers fill the field with one number.
  out.has_intensity = cloud.has_intensity() && !out.index.empty() &&
                      std::any_of(out.index.begin(), out.index.end(), [&](std::uint32_t i) {
                        return cloud.intensity[i] != cloud.intensity[out.index.front()];
                      });

  if (out.has_intensity) describe_numbers(out);

  out.successor.assign(out.size(), BoardReturns::kNone);
  std::map<std::uint16_t, std::uint32_t> last;
  for (std::uint32_t k = 0; k < out.index.size(); ++k) {
    const std::uint16_t line = cloud.has_line() ? cloud.line[out.index[k]] : std::uint16_t{0};
    const auto [at, fresh] = last.try_emplace(line, k);
    if (!fresh) {
      out.successor[at->second] = k;
      at->second = k;
    }
  }
  return out;
}

double intensity_structure(const BoardReturns& returns) {
  constexpr double kFewest = 20.0;
  double n = 0, sum = 0, squares = 0, pairs = 0, differences = 0;
  for (std::size_t k = 0; k < returns.size(); ++k) {
    const double i = returns.intensity(k);
    n += 1;
    sum += i;
    squares += i * i;
    const std::uint32_t next = returns.successor[k];
    if (next == BoardReturns::kNone) continue;
    pairs += 1;
    differences += std::pow(returns.intensity(next) - i, 2);
  }
  if (n < kFewest || pairs < kFewest || !(differences > 0.0)) return 1.0;
  return (squares / n - std::pow(sum / n, 2)) / (0.5 * differences / pairs);
}

double seen_share(const BoardReturns& returns, const BlurredPrint& print,
                  const Rigid3& lidar_from_board) {
  constexpr int kParts = 4;
  constexpr double kFewest = 0.2;
  const BoardOutline& outline = print.outline();
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  std::array<double, kParts * kParts> count{};
  for (std::size_t k = 0; k < returns.size(); ++k) {
    const auto hit = predictor.hit(returns.point_m(k).normalized());
    if (!hit) continue;
    const Eigen::Vector2d t =
        kParts * (hit->board_m - outline.lower_left_m).cwiseQuotient(outline.size_m());
    const int x = std::clamp(static_cast<int>(t.x()), 0, kParts - 1);
    const int y = std::clamp(static_cast<int>(t.y()), 0, kParts - 1);
    count[static_cast<std::size_t>(y * kParts + x)] += 1.0;
  }
  std::vector<double> sorted(count.begin(), count.end());
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() * 3 / 4];
  const auto seen = std::count_if(count.begin(), count.end(),
                                  [&](double n) { return n > 0.0 && n >= kFewest * usual; });
  return static_cast<double>(seen) / static_cast<double>(count.size());
}

}  // namespace lvcalib
