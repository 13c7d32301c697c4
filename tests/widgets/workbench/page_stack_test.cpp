// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/page_stack.h"

#include <QAction>
#include <QTabWidget>
#include <QTest>

#include <gtest/gtest.h>

#include "pages/scene_page.h"
#include "start/welcome_page.h"

namespace lvcalib::widgets::page_stack_test {
namespace {

TEST(PageStack, ShowsTheWelcomePageFirstAndATabPerPage) {
  PageStack stack;
  stack.show();
  EXPECT_TRUE(stack.welcome().isVisible());
  stack.show_pages();
  EXPECT_FALSE(stack.welcome().isVisible());
  const auto* tabs = stack.findChild<QTabWidget*>("pages");
  ASSERT_EQ(stack.tab_count(), 4);
  for (int tab = 0; tab < 4; ++tab) {
    stack.show_tab(tab);
    EXPECT_EQ(tabs->currentIndex(), tab);
    EXPECT_FALSE(tabs->tabText(tab).isEmpty());
  }
}

TEST(PageStack, ABoxBeingEditedStaysUntilAnotherIsInForce) {
  PageStack stack;
  stack.show();
  stack.show_pages();
  stack.set_scene(0, std::nullopt);
  auto* crop = stack.findChild<QAction*>("crop-action");
  ASSERT_NE(crop, nullptr);
  crop->setChecked(true);
  stack.set_crop_box(std::nullopt);
  EXPECT_TRUE(crop->isChecked());
  CropBox box;
  box.center_m = {1, 2, 3};
  stack.set_crop_box(box);
  stack.set_crop_box(std::nullopt);
  EXPECT_FALSE(crop->isChecked());
}

TEST(PageStack, LiveRefinementsOfAnyKindAreTakenWithoutHarm) {
  PageStack stack;
  stack.show();
  stack.show_pages();
  stack.show_tab(1);
  stack.start(Dataset{});
  stack.set_scene(0, std::nullopt);
  stack.show_board_points(0, std::make_shared<const Cloud>());
  for (const int scene : {0, 1, -1})
    stack.show_iteration(scene, std::make_shared<const BoardRefinement>());
  QTest::qWait(250);
  stack.set_scene(2, std::nullopt);
  stack.set_scene_data({});
  stack.set_result(std::make_shared<const CalibrationResult>());
  QTest::qWait(50);
  EXPECT_TRUE(stack.isVisible());
}

}  // namespace
}  // namespace lvcalib::widgets::page_stack_test
