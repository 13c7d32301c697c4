// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsics/camera_page.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>

#include <gtest/gtest.h>

#include "camera/camera_deviations.h"
#include "modelling/residual_map_plot.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"
#include "views/image_view.h"
#include "views/uncertainty_plots.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::camera_page_test {
namespace {

using test::find;

// A dataset on disk and its calibrations; copied for whoever changes it.
struct Rig {
  QTemporaryDir folder;
  std::filesystem::path path;
  Dataset dataset;
  Camera truth;
  std::shared_ptr<const CalibrationResult> fixed, free;
};

const Rig& rig() {
  static const auto made = [] {
    auto out = std::make_unique<Rig>();
    simulation::SimulationOptions options;
    options.seed = 21;
    options.scenes = 4;
    options.lidar.points = 60'000;
    options.image.width_px = 800;
    options.image.height_px = 500;
    const auto simulated = simulation::simulate(options, {});
    EXPECT_TRUE(simulated.ok());
    out->path = out->folder.filePath("rig").toStdString();
    out->truth = simulated->camera;
    EXPECT_TRUE(simulation::write_dataset(*simulated, out->path).ok());
    out->dataset = *open_dataset(out->path);
    const auto calibrated = [&](IntrinsicsMode mode) {
      CalibrationRequest request;
      request.options.intrinsics.mode = static_cast<int>(mode);
      auto result = calibrate(out->dataset, request, {});
      EXPECT_TRUE(result.ok()) << result.error().text();
      return std::make_shared<const CalibrationResult>(std::move(*result));
    };
    out->fixed = calibrated(IntrinsicsMode::kFixed);
    out->free = calibrated(IntrinsicsMode::kFree);
    return out;
  }();
  return *made;
}

class CameraPageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    page_.setChoices(answers_);
    page_.resize(1000, 600);
    page_.show();
    QObject::connect(&page_, &CameraPage::failed,
                     [this](const QString& message) { failures_ << message; });
  }
  void open(const std::shared_ptr<const CalibrationResult>& result) {
    page_.setDataset(rig().dataset);
    page_.setResult(result);
    EXPECT_TRUE(settled());
  }
  bool settled() {
    return test::wait_until([this] { return !page_.busy(); }, 60'000);
  }
  QPushButton* button(const char* name) { return find<QPushButton>(page_, name); }
  QString text() { return find<QTextBrowser>(page_, "camera_text")->toPlainText(); }
  QTreeWidget* images() { return find<QTreeWidget>(page_, "camera_images"); }
  qsizetype cells(const char* which) {
    return which == QLatin1String("residuals")
               ? page_.findChild<ResidualMapPlot*>()->csv().count('\n')
               : page_.findChild<UncertaintyMapPlot*>()->csv().count('\n');
  }

  test::Answers answers_;
  CameraPage page_;
  QStringList failures_;
};

TEST_F(CameraPageTest, WithoutADatasetThereIsNothingToDo) {
  for (const char* name : {"camera_add", "camera_calibrate", "camera_save"})
    EXPECT_FALSE(button(name)->isEnabled()) << name;
  EXPECT_TRUE(text().isEmpty());
}

