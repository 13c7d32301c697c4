// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report_images.h"

#include <fstream>

#include <gtest/gtest.h>

#include "support/image_files.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

std::string encoded(const std::string& text) {
  return base64(reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

// The examples of RFC 4648.
TEST(ReportImages, Base64) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

TEST(ReportImages, ShowsThePartAskedForWithinTheImage) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "image.png";
  test::write_png(path, cv::Mat(100, 200, CV_8UC1, cv::Scalar(90)));
  const auto part = page_image(path, {150.2, -30.0}, {260.0, 40.3}, 1000);
  ASSERT_TRUE(part.has_value());
  EXPECT_TRUE(part->data_uri.starts_with("data:image/jpeg;base64,/9j/"));
  EXPECT_EQ(part->from_px, Eigen::Vector2d(149.5, -0.5));
  EXPECT_EQ(part->size_px, Eigen::Vector2d(50, 40));
  // Made smaller, it still says what it shows of the original.
  const auto small = page_image(path, {0, 0}, {200, 100}, 50);
  ASSERT_TRUE(small.has_value());
  EXPECT_EQ(small->size_px, Eigen::Vector2d(200, 100));
}

TEST(ReportImages, WhatIsNoImageGivesNone) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "image.png";
  EXPECT_FALSE(page_image(path, {0, 0}, {10, 10}, 100).has_value());
  std::ofstream(path) << "no image";
  EXPECT_FALSE(page_image(path, {0, 0}, {10, 10}, 100).has_value());
  test::write_png(path, cv::Mat(10, 10, CV_8UC1, cv::Scalar(90)));
  EXPECT_FALSE(page_image(path, {50, 50}, {60, 60}, 100).has_value());
}

}  // namespace
}  // namespace lvcalib
