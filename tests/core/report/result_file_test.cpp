// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/result_file.h"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "base/yaml_file.h"
#include "report/exports.h"
#include "support/pose_matchers.h"
#include "support/synthetic_observations.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// A result as the pipeline leaves it: two used scenes solved from synthetic observations, and one
// that was left out, with a name and a reason that need quoting.
CalibrationResult sample_result() {
  CalibrationResult result;
  result.dataset = "/data/a \"quoted\" folder: #1";
  result.camera = test::test_camera();
  auto observations =
      test::observed_scenes(3, result.target, result.camera, test::test_extrinsic(), {}, 1);
  auto solution = solve_extrinsic({observations, result.camera, result.target, {}});
  if (!solution) {
    ADD_FAILURE() << solution.error().text();
    return result;
  }
  result.extrinsic = *solution;
  for (std::size_t s = 0; s < observations.size(); ++s) {
    SceneResult scene;
    scene.name = observations[s].name;
    scene.used = true;
    scene.view.emplace();
    scene.view->tag_count = 16;
    scene.view->camera_from_board.transform = observations[s].camera_from_board;
    scene.refinement.emplace();
    scene.refinement->plane = observations[s].plane;
    scene.refinement->lidar_from_board = observations[s].lidar_from_board;
    scene.refinement->nodes = observations[s].nodes;
    scene.refinement->converged = true;
    scene.refinement->board_points = 4321;
    scene.refinement->history.resize(3);
    scene.refinement->history[0].max_update_m = 0.004;
    result.scenes.push_back(scene);
  }
  result.scenes[1].refinement->nodes[4].valid = false;
  result.scenes[1].refinement->nodes[4].reason = Message("too few samples");
  SceneResult left_out;
  left_out.name = "Z: \"odd\"\n#name";
  left_out.reason = Message("no tags: image\tis 'black' \x80");
  result.scenes.push_back(left_out);
  result.quality = Quality::kDoubtful;
  result.warnings = {Message("result: one"), Message("two: \"quoted\" — 3 %")};
  result.times.total_ms = 12.5;
  return result;
}

