// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/log_dock.h"

#include <gtest/gtest.h>

namespace lvcalib::widgets::log_dock_test {
namespace {

TEST(LogDock, KeepsTheLatestLines) {
  LogDock dock;
  dock.append("first");
  for (int i = 0; i < LogDock::kMaxLines; ++i) dock.append(QString::number(i));
  const QStringList lines = dock.text().split('\n');
  EXPECT_EQ(lines.size(), LogDock::kMaxLines);
  EXPECT_TRUE(lines.last().endsWith(QString::number(LogDock::kMaxLines - 1)));
  EXPECT_FALSE(dock.text().contains("first"));
}

}  // namespace
}  // namespace lvcalib::widgets::log_dock_test
