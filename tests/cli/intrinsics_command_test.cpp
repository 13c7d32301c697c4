// SPDX-License-Identifier: GPL-3.0-or-later
// intrinsics, as a user runs it: a camera from images of the board, and what can be wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "camera/camera_deviations.h"
#include "cli/child_process.h"
#include "cli/good_dataset.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"

namespace lvcalib::testing {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

simulation::SimulationOptions image_options() {
  simulation::SimulationOptions options;
  options.seed = 31;
  options.scenes = 6;
  options.lidar.points = 500;  // Nobody looks at the clouds.
  options.image.width_px = 800;
  options.image.height_px = 600;
  options.placement.min_distance_m = 1.2;
  options.placement.max_distance_m = 2.2;
  options.placement.max_tilt_deg = 45.0;
  return options;
}

// A rig of which the images are used, simulated once. Not to be written to.
const simulation::SimulatedRig& rig() {
  static const simulation::SimulatedRig simulated = [] {
    auto made = simulation::simulate(image_options(), {});
    if (!made) throw std::runtime_error(made.error().text());
    return std::move(*made);
  }();
  return simulated;
}

class IntrinsicsCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(images());
    write_file(images() / "target.yaml", to_yaml(rig().target));
  }
  void write_images(std::size_t count) const {
    for (std::size_t k = 0; k < count; ++k)
      write_file(images() / (rig().scenes[k].name + ".png"),
                 *simulation::encode_png(rig().scenes[k].image));
  }
  [[nodiscard]] fs::path images() const { return folder_.path() / "images"; }
  [[nodiscard]] fs::path output() const { return folder_.path() / "new" / "camera.yaml"; }
  [[nodiscard]] Outcome intrinsics(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"intrinsics", images(), "-o", output()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lvcalib(arguments);
  }
  void expect_refused(const Outcome& outcome, int status, const std::string& what) const {
    expect_refusal(outcome, status, what, output());
    EXPECT_TRUE(unfinished_files(folder_.path()).empty());
  }
  TemporaryFolder folder_{"intrinsics"};
};

TEST_F(IntrinsicsCommand, WritesACameraWithItsStandardDeviations) {
  write_images(6);
  write_file(images() / "note.png", "this is no image");
  const Outcome outcome = intrinsics();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(lines_of(outcome.out).size(), 1U);
  EXPECT_THAT(outcome.out, HasSubstr("6 of 7 images"));
  EXPECT_THAT(outcome.out, HasSubstr("plumb_bob"));
  EXPECT_THAT(outcome.err, HasSubstr("note.png"));
  const auto camera = read_camera(output());
  ASSERT_TRUE(camera.ok()) << camera.error().text();
  EXPECT_TRUE(camera->warnings.empty());
  const auto sigma = read_camera_deviations(output(), camera->camera);
  ASSERT_TRUE(sigma.ok() && sigma->has_value());
  const Camera& truth = rig().camera;
  EXPECT_GT((**sigma)(0), 0.0);
  EXPECT_LT((**sigma)(0), 0.01 * truth.fx);
  EXPECT_NEAR(camera->camera.fx, truth.fx, 4.0 * (**sigma)(0));
  EXPECT_NEAR(camera->camera.cx, truth.cx, 4.0 * (**sigma)(2));
  EXPECT_GE((**sigma)(8), 0.0);
}

TEST_F(IntrinsicsCommand, TakesADatasetAndAModel) {
  const fs::path dataset = folder_.path() / "dataset";
  const Status written = simulation::write_dataset(rig(), dataset);
  ASSERT_TRUE(written.ok());
  // In place of the one that is there: it is not read.
  const Outcome outcome = run_lvcalib({"intrinsics", dataset, "-o", dataset / "camera.yaml",
                                       "--model", "rational_polynomial", "--quiet"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto camera = read_camera(dataset / "camera.yaml");
  ASSERT_TRUE(camera.ok());
  EXPECT_EQ(camera->camera.model, DistortionModel::kRationalPolynomial);
}

TEST_F(IntrinsicsCommand, AnEmptyFolder) {
  expect_refused(intrinsics(), 3, "no images");
  fs::remove_all(images());
  expect_refused(intrinsics(), 3, "folder not found");
}

TEST_F(IntrinsicsCommand, NoTarget) {
  write_images(1);
  fs::remove(images() / "target.yaml");
  expect_refused(intrinsics(), 3, "target.yaml");
  EXPECT_THAT(intrinsics().err, HasSubstr("--target"));
}

// The first scene faces the camera.
TEST_F(IntrinsicsCommand, OneImage) {
  write_images(1);
  expect_refused(intrinsics(), 1, "do not determine the focal length");
}

TEST_F(IntrinsicsCommand, TextAsImage) {
  write_file(images() / "a.png", "this is no image");
  expect_refused(intrinsics(), 3, "a.png");
}

TEST_F(IntrinsicsCommand, ImagesOfTwoSizes) {
  write_images(2);
  simulation::SimulatedImage other = rig().scenes[2].image;
  other.height_px -= 8;
  other.pixels.resize(static_cast<std::size_t>(other.width_px * other.height_px));
  write_file(images() / "z.png", *simulation::encode_png(other));
  expect_refused(intrinsics(), 3, "z.png");
  EXPECT_THAT(intrinsics().err, HasSubstr("800 × 592"));
}

TEST_F(IntrinsicsCommand, WrongUsage) {
  write_images(1);
  expect_refused(intrinsics({"--model", "fish"}), 2, "plumb_bob");
  EXPECT_EQ(run_lvcalib({"intrinsics", images()}).status, 2);
  const fs::path image = images() / (rig().scenes[0].name + ".png");
  const std::string before = read_file(image);
  const Outcome outcome = run_lvcalib({"intrinsics", images(), "-o", image});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the output is the input itself"));
  EXPECT_EQ(read_file(image), before);
  EXPECT_EQ(run_lvcalib({"intrinsics", images(), "-o", images()}).status, 2);
  expect_refused(intrinsics({"--camera", images() / "none.yaml"}), 3, "none.yaml");
}

}  // namespace
}  // namespace lvcalib::testing