TEST_F(CameraPageTest, ShowsTheCameraThatWasTakenAsGiven) {
  open(rig().fixed);
  EXPECT_TRUE(text().contains("taken as given")) << text().toStdString();
  EXPECT_FALSE(text().contains("with the LiDAR"));
  ASSERT_EQ(images()->topLevelItemCount(), 4);
  const SceneSolution& first = rig().fixed->extrinsic.scenes.front();
  EXPECT_EQ(images()->topLevelItem(0)->text(0).toStdString(), first.name);
  EXPECT_NEAR(images()->topLevelItem(0)->text(2).toDouble(), first.rms_px, 0.001);
  EXPECT_GT(cells("residuals"), 1);
  EXPECT_EQ(cells("uncertainty"), 0) << "nothing is known of how sure it is";
  EXPECT_FALSE(button("camera_save")->isEnabled()) << "nothing was estimated";
  // The image of the chosen scene, with its corners.
  auto* view = find<ImageView>(page_, "camera_image");
  ASSERT_TRUE(test::wait_until([&] { return !view->image().isNull(); }, 10'000));
  EXPECT_EQ(view->overlay().overlay().corners.size(),
            static_cast<std::size_t>(images()->topLevelItem(0)->text(1).toInt()));
}

// What is selected are the corners in the rectangle; what goes are their tags, in their scenes.
TEST_F(CameraPageTest, CornersAreBrushedAndTheirTagsLeftOut) {
  open(rig().fixed);
  auto* brush = find<QToolButton>(page_, "camera_brush");
  auto* exclude = find<QToolButton>(page_, "camera_exclude");
  auto* map = page_.findChild<ResidualMapPlot*>();
  ASSERT_TRUE(brush->isEnabled());
  EXPECT_FALSE(exclude->isVisible());
  QTest::qWait(50);
  const SceneResult& scene = rig().fixed->scenes[1];
  const CornerObservation& corner = scene.view->corners[5];
  const QPoint at(static_cast<int>(map->xAxis->coordToPixel(corner.pixel.x())),
                  static_cast<int>(map->yAxis->coordToPixel(corner.pixel.y())));
  const auto drag = [&] {
    QTest::mousePress(map, Qt::LeftButton, {}, at - QPoint(3, 3));
    QTest::mouseMove(map, at);
    QTest::mouseMove(map, at + QPoint(4, 4));
    QTest::mouseRelease(map, Qt::LeftButton, {}, at + QPoint(4, 4));
  };
  brush->setChecked(true);
  drag();
  ASSERT_TRUE(exclude->isVisible());
  QSignalSpy wanted(&page_, &CameraPage::excludeWanted);
  exclude->click();
  ASSERT_EQ(wanted.count(), 1);
  const auto more = wanted[0][0].value<std::map<QString, SceneEdits>>();
  const auto of_scene = more.find(QString::fromStdString(scene.name));
  ASSERT_NE(of_scene, more.end());
  EXPECT_TRUE(contains_id(of_scene->second.tags, corner.feature_id));
  EXPECT_LT(of_scene->second.tags.size(), 5U) << "not those far away";
  EXPECT_TRUE(of_scene->second.points_m.empty());
  EXPECT_FALSE(exclude->isVisible());
  drag();
  EXPECT_TRUE(exclude->isVisible());
  brush->setChecked(false);
  EXPECT_FALSE(exclude->isVisible());
}

// While the image of what was there before is still being loaded.
TEST_F(CameraPageTest, NothingOfADatasetThatIsClosedStays) {
  open(rig().fixed);
  page_.setDataset(std::nullopt);
  ASSERT_TRUE(settled());
  EXPECT_EQ(images()->topLevelItemCount(), 0);
  auto* view = find<ImageView>(page_, "camera_image");
  EXPECT_FALSE(test::wait_until([&] { return !view->image().isNull(); }, 500));
  EXPECT_EQ(cells("residuals"), 0);
  EXPECT_TRUE(text().isEmpty());
}

TEST_F(CameraPageTest, WhatWasEstimatedWithTheLidarIsShownWithItsUncertainty) {
  open(rig().free);
  EXPECT_TRUE(text().contains("with the LiDAR")) << text().toStdString();
  EXPECT_TRUE(text().contains("±"));
  EXPECT_GT(cells("uncertainty"), 1);
  EXPECT_TRUE(button("camera_save")->isEnabled());
}

TEST_F(CameraPageTest, ACameraIsCalibratedFromImagesAloneAndSaved) {
  open(rig().fixed);
  button("camera_calibrate")->click();
  EXPECT_TRUE(page_.busy());
  ASSERT_TRUE(test::wait_until([this] { return page_.calibration() && !page_.busy(); }, 60'000));
  EXPECT_EQ(find<QComboBox>(page_, "camera_shown")->currentIndex(), 1);
  EXPECT_TRUE(text().contains("images alone")) << text().toStdString();
  EXPECT_TRUE(text().contains("4 of 4 images"));
  EXPECT_EQ(images()->topLevelItem(1)->text(0), QStringLiteral("B/image.png"));
  EXPECT_GT(cells("uncertainty"), 1);
  const Camera& made = page_.calibration()->camera;
  EXPECT_NEAR(made.fx, rig().truth.fx, 4.0 * page_.calibration()->sigma(0));
  answers_.export_to = rig().folder.filePath("made.yaml");
  button("camera_save")->click();
  const auto saved = read_camera(answers_.export_to.toStdString());
  ASSERT_TRUE(saved.ok()) << saved.error().text();
  EXPECT_NEAR(saved->camera.fx, made.fx, 1e-6);
  const auto stated = read_camera_deviations(answers_.export_to.toStdString(), saved->camera);
  ASSERT_TRUE(stated.ok() && *stated);
  EXPECT_NEAR((**stated)(0), page_.calibration()->sigma(0), 1e-4) << "four digits";
  EXPECT_TRUE(failures_.isEmpty());
  // Back to the calibration with the LiDAR, and another dataset forgets it.
  find<QComboBox>(page_, "camera_shown")->setCurrentIndex(0);
  ASSERT_TRUE(settled());
  EXPECT_TRUE(text().contains("taken as given"));
  Dataset other = rig().dataset;
  other.path = "/elsewhere";
  page_.setDataset(other);
  EXPECT_EQ(page_.calibration(), nullptr);
}

TEST_F(CameraPageTest, ACameraThatCannotBeWrittenSaysSo) {
  open(rig().free);
  answers_.export_to = rig().folder.filePath("no/folder/camera.yaml");
  button("camera_save")->click();
  ASSERT_EQ(failures_.size(), 1);
  EXPECT_TRUE(failures_[0].contains("camera.yaml"));
}

TEST_F(CameraPageTest, ImagesThatAreAddedGoIntoTheDataset) {
  Dataset copy = rig().dataset;
  const QTemporaryDir folder;
  copy.path = folder.filePath("rig").toStdString();
  std::filesystem::copy(rig().path, copy.path, std::filesystem::copy_options::recursive);
  page_.setDataset(copy);
  const QSignalSpy changed(&page_, &CameraPage::datasetChanged);
  answers_.images =
      QStringList{QString::fromStdString((copy.path / "scenes/A/image.png").string())};
  button("camera_add")->click();
  ASSERT_TRUE(settled());
  EXPECT_EQ(changed.count(), 1);
  EXPECT_EQ(open_dataset(copy.path)->camera_images.size(), 1U);
  // Another image of that name, and none at all.
  answers_.images =
      QStringList{QString::fromStdString((copy.path / "scenes/B/image.png").string())};
  button("camera_add")->click();
  ASSERT_TRUE(settled());
  auto* message = find<QLabel>(page_, "camera_message");
  EXPECT_TRUE(message->text().contains("another image of this name"))
      << message->text().toStdString();
  EXPECT_EQ(changed.count(), 1);
  answers_.images.clear();
  button("camera_add")->click();
  EXPECT_FALSE(page_.busy());
}

TEST_F(CameraPageTest, WithoutAnyImageThereIsAnErrorAndNoCamera) {
  Dataset blank = rig().dataset;
  blank.scenes.clear();
  page_.setDataset(blank);
  button("camera_calibrate")->click();
  ASSERT_TRUE(settled());
  EXPECT_FALSE(find<QLabel>(page_, "camera_message")->text().isEmpty());
  EXPECT_EQ(page_.calibration(), nullptr);
}

}  // namespace
}  // namespace lvcalib::widgets::camera_page_test
