// SPDX-License-Identifier: GPL-3.0-or-later
#include "detection/board_view.h"

#include <cmath>
#include <fstream>

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/statistics.h"
#include "support/rendered_board.h"

namespace lvcalib {
namespace {

Target viewed_target() {
  Target target;
  target.tag_columns = 3;
  target.tag_rows = 2;
  target.tag_spacing = 0.6;
  target.circle_radius_m = 0.03;
  return target;
}

GrayImage picture(const Target& target, const Camera& camera, const Rigid3& pose) {
  testing::RenderOptions render;
  render.samples_per_side = 4;
  return testing::render_board(target, camera, pose, render);
}

TEST(BoardView, PoseAgreesWithTheTruth) {
  const Target target = viewed_target();
  Camera camera = testing::pinhole(400, 300, 400);
  camera.distortion.head<2>() << -0.2, 0.05;
  const Rigid3 pose = testing::facing_pose(target, 0.9, 0.15, 0.35, -0.3);
  const auto view = find_board_in_image(picture(target, camera, pose), target, camera, {}, {});
  ASSERT_TRUE(view.ok()) << view.error().text();
  EXPECT_EQ(view->tag_count, 6);
  EXPECT_EQ(view->corners.size(), 24U);
  EXPECT_FALSE(view->alternative_pose.has_value());
  EXPECT_TRUE(view->warnings.empty());
  EXPECT_LT(view->sigma_px, 0.05);
  EXPECT_LT(view->rms_px, 0.05);
  const Vector6d error = se3_log(pose * view->camera_from_board.transform.inverse());
  EXPECT_LT(error.dot(view->camera_from_board.covariance.inverse() * error), 22.5);  // 99.9 %
  EXPECT_LT(error.head<3>().norm(), 1e-3);
}

TEST(BoardView, DifferentImageSizeIsAnErrorNamingBoth) {
  const Target target = viewed_target();
  const Camera camera = testing::pinhole(400, 300, 400);
  const GrayImage image{200, 150, std::vector<float>(200 * 150, 0.0F)};
  const auto view = find_board_in_image(image, target, camera, {}, {});
  ASSERT_FALSE(view.ok());
  EXPECT_EQ(view.error().kind, ErrorKind::kInput);
  EXPECT_NE(view.error().message.text().find("200 × 150"), std::string::npos);
  EXPECT_NE(view.error().message.text().find("400 × 300"), std::string::npos);
}

TEST(BoardView, PixelsThatAreNotNumbersDoNoHarm) {
  const Target target = viewed_target();
  const Camera camera = testing::pinhole(400, 300, 400);
  GrayImage image = picture(target, camera, testing::facing_pose(target, 0.9, 0.1, 0.3, 0));
  for (std::size_t i = 0; i < image.pixels.size(); i += 977) image.pixels[i] = std::nanf("");
  EXPECT_TRUE(find_board_in_image(image, target, camera, {}, {}).ok());
  image.pixels.clear();
  EXPECT_FALSE(find_board_in_image(image, target, camera, {}, {}).ok());
}

// A second copy of one tag beside the board: the one that fits the board is kept.
TEST(BoardView, OfTwoTagsWithOneIdTheFittingOneIsKept) {
  const Target target = viewed_target();
  const Camera camera = testing::pinhole(560, 300, 400);
  const Rigid3 pose = testing::facing_pose(target, 0.9, 0.0, 0.2, 0.1);
  GrayImage image = picture(target, camera, pose);
  // Copy what surrounds tag 0 into the empty right part of the image.
  const auto center = camera.project(pose * Eigen::Vector3d(0.06, 0.06, 0));
  const int half = 40;
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      const int from_x = static_cast<int>(center->x()) + x;
      const int from_y = static_cast<int>(center->y()) + y;
      image.pixels[static_cast<std::size_t>((80 + y) * image.width_px + 510 + x)] =
          image.at(from_x, from_y);
    }
  }
  const auto view = find_board_in_image(image, target, camera, {}, {});
  ASSERT_TRUE(view.ok()) << view.error().text();
  EXPECT_EQ(view->tag_count, 6);
  EXPECT_LT(translation_distance_m(view->camera_from_board.transform, pose), 2e-3);
}

