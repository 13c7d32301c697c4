// SPDX-License-Identifier: GPL-3.0-or-later
// In the smallest window that is promised nothing may be cut off, on any page and in any dialog, in
// either language.
#include <QDialog>
#include <QDockWidget>
#include <QFontDatabase>
#include <QTabWidget>
#include <QTemporaryDir>
#include <filesystem>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "widgets/support/cut_texts.h"
#include "widgets/workbench/main_window_fixture.h"
#include "workbench/language.h"

namespace lvcalib::cut_text_test {
namespace {

using test::find;
using test::trigger;
using test::wait_until;

class CutTextTest : public test::MainWindowTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    // Without one its words are boxes, all of one width.
    if (QLatin1String(GetParam()) == QLatin1String("zh_CN") &&
        QFontDatabase::families(QFontDatabase::SimplifiedChinese).isEmpty())
      GTEST_SKIP() << "no Chinese font, as of fonts-wqy-microhei";
    settings_ = std::make_unique<widgets::AppSettings>(folder_.path());
    window_ = std::make_unique<widgets::MainWindow>(*settings_, answers_);
    for (QAction* action : window_->findChildren<QAction*>(QStringLiteral("language"))) {
      if (action->data().toString() == QLatin1String(GetParam())) action->trigger();
    }
    window_->resize(1280, 720);
    window_->show();
    QTest::qWait(50);
  }
  void TearDown() override {
    window_.reset();
    widgets::use_language("en");
  }
  void calibrate() {
    ASSERT_TRUE(trigger(*window_, "run"));
    ASSERT_TRUE(test::wait_for_result(*window_));
  }
  void expect_whole(const QString& where, const QWidget& window) {
    // Figures and tables find their size in turns of their own, later on a busy machine: what is
    // cut for good is cut after two seconds.
    QStringList found;
    for (int turn = 0; turn < 50; ++turn) {
      QTest::qWait(40);
      QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
      found = test::CutTexts(window).found();
      if (found.isEmpty()) return;
    }
    for (const QString& cut : found)
      ADD_FAILURE() << where.toStdString() << ": " << cut.toStdString();
  }
  // A page or a dialog, and the pages within it.
  void look_at(const QWidget& page, const QString& name) {
    expect_whole(name, *page.window());
    for (auto* inner : page.findChildren<QTabWidget*>()) {
      for (int k = 1; k < inner->count(); ++k) {
        inner->setCurrentIndex(k);
        expect_whole(name + QLatin1Char(' ') + inner->tabText(k), *page.window());
      }
      inner->setCurrentIndex(0);
    }
  }
};

TEST_P(CutTextTest, NothingIsOnAnyPage) {
  expect_whole("welcome", *window_);
  open();
  auto* tabs = find<QTabWidget>(*window_, "pages");
  for (int k = 0; k < tabs->count(); ++k) {
    tabs->setCurrentIndex(k);
    expect_whole(tabs->tabText(k) + QStringLiteral(" before the run"), *window_);
  }
  ASSERT_NO_FATAL_FAILURE(calibrate());
  for (int k = 0; k < tabs->count(); ++k) {
    tabs->setCurrentIndex(k);
    if (tabs->widget(k)->objectName() == QLatin1String("model_page")) {
      auto& work = window_->model_work();
      ASSERT_TRUE(wait_until([&] { return work.step() && !work.busy(); }, 60'000));
    }
    look_at(*tabs->widget(k), tabs->tabText(k));
  }
  for (const char* dock : {"scenes_dock", "parameters_dock", "log_dock"}) {
    auto* shown = find<QWidget>(*window_, dock);
    ASSERT_NE(shown, nullptr) << dock;
    shown->show();
    expect_whole(QString::fromLatin1(dock), *window_);
  }
}

// Two effects with long names in the model: the list of effects, the figures and the list of scenes
// share the width. A window of 1920×1080 is also what 3840×2160 at a scale of 2 has.
TEST_P(CutTextTest, NothingIsWithTwoEffectsInTheModel) {
  open();
  ASSERT_NO_FATAL_FAILURE(calibrate());
  auto* tabs = find<QTabWidget>(*window_, "pages");
  auto* page = find<QWidget>(*window_, "model_page");
  tabs->setCurrentWidget(page);
  auto& work = window_->model_work();
  ASSERT_TRUE(wait_until([&] { return work.step() && !work.busy(); }, 60'000));
  for (const char* effect : {"intensity_geometry", "range_incidence"}) {
    work.add(QString::fromLatin1(effect));
    ASSERT_TRUE(wait_until([&] { return work.step() && !work.busy(); }, 60'000));
  }
  ASSERT_EQ(work.step()->terms.size(), 2U);
  for (const QSize size : {QSize(1280, 720), QSize(1920, 1080)}) {
    window_->resize(size);
    QTest::qWait(50);
    EXPECT_EQ(window_->width(), size.width());
    EXPECT_EQ(window_->height(), size.height());
    look_at(*page, QStringLiteral("%1×%2").arg(size.width()).arg(size.height()));
  }
}

// A dataset as people name their scenes, not yet run: every row says so, beside names that take the
// room. Then with one of them rejected.
TEST_P(CutTextTest, NothingIsBesideLongNamesOfScenes) {
  const QTemporaryDir folder;
  const QString named = folder.filePath(QStringLiteral("named"));
  namespace fs = std::filesystem;
  fs::copy(dataset().toStdString(), named.toStdString(), fs::copy_options::recursive);
  for (const auto& scene : std::vector<fs::directory_entry>(
           fs::directory_iterator((named + "/scenes").toStdString()), fs::directory_iterator()))
    fs::rename(scene.path(), scene.path().parent_path() /
                                 ("2026-03-14-garage_" + scene.path().filename().string()));
  answers_.dataset = named;
  ASSERT_TRUE(trigger(*window_, "open_dataset"));
  ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  auto* view = find<QTreeView>(*window_, "scenes");
  ASSERT_EQ(view->model()->rowCount(), 3);
  auto* dock = find<QDockWidget>(*window_, "scenes_dock");
  const auto look_at_list = [&](const char* when) {
    expect_whole(QLatin1String(when), *window_);
    // There are states that fit at one width and others that fit at another.
    window_->resize(1600, 720);
    for (int width = 240; width < 440; width += 8) {
      window_->resizeDocks({dock}, {width}, Qt::Horizontal);
      expect_whole(QStringLiteral("%1, list of %2 px").arg(QLatin1String(when)).arg(dock->width()),
                   *window_);
    }
    window_->resize(1280, 720);
  };
  look_at_list("not run");
  ASSERT_NO_FATAL_FAILURE(calibrate());
  look_at_list("used");
  view->setCurrentIndex(view->model()->index(1, 0));
  ASSERT_TRUE(trigger(*window_, "reject"));
  look_at_list("rejected");
}

TEST_P(CutTextTest, NothingIsInAnyDialog) {
  open();
  ASSERT_NO_FATAL_FAILURE(calibrate());
  for (const char* name :
       {"results", "compare_results", "check_fresh_data", "plan_scenes", "target_camera",
        "camera_alone", "print_board", "correct_clouds", "guide", "about"}) {
    ASSERT_TRUE(trigger(*window_, name)) << name;
    QTest::qWait(100);
    for (QDialog* dialog : window_->findChildren<QDialog*>()) {
      if (!dialog->isVisible()) continue;
      look_at(*dialog, name);
      dialog->close();
    }
    QTest::qWait(20);
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, CutTextTest, ::testing::Values("en", "zh_CN"));

}  // namespace
}  // namespace lvcalib::cut_text_test
