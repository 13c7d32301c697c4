// SPDX-License-Identifier: BSD-3-Clause
#include "recording/pixels.h"

#include <algorithm>
#include <bit>
#include <map>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/image_codec.h"

namespace lvcalib {
namespace {

// Cells along the longer side of an image: a board at the far end of its range (a tenth of the
// side) still covers a hundred of them.
constexpr int kCellsAlong = 96;

struct Conversion {
  int type = CV_8UC1;
  int to_color = -1;  // OpenCV's code to BGR; −1: grey or already so.
  int to_grey = -1;   // To grey; −1: grey already.
};

// OpenCV names a bayer pattern by its second row's second and third pixel, ROS by its first row.
Conversion conversion_of(const std::string& encoding) {
  static const std::map<std::string, Conversion> known = {
      {"mono8", {CV_8UC1, -1, -1}},
      {"8UC1", {CV_8UC1, -1, -1}},
      {"mono16", {CV_16UC1, -1, -1}},
      {"16UC1", {CV_16UC1, -1, -1}},
      {"bgr8", {CV_8UC3, -1, cv::COLOR_BGR2GRAY}},
      {"8UC3", {CV_8UC3, -1, cv::COLOR_BGR2GRAY}},
      {"bgr16", {CV_16UC3, -1, cv::COLOR_BGR2GRAY}},
      {"rgb8", {CV_8UC3, cv::COLOR_RGB2BGR, cv::COLOR_RGB2GRAY}},
      {"rgb16", {CV_16UC3, cv::COLOR_RGB2BGR, cv::COLOR_RGB2GRAY}},
      {"rgba8", {CV_8UC4, cv::COLOR_RGBA2BGR, cv::COLOR_RGBA2GRAY}},
      {"bgra8", {CV_8UC4, cv::COLOR_BGRA2BGR, cv::COLOR_BGRA2GRAY}},
      {"8UC4", {CV_8UC4, cv::COLOR_BGRA2BGR, cv::COLOR_BGRA2GRAY}},
      {"bayer_rggb8", {CV_8UC1, cv::COLOR_BayerBG2BGR, cv::COLOR_BayerBG2GRAY}},
      {"bayer_bggr8", {CV_8UC1, cv::COLOR_BayerRG2BGR, cv::COLOR_BayerRG2GRAY}},
      {"bayer_gbrg8", {CV_8UC1, cv::COLOR_BayerGR2BGR, cv::COLOR_BayerGR2GRAY}},
      {"bayer_grbg8", {CV_8UC1, cv::COLOR_BayerGB2BGR, cv::COLOR_BayerGB2GRAY}},
      {"bayer_rggb16", {CV_16UC1, cv::COLOR_BayerBG2BGR, cv::COLOR_BayerBG2GRAY}},
      {"bayer_bggr16", {CV_16UC1, cv::COLOR_BayerRG2BGR, cv::COLOR_BayerRG2GRAY}},
      {"bayer_gbrg16", {CV_16UC1, cv::COLOR_BayerGR2BGR, cv::COLOR_BayerGR2GRAY}},
      {"bayer_grbg16", {CV_16UC1, cv::COLOR_BayerGB2BGR, cv::COLOR_BayerGB2GRAY}},
      {"yuv422", {CV_8UC2, cv::COLOR_YUV2BGR_UYVY, cv::COLOR_YUV2GRAY_UYVY}},
      {"uyvy", {CV_8UC2, cv::COLOR_YUV2BGR_UYVY, cv::COLOR_YUV2GRAY_UYVY}},
      {"yuv422_yuy2", {CV_8UC2, cv::COLOR_YUV2BGR_YUY2, cv::COLOR_YUV2GRAY_YUY2}},
      {"yuyv", {CV_8UC2, cv::COLOR_YUV2BGR_YUY2, cv::COLOR_YUV2GRAY_YUY2}}};
  return known.at(encoding);  // decode_image() let no other pass.
}

Error damaged_image(const std::string& where) {
  return Error::input(Message("an image cannot be decoded: its data are damaged"), where);
}

// Blue first, as OpenCV has colours; grey without alpha.
cv::Mat in_opencv_order(const DecodedImage& image) {
  const cv::Mat view(image.height_px, image.width_px,
                     CV_MAKETYPE(image.bits == 8 ? CV_8U : CV_16U, image.channels),
                     const_cast<std::uint8_t*>(image.bytes.data()), image.row_bytes());
  cv::Mat out;
  if (image.channels == 1) return view.clone();
  if (image.channels == 2) {
    cv::extractChannel(view, out, 0);
  } else {
    cv::cvtColor(view, out, image.channels == 3 ? cv::COLOR_RGB2BGR : cv::COLOR_RGBA2BGRA);
  }
  return out;
}

// Blue and red exchanged, as a file has them.
Result<std::string> png_of(const cv::Mat& bgr) {
  cv::Mat pixels;
  if (bgr.channels() < 3) {
    pixels = bgr;
  } else {
    cv::cvtColor(bgr, pixels, bgr.channels() == 3 ? cv::COLOR_BGR2RGB : cv::COLOR_BGRA2RGBA);
  }
  return encode_png({pixels.cols, pixels.rows, pixels.channels(), pixels.depth() == CV_16U ? 16 : 8,
                     pixels.data, pixels.step[0]});
}

// The pixels as they were sent; an empty matrix if they cannot be decoded.
cv::Mat pixels_of(const ImageMessage& message) {
  if (message.compressed) {
    const auto decoded = decode_image(message.data);
    return decoded ? in_opencv_order(*decoded) : cv::Mat{};
  }
  const int type = conversion_of(message.encoding).type;
  const cv::Mat view(message.height_px, message.width_px, type,
                     const_cast<char*>(message.data.data()), message.step);
  if (CV_MAT_DEPTH(type) != CV_16U ||
      message.big_endian == (std::endian::native == std::endian::big)) {
    return view;
  }
  cv::Mat swapped = view.clone();
  for (int y = 0; y < swapped.rows; ++y) {
    auto* row = swapped.ptr<std::uint16_t>(y);
    std::transform(row, row + swapped.cols * swapped.channels(), row, [](std::uint16_t v) {
      return static_cast<std::uint16_t>((v << 8U) | (v >> 8U));
    });
  }
  return swapped;
}

// 8-bit grey, only to compare images with each other.
cv::Mat grey_of(const ImageMessage& message) {
  cv::Mat pixels = pixels_of(message);
  int code = -1;
  if (message.compressed) {
    if (pixels.channels() == 3) code = cv::COLOR_BGR2GRAY;
    if (pixels.channels() == 4) code = cv::COLOR_BGRA2GRAY;
  } else {
    code = conversion_of(message.encoding).to_grey;
  }
  if (code >= 0 && !pixels.empty()) {
    cv::Mat grey;
    cv::cvtColor(pixels, grey, code);
    pixels = grey;
  }
  if (!pixels.empty() && pixels.depth() == CV_16U) {
    // Sensors of 10 and 12 bits fill a part of the range only; what matters is the contrast.
    double largest = 0.0;
    cv::minMaxLoc(pixels, nullptr, &largest);
    double full = 255.0;
    while (full < largest) full = 2.0 * full + 1.0;
    cv::Mat bytes;
    pixels.convertTo(bytes, CV_8U, 255.0 / full);
    pixels = bytes;
  }
  return pixels.depth() == CV_8U && pixels.channels() == 1 ? pixels : cv::Mat{};
}

double sharpness_of(const cv::Mat& grey) {
  double sum = 0.0;
  for (int y = 0; y + 1 < grey.rows; ++y) {
    const auto* row = grey.ptr<std::uint8_t>(y);
    const auto* below = grey.ptr<std::uint8_t>(y + 1);
    std::uint64_t row_sum = 0;
    for (int x = 0; x + 1 < grey.cols; ++x) {
      const int right = row[x + 1] - row[x];
      const int down = below[x] - row[x];
      row_sum += static_cast<std::uint64_t>(right * right + down * down);
    }
    sum += static_cast<double>(row_sum);
  }
  return sum / static_cast<double>(grey.total());
}

}  // namespace

Result<ImageLook> look_at_image(const ImageMessage& message, const std::string& where) {
  try {
    const cv::Mat grey = grey_of(message);
    if (grey.empty()) return damaged_image(where);
    ImageLook look;
    look.width_px = grey.cols;
    look.height_px = grey.rows;
    look.cell_px = std::max(1, (std::max(grey.cols, grey.rows) + kCellsAlong - 1) / kCellsAlong);
    look.columns = std::max(1, grey.cols / look.cell_px);
    look.rows = std::max(1, grey.rows / look.cell_px);
    cv::Mat wide;
    grey.convertTo(wide, CV_16U, 256.0);
    const cv::Rect whole(0, 0, std::min(grey.cols, look.columns * look.cell_px),
                         std::min(grey.rows, look.rows * look.cell_px));
    cv::Mat cells;
    cv::resize(wide(whole), cells, {look.columns, look.rows}, 0, 0, cv::INTER_AREA);
    look.cells.assign(cells.begin<std::uint16_t>(), cells.end<std::uint16_t>());
    look.sharpness = sharpness_of(grey);
    return look;
  } catch (const cv::Exception&) {
    return damaged_image(where);
  }
}

Result<Thumbnail> make_thumbnail(const ImageMessage& message, int longest_px,
                                 const std::string& where) {
  try {
    cv::Mat pixels = pixels_of(message);
    if (pixels.empty()) return damaged_image(where);
    const int code = message.compressed ? -1 : conversion_of(message.encoding).to_color;
    if (code >= 0) {
      cv::Mat color;
      cv::cvtColor(pixels, color, code);
      pixels = color;
    }
    if (pixels.depth() != CV_8U) {
      cv::Mat bytes;
      cv::normalize(pixels, bytes, 0.0, 255.0, cv::NORM_MINMAX, CV_8U);
      pixels = bytes;
    }
    const double scale =
        std::min(1.0, static_cast<double>(longest_px) / std::max(pixels.cols, pixels.rows));
    cv::Mat small;
    cv::resize(pixels, small, {}, scale, scale, cv::INTER_AREA);
    const int to_rgb[] = {-1, cv::COLOR_GRAY2RGB, -1, cv::COLOR_BGR2RGB, cv::COLOR_BGRA2RGB};
    if (small.channels() > 4 || to_rgb[small.channels()] < 0) return damaged_image(where);
    cv::Mat rgb;
    cv::cvtColor(small, rgb, to_rgb[small.channels()]);
    Thumbnail out{rgb.cols, rgb.rows, {}};
    out.rgb.assign(rgb.data, rgb.data + rgb.total() * 3);
    return out;
  } catch (const cv::Exception&) {
    return damaged_image(where);
  }
}

Result<ImageFile> make_image_file(const ImageMessage& message, const std::string& where) {
  ImageFile out;
  try {
    if (message.compressed) {
      if (pixels_of(message).empty()) return damaged_image(where);
      out.extension = message.encoding == "jpeg" ? ".jpg" : "." + message.encoding;
      out.bytes = message.data;
      return out;
    }
    cv::Mat pixels = pixels_of(message);
    if (const int code = conversion_of(message.encoding).to_color; code >= 0) {
      cv::Mat color;
      cv::cvtColor(pixels, color, code);
      pixels = color;
    }
    auto png = png_of(pixels);
    if (!png) return damaged_image(where);
    out.extension = ".png";
    out.bytes = std::move(*png);
    return out;
  } catch (const cv::Exception&) {
    return damaged_image(where);
  }
}

}  // namespace lvcalib
