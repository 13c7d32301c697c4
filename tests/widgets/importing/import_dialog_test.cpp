// SPDX-License-Identifier: GPL-3.0-or-later
// From a bag to an extrinsic through the window, and what may go wrong on the way.
#include "importing/import_dialog.h"

#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "importing/stretch_list.h"
#include "importing/time_line.h"
#include "report/result_file.h"
#include "support/timing.h"
#include "widgets/importing/recorded_walk.h"
#include "widgets/workbench/main_window_fixture.h"

namespace lvcalib::widgets::import_dialog_test {
namespace {

using test::find;
using test::wait_until;

class ImportDialogTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void SetUp() override {
    settings_ = std::make_unique<AppSettings>(folder_.filePath("settings"));
    window_ = std::make_unique<MainWindow>(*settings_, answers_);
    window_->show();
  }
  // Opens the recording as the menu does.
  void open(const QString& path) {
    answers_.recording = path;
    ASSERT_TRUE(test::trigger(*window_, "import_recording"));
    ASSERT_NE(dialog(), nullptr);
    find<QLineEdit>(*dialog(), "dataset_folder");
  }
  void look_at(const QString& path) {
    open(path);
    ASSERT_TRUE(
        wait_until([&] { return stretches().topLevelItemCount() > 0 && !dialog()->busy(); }));
    find<QLineEdit>(*dialog(), "dataset_folder")->setText(dataset());
  }
  bool wait_for_pictures() {
    return wait_until([&] {
      for (int i = 0; i < stretches().topLevelItemCount(); ++i) {
        if (stretches().stretches()[static_cast<std::size_t>(i)].usable &&
            stretches().topLevelItem(i)->text(3).isEmpty())
          return false;
      }
      return true;
    });
  }
  ImportDialog* dialog() { return window_->findChild<ImportDialog*>(); }
  StretchList& stretches() { return *find<StretchList>(*dialog(), "stretches"); }
  QPushButton& button(const char* name) { return *find<QPushButton>(*dialog(), name); }
  QString problem() { return find<QLabel>(*dialog(), "import_problem")->text(); }
  QString dataset() { return folder_.filePath("dataset"); }
  QStringList left_behind() {
    return QDir(folder_.path()).entryList(QDir::Dirs | QDir::Hidden | QDir::NoDotAndDotDot);
  }

