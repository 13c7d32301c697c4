// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/board_intensity_view.h"

#include <QSet>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::board_intensity_view_test {
namespace {

int colours(QWidget& widget) {
  const QImage image = widget.grab().toImage();
  QSet<QRgb> seen;
  for (int y = 0; y < image.height(); y += 3) {
    for (int x = 0; x < image.width(); x += 3) seen.insert(image.pixel(x, y));
  }
  return static_cast<int>(seen.size());
}

TEST(BoardIntensityViewTest, ShowsMeasuredPredictedAndDifference) {
  BoardIntensityView view;
  view.resize(600, 240);
  view.setImages(nullptr, "nothing yet");
  const int empty = colours(view);
  view.setImages(std::make_shared<const BoardIntensity>(
      board_intensity(test::model_example().base->fitted(), -1)));
  EXPECT_GT(colours(view), empty);
}

TEST(BoardIntensityViewTest, FlickersBetweenMeasuredAndPredicted) {
  BoardIntensityView view;
  view.resize(400, 240);
  view.setImages(std::make_shared<const BoardIntensity>(
      board_intensity(test::model_example().base->fitted(), 0)));
  view.show();
  EXPECT_FALSE(view.showsPrediction());
  view.setFlicker(true);
  EXPECT_TRUE(QTest::qWaitFor([&] { return view.showsPrediction(); }, 5000));
  view.setFlicker(false);
  EXPECT_FALSE(view.showsPrediction());
}

}  // namespace
}  // namespace lvcalib::widgets::board_intensity_view_test
