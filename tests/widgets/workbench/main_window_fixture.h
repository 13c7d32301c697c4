// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTemporaryDir>
#include <memory>

#include <gtest/gtest.h>

#include "runner/demo.h"
#include "widgets/support/driver.h"
#include "workbench/main_window.h"

namespace lvcalib::test {

inline simulation::SimulationOptions small_demo() {
  simulation::SimulationOptions options;
  options.seed = 3;
  options.scenes = 3;
  options.lidar.points = 100'000;
  options.image.width_px = 800;
  options.image.height_px = 500;
  return options;
}

/// A window with settings of its own; all cases share one simulated dataset.
class MainWindowTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new QTemporaryDir;
    ASSERT_TRUE(widgets::make_demo(dataset().toStdString(), small_demo(), {}).ok());
  }
  static void TearDownTestSuite() {
    delete data_;
    EXPECT_TRUE(widgets::Runner::wait_for_workers(60'000));
  }
  static QString dataset() { return data_->filePath(QStringLiteral("dataset")); }

  void SetUp() override {
    settings_ = std::make_unique<widgets::AppSettings>(folder_.path());
    window_ = std::make_unique<widgets::MainWindow>(*settings_, answers_);
    window_->show();
  }
  void open() {
    answers_.dataset = dataset();
    ASSERT_TRUE(trigger(*window_, "open_dataset"));
    ASSERT_TRUE(wait_until([&] { return workspace().is_open() && !workspace().busy(); }));
  }
  void run() {
    open();
    QTest::keyClick(window_.get(), Qt::Key_F5);
    ASSERT_TRUE(wait_for_result(*window_));
  }
  widgets::Workspace& workspace() { return window_->workspace(); }
  Eigen::Matrix4d pose() {
    return workspace().result()->extrinsic.camera_from_lidar.transform.matrix();
  }

  static inline QTemporaryDir* data_ = nullptr;
  QTemporaryDir folder_;
  Answers answers_;
  std::unique_ptr<widgets::AppSettings> settings_;
  std::unique_ptr<widgets::MainWindow> window_;
};

}  // namespace lvcalib::test
