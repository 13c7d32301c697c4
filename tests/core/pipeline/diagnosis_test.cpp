// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/diagnosis.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/scene_copies.h"
#include "pipeline/turned_images.h"
#include "support/simulated_dataset.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

Rigid3 moved(double x_m, double turn_rad) {
  Vector6d xi = Vector6d::Zero();
  xi(0) = x_m;
  xi(5) = turn_rad;
  return se3_exp(xi);
}

// Scenes A, B, … whose boards were seen by a rig with these extrinsics.
CalibrationResult with_extrinsics(const std::vector<Rigid3>& camera_from_lidar) {
  CalibrationResult result;
  for (std::size_t s = 0; s < camera_from_lidar.size(); ++s) {
    SceneResult scene;
    scene.name = std::string(1, static_cast<char>('A' + s));
    const Rigid3 board = moved(0.2 * static_cast<double>(s), 0.1) *
                         Rigid3{Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 3.0)};
    scene.view.emplace();
    scene.view->camera_from_board = {board, 1e-8 * Matrix6d::Identity()};
    BoardCandidate candidate;
    candidate.lidar_from_board = {camera_from_lidar[s].inverse() * board,
                                  1e-8 * Matrix6d::Identity()};
    candidate.gain = 500.0;
    scene.search.emplace();
    scene.search->candidates = {candidate};
    result.scenes.push_back(scene);
  }
  result.extrinsic.camera_from_lidar.transform = camera_from_lidar.front();
  return result;
}

TEST(DiagnoseBump, ScenesAfterABumpAreGivenAsAGroup) {
  const Rigid3 before = moved(0.0, 0.0);
  const Rigid3 after = moved(0.03, 0.01);
  CalibrationResult result = with_extrinsics({before, before, before, after, after});
  for (std::size_t s = 0; s < 5; ++s) {
    result.scenes[s].used = s < 3;
    result.scenes[s].contradicts = s >= 3;
  }
  const std::string text = diagnose_bump(result).text();
  EXPECT_THAT(text, HasSubstr("scenes A, B, C give t = [0.000 0.000 0.000] m"));
  EXPECT_THAT(text, HasSubstr("scenes D, E give t = [0.030"));
  EXPECT_THAT(text, HasSubstr("10.0 mrad apart"));
  EXPECT_THAT(text, HasSubstr("did a sensor move between scenes C and D?"));
}

TEST(DiagnoseBump, OtherContradictionsAreNone) {
  const Rigid3 before = moved(0.0, 0.0);
  CalibrationResult scattered =
      with_extrinsics({before, before, before, moved(0.2, 0.1), moved(-0.2, -0.1)});
  CalibrationResult between = with_extrinsics({before, moved(0.03, 0.01), before, before});
  for (std::size_t s = 0; s < 5; ++s) {
    scattered.scenes[s].used = s < 3;
    scattered.scenes[s].contradicts = s >= 3;
  }
  for (std::size_t s = 0; s < 4; ++s) {
    between.scenes[s].used = s != 1;
    between.scenes[s].contradicts = s == 1;
  }
  EXPECT_EQ(diagnose_bump(scattered), Message());
  EXPECT_EQ(diagnose_bump(between), Message());
  CalibrationResult clean = with_extrinsics({before, before, before});
  for (SceneResult& scene : clean.scenes) scene.used = true;
  EXPECT_EQ(diagnose_bump(clean), Message());
  EXPECT_EQ(diagnose_bump(CalibrationResult()), Message());
}

TEST(DiagnoseUnseenTags, WholeRowsThatNoImageShowsAreNamed) {
  CalibrationResult result = with_extrinsics({Rigid3(), Rigid3()});
  for (SceneResult& scene : result.scenes) {
    for (const TargetTag& tag : result.target.tags()) scene.view->corners.push_back({tag.id});
  }
  EXPECT_EQ(diagnose_unseen_tags(result), Message());
  result.target.tag_rows = 5;
  EXPECT_THAT(diagnose_unseen_tags(result), HasSubstr("tagRows: 4 would fit"));
  // One image may show a part of the board only.
  result.scenes.pop_back();
  EXPECT_EQ(diagnose_unseen_tags(result), Message());
}

