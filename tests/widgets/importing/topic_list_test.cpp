// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/topic_list.h"

#include <gtest/gtest.h>

#include "widgets/importing/recorded_walk.h"

namespace lvcalib::widgets::topic_list_test {
namespace {

TEST(TopicList, SaysWhatWasRecordedAndHowOften) {
  TopicList list;
  list.setRecording(nullptr);
  EXPECT_EQ(list.topLevelItemCount(), 0);
  auto recording = Recording::open(test::small_walk().path.toStdString(), {});
  ASSERT_TRUE(recording.ok());
  list.setRecording(std::make_shared<const Recording>(std::move(*recording)));
  ASSERT_EQ(list.topLevelItemCount(), 3);
  const QTreeWidgetItem* images = list.topLevelItem(0);
  EXPECT_EQ(images->text(0), "/camera/image_raw");
  EXPECT_EQ(images->text(1), "sensor_msgs/Image");
  EXPECT_EQ(images->text(2), "84");
  EXPECT_EQ(images->text(3), "10.0 Hz");
  EXPECT_EQ(list.topLevelItem(1)->text(0), "/points");
  EXPECT_EQ(list.topLevelItem(2)->text(0), "/camera/camera_info");
}

}  // namespace
}  // namespace lvcalib::widgets::topic_list_test
