// SPDX-License-Identifier: GPL-3.0-or-later
// Sound files that show another board than target.yaml describes, or none.
#include <cmath>
#include <cstdio>
#include <regex>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "cli/bad_input.h"
#include "cloud/cloud.h"
#include "support/image_files.h"
#include "target/target.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

void change_images(const fs::path& dataset, const std::function<void(cv::Mat&)>& change) {
  for (const std::string& scene : scene_names(dataset)) {
    const fs::path path = dataset / "scenes" / scene / "image.png";
    cv::Mat image = test::read_pixels(path);
    ASSERT_FALSE(image.empty());
    change(image);
    fs::remove(path);
    ASSERT_TRUE(test::write_png(path, image));
  }
}

void make_grey(const fs::path& dataset) {
  change_images(dataset, [](cv::Mat& image) { image.setTo(128); });
}

void mirror(const fs::path& dataset) {
  change_images(dataset, [](cv::Mat& image) {
    cv::Mat flipped;
    cv::flip(image, flipped, 1);
    image = flipped;
  });
}

// T_LB of a scene, from the truth of the simulation.
Eigen::Isometry3d lidar_from_board(const std::string& scene) {
  fs::path path = good_dataset();
  path += "-truth.json";
  const auto rows = nlohmann::json::parse(read_file(path))["scenes"][scene]["T_LB"];
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) out.matrix()(r, c) = rows[r][c].get<double>();
  }
  return out;
}

void take_board_out_of_cloud(const fs::path& dataset, const std::string& scene) {
  const fs::path path = dataset / "scenes" / scene / "cloud.pcd";
  const auto cloud = read_cloud(path);
  ASSERT_TRUE(cloud.ok());
  const Eigen::Isometry3d board_from_lidar = lidar_from_board(scene).inverse();
  const BoardOutline outline = Target{}.outline();
  constexpr double kAround_m = 0.15;
  Cloud rest;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const Eigen::Vector3d p = board_from_lidar * cloud->points_m[i].cast<double>();
    const Eigen::Vector2d from_center = p.head<2>() - outline.center_m();
    const Eigen::Vector2d half = 0.5 * outline.size_m() + Eigen::Vector2d::Constant(kAround_m);
    if ((from_center.array().abs() < half.array()).all() && std::abs(p.z()) < kAround_m) continue;
    rest.points_m.push_back(cloud->points_m[i]);
    rest.intensity.push_back(cloud->intensity[i]);
  }
  ASSERT_LT(rest.size(), cloud->size());
  fs::remove(path);
  ASSERT_TRUE(write_pcd(path, rest).ok());
}

void take_board_out_of_clouds(const fs::path& dataset) {
  for (const std::string& scene : scene_names(dataset)) take_board_out_of_cloud(dataset, scene);
}

std::function<void(const fs::path&)> edit_target(const std::string& from, const std::string& to) {
  return [=](const fs::path& dataset) { replace_text(dataset / "target.yaml", from, to); };
}

std::vector<BadInput> boards() {
  return {
      {"NoTags", make_grey, 3, {"A/image.png: no tags in the image"}},
      {"Mirrored", mirror, 3, {"A/image.png: ", "mirrored"}},
      {"OtherIds",
       edit_target("firstTagId: 0", "firstTagId: 100"),
       3,
       {"A/image.png: ", "shows tags 0, 1, 2", "the target has 100 to 115"}},
      {"OtherFamily",
       edit_target("tag36h11", "tag25h9"),
       3,
       {"A/image.png: ", "tag36h11", "target says tag25h9"}},
      {"OtherBorder",
       edit_target("tagBorder: 1", "tagBorder: 2"),
       3,
       {"A/image.png: ", "1-bit border", "set tagBorder: 1"}},
      {"BoardNotInClouds", take_board_out_of_clouds, 1, {"not found in any cloud", "A", "C"}},
  };
}

class BadBoard : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadBoard, IsExplainedInOneClearError) {
  SpoiledRun(GetParam()).expect_as_described();
}

INSTANTIATE_TEST_SUITE_P(Dataset, BadBoard, ::testing::ValuesIn(boards()),
                         [](const auto& info) { return info.param.name; });

