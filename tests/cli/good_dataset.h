// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/child_process.h"

namespace lvcalib::testing {

/// A folder of its own in the system's place for temporary files; gone with the object.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& name);
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A small simulated dataset with scenes A, B and C, made once per test program, with
/// PATH-truth.json beside it. Not to be written to.
const std::filesystem::path& good_dataset();

/// The names of its scenes, sorted.
std::vector<std::string> scene_names(const std::filesystem::path& dataset);

/// A copy that may be spoiled; images and clouds are links to the original's.
void copy_dataset(const std::filesystem::path& from, const std::filesystem::path& to);

/// Replaces a file (never what a link points to).
void write_file(const std::filesystem::path& path, std::string_view content);
std::string read_file(const std::filesystem::path& path);

/// Replaces the first `from` in a text file; a test that finds none has failed.
void replace_text(const std::filesystem::path& path, const std::string& from,
                  const std::string& to);

/// Everything below a folder whose name says that it is unfinished.
std::vector<std::string> unfinished_files(const std::filesystem::path& folder);

}  // namespace lvcalib::testing
