// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/demo.h"

#include <QTemporaryDir>
#include <filesystem>

#include <gtest/gtest.h>

#include "pipeline/dataset.h"

namespace lvcalib::widgets::demo_test {
namespace {

TEST(Demo, MakesADatasetAndReplacesAnEarlierOne) {
  QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("data/demo").toStdString();
  auto options = demo_options();
  EXPECT_TRUE(check(options).ok());
  options.lidar.points = 5000;
  options.image.width_px = 320;
  options.image.height_px = 240;
  for (const int scenes : {1, 2}) {
    options.scenes = scenes;
    double last = -1.0;
    RunContext context;
    context.progress = [&](const Progress& p) {
      EXPECT_EQ(p.stage, "simulate");
      last = p.fraction;
    };
    const Status made = make_demo(path, options, context);
    ASSERT_TRUE(made.ok()) << made.error().text();
    EXPECT_EQ(last, 1.0);
    const auto dataset = open_dataset(path);
    ASSERT_TRUE(dataset.ok()) << dataset.error().text();
    EXPECT_EQ(dataset->scenes.size(), static_cast<std::size_t>(scenes));
  }
}

TEST(Demo, AStopLeavesNothingBehind) {
  QTemporaryDir folder;
  const std::filesystem::path path = folder.filePath("demo").toStdString();
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  context.progress = [&](const Progress& p) {
    if (p.fraction > 0.0) stop.request_stop();
  };
  auto options = demo_options();
  options.lidar.points = 5000;
  const Status made = make_demo(path, options, context);
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().kind, ErrorKind::kCancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path().toStdString()));
}

}  // namespace
}  // namespace lvcalib::widgets::demo_test
