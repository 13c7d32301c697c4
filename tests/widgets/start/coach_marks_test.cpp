// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/coach_marks.h"

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace lvcalib::widgets::coach_marks_test {
namespace {

class Coach : public ::testing::Test {
 protected:
  Coach() : marks_(&window_), target_(&window_), other_(&window_) {
    window_.resize(600, 400);
    target_.setGeometry(20, 20, 100, 30);
    other_.setGeometry(480, 360, 100, 30);
    window_.show();
  }
  QPushButton* button(const char* name) {
    return marks_.findChild<QPushButton*>(QString::fromLatin1(name));
  }
  QWidget window_;
  CoachMarks marks_;
  QPushButton target_, other_;
};

TEST_F(Coach, LeadsFromMarkToMarkBesideItsTargets) {
  QSignalSpy ended(&marks_, &CoachMarks::ended);
  marks_.start(
      {{"Look here", [&] { return &target_; }, {}}, {"and there", [&] { return &other_; }, {}}});
  EXPECT_EQ(marks_.current(), 0);
  EXPECT_TRUE(marks_.isVisible());
  EXPECT_GT(marks_.y(), target_.geometry().bottom());
  button("coach_next")->click();
  EXPECT_EQ(marks_.current(), 1);
  EXPECT_LT(marks_.geometry().bottom(), other_.y()) << "above, where there is room";
  EXPECT_LE(marks_.geometry().right(), window_.width());
  button("coach_next")->click();
  EXPECT_EQ(ended.count(), 1);
  EXPECT_FALSE(marks_.isVisible());
}

TEST_F(Coach, GoesOnWhenTheUserHasDoneIt) {
  bool done = false;
  marks_.start({{"Do it", [&] { return &target_; }, [&] { return done; }},
                {"Well done", [&] { return &target_; }, {}}});
  EXPECT_FALSE(button("coach_next")->isVisible());
  done = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return marks_.current() == 1; }, 5000));
}

TEST_F(Coach, WaitsForTheReaderWhereSomethingIsComputed) {
  bool done = false;
  marks_.start({{"Wait", [&] { return &target_; }, [&] { return done; }, true},
                {"Well done", [&] { return &target_; }, {}}});
  EXPECT_TRUE(button("coach_next")->isVisible());
  EXPECT_FALSE(button("coach_next")->isEnabled());
  done = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return button("coach_next")->isEnabled(); }, 5000));
  EXPECT_EQ(marks_.current(), 0);
  button("coach_next")->click();
  EXPECT_EQ(marks_.current(), 1);
}

// What has been computed is not said to be going on.
TEST_F(Coach, SaysSomethingElseOnceItIsDone) {
  bool done = false;
  const auto text = [&] { return marks_.findChild<QLabel*>()->text(); };
  const CoachMark mark{"Trying", [&] { return &target_; }, [&] { return done; }, true, {}, "Tried"};
  marks_.start({mark, {"Well done", [&] { return &target_; }, {}}});
  EXPECT_EQ(text(), "Trying");
  done = true;
  EXPECT_TRUE(QTest::qWaitFor([&] { return text() == "Tried"; }, 5000));
  marks_.start({mark});
  EXPECT_EQ(text(), "Tried") << "when it is done already";
  button("coach_next")->click();
}

// Done before it could be read: then it does not vanish.
TEST_F(Coach, WaitsForTheReaderWhereItIsDoneAlready) {
  marks_.start({{"Do it", [&] { return &target_; }, [] { return true; }},
                {"Well done", [&] { return &target_; }, {}}});
  EXPECT_TRUE(button("coach_next")->isVisible());
  EXPECT_TRUE(button("coach_next")->isEnabled());
  QTest::qWait(3 * CoachMarks::kLookMs);
  EXPECT_EQ(marks_.current(), 0);
  button("coach_next")->click();
  EXPECT_EQ(marks_.current(), 1);
}

// It lies over nothing that it speaks of, wherever that is.
TEST_F(Coach, StandsBesideAllThatItExplains) {
  window_.resize(1000, 700);
  other_.show();
  const QRect places[][2] = {{{700, 200, 290, 150}, {700, 360, 290, 130}},
                             {{10, 20, 980, 150}, {10, 180, 250, 200}},
                             {{300, 250, 400, 400}, {720, 200, 270, 300}}};
  for (const auto& [target, other] : places) {
    target_.setGeometry(target);
    other_.setGeometry(other);
    marks_.start(
        {{"A sentence that is long enough to need three lines or four in a bubble, and "
          "speaks of two things",
          [&] { return &target_; },
          {},
          false,
          [&] {
            return std::vector<QWidget*>{&other_, nullptr};
          }}});
    EXPECT_TRUE(marks_.isVisible());
    EXPECT_FALSE(marks_.geometry().intersects(target_.geometry())) << target.x();
    EXPECT_FALSE(marks_.geometry().intersects(other_.geometry())) << target.x();
    EXPECT_TRUE(window_.rect().contains(marks_.geometry()));
  }
}

TEST_F(Coach, HidesWhileItsTargetIsNotThereAndEndsWhenAsked) {
  QWidget* there = nullptr;
  marks_.start({{"Wait", [&] { return there; }, {}}, {"More", [&] { return there; }, {}}});
  EXPECT_FALSE(marks_.isVisible());
  there = &target_;
  EXPECT_TRUE(QTest::qWaitFor([&] { return marks_.isVisible(); }, 5000));
  button("coach_close")->click();
  EXPECT_FALSE(marks_.isVisible());
  EXPECT_EQ(marks_.current(), -1);
}

}  // namespace
}  // namespace lvcalib::widgets::coach_marks_test
