// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/status_line.h"

#include <QApplication>
#include <QLabel>
#include <QProgressBar>

#include <gtest/gtest.h>

#include "style/marks.h"
#include "style/theme.h"

namespace lvcalib::widgets::status_line_test {
namespace {

TEST(StatusLine, ShowsStageFractionAndTextOnlyWhileSomethingRuns) {
  StatusLine line;
  line.show();
  auto* bar = line.findChild<QProgressBar*>("progress");
  EXPECT_FALSE(bar->isVisible());
  line.show_progress("refine", 0.7, "B");
  EXPECT_TRUE(bar->isVisible());
  EXPECT_EQ(bar->value(), 700);
  EXPECT_EQ(line.findChild<QLabel*>("stage")->text(), "Refining");
  EXPECT_EQ(line.text(), "B");
  line.show_idle("done");
  EXPECT_FALSE(bar->isVisible());
  EXPECT_EQ(line.text(), "done");
}

TEST(StatusLine, SaysWhenTheQualityIsOfOlderDecisions) {
  StatusLine line;
  line.show();
  auto* quality = line.findChild<QLabel*>("quality");
  line.show_quality(nullptr, {Missing::kNothing, false});
  EXPECT_FALSE(quality->isVisible());
  auto result = std::make_shared<CalibrationResult>();
  result->quality = Quality::kGood;
  line.show_quality(result, {Missing::kNothing, true});
  EXPECT_EQ(quality->text(), "Base model: good");
  auto modelled = std::make_shared<CalibrationResult>(*result);
  modelled->model = {{"range_walk", {{"a", "mm", 1e-3, 0.01, 0.001}}}};
  modelled->model_scales.darkness_high = 1.0;
  line.show_quality(modelled, {Missing::kNothing, true});
  EXPECT_EQ(quality->text(), "Base model + Range walk: good");
  EXPECT_TRUE(quality->toolTip().contains("taken out: Range walk"));
  line.show_quality(result, {Missing::kNothing, false});
  EXPECT_TRUE(quality->text().contains("out of date"));
}

// Nothing is called good beside a list that says what is missing, nor before there is such a list.
TEST(StatusLine, GoodIsWhatMissesNothing) {
  StatusLine line;
  line.show();
  const auto* quality = line.findChild<QLabel*>("quality");
  const auto* mark = line.findChild<QLabel*>("quality_mark");
  const auto image = [&] { return mark->pixmap(Qt::ReturnByValue).toImage(); };
  const auto wanted = [](Mark m) { return mark_icon(m, qApp->palette()).pixmap(16, 16).toImage(); };
  auto result = std::make_shared<CalibrationResult>();
  result->quality = Quality::kGood;
  line.show_quality(result, {Missing::kSought, true});
  EXPECT_EQ(quality->text(), "Base model: good so far; still looking for what is missing");
  EXPECT_EQ(image(), wanted(Mark::kIdle));
  line.show_quality(result, {Missing::kNotSought, true});
  EXPECT_TRUE(quality->text().contains("nobody has looked")) << quality->text().toStdString();
  EXPECT_EQ(image(), wanted(Mark::kIdle));
  line.show_quality(result, {Missing::kSomething, true});
  EXPECT_EQ(quality->text(), "Base model: doubtful");
  EXPECT_EQ(image(), wanted(Mark::kDoubtful));
  line.show_quality(result, {Missing::kNothing, true});
  EXPECT_EQ(quality->text(), "Base model: good");
  EXPECT_EQ(image(), wanted(Mark::kGood));
  // What is bad already does not wait for more.
  result->quality = Quality::kFailed;
  line.show_quality(result, {Missing::kSought, true});
  EXPECT_EQ(quality->text(), "Base model: failed");
  EXPECT_EQ(image(), wanted(Mark::kBad));
}

// What is drawn next may come before the layout.
TEST(StatusLine, ALongerVerdictIsWholeAtOnce) {
  StatusLine line;
  line.resize(1200, 30);
  line.show();
  auto result = std::make_shared<CalibrationResult>();
  result->quality = Quality::kGood;
  line.show_quality(result, {Missing::kNothing, true});
  QCoreApplication::processEvents();
  auto* quality = line.findChild<QLabel*>("quality");
  const int before = quality->width();
  result->model = {{"range_walk", {{"a", "mm", 1e-3, 0.01, 0.001}}}};
  result->model_scales.darkness_high = 1.0;
  line.show_quality(result, {Missing::kNothing, true});
  EXPECT_GT(quality->sizeHint().width(), before);
  EXPECT_GE(quality->width(), quality->sizeHint().width());
}

TEST(StatusLine, ItsMarkFollowsTheTheme) {
  StatusLine line;
  line.show();
  auto result = std::make_shared<CalibrationResult>();
  result->quality = Quality::kDoubtful;
  line.show_quality(result, {Missing::kNothing, true});
  auto* mark = line.findChild<QLabel*>("quality_mark");
  for (const Theme theme : {Theme::kDark, Theme::kLight}) {
    apply_theme(*qApp, theme);
    QCoreApplication::processEvents();
    const QImage wanted = mark_icon(Mark::kDoubtful, qApp->palette()).pixmap(16, 16).toImage();
    EXPECT_EQ(mark->pixmap(Qt::ReturnByValue).toImage(), wanted);
  }
}

}  // namespace
}  // namespace lvcalib::widgets::status_line_test
