// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibration.h"
#include "pipeline/input_hashes.h"

namespace lvcalib {

/// A unit in which lengths are written where metres are expected: "in millimetres".
struct LengthUnit {
  Message what;
  double in_m;
};
std::vector<LengthUnit> other_length_units();

/// A board as an image has it, were it `size` times as large as the target says: where it may be in
/// the cloud is left open.
SceneHypotheses seen_by_camera(const BoardView& view, const Target& target, double size = 1.0);

/// After the board was not found in any cloud: whether it is found, at places of two scenes that
/// agree if there are two, once the clouds are taken for ones in millimetres, centimetres, feet or
/// inches, for mirrored ones, or for ones whose intensities belong to other points. The error that
/// says so.
std::optional<Error> diagnose_clouds(const Dataset& dataset, const CalibrationRequest& request,
                                     const CalibrationResult& result, const RunContext& context);

/// Looks for the board in other sizes (half to double, and as if the target's lengths were in other
/// units), after it was not found in its own. The size (over the model's) at which it is found, or
/// nothing.
std::optional<double> find_scaled_board(const Dataset& dataset, const CalibrationRequest& request,
                                        const CalibrationResult& result, const RunContext& context);

/// The two scenes after whose images have been exchanged all scenes agree, if they did not before.
std::optional<std::pair<std::size_t, std::size_t>> exchanged_images(
    std::vector<SceneHypotheses> scenes, int agreeing, const ConsensusOptions& options);

/// After the board was not found where images expect it: whether all of three scenes or more agree
/// once two of them exchange their clouds. The error that says so.
std::optional<Error> diagnose_exchanged_clouds(const Dataset& dataset,
                                               const CalibrationRequest& request,
                                               const CalibrationResult& result,
                                               const RunContext& context);

/// How many scenes agree by more than chance: two by their prints, three by outlines alone, which
/// have likenesses (two scenes may find panels that agree).
int fewest_agreeing(const std::vector<SceneHypotheses>& scenes, const SceneConsensus& consensus);

/// After scenes have found boards that do not agree: whether more of them than did, and two at
/// least (by outlines alone three), agree once the clouds are taken for mirrored ones. The error
/// that says so.
std::optional<Error> diagnose_mirrored(const Dataset& dataset, const CalibrationRequest& request,
                                       const CalibrationResult& result,
                                       std::vector<SceneHypotheses> scenes, int agreeing,
                                       const RunContext& context);

/// How a rough extrinsic went wrong, seen from the one that the scenes give: "it is the inverse",
/// "its translation is in millimetres", …
Message diagnose_guess(const Rigid3& guess, const Rigid3& camera_from_lidar);

/// Whole rows or columns at the end of a grid of tags that no image shows, of two images or more:
/// "no image shows tags 16 to 19: tagRows: 4 would fit". Empty if there are none.
Message diagnose_unseen_tags(const CalibrationResult& result);

/// If the images show circles of another radius than target.yaml says, by more than a quarter of a
/// pixel, which is what the places of edges within one image agree to: "circleRadius: 0.0450 would
/// fit". Empty if not.
Message better_circle_radius(const CalibrationResult& result);

/// What a scene that has been searched brings to the joint decision; nothing if it brings nothing.
SceneHypotheses hypotheses_of(const SceneResult& scene, const Target& target);

/// Scenes that agree on an extrinsic: their names, and it.
struct SceneGroup {
  std::vector<std::string> names;
  Rigid3 camera_from_lidar;
};
/// The sentence that two groups of scenes before and after each other give different extrinsics.
Message describe_bump(const SceneGroup& first, const SceneGroup& second,
                      const std::string& last_before, const std::string& first_after);

/// Whether the scenes that contradict the others agree among themselves, and come all before or all
/// after them in the order of their names: then something moved in between. So it did if scenes
/// that are all in use miss each other by ten times their noise, and by a tenth of that once they
/// are solved in two groups, before and after a moment. The sentence that says so, with both
/// extrinsics; empty if not.
Message diagnose_bump(const CalibrationResult& result);

/// How far the search for the board came in a scene.
Message search_summary(const SceneResult& scene);

/// Why a scene whose image shows the board is not used where its cloud does not: what lies at the
/// place that the other scenes give.
Message missing_board(const SceneResult& scene);

}  // namespace lvcalib
