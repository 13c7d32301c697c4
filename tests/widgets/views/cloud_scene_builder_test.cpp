// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_scene_builder.h"

#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace lvcalib::widgets::cloud_scene_builder_test {
namespace {

CloudSceneInput input_of(std::size_t points) {
  auto cloud = std::make_shared<Cloud>();
  cloud->points_m.assign(points, Eigen::Vector3f(3, 0, 0));
  cloud->intensity.assign(points, 1.0F);
  CloudSceneInput input;
  input.full = cloud;
  return input;
}

TEST(CloudSceneBuilder, OnlyTheNewestIsDelivered) {
  CloudSceneBuilder builder;
  std::vector<std::size_t> sizes;
  QObject::connect(&builder, &CloudSceneBuilder::ready,
                   [&](const std::shared_ptr<const CloudScene>& s) { sizes.push_back(s->size()); });
  for (const std::size_t n : {400'000, 300'000, 200'000, 17}) builder.request(input_of(n));
  EXPECT_TRUE(builder.busy());
  ASSERT_TRUE(QTest::qWaitFor([&] { return !builder.busy(); }, 10'000));
  EXPECT_EQ(sizes, std::vector<std::size_t>{17});
  builder.request(input_of(5));
  ASSERT_TRUE(QTest::qWaitFor([&] { return !builder.busy(); }, 10'000));
  EXPECT_EQ(sizes.back(), 5U);
}

TEST(CloudSceneBuilder, MayGoInTheMiddleOfTheWork) {
  for (int k = 0; k < 5; ++k) {
    CloudSceneBuilder builder;
    builder.request(input_of(500'000));
    QTest::qWait(2 * k);
  }
  QTest::qWait(50);  // Late events of the dead would be delivered here.
}

}  // namespace
}  // namespace lvcalib::widgets::cloud_scene_builder_test
