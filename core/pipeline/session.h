// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib {

/// What the user decided about one scene.
struct SceneDecision {
  bool use = true;
  bool insist = false;  ///< Used though it contradicts the others or shows too few circles.
  std::optional<CropBox> crop;
  SceneEdits edits;  ///< What of it is left out by hand.
  std::string note;  ///< The user's own words about it.
  bool operator==(const SceneDecision&) const = default;
};

/// Everything the user decided about a dataset; with the dataset it determines the result.
struct Decisions {
  std::map<std::string, SceneDecision> scenes;  ///< Scenes without an entry are used, uncropped.
  CalibrationOptions options;
  std::optional<Rigid3> guess;  ///< Rough T_camera_lidar; takes the place of rig.yaml's.
  bool use_crops = false;       ///< Take board.pcd instead of cloud.pcd where present.
  std::vector<std::filesystem::path> added_scenes;  ///< Scene folders besides the dataset's own.
  /// In which order scenes are listed; those that are not in it follow by name.
  std::vector<std::string> scene_order;
};

/// True if two sets of options have the same values.
bool same_options(const CalibrationOptions& a, const CalibrationOptions& b);

/// True if two sets of decisions ask for the same calibration: notes and the order of the list are
/// words about it.
bool same_calibration(const Decisions& a, const Decisions& b);

/// The scene's decision, or the default one.
SceneDecision decision_of(const Decisions& decisions, const std::string& scene);

/// Adds scene folders to a dataset, sorted in by name.
/// Errors (kInput): a folder without image or cloud; a name that is taken already.
Status add_scenes(Dataset& dataset, const std::vector<std::filesystem::path>& folders);

/// The decisions as one request to calibrate(): what `lvcalib calibrate` would get.
CalibrationRequest request_of(const Dataset& dataset, const Decisions& decisions);

/// What a run leaves for the next one. Cheap to copy; nothing in it is changed once made.
struct SessionState {
  StageCache cache;
  CalibrationRequest request;  ///< Of the last whole run.
  std::vector<std::string> scene_names;
  std::shared_ptr<const CalibrationResult> whole;   ///< Of the last whole run.
  std::shared_ptr<const CalibrationResult> latest;  ///< After the last run of any kind.
};

/// Outcome of a run: the state for the next one, which is worth keeping also after an error.
struct SessionRun {
  SessionState state;
  std::optional<Error> error;
  bool solved_only = false;  ///< Only the joint solve was run.
};

/// What run_session() would give with these decisions from the features of the last whole run, for
/// a look at options of the solve before they are taken. Errors as resolve_calibration(); kUsage
/// before the first whole run.
Result<CalibrationResult> preview_session(const Dataset& dataset, const Decisions& decisions,
                                          const SessionState& state, const RunContext& context);

/// Brings the result up to date with the decisions, running what they touch and nothing else:
/// scenes taken out or back in → the joint solve from kept features; a crop box → that scene's
/// search and what follows; an option → its stage and what follows. From an empty state it is the
/// same as calibrate().
SessionRun run_session(const Dataset& dataset, const Decisions& decisions, SessionState state,
                       const RunContext& context, const CalibrationObserver& observer = {});

}  // namespace lvcalib