// One size given wrong: LiDAR and camera disagree, and the message says by how much.
struct WrongSize {
  double factor = 1.0;  ///< What target.yaml says over what was printed.
  bool whole_print = false;
};

class WrongTagSize : public ::testing::TestWithParam<WrongSize> {};

TEST_P(WrongTagSize, IsMeasured) {
  const double factor = GetParam().factor;
  const bool whole_print = GetParam().whole_print;
  const Target target;
  const auto scale = [&](const fs::path& dataset) {
    const auto line = [&](const char* key, double value) {
      char from[64];
      char to[64];
      std::snprintf(from, sizeof from, "%s: %g\n", key, value);
      std::snprintf(to, sizeof to, "%s: %g\n", key, factor * value);
      replace_text(dataset / "target.yaml", from, to);
    };
    line("tagSize", target.tag_size_m);
    if (!whole_print) return;
    line("circleRadius", target.circle_radius_m);
    line("margin", target.margin_m);
  };
  const SpoiledRun run(
      {"TagSize" + std::to_string(std::lround(1000 * factor)) + (whole_print ? "Print" : "Tags"),
       scale,
       1,
       {"disagree", "size", "target.yaml"}});
  run.expect_as_described();
  // "… the LiDAR measures it 9.09 ± 0.10 % smaller …", or without the ±.
  const std::regex percentage(R"(([0-9.]+)( ± [0-9.]+)? % (smaller|larger))");
  std::smatch found;
  const std::string error = run.error();
  ASSERT_TRUE(std::regex_search(error, found, percentage)) << error;
  const double measured = (found[3] == "smaller" ? -1.0 : 1.0) * std::stod(found[1]);
  const double expected = 100.0 * (1.0 / factor - 1.0);
  const double tolerance = std::abs(expected) < 12.0 ? 1.0 : 2.0;
  EXPECT_NEAR(measured, expected, tolerance) << error;
}

INSTANTIATE_TEST_SUITE_P(Dataset, WrongTagSize,
                         ::testing::Values(WrongSize{1.015}, WrongSize{1.05}, WrongSize{0.95},
                                           WrongSize{1.1, true}, WrongSize{0.9, true},
                                           WrongSize{1.3, true}, WrongSize{2.0, true}));

TEST(OneScene, GivesAResultThatIsDoubtfulAndSaysWhy) {
  BadInput input{"OneScene",
                 [](const fs::path& dataset) {
                   fs::remove_all(dataset / "scenes" / "B");
                   fs::remove_all(dataset / "scenes" / "C");
                 },
                 1,
                 {"only one usable scene", "take two or more"}};
  const SpoiledRun alone(input);
  alone.expect_as_described();
  const auto json = nlohmann::json::parse(read_file(alone.output() / "result.json"));
  EXPECT_EQ(json["quality"], "doubtful");
  EXPECT_THAT(json["warnings"].dump(), HasSubstr("only one usable scene"));
  EXPECT_EQ(json["scenes"].size(), 1U);

  input.name = "AllButOneRejected";
  input.spoil = {};
  input.arguments = {"--reject", "A", "--reject", "C"};
  const SpoiledRun rejected(input);
  rejected.expect_as_described();
  ASSERT_TRUE(fs::exists(rejected.output() / "result.json"));
  // How the rejected ones would fit.
  const auto fits = nlohmann::json::parse(read_file(rejected.output() / "result.json"));
  ASSERT_EQ(fits["scenes"].size(), 3U);
  for (const auto& scene : fits["scenes"]) {
    EXPECT_GT(scene["rms_px"].get<double>(), 0.0) << scene["name"];
    EXPECT_GT(scene["rms_mm"].get<double>(), 0.0) << scene["name"];
  }
}

TEST(OneBoardMissing, CostsOneScene) {
  const SpoiledRun run(
      {"OneBoardMissing", [](const fs::path& dataset) { take_board_out_of_cloud(dataset, "B"); }});
  EXPECT_EQ(run.outcome().status, 0) << run.outcome().err;
  EXPECT_THAT(lines_with(run.outcome().err, "lvcalib: warning: "),
              ::testing::Contains(HasSubstr("scene B is not used")));
}

}  // namespace
}  // namespace lvcalib::testing
