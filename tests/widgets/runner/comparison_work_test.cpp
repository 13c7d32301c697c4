// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/comparison_work.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include <gtest/gtest.h>

#include "pipeline/project_file.h"
#include "report/result_file.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"

namespace lvcalib::widgets::comparison_work_test {
namespace {

using Kind = ComparedResult::Kind;

class ComparisonWorkTest : public ::testing::Test {
 protected:
  ComparisonWorkTest() {
    QObject::connect(&work_, &ComparisonWork::ready, &work_,
                     [this](const auto& comparison) { last_ = comparison; });
    QObject::connect(&work_, &ComparisonWork::failed, &work_,
                     [this](const Error& error) { error_ = error.text(); });
  }
  bool answered() {
    return QTest::qWaitFor([this] { return !work_.busy(); }, 120'000);
  }
  QTemporaryDir folder_;
  ComparisonWork work_;
  std::shared_ptr<const Comparison> last_;
  std::string error_;
};

std::shared_ptr<CalibrationResult> result_at(double x_m) {
  auto out = std::make_shared<CalibrationResult>();
  out->extrinsic.camera_from_lidar.transform.translation.x() = x_m;
  SceneResult scene;
  scene.name = "A";
  out->scenes = {scene};
  return out;
}

TEST_F(ComparisonWorkTest, FilesAreReadOnceUntilTheyAreForgotten) {
  const auto folder = folder_.filePath("r").toStdString();
  ASSERT_TRUE(write_results(*result_at(0.5), folder).ok());
  const ComparedResult file{Kind::kFile, 0, QString::fromStdString(folder + "/result.json")};
  const ComparisonBasis basis{result_at(0.2), nullptr, {}, 0, {}};
  const ComparedResult present{Kind::kStep, 0, {}};
  work_.request(basis, present, file);
  ASSERT_TRUE(answered());
  ASSERT_TRUE(last_) << error_;
  EXPECT_NEAR(last_->difference.translation_mm, 300.0, 1e-9);
  ASSERT_EQ(last_->scenes.size(), 1U);
  ASSERT_EQ(last_->shifts.size(), 1U);
  EXPECT_FALSE(last_->shifts[0].has_value());  // Nothing was found in it.
  ASSERT_TRUE(write_results(*result_at(0.6), folder).ok());
  work_.request(basis, present, file);
  ASSERT_TRUE(answered());
  EXPECT_NEAR(last_->difference.translation_mm, 300.0, 1e-9);
  work_.forget(file);
  work_.request(basis, present, file);
  ASSERT_TRUE(answered());
  EXPECT_NEAR(last_->difference.translation_mm, 400.0, 1e-9);
  QFile::remove(file.path);
  work_.forget(file);
  work_.request(basis, present, file);
  ASSERT_TRUE(answered());
  EXPECT_NE(error_.find("result.json"), std::string::npos) << error_;
}

TEST_F(ComparisonWorkTest, AnotherProjectIsCalibratedWhileTheLoopTurns) {
  simulation::SimulationOptions options;
  options.seed = 7;
  options.scenes = 3;
  options.lidar.points = 60'000;
  options.image.width_px = 800;
  options.image.height_px = 500;
  const auto rig = simulation::simulate(options, {});
  ASSERT_TRUE(rig.ok()) << rig.error().text();
  Project project;
  project.dataset = folder_.filePath("rig").toStdString();
  ASSERT_TRUE(simulation::write_dataset(*rig, project.dataset).ok());
  const QString path = folder_.filePath("rig.lvcalib");
  ASSERT_TRUE(write_project(path.toStdString(), project).ok());
  QSignalSpy progressed(&work_, &ComparisonWork::progressed);
  int turns = 0;
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, &timer, [&turns] { ++turns; });
  timer.start(20);
  work_.request({result_at(0.2), nullptr, {}, 0, {}}, {Kind::kStep, 0, {}},
                {Kind::kProject, 0, path});
  ASSERT_TRUE(answered());
  EXPECT_GT(turns, 3);  // The loop went on meanwhile.
  ASSERT_TRUE(last_) << error_;
  EXPECT_GT(progressed.size(), 0);
  EXPECT_EQ(last_->second.scenes.size(), 3U);
  EXPECT_TRUE(last_->second.scenes[0].rms_px.has_value());
  EXPECT_TRUE(last_->second.extrinsic.states_errors());
  EXPECT_EQ(last_->second.dataset, project.dataset.string());
  EXPECT_FALSE(share_scenes(last_->first, last_->second));
}

}  // namespace
}  // namespace lvcalib::widgets::comparison_work_test
