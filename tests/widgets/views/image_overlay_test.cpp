// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_overlay.h"

#include <QGraphicsScene>
#include <QImage>
#include <QPainter>

#include <gtest/gtest.h>

namespace lvcalib::widgets::image_overlay_test {
namespace {

QImage painted(const ImageOverlay& overlay, const OverlayParts& parts,
               const std::vector<QPointF>& highlights = {}, int device_pixel_ratio = 1) {
  QGraphicsScene scene;
  auto* item = new OverlayItem;
  item->setBounds({0, 0, 200, 200});
  item->setOverlay(overlay);
  item->setParts(parts);
  item->setHighlights(highlights, -1);
  scene.addItem(item);
  QImage image(QSize(200, 200) * device_pixel_ratio, QImage::Format_RGB32);
  image.setDevicePixelRatio(device_pixel_ratio);
  image.fill(Qt::black);
  QPainter painter(&image);
  scene.render(&painter, {0, 0, 200, 200}, {0, 0, 200, 200});
  return image;
}

TEST(ImageOverlay, PointsTakeTheirColours) {
  ImageOverlay overlay;
  overlay.points = {{50, 50}, {150, 150}};
  overlay.point_colors = {qRgb(255, 0, 0), qRgb(0, 0, 255)};
  const QImage image = painted(overlay, {false, false, false, true});
  const auto strongest = [&](int x, int y) {
    QRgb best = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) best |= image.pixel(x + dx, y + dy);
    }
    return best;
  };
  EXPECT_GT(qRed(strongest(50, 50)), 240);
  EXPECT_LT(qBlue(strongest(50, 50)), 20);
  EXPECT_GT(qBlue(strongest(150, 150)), 240);
}

// On a screen of twice the resolution a dot has twice the pixels across.
TEST(ImageOverlay, DotsAreAsLargeOnAFineScreen) {
  ImageOverlay overlay;
  overlay.points = {{50, 50}};
  overlay.point_colors = {qRgb(255, 0, 0)};
  const auto dots = [&](int ratio) {
    const QImage image = painted(overlay, {false, false, false, true}, {}, ratio);
    int out = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) out += qRed(image.pixel(x, y)) > 120 ? 1 : 0;
    }
    return out;
  };
  EXPECT_GE(dots(2), 3 * dots(1));
}

// The middle of a tag that is not used is hatched, in the colour of who did not want it.
TEST(ImageOverlay, WhatIsNotUsedIsStruckThrough) {
  ImageOverlay overlay;
  overlay.tags.push_back({1, QPolygonF({{50, 150}, {150, 150}, {150, 50}, {50, 50}})});
  const auto count = [&](auto is_color) {
    const QImage image = painted(overlay, {true, false, false, false, false});
    int out = 0;
    for (int y = 60; y < 90; ++y) {
      for (int x = 60; x < 140; ++x) out += is_color(image.pixel(x, y)) ? 1 : 0;
    }
    return out;
  };
  const auto red = [](QRgb c) { return qRed(c) > 150 && qGreen(c) < 90 && qBlue(c) < 110; };
  const auto violet = [](QRgb c) { return qBlue(c) > 180 && qRed(c) > 100; };
  EXPECT_EQ(count(red) + count(violet), 0);
  overlay.tags[0].used = false;
  EXPECT_GT(count(red), 100);
  overlay.tags[0].left_out = true;
  EXPECT_EQ(count(red), 0);
  EXPECT_GT(count(violet), 100);
}

TEST(ImageOverlay, UnusedPointsAreCrosses) {
  ImageOverlay overlay;
  overlay.refused_points = {{50, 50}};
  overlay.left_out_points = {{150, 150}};
  const QImage none = painted(overlay, {false, false, false, false, false});
  const QImage shown = painted(overlay, {false, false, false, false, true});
  EXPECT_EQ(none.pixel(50, 50), qRgb(0, 0, 0));
  EXPECT_GT(qRed(shown.pixel(50, 50)), 100);
  EXPECT_GT(qBlue(shown.pixel(150, 150)), 100);
}

TEST(ImageOverlay, InvalidCirclesAreRed) {
  ImageOverlay overlay;
  QPolygonF edge;
  for (int k = 0; k < 40; ++k) {
    edge.push_back({100 + 40 * std::cos(k * 0.157), 100 + 40 * std::sin(k * 0.157)});
  }
  overlay.circles.push_back({0, edge, {100, 100}, true});
  const QImage valid = painted(overlay, {false, false, true, false});
  overlay.circles[0].valid = false;
  const QImage invalid = painted(overlay, {false, false, true, false});
  EXPECT_GT(qGreen(valid.pixel(100, 100)), 120);
  EXPECT_LT(qGreen(invalid.pixel(100, 100)), 110);
  EXPECT_GT(qRed(invalid.pixel(100, 100)), 200);
}

// A cross says that something is not used; what is used has a dot for its centre.
TEST(ImageOverlay, OnlyWhatIsRefusedIsCrossedOut) {
  ImageOverlay overlay;
  QPolygonF edge;
  for (int k = 0; k < 40; ++k) {
    edge.push_back({100 + 40 * std::cos(k * 0.157), 100 + 40 * std::sin(k * 0.157)});
  }
  overlay.circles.push_back({0, edge, {100, 100}, true});
  // Between the edge and the middle, on the two lines of a cross.
  const auto lit = [&](double from, double to) {
    const QImage image = painted(overlay, {false, false, true, false});
    int out = 0;
    for (int y = 65; y < 136; ++y) {
      for (int x = 65; x < 136; ++x) {
        const double off = std::hypot(x - 100.0, y - 100.0);
        if (off > from && off < to && qRed(image.pixel(x, y)) > 60) ++out;
      }
    }
    return out;
  };
  EXPECT_EQ(lit(4.0, 36.0), 0);
  EXPECT_GT(lit(0.0, 3.0), 10) << "a dot in the middle";
  overlay.circles[0].valid = false;
  EXPECT_GT(lit(4.0, 36.0), 100);
}

TEST(ImageOverlay, HighlightsAreRings) {
  const QImage image = painted({}, {}, {QPointF(100, 100)});
  EXPECT_GT(qBlue(image.pixel(109, 100)), 150);
  EXPECT_EQ(image.pixel(100, 100), qRgb(0, 0, 0));
}

}  // namespace
}  // namespace lvcalib::widgets::image_overlay_test
