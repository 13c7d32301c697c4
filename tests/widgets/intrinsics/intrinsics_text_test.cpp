// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsics/intrinsics_text.h"

#include <QGuiApplication>
#include <QTextDocument>

#include <gtest/gtest.h>

namespace lvcalib::widgets::intrinsics_text_test {
namespace {

QString plain(const QString& html) {
  QTextDocument document;
  document.setHtml(html);
  return document.toPlainText();
}

Camera given() {
  Camera camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx = camera.fy = 500.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

TEST(IntrinsicsText, EachCameraHasAColumnAndItsStandardDeviations) {
  const Camera camera = given();
  CameraDeviations stated = CameraDeviations::Constant(-1.0);
  stated(0) = 0.25;
  CameraCalibration alone;
  alone.camera = camera;
  alone.camera.fx = 512.3456;
  alone.camera.model = DistortionModel::kEquidistant;
  alone.sigma(0) = 0.0321;
  CameraKnowledge known;
  known.given = &camera;
  known.stated = &stated;
  known.alone = &alone;
  const QString text = plain(intrinsics_table(known));
  EXPECT_TRUE(text.contains("500.00 ± 0.25")) << text.toStdString();
  EXPECT_TRUE(text.contains("512.346 ± 0.032")) << text.toStdString();
  // What is not stated has no ±.
  EXPECT_TRUE(text.contains("319.50\n")) << text.toStdString();
  EXPECT_EQ(text.count("±"), 2);
  // Five entries of one model, four of the other.
  EXPECT_EQ(text.count("k1"), 2);
  EXPECT_EQ(text.count("p1"), 1);
  EXPECT_EQ(text.count("k4"), 1);
  EXPECT_TRUE(intrinsics_table({}).isEmpty());
}

TEST(IntrinsicsText, AContradictionSaysWhatItDoesToTheExtrinsic) {
  CalibrationResult result;
  result.camera = given();
  result.verified = true;
  const QPalette palette = QGuiApplication::palette();
  CameraFigures figures;
  EXPECT_FALSE(plain(camera_verdict(result, figures, palette)).contains("contradict"));
  result.intrinsics.contradiction.emplace();
  result.intrinsics.contradiction->what = Message("the focal length is %1 % too long", "3.0");
  result.intrinsics.contradiction->camera_from_lidar.emplace();
  result.intrinsics.contradiction->move_mm = 42.0;
  figures.unreached = {Message("top left")};
  const QString text = plain(camera_verdict(result, figures, palette));
  EXPECT_TRUE(text.contains("the focal length is 3.0 % too long")) << text.toStdString();
  EXPECT_TRUE(text.contains("42")) << text.toStdString();
  EXPECT_TRUE(text.contains("top left")) << text.toStdString();
}

TEST(IntrinsicsText, DistortionModelsAreComparedInWords) {
  CameraCalibration alone;
  alone.predictions = {{DistortionModel::kPlumbBob, 0.42}, {DistortionModel::kEquidistant, 0.051}};
  alone.warnings = {Message("no board reached these parts of the image")};
  const QString text = plain(camera_verdict(alone, {}, QGuiApplication::palette()));
  EXPECT_TRUE(text.contains("plumb_bob 0.420 px, equidistant 0.051 px")) << text.toStdString();
  EXPECT_TRUE(text.contains("no board reached"));
}

}  // namespace
}  // namespace lvcalib::widgets::intrinsics_text_test
