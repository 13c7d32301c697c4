// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/check_dialog.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"
#include "support/boardless_rooms.h"
#include "views/image_view.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::check_dialog_test {
namespace {

using test::find;

// Two rooms without a board, on disk.
struct Rooms {
  QTemporaryDir folder;
  Camera camera;
  Rigid3 camera_from_lidar;
  std::vector<FilePair> pairs;
};

const Rooms& rooms() {
  static const auto made = [] {
    auto out = std::make_unique<Rooms>();
    const auto rig = simulation::simulate(test::boardless_rooms(), {});
    EXPECT_TRUE(rig.ok());
    const std::filesystem::path path = out->folder.filePath("rooms").toStdString();
    EXPECT_TRUE(simulation::write_dataset(*rig, path).ok());
    out->camera = rig->camera;
    out->camera_from_lidar = rig->camera_from_lidar;
    out->pairs = *find_fresh_data(path);
    return out;
  }();
  return *made;
}

class CheckDialogTest : public ::testing::Test {
 protected:
  void show(const CheckedPose& pose, const std::vector<FilePair>& pairs) {
    dialog_ = std::make_unique<CheckDialog>(
        CheckStart{rooms().camera, pose, pairs, false, rooms().folder.path()}, answers_);
    dialog_->setAttribute(Qt::WA_DeleteOnClose, false);
    QObject::connect(dialog_.get(), &CheckDialog::roughPoseWanted,
                     [this](const std::optional<Rigid3>& pose) { wanted_.push_back(pose); });
    dialog_->show();
  }
  static CheckedPose turned(double y_mrad) {
    Vector6d turn = Vector6d::Zero();
    turn(4) = 1e-3 * y_mrad;
    return {CheckedPose::Kind::kCalibration, se3_exp(turn) * rooms().camera_from_lidar, {}};
  }
  QString verdict() { return find<QLabel>(*dialog_, "check_verdict")->text(); }
  double value(int row) {
    return find<QDoubleSpinBox>(*dialog_, qPrintable(QString("check_value_%1").arg(row)))->value();
  }
  ImageView* image() { return find<ImageView>(*dialog_, "check_image"); }
  bool judged() {
    return test::wait_until([this] { return !dialog_->busy() && verdict().contains("dges"); },
                            60'000);
  }
  bool says(const QString& text) {
    return test::wait_until([&] { return verdict().contains(text); }, 60'000);
  }

  test::Answers answers_;
  std::unique_ptr<CheckDialog> dialog_;
  std::vector<std::optional<Rigid3>> wanted_;
};

TEST_F(CheckDialogTest, ACalibrationIsJudgedAtOnce) {
  show(turned(0.0), rooms().pairs);
  ASSERT_TRUE(says("Edges agree with the calibration")) << verdict().toStdString();
  EXPECT_EQ(find<QComboBox>(*dialog_, "check_place")->count(), 2);
  ASSERT_TRUE(test::wait_until([this] { return !image()->image().isNull(); }, 10'000));
  EXPECT_GT(image()->overlay().overlay().points.size(), 1000U);
  EXPECT_TRUE(find<QLabel>(*dialog_, "check_score")->text().contains("±"));
  // What the colours of the dots are, of those that are shown.
  const auto* legend = find<QLabel>(*dialog_, "check_legend");
  const auto metres = QStringLiteral("\u00a0m");
  EXPECT_EQ(legend->text().count(metres), 3) << legend->text().toStdString();
  EXPECT_TRUE(legend->text().contains("on\u00a0none"));
  find<QCheckBox>(*dialog_, "check_points")->setChecked(false);
  EXPECT_EQ(legend->text().count(metres), 0);
}

TEST_F(CheckDialogTest, ABumpedRigIsMovedToWhereEdgesAgree) {
  show(turned(12.0), {});
  EXPECT_TRUE(verdict().contains("Choose a folder"));
  answers_.files = rooms().folder.filePath("rooms");
  find<QPushButton>(*dialog_, "check_folder")->click();
  ASSERT_TRUE(says("Edges contradict the calibration")) << verdict().toStdString();
  // A first step by hand, then by the edges.
  find<QDoubleSpinBox>(*dialog_, "check_value_1")->setValue(-8.0);
  EXPECT_TRUE(verdict().contains("Moved by hand"));
  find<QPushButton>(*dialog_, "check_best")->click();
  ASSERT_TRUE(test::wait_until([this] { return std::abs(value(1) + 12.0) < 4.0; }, 60'000))
      << value(1);
  EXPECT_LT(rotation_distance_rad(dialog_->pose(), rooms().camera_from_lidar), 0.006);
  find<QPushButton>(*dialog_, "check_take")->click();
  ASSERT_EQ(wanted_.size(), 1U);
  EXPECT_LT(rotation_distance_rad(*wanted_[0], dialog_->pose()), 1e-9);
  find<QPushButton>(*dialog_, "check_forget")->click();
  ASSERT_EQ(wanted_.size(), 2U);
  EXPECT_FALSE(wanted_[1].has_value());
  find<QPushButton>(*dialog_, "check_reset")->click();
  EXPECT_EQ(value(1), 0.0);
}

TEST_F(CheckDialogTest, PointsFollowTheMouse) {
  show({CheckedPose::Kind::kRough, rooms().camera_from_lidar, {}}, rooms().pairs);
  ASSERT_TRUE(test::wait_until([this] { return !image()->image().isNull(); }, 60'000));
  QWidget* canvas = image()->viewport();
  const double zoom = image()->zoom();
  const QPoint from = canvas->rect().center();
  QTest::mousePress(canvas, Qt::LeftButton, {}, from);
  QTest::mouseMove(canvas, from + QPoint(20, 0));
  QTest::mouseRelease(canvas, Qt::LeftButton, {}, from + QPoint(20, 0));
  // Near the middle a point moves as far as the cursor.
  const Camera& camera = rooms().camera;
  EXPECT_NEAR(value(1), 1e3 * 20.0 / zoom / camera.fx, 2.0);
  EXPECT_NEAR(value(0), 0.0, 0.5);
  QTest::mousePress(canvas, Qt::LeftButton, Qt::ControlModifier, from);
  QMouseEvent move(QEvent::MouseMove, QPointF(from + QPoint(0, 10)),
                   canvas->mapToGlobal(QPointF(from + QPoint(0, 10))), Qt::LeftButton,
                   Qt::LeftButton, Qt::ControlModifier);
  QApplication::sendEvent(canvas, &move);
  QTest::mouseRelease(canvas, Qt::LeftButton, Qt::ControlModifier, from + QPoint(0, 10));
  EXPECT_GT(value(4), 5.0);  // Some metres ahead, down by pixels.
}

TEST_F(CheckDialogTest, SaysWhyAFolderCannotBeUsed) {
  show(turned(0.0), {});
  QTemporaryDir empty;
  answers_.files = empty.path();
  find<QPushButton>(*dialog_, "check_folder")->click();
  ASSERT_TRUE(says(empty.path())) << verdict().toStdString();
}

}  // namespace
}  // namespace lvcalib::widgets::check_dialog_test
