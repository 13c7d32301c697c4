// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>

namespace lvcalib::test {

/// A rig that is not of this project, in the folder that LVCALIB_SHARED_DATA names or in
/// shared/data beside the source folder; need not be there.
inline std::filesystem::path shared_rig(const std::filesystem::path& name) {
  const char* set = std::getenv("LVCALIB_SHARED_DATA");
  const std::filesystem::path data =
      set != nullptr ? std::filesystem::path(set)
                     : std::filesystem::path(LVCALIB_SOURCE_DIR).parent_path() / "shared" / "data";
  return data / name;
}

}  // namespace lvcalib::test