void expect_keys(const json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

void expect_matrix(const json& rows, std::size_t height, std::size_t width) {
  ASSERT_EQ(rows.size(), height);
  for (const json& row : rows) {
    ASSERT_EQ(row.size(), width);
    for (const json& v : row) EXPECT_TRUE(v.is_number());
  }
}

TEST(ResultJson, HasEveryKeyOfTheFormat) {
  const CalibrationResult result = sample_result();
  const json j = json::parse(result_as_json(result));
  expect_keys(j, {"version", "dataset", "T_camera_lidar", "covariance", "quality", "warnings",
                  "rms_px", "rms_mm", "scenes", "leave_one_out", "timing_ms"});
  expect_keys(j["T_camera_lidar"], {"matrix", "translation_m", "quaternion_xyzw"});
  expect_matrix(j["T_camera_lidar"]["matrix"], 4, 4);
  EXPECT_EQ(j["T_camera_lidar"]["translation_m"].size(), 3U);
  EXPECT_EQ(j["T_camera_lidar"]["quaternion_xyzw"].size(), 4U);
  expect_matrix(j["covariance"], 6, 6);
  EXPECT_EQ(j["quality"], "doubtful");
  EXPECT_EQ(j["warnings"].size(), 2U);
  expect_keys(j["timing_ms"], {"load", "detect", "localize", "refine", "optimize", "total"});
  ASSERT_EQ(j["scenes"].size(), 4U);
  for (std::size_t s = 0; s < 3; ++s) {
    const json& scene = j["scenes"][s];
    expect_keys(scene, {"name", "used", "reason", "tags", "board_points", "T_camera_board",
                        "T_lidar_board", "rms_px", "rms_mm", "refinement", "nodes"});
    expect_matrix(scene["T_camera_board"], 4, 4);
    expect_matrix(scene["T_lidar_board"], 4, 4);
    expect_keys(scene["refinement"], {"converged", "iterations", "max_update_mm"});
    EXPECT_EQ(scene["refinement"]["iterations"], 3);
    EXPECT_EQ(scene["refinement"]["max_update_mm"].size(), 3U);
    EXPECT_NEAR(scene["refinement"]["max_update_mm"][0].get<double>(), 4.0, 1e-9);
    EXPECT_EQ(scene["tags"], 16);
    EXPECT_EQ(scene["board_points"], 4321);
    ASSERT_EQ(scene["nodes"].size(), 9U);
    for (const json& node : scene["nodes"]) {
      expect_keys(node, {"id", "valid", "center_lidar_m", "sigma_mm", "valid_bins"});
      EXPECT_EQ(node["center_lidar_m"].size(), 3U);
    }
    EXPECT_NEAR(scene["nodes"][0]["sigma_mm"].get<double>(), 0.4, 1e-9);
  }
  EXPECT_EQ(j["scenes"][1]["nodes"][4]["valid"], false);
  // A scene that got nowhere has its name and reason all the same.
  expect_keys(j["scenes"][3],
              {"name", "used", "reason", "tags", "board_points", "rms_px", "rms_mm"});
  EXPECT_EQ(j["scenes"][3]["used"], false);
  EXPECT_EQ(j["scenes"][3]["name"], result.scenes[3].name);
  ASSERT_EQ(j["leave_one_out"].size(), 3U);
  expect_keys(j["leave_one_out"][0], {"without", "translation_mm", "rotation_mrad"});
}

TEST(ResultJson, NumbersKeepTheirFullPrecision) {
  const CalibrationResult result = sample_result();
  const json j = json::parse(result_as_json(result));
  const Eigen::Matrix4d m = result.extrinsic.camera_from_lidar.transform.matrix();
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_EQ(j["T_camera_lidar"]["matrix"][r][c].get<double>(),
                m(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)));
    }
  }
  const auto q = j["T_camera_lidar"]["quaternion_xyzw"];
  EXPECT_EQ(q[3].get<double>(), result.extrinsic.camera_from_lidar.transform.rotation.w());
}

// What the frames are called is the user's; exports read it from the file.
TEST(ResultFiles, NameTheFramesAsTheUserDoes) {
  const CalibrationResult result = sample_result();
  EXPECT_EQ(json::parse(result_as_json(result))["frames"],
            (json{{"lidar", "lidar"}, {"camera", "camera"}}));
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_results(result, folder.path(), {"velodyne", "cam0/optical"}).ok());
  const auto text = read_text_file(folder.path() / "result.yaml", 1U << 20U);
  ASSERT_TRUE(text.ok());
  const auto yaml = YamlFile::parse(*text, "result.yaml");
  ASSERT_TRUE(yaml.ok()) << yaml.error().text();
  EXPECT_EQ(yaml->root().find("frames")->find("lidar")->scalar, "velodyne");
  EXPECT_EQ(yaml->root().find("frames")->find("camera")->scalar, "cam0/optical");
  const auto input = read_export_input(folder.path() / "result.json");
  ASSERT_TRUE(input.ok()) << input.error().text();
  EXPECT_EQ(input->lidar_frame, "velodyne");
  EXPECT_EQ(input->camera_frame, "cam0/optical");
  // A file of an older version has none, and what no format takes is none.
  json j = json::parse(result_as_json(result, {"velodyne", "--x"}));
  const auto odd = read_export_input(folder.write("odd.json", j.dump()));
  ASSERT_TRUE(odd.ok()) << odd.error().text();
  EXPECT_EQ(odd->lidar_frame, "velodyne");
  EXPECT_EQ(odd->camera_frame, "camera");
  j.erase("frames");
  const auto old = read_export_input(folder.write("old.json", j.dump()));
  ASSERT_TRUE(old.ok()) << old.error().text();
  EXPECT_EQ(old->lidar_frame, "lidar");
}

