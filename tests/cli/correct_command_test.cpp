// SPDX-License-Identifier: GPL-3.0-or-later
// `lvcalib correct` as a user runs it.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "cloud/cloud.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kScales =
    R"("scales": {"white_level": 100, "black_level": 10, "log_contrast": 2.3,
       "darkness": [0, 1], "largest_incidence_rad": 1.0, "lines": [0, 1]})";

std::string result_with(const std::string& effects) {
  return "{\"model\": {\"effects\": [" + effects + "], " + kScales + "}}";
}

std::string effect(const std::string& id, const std::string& parameters) {
  return "{\"id\": \"" + id + "\", \"parameters\": [" + parameters + "]}";
}

const std::string kOffset = effect("range_offset", R"({"name": "a", "value": 12, "unit": "mm"})");

// Four points in two rows, one of them no return.
const std::string kCloud =
    "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 2\n"
    "HEIGHT 2\nPOINTS 4\nDATA ascii\n2 0 0 100\nnan nan nan 0\n0 3 0 10\n0 0 -4 50\n";

class CorrectCommand : public ::testing::Test {
 protected:
  CorrectCommand() {
    write("cloud.pcd", kCloud);
    write("result.json", result_with(kOffset));
  }
  void write(const std::string& name, const std::string& content) const {
    write_file(folder_.path() / name, content);
  }
  [[nodiscard]] Outcome run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "correct");
    arguments.emplace_back("--quiet");
    return run_lvcalib(std::move(arguments), {.folder = folder_.path()});
  }
  // One error line with its parts, the status, and no output file.
  void expect_error(std::vector<std::string> arguments, int status,
                    const std::vector<std::string>& parts) const {
    const Outcome outcome = run(std::move(arguments));
    EXPECT_EQ(outcome.status, status) << outcome.err;
    const auto errors = lines_with(outcome.err, "lvcalib: error: ");
    ASSERT_EQ(errors.size(), 1U) << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(errors[0], HasSubstr(part));
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_FALSE(fs::exists(folder_.path() / "fixed.pcd"));
  }
  [[nodiscard]] Result<Cloud> fixed() const {
    return read_cloud(folder_.path() / "fixed.pcd", {}, PointChoice::kAll);
  }

 private:
  TemporaryFolder folder_{"correct"};
};

