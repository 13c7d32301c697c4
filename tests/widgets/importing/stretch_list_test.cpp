// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/stretch_list.h"

#include <QSignalSpy>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lvcalib::widgets::stretch_list_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

ImportedStretch stretch(double first_s, double last_s, bool taken, bool usable,
                        const Message& reason) {
  ImportedStretch out;
  out.first_s = first_s;
  out.last_s = last_s;
  out.taken = taken;
  out.usable = usable;
  out.reason = reason;
  return out;
}

std::vector<ImportedStretch> examples() {
  return {
      stretch(0, 2, true, true, Message("rig and board stand still for 2.0 s")),
      stretch(3, 4, false, true, Message("the same pose as from 0.0 s to 2.0 s, which is kept")),
      stretch(5, 5.5, false, false, Message("stands still for 0.5 s only; 0.8 s are needed")),
      stretch(6, 8, true, true, Message("rig and board stand still for 2.0 s"))};
}

class StretchListTest : public ::testing::Test {
 protected:
  StretchListTest() { list_.setStretches(examples()); }
  StretchList list_;
};

TEST_F(StretchListTest, WhatIsProposedNeedsNoTimes) {
  EXPECT_THAT(list_.taken(), ElementsAre(true, false, false, true));
  EXPECT_THAT(list_.sceneTimes(), IsEmpty());
  EXPECT_EQ(list_.expectedScenes(), 2);
}

TEST_F(StretchListTest, TicksBecomeTimes) {
  QSignalSpy changed(&list_, &StretchList::takenChanged);
  list_.toggle(0);
  EXPECT_EQ(changed.size(), 1);
  EXPECT_THAT(list_.sceneTimes(), ElementsAre(7.0));
  EXPECT_TRUE(list_.describe(0).contains("left out by you"));
  list_.toggle(1);
  EXPECT_THAT(list_.sceneTimes(), ElementsAre(3.5, 7.0));
  EXPECT_TRUE(list_.describe(1).contains("as you decided"));
  list_.toggle(0);
  list_.toggle(1);
  EXPECT_THAT(list_.sceneTimes(), IsEmpty()) << "as proposed again";
}

TEST_F(StretchListTest, WhatCannotBeASceneCannotBeTicked) {
  list_.toggle(2);
  list_.toggle(7);
  EXPECT_THAT(list_.taken(), ElementsAre(true, false, false, true));
  EXPECT_TRUE(list_.describe(2).contains("0.8 s are needed"));
}

TEST_F(StretchListTest, AStretchWithoutTheBoardIsNotCountedAndSaysSo) {
  QImage picture(40, 30, QImage::Format_RGB888);
  picture.fill(Qt::gray);
  list_.setPicture(0, picture, true, {});
  list_.setPicture(3, picture, true, Message("no tags in the image"));
  list_.setPicture(9, picture, true, {});
  EXPECT_EQ(list_.expectedScenes(), 1);
  EXPECT_EQ(list_.topLevelItem(0)->text(3), "seen");
  EXPECT_EQ(list_.topLevelItem(3)->text(3), "not seen");
  EXPECT_TRUE(list_.topLevelItem(3)->text(4).contains("no tags in the image"));
  EXPECT_FALSE(list_.topLevelItem(3)->icon(0).isNull());
  list_.forgetBoards();
  EXPECT_EQ(list_.expectedScenes(), 2);
}

}  // namespace
}  // namespace lvcalib::widgets::stretch_list_test
