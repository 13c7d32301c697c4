// SPDX-License-Identifier: GPL-3.0-or-later
// Missing, unreadable and malformed files of a dataset.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/bad_input.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;

using Spoil = std::function<void(const fs::path&)>;

Spoil remove(const std::string& name) {
  return [name](const fs::path& dataset) { fs::remove_all(dataset / name); };
}

Spoil write(const std::string& name, const std::string& content) {
  return [=](const fs::path& dataset) { write_file(dataset / name, content); };
}

Spoil edit(const std::string& name, const std::string& from, const std::string& to) {
  return [=](const fs::path& dataset) { replace_text(dataset / name, from, to); };
}

Spoil folder_instead(const std::string& name) {
  return [=](const fs::path& dataset) {
    fs::remove_all(dataset / name);
    fs::create_directories(dataset / name / "inside");
  };
}

// A copy, not the link: the original stays readable.
Spoil forbid(const std::string& name) {
  return [=](const fs::path& dataset) {
    write_file(dataset / name, read_file(dataset / name));
    fs::permissions(dataset / name, fs::perms::none);
  };
}

std::string garbage() {
  std::string bytes;
  for (int i = 0; i < 3000; ++i) bytes.push_back(static_cast<char>((i * 7919 + i * i * 31) % 251));
  return bytes;
}

constexpr const char* kTarget = "target.yaml";
constexpr const char* kCamera = "camera.yaml";
constexpr const char* kImage = "scenes/B/image.png";
constexpr const char* kCloud = "scenes/B/cloud.pcd";

std::vector<BadInput> missing_files() {
  return {
      {"NoDataset",
       [](const fs::path& dataset) { fs::remove_all(dataset); },
       3,
       {"dataset: ", "folder not found", "target.yaml"}},
      {"DatasetIsFile",
       [](const fs::path& dataset) {
         fs::remove_all(dataset);
         write_file(dataset, "x");
       },
       3,
       {"dataset: ", "expected"}},
      {"NoTarget", remove(kTarget), 3, {"dataset/target.yaml: file not found"}},
      {"NoCamera", remove(kCamera), 3, {"dataset/camera.yaml: file not found"}},
      {"NoScenesFolder", remove("scenes"), 3, {"dataset/scenes: ", "not found", "expected"}},
      {"ScenesIsFile",
       [](const fs::path& dataset) {
         fs::remove_all(dataset / "scenes");
         write_file(dataset / "scenes", "x");
       },
       3,
       {"dataset/scenes: ", "expected"}},
      {"NoScenes",
       [](const fs::path& dataset) {
         fs::remove_all(dataset / "scenes");
         fs::create_directories(dataset / "scenes");
       },
       3,
       {"dataset/scenes: no scenes", "expected"}},
      {"SceneWithoutImage", remove(kImage), 3, {"scenes/B: no image", "image.png"}},
      {"SceneWithoutCloud", remove(kCloud), 3, {"scenes/B: no cloud", "cloud.pcd"}},
      {"DanglingLink",
       [](const fs::path& dataset) {
         fs::remove(dataset / kImage);
         fs::create_symlink("nowhere", dataset / kImage);
       },
       3,
       {"scenes/B"}},
      {"TargetIsFolder", folder_instead(kTarget), 3, {"target.yaml: not a regular file"}},
      {"CameraIsFolder", folder_instead(kCamera), 3, {"camera.yaml: not a regular file"}},
      {"ImageIsFolder", folder_instead(kImage), 3, {"B/image.png: not a regular file"}},
      {"CloudIsFolder", folder_instead(kCloud), 3, {"B/cloud.pcd: is a folder, expected"}},
  };
}

std::vector<BadInput> unreadable_files() {
  std::vector<BadInput> inputs;
  for (const auto& [name, file] : {std::pair{"ForbiddenTarget", kTarget},
                                   {"ForbiddenCamera", kCamera},
                                   {"ForbiddenImage", kImage},
                                   {"ForbiddenCloud", kCloud}}) {
    inputs.push_back({name, forbid(file), 3, {file, "cannot be read"}, {}, true});
  }
  return inputs;
}

