// SPDX-License-Identifier: GPL-3.0-or-later
// A card before a board: the window shows what is refused for it, and takes it back.
#include "support/covered_board.h"

#include <QTabWidget>
#include <QTextBrowser>
#include <QToolButton>

#include <gtest/gtest.h>

#include "pages/scene_page.h"
#include "pipeline/refusals.h"
#include "simulation/dataset_writer.h"
#include "views/cloud_view.h"
#include "views/image_view.h"
#include "widgets/workbench/main_window_fixture.h"

namespace lvcalib::covered_board_test {
namespace {

using test::MainWindowTest;

class CoveredBoardTest : public MainWindowTest {
 protected:
  void SetUp() override {
    MainWindowTest::SetUp();
    auto rig = simulation::simulate(test::small_demo(), {});
    ASSERT_TRUE(rig);
    BoardOutline card = rig->target.outline();
    card.lower_left_m += Eigen::Vector2d(0.5, -0.05);
    card.upper_right_m = card.lower_left_m + Eigen::Vector2d(0.1, 0.5);
    test::cover_part(*rig, 1, card, 0.05F);
    const QString path = folder_.filePath(QStringLiteral("covered"));
    ASSERT_TRUE(simulation::write_dataset(*rig, path.toStdString()).ok());
    answers_.dataset = path;
    ASSERT_TRUE(test::trigger(*window_, "open_dataset"));
    ASSERT_TRUE(test::wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
    QTest::keyClick(window_.get(), Qt::Key_F5);
    ASSERT_TRUE(test::wait_for_result(*window_));
    pages_ = test::find<QTabWidget>(*window_, "pages");
    page_ = window_->findChild<widgets::ScenePage*>();
    image_ = page_->findChild<widgets::ImageView*>();
  }
  std::vector<Refusal> patches() {
    std::vector<Refusal> out;
    for (const Refusal& refusal : refusals(*workspace().result())) {
      if (refusal.what == Refusal::What::kPatch) out.push_back(refusal);
    }
    return out;
  }
  const std::vector<widgets::ImageOverlay::Part>& parts() {
    return image_->overlay().overlay().parts;
  }
  QString selection() { return test::find<QLabel>(*page_, "selection")->text(); }

  QTabWidget* pages_ = nullptr;
  widgets::ScenePage* page_ = nullptr;
  widgets::ImageView* image_ = nullptr;
};

TEST_F(CoveredBoardTest, APartOfTheBoardIsShownAsRefusedAndTakenBack) {
  const std::size_t count = patches().size();
  ASSERT_GE(count, 1U);
  for (const Refusal& patch : patches()) EXPECT_EQ(patch.scene, "B");
  EXPECT_TRUE(parts().empty()) << "scene A";
  const SceneResponse& response = workspace().result()->response.scenes[1];
  ASSERT_EQ(response.name, "B");
  EXPECT_GT(response.samples.size(), 300U);
  for (const BoundarySample& s : response.samples) {
    for (const Refusal& patch : patches())
      ASSERT_FALSE(patch.board_m.contains(s.board_m.cast<double>())) << s.board_m.transpose();
  }
  test::click_scene(*window_, "B", false);
  ASSERT_TRUE(test::wait_until([&] {
    const auto& shown = page_->findChild<widgets::CloudView*>()->scene();
    return !image_->image().isNull() && shown && !shown->unused.refused_m.empty() &&
           parts().size() == count;
  }));
  EXPECT_FALSE(parts()[0].used);
  auto* text = test::find<QLabel>(*page_, "scene-edits");
  EXPECT_TRUE(text->text().contains("of the board")) << text->text().toStdString();

  // A refused point says why.
  const auto& cloud = *page_->findChild<widgets::CloudView*>()->scene();
  int told = 0;
  for (std::uint32_t i = 0; i < cloud.cloud->size() && told == 0; ++i) {
    const auto& refused = cloud.unused.refused_m;
    if (std::find(refused.begin(), refused.end(), cloud.cloud->points_m[i]) == refused.end())
      continue;
    Q_EMIT page_->findChild<widgets::CloudView*>()->pointPicked(i);
    told += selection().contains("left out: ");
  }
  EXPECT_EQ(told, 1) << selection().toStdString();

  // A click into the part: between tags and circles, where the card stands.
  const QPointF middle = parts()[0].edge.boundingRect().center();
  Q_EMIT image_->pixelClicked(middle);
  EXPECT_TRUE(selection().contains("something stands before")) << selection().toStdString();
  auto* keep = test::find<QToolButton>(*page_, "keep");
  ASSERT_TRUE(keep->isVisible());
  QTest::mouseClick(keep, Qt::LeftButton);
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(patches().size(), count - 1);
  ASSERT_EQ(parts().size(), count);
  EXPECT_TRUE(parts().back().used);
  EXPECT_TRUE(text->text().contains("Used all the same: a part of the board"))
      << text->text().toStdString();

  // The list of what is left out has it too, and leaves it out again.
  pages_->setCurrentIndex(3);
  auto* list = test::find<QTextBrowser>(*window_, "response-reasons");
  EXPECT_TRUE(list->toPlainText().contains("Used all the same: a part of the board"))
      << list->toPlainText().toStdString();
  ASSERT_TRUE(list->toHtml().contains("href=\"back:B\""));
  Q_EMIT list->anchorClicked(QUrl("back:B"));
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_EQ(patches().size(), count);
  EXPECT_FALSE(list->toHtml().contains("href=\"back:B\""));
}

}  // namespace
}  // namespace lvcalib::covered_board_test
