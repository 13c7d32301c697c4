// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/missing_pane.h"

#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollBar>
#include <QSplitter>
#include <QTabWidget>
#include <QTest>
#include <QTextBrowser>
#include <QTreeWidget>
#include <algorithm>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::missing_pane_test {
namespace {

TEST(MissingPaneTest, TheTopSuggestionIsChosenAndExplained) {
  MissingPane pane;
  QSignalSpy chosen(&pane, &MissingPane::chosen);
  pane.setRanking(test::model_example().missing, true, false);
  EXPECT_GE(chosen.count(), 1);
  ASSERT_NE(pane.current(), nullptr);
  EXPECT_EQ(pane.current()->finding.id, "range_walk");
  const auto* list = pane.findChild<QTreeWidget*>("proposals");
  EXPECT_EQ(list->topLevelItem(0)->text(0), "Range walk");
  EXPECT_TRUE(list->topLevelItem(0)->text(2).startsWith(QString::fromUtf8("−")));
  EXPECT_TRUE(pane.findChild<QTextBrowser*>("proposal_text")->toPlainText().contains("mm"));
  EXPECT_TRUE(pane.findChild<QLabel*>("missing_verdict")->text().contains("Range walk"));
  QSignalSpy add(&pane, &MissingPane::addWanted);
  pane.findChild<QPushButton*>("add_proposal")->click();
  ASSERT_EQ(add.count(), 1);
  EXPECT_EQ(add.last().at(0).toString(), "range_walk");
}

TEST(MissingPaneTest, ReasonsAreReadWithoutScrollingWhereThereIsRoom) {
  MissingPane pane;
  pane.resize(420, 900);
  pane.setRanking(test::model_example().missing, true, false);
  pane.show();
  QTest::qWait(50);
  const auto* text = pane.findChild<QTextBrowser*>("proposal_text");
  EXPECT_EQ(text->verticalScrollBar()->maximum(), 0);
  const auto* list = pane.findChild<QTreeWidget*>("proposals");
  EXPECT_GE(list->height(), 200);
  // Where there is none, the list stays one to choose from.
  pane.resize(420, 420);
  QTest::qWait(50);
  EXPECT_GT(text->verticalScrollBar()->maximum(), 0);
  EXPECT_GE(list->height(), 60);
  // What the user drags stays.
  auto* parts = pane.findChild<QSplitter*>();
  parts->setSizes({250, 70, 100});
  Q_EMIT parts->splitterMoved(250, 1);
  const QList<int> dragged = parts->sizes();
  pane.setRanking(nullptr, true, false);
  pane.setRanking(test::model_example().missing, true, false);
  QTest::qWait(50);
  EXPECT_EQ(parts->sizes(), dragged);
}

// One cause makes several effects fit better: whoever adds them all has as many wrong ones.
TEST(MissingPaneTest, SeveralSuggestionsAreSaidToStandForOne) {
  ModelRanking ranking = *test::model_example().missing;
  ASSERT_GT(ranking.proposals.size(), 1U);
  const char* const caution = "stand in for it";
  MissingPane pane;
  const auto* verdict = pane.findChild<QLabel*>("missing_verdict");
  for (EffectProposal& p : ranking.proposals) p.suggested = false;
  ranking.proposals[0].suggested = true;
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_FALSE(verdict->text().contains(caution)) << verdict->text().toStdString();
  ranking.proposals[1].suggested = true;
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_TRUE(verdict->text().contains(caution)) << verdict->text().toStdString();
}

TEST(MissingPaneTest, NothingMissingIsSaid) {
  const auto clean = test::make_model_example(false);
  MissingPane pane;
  pane.setRanking(clean.missing, true, false);
  EXPECT_TRUE(pane.findChild<QLabel*>("missing_verdict")->text().contains("Nothing is missing"));
}

// The sentence on top does not contradict what the calibration itself found wrong.
TEST(MissingPaneTest, NothingIsMissingOnlyWhereNothingElseSpeaksAgainstTheResult) {
  MissingPane pane;
  const auto* verdict = pane.findChild<QLabel*>("missing_verdict");
  pane.setRanking(std::make_shared<const ModelRanking>(), true, false);
  EXPECT_TRUE(verdict->text().contains("Nothing is missing"));
  pane.setDoubt(Message("dark returns lie too far: an effect is missing in the model"));
  EXPECT_FALSE(verdict->text().contains("Nothing is missing"));
  EXPECT_TRUE(verdict->text().contains("dark returns lie too far"))
      << verdict->text().toStdString();
  pane.setDoubt({});
  EXPECT_TRUE(verdict->text().contains("Nothing is missing"));
}

TEST(MissingPaneTest, BusyItOffersToCancelOnly) {
  MissingPane pane;
  pane.setRanking(test::model_example().missing, true, true);
  EXPECT_FALSE(pane.findChild<QPushButton*>("add_proposal")->isEnabled());
  EXPECT_FALSE(pane.findChild<QPushButton*>("find_all")->isEnabled());
  QSignalSpy cancel(&pane, &MissingPane::cancelWanted);
  pane.findChild<QPushButton*>("look_missing")->click();
  EXPECT_EQ(cancel.count(), 1);
}

TEST(MissingPaneTest, UnknownStructureOffersACurve) {
  ModelRanking ranking;
  ranking.unknown.push_back({Channel::kRange, "azimuth", 0.21, 3.0});
  MissingPane pane;
  QSignalSpy structure(&pane, &MissingPane::structureChosen);
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_EQ(structure.count(), 1);
  QSignalSpy curve(&pane, &MissingPane::curveWanted);
  pane.findChild<QPushButton*>("add_proposal")->click();
  ASSERT_EQ(curve.count(), 1);
  EXPECT_EQ(curve.last().at(1).toString(), "azimuth");
}

TEST(MissingPaneTest, AClosedFormIsAddedFromWhereItIsTold) {
  const std::string formula = "formula:range:a*sin(25*azimuth) + b";
  ModelRanking ranking;
  ranking.unknown.push_back({Channel::kRange, "azimuth", 0.21, 3.0});
  ranking.unknown.back().formula = formula;
  MissingPane pane;
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  auto* text = pane.findChild<QTextBrowser*>("proposal_text");
  EXPECT_TRUE(text->toPlainText().contains(QString::fromStdString(formula)));
  QSignalSpy add(&pane, &MissingPane::addWanted);
  const QString html = text->toHtml();
  const auto at = html.indexOf("href=\"") + 6;
  Q_EMIT text->anchorClicked(QUrl(html.mid(at, html.indexOf('"', at) - at)));
  ASSERT_EQ(add.count(), 1);
  EXPECT_EQ(add.last().at(0).toString().toStdString(), formula);
}

// A click adds the curve just as it is suggested, and nothing speaks of a command line.
TEST(MissingPaneTest, WhatIsAdvisedIsAddedFromWhereItIsTold) {
  ModelRanking ranking;
  ranking.unknown.push_back({Channel::kRange, "azimuth", 0.21, 3.0});
  ranking.unknown.back().formula = "formula:range:a*sin(25*azimuth) + b";
  ranking.unknown.push_back({Channel::kBoundary, "board x", 0.11, 2.0});
  ranking.unknown.back().second_covariate = "board y";
  MissingPane pane;
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  auto* advice = pane.findChild<QTextBrowser*>("advice");
  EXPECT_FALSE(advice->toPlainText().contains("--")) << advice->toPlainText().toStdString();
  QSignalSpy add(&pane, &MissingPane::addWanted);
  const QString html = advice->toHtml();
  QStringList wanted;
  for (auto at = html.indexOf("href=\""); at >= 0; at = html.indexOf("href=\"", at + 1))
    Q_EMIT advice->anchorClicked(QUrl(html.mid(at + 6, html.indexOf('"', at + 6) - at - 6)));
  for (const auto& one : add) wanted << one.at(0).toString();
  EXPECT_EQ(wanted, QStringList({"curve:range:azimuth", "formula:range:a*sin(25*azimuth) + b",
                                 "curve:boundary:board_x,board_y"}));
}

// As after a fit that was cancelled: it can be taken up again from here.
TEST(MissingPaneTest, WithACalibrationAndNoModelItOffersToLook) {
  MissingPane pane;
  const auto* verdict = pane.findChild<QLabel*>("missing_verdict");
  auto* look = pane.findChild<QPushButton*>("look_missing");
  pane.setRanking(nullptr, false, false);
  EXPECT_EQ(verdict->text(), "Run the calibration first.");
  EXPECT_FALSE(look->isEnabled());
  pane.setCalibrated(true);
  EXPECT_EQ(verdict->text(), "Nobody has looked yet.");
  ASSERT_TRUE(look->isEnabled());
  QSignalSpy wanted(&pane, &MissingPane::lookWanted);
  look->click();
  EXPECT_EQ(wanted.count(), 1);
  // What cannot be fitted says why, and asks for nothing.
  pane.setReason("not enough scenes");
  pane.setRanking(nullptr, false, false);
  EXPECT_EQ(verdict->text(), "not enough scenes");
  EXPECT_FALSE(look->isEnabled());
}

TEST(MissingPaneTest, WhatMattersIsToldFromWhatDoesNot) {
  ModelRanking ranking;
  ranking.unknown.push_back({Channel::kRange, "azimuth", 0.21, 3.0});
  MissingPane pane;
  const auto* verdict = pane.findChild<QLabel*>("missing_verdict");
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_TRUE(verdict->text().contains("Nothing that matters is missing"));
  ranking.unknown.back().matters = true;
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_TRUE(verdict->text().contains("Something is left"));
}

TEST(MissingPaneTest, NextScenesAreListed) {
  ModelRanking ranking;
  MissingPane pane;
  const auto* advice = pane.findChild<QTextBrowser*>("advice");
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_TRUE(advice->toPlainText().contains("No further scene"));
  ranking.advice = {Message("take a scene at 5 m"), Message("repeat the first scene at the end")};
  pane.setRanking(std::make_shared<const ModelRanking>(ranking), true, false);
  EXPECT_TRUE(advice->toPlainText().contains("take a scene at 5 m"));
  EXPECT_TRUE(advice->toPlainText().contains("repeat the first scene"));
}

TEST(MissingPaneTest, WhatCannotBeSeenIsListedByWhatItCouldDo) {
  MissingPane pane;
  pane.setRanking(test::model_example().missing, true, false);
  const auto* budget = pane.findChild<QTreeWidget*>("sensitivity");
  // What is suggested is seen, and listed as missing.
  std::vector<BudgetItem> limits = test::model_example().missing->budget;
  std::erase_if(limits, [](const BudgetItem& limit) {
    const auto& proposals = test::model_example().missing->proposals;
    return std::any_of(proposals.begin(), proposals.end(), [&](const EffectProposal& p) {
      return p.suggested && p.finding.id == limit.id;
    });
  });
  ASSERT_FALSE(limits.empty());
  ASSERT_LT(limits.size(), test::model_example().missing->budget.size());
  EXPECT_EQ(budget->columnCount(), 2);
  ASSERT_EQ(budget->topLevelItemCount(), static_cast<int>(limits.size()));
  EXPECT_TRUE(
      budget->topLevelItem(0)->text(0).contains(QString::fromStdString(limits.front().parameter)));
  // Names in full and no scroll bar, as narrow as the pane is in a small window.
  pane.resize(300, 420);
  pane.show();
  for (auto* tabs : pane.findChildren<QTabWidget*>()) tabs->setCurrentIndex(1);
  QTest::qWait(50);
  EXPECT_FALSE(budget->horizontalScrollBar()->isVisible());
  for (int k = 0; k < budget->topLevelItemCount(); ++k) {
    const QString text = budget->topLevelItem(k)->text(0);
    const QRect shown = budget->visualItemRect(budget->topLevelItem(k));
    const QRect needed = budget->fontMetrics().boundingRect(
        QRect(0, 0, budget->header()->sectionSize(0) - 22, 1000), Qt::TextWordWrap, text);
    EXPECT_GE(shown.height(), needed.height()) << text.toStdString();
  }
  double last = HUGE_VAL;
  for (int k = 0; k < budget->topLevelItemCount(); ++k) {
    EXPECT_FALSE(budget->topLevelItem(k)->text(0).endsWith(" 1")) << "a number has no unit";
    const double mm = budget->topLevelItem(k)->text(1).section(' ', 0, 0).toDouble();
    EXPECT_LE(mm, last + 0.051);
    last = mm;
  }
}

}  // namespace
}  // namespace lvcalib::widgets::missing_pane_test
