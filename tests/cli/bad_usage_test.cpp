// SPDX-License-Identifier: GPL-3.0-or-later
// Wrong arguments, options files, output places, and the other commands' inputs.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/bad_input.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

using Spoil = std::function<void(const fs::path&)>;

// Beside the dataset.
Spoil beside(const std::string& name, const std::string& content) {
  return [=](const fs::path& dataset) { write_file(dataset.parent_path() / name, content); };
}

std::vector<BadInput> usage() {
  const std::string matrix = "T_camera_lidar:\n  - [2, 0, 0, 0]\n  - [0, 1, 0, 0]\n";
  return {
      {"RejectUnknownScene", {}, 2, {"dataset", "no scene 'Z'"}, {"--reject", "Z"}},
      {"RejectAll",
       {},
       3,
       {"every scene is rejected"},
       {"--reject", "A", "--reject", "B", "--reject", "C"}},
      {"UnknownOption", {}, 2, {"calibrate: ", "--frobnicate"}, {"--frobnicate"}},
      {"ExtraArgument", {}, 2, {"calibrate: ", "another"}, {"another"}},
      {"ThreadsWord", {}, 2, {"--threads"}, {"--threads", "two"}},
      {"NoConfig", {}, 3, {"no.yaml: file not found"}, {"--config", "no.yaml"}},
      {"ConfigOutOfRange",
       beside("config.yaml", "refinement:\n  max_bins: 1e9\n"),
       3,
       {"config.yaml:2: 'refinement.max_bins' must be between 6 and 360"},
       {"--config", "config.yaml"}},
      {"ConfigWord",
       beside("config.yaml", "refinement.max_bins: many\n"),
       3,
       {"config.yaml:1: 'refinement.max_bins' must be a number"},
       {"--config", "config.yaml"}},
      {"ConfigFraction",
       beside("config.yaml", "refinement.max_bins: 20.5\n"),
       3,
       {"config.yaml:1: 'refinement.max_bins' must be a whole number"},
       {"--config", "config.yaml"}},
      {"NoInit", {}, 3, {"no.yaml: file not found"}, {"--init", "no.yaml"}},
      {"InitIsNoRotation",
       beside("rig.yaml", matrix + "  - [0, 0, 1, 0]\n"),
       3,
       {"rig.yaml:", "not a rotation"},
       {"--init", "rig.yaml"}},
      {"InitIsMirror",
       beside("rig.yaml", "T_camera_lidar: [-1,0,0,0, 0,1,0,0, 0,0,1,0]\n"),
       3,
       {"rig.yaml:1: ", "not a rotation"},
       {"--init", "rig.yaml"}},
      {"InitHasElevenNumbers",
       beside("rig.yaml", "T_camera_lidar: [1,0,0,0, 0,1,0,0, 0,0,1]\n"),
       3,
       {"rig.yaml:1: ", "12 or 16 numbers, found 11"},
       {"--init", "rig.yaml"}},
      {"InitIsNan",
       beside("rig.yaml", "T_camera_lidar: [1,0,0,.nan, 0,1,0,0, 0,0,1,0]\n"),
       3,
       {"rig.yaml:1: ", "must hold numbers"},
       {"--init", "rig.yaml"}},
  };
}

class BadUsage : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadUsage, IsNamedInOneClearError) {
  SpoiledRun(GetParam()).expect_as_described();
}

INSTANTIATE_TEST_SUITE_P(Calibrate, BadUsage, ::testing::ValuesIn(usage()),
                         [](const auto& info) { return info.param.name; });

TEST(OddConfig, UnknownOptionsAreWarnedAboutWithTheNearestKnownOne) {
  const SpoiledRun run({"OddConfig",
                        beside("config.yaml", "refinement:\n  max_bin: 60\n"),
                        0,
                        {},
                        {"--config", "config.yaml"}});
  EXPECT_EQ(run.outcome().status, 0) << run.outcome().err;
  EXPECT_THAT(run.outcome().err, HasSubstr("lvcalib: warning: config.yaml:2: unknown option "
                                           "'refinement.max_bin' ignored; did you mean "
                                           "'refinement.max_bins'?\n"));
}

// Failures of any command, in a folder with the good dataset's files at hand.
class AnyCommand : public ::testing::Test {
 protected:
  void expect_error(const std::vector<std::string>& arguments, int status,
                    const std::vector<std::string>& message, bool unprivileged = false) {
    RunSettings settings;
    settings.folder = folder_.path();
    settings.unprivileged = unprivileged;
    const auto before = contents();
    const Outcome outcome = run_lvcalib(arguments, settings);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    const auto errors = lines_with(outcome.err, "lvcalib: error: ");
    ASSERT_EQ(errors.size(), 1U) << outcome.err;
    for (const std::string& part : message) EXPECT_THAT(errors.front(), HasSubstr(part));
    EXPECT_EQ(contents(), before);
  }
  [[nodiscard]] std::vector<std::string> contents() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      names.push_back(entry.path());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  void write(const std::string& name, const std::string& content) {
    write_file(folder_.path() / name, content);
  }
  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_{"any"};
};

