// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "pipeline/session.h"
#include "selection/model_session.h"

namespace lvcalib {

/// What the user calls the frames of the two sensors in exports.
struct ProjectFrames {
  std::string lidar;
  std::string camera;
  bool operator==(const ProjectFrames&) const = default;
};

/// A project: where the dataset is and what the user decided about it. Stored as YAML text with
/// paths relative to the project file.
struct Project {
  std::filesystem::path dataset;  ///< Absolute.
  Decisions decisions;
  std::vector<ModelDecision> model;          ///< What was done to the model of effects, in order.
  std::optional<ProjectFrames> frames = {};  ///< None: nothing was said.
};

/// A project read from a file.
struct ProjectFile {
  Project project;
  std::vector<Message> warnings;  ///< Unknown keys and options.
};

/// Format version that this program writes; files of a newer one are refused.
inline constexpr int kProjectVersion = 1;

/// The project as text; `folder` is what its paths are relative to.
std::string project_as_text(const Project& project, const std::filesystem::path& folder);

/// Writes a project atomically.
Status write_project(const std::filesystem::path& path, const Project& project);

/// Reads a project; neither it nor the dataset is touched.
/// Errors (kInput): not a project; a newer version; a value of the wrong type or range.
Result<ProjectFile> read_project(const std::filesystem::path& path);

/// Reads text as if it stood in a file `path`.
Result<ProjectFile> project_from_text(const std::string& text, const std::filesystem::path& path);

/// How a project meets its dataset.
struct OpenedProject {
  /// The folder is not where the project says: ask for it. `dataset` is empty then.
  bool dataset_moved = false;
  Dataset dataset;                          ///< With the added scenes that are there.
  std::vector<std::string> missing_scenes;  ///< Decided about in the project, not found on disk.
  std::vector<Message> warnings;
};

/// Opens the project's dataset. Errors: as open_dataset(), if the folder is there;
/// scenes that cannot be used are left out with their reasons.
Result<OpenedProject> open_project_dataset(const Project& project);

/// What a project's decisions give: its dataset calibrated from nothing, with the effects that its
/// model has. Errors: kInput if the dataset is not where the project says; those of open_dataset(),
/// run_session() and apply_decision().
Result<std::shared_ptr<const CalibrationResult>> calibrate_project(const Project& project,
                                                                   const RunContext& context);

}  // namespace lvcalib