  QTemporaryDir folder_;
  test::Answers answers_;
  std::unique_ptr<AppSettings> settings_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(ImportDialogTest, FromABagToAnExtrinsic) {
  const test::RecordedWalk walk(test::walk_simulation(3, 120'000, 1024, 768));
  test::Watchdog watchdog;
  look_at(walk.path);
  ASSERT_TRUE(wait_for_pictures());
  EXPECT_EQ(stretches().expectedScenes(), 3);
  EXPECT_TRUE(wait_until([&] {
    return find<TimeLine>(*dialog(), "time_line")->pictureCount() == RecordingWork::kGlimpses;
  }));
  EXPECT_EQ(stretches().topLevelItem(0)->text(3), "seen");
  EXPECT_FALSE(stretches().topLevelItem(0)->icon(0).isNull());
  EXPECT_EQ(find<QComboBox>(*dialog(), "image_topic")->currentText(), "/camera/image_raw");
  EXPECT_TRUE(problem().isEmpty()) << problem().toStdString();
  button("import_start").click();
  // The dialog goes, the dataset opens and is calibrated, without another click.
  ASSERT_TRUE(wait_until([&] { return dialog() == nullptr; }));
  ASSERT_TRUE(test::wait_for_result(*window_));
  EXPECT_LT(watchdog.take_largest_ms(), test::time_limit(2000));
  const auto result = window_->workspace().result();
  EXPECT_EQ(result->scenes.size(), 3U);
  const ExtrinsicError error = compare_extrinsics(
      {result->extrinsic.camera_from_lidar.transform, {}}, walk.rig.camera_from_lidar);
  EXPECT_LT(error.translation_mm, 5.0);
  EXPECT_LT(error.rotation_mrad, 3.0);
}

TEST_F(ImportDialogTest, AStretchThatIsUntickedIsNoScene) {
  look_at(test::small_walk().path);
  ASSERT_EQ(stretches().topLevelItemCount(), 3);
  auto* line = find<TimeLine>(*dialog(), "time_line");
  QTest::mouseClick(line, Qt::LeftButton, {}, line->stretchRect(1).center());
  EXPECT_EQ(stretches().topLevelItem(1)->checkState(0), Qt::Unchecked);
  EXPECT_TRUE(stretches().topLevelItem(1)->text(4).contains("left out by you"));
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return window_->workspace().is_open(); }));
  EXPECT_EQ(window_->workspace().dataset().scenes.size(), 2U);
  window_->workspace().cancel();
}

TEST_F(ImportDialogTest, DraggedEdgesAreThoseOfTheScene) {
  look_at(test::small_walk().path);
  ASSERT_TRUE(wait_for_pictures());
  auto* line = find<TimeLine>(*dialog(), "time_line");
  auto* as_found = find<QPushButton>(*dialog(), "as_found");
  EXPECT_FALSE(as_found->isEnabled());
  stretches().toggle(0);  // Stays unticked whatever becomes of the others.
  const QRect band = line->stretchRect(1);
  const double found_s = stretches().stretches()[1].first_s;
  const QPoint from(band.left(), band.center().y());
  const auto drag = [&] {
    QTest::mousePress(line, Qt::LeftButton, {}, from);
    QTest::mouseMove(line, from + QPoint(band.width() / 4, 0));
    QTest::mouseMove(line, from + QPoint(band.width() / 3, 0));
    QTest::mouseRelease(line, Qt::LeftButton, {}, from + QPoint(band.width() / 3, 0));
    return wait_until([&] { return stretches().stretches()[1].by_hand && !dialog()->busy(); });
  };
  ASSERT_TRUE(drag());
  EXPECT_GT(stretches().stretches()[1].first_s, found_s + 0.4);
  EXPECT_NEAR(find<QDoubleSpinBox>(*dialog(), "stretch_first")->value(),
              stretches().stretches()[1].first_s, 0.006);
  EXPECT_TRUE(as_found->isEnabled());
  as_found->click();
  ASSERT_TRUE(wait_until([&] { return !stretches().stretches()[1].by_hand && !dialog()->busy(); }));
  EXPECT_EQ(stretches().stretches()[1].first_s, found_s);
  ASSERT_TRUE(drag());
  // The keyboard's way to the other edge.
  auto* last = find<QDoubleSpinBox>(*dialog(), "stretch_last");
  const double last_s = last->value() - 0.4;
  last->setValue(last_s);
  ASSERT_TRUE(wait_until(
      [&] { return stretches().stretches()[1].last_s < last_s + 0.01 && !dialog()->busy(); }));
  EXPECT_EQ(stretches().taken(), (std::vector<bool>{false, true, true}));
  const ImportedStretch wanted = stretches().stretches()[1];
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return window_->workspace().is_open(); }));
  window_->workspace().cancel();
  QFile file(dataset() + "/import.json");
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const auto stretches = QJsonDocument::fromJson(file.readAll())["stretches"].toArray();
  ASSERT_EQ(stretches.size(), 3);
  EXPECT_FALSE(stretches[0]["taken"].toBool());
  EXPECT_TRUE(stretches[1]["taken"].toBool());
  EXPECT_NEAR(stretches[1]["first_s"].toDouble(), wanted.first_s, 1e-6);
  EXPECT_NEAR(stretches[1]["last_s"].toDouble(), wanted.last_s, 1e-6);
  EXPECT_GE(stretches[1]["image_s"].toDouble(), wanted.first_s);
}

TEST_F(ImportDialogTest, WithNothingTickedNothingIsImported) {
  look_at(test::small_walk().path);
  for (int i = 0; i < 3; ++i) stretches().toggle(i);
  EXPECT_FALSE(button("import_start").isEnabled());
  EXPECT_FALSE(problem().isEmpty());
  stretches().toggle(0);
  EXPECT_TRUE(button("import_start").isEnabled());
  EXPECT_TRUE(problem().isEmpty());
}

TEST_F(ImportDialogTest, ACancelledImportLeavesNothingAndCanBeDoneAgain) {
  look_at(test::small_walk().path);
  button("import_start").click();
  ASSERT_TRUE(dialog()->busy());
  button("import_stop").click();
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); }, 5000));
  ASSERT_TRUE(Runner::wait_for_workers(10'000));
  EXPECT_THAT(left_behind(), ::testing::ElementsAre("settings"));
  EXPECT_FALSE(window_->workspace().is_open());
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return window_->workspace().is_open(); }));
  window_->workspace().cancel();
}

TEST_F(ImportDialogTest, LookingCanBeCancelledAndTheDialogClosedMeanwhile) {
  open(test::small_walk().path);
  ASSERT_TRUE(dialog()->busy());
  button("import_stop").click();
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); }, 5000));
  EXPECT_FALSE(button("import_start").isEnabled());
  button("import_stop").click();  // Now: look again.
  ASSERT_TRUE(wait_until([&] { return button("import_start").isEnabled(); }));
  open(test::small_walk().path);
  dialog()->close();
  ASSERT_TRUE(wait_until([&] { return dialog() == nullptr; }, 5000));
  look_at(test::small_walk().path);
  EXPECT_EQ(stretches().topLevelItemCount(), 3);
}

