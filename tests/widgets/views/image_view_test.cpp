// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_view.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include "support/timing.h"
#include "widgets/views/plots_test.h"

namespace lvcalib::widgets::image_view_test {
namespace {

ImageOverlay example() {
  ImageOverlay overlay;
  overlay.tags.push_back({7, QPolygonF({{100, 100}, {200, 100}, {200, 200}, {100, 200}}), true});
  ImageOverlay::Corner corner;
  corner.feature_id = 7;
  corner.detected = {200, 100};
  corner.predicted = {199, 100};
  corner.has_prediction = true;
  overlay.corners.push_back(corner);
  return overlay;
}

class ImageViewTest : public ::testing::Test {
 protected:
  void SetUp() override {
    QImage image(640, 480, QImage::Format_Grayscale8);
    image.fill(90);
    image.setPixel(300, 250, qRgb(0, 0, 0));
    image.scanLine(250)[300] = 33;
    view_.resize(640, 500);
    view_.show();
    view_.setImage(image);
  }
  [[nodiscard]] QPoint at(double x, double y) const { return view_.mapFromScene(QPointF(x, y)); }
  ImageView view_;
};

TEST_F(ImageViewTest, FitsAndZoomsAboutTheCursor) {
  const QRectF seen = view_.mapToScene(view_.viewport()->rect()).boundingRect();
  EXPECT_TRUE(seen.contains(QRectF(0, 0, 639, 479)));
  const QPoint cursor(200, 150);
  const QPointF before = view_.mapToScene(cursor);
  for (int k = 0; k < 6; ++k) {
    QWheelEvent wheel(cursor, view_.viewport()->mapToGlobal(cursor), {}, QPoint(0, 120),
                      Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(view_.viewport(), &wheel);
  }
  EXPECT_GT(view_.zoom(), 2.0);
  const QPointF after = view_.mapToScene(cursor);
  EXPECT_NEAR(after.x(), before.x(), 1.0);
  EXPECT_NEAR(after.y(), before.y(), 1.0);
  QTest::keyClick(&view_, Qt::Key_1);
  EXPECT_NEAR(view_.zoom(), 1.0, 1e-9);
  QTest::keyClick(&view_, Qt::Key_F);
  EXPECT_LT(view_.zoom(), 1.05);
}

TEST_F(ImageViewTest, AClickNamesPixelOrTag) {
  view_.overlay().setOverlay(example());
  QSignalSpy pixel(&view_, &ImageView::pixelClicked);
  QSignalSpy tag(&view_, &ImageView::tagClicked);
  QTest::mouseClick(view_.viewport(), Qt::LeftButton, {}, at(400, 300));
  ASSERT_EQ(pixel.size(), 1);
  EXPECT_NEAR(pixel[0][0].toPointF().x(), 400, 1.0);
  EXPECT_NEAR(pixel[0][0].toPointF().y(), 300, 1.0);
  QTest::mouseClick(view_.viewport(), Qt::LeftButton, {}, at(150, 150));
  ASSERT_EQ(tag.size(), 1);
  EXPECT_EQ(tag[0][0].toInt(), 7);
  EXPECT_EQ(pixel.size(), 1);
}

// The centre of the top-left pixel is (0, 0): the dark pixel's centre has whole coordinates.
TEST_F(ImageViewTest, CoordinatesAreThoseOfPixelCentres) {
  view_.zoomAt(at(300, 250), 20.0);
  QSignalSpy hovered(&view_, &ImageView::hovered);
  for (const double off : {-0.4, 0.4}) {
    QTest::mouseMove(view_.viewport(), at(300 + off, 250 + off));
    QTest::qWait(10);
  }
  ASSERT_GE(hovered.size(), 1);
  EXPECT_EQ(hovered.back()[1].toInt(), 33);
}

TEST_F(ImageViewTest, PartsCanBeSwitchedOff) {
  const QColor tag_color(40, 200, 80);
  view_.overlay().setOverlay(example());
  view_.overlay().setParts({true, false, false, false});
  EXPECT_TRUE(test::shows(*view_.viewport(), tag_color));
  view_.overlay().setParts({false, false, false, false});
  EXPECT_FALSE(test::shows(*view_.viewport(), tag_color));
  // The arrow is one pixel times fifty: it reaches far beyond the corner.
  view_.overlay().setParts({false, true, false, false});
  QImage shot = view_.viewport()->grab().toImage();
  const QPoint middle = at(199 + 25, 100);
  EXPECT_GT(qRed(shot.pixel(middle)), 150);
  EXPECT_LT(qGreen(shot.pixel(middle)), 120);
  view_.overlay().setResidualFactor(5.0);
  shot = view_.viewport()->grab().toImage();
  EXPECT_NEAR(qRed(shot.pixel(middle)), 90, 1);
}

TEST_F(ImageViewTest, LevelsChangeWhatIsShown) {
  view_.setLevels({0.0, 90.0 / 255.0});
  const QImage shot = view_.viewport()->grab().toImage();
  EXPECT_GT(qGray(shot.pixel(at(500, 400))), 250);
}

TEST_F(ImageViewTest, SavesPictureAndCorners) {
  view_.overlay().setOverlay(example());
  const QTemporaryDir folder;
  EXPECT_TRUE(view_.figureActions()->save(folder.filePath("i.png")));
  EXPECT_TRUE(view_.figureActions()->save(folder.filePath("i.pdf")));
  ASSERT_TRUE(view_.figureActions()->save(folder.filePath("i.csv")));
  QFile file(folder.filePath("i.csv"));
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  EXPECT_TRUE(file.readAll().contains("7,0,200,100,199,100,1"));
  view_.setImage({});
  EXPECT_FALSE(view_.figureActions()->save(folder.filePath("none.png")));
}

TEST(ImageViewSpeed, ManyPointsPaintFast) {
  ImageView view;
  view.resize(900, 700);
  view.setImage(QImage(1920, 1200, QImage::Format_Grayscale8));
  ImageOverlay overlay;
  for (int k = 0; k < 200'000; ++k) {
    overlay.points.emplace_back(k % 1920, (k * 7) % 1200);
    overlay.point_colors.push_back(qRgb(k % 255, (k / 3) % 255, 100));
  }
  view.overlay().setOverlay(overlay);
  view.overlay().setParts({true, true, true, true});
  view.show();
  view.grab();
  QElapsedTimer clock;
  clock.start();
  view.grab();
  const auto elapsed = clock.elapsed();
  RecordProperty("paint_ms", static_cast<int>(elapsed));
  EXPECT_LT(elapsed, ::lvcalib::test::time_limit(1000));
}

}  // namespace
}  // namespace lvcalib::widgets::image_view_test
