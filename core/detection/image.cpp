// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <new>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/file_io.h"
#include "base/image_header.h"
#include "base/memory.h"
#include "detection/board_view.h"
#include "detection/color_image.h"

namespace lvcalib {
namespace {

// Larger than any camera used for calibration; guards against headers that claim absurd sizes.
constexpr long long kMaxPixels = 200'000'000;
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30U;

// Luma of ITU-R BT.601; OpenCV stores blue, green, red (, alpha). Alpha is ignored: what lies
// beneath transparent pixels is what the camera saw.
template <class Sample>
void copy_gray(const cv::Mat& mat, float scale, std::vector<float>& pixels) {
  const int channels = mat.channels();
  float* out = pixels.data();
  for (int y = 0; y < mat.rows; ++y) {
    const Sample* in = mat.ptr<Sample>(y);
    for (int x = 0; x < mat.cols; ++x, in += channels) {
      const float value = channels < 3 ? static_cast<float>(in[0])
                                       : 0.114F * static_cast<float>(in[0]) +
                                             0.587F * static_cast<float>(in[1]) +
                                             0.299F * static_cast<float>(in[2]);
      *out++ = scale * value;
    }
  }
}

Result<GrayImage> to_gray(const cv::Mat& mat, const std::string& where) {
  GrayImage image{mat.cols, mat.rows, {}};
  image.pixels.resize(mat.total());
  if (mat.depth() == CV_8U) {
    copy_gray<unsigned char>(mat, 1.0F, image.pixels);
  } else if (mat.depth() == CV_16U) {
    copy_gray<unsigned short>(mat, 1.0F / 257.0F, image.pixels);
  } else {
    return Error::input("the image has neither 8 nor 16 bits per channel", where,
                        "save it as 8 or 16 bit png");
  }
  return image;
}

// Red, green, blue in whole grey levels of 0…255.
template <class Sample>
void copy_color(const cv::Mat& mat, int divisor, std::vector<std::uint8_t>& rgb) {
  const int channels = mat.channels();
  std::uint8_t* out = rgb.data();
  const auto level = [&](Sample value) {
    return static_cast<std::uint8_t>((value + divisor / 2) / divisor);
  };
  for (int y = 0; y < mat.rows; ++y) {
    const Sample* in = mat.ptr<Sample>(y);
    for (int x = 0; x < mat.cols; ++x, in += channels, out += 3) {
      out[0] = level(in[channels < 3 ? 0 : 2]);
      out[1] = level(in[channels < 3 ? 0 : 1]);
      out[2] = level(in[0]);
    }
  }
}

Result<cv::Mat> decode(std::string_view bytes, const std::string& where) {
  const auto header = read_image_header(bytes);
  if (!header) {
    Error error = header.error();
    error.where = where;
    return error;
  }
  if (header->width_px < 1 || header->height_px < 1 ||
      header->width_px > kMaxPixels / header->height_px) {
    return Error::input("the image claims " + std::to_string(header->width_px) + " × " +
                            std::to_string(header->height_px) + " pixels; expected 1 to " +
                            std::to_string(kMaxPixels) + " in all",
                        where);
  }
  const Error damaged = Error::input("the image cannot be decoded: its data are damaged", where,
                                     "copy or save the image again");
  // The decoders behind OpenCV are many, and not all of them take a refusal well. Pixels of 16 bits
  // and four channels, twice, and room for themselves.
  constexpr std::size_t kOwn = std::size_t{32} << 20U;
  require_memory(16 * static_cast<std::size_t>(header->width_px) *
                     static_cast<std::size_t>(header->height_px) +
                 kOwn);
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U,
                      const_cast<char*>(bytes.data()));  // imdecode only reads
    cv::Mat mat = cv::imdecode(raw, cv::IMREAD_UNCHANGED);
    if (mat.empty()) return damaged;
    return mat;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // The decoder's own text names source lines of OpenCV, which help nobody here.
    return damaged;
  }
}

Result<cv::Mat> decode(const std::filesystem::path& path) {
  const auto bytes = read_text_file(path, kMaxFileBytes);
  if (!bytes) return bytes.error();
  return decode(*bytes, path.string());
}

}  // namespace

Result<GrayImage> read_image(std::string_view file, const std::string& where) {
  const auto mat = decode(file, where);
  if (!mat) return mat.error();
  return to_gray(*mat, where);
}

Result<GrayImage> read_image(const std::filesystem::path& path) {
  const auto mat = decode(path);
  if (!mat) return mat.error();
  return to_gray(*mat, path.string());
}

Result<ColorImage> read_color_image(const std::filesystem::path& path) {
  const auto mat = decode(path);
  if (!mat) return mat.error();
  ColorImage image{mat->cols, mat->rows, {}};
  image.rgb.resize(3 * mat->total());
  if (mat->depth() == CV_8U) {
    copy_color<unsigned char>(*mat, 1, image.rgb);
  } else if (mat->depth() == CV_16U) {
    copy_color<unsigned short>(*mat, 257, image.rgb);
  } else {
    return Error::input("the image has neither 8 nor 16 bits per channel", path.string(),
                        "save it as 8 or 16 bit png");
  }
  return image;
}

}  // namespace lvcalib
