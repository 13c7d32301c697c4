// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/good_dataset.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace lvcalib::testing {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_(fs::temp_directory_path() / ("lvcalib_" + name + std::to_string(::getpid()))) {
  fs::remove_all(path_);
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code code;
  fs::remove_all(path_, code);
}

const fs::path& good_dataset() {
  static const TemporaryFolder folder("good");
  static const fs::path dataset = [] {
    const fs::path path = folder.path() / "dataset";
    const Outcome outcome =
        run_lvcalib({"simulate", "-o", path, "--seed", "11", "--scenes", "3", "--points", "120000",
                     "--image", "1024x768", "--distance", "2:2.5", "--quiet"});
    if (outcome.status != 0) {
      throw std::runtime_error("the good dataset cannot be made: " + outcome.err);
    }
    return path;
  }();
  return dataset;
}

std::vector<std::string> scene_names(const fs::path& dataset) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(dataset / "scenes")) {
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void copy_dataset(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const char* name : {"target.yaml", "camera.yaml"}) fs::copy_file(from / name, to / name);
  for (const std::string& scene : scene_names(from)) {
    fs::create_directories(to / "scenes" / scene);
    for (const auto& entry : fs::directory_iterator(from / "scenes" / scene)) {
      fs::create_symlink(entry.path(), to / "scenes" / scene / entry.path().filename());
    }
  }
}

void write_file(const fs::path& path, std::string_view content) {
  fs::remove(path);
  std::ofstream(path, std::ios::binary) << content;
}

std::string read_file(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void replace_text(const fs::path& path, const std::string& from, const std::string& to) {
  std::string text = read_file(path);
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from << " is not in " << text;
  write_file(path, text.replace(at, from.size(), to));
}

std::vector<std::string> unfinished_files(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    if (name.find(".part") != std::string::npos) found.push_back(entry.path());
  }
  return found;
}

}  // namespace lvcalib::testing
