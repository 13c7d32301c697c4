// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "base/progress.h"
#include "base/rigid3.h"
#include "solve/board_returns.h"

namespace lvcalib {

/// A pose for the board within a neighbourhood of another, found by the print alone.
struct PrintMatch {
  Rigid3 lidar_from_board;
  double correlation = 0.0;     ///< Between intensities and blurred print.
  double log_likelihood = 0.0;  ///< Over that of no print at all.
};

/// Poses at least so far apart are different places of the print: half of the smallest feature that
/// a LiDAR resolves at two metres.
inline constexpr double kOtherPlace_m = 0.04;

struct PrintSearch {
  double reach_m = 0.075;  ///< Moves tried along each axis of the board.
  double turn_rad = 0.1;   ///< Turns tried about its normal.
  std::size_t samples = 1500;
  std::size_t places = 4;  ///< Local maxima followed to the end.
};

/// Slides and turns the board on its plane until the intensities fit best. The best pose first,
/// then the best of those elsewhere (`places` in all); none where no pose correlates.
std::vector<PrintMatch> match_print(const BoardReturns& returns, const BlurredPrint& print,
                                    const Rigid3& lidar_from_board, const PrintSearch& search = {},
                                    int threads = 1);

/// One scene's print, as it is seen before the joint solve.
struct PrintSighting {
  double correlation = 0.0;  ///< 0: no pose correlates, or there are no intensities.
  double margin = 0.0;       ///< Log-likelihood by which its place beats the best other one.
  bool unseen = false;       ///< There are intensities, and the print is not in them.
};

/// What the prints of all scenes say together about the extrinsic.
struct PrintVote {
  Rigid3 camera_from_lidar;
  /// Log-likelihood by which the print's place beats the best place elsewhere, or no print at all.
  double margin = 0.0;
  std::vector<PrintSighting> scenes;
};

/// Each scene's print votes for an extrinsic, and for the next best; the vote under which all
/// scenes' prints fit best wins, the start included. `camera_from_board` holds for the votes. Empty
/// where the context stops it.
std::optional<PrintVote> vote_on_print(const std::vector<BoardReturns>& returns,
                                       const BlurredPrint& print,
                                       const std::vector<Rigid3>& camera_from_board,
                                       const Rigid3& camera_from_lidar, const PrintSearch& search,
                                       const RunContext& context);

}  // namespace lvcalib
