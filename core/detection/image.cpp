// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <string>

#include "base/file_io.h"
#include "base/image_codec.h"
#include "detection/board_view.h"
#include "detection/color_image.h"

namespace lvcalib {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30U;

template <class Sample>
const Sample* row_of(const DecodedImage& image, int row) {
  return reinterpret_cast<const Sample*>(image.bytes.data() +
                                         static_cast<std::size_t>(row) * image.row_bytes());
}

// Luma of ITU-R BT.601. Alpha is ignored: what lies beneath transparent pixels is what the camera
// saw.
template <class Sample>
void copy_gray(const DecodedImage& image, float scale, std::vector<float>& pixels) {
  const int channels = image.channels;
  float* out = pixels.data();
  for (int y = 0; y < image.height_px; ++y) {
    const Sample* in = row_of<Sample>(image, y);
    for (int x = 0; x < image.width_px; ++x, in += channels) {
      const float value = channels < 3 ? static_cast<float>(in[0])
                                       : 0.114F * static_cast<float>(in[2]) +
                                             0.587F * static_cast<float>(in[1]) +
                                             0.299F * static_cast<float>(in[0]);
      *out++ = scale * value;
    }
  }
}

// Red, green, blue in whole grey levels of 0…255.
template <class Sample>
void copy_color(const DecodedImage& image, int divisor, std::vector<std::uint8_t>& rgb) {
  const int channels = image.channels;
  std::uint8_t* out = rgb.data();
  const auto level = [&](Sample value) {
    return static_cast<std::uint8_t>((value + divisor / 2) / divisor);
  };
  for (int y = 0; y < image.height_px; ++y) {
    const Sample* in = row_of<Sample>(image, y);
    for (int x = 0; x < image.width_px; ++x, in += channels, out += 3) {
      out[0] = level(in[0]);
      out[1] = level(in[channels < 3 ? 0 : 1]);
      out[2] = level(in[channels < 3 ? 0 : 2]);
    }
  }
}

Result<DecodedImage> decode(std::string_view bytes, const std::string& where) {
  auto image = decode_image(bytes);
  if (image) return image;
  Error error = image.error();
  error.where = where;
  return error;
}

Result<DecodedImage> decode(const std::filesystem::path& path) {
  const auto bytes = read_text_file(path, kMaxFileBytes);
  if (!bytes) return bytes.error();
  return decode(*bytes, path.string());
}

GrayImage to_gray(const DecodedImage& decoded) {
  GrayImage image{decoded.width_px, decoded.height_px, {}};
  image.pixels.resize(static_cast<std::size_t>(decoded.width_px) *
                      static_cast<std::size_t>(decoded.height_px));
  if (decoded.bits == 8) {
    copy_gray<std::uint8_t>(decoded, 1.0F, image.pixels);
  } else {
    copy_gray<std::uint16_t>(decoded, 1.0F / 257.0F, image.pixels);
  }
  return image;
}

}  // namespace

Result<GrayImage> read_image(std::string_view file, const std::string& where) {
  const auto image = decode(file, where);
  if (!image) return image.error();
  return to_gray(*image);
}

Result<GrayImage> read_image(const std::filesystem::path& path) {
  const auto image = decode(path);
  if (!image) return image.error();
  return to_gray(*image);
}

Result<ColorImage> read_color_image(const std::filesystem::path& path) {
  const auto decoded = decode(path);
  if (!decoded) return decoded.error();
  ColorImage image{decoded->width_px, decoded->height_px, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(decoded->width_px) *
                   static_cast<std::size_t>(decoded->height_px));
  if (decoded->bits == 8) {
    copy_color<std::uint8_t>(*decoded, 1, image.rgb);
  } else {
    copy_color<std::uint16_t>(*decoded, 257, image.rgb);
  }
  return image;
}

}  // namespace lvcalib
