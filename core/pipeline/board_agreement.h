// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "localization/scene_consensus.h"
#include "pipeline/calibration.h"
#include "pipeline/scene_copies.h"

namespace lvcalib {

/// What a calibration is given.
struct CalibrationInput {
  const Dataset& dataset;
  const CalibrationRequest& request;
  const RunContext& context;
  StageCache* cache;  ///< Null: there is none.
  const CalibrationObserver& observer;
};

/// What has become of it so far.
struct Calibration {
  CalibrationResult result;
  std::vector<std::optional<BoardPlane>> planes;  ///< Per scene, where it was fitted in this run.
  std::vector<char> looked_twice;                 ///< Per scene; not bool, scenes run in parallel.
  std::vector<SameContent> same;                  ///< Per scene: what it shares with another.
  bool looked_for_sizes = false;
  bool looked_for_readings = false;
};

/// What every scene brings to the joint decision about the boards' places.
std::vector<SceneHypotheses> hypotheses(const CalibrationResult& result);

/// Which of the boards found in the clouds the scenes agree on, after second looks where the others
/// put a board that is missing: sets the consensus, each scene's choice, and why one has none.
/// Errors: kUntrusted, with what would mend it where that is found; kCancelled.
Status agree_on_boards(const CalibrationInput& in, Calibration& run);

/// Second look: where the other scenes put the board, or (without them) on walls everywhere.
Status search_again(const CalibrationInput& in, Calibration& run,
                    const std::optional<Rigid3>& camera_from_lidar);

/// The error to give if no cloud shows the board, with what would mend it where that is found.
Error board_not_found(const CalibrationInput& in, Calibration& run);

/// Without circles too few scenes are left where some contradict the others: what makes them do so
/// may be what the images say themselves, or, where no two agree, how the clouds are read. The
/// error that says so.
std::optional<Error> explain_too_few_scenes(const CalibrationInput& in, Calibration& run);

}  // namespace lvcalib
