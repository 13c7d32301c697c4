// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsics/camera_dialog.h"

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/file_io.h"
#include "intrinsics/camera_page.h"
#include "modelling/residual_map_plot.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"
#include "views/uncertainty_plots.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::camera_dialog_test {
namespace {

using test::find;
namespace fs = std::filesystem;

// A folder of photos of the board, with target.yaml in it and beside it.
struct Photos {
  QTemporaryDir folder;
  Camera truth;
  [[nodiscard]] QString at(const char* name) const { return folder.filePath(name); }
};

const Photos& photos() {
  static const auto made = [] {
    auto out = std::make_unique<Photos>();
    simulation::SimulationOptions options;
    options.seed = 23;
    options.scenes = 6;
    options.lidar.points = 500;
    options.image.width_px = 800;
    options.image.height_px = 500;
    const auto rig = simulation::simulate(options, {});
    EXPECT_TRUE(rig.ok());
    out->truth = rig->camera;
    const auto write = [&](const char* name, const std::string& bytes) {
      const fs::path path = out->at(name).toStdString();
      fs::create_directories(path.parent_path());
      std::ofstream(path, std::ios::binary) << bytes;
    };
    for (const auto& scene : rig->scenes)
      write(("photos/" + scene.name + ".png").c_str(), *simulation::encode_png(scene.image));
    write("photos/target.yaml", to_yaml(rig->target));
    Target other = rig->target;
    other.first_tag_id += 300;
    write("other.yaml", to_yaml(other));
    fs::create_directories(out->at("nothing").toStdString());
    return out;
  }();
  return *made;
}

class CameraDialogTest : public ::testing::Test {
 protected:
  CameraDialogTest() : dialog_(answers_, photos().folder.path()) {
    dialog_.setAttribute(Qt::WA_DeleteOnClose, false);
    dialog_.show();
  }
  bool settled() {
    return test::wait_until([this] { return !dialog_.busy(); }, 60'000);
  }
  bool calibrates() {
    button("camera_calibrate")->click();
    return test::wait_until([this] { return dialog_.page().calibration() && !dialog_.busy(); },
                            60'000);
  }
  void choose(const char* folder) {
    answers_.camera_images = photos().at(folder);
    button("photos_choose_folder")->click();
    EXPECT_TRUE(settled());
  }
  QPushButton* button(const char* name) { return find<QPushButton>(dialog_, name); }
  QString said() { return find<QLabel>(dialog_, "photos_text")->text(); }

  test::Answers answers_;
  CameraDialog dialog_;
};

TEST_F(CameraDialogTest, AFolderOfImagesBecomesACamera) {
  EXPECT_FALSE(button("camera_calibrate")->isEnabled());
  EXPECT_FALSE(button("camera_add")->isVisible());
  choose("photos");
  EXPECT_TRUE(said().contains("6 images")) << said().toStdString();
  ASSERT_TRUE(calibrates());
  const auto made = dialog_.page().calibration();
  EXPECT_NEAR(made->camera.fx, photos().truth.fx, 4.0 * made->sigma(0));
  EXPECT_EQ(find<QTreeWidget>(dialog_, "camera_images")->topLevelItemCount(), 6);
  EXPECT_GT(dialog_.findChild<ResidualMapPlot*>()->csv().count('\n'), 1);
  EXPECT_GT(dialog_.findChild<UncertaintyMapPlot*>()->csv().count('\n'), 1);
  const QSignalSpy saved(&dialog_, &CameraDialog::cameraSaved);
  answers_.export_to = photos().at("photos/camera.yaml");
  button("camera_save")->click();
  ASSERT_EQ(saved.count(), 1);
  const auto read = read_camera(answers_.export_to.toStdString());
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_NEAR(read->camera.fx, made->camera.fx, 1e-6);
  // Of another model, and nothing of what was before.
  find<QComboBox>(dialog_, "photos_model")->setCurrentText("equidistant");
  EXPECT_EQ(dialog_.page().calibration(), nullptr);
  ASSERT_TRUE(settled());
  EXPECT_FALSE(button("camera_save")->isEnabled());
  ASSERT_TRUE(calibrates());
  EXPECT_EQ(dialog_.page().calibration()->camera.model, DistortionModel::kEquidistant);
}

TEST_F(CameraDialogTest, StartsFromACameraThatIsAboutRight) {
  answers_.camera = photos().folder.filePath("rough.yaml");
  Camera rough = photos().truth;
  rough.fx *= 1.05;
  rough.fy *= 1.05;
  ASSERT_TRUE(write_file_atomically(answers_.camera.toStdString(), to_yaml(rough)).ok());
  choose("photos");
  button("photos_choose_camera")->click();
  ASSERT_TRUE(settled());
  ASSERT_TRUE(calibrates());
  const auto made = dialog_.page().calibration();
  EXPECT_NEAR(made->camera.fx, photos().truth.fx, 4.0 * made->sigma(0));
  // One of images of another size is no start for these.
  rough.width_px += 100;
  ASSERT_TRUE(write_file_atomically(answers_.camera.toStdString(), to_yaml(rough)).ok());
  button("photos_choose_camera")->click();
  ASSERT_TRUE(settled());
  button("camera_calibrate")->click();
  ASSERT_TRUE(settled());
  EXPECT_EQ(dialog_.page().calibration(), nullptr);
  EXPECT_FALSE(find<QLabel>(dialog_, "camera_message")->text().isEmpty());
}

TEST_F(CameraDialogTest, SaysWhatIsWrongWithWhatIsChosen) {
  choose("nothing");
  EXPECT_TRUE(said().contains("nothing")) << said().toStdString();
  EXPECT_FALSE(button("camera_calibrate")->isEnabled());
  choose("photos");
  answers_.target = photos().at("absent.yaml");
  button("photos_choose_target")->click();
  ASSERT_TRUE(settled());
  EXPECT_TRUE(said().contains("absent.yaml")) << said().toStdString();
  EXPECT_FALSE(button("camera_calibrate")->isEnabled());
  answers_.target = photos().at("photos/target.yaml");
  button("photos_choose_target")->click();
  answers_.camera = photos().at("no-camera.yaml");
  button("photos_choose_camera")->click();
  ASSERT_TRUE(settled());
  EXPECT_TRUE(said().contains("no-camera.yaml")) << said().toStdString();
  EXPECT_FALSE(button("camera_calibrate")->isEnabled());
  find<QLineEdit>(dialog_, "photos_camera")->clear();
  // A board that none of the images shows.
  answers_.target = photos().at("other.yaml");
  button("photos_choose_target")->click();
  ASSERT_TRUE(settled());
  button("camera_calibrate")->click();
  ASSERT_TRUE(settled());
  EXPECT_EQ(dialog_.page().calibration(), nullptr);
  EXPECT_FALSE(find<QLabel>(dialog_, "camera_message")->text().isEmpty());
}

}  // namespace
}  // namespace lvcalib::widgets::camera_dialog_test
