// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "base/rigid3.h"
#include "cloud/cloud.h"
#include "model/board_prediction.h"
#include "solve/covered_places.h"

namespace lvcalib {

/// A part of the board that something covers, and the returns that were left out because of it.
struct CoveredPatch {
  Eigen::AlignedBox2d board_m;
  std::size_t returns = 0;
};

/// Standard deviation that rounding to whole steps leaves, in steps: 1/√12.
inline constexpr double kRoundingSigma = 0.2887;

/// The returns of one scene that lie on the board, as places in the scene's cloud.
struct BoardReturns {
  const Cloud* cloud = nullptr;
  std::vector<std::uint32_t> index;
  std::size_t on_board = 0;     ///< Rays that meet the board's inside, refused ones included.
  bool has_intensity = false;   ///< And it is not the same on all of them.
  double intensity_step = 0.0;  ///< Of numbers that come in few steps, the smallest; else 0.
  double saturated = 0.0;       ///< Share at the largest value, where they pile up there; else 0.
  std::size_t refused = 0;  ///< Of them, those that lie off the plane or next to what covers it.
  std::vector<CoveredPatch> covered;
  /// Correlation of neighbours along a line is measured over these: places in `index` whose
  /// successor on the same line is the next place of `successor`, or kNone.
  static constexpr std::uint32_t kNone = 0xffffffffU;
  std::vector<std::uint32_t> successor;

  [[nodiscard]] std::size_t size() const { return index.size(); }
  [[nodiscard]] Eigen::Vector3d point_m(std::size_t k) const {
    return cloud->points_m[index[k]].cast<double>();
  }
  [[nodiscard]] double intensity(std::size_t k) const {
    return static_cast<double>(cloud->intensity[index[k]]);
  }
};

struct ReturnSelection {
  /// The spot must lie inside the outline by so many of its widths (one σ).
  double inside_sigmas = 3.0;
  /// And by so much more: the board's place in its plane is known no better.
  double place_m = 0.0;
  /// A return farther than this many standard deviations of its range from the plane is not on it.
  double range_gate = 5.0;
  /// Look for what stands close before the board or lies on it (see cover_crowds() and
  /// cover_patches()). Off while the board may be off its place.
  bool covers = true;
  /// Parts of the board where nothing counts as covered, whatever it looks like.
  std::vector<BoardOutline> uncovered = {};
  /// What effects in the model add to the range of a point of the cloud; empty: nothing. A return
  /// is on the board if its range agrees with or without that: what an effect has brought in stays
  /// in should the effect be wrong. It is asked of those returns alone that do not agree.
  std::function<double(std::uint32_t)> added_m = {};
};

/// Picks the returns on a board at `lidar_from_board`: those whose ray meets the board's inside and
/// whose range agrees with its plane. Where something stands before the board or lies on it,
/// returns within three spot widths of it are left out as well: part of their light comes from it.
BoardReturns select_returns(const Cloud& cloud, const BlurredPrint& print,
                            const Rigid3& lidar_from_board, const BeamSpread& beam,
                            const RangeNoise& noise, const ReturnSelection& selection = {});

/// Below this intensity_structure() returns show no print: noise alone gives one, with a few
/// hundred returns ± 0.1; a print of a contrast of half the noise adds this quarter.
inline constexpr double kPlainStructure = 1.25;

/// How much the intensities vary over the board against what neighbours along the scan differ by:
/// ½·E[difference²] of noise alone is the variance, so that one means no print to be seen.
double intensity_structure(const BoardReturns& returns);

/// Share of sixteen parts of the board with at least a fifth of the returns that the fuller half of
/// them has.
double seen_share(const BoardReturns& returns, const BlurredPrint& print,
                  const Rigid3& lidar_from_board);

}  // namespace lvcalib
