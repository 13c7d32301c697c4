// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/app_settings.h"

#include <QTemporaryDir>

#include <gtest/gtest.h>

namespace lvcalib::widgets::app_settings_test {
namespace {

TEST(AppSettings, AreRememberedInTheirFolder) {
  QTemporaryDir folder;
  {
    AppSettings settings(folder.path());
    EXPECT_TRUE(settings.recent().isEmpty());
    EXPECT_EQ(settings.theme(), Theme::kSystem);
    settings.set_theme(Theme::kDark);
    settings.set_language("zh_CN");
    settings.set_last_folder("/data");
    settings.set_window("geometry", "state");
  }
  const AppSettings again(folder.path());
  EXPECT_EQ(again.theme(), Theme::kDark);
  EXPECT_EQ(again.language(), "zh_CN");
  EXPECT_EQ(again.last_folder(), "/data");
  EXPECT_EQ(again.geometry(), "geometry");
  EXPECT_EQ(again.window_state(), "state");
  EXPECT_TRUE(again.data_folder().startsWith(folder.path()));
}

TEST(AppSettings, RecentHasEachPathOnceLatestFirstAndNotTooMany) {
  QTemporaryDir folder;
  AppSettings settings(folder.path());
  for (int i = 0; i < AppSettings::kMaxRecent + 5; ++i)
    settings.add_recent(QStringLiteral("/d%1").arg(i));
  settings.add_recent("/d8");
  EXPECT_EQ(settings.recent().size(), AppSettings::kMaxRecent);
  EXPECT_EQ(settings.recent().first(), "/d8");
  EXPECT_EQ(settings.recent().count("/d8"), 1);
}

}  // namespace
}  // namespace lvcalib::widgets::app_settings_test
