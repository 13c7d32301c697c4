// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate, then export and report, as a user runs them.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/child_process.h"
#include "cli/good_dataset.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class EvidenceCommands : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder("evidence");
    const Outcome outcome =
        run_lvcalib({"calibrate", good_dataset().string(), "-o", result_folder().string()});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
  static void TearDownTestSuite() { delete folder_; }
  static fs::path result_folder() { return folder_->path() / "out"; }
  static std::string result() { return (result_folder() / "result.json").string(); }
  static fs::path at(const std::string& name) { return folder_->path() / name; }
  static Outcome export_as(const std::string& format, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"export", result(), "--format",
                                          format,   "-o",     at("file").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    fs::remove(at("file"));
    return run_lvcalib(arguments);
  }
  static TemporaryFolder* folder_;
};
TemporaryFolder* EvidenceCommands::folder_ = nullptr;

TEST_F(EvidenceCommands, EveryFormatIsWritten) {
  for (const char* format : {"opencv", "ros1-tf", "ros2-tf", "urdf", "kalibr", "autoware",
                             "fast-livo2", "lvi-sam", "koide", "matrix"}) {
    const Outcome outcome = export_as(format);
    EXPECT_EQ(outcome.status, 0) << format << ": " << outcome.err;
    EXPECT_THAT(read_file(at("file")), HasSubstr("worked point")) << format;
  }
  const Outcome outcome = export_as("boundary-response");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(read_file(at("file")), HasSubstr("covariance"));
}

TEST_F(EvidenceCommands, R3liveAsksForTheImu) {
  const Outcome without = export_as("r3live");
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, HasSubstr("--imu"));
  EXPECT_FALSE(fs::exists(at("file")));
  write_file(at("imu.yaml"),
             "T_imu_lidar: [[1, 0, 0, 0.05], [0, 1, 0, 0], [0, 0, 1, 0.1], [0, 0, 0, 1]]\n");
  const Outcome with = export_as("r3live", {"--imu", at("imu.yaml").string()});
  EXPECT_EQ(with.status, 0) << with.err;
  EXPECT_THAT(read_file(at("file")), HasSubstr("camera_ext_R"));
  write_file(at("imu.yaml"), "T_imu_lidar: [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0]]\n");
  const Outcome no_rotation = export_as("r3live", {"--imu", at("imu.yaml").string()});
  EXPECT_EQ(no_rotation.status, 3);
  EXPECT_THAT(no_rotation.err, HasSubstr("T_imu_lidar"));
}