TEST(ResultYaml, ParsesAndSaysTheSame) {
  const CalibrationResult result = sample_result();
  const auto yaml = YamlFile::parse(result_as_yaml(result), "result.yaml");
  ASSERT_TRUE(yaml.ok()) << yaml.error().text();
  const YamlValue* pose = yaml->root().find("T_camera_lidar");
  ASSERT_NE(pose, nullptr);
  const auto matrix = yaml->flatten(*pose->find("matrix"), "matrix");
  ASSERT_TRUE(matrix.ok());
  ASSERT_EQ(matrix->size(), 16U);
  const Eigen::Matrix4d m = result.extrinsic.camera_from_lidar.transform.matrix();
  for (int i = 0; i < 16; ++i)
    EXPECT_NEAR((*matrix)[static_cast<std::size_t>(i)], m(i / 4, i % 4), 1e-9);
  EXPECT_EQ(yaml->numbers("covariance", 36)->size(), 36U);
  const auto sigma = yaml->numbers("sigma_translation_mm", 3);
  ASSERT_TRUE(sigma.ok());
  EXPECT_NEAR((*sigma)[0], 1e3 * std::sqrt(result.extrinsic.camera_from_lidar.covariance(0, 0)),
              1e-6);
  EXPECT_EQ(*yaml->string("quality"), "doubtful");
  EXPECT_EQ(*yaml->string("dataset"), result.dataset);
  const YamlValue* scenes = yaml->root().find("scenes");
  ASSERT_NE(scenes, nullptr);
  ASSERT_EQ(scenes->list.size(), 4U);
  EXPECT_EQ(scenes->list[3].find("name")->scalar, result.scenes[3].name);
  ASSERT_EQ(yaml->root().find("warnings")->list.size(), 2U);
  EXPECT_EQ(yaml->root().find("warnings")->list[1].scalar, result.warnings[1].text());
}

TEST(ResultYaml, IsAcceptedAsARoughExtrinsic) {
  const test::TemporaryFolder folder;
  const CalibrationResult result = sample_result();
  const auto rough = read_rough_extrinsic(folder.write("rig.yaml", result_as_yaml(result)));
  ASSERT_TRUE(rough.ok()) << rough.error().text();
  EXPECT_THAT(*rough, test::IsNearPose(result.extrinsic.camera_from_lidar.transform, 1e-5, 1e-5));
}

TEST(WriteResults, WritesBothFilesAndReadsBack) {
  const test::TemporaryFolder folder;
  const CalibrationResult result = sample_result();
  const fs::path out = folder.path() / "new" / "out";
  ASSERT_TRUE(write_results(result, out).ok());
  EXPECT_TRUE(fs::exists(out / "result.yaml"));
  const auto stored = read_result(out / "result.json");
  ASSERT_TRUE(stored.ok()) << stored.error().text();
  EXPECT_THAT(stored->camera_from_lidar,
              test::IsNearPose(result.extrinsic.camera_from_lidar.transform, 1e-9, 1e-5));
  EXPECT_EQ(stored->covariance, result.extrinsic.camera_from_lidar.covariance);
  // Nothing but the two files is left behind.
  EXPECT_EQ(std::distance(fs::directory_iterator(out), fs::directory_iterator()), 2);
  folder.write("file", "");
  const Status blocked = write_results(result, folder.path() / "file" / "out");
  ASSERT_FALSE(blocked.ok());
  EXPECT_EQ(blocked.error().kind, ErrorKind::kOutput);
}

