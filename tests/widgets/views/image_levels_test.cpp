// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_levels.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::image_levels_test {
namespace {

QImage ramp16() {
  QImage image(256, 4, QImage::Format_Grayscale16);
  for (int y = 0; y < 4; ++y) {
    auto* line = reinterpret_cast<quint16*>(image.scanLine(y));
    for (int x = 0; x < 256; ++x) line[x] = static_cast<quint16>(257 * x);
  }
  return image;
}

TEST(ImageLevels, FullRangeKeepsTheImage) {
  const QImage out = apply_levels(ramp16(), {});
  for (int x = 0; x < 256; ++x) EXPECT_EQ(qGray(out.pixel(x, 1)), x);
}

TEST(ImageLevels, SpreadsTheRangeBetweenBlackAndWhite) {
  const QImage out = apply_levels(ramp16(), {0.25, 0.5});
  EXPECT_EQ(qGray(out.pixel(10, 0)), 0);
  EXPECT_EQ(qGray(out.pixel(200, 0)), 255);
  EXPECT_NEAR(qGray(out.pixel(96, 0)), 128, 2);
}

TEST(ImageLevels, SixteenBitDetailBecomesVisible) {
  QImage image(2, 1, QImage::Format_Grayscale16);
  auto* line = reinterpret_cast<quint16*>(image.scanLine(0));
  line[0] = 1000;
  line[1] = 1100;  // The same in eight bits.
  const QImage out = apply_levels(image, {1000 / 65535.0, 1100 / 65535.0});
  EXPECT_EQ(qGray(out.pixel(0, 0)), 0);
  EXPECT_EQ(qGray(out.pixel(1, 0)), 255);
}

TEST(ImageLevels, ColourStaysColour) {
  QImage image(1, 1, QImage::Format_RGB32);
  image.setPixel(0, 0, qRgb(100, 50, 0));
  const QRgb out = apply_levels(image, {0.0, 0.5}).pixel(0, 0);
  EXPECT_NEAR(qRed(out), 200, 1);
  EXPECT_NEAR(qGreen(out), 100, 1);
  EXPECT_EQ(qBlue(out), 0);
}

TEST(ImageLevels, AnImageAsItIsTakesNoMemoryOfItsOwn) {
  QImage image(2, 2, QImage::Format_RGB32);
  image.fill(qRgb(100, 50, 0));
  EXPECT_EQ(apply_levels(image, {}).constBits(), image.constBits());
  EXPECT_NE(apply_levels(image, {0.0, 0.5}).constBits(), image.constBits());
}

TEST(ImageLevels, AutomaticLevelsEncloseThePixels) {
  QImage image(100, 100, QImage::Format_Grayscale8);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) image.scanLine(y)[x] = static_cast<uchar>(60 + x % 50);
  }
  const ImageLevels levels = automatic_levels(image);
  EXPECT_NEAR(levels.black, 60 / 255.0, 0.01);
  EXPECT_NEAR(levels.white, 109 / 255.0, 0.01);
  image.fill(7);
  EXPECT_EQ(automatic_levels(image).white, 1.0);  // A flat image has nothing to spread.
  EXPECT_EQ(automatic_levels({}).white, 1.0);
  EXPECT_TRUE(apply_levels({}, {}).isNull());
}

}  // namespace
}  // namespace lvcalib::widgets::image_levels_test