TEST_F(CorrectCommand, TakesAnOffsetOutAndKeepsEveryPoint) {
  const Outcome outcome = run({"cloud.pcd", "--with", "result.json", "-o", "fixed.pcd"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "3 points; taken out: range_offset (12 mm RMS, 12 mm at most) -> fixed.pcd\n");
  const auto cloud = fixed();
  ASSERT_TRUE(cloud.ok()) << cloud.error().text();
  ASSERT_EQ(cloud->size(), 4U);
  EXPECT_EQ(cloud->rows, 2U);
  EXPECT_NEAR(cloud->points_m[0].x(), 1.988, 1e-6);
  EXPECT_TRUE(std::isnan(cloud->points_m[1].x()));
  EXPECT_NEAR(cloud->points_m[2].y(), 2.988, 1e-6);
  EXPECT_NEAR(cloud->points_m[3].z(), -3.988, 1e-6);
  EXPECT_THAT(cloud->intensity, ::testing::ElementsAre(100, 0, 10, 50));
}

TEST_F(CorrectCommand, TellsOfACloudWithoutReturnsInItsSecondHalf) {
  std::string half =
      "VERSION 0.7\nFIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
      "WIDTH 4000\nHEIGHT 1\nPOINTS 4000\nDATA ascii\n";
  for (int i = 0; i < 4000; ++i) half += i < 2000 ? "2 0 0 100\n" : "nan nan nan 0\n";
  write("half.pcd", half);
  const Outcome outcome = run({"half.pcd", "--with", "result.json", "-o", "fixed.pcd"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("half.pcd: from point 2001 of 4000 on none is a return"));
}

TEST_F(CorrectCommand, AModelWithoutEffectsCopiesTheCloudAndWarns) {
  write("result.json", R"({"model": {"effects": []}})");
  const Outcome outcome = run({"cloud.pcd", "--with", "result.json", "-o", "fixed.pcd"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("holds no effects"));
  EXPECT_THAT(outcome.out, HasSubstr("taken out: nothing"));
  EXPECT_EQ(fixed()->points_m[0], Eigen::Vector3f(2, 0, 0));
}

TEST_F(CorrectCommand, SaysWhichEffectsStayIn) {
  write("result.json",
        result_with(kOffset + "," +
                    effect("boundary_bias", R"({"name": "δ0", "value": 1, "unit": "mm"})")));
  const Outcome outcome =
      run({"cloud.pcd", "--with", "result.json", "-o", "fixed.pcd", "--skip", "range_offset"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("left: range_offset (skipped), boundary_bias (does not move "
                                     "points)"));
}

TEST_F(CorrectCommand, BadInputIsNamedAndLeavesNoFile) {
  const std::vector<std::string> tail = {"--with", "result.json", "-o", "fixed.pcd"};
  const auto with_cloud = [&](const std::string& cloud) {
    std::vector<std::string> arguments = tail;
    arguments.insert(arguments.begin(), cloud);
    return arguments;
  };
  expect_error(with_cloud("no.pcd"), 3, {"no.pcd: ", "not found"});
  write("cut.pcd", kCloud.substr(0, kCloud.size() - 12));
  expect_error(with_cloud("cut.pcd"), 3, {"cut.pcd: ", "truncated"});
  write("empty.pcd", "");
  expect_error(with_cloud("empty.pcd"), 3, {"empty.pcd: ", "empty"});
  write("words.pcd", "hello");
  expect_error(with_cloud("words.pcd"), 3, {"words.pcd: ", "neither"});
  expect_error({"cloud.pcd", "--with", "none.json", "-o", "fixed.pcd"}, 3,
               {"none.json: ", "not found"});
  expect_error({"cloud.pcd", "--with", "cloud.pcd", "-o", "fixed.pcd"}, 3,
               {"cloud.pcd: ", "not a JSON object"});
  write("result.json", R"({"T_camera_lidar": {}})");
  expect_error(with_cloud("cloud.pcd"), 3, {"result.json: ", "holds no model", "discover"});
  write("result.json", result_with(effect("magic", "")));
  expect_error(with_cloud("cloud.pcd"), 3, {"result.json: ", "'magic'", "no effect"});
  write("result.json", result_with(effect("scan_motion",
                                          R"({"name": "vx", "value": 5, "unit": "mm/s"},
                                             {"name": "vy", "value": 5, "unit": "mm/s"},
                                             {"name": "vz", "value": 5, "unit": "mm/s"})")));
  expect_error(with_cloud("cloud.pcd"), 3,
               {"cloud.pcd: ", "'scan_motion'", "no time", "--skip scan_motion"});
}

TEST_F(CorrectCommand, WrongUsageIsNamed) {
  expect_error({"cloud.pcd", "-o", "fixed.pcd"}, 2, {"--with is required"});
  expect_error({"cloud.pcd", "--with", "result.json"}, 2, {"--output is required"});
  expect_error({"cloud.pcd", "--with", "result.json", "-o", "fixed.pcd", "--clock", "2"}, 2,
               {"--clock"});
  expect_error({"cloud.pcd", "--with", "result.json", "-o", "fixed.pcd", "--skip", "range_walk"}, 2,
               {"'range_walk'", "not in the model"});
  expect_error({"cloud.pcd", "--with", "result.json", "-o", "no_folder/fixed.pcd"}, 3,
               {"no_folder/fixed.pcd: ", "cannot be written"});
}

}  // namespace
}  // namespace lvcalib::testing
