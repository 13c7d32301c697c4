// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/figure_source.h"

#include <QElapsedTimer>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::figure_source_test {
namespace {

class Source : public ::testing::Test {
 protected:
  Source() {
    QObject::connect(&source_, &FigureSource::figureReady, &source_, [this](const auto& f) {
      figure_ = f;
      ++figures_;
    });
    QObject::connect(&source_, &FigureSource::patternReady, &source_, [this](const auto& f) {
      pattern_ = f;
      ++patterns_;
    });
    QObject::connect(&source_, &FigureSource::boardReady, &source_,
                     [this](const auto& b) { board_ = b; });
    source_.setSteps(test::model_example().base, test::model_example().base);
  }
  FigureSource source_;
  std::shared_ptr<const ResidualFigure> figure_, pattern_;
  std::shared_ptr<const BoardIntensity> board_;
  int figures_ = 0, patterns_ = 0;
};

TEST_F(Source, MakesFiguresOffTheInterfaceThread) {
  source_.request(Channel::kRange, "darkness", std::nullopt);
  ASSERT_TRUE(QTest::qWaitFor([&] { return figures_ == 1; }, 30'000));
  // From now on the residuals are there: another covariate is a matter of milliseconds.
  QElapsedTimer clock;
  clock.start();
  source_.request(Channel::kRange, "range", std::nullopt);
  ASSERT_TRUE(QTest::qWaitFor([&] { return figures_ == 2; }, 30'000));
  RecordProperty("switch_milliseconds", static_cast<int>(clock.elapsed()));
  EXPECT_EQ(figure_->along().name, "range");
}

TEST_F(Source, OnlyTheNewestRequestIsAnswered) {
  source_.request(Channel::kRange, "darkness", std::nullopt);
  source_.request(Channel::kRange, "azimuth", std::nullopt);
  source_.request(Channel::kCorner, "image x", std::nullopt);
  ASSERT_TRUE(QTest::qWaitFor([&] { return figures_ >= 1; }, 30'000));
  QTest::qWait(200);
  EXPECT_EQ(figures_, 1);
  EXPECT_EQ(figure_->along().name, "image x");
}

TEST_F(Source, APatternIsShownWhereItTellsMost) {
  source_.requestPattern(test::model_example().mended->terms[0].use);
  ASSERT_TRUE(QTest::qWaitFor([&] { return patterns_ == 1; }, 30'000));
  ASSERT_NE(pattern_, nullptr);
  EXPECT_EQ(pattern_->view->columns.channel, Channel::kRange);
  EXPECT_TRUE(pattern_->along().name == "darkness" || pattern_->along().name == "print" ||
              pattern_->along().name == "intensity")
      << pattern_->along().name;
  EXPECT_FALSE(pattern_->predicted.empty());
}

TEST_F(Source, MakesTheBoardsIntensity) {
  source_.requestBoard(-1);
  ASSERT_TRUE(QTest::qWaitFor([&] { return board_ != nullptr; }, 30'000));
  EXPECT_FALSE(board_->measured.empty());
}

TEST_F(Source, WithoutAStepNothingIsAnswered) {
  source_.setSteps(nullptr, nullptr);
  source_.request(Channel::kRange, "range", std::nullopt);
  source_.requestBoard(0);
  QTest::qWait(100);
  EXPECT_EQ(figures_, 0);
  EXPECT_EQ(board_, nullptr);
}

}  // namespace
}  // namespace lvcalib::widgets::figure_source_test