TEST_F(EvidenceCommands, TheReportIsOneFile) {
  const Outcome outcome =
      run_lvcalib({"report", result_folder().string(), "-o", at("report.html").string()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(read_file(at("report.html")), HasSubstr("Boundary response"));
}

TEST_F(EvidenceCommands, AFailedResultIsExportedOnlyByForce) {
  const std::string file = at("failed.json").string();
  write_file(file, read_file(result()));
  replace_text(file, "\"quality\": \"good\"", "\"quality\": \"failed\"");
  const std::string out = at("failed.txt").string();
  const std::vector<std::string> arguments{"export", file, "--format", "matrix", "-o", out};
  expect_refusal(run_lvcalib(arguments), 1, "has failed", out);
  auto forced = arguments;
  forced.emplace_back("--force");
  const Outcome outcome = run_lvcalib(forced);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(read_file(out), HasSubstr("worked point"));
}

TEST_F(EvidenceCommands, TheReportRefusesFilesThatHaveChanged) {
  const fs::path dataset = at("changing");
  copy_dataset(good_dataset(), dataset);
  const std::string folder = at("changing-out").string();
  ASSERT_EQ(run_lvcalib({"calibrate", dataset.string(), "-o", folder}).status, 0);
  const std::string out = at("changing.html").string();
  EXPECT_EQ(run_lvcalib({"report", folder, "-o", out}).status, 0);
  fs::remove(out);
  const fs::path image = dataset / "scenes" / "B" / "image.png";
  const std::string other = read_file(dataset / "scenes" / "C" / "image.png");
  write_file(image, other);
  expect_refusal(run_lvcalib({"report", folder, "-o", out}), 3, "its content changed", out);
  // So does a cloud that takes its colours from that image; other scenes still have theirs.
  const auto colored = [&](const char* scene) {
    return run_lvcalib({"export", folder + "/result.json", "--format", "colored-ply", "--scene",
                        scene, "-o", at("colored.ply").string()});
  };
  expect_refusal(colored("B"), 3, "its content changed", at("colored.ply"));
  EXPECT_EQ(colored("C").status, 0);
}

TEST_F(EvidenceCommands, AnInputIsNeverOverwritten) {
  const std::string before = read_file(result());
  for (const auto& arguments : {std::vector<std::string>{"export", result(), "--format", "matrix"},
                                std::vector<std::string>{"report", result_folder().string()}}) {
    auto onto = arguments;
    onto.insert(onto.end(), {"-o", result()});
    const Outcome outcome = run_lvcalib(onto);
    EXPECT_EQ(outcome.status, 2) << arguments[0];
    EXPECT_THAT(outcome.err, HasSubstr("the output is the input itself"));
  }
  EXPECT_EQ(read_file(result()), before);
  const fs::path among = good_dataset() / "scenes" / "D";
  for (const char* command : {"calibrate", "discover"}) {
    expect_refusal(run_lvcalib({command, good_dataset().string(), "-o", among.string()}), 2,
                   "among a dataset's scenes", among);
  }
}

TEST_F(EvidenceCommands, NothingIsWrittenOntoADatasetsFiles) {
  const fs::path dataset = at("own");
  copy_dataset(good_dataset(), dataset);
  const fs::path cloud = dataset / "scenes" / "A" / "cloud.pcd";
  const fs::path image = dataset / "scenes" / "B" / "image.png";
  const std::string lidar =
      (fs::path(LVCALIB_SOURCE_DIR) / "resources" / "lidars" / "avia.yaml").string();
  const std::vector<std::vector<std::string>> among = {
      {"export", result(), "--format", "matrix", "-o", cloud.string()},
      {"report", result_folder().string(), "-o", image.string()},
      {"target", "-o", image.string()},
      {"correct", cloud.string(), "--with", result(), "-o",
       (dataset / "scenes" / "B.pcd").string()},
      {"check", result(), dataset.string(), "-o", cloud.string()},
      {"export", result(), "--format", "matrix", "-o", (result_folder() / "result.yaml").string()},
      {"export", result(), "--format", "matrix", "-o", (good_dataset() / "camera.yaml").string()},
      {"export", result(), "--format", "matrix", "-o", (dataset / "target.yaml").string()},
      {"report", result_folder().string(), "-o", (dataset / "rig.yaml").string()},
      {"calibrate", dataset.string(), "--init", (result_folder() / "result.yaml").string(), "-o",
       result_folder().string()}};
  for (const auto& arguments : among) {
    const Outcome outcome = run_lvcalib(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments[0];
    EXPECT_THAT(outcome.err, ::testing::AnyOf(HasSubstr("among a dataset's scenes"),
                                              HasSubstr("read as a part of the dataset"),
                                              HasSubstr("the output is the input itself")));
  }
  const std::string target = (dataset / "target.yaml").string();
  const std::string before = read_file(target);
  const Outcome plan =
      run_lvcalib({"plan", "--target", target, "--camera", (dataset / "camera.yaml").string(),
                   "--lidar", lidar, "--scenes", "3", "-o", target});
  EXPECT_EQ(plan.status, 2);
  EXPECT_THAT(plan.err, HasSubstr("the output is the input itself"));
  EXPECT_EQ(read_file(target), before);
  EXPECT_EQ(read_file(cloud), read_file(good_dataset() / "scenes" / "A" / "cloud.pcd"));
}

TEST_F(EvidenceCommands, OutputThatIsLostIsAnError) {
  RunSettings settings;
  settings.print_to = "/dev/full";
  fs::path truth = good_dataset();
  truth += "-truth.json";
  for (const auto& arguments :
       {std::vector<std::string>{"evaluate", result(), "--truth", truth.string()},
        std::vector<std::string>{"--help"}, std::vector<std::string>{"calibrate", "--version"}}) {
    const Outcome outcome = run_lvcalib(arguments, settings);
    EXPECT_EQ(outcome.status, 3) << arguments[0];
    EXPECT_THAT(outcome.err, HasSubstr("standard output cannot be written")) << arguments[0];
  }
}

TEST_F(EvidenceCommands, WhatCannotBeReadIsRefusedWithoutOutput) {
  const fs::path bad = at("bad");
  fs::create_directories(bad);
  const fs::path out = at("none");
  const std::string file = (bad / "result.json").string();
  for (const char* text : {"", "{", "[]", "{}", "{\"T_camera_lidar\": 5}"}) {
    write_file(file, text);
    for (const auto& arguments :
         {std::vector<std::string>{"export", file, "--format", "matrix", "-o", out.string()},
          std::vector<std::string>{"report", bad.string(), "-o", out.string()}}) {
      const Outcome outcome = run_lvcalib(arguments);
      EXPECT_EQ(outcome.status, 3) << arguments[0] << " of '" << text << "': " << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("result.json")) << text;
      EXPECT_FALSE(fs::exists(out));
    }
  }
  EXPECT_EQ(run_lvcalib({"report", at("nowhere").string(), "-o", out.string()}).status, 3);
  EXPECT_EQ(export_as("fastlivo2").status, 2);
  EXPECT_EQ(run_lvcalib({"export", result(), "--format", "matrix", "-o", "/nowhere/at/all"}).status,
            3);
}

}  // namespace
}  // namespace lvcalib::testing
