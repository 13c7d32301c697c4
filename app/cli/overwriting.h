// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace lvcalib::cli {

/// Refuses a name that a dataset reads: what its target, its camera or a rough extrinsic is.
inline Status check_no_part_of_dataset(const std::string& output) {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path whole = fs::weakly_canonical(output, code);
  if (code) return Done{};
  const auto is = [&](const char* name) { return whole.filename() == name; };
  if (!is("target.yaml") && !is("camera.yaml") && !is("rig.yaml")) return Done{};
  const fs::path dataset = whole.parent_path();
  if (!fs::is_directory(dataset / "scenes", code)) return Done{};
  return Error::usage(
      Message("the output would be read as a part of the dataset %1", dataset.string()), output,
      Message("give another name with -o"));
}

/// Refuses to write onto a file that is read (what was measured would be gone for good), or among
/// the scenes of a dataset, where the next run would take it for one of theirs. Empty names are
/// none.
inline Status check_output(const std::string& output, const std::vector<std::string>& inputs) {
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
  return Done{};
}

}  // namespace lvcalib::cli
