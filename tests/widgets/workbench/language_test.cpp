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

}  // namespace
}  // namespace lvcalib::widgets::language_test