std::vector<BadInput> bad_targets() {
  return {
      {"EmptyTarget", write(kTarget, ""), 3, {"target.yaml", "expected"}},
      {"GarbageTarget", write(kTarget, garbage()), 3, {"target.yaml"}},
      {"ListTarget", write(kTarget, "- 1\n- 2\n"), 3, {"target.yaml", "expected a YAML map"}},
      {"MalformedTarget",
       write(kTarget, "target_type: [aprilgrid\ntagCols: }"),
       3,
       {"target.yaml:", "not valid YAML"}},
      {"TagSizeWord",
       edit(kTarget, "tagSize: 0.12", "tagSize: abc"),
       3,
       {"target.yaml:5: 'tagSize' must be a number, found 'abc'"}},
      {"TagSizeNan",
       edit(kTarget, "tagSize: 0.12", "tagSize: .nan"),
       3,
       {"target.yaml:5: 'tagSize' must be a number"}},
      {"TagSizeZero", edit(kTarget, "tagSize: 0.12", "tagSize: 0"), 3, {"target.yaml", "tagSize"}},
      {"TagSizeMillimetres",
       edit(kTarget, "tagSize: 0.12", "tagSize: 120"),
       3,
       {"target.yaml:5: 'tagSize' must be between 0 and 100"}},
      {"TagColsNegative",
       edit(kTarget, "tagCols: 4", "tagCols: -3"),
       3,
       {"target.yaml:3: 'tagCols' must be between 1 and 1000, found '-3'"}},
      {"TagColsHuge",
       edit(kTarget, "tagCols: 4", "tagCols: 4000000000"),
       3,
       {"target.yaml:3: 'tagCols'"}},
      {"TagColsFraction",
       edit(kTarget, "tagCols: 4", "tagCols: 3.5"),
       3,
       {"target.yaml:3: 'tagCols' must be a whole number, found '3.5'"}},
      {"TagRowsList",
       edit(kTarget, "tagRows: 4", "tagRows: [4, 4]"),
       3,
       {"target.yaml:4: 'tagRows' must be a number, found a list"}},
      {"CircleTooLarge",
       edit(kTarget, "circleRadius: 0.045", "circleRadius: 0.5"),
       3,
       {"target.yaml: ", "circleRadius"}},
      {"NoTagSize",
       edit(kTarget, "tagSize: 0.12\n", ""),
       3,
       {"target.yaml: key 'tagSize' is missing"}},
      {"MisspeltTagSize",
       edit(kTarget, "tagSize: ", "tagSze: "),
       3,
       {"target.yaml: key 'tagSize' is missing", "is 'tagSze' a misspelling of it?"}},
      {"UnknownTargetType",
       edit(kTarget, "aprilgrid_circles", "aprilgird"),
       3,
       {"target.yaml:1: target_type 'aprilgird' is not known; expected aprilgrid_circles"}},
      {"UnknownFamily", edit(kTarget, "tag36h11", "tag99h99"), 3, {"target.yaml", "tag99h99"}},
  };
}

std::vector<BadInput> bad_cameras() {
  return {
      {"EmptyCamera", write(kCamera, ""), 3, {"camera.yaml", "expected"}},
      {"GarbageCamera", write(kCamera, garbage()), 3, {"camera.yaml"}},
      {"MalformedCamera",
       write(kCamera, "image_width: 5\n image_height: : 3\n"),
       3,
       {"camera.yaml:", "not valid YAML"}},
      {"OtherYaml", write(kCamera, "hello: world\n"), 3, {"camera.yaml: ", "camera_matrix"}},
      {"WidthWord",
       edit(kCamera, "image_width: 1024", "image_width: wide"),
       3,
       {"camera.yaml:", "'image_width' must be a number, found 'wide'"}},
      {"WidthNegative",
       edit(kCamera, "image_width: 1024", "image_width: -1024"),
       3,
       {"camera.yaml:", "'image_width'"}},
      {"NanFocalLength",
       edit(kCamera, "data: [", "data: [.nan, 0, 512, 0, 600, 384, 0, 0, 1] # "),
       3,
       {"camera.yaml:", "number"}},
      {"InfinitePoint",
       edit(kCamera, "data: [", "data: [600, 0, .inf, 0, 600, 384, 0, 0, 1] # "),
       3,
       {"camera.yaml:", "number"}},
      {"ZeroFocalLength",
       edit(kCamera, "data: [", "data: [0, 0, 512, 0, 600, 384, 0, 0, 1] # "),
       3,
       {"camera.yaml", "focal length"}},
      {"EightNumbers",
       edit(kCamera, "data: [", "data: [600, 0, 512, 0, 600, 384, 0, 0] # "),
       3,
       {"camera.yaml:", "'camera_matrix' says 3 × 3 but holds 8 numbers"}},
      {"UnknownDistortion",
       edit(kCamera, "plumb_bob", "fisheye9"),
       3,
       {"camera.yaml", "fisheye9", "plumb_bob"}},
      {"RigIsNoRotation",
       write("rig.yaml", "T_camera_lidar: [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]\n"),
       3,
       {"rig.yaml:1: ", "not a rotation"}},
  };
}

std::vector<BadInput> all() {
  std::vector<BadInput> inputs;
  for (const auto& part : {missing_files(), unreadable_files(), bad_targets(), bad_cameras()}) {
    inputs.insert(inputs.end(), part.begin(), part.end());
  }
  return inputs;
}

class BadFile : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadFile, IsNamedInOneClearError) {
  SpoiledRun(GetParam()).expect_as_described();
}

INSTANTIATE_TEST_SUITE_P(Dataset, BadFile, ::testing::ValuesIn(all()),
                         [](const auto& info) { return info.param.name; });

// What is odd but harmless gives warnings, and the result is there.
TEST(OddFile, UnknownKeysAreWarnedAboutWithTheNearestKnownOne) {
  const SpoiledRun run({"UnknownKeys", [](const fs::path& dataset) {
                          std::ofstream(dataset / kTarget, std::ios::app) << "tagSze: 0.3\n";
                          std::ofstream(dataset / kCamera, std::ios::app) << "image_widht: 3\n";
                        }});
  EXPECT_EQ(run.outcome().status, 0) << run.outcome().err;
  EXPECT_TRUE(fs::exists(run.output() / "result.json"));
  const auto warnings = lines_with(run.outcome().err, "lvcalib: warning: ");
  using ::testing::AllOf;
  using ::testing::Contains;
  using ::testing::HasSubstr;
  EXPECT_THAT(warnings, Contains(AllOf(HasSubstr("target.yaml:"), HasSubstr("'tagSze'"),
                                       HasSubstr("did you mean 'tagSize'?")))
                            .Times(1));
  EXPECT_THAT(warnings, Contains(AllOf(HasSubstr("camera.yaml:"), HasSubstr("'image_widht'"),
                                       HasSubstr("did you mean 'image_width'?")))
                            .Times(1));
}

}  // namespace
}  // namespace lvcalib::testing
