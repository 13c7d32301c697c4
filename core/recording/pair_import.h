// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "cloud/cloud.h"
#include "recording/file_pairs.h"

namespace lvcalib {

/// The cloud of a pair: a pcd or ply file, KITTI's bin (by its name), or all clouds of a recording
/// as one. Errors as of their readers.
Result<Cloud> read_pair_cloud(const std::filesystem::path& path, const RunContext& context);

struct PairImportOptions {
  std::string target_yaml;       ///< Content of the dataset's target.yaml.
  std::optional<Camera> camera;  ///< Instead of intrinsics that lie with the files.
  /// Says why the board cannot be seen in an image; empty: it can. Not asked without intrinsics.
  std::function<Message(const std::filesystem::path& image, const Camera& camera)> board_check;
  /// False if the board is a guess: pairs without it are left only if others show it.
  bool board_is_certain = true;
  bool force = false;  ///< Replace an earlier import.
};

/// One pair and what became of it.
struct ImportedPair {
  FilePair files;
  bool taken = false;
  Message reason;  ///< In words, why it was left; empty if it was taken.
  std::size_t points = 0;
  std::vector<Message> cloud_warnings;  ///< See Cloud::warnings.
  Message board_complaint;  ///< Why a scene that was taken does not show the guessed board.
};

struct PairImportSummary {
  FileLayout layout = FileLayout::kSameName;
  bool has_camera = false;  ///< The dataset has a camera.yaml.
  std::vector<ImportedPair> pairs;
  std::vector<Message> warnings;
  [[nodiscard]] std::size_t scene_count() const;
};

/// Makes a dataset folder of pairs of files: one scene each, with the image as it is, the cloud as
/// it is (KITTI's bin and recordings as PCD), target.yaml, camera.yaml if intrinsics are known, and
/// import.json, which says what became of each. Pairs whose image or cloud cannot be read, or whose
/// image is of another size than the camera's, are left with their reason. DATASET takes its name
/// only when all of it is written.
/// Errors: DATASET exists; no pair can be used (naming why); a stop.
Result<PairImportSummary> import_pairs(const PairedFiles& files, const PairImportOptions& options,
                                       const std::filesystem::path& dataset,
                                       const RunContext& context);

/// Adds pairs to a dataset folder that is there, as import_pairs() makes scenes of them. Each scene
/// is written under a name that begins with a dot and takes its own when it is complete: whoever
/// lists the dataset meanwhile never sees part of one. What became of each is added to the
/// dataset's import.json if it has one. A pair whose name a scene has already is left. `options`:
/// camera (the dataset's), board_check and board_is_certain count. Errors: no such folder; it
/// cannot be written; a stop. The scenes before stay.
Result<PairImportSummary> add_pairs(const std::vector<FilePair>& pairs,
                                    const PairImportOptions& options,
                                    const std::filesystem::path& dataset,
                                    const RunContext& context);

/// Why image or cloud of a pair cannot be read (another format, truncated, damaged); empty if both
/// can.
Message pair_complaint(const FilePair& pair, const RunContext& context);

}  // namespace lvcalib
