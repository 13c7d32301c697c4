// SPDX-License-Identifier: BSD-3-Clause
#include "base/image_header.h"

#include <cstdint>
#include <cstdlib>

#include <zlib.h>

namespace lvcalib {
namespace {

// Reads unsigned integers of either byte order; out of range gives zero, which every caller
// refuses as a size or an offset.
class Bytes {
 public:
  Bytes(std::string_view data, bool big_endian) : data_(data), big_endian_(big_endian) {}
  [[nodiscard]] std::size_t size() const { return data_.size(); }
  [[nodiscard]] std::uint32_t u8(std::size_t at) const {
    return at < data_.size() ? static_cast<unsigned char>(data_[at]) : 0U;
  }
  [[nodiscard]] std::uint32_t u16(std::size_t at) const {
    return big_endian_ ? u8(at) << 8U | u8(at + 1) : u8(at + 1) << 8U | u8(at);
  }
  [[nodiscard]] std::uint32_t u32(std::size_t at) const {
    return big_endian_ ? u16(at) << 16U | u16(at + 2) : u16(at + 2) << 16U | u16(at);
  }

 private:
  std::string_view data_;
  bool big_endian_;
};

Error truncated(const char* format) {
  return Error::input(Message("the %1 file ends early or is damaged", format), {},
                      Message("copy or save the image again"));
}

Result<ImageHeader> read_png(std::string_view data) {
  const Bytes bytes(data, true);
  ImageHeader header;
  std::size_t at = 8;
  while (at + 12 <= data.size()) {
    const std::size_t length = bytes.u32(at);
    if (length > data.size() - at - 12) return truncated("png");
    const std::string_view type = data.substr(at + 4, 4);
    const auto* const checked = reinterpret_cast<const Bytef*>(data.data() + at + 4);
    if (crc32(0, checked, static_cast<uInt>(length + 4)) != bytes.u32(at + 8 + length))
      return truncated("png");
    if (type == "IHDR") header = {bytes.u32(at + 8), bytes.u32(at + 12)};
    if (type == "IEND") return header;
    at += length + 12;
  }
  return truncated("png");
}

// Walks the marker segments up to the frame header (SOF0 … SOF15 but for DHT, JPG, DAC).
Result<ImageHeader> read_jpeg(std::string_view data) {
  if (data.rfind("\xFF\xD9") == std::string_view::npos) return truncated("jpg");
  const Bytes bytes(data, true);
  std::size_t at = 2;
  while (at + 9 < data.size()) {
    if (bytes.u8(at) != 0xFF) return truncated("jpg");
    const std::uint32_t marker = bytes.u8(at + 1);
    if (marker == 0xFF) {  // fill byte
      ++at;
      continue;
    }
    const bool frame =
        marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    if (frame) return ImageHeader{bytes.u16(at + 7), bytes.u16(at + 5)};
    if (marker == 0xDA || marker == 0xD9) break;
    const bool bare = marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
    at += 2 + (bare ? 0 : bytes.u16(at + 2));
  }
  return truncated("jpg");
}

Result<ImageHeader> read_bmp(std::string_view data) {
  const Bytes bytes(data, false);
  if (data.size() < 26) return truncated("bmp");
  if (bytes.u32(14) == 12) return ImageHeader{bytes.u16(18), bytes.u16(20)};
  // A negative height marks rows stored from the top.
  return ImageHeader{static_cast<std::int32_t>(bytes.u32(18)),
                     std::llabs(static_cast<std::int32_t>(bytes.u32(22)))};
}

Result<ImageHeader> read_tiff(std::string_view data) {
  const Bytes bytes(data, data.front() == 'M');
  const std::size_t directory = bytes.u32(4);
  if (directory < 8 || directory + 2 > data.size()) return truncated("tiff");
  const std::size_t entries = bytes.u16(directory);
  if (directory + 2 + 12 * entries > data.size()) return truncated("tiff");
  ImageHeader header;
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t at = directory + 2 + 12 * i;
    const std::uint32_t value = bytes.u16(at + 2) == 3 ? bytes.u16(at + 8) : bytes.u32(at + 8);
    if (bytes.u16(at) == 256) header.width_px = value;
    if (bytes.u16(at) == 257) header.height_px = value;
  }
  return header;
}

}  // namespace

Result<ImageHeader> read_image_header(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.empty()) return Error::input(Message("the image file is empty"));
  if (bytes.starts_with("\x89PNG\r\n\x1A\n"sv)) return read_png(bytes);
  if (bytes.starts_with("\xFF\xD8\xFF"sv)) return read_jpeg(bytes);
  if (bytes.starts_with("BM"sv)) return read_bmp(bytes);
  if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return read_tiff(bytes);
  return Error::input(Message("not an image that can be read; expected png, jpg, bmp or tiff"));
}

}  // namespace lvcalib
