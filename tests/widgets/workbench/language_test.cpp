// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/language.h"

#include <QCoreApplication>

#include <gtest/gtest.h>

namespace lvcalib::widgets::language_test {
namespace {

TEST(Language, TheChineseCatalogueIsPartOfTheProgram) {
  const auto run = [] {
    return QCoreApplication::translate("lvcalib::widgets::MainActions", "&Run all");
  };
  EXPECT_EQ(use_language("zh_CN"), "zh_CN");
  EXPECT_EQ(run(), QString::fromUtf8("全部运行(&R)"));
  EXPECT_EQ(use_language("en"), "en");
  EXPECT_EQ(run(), "&Run all");
  EXPECT_EQ(use_language("xx"), "en") << "unknown languages fall back";
  ASSERT_EQ(languages().size(), 2U);
}

TEST(Language, OneIsNotManyInEnglish) {
  const auto opened = [](int scenes) {
    return QCoreApplication::translate("lvcalib::widgets::Workspace", "Opened %1 with %n scenes.",
                                       nullptr, scenes);
  };
  for (const char* code : {"en", "xx"}) {
    EXPECT_EQ(use_language(code), "en");
    EXPECT_EQ(opened(1), "Opened %1 with 1 scene.") << code;
    EXPECT_EQ(opened(2), "Opened %1 with 2 scenes.") << code;
    EXPECT_EQ(opened(0), "Opened %1 with 0 scenes.") << code;
  }
}

}  // namespace
}  // namespace lvcalib::widgets::language_test
