// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace lvcalib::cli {

/// Whether a file may take the name of what a dataset reads: its target, its camera, a rough
/// extrinsic.
enum class DatasetFiles { kRefused, kWritten };

/// Refuses to write onto a file that is read (what was measured would be gone for good), among the
/// scenes of a dataset, where the next run would take it for one of theirs, or under a name that a
/// dataset reads, its own or another. Empty names are none.
inline Status check_output(const std::string& output, const std::vector<std::string>& inputs,
                           DatasetFiles dataset_files = DatasetFiles::kRefused) {
  namespace fs = std::filesystem;
  std::error_code code;
  for (const std::string& input : inputs) {
    if (input.empty() || !fs::equivalent(output, input, code) || code) continue;
    return Error::usage(Message("the output is the input itself"), output,
                        Message("give another name with -o"));
  }
  const fs::path whole = fs::weakly_canonical(output, code);
  if (code) return Done{};
  for (fs::path folder = whole; folder.has_relative_path(); folder = folder.parent_path()) {
    if (folder.filename() != "scenes") continue;
    const fs::path dataset = folder.parent_path();
    if (!fs::exists(dataset / "target.yaml", code) && !fs::exists(dataset / "camera.yaml", code))
      continue;
    return Error::usage(Message("the output lies among a dataset's scenes"), output,
                        Message("give a place outside %1", folder.string()));
  }
  if (dataset_files == DatasetFiles::kWritten ||
      !fs::is_directory(whole.parent_path() / "scenes", code))
    return Done{};
  for (const char* name : {"target.yaml", "camera.yaml", "rig.yaml"}) {
    if (whole.filename() != name) continue;
    return Error::usage(Message("the output would be read as a part of the dataset %1",
                                whole.parent_path().string()),
                        output, Message("give another name with -o"));
  }
  return Done{};
}

}  // namespace lvcalib::cli