TEST_F(AnyCommand, CalibrateNeedsDatasetAndOutput) {
  const std::string dataset = good_dataset();
  expect_error({"calibrate"}, 2, {"calibrate: "});
  expect_error({"calibrate", dataset}, 2, {"--output is required"});
  expect_error({"calibrate", "-o", "out"}, 2, {"DATASET is required"});
}

TEST_F(AnyCommand, OutputThatCannotBeWrittenIsSaid) {
  const std::string dataset = good_dataset();
  write("file", "x");
  expect_error({"calibrate", dataset, "-o", "file"}, 3, {"file: ", "cannot be created"});
  expect_error({"calibrate", dataset, "-o", "file/out"}, 3, {"file/out: ", "cannot be created"});
  EXPECT_EQ(read_file(folder() / "file"), "x");
  fs::create_directory(folder() / "locked");
  fs::permissions(folder() / "locked", fs::perms::owner_read | fs::perms::owner_exec |
                                           fs::perms::others_read | fs::perms::others_exec);
  expect_error({"calibrate", dataset, "-o", "locked/out"}, 3, {"locked/out: ", "cannot be created"},
               true);
  expect_error({"calibrate", dataset, "-o", "locked"}, 3, {"locked", "cannot be written"}, true);
}

TEST_F(AnyCommand, SimulateRefusesAFolderThatIsNotItsOwn) {
  fs::create_directory(folder() / "mine");
  write("mine/precious.txt", "x");
  expect_error({"simulate", "-o", "mine"}, 3, {"mine: exists already and is not"});
  expect_error({"simulate", "-o", "mine", "--force"}, 3, {"mine: exists already and is not"});
  write("file", "x");
  expect_error({"simulate", "-o", "file"}, 3, {"file: "});
  expect_error({"simulate", "-o", "new", "--scenes", "0"}, 2, {"scenes"});
  expect_error({"simulate", "-o", "new", "--lidar", "radar"}, 2, {"--lidar", "avia"});
  expect_error({"simulate", "-o", "new", "--effect", "magic=1"}, 2, {"magic"});
  expect_error({"simulate", "-o", "new", "--effect", "range_wlak=1"}, 2, {"'range_walk'"});
  expect_error({"simulate", "-o", "new", "--effect", "range_walk=900"}, 2, {"-100 to 100 mm"});
  expect_error({"simulate", "-o", "new", "--effect", "range_walk"}, 2, {"ID=VALUE"});
  expect_error({"simulate", "-o", "new", "--effect", "range_walk=1", "--effect", "range_walk=2"}, 2,
               {"given twice"});
  expect_error({"simulate", "-o", "new", "--target", "no.yaml"}, 3, {"no.yaml: file not found"});
}

TEST_F(AnyCommand, EvaluateNamesTheUnfitFile) {
  fs::path truth = good_dataset();
  truth += "-truth.json";
  write("empty.json", "");
  write("list.json", "[1, 2]");
  write("other.json", R"({"hello": "world"})");
  write("words.json", R"({"T_camera_lidar": {"matrix": [["a"]]}, "T_CL": "b"})");
  write("scaled.json", R"({"T_CL": [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 0]],
    "T_camera_lidar": {"matrix": [[2,0,0,0], [0,2,0,0], [0,0,2,0], [0,0,0,1]]}})");
  for (const char* name :
       {"no.json", "empty.json", "list.json", "other.json", "words.json", "scaled.json", "."}) {
    const std::string where = std::string(name) + ": ";
    expect_error({"evaluate", name, "--truth", truth}, 3, {where});
  }
  write("result.json", R"({"T_camera_lidar":
    {"matrix": [[1,0,0,0], [0,1,0,0], [0,0,1,0], [0,0,0,1]]}})");
  for (const char* name : {"no.json", "empty.json", "other.json", "words.json", "scaled.json"}) {
    const std::string where = std::string(name) + ": ";
    expect_error({"evaluate", "result.json", "--truth", name}, 3, {where});
  }
  expect_error({"evaluate", "result.json"}, 2, {"--truth is required"});
}

TEST_F(AnyCommand, ACommandThatIsNoneIsNamedWithTheNearestOne) {
  expect_error({"calibrat", "x"}, 2, {"there is no command 'calibrat'", "did you mean calibrate?"});
  expect_error({"foo"}, 2, {"there is no command 'foo', known are calibrate, discover, "});
  expect_error({}, 2, {"A subcommand is required"});
  expect_error({"--frobnicate"}, 2, {"--help"});
}

TEST_F(AnyCommand, OverlapsAreOfSeveralPages) {
  expect_error({"target", "-o", "board.pdf", "--overlap", "300"}, 2, {"--overlap", "--paper"});
}

TEST_F(AnyCommand, TargetTellsFormatsByTheirEnding) {
  const fs::path target = good_dataset() / "target.yaml";
  expect_error({"target", target, "-o", "board.docx"}, 2, {"board.docx", ".pdf, .svg or .png"});
  expect_error({"target", target, "-o", "board"}, 2, {"board", ".pdf, .svg or .png"});
  expect_error({"target", good_dataset() / "camera.yaml", "-o", "board.pdf"}, 3,
               {"camera.yaml: ", "target_type"});
}

}  // namespace
}  // namespace lvcalib::testing