TEST_F(ImportDialogTest, ABrokenBagIsOneMessage) {
  const QString path = folder_.filePath("broken.bag");
  test::write_bytes(path.toStdString(), "#ROSBAG V2.0\nand then nothing that makes sense");
  open(path);
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); }));
  EXPECT_TRUE(problem().contains("broken.bag")) << problem().toStdString();
  EXPECT_FALSE(button("import_start").isEnabled());
  EXPECT_EQ(find<QDialog>(*window_, "error_dialog"), nullptr) << "the dialog itself says it";
  // Another one can be chosen from there.
  answers_.recording = test::small_walk().path;
  button("import_other").click();
  ASSERT_TRUE(wait_until([&] { return stretches().topLevelItemCount() == 3; }));
  EXPECT_TRUE(problem().isEmpty()) << problem().toStdString();
}

TEST_F(ImportDialogTest, ATruncatedBagIsReadAsFarAsItGoesAndSaysSo) {
  QFile file(test::small_walk().path);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QByteArray bytes = file.readAll();
  const QString path = folder_.filePath("cut.bag");
  test::write_bytes(path.toStdString(), bytes.left(bytes.size() / 2).toStdString());
  look_at(path);
  EXPECT_GE(stretches().expectedScenes(), 1);
  EXPECT_GE(find<QListWidget>(*dialog(), "import_warnings")->count(), 1);
}

TEST_F(ImportDialogTest, ARecordingWithoutCloudsSaysWhatIsMissing) {
  auto messages = test::simulated_walk(test::small_walk().rig, {});
  std::erase_if(messages, [](const test::BagMessage& m) { return m.topic == "/points"; });
  open(test::small_walk().write(messages, "no-clouds.bag"));
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy() && !problem().isEmpty(); }));
  EXPECT_TRUE(problem().contains("holds no clouds")) << problem().toStdString();
  EXPECT_FALSE(button("import_start").isEnabled());
}

TEST_F(ImportDialogTest, WithoutCameraInfoTheDatasetIsWrittenAndWhatIsMissingIsSaid) {
  auto messages = test::simulated_walk(test::small_walk().rig, {});
  std::erase_if(messages, [](const test::BagMessage& m) {
    return m.topic != "/points" && m.topic != "/camera/image_raw";
  });
  look_at(test::small_walk().write(messages, "no-info.bag"));
  button("import_start").click();
  ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); }));
  EXPECT_TRUE(problem().contains("camera.yaml")) << problem().toStdString();
  EXPECT_TRUE(QFile::exists(dataset() + "/target.yaml"));
  EXPECT_FALSE(window_->workspace().is_open());
}

TEST_F(ImportDialogTest, DroppedRecordingsAndFoldersOfThemAreImported) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(test::small_walk().path)});
  QDropEvent drop(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  // Without a platform's drag there is no drop target for sendEvent() to find.
  static_cast<QObject*>(window_.get())->event(&drop);
  ASSERT_NE(dialog(), nullptr);
  ASSERT_TRUE(wait_until([&] { return stretches().topLevelItemCount() == 3; }));
  dialog()->close();
  ASSERT_TRUE(wait_until([&] { return dialog() == nullptr; }, 5000));
  // A folder that is no dataset but holds a recording.
  const QString folder = folder_.filePath("run");
  test::WalkOptions walk;
  walk.wire = test::Wire::kCdrLittle;
  test::write_rosbag2(folder.toStdString(), test::simulated_walk(test::small_walk().rig, walk),
                      "sqlite3", 2);
  answers_.dataset = folder;
  ASSERT_TRUE(test::trigger(*window_, "open_dataset"));
  ASSERT_NE(dialog(), nullptr);
  EXPECT_TRUE(wait_until([&] { return stretches().topLevelItemCount() == 3; }));
}

// Recordings of other people's tools, where they are at hand: none holds a board at rest.
TEST_F(ImportDialogTest, OtherRecordingsEndInOneMessage) {
  const char* data = std::getenv("LVCALIB_SHARED_DATA");
  const auto folder =
      (data != nullptr ? std::filesystem::path(data)
                       : std::filesystem::path(LVCALIB_SOURCE_DIR).parent_path() / "shared/data") /
      "recordings";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
  int opened = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".md") continue;
    open(QString::fromStdString(entry.path().string()));
    ASSERT_TRUE(wait_until([&] { return !dialog()->busy(); })) << entry.path();
    EXPECT_FALSE(problem().isEmpty() && stretches().topLevelItemCount() == 0) << entry.path();
    EXPECT_EQ(find<QDialog>(*window_, "error_dialog"), nullptr);
    ++opened;
  }
  EXPECT_GT(opened, 3);
}

TEST_F(ImportDialogTest, ALongerLeastRestChangesTheStretchesAtOnce) {
  look_at(test::small_walk().path);
  find<QDoubleSpinBox>(*dialog(), "min_still")->setValue(3.0);
  ASSERT_TRUE(wait_until([&] { return !stretches().stretches().front().usable; }, 5000));
  EXPECT_FALSE(button("import_start").isEnabled());
  find<QDoubleSpinBox>(*dialog(), "min_still")->setValue(0.8);
  EXPECT_TRUE(wait_until([&] { return button("import_start").isEnabled(); }, 5000));
}

}  // namespace
}  // namespace lvcalib::widgets::import_dialog_test
