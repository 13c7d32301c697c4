// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "base/image_codec.h"

namespace lvcalib::test {

/// Exchanges red and blue, which OpenCV has the other way round than files.
inline cv::Mat red_and_blue_exchanged(const cv::Mat& pixels) {
  cv::Mat out = pixels.clone();
  const int channels = pixels.channels();
  if (channels < 3) return out;
  const int pairs[] = {0, 2, 1, 1, 2, 0, 3, 3};
  cv::mixChannels(&pixels, 1, &out, 1, pairs, static_cast<std::size_t>(channels));
  return out;
}

/// The pixels of an image file as OpenCV has them, blue first; fails the test if there are none.
/// Tests take the product's decoder, which is compared with OpenCV's in one place: loading that
/// takes longer than most tests.
inline cv::Mat decode_pixels(const std::string& file) {
  const auto image = decode_image(file);
  EXPECT_TRUE(image.ok()) << (image.ok() ? "" : image.error().text());
  if (!image) return {};
  return red_and_blue_exchanged(
      cv::Mat(image->height_px, image->width_px,
              CV_MAKETYPE(image->bits == 8 ? CV_8U : CV_16U, image->channels),
              const_cast<std::uint8_t*>(image->bytes.data())));
}

inline cv::Mat read_pixels(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return decode_pixels({std::istreambuf_iterator<char>(stream), {}});
}

/// Writes a png of pixels with blue first; false if that cannot be done.
inline bool write_png(const std::filesystem::path& path, const cv::Mat& pixels) {
  const cv::Mat rgb = red_and_blue_exchanged(pixels);
  const auto file = encode_png(
      {rgb.cols, rgb.rows, rgb.channels(), rgb.depth() == CV_8U ? 8 : 16, rgb.data, rgb.step[0]});
  if (!file) return false;
  std::ofstream stream(path, std::ios::binary);
  stream << *file;
  return stream.good();
}

}  // namespace lvcalib::test
