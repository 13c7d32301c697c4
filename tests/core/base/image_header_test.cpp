// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/image_header.h"

#include <string>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

using namespace std::string_literals;

TEST(ImageHeader, ReadsSizesWithoutDecoding) {
  const auto bmp = read_image_header("BM"s + std::string(12, '\0') + "\x28\0\0\0"s +
                                     "\x80\x07\0\0"s + "\xD0\xFB\xFF\xFF"s + "xxxx");
  ASSERT_TRUE(bmp.ok());
  EXPECT_EQ(bmp->width_px, 1920);
  EXPECT_EQ(bmp->height_px, 1072);  // rows from the top: stored as −1072

  const auto tiff =
      read_image_header("II*\0\x08\0\0\0\x02\0"s + "\0\x01\x03\0\x01\0\0\0\x40\0\0\0"s +
                        "\x01\x01\x04\0\x01\0\0\0\x30\0\0\0"s);
  ASSERT_TRUE(tiff.ok());
  EXPECT_EQ(tiff->width_px, 64);
  EXPECT_EQ(tiff->height_px, 48);

  const auto jpeg =
      read_image_header("\xFF\xD8\xFF\xE0\0\x04zz\xFF\xC0\0\x0B\x08\x01\xE0\x02\x80"s +
                        "\x01\x01\x11\0"s + "\xFF\xD9"s);
  ASSERT_TRUE(jpeg.ok());
  EXPECT_EQ(jpeg->width_px, 640);
  EXPECT_EQ(jpeg->height_px, 480);
}

TEST(ImageHeader, RefusesWhatIsNotWhole) {
  EXPECT_FALSE(read_image_header("").ok());
  EXPECT_FALSE(read_image_header("\xFF\xD8\xFF").ok());
  EXPECT_FALSE(read_image_header("BM").ok());
  EXPECT_FALSE(read_image_header("II*\0\xFF\xFF\xFF\xFF"s).ok());
  EXPECT_FALSE(read_image_header("II*\0\x08\0\0\0\xFF\xFF"s).ok());
  EXPECT_FALSE(read_image_header("\x89PNG\r\n\x1A\n"s + "\xFF\xFF\xFF\xFFIHDR"s).ok());
  EXPECT_FALSE(read_image_header("GIF89a"s).ok());
}

}  // namespace
}  // namespace lvcalib
