// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/residual_figure.h"

#include <QElapsedTimer>

#include <gtest/gtest.h>

#include "base/random.h"
#include "model_example.h"

namespace lvcalib::widgets::residual_figure_test {
namespace {

std::shared_ptr<const ChannelView> range_view() {
  const auto& example = test::model_example();
  return std::make_shared<const ChannelView>(
      make_channel_view(*example.mended, *example.base, Channel::kRange));
}

int painted(const QImage& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) count += qAlpha(image.pixel(x, y)) > 0 ? 1 : 0;
  }
  return count;
}

TEST(ResidualFigureTest, ShowsBeforeAndAfterAlongACovariate) {
  const auto figure = make_residual_figure(range_view(), "range", nullptr, {});
  ASSERT_NE(figure, nullptr);
  EXPECT_GT(painted(figure->density), 1000);
  EXPECT_GT(figure->now.size(), 10U);
  EXPECT_EQ(figure->now.size(), figure->before.size());
  EXPECT_TRUE(figure->predicted.empty());
  EXPECT_NEAR(figure->noise, 8.0, 1e-3);
  EXPECT_TRUE(figure->labels.empty());
  EXPECT_LT(figure->x_low, 1.8);
  EXPECT_GT(figure->x_high, 4.0);
}

TEST(ResidualFigureTest, CategoriesStandSideBySide) {
  const auto figure = make_residual_figure(range_view(), "print", nullptr, {});
  ASSERT_NE(figure, nullptr);
  ASSERT_EQ(figure->labels.size(), 2U);
  EXPECT_EQ(figure->place(0.0), 1.0);
  EXPECT_EQ(figure->place(1.0), 2.0);
  EXPECT_GT(figure->before[1].residual.mean - figure->before[0].residual.mean, 6.0);
}

TEST(ResidualFigureTest, APatternIsGroupedAsTheResidualsAre) {
  const auto& example = test::model_example();
  auto view = std::make_shared<const ChannelView>(
      make_channel_view(*example.base, *example.base, Channel::kRange));
  auto overlay = std::make_shared<Overlay>();
  overlay->pattern =
      effect_pattern(example.base->fitted(), example.mended->terms[0].use, Channel::kRange, true);
  const auto figure = make_residual_figure(view, "darkness", overlay, {});
  ASSERT_NE(figure, nullptr);
  ASSERT_EQ(figure->predicted.size(), figure->now.size());
  EXPECT_NEAR(figure->predicted.back().residual.mean - figure->predicted.front().residual.mean,
              figure->now.back().residual.mean - figure->now.front().residual.mean, 1.0);
}

TEST(ResidualFigureTest, WhatIsNotThereGivesNothing) {
  EXPECT_EQ(make_residual_figure(range_view(), "no such thing", nullptr, {}), nullptr);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(make_residual_figure(range_view(), "range", nullptr, stop.get_token()), nullptr);
}

TEST(ResidualFigureTest, MapsCoverImageBoardAndDirections) {
  const auto& example = test::model_example();
  const ChannelView corners = make_channel_view(*example.base, *example.base, Channel::kCorner);
  EXPECT_FALSE(corners.image.cells.empty());
  EXPECT_GT(corners.image.cells.front().second.n, 0U) << "arrows";
  EXPECT_TRUE(corners.angles.cells.empty());
  const auto range = range_view();
  EXPECT_TRUE(range->image.cells.empty());
  EXPECT_FALSE(range->board.cells.empty());
  EXPECT_FALSE(range->angles.cells.empty());
}

// A million residuals: made in the background, so seconds would be a nuisance and no more.
TEST(ResidualFigureTest, AMillionResidualsAreDrawnInAFractionOfASecond) {
  ChannelView big;
  big.columns.channel = Channel::kRange;
  Covariate x{"range", "m", false, {}};
  Random random(1);
  for (int k = 0; k < 1'000'000; ++k) {
    x.values.push_back(static_cast<float>(random.uniform(1.0, 5.0)));
    big.columns.value.push_back(static_cast<float>(random.normal()));
    big.columns.sigma.push_back(1.0F);
    big.columns.scene.push_back(k % 6);
  }
  big.columns.before = big.columns.value;
  big.columns.covariates.push_back(std::move(x));
  QElapsedTimer clock;
  clock.start();
  const auto figure = make_residual_figure(std::make_shared<const ChannelView>(std::move(big)),
                                           "range", nullptr, {});
  ASSERT_NE(figure, nullptr);
  RecordProperty("milliseconds", static_cast<int>(clock.elapsed()));
  EXPECT_EQ(figure->now.size(), 24U);
}

}  // namespace
}  // namespace lvcalib::widgets::residual_figure_test
