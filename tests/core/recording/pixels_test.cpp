// SPDX-License-Identifier: GPL-3.0-or-later
#include "recording/pixels.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "support/image_files.h"

namespace lvcalib {
namespace {

// A smooth picture in colours, so that a mosaic of it can be undone within a few grey levels.
cv::Mat picture() {
  cv::Mat out(120, 192, CV_8UC3);
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      out.at<cv::Vec3b>(y, x) = {static_cast<uchar>(40 + x / 2), static_cast<uchar>(60 + y),
                                 static_cast<uchar>(200 - (x + y) / 3)};
    }
  }
  return out;
}

// The colour (0 blue, 1 green, 2 red) of each pixel of a 2 × 2 pattern "rggb".
int color_of(const std::string& pattern, int x, int y) {
  const char c = pattern[static_cast<std::size_t>(2 * (y % 2) + x % 2)];
  return c == 'b' ? 0 : c == 'g' ? 1 : 2;
}

ImageMessage message_of(const cv::Mat& pixels, const std::string& encoding) {
  ImageMessage out;
  out.width_px = pixels.cols;
  out.height_px = pixels.rows;
  out.encoding = encoding;
  out.step = static_cast<std::uint32_t>(pixels.step);
  out.data = {reinterpret_cast<const char*>(pixels.data),
              pixels.step * static_cast<std::size_t>(pixels.rows)};
  return out;
}

cv::Mat decoded(const ImageMessage& message) {
  const auto file = make_image_file(message, "test");
  EXPECT_TRUE(file.ok());
  EXPECT_EQ(file->extension, ".png");
  return test::decode_pixels(file->bytes);
}

TEST(Pixels, ColorsAndGreyAreKept) {
  const cv::Mat bgr = picture();
  EXPECT_EQ(cv::norm(decoded(message_of(bgr, "bgr8")), bgr, cv::NORM_INF), 0.0);
  cv::Mat other;
  cv::cvtColor(bgr, other, cv::COLOR_BGR2RGB);
  EXPECT_EQ(cv::norm(decoded(message_of(other, "rgb8")), bgr, cv::NORM_INF), 0.0);
  cv::cvtColor(bgr, other, cv::COLOR_BGR2RGBA);
  EXPECT_EQ(cv::norm(decoded(message_of(other, "rgba8")), bgr, cv::NORM_INF), 0.0);
  cv::cvtColor(bgr, other, cv::COLOR_BGR2BGRA);
  EXPECT_EQ(cv::norm(decoded(message_of(other, "bgra8")), bgr, cv::NORM_INF), 0.0);
  cv::cvtColor(bgr, other, cv::COLOR_BGR2GRAY);
  EXPECT_EQ(cv::norm(decoded(message_of(other, "mono8")), other, cv::NORM_INF), 0.0);
}

TEST(Pixels, SixteenBitsOfBothByteOrders) {
  cv::Mat wide(20, 30, CV_16UC1);
  for (int i = 0; i < 600; ++i)
    wide.at<std::uint16_t>(i / 30, i % 30) = static_cast<std::uint16_t>(i * 109);
  EXPECT_EQ(cv::norm(decoded(message_of(wide, "mono16")), wide, cv::NORM_INF), 0.0);
  cv::Mat swapped = wide.clone();
  for (auto& v : cv::Mat_<std::uint16_t>(swapped)) v = static_cast<std::uint16_t>(v << 8 | v >> 8);
  ImageMessage big = message_of(swapped, "mono16");
  big.big_endian = true;
  EXPECT_EQ(cv::norm(decoded(big), wide, cv::NORM_INF), 0.0);
}

TEST(Pixels, EveryBayerPatternGivesTheColorsBack) {
  const cv::Mat bgr = picture();
  for (const std::string pattern : {"rggb", "bggr", "gbrg", "grbg"}) {
    cv::Mat mosaic(bgr.rows, bgr.cols, CV_8UC1);
    for (int y = 0; y < bgr.rows; ++y) {
      for (int x = 0; x < bgr.cols; ++x) {
        mosaic.at<uchar>(y, x) = bgr.at<cv::Vec3b>(y, x)[color_of(pattern, x, y)];
      }
    }
    const cv::Mat back = decoded(message_of(mosaic, "bayer_" + pattern + "8"));
    const cv::Rect inner(2, 2, bgr.cols - 4, bgr.rows - 4);
    EXPECT_LE(cv::norm(back(inner), bgr(inner), cv::NORM_INF), 3.0) << pattern;
  }
}

TEST(Pixels, Yuv422OfBothOrders) {
  // A grey ramp: luma is the grey, chroma 128.
  cv::Mat uyvy(10, 20, CV_8UC2);
  cv::Mat yuyv(10, 20, CV_8UC2);
  for (int i = 0; i < 200; ++i) {
    const auto y = static_cast<uchar>(16 + i);
    uyvy.at<cv::Vec2b>(i / 20, i % 20) = {128, y};
    yuyv.at<cv::Vec2b>(i / 20, i % 20) = {y, 128};
  }
  const cv::Mat a = decoded(message_of(uyvy, "yuv422"));
  const cv::Mat b = decoded(message_of(yuyv, "yuv422_yuy2"));
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
  // Video's 16…235 spread over 0…255.
  EXPECT_NEAR(a.at<cv::Vec3b>(5, 0)[1], 1.164 * 100, 2.0);
}

TEST(Pixels, PackedImagesKeepTheirBytes) {
  cv::Mat grey;
  cv::cvtColor(picture(), grey, cv::COLOR_BGR2GRAY);
  const std::string jpeg =
      *encode_grey_jpeg({grey.cols, grey.rows, 1, 8, grey.data, grey.step[0]}, 90);
  ImageMessage message;
  message.compressed = true;
  message.encoding = "jpeg";
  message.data = jpeg;
  const auto file = make_image_file(message, "test");
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(file->extension, ".jpg");
  EXPECT_EQ(file->bytes, message.data);
  const auto look = look_at_image(message, "test");
  ASSERT_TRUE(look.ok());
  EXPECT_EQ(look->width_px, 192);
  message.data = message.data.substr(0, 100);
  EXPECT_FALSE(look_at_image(message, "test").ok());
}

TEST(Pixels, LooksAreMeansOfCellsAndSharpnessFallsWithBlur) {
  cv::Mat grey(96, 192, CV_8UC1, cv::Scalar(0));
  grey.colRange(0, 1).setTo(200);  // Half of the first column of cells, which are 2 px wide.
  const auto look = look_at_image(message_of(grey, "mono8"), "test");
  ASSERT_TRUE(look.ok());
  EXPECT_EQ(look->cell_px, 2);
  EXPECT_EQ(look->columns, 96);
  EXPECT_EQ(look->rows, 48);
  EXPECT_EQ(look->cells[0], 100 * 256);
  EXPECT_EQ(look->cells[1], 0);
  cv::Mat sharp(200, 200, CV_8UC1, cv::Scalar(30));
  sharp(cv::Rect(50, 50, 80, 80)).setTo(220);
  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {}, 1.5);
  EXPECT_GT(look_at_image(message_of(sharp, "mono8"), "")->sharpness,
            1.5 * look_at_image(message_of(blurred, "mono8"), "")->sharpness);
}

}  // namespace
}  // namespace lvcalib
