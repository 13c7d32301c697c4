// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/lidar_file.h"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_table.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

constexpr const char* kGood =
    "pattern: rosette\nazimuth_fov_deg: [-30, 30]\nelevation_fov_deg: [-20, 20]\n"
    "points_per_scene: 100000\nrange_noise_mm: 8\nbeam_mrad: 1.0\n";

class LidarFileTest : public ::testing::Test {
 protected:
  Result<LidarFile> read(const std::string& text) {
    const auto path = folder_.path() / "lidar.yaml";
    std::ofstream(path) << text;
    return read_lidar(path);
  }
  std::string error(const std::string& text) {
    const auto out = read(text);
    EXPECT_FALSE(out.ok()) << text;
    if (out.ok()) return {};
    EXPECT_EQ(out.error().kind, ErrorKind::kInput);
    return out.error().text();
  }
  test::TemporaryFolder folder_;
};

TEST_F(LidarFileTest, ReadsUnitsIntoSi) {
  const auto out = read(std::string(kGood) + "lines: 6\ntime: true\nscan_speed_rad_s: 50\n");
  ASSERT_TRUE(out.ok()) << out.error().text();
  const LidarDescription& lidar = out->lidar;
  EXPECT_NEAR(lidar.sensors.azimuth_rad.y(), M_PI / 6, 1e-12);
  EXPECT_DOUBLE_EQ(lidar.sensors.range_sigma_m, 0.008);
  EXPECT_DOUBLE_EQ(lidar.sensors.footprint_rad, 0.001);
  EXPECT_EQ(lidar.lines.size(), 6U);
  EXPECT_TRUE(lidar.has_time);
  EXPECT_NEAR(lidar.sensors.traits[5].scan_rad_s.norm(), 50.0, 1e-9);
  // An ellipse in a rectangle of 60° by 2·sin 20°.
  const double area = M_PI / 4 * (M_PI / 3) * 2 * std::sin(M_PI / 9);
  EXPECT_NEAR(lidar.sensors.points_per_sr, 100000 / area, 1e-6 * 100000 / area);
  EXPECT_FALSE(lidar.camera_from_lidar.has_value());
  EXPECT_TRUE(out->warnings.empty());
}

TEST_F(LidarFileTest, EveryMistakeIsNamed) {
  EXPECT_THAT(read_lidar(folder_.path() / "none.yaml").error().text(), HasSubstr("none.yaml"));
  EXPECT_THAT(error("pattern: rosette\n"), HasSubstr("azimuth_fov_deg"));
  EXPECT_THAT(error("pattern: zigzag\n"), HasSubstr("expected rosette or spinning"));
  std::string negative = kGood;
  negative.replace(negative.find("_mm: 8"), 6, "_mm: -8");
  EXPECT_THAT(error(negative), HasSubstr("range_noise_mm"));
  EXPECT_THAT(error("pattern: rosette\nazimuth_fov_deg: [30, -30]\n"), HasSubstr("[low, high]"));
  EXPECT_THAT(error(std::string(kGood) + "time: perhaps\n"), HasSubstr("true or false"));
  EXPECT_THAT(error(std::string(kGood) + "T_camera_lidar: [1, 2, 3]\n"), HasSubstr("3 numbers"));
  EXPECT_THAT(error(std::string(kGood) + "T_camera_lidar: [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]\n"),
              HasSubstr("not a rotation"));
  EXPECT_THAT(error(std::string(kGood) + "lines: many\n"), HasSubstr("lines"));
}

TEST_F(LidarFileTest, UnknownKeysAreWarnedOf) {
  const auto out = read(std::string(kGood) + "beam_mrd: 2\n");
  ASSERT_TRUE(out.ok());
  ASSERT_EQ(out->warnings.size(), 1U);
  EXPECT_THAT(out->warnings[0], HasSubstr("beam_mrd"));
}

TEST_F(LidarFileTest, ATextIsReadLikeAFile) {
  const auto out = parse_lidar(kGood, "in the program");
  ASSERT_TRUE(out.ok()) << out.error().text();
  EXPECT_NEAR(out->lidar.sensors.range_sigma_m, 0.008, 1e-9);
  EXPECT_THAT(parse_lidar("pattern: zigzag\n", "in the program").error().text(),
              HasSubstr("in the program"));
}

TEST(LidarOf, IsWhatTookTheScenes) {
  const auto made = test::synthetic_table({});
  Rigid3 mount = forward_looking_mount();
  mount.translation.x() = 0.2;
  const LidarDescription lidar = lidar_of(made.table, mount);
  EXPECT_EQ(lidar.lines, made.table.lines);
  EXPECT_EQ(lidar.has_time, made.table.has_time);
  EXPECT_EQ(lidar.has_intensity, made.table.has_intensity);
  EXPECT_NEAR(lidar.sensors.range_sigma_m, 0.008, 1e-6);
  ASSERT_TRUE(lidar.camera_from_lidar.has_value());
  EXPECT_EQ(lidar.camera_from_lidar->translation.x(), 0.2);
}

TEST_F(LidarFileTest, ExamplesAreGood) {
  for (const char* name : {"avia", "spinning"}) {
    const auto path = std::filesystem::path(LVCALIB_SOURCE_DIR) / "resources" / "lidars" /
                      (std::string(name) + ".yaml");
    const auto out = read_lidar(path);
    ASSERT_TRUE(out.ok()) << out.error().text();
    EXPECT_TRUE(out->warnings.empty());
  }
}

}  // namespace
}  // namespace lvcalib
