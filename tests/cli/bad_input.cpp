// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bad_input.h"

#include <ostream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lvcalib::testing {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::ostream& operator<<(std::ostream& stream, const BadInput& input) {
  return stream << input.name;
}

SpoiledRun::SpoiledRun(const BadInput& input) : input_(input), folder_("bad_" + input.name) {
  const fs::path dataset = folder_.path() / "dataset";
  copy_dataset(good_dataset(), dataset);
  if (input_.spoil) input_.spoil(dataset);
  std::vector<std::string> arguments = {"calibrate", "dataset", "-o", "out"};
  arguments.insert(arguments.end(), input_.arguments.begin(), input_.arguments.end());
  RunSettings settings;
  settings.folder = folder_.path();
  settings.unprivileged = input_.unprivileged;
  // Only what the case forbids is forbidden.
  if (input_.unprivileged) fs::permissions(folder_.path(), fs::perms::all);
  outcome_ = run_lvcalib(arguments, settings);
}

std::string SpoiledRun::error() const {
  const auto lines = lines_with(outcome_.err, "lvcalib: error: ");
  return lines.size() == 1 ? lines.front() : std::string{};
}

void SpoiledRun::expect_as_described() const {
  EXPECT_FALSE(outcome_.timed_out);
  EXPECT_EQ(outcome_.status, input_.status) << outcome_.err;
  EXPECT_EQ(outcome_.out, "");
  EXPECT_EQ(lines_with(outcome_.err, "lvcalib: error: ").size(), 1U) << outcome_.err;
  for (const std::string& part : input_.message) EXPECT_THAT(error(), HasSubstr(part));
  expect_no_partial_output();
}

// A run without a trustworthy result may leave it for inspection, but then as a whole.
void SpoiledRun::expect_no_partial_output() const {
  EXPECT_THAT(unfinished_files(folder_.path()), ::testing::IsEmpty());
  if (!fs::exists(output())) return;
  EXPECT_EQ(input_.status, 1);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(output())) {
    names.insert(entry.path().filename());
  }
  EXPECT_EQ(names, (std::set<std::string>{"result.json", "result.yaml"}));
  const auto json = nlohmann::json::parse(read_file(output() / "result.json"), nullptr, false);
  ASSERT_TRUE(json.is_object());
  EXPECT_NE(json.value("quality", ""), "good");
}

}  // namespace lvcalib::testing