TEST(ReadResult, RefusesWhatIsNoResult) {
  const test::TemporaryFolder folder;
  for (const std::string text :
       {"", "no json", "[1, 2]", "{}", "{\"T_camera_lidar\": 3}", "{\"T_camera_lidar\": {}}",
        "{\"T_camera_lidar\": {\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,0]]}}",
        "{\"T_camera_lidar\": {\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0]]}}",
        "{\"T_camera_lidar\": {\"matrix\": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,\"1\"]]}}",
        "{\"T_camera_lidar\": {\"matrix\": [[1,0,0,1e999],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}}",
        "{\"T_camera_lidar\": {\"matrix\": [[1,0,0,null],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}}",
        "{\"T_camera_lidar\": {\"matrix\": [[5,0,0,0],[0,5,0,0],[0,0,5,0],[0,0,0,1]]}}",
        "{\"T_camera_lidar\": {\"matrix\": [[0,0,0,0],[0,0,0,0],[0,0,0,0],[0,0,0,1]]}}"}) {
    const auto stored = read_result(folder.write("result.json", text));
    ASSERT_FALSE(stored.ok()) << text;
    EXPECT_EQ(stored.error().kind, ErrorKind::kInput);
    EXPECT_THAT(stored.error().where, HasSubstr("result.json")) << text;
  }
  EXPECT_FALSE(read_result(folder.path() / "missing.json").ok());
  EXPECT_FALSE(read_result(folder.path()).ok());
  // A covariance is optional.
  const auto bare = read_result(folder.write(
      "result.json",
      "{\"T_camera_lidar\": {\"matrix\": [[1,0,0,4],[0,1,0,5],[0,0,1,6],[0,0,0,1]]}}"));
  ASSERT_TRUE(bare.ok());
  EXPECT_EQ(bare->camera_from_lidar.translation, Eigen::Vector3d(4, 5, 6));
  EXPECT_TRUE(bare->covariance.isZero(0.0));
}

TEST(ReadTruth, ReadsThreeByFourRowsAndRefusesOtherFiles) {
  const test::TemporaryFolder folder;
  const auto truth =
      read_truth(folder.write("truth.json", "{\"T_CL\": [[0,-1,0,0.1],[0,0,-1,0.2],[1,0,0,0.3]]}"));
  ASSERT_TRUE(truth.ok());
  EXPECT_EQ(truth->translation, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_LT((*truth * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0.1, 0.2, 1.3)).norm(), 1e-12);
  for (const std::string text : {"", "{}", "{\"T_CL\": []}", "{\"T_CL\": [[1,2,3,4],[1,2,3,4]]}",
                                 "{\"T_CL\": [[1,2,3],[1,2,3],[1,2,3]]}", "{\"T_CL\": \"text\"}",
                                 "{\"T_CL\": [[0,0,0,0],[0,0,0,0],[0,0,0,0]]}"}) {
    const auto refused = read_truth(folder.write("truth.json", text));
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
  }
}

TEST(CompareExtrinsics, AnalyticCases) {
  StoredExtrinsic estimate;
  estimate.camera_from_lidar = test::test_extrinsic();
  const ExtrinsicError none = compare_extrinsics(estimate, test::test_extrinsic());
  EXPECT_NEAR(none.translation_mm, 0.0, 1e-9);
  EXPECT_NEAR(none.rotation_mrad, 0.0, 1e-4);
  EXPECT_TRUE(std::isnan(none.normalized(0)));
  // A pure shift of 3, 4 mm.
  Rigid3 truth = test::test_extrinsic();
  truth.translation += Eigen::Vector3d(0.003, 0.0, -0.004);
  estimate.covariance.diagonal().setConstant(1e-6);
  const ExtrinsicError shift = compare_extrinsics(estimate, truth);
  EXPECT_NEAR(shift.translation_mm, 5.0, 1e-9);
  EXPECT_NEAR(shift.rotation_mrad, 0.0, 1e-4);
  EXPECT_NEAR(shift.normalized(0), 3.0, 1e-6);
  EXPECT_NEAR(shift.normalized(2), -4.0, 1e-6);
  // A pure turn of 10 mrad about the camera's y axis, on the left.
  Vector6d xi = Vector6d::Zero();
  xi(4) = 0.010;
  estimate.covariance.diagonal().tail<3>().setConstant(25e-6);
  const ExtrinsicError turn =
      compare_extrinsics(estimate, se3_exp(xi) * estimate.camera_from_lidar);
  EXPECT_NEAR(turn.rotation_mrad, 10.0, 1e-6);
  EXPECT_LT((turn.left_perturbation - xi).norm(), 1e-9);
  EXPECT_NEAR(turn.normalized(4), 2.0, 1e-6);
}

TEST(Version, IsThreeNumbers) {
  EXPECT_THAT(version(), ::testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+.*"));
}

}  // namespace
}  // namespace lvcalib
