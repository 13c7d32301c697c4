// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/still_stretches.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace lvcalib {
namespace {

constexpr int kWidth = 960;
constexpr int kHeight = 600;
constexpr std::int64_t kTick = 100'000'000;  // 10 Hz

// A board with a chequered print before a textured wall, seen by a camera (noise of 4 grey levels)
// whose look is made directly: means of cells of 10 px.
ImageLook look_at(double board_x_px, double camera_x_px, double gain, std::uint64_t seed) {
  Random random(seed);
  ImageLook look;
  look.width_px = kWidth;
  look.height_px = kHeight;
  look.cell_px = 10;
  look.columns = kWidth / 10;
  look.rows = kHeight / 10;
  const auto smooth = [](double edge, double at) { return 0.5 * (1.0 + std::tanh(at - edge)); };
  for (int row = 0; row < look.rows; ++row) {
    for (int column = 0; column < look.columns; ++column) {
      double sum = 0.0;
      for (int k = 0; k < 10; ++k) {
        const double x = 10.0 * column + k + camera_x_px;
        const double y = 10.0 * row + 5.0;
        double grey = 120.0 + 40.0 * std::sin(0.05 * x) * std::cos(0.03 * y);
        const double u = x - board_x_px;
        if (u > 0.0 && u < 100.0 && y > 200.0 && y < 300.0) {
          const double phase = std::fmod(u, 25.0);
          grey = 40.0 + 160.0 * smooth(12.0, phase) * (1.0 - smooth(24.0, phase));
        }
        sum += grey;
      }
      const double noise = random.normal(0.0, 4.0 / 10.0);  // A hundred pixels.
      const double mean = gain * sum / 10.0 + noise;
      look.cells.push_back(static_cast<std::uint16_t>(256.0 * mean));
    }
  }
  look.sharpness = 1.0;
  return look;
}

// A wall 5 m ahead and a board of 0.9 m before it, hit in random directions.
CloudLook sweep(double board_y_m, double yaw_rad, std::uint64_t seed) {
  Random random(seed);
  Cloud cloud;
  for (int i = 0; i < 20'000; ++i) {
    const double azimuth = random.uniform(-0.6, 0.6);
    const double elevation = random.uniform(-0.5, 0.5);
    const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth + yaw_rad),
                                    std::cos(elevation) * std::sin(azimuth + yaw_rad),
                                    std::sin(elevation));
    // The second wall, slanted, tells a turn.
    double range = 5.0 / direction.x();
    range = std::min(range, 4.0 / (0.6 * direction.x() + 0.8 * direction.y() + 1e-9) > 0.0
                                ? 4.0 / (0.6 * direction.x() + 0.8 * direction.y())
                                : range);
    const Eigen::Vector3d at = 3.0 / direction.x() * direction;
    if (std::abs(at.y() - board_y_m) < 0.45 && std::abs(at.z()) < 0.45) range = at.norm();
    range += random.normal(0.0, 0.02);
    const Eigen::Vector3d seen(std::cos(elevation) * std::cos(azimuth),
                               std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    cloud.points_m.push_back((range * seen).cast<float>());
  }
  return look_at_cloud(cloud);
}

struct State {
  double board_px = 400.0;
  double camera_px = 0.0;
  double board_m = 0.0;
  double yaw_rad = 0.0;
};

class Walk {
 public:
  // One sample of both sensors.
  void step(const State& s, bool with_cloud = true) {
    const double gain = 1.0 + 0.02 * std::sin(1.7 * static_cast<double>(tick_));
    images_.add(tick_ * kTick, look_at(s.board_px, s.camera_px, gain, 2 * number_), 1);
    if (with_cloud) clouds_.add(tick_ * kTick, sweep(s.board_m, s.yaw_rad, 2 * number_ + 1), 1);
    ++number_;
    ++tick_;
  }
  void rest(const State& s, int samples, bool with_cloud = true) {
    for (int i = 0; i < samples; ++i) step(s, with_cloud);
  }
  [[nodiscard]] std::vector<StillStretch> stretches(const StillOptions& options = {}) const {
    return find_still_stretches(images_, clouds_, options);
  }
  [[nodiscard]] std::vector<StillStretch> taken() const {
    auto out = stretches();
    std::erase_if(out, [](const auto& s) { return s.verdict != StretchVerdict::kTaken; });
    return out;
  }
  [[nodiscard]] const ImageTrack& images() const { return images_; }

 private:
  ImageTrack images_ = make_image_track({});
  CloudTrack clouds_ = make_cloud_track({});
  std::int64_t tick_ = 0;
  std::uint64_t number_ = 1;
};

// Begin and end in tenths of a second; a sample stands for the tenth about it.
void expect_span(const StillStretch& s, double first, double last) {
  EXPECT_NEAR(static_cast<double>(s.first_ns) / kTick, first, 1.01);
  EXPECT_NEAR(static_cast<double>(s.last_ns) / kTick, last, 1.01);
}

TEST(StillStretches, BoardMovedBetweenRests) {
  Walk walk;
  State s;
  walk.rest(s, 20);
  // Two pixels a sample: a hand that moves the board slowly.
  for (int i = 0; i < 20; ++i) {
    s.board_px += 2.0;
    s.board_m += 0.02;
    walk.step(s);
  }
  walk.rest(s, 25);
  const auto taken = walk.taken();
  ASSERT_EQ(taken.size(), 2U);
  expect_span(taken[0], 0, 19);
  expect_span(taken[1], 39, 64);
}

TEST(StillStretches, RigTurnedBetweenRests) {
  Walk walk;
  State s;
  walk.rest(s, 20);
  for (int i = 0; i < 15; ++i) {
    s.camera_px += 1.5;
    s.board_px -= 1.5;
    s.yaw_rad += 0.02;
    walk.step(s);
  }
  walk.rest(s, 20);
  EXPECT_EQ(walk.taken().size(), 2U);
}

