// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/where_pane.h"

#include <QComboBox>
#include <QStyleOptionComboBox>
#include <QTabWidget>
#include <QToolButton>

#include <gtest/gtest.h>

#include "model_example.h"
#include "modelling/residual_map_plot.h"
#include "modelling/residual_plot.h"

namespace lvcalib::widgets::where_pane_test {
namespace {

class Where : public ::testing::Test {
 protected:
  Where() : pane_(source_), plot_(pane_.findChild<ResidualPlot*>("residual_plot")) {
    pane_.resize(700, 500);
    pane_.show();
    source_.setSteps(test::model_example().base, test::model_example().base);
    pane_.setStep(test::model_example().base, {});
    QObject::connect(&pane_, &WherePane::selected, &pane_,
                     [this](const std::vector<SelectedSample>& s) { samples_ = s; });
  }
  bool wait_for(const char* covariate) {
    return QTest::qWaitFor(
        [&] { return plot_->figure() && plot_->figure()->along().name == covariate; }, 30'000);
  }
  FigureSource source_;
  WherePane pane_;
  ResidualPlot* plot_;
  std::vector<SelectedSample> samples_;
};

TEST_F(Where, BeginsWhereTheStructureIsStrongest) {
  EXPECT_EQ(pane_.channel(), Channel::kRange);
  EXPECT_TRUE(wait_for(pane_.covariate().toUtf8().constData()));
  const auto* covariates = pane_.findChild<QComboBox*>("covariate");
  EXPECT_TRUE(covariates->itemText(0).contains('%'));
  EXPECT_GT(covariates->count(), 10);
}

// At the width that a window of 1280 pixels leaves the pane, and at half of it.
TEST_F(Where, WhatIsChosenIsReadInFull) {
  for (const int width : {417, 330}) {
    pane_.resize(width, 400);
    QCoreApplication::processEvents();
    for (const char* name : {"channel", "covariate"}) {
      const auto* box = pane_.findChild<QComboBox*>(QString::fromLatin1(name));
      for (int k = 0; k < box->count(); ++k) {
        QStyleOptionComboBox option;
        option.initFrom(box);
        const int room =
            box->style()
                ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, box)
                .width();
        EXPECT_GE(room, box->fontMetrics().horizontalAdvance(box->itemText(k)))
            << box->itemText(k).toStdString() << " in " << width;
      }
      const QRect place(box->mapTo(&pane_, QPoint(0, 0)), box->size());
      EXPECT_TRUE(pane_.rect().contains(place)) << name << " in " << width;
    }
  }
}

TEST_F(Where, AnotherChannelHasItsOwnCovariates) {
  auto* channels = pane_.findChild<QComboBox*>("channel");
  channels->setCurrentIndex(channels->findData(static_cast<int>(Channel::kCorner)));
  EXPECT_GE(pane_.findChild<QComboBox*>("covariate")->findData("image x"), 0);
  EXPECT_TRUE(wait_for(pane_.covariate().toUtf8().constData()));
  pane_.look(Channel::kRange, "azimuth");
  EXPECT_EQ(pane_.covariate(), "azimuth");
  EXPECT_TRUE(wait_for("azimuth"));
}

TEST_F(Where, WhatTheUserChoseIsTold) {
  int turned = 0;
  QObject::connect(&pane_, &WherePane::turned, &pane_, [&] { ++turned; });
  pane_.look(Channel::kCorner, "image x");
  pane_.look(Channel::kRange, "azimuth");
  EXPECT_EQ(turned, 0) << "nobody chose that";
  auto* covariates = pane_.findChild<QComboBox*>("covariate");
  covariates->setCurrentIndex(covariates->findData("range"));
  EXPECT_EQ(turned, 1);
  auto* channels = pane_.findChild<QComboBox*>("channel");
  channels->setCurrentIndex(channels->findData(static_cast<int>(Channel::kCorner)));
  EXPECT_EQ(turned, 2);
}

TEST_F(Where, BrushingSelectsTheSameMeasurementsEverywhere) {
  pane_.look(Channel::kRange, "range");
  ASSERT_TRUE(wait_for("range"));
  pane_.findChild<QToolButton*>("brush")->click();
  Q_EMIT plot_->brushed(QRectF(QPointF(0.0, -100.0), QPointF(2.2, 100.0)));
  ASSERT_FALSE(samples_.empty());
  for (const SelectedSample& s : samples_) {
    ASSERT_TRUE(s.point_in_lidar_m);
    EXPECT_LT(s.point_in_lidar_m->norm(), 2.3);
  }
  pane_.findChild<QToolButton*>("brush")->click();
  EXPECT_TRUE(samples_.empty()) << "off again";
}

TEST_F(Where, WhatIsSelectedCanBeLeftOut) {
  pane_.look(Channel::kRange, "range");
  ASSERT_TRUE(wait_for("range"));
  auto* exclude = pane_.findChild<QToolButton*>("where-exclude");
  std::size_t left_out = 0;
  QObject::connect(&pane_, &WherePane::excludeWanted, &pane_, [&] { left_out = samples_.size(); });
  EXPECT_TRUE(exclude->isHidden()) << "nothing is selected";
  pane_.findChild<QToolButton*>("brush")->click();
  Q_EMIT plot_->brushed(QRectF(QPointF(0.0, -100.0), QPointF(2.2, 100.0)));
  ASSERT_FALSE(exclude->isHidden());
  exclude->click();
  EXPECT_GT(left_out, 0U);
  EXPECT_TRUE(samples_.empty()) << "it is decided";
  EXPECT_TRUE(exclude->isHidden());
}

// Its rows are those of another table.
TEST_F(Where, WhatAnotherStepShowsCannotBeSelected) {
  pane_.look(Channel::kRange, "range");
  ASSERT_TRUE(wait_for("range"));
  const auto brush = [&] { Q_EMIT plot_->brushed(QRectF(QPointF(0, -100), QPointF(2.2, 100))); };
  brush();
  ASSERT_FALSE(samples_.empty());
  const auto before = plot_->figure();
  source_.setSteps(test::model_example().mended, test::model_example().base);
  pane_.setStep(test::model_example().mended, {});
  EXPECT_TRUE(samples_.empty()) << "of the step before";
  brush();
  EXPECT_TRUE(samples_.empty());
  ASSERT_TRUE(QTest::qWaitFor([&] { return plot_->figure() != before; }, 30'000));
  brush();
  EXPECT_FALSE(samples_.empty());
}

TEST_F(Where, BrushingKeepsUpWithTheHand) {
  pane_.look(Channel::kRange, "range");
  ASSERT_TRUE(wait_for("range"));
  QElapsedTimer clock;
  clock.start();
  constexpr int kMoves = 20;
  for (int k = 1; k <= kMoves; ++k) {
    Q_EMIT plot_->brushed(QRectF(QPointF(0.0, -100.0), QPointF(1.5 + 0.1 * k, 100.0)));
    QCoreApplication::processEvents();
  }
  RecordProperty("milliseconds_per_move", static_cast<int>(clock.elapsed() / kMoves));
}

TEST_F(Where, TheBoardsIntensityIsDrawnWhenItIsLookedAt) {
  auto* tabs = pane_.findChild<QTabWidget*>("where_tabs");
  bool ready = false;
  QObject::connect(&source_, &FigureSource::boardReady, &pane_, [&] { ready = true; });
  QTest::qWait(50);
  EXPECT_FALSE(ready);
  tabs->setCurrentIndex(4);
  EXPECT_TRUE(QTest::qWaitFor([&] { return ready; }, 30'000));
  EXPECT_EQ(pane_.findChild<QComboBox*>("board_scene")->count(), 7);
}

QString message_of(const QCustomPlot& plot) {
  for (int k = 0; k < plot.itemCount(); ++k) {
    if (const auto* text = qobject_cast<QCPItemText*>(plot.item(k))) return text->text();
  }
  return {};
}

// Neither the residuals of the channel before nor that there are none.
TEST_F(Where, AnotherChannelIsAwaited) {
  ASSERT_TRUE(wait_for(pane_.covariate().toUtf8().constData()));
  const auto* image = pane_.findChild<QTabWidget*>("where_tabs")->widget(1);
  const auto* map = qobject_cast<const ResidualMapPlot*>(image);
  ASSERT_NE(map, nullptr);
  EXPECT_TRUE(message_of(*map).contains("only corners")) << message_of(*map).toStdString();
  auto* channels = pane_.findChild<QComboBox*>("channel");
  channels->setCurrentIndex(channels->findData(static_cast<int>(Channel::kCorner)));
  EXPECT_EQ(plot_->figure(), nullptr);
  EXPECT_TRUE(message_of(*plot_).contains("being collected"));
  EXPECT_TRUE(message_of(*map).contains("being collected")) << message_of(*map).toStdString();
  EXPECT_TRUE(wait_for(pane_.covariate().toUtf8().constData()));
  EXPECT_TRUE(message_of(*map).contains("longest arrow")) << message_of(*map).toStdString();
}

TEST_F(Where, WithoutAModelItSaysWhy) {
  source_.setSteps(nullptr, nullptr);
  pane_.setStep(nullptr, "run first");
  EXPECT_EQ(plot_->figure(), nullptr);
  EXPECT_EQ(message_of(*plot_), "run first");
  EXPECT_FALSE(pane_.findChild<QComboBox*>("channel")->isEnabled());
}

}  // namespace
}  // namespace lvcalib::widgets::where_pane_test
