// SPDX-License-Identifier: GPL-3.0-or-later
// The guide's first hour, followed to the letter: what it says one sees is there, and everything
// that it names is called so in the window.
#include <QDialog>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QRegularExpression>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <set>

#include <gtest/gtest.h>

#include "importing/import_dialog.h"
#include "importing/stretch_list.h"
#include "models/scene_model.h"
#include "runner/demo.h"
#include "start/coach_marks.h"
#include "widgets/importing/recorded_walk.h"
#include "widgets/support/driver.h"
#include "widgets/support/visible_texts.h"

namespace lvcalib::widgets::newcomer_test {
namespace {

QString plain(QString text) {
  return text.remove(QLatin1Char('&')).simplified();
}

class NewcomerTest : public ::testing::Test {
 protected:
  NewcomerTest() : settings_(folder_.filePath("settings")), window_(settings_, answers_) {
    window_.resize(1500, 940);
    window_.show();
    // A short stage may come and go between two looks: the status line is read whenever it changes.
    QObject::connect(&window_.workspace(), &Workspace::progressed, &window_,
                     [this] { seen_.insert(test::find<QLabel>(window_, "stage")->text()); });
    look_around();
  }
  ~NewcomerTest() override {
    window_.close();
    Runner::wait_for_workers(30'000);
  }

  // What is said anywhere in the window now.
  void look_around() {
    const test::TextCollector collector(window_);
    for (const test::SaidText& said : collector.texts()) seen_.insert(plain(said.text));
  }
  bool wait(const std::function<bool()>& holds) {
    const bool held = test::wait_until(holds, 300'000);
    look_around();
    return held;
  }
  void show_tab(int tab) {
    test::find<QTabWidget>(window_, "pages")->setCurrentIndex(tab);
    QTest::qWait(100);
    look_around();
  }
  bool is_named(const QString& name) const {
    return std::any_of(seen_.begin(), seen_.end(),
                       [&](const QString& text) { return text.contains(name); });
  }
  // What the guide sets in italics: names of the window.
  static QStringList names_of_the_guide() {
    QFile file(QStringLiteral(LVCALIB_SOURCE_DIR "/resources/guide/first-hour.md"));
    if (!file.open(QIODevice::ReadOnly)) return {};
    const QString text = QString::fromUtf8(file.readAll()).simplified();
    static const QRegularExpression italics(QStringLiteral("(?<!\\*)\\*([^*]+)\\*(?!\\*)"));
    QStringList names;
    for (auto at = italics.globalMatch(text); at.hasNext();)
      names += at.next().captured(1).split(QStringLiteral(" › "));
    names.removeDuplicates();
    return names;
  }

  QTemporaryDir folder_;
  AppSettings settings_;
  test::Answers answers_;
  MainWindow window_;
  std::set<QString> seen_;
};

TEST_F(NewcomerTest, TheFirstHourIsAsTheGuideSays) {
  ASSERT_GT(names_of_the_guide().size(), 25);
  // 2. The demo.
  simulation::SimulationOptions options = demo_options();
  options.seed = 1;  // Fewer points than the demo has: its own scenes would leave a weak direction.
  options.lidar.points = 60'000;
  options.image.width_px = 1000;
  options.image.height_px = 640;
  options.placement.max_distance_m = 2.8;
  window_.set_demo(options);
  ASSERT_TRUE(test::trigger(window_, "demo"));
  ASSERT_TRUE(wait([&] { return window_.workspace().is_open() && !window_.workspace().busy(); }));
  for (const char* scene : {"A", "B", "C", "D"})
    EXPECT_EQ(test::cell(window_, scene, SceneModel::kState), "not run");
  auto* coach = test::find<CoachMarks>(window_, "coach_marks");
  ASSERT_NE(coach, nullptr);
  EXPECT_TRUE(coach->isVisible());
  EXPECT_TRUE(is_named("Press <b>Run all</b>"));
  test::trigger(window_, "run");
  ASSERT_TRUE(wait([&] { return window_.workspace().result() && !window_.workspace().busy(); }));
  EXPECT_EQ(test::cell(window_, "A", SceneModel::kState), "used");
  EXPECT_EQ(test::find<QLabel>(window_, "quality")->text(), "Base model: doubtful");
  EXPECT_TRUE(test::find<QLabel>(window_, "quality")->toolTip().contains("an effect is missing"))
      << test::find<QLabel>(window_, "quality")->toolTip().toStdString();
  show_tab(2);
  show_tab(4);
  ASSERT_TRUE(wait([&] { return window_.model_work().ranking() && !window_.model_work().busy(); }));
  auto* proposals = test::find<QTreeWidget>(window_, "proposals");
  EXPECT_TRUE(test::find<QLabel>(window_, "missing_verdict")
                  ->text()
                  .startsWith("<b>Range walk is missing.</b>"));
  EXPECT_EQ(proposals->topLevelItem(0)->text(0), "Range walk");
  EXPECT_EQ(proposals->topLevelItem(0)->text(1), "present");
  EXPECT_TRUE(wait([&] { return test::find<QPushButton>(*coach, "coach_next")->isEnabled(); }));
  test::find<QPushButton>(window_, "add_proposal")->click();
  ASSERT_TRUE(wait([&] {
    return window_.model_work().current() == 1 && window_.model_work().ranking() &&
           !window_.model_work().busy();
  }));
  auto* terms = test::find<QTreeWidget>(window_, "terms");
  ASSERT_EQ(terms->topLevelItemCount(), 2);
  EXPECT_EQ(terms->topLevelItem(1)->text(0), "Range walk");
  EXPECT_TRUE(terms->topLevelItem(1)->text(1).contains(QString::fromUtf8("±")));
  EXPECT_TRUE(
      test::find<QLabel>(window_, "missing_verdict")->text().contains("Nothing is missing"));
  ASSERT_TRUE(test::trigger(window_, "undo"));
  EXPECT_EQ(window_.model_work().current(), 0U);
  ASSERT_TRUE(test::trigger(window_, "redo"));
  EXPECT_EQ(window_.model_work().current(), 1U);
  // 3. The board, and a recording.
  ASSERT_TRUE(test::trigger(window_, "print_board"));
  look_around();
  test::find<QDialog>(window_, "print_dialog")->close();
  const test::RecordedWalk walk(test::walk_simulation(3, 120'000, 1024, 768));
  answers_.recording = walk.path;
  ASSERT_TRUE(test::trigger(window_, "import_recording"));
  auto* dialog = window_.findChild<ImportDialog*>();
  ASSERT_NE(dialog, nullptr);
  auto* stretches = test::find<StretchList>(*dialog, "stretches");
  ASSERT_TRUE(wait([&] { return stretches->topLevelItemCount() > 0 && !dialog->busy(); }));
  EXPECT_EQ(stretches->expectedScenes(), 3);
  test::find<QLineEdit>(*dialog, "dataset_folder")->setText(folder_.filePath("mine"));
  test::find<QPushButton>(*dialog, "import_start")->click();
  ASSERT_TRUE(wait([&] { return window_.findChild<ImportDialog*>() == nullptr; }));
  ASSERT_TRUE(test::wait_for_result(window_));
  // 4. and 5. The verdict, and what is missing.
  show_tab(0);
  show_tab(2);
  show_tab(4);
  EXPECT_FALSE(test::find<QLabel>(window_, "quality")->text().isEmpty());
  ASSERT_TRUE(wait([&] { return window_.model_work().step() && !window_.model_work().busy(); }));
  // 6. Export.
  ASSERT_TRUE(test::trigger(window_, "results"));
  auto* results = test::find<QDialog>(window_, "results_dialog");
  ASSERT_NE(results, nullptr);
  test::find<QTabWidget>(*results, "results_tabs")->setCurrentIndex(1);
  auto* formats = test::find<QListWidget>(*results, "formats");
  formats->setCurrentItem(formats->findItems(QStringLiteral("ros2-tf"), Qt::MatchExactly).value(0));
  QTest::keyClicks(test::find<QLineEdit>(*results, "lidar_frame"), "_roof");
  look_around();
  answers_.export_to = folder_.filePath("mine.launch");
  test::find<QPushButton>(*results, "save_export")->click();
  QFile written(answers_.export_to);
  ASSERT_TRUE(wait([&] { return written.exists(); }));
  ASSERT_TRUE(written.open(QIODevice::ReadOnly));
  EXPECT_TRUE(written.readAll().contains("lidar_roof"));
  // Everything that the guide names was there.
  for (const QString& name : names_of_the_guide())
    EXPECT_TRUE(is_named(name)) << "the guide names '" << name.toStdString() << "'";
}

}  // namespace
}  // namespace lvcalib::widgets::newcomer_test