TEST(BetterCircleRadius, IsNamedBeyondAQuarterOfAPixel) {
  CalibrationResult result = with_extrinsics({Rigid3(), Rigid3()});
  result.target.circle_radius_m = 0.045;
  EXPECT_EQ(better_circle_radius(result), Message()) << "not measured";
  const auto measured = [&](double first_m, double second_m) {
    result.scenes[0].view->circle_radius = {first_m, 0.002};
    result.scenes[1].view->circle_radius = {second_m, 0.002};
    return better_circle_radius(result).text();
  };
  EXPECT_EQ(measured(0.0453, 0.0456), "");
  EXPECT_THAT(measured(0.0473, 0.0475), HasSubstr("circleRadius: 0.0474 would fit"));
}

// A wall of returns as a scan of it measures them.
Cloud wall(std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> place(-0.5F, 0.5F);
  std::normal_distribution<float> noise(0.0F, 0.003F);
  std::uniform_int_distribution<int> level(0, 255);
  Cloud cloud;
  for (int i = 0; i < 20'000; ++i) {
    cloud.points_m.emplace_back(3.0F + noise(engine), place(engine), place(engine));
    cloud.intensity.push_back(static_cast<float>(level(engine)));
  }
  return cloud;
}

TEST(SameReturns, AreThoseOfACloudThatWasWrittenAgain) {
  const Cloud cloud = wall(1);
  Cloud rounded;
  // Another order, four digits behind the point, a third of the points gone.
  for (std::size_t i = cloud.size(); i-- > 0;) {
    if (i % 3 == 0) continue;
    const Eigen::Vector3f tenths = 1e4F * cloud.points_m[i];
    rounded.points_m.push_back(1e-4F * tenths.array().round());
    rounded.intensity.push_back(cloud.intensity[i]);
  }
  EXPECT_TRUE(same_returns(cloud, rounded));
  EXPECT_TRUE(same_returns(rounded, cloud));
  EXPECT_FALSE(same_returns(cloud, wall(2))) << "another scan of the same wall";
  EXPECT_FALSE(same_returns(cloud, Cloud()));
}

TEST(SameContent, ImagesAndCloudsAreComparedEachForItself) {
  const test::TemporaryFolder folder;
  Dataset dataset;
  const auto add = [&](const std::string& name, const char* image, const char* cloud) {
    SceneFiles files;
    files.name = name;
    files.image = folder.path() / (name + ".png");
    files.cloud = folder.path() / (name + ".pcd");
    folder.write(name + ".png", image);
    folder.write(name + ".pcd", cloud);
    dataset.scenes.push_back(files);
  };
  dataset.path = folder.path();
  add("A", "image 1", "cloud 1");
  add("B", "image 2", "cloud 1");
  add("C", "image 1", "cloud 2");
  add("D", "image 2", "cloud 1");
  add("E", "image 3", "cloud 3");
  const auto same = same_content(dataset, false, hash_inputs(dataset, false, {}));
  ASSERT_EQ(same.size(), 5U);
  EXPECT_FALSE(same[0].image || same[0].cloud);
  EXPECT_FALSE(same[1].image.has_value());
  EXPECT_EQ(same[1].cloud, 0U);
  EXPECT_EQ(same[2].image, 0U);
  EXPECT_FALSE(same[2].cloud.has_value());
  EXPECT_EQ(same[3].image, 1U);
  EXPECT_EQ(same[3].cloud, 0U);
  EXPECT_FALSE(same[4].image || same[4].cloud);
}

// Intensities that belong to other returns show something like a small board in every cloud; at
// places that do not agree it is none.
TEST(Calibrate, WhatLooksLikeASmallBoardByChanceIsNoOtherUnit) {
  simulation::SimulationOptions options = test::dataset_options(992001, 4);
  options.lidar.kind = simulation::LidarKind::kRosette;
  options.lidar.points = 60'000;
  const test::SimulatedDataset data(options);
  const Dataset dataset = data.open();
  for (const SceneFiles& scene : dataset.scenes) {
    auto cloud = read_cloud(scene.cloud);
    ASSERT_TRUE(cloud.ok());
    std::rotate(cloud->intensity.begin(), cloud->intensity.end() - 300, cloud->intensity.end());
    ASSERT_TRUE(write_pcd(scene.cloud, *cloud).ok());
  }
  const auto result = calibrate(dataset, {}, {});
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().text(), HasSubstr("the board is not found in any cloud"));
  EXPECT_THAT(result.error().text(), Not(HasSubstr("if the lengths in target.yaml are")));
  EXPECT_THAT(result.error().text(), Not(HasSubstr("disagree on the board's size")));
}

}  // namespace
}  // namespace lvcalib
