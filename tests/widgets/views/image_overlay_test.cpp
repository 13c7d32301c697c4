// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_overlay.h"

#include <QGraphicsScene>
#include <QImage>
#include <QPainter>

#include <gtest/gtest.h>

namespace lvcalib::widgets::image_overlay_test {
namespace {

QImage painted(const ImageOverlay& overlay, const OverlayParts& parts,
               const std::vector<QPointF>& highlights = {}) {
  QGraphicsScene scene;
  auto* item = new OverlayItem;
  item->setBounds({0, 0, 200, 200});
  item->setOverlay(overlay);
  item->setParts(parts);
  item->setHighlights(highlights, -1);
  scene.addItem(item);
  QImage image(200, 200, QImage::Format_RGB32);
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

TEST(ImageOverlay, HighlightsAreRings) {
  const QImage image = painted({}, {}, {QPointF(100, 100)});
  EXPECT_GT(qBlue(image.pixel(109, 100)), 150);
  EXPECT_EQ(image.pixel(100, 100), qRgb(0, 0, 0));
}

}  // namespace
}  // namespace lvcalib::widgets::image_overlay_test
