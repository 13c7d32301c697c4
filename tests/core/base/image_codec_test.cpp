// SPDX-License-Identifier: GPL-3.0-or-later
// What files of each kind hold; OpenCV's own reading of them is compared beside the detection.
#include "base/image_codec.h"

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

PixelView view_of(const DecodedImage& image) {
  return {image.width_px, image.height_px,    image.channels,
          image.bits,     image.bytes.data(), image.row_bytes()};
}

DecodedImage ramp(int channels, int bits) {
  DecodedImage image{13, 7, channels, bits, {}};
  image.bytes.resize(image.row_bytes() * 7);
  for (std::size_t k = 0; k < image.bytes.size(); ++k)
    image.bytes[k] = static_cast<std::uint8_t>(31 * k + k / 50);
  return image;
}

TEST(ImageCodec, APngComesBackAsItWas) {
  for (const int channels : {1, 2, 3, 4}) {
    for (const int bits : {8, 16}) {
      const DecodedImage image = ramp(channels, bits);
      const auto file = encode_png(view_of(image));
      ASSERT_TRUE(file.ok()) << file.error().text();
      const auto back = decode_image(*file);
      ASSERT_TRUE(back.ok()) << back.error().text();
      EXPECT_EQ(back->width_px, 13);
      EXPECT_EQ(back->height_px, 7);
      EXPECT_EQ(back->channels, channels);
      EXPECT_EQ(back->bits, bits);
      EXPECT_EQ(back->bytes, image.bytes) << channels << " channels of " << bits << " bits";
    }
  }
}

TEST(ImageCodec, AJpegComesBackNearly) {
  DecodedImage image{40, 24, 1, 8, {}};
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 40; ++x) image.bytes.push_back(static_cast<std::uint8_t>(5 * x + 2 * y));
  const auto file = encode_grey_jpeg(view_of(image), 95);
  ASSERT_TRUE(file.ok()) << file.error().text();
  const auto back = decode_image(*file);
  ASSERT_TRUE(back.ok()) << back.error().text();
  ASSERT_EQ(back->bytes.size(), image.bytes.size());
  EXPECT_EQ(back->channels, 1);
  for (std::size_t k = 0; k < image.bytes.size(); ++k)
    EXPECT_NEAR(back->bytes[k], image.bytes[k], 6) << k;
}

// A bitmap of 2 × 2 pixels, byte by byte.
std::string bitmap(int bits, int height, const std::string& palette, const std::string& rows,
                   int compression = 0) {
  const auto number = [](std::size_t value, int bytes) {
    std::string out;
    for (int k = 0; k < bytes; ++k)
      out += static_cast<char>((value >> (8U * static_cast<unsigned>(k))) & 0xFFU);
    return out;
  };
  const std::size_t first = 54 + palette.size();
  return "BM" + number(first + rows.size(), 4) + number(0, 4) + number(first, 4) + number(40, 4) +
         number(2, 4) + number(static_cast<std::size_t>(static_cast<std::uint32_t>(height)), 4) +
         number(1, 2) + number(static_cast<std::size_t>(bits), 2) +
         number(static_cast<std::size_t>(compression), 4) + std::string(20, '\0') + palette + rows;
}

TEST(ImageCodec, BitmapsOfEveryDepth) {
  using Bytes = std::vector<std::uint8_t>;
  const std::string colours("\x01\x02\x03\0\x0A\x0B\x0C\0", 8);
  const std::string greys("\x05\x05\x05\0\xC8\xC8\xC8\0", 8);
  // From the bottom row to the top one, each to a multiple of four bytes.
  const auto one = decode_image(bitmap(1, 2, colours, std::string("\x40\0\0\0\x80\0\0\0", 8)));
  ASSERT_TRUE(one.ok()) << one.error().text();
  EXPECT_EQ(one->bytes, (Bytes{12, 11, 10, 3, 2, 1, 3, 2, 1, 12, 11, 10}));
  const auto grey = decode_image(bitmap(1, 2, greys, std::string("\x40\0\0\0\x80\0\0\0", 8)));
  ASSERT_TRUE(grey.ok()) << grey.error().text();
  EXPECT_EQ(grey->channels, 1);
  EXPECT_EQ(grey->bytes, (Bytes{200, 5, 5, 200}));
  // Rows from the top, where the height is negative.
  const std::string pixels("\x01\x02\x03\x04\x05\x06\0\0\x07\x08\x09\x0A\x0B\x0C\0\0", 16);
  const auto down = decode_image(bitmap(24, -2, "", pixels));
  ASSERT_TRUE(down.ok()) << down.error().text();
  EXPECT_EQ(down->bytes, (Bytes{3, 2, 1, 6, 5, 4, 9, 8, 7, 12, 11, 10}));
  // Five bits each: full red, full blue; half green, none.
  const auto sixteen =
      decode_image(bitmap(16, -2, "", std::string("\x00\x7C\x1F\x00\x00\x02\x00\x00", 8)));
  ASSERT_TRUE(sixteen.ok()) << sixteen.error().text();
  EXPECT_EQ(sixteen->bytes, (Bytes{255, 0, 0, 0, 0, 255, 0, 132, 0, 0, 0, 0}));
}

TEST(ImageCodec, WhatCannotBeReadSaysSo) {
  const std::string rows(64, '\0');
  const auto coded = decode_image(bitmap(8, 2, std::string(1024, '\0'), rows, 1));
  ASSERT_FALSE(coded.ok());
  EXPECT_NE(coded.error().message.text().find("compressed bmp"), std::string::npos);
  EXPECT_FALSE(decode_image(bitmap(24, 2, "", "short")).ok());
  EXPECT_FALSE(decode_image("").ok());
  EXPECT_FALSE(encode_png({}).ok());
  EXPECT_FALSE(encode_grey_jpeg(view_of(ramp(3, 8)), 90).ok());
  // A header that claims more than the data hold.
  std::string claims = bitmap(24, 1'000'000, "", rows);
  const auto large = decode_image(claims);
  ASSERT_FALSE(large.ok());
  EXPECT_EQ(large.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace lvcalib