TEST(StillStretches, SlowDriftIsNoRest) {
  Walk walk;
  State s;
  walk.rest(s, 50);
  // A third of a pixel a sample, which none of two neighbours shows.
  for (int i = 0; i < 100; ++i) {
    s.camera_px += 0.35;  // Board and wall drift through the image together.
    walk.step(s);
  }
  const auto taken = walk.taken();
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_NEAR(static_cast<double>(taken[0].last_ns) / kTick, 49.0, 4.0);
}

TEST(StillStretches, NoiseAndBrightnessAreNoMotion) {
  Walk walk;
  walk.rest({}, 100);
  const auto taken = walk.taken();
  ASSERT_EQ(taken.size(), 1U);
  expect_span(taken[0], 0, 99);
}

TEST(StillStretches, ShortRestsAreToldAndLeft) {
  Walk walk;
  State s;
  walk.rest(s, 20);
  for (int i = 0; i < 5; ++i) {
    s.board_px += 20.0;
    s.board_m += 0.1;
    walk.step(s);
  }
  walk.rest(s, 6);
  for (int i = 0; i < 5; ++i) {
    s.board_px += 20.0;
    s.board_m += 0.1;
    walk.step(s);
  }
  walk.rest(s, 20);
  const auto all = walk.stretches();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].verdict, StretchVerdict::kTaken);
  EXPECT_EQ(all[1].verdict, StretchVerdict::kTooShort);
  EXPECT_EQ(all[2].verdict, StretchVerdict::kTaken);
}

TEST(StillStretches, TheSamePoseAgainIsARepeatOfTheLonger) {
  Walk walk;
  State s;
  walk.rest(s, 15);
  State moved = s;
  moved.board_px += 200.0;
  moved.board_m += 0.6;
  walk.rest(moved, 20);
  s.board_px += 0.5;
  walk.rest(s, 30);
  const auto all = walk.stretches();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].verdict, StretchVerdict::kRepeat);
  EXPECT_EQ(all[0].repeat_of, 2U);
  EXPECT_EQ(all[1].verdict, StretchVerdict::kTaken);
  EXPECT_EQ(all[2].verdict, StretchVerdict::kTaken);
}

TEST(StillStretches, WithoutCloudsOrWithCloudsThatMove) {
  Walk walk;
  State s;
  walk.rest(s, 20);
  State moved = s;
  moved.board_px += 200.0;
  moved.board_m += 0.6;
  walk.rest(moved, 20, false);
  s.board_px -= 150.0;
  s.board_m -= 0.5;
  for (int i = 0; i < 20; ++i) {
    s.yaw_rad += 0.05;  // Only the LiDAR turns.
    walk.step(s);
  }
  const auto all = walk.stretches();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].verdict, StretchVerdict::kTaken);
  EXPECT_EQ(all[1].verdict, StretchVerdict::kNoCloud);
  EXPECT_EQ(all[2].verdict, StretchVerdict::kCloudMoves);
}

TEST(StillStretches, OneImageAndCloudPerPose) {
  ImageTrack images = make_image_track({});
  CloudTrack clouds = make_cloud_track({});
  for (int i = 0; i < 4; ++i) {
    const std::int64_t t = i * 100 * kTick;
    images.add(t, look_at(100.0 + 120.0 * i, 0.0, 1.0, static_cast<std::uint64_t>(i)), 1);
    clouds.add(t + kTick, sweep(-1.0 + 0.5 * i, 0.0, static_cast<std::uint64_t>(i)), 1);
  }
  const auto all = find_still_stretches(images, clouds, {});
  ASSERT_EQ(all.size(), 4U);
  for (const StillStretch& s : all) EXPECT_EQ(s.verdict, StretchVerdict::kTaken);
}

TEST(StillStretches, LongTracksAreThinnedOut) {
  ImageTrack track(10.0, 1000);
  std::int64_t t = 0;
  for (int i = 0; i < 5000; ++i, t += kTick) {
    if (track.wants(t)) track.add(t, ImageLook{}, 1);
  }
  EXPECT_LE(track.size(), 1001U);
  EXPECT_GE(track.size(), 400U);
  EXPECT_GT(track.period_ns(), 5 * kTick);
  EXPECT_FALSE(track.wants(0));
  for (std::size_t i = 1; i < track.size(); ++i) EXPECT_GT(track.time_ns(i), track.time_ns(i - 1));
}

TEST(StillStretches, ImagesOfChangingSize) {
  Walk walk;
  walk.rest({}, 20);
  ImageTrack images = walk.images();
  ImageLook other = look_at(400.0, 0.0, 1.0, 5);
  other.width_px = 100;
  images.add(20 * kTick, other, 1);
  images.add(21 * kTick, look_at(400.0, 0.0, 1.0, 6), 1);
  const ImageComparison comparison(images);
  EXPECT_TRUE(comparison.moved(0, 20, 1.0));
  EXPECT_FALSE(comparison.moved(0, 21, 1.0));
}

TEST(CloudLook, NoAxisIsSpecial) {
  // The same scene turned about an odd axis looks the same to itself, and moves when it moves.
  const CloudLook a = sweep(0.0, 0.0, 1);
  const CloudLook b = sweep(0.0, 0.0, 2);
  const CloudLook c = sweep(0.3, 0.1, 3);
  EXPECT_FALSE(moved(a, b));
  EXPECT_TRUE(moved(a, c));
  EXPECT_TRUE(moved(a, CloudLook{}));
  for (const CloudLook::Cell& cell : a.cells) EXPECT_GT(cell.range_2mm, 1000);
}

}  // namespace
}  // namespace lvcalib