TEST(BoardView, WrongSpacingIsNoticed) {
  const Target printed = viewed_target();
  Target told = printed;
  told.type = TargetType::kAprilGrid;
  told.tag_spacing = 1.2;
  const Camera camera = testing::pinhole(400, 300, 400);
  const GrayImage image = picture(printed, camera, testing::facing_pose(printed, 0.9, 0, 0.2, 0.1));
  DetectionOptions options;
  const auto view = find_board_in_image(image, told, camera, options, {});
  EXPECT_TRUE(!view.ok() || !view->warnings.empty());
}

TEST(BoardView, StopIsHonoured) {
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const Camera camera = testing::pinhole(64, 64, 100);
  const GrayImage image{64, 64, std::vector<float>(64 * 64, 0.0F)};
  const auto view = find_board_in_image(image, viewed_target(), camera, {}, context);
  ASSERT_FALSE(view.ok());
  EXPECT_EQ(view.error().kind, ErrorKind::kCancelled);
}

// Independent simulator with known poses: corners without bias, poses within their covariance.
TEST(SimulatedScenes, CornersAndPosesAgreeWithTheTruth) {
  const auto data = testing::shared_data();
  if (!data) GTEST_SKIP() << "shared data not found";
  std::vector<double> errors, distances;
  double outward = 0.0;
  for (const std::string set : {"clean-avia", "walk-rosette"}) {
    const auto folder = *data / "simulated" / set;
    std::ifstream stream(*data / "simulated" / (set + "-truth.json"));
    const auto truth = nlohmann::json::parse(stream);
    const auto target = read_target(folder / "target.yaml");
    const auto camera = read_camera(folder / "camera.yaml");
    ASSERT_TRUE(target.ok() && camera.ok());
    for (const auto& [name, scene] : truth["scenes"].items()) {
      Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
      for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
          matrix(static_cast<int>(row), static_cast<int>(column)) = scene["T_CB"][row][column];
        }
      }
      const Rigid3 pose = Rigid3::from_matrix(matrix);
      const auto image = read_image(folder / "scenes" / name / "image.png");
      ASSERT_TRUE(image.ok());
      const auto view = find_board_in_image(*image, target->target, camera->camera, {}, {});
      ASSERT_TRUE(view.ok()) << view.error().text();
      EXPECT_GE(view->tag_count, 15) << set << " " << name;
      for (const CornerObservation& corner : view->corners) {
        const auto project = [&](const Eigen::Vector2d& p) {
          return *camera->camera.project(pose * Eigen::Vector3d(p.x(), p.y(), 0));
        };
        const Eigen::Vector2d expected = project(corner.board_m);
        const Eigen::Vector2d center = project(target->target.tag(corner.feature_id)->center_m);
        const Eigen::Vector2d error = corner.pixel - expected;
        outward += error.dot((expected - center).normalized());
        // Corners of half-hidden tags say themselves that they are worse.
        if (corner.sigma_px < 0.05) errors.push_back(error.norm() / std::sqrt(2.0));
      }
      const Vector6d error = se3_log(pose * view->camera_from_board.transform.inverse());
      distances.push_back(error.dot(view->camera_from_board.covariance.inverse() * error));
      EXPECT_LT(distances.back(), 22.5) << set << " " << name;
    }
  }
  outward /= static_cast<double>(errors.size());
  RecordProperty("outward_px", std::to_string(outward));
  RecordProperty("rms_px", std::to_string(rms(errors)));
  EXPECT_LT(std::abs(outward), 0.005);
  EXPECT_LT(rms(errors), 0.03);
}

}  // namespace
}  // namespace lvcalib
