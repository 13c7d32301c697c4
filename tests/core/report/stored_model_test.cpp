// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/stored_model.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/result_file.h"
#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

CalibrationResult with_two_effects() {
  CalibrationResult result;
  result.model.push_back({"range_walk", {{"a", "mm", 1e-3, 0.0095, 0.0002}}, 2.25});
  result.model.push_back({"channel_range_offset",
                          {{"a2", "mm", 1e-3, 0.004, 0.001}, {"a7", "mm", 1e-3, -0.004, 0.001}},
                          0.0});
  result.model_scales.level = {120.0, 11.0};
  result.model_scales.log_contrast = 2.39;
  result.model_scales.darkness_low = -0.1;
  result.model_scales.darkness_high = 1.2;
  result.model_scales.incidence_high_rad = 0.9;
  result.model_scales.lines = {2, 7};
  return result;
}

TEST(StoredModel, ReadsBackWhatAResultFileHolds) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("result.json", result_as_json(with_two_effects()));
  const auto model = read_model(path);
  ASSERT_TRUE(model.ok()) << model.error().text();
  ASSERT_EQ(model->effects.size(), 2U);
  EXPECT_EQ(model->effects[0].effect, find_effect("range_walk"));
  EXPECT_DOUBLE_EQ(model->effects[0].shape, 2.25);
  EXPECT_NEAR(model->effects[0].values(0), 0.0095, 1e-15);
  EXPECT_NEAR(model->effects[1].values(1), -0.004, 1e-15);
  const ModelScales expected = with_two_effects().model_scales;
  EXPECT_EQ(model->scales.level, expected.level);
  EXPECT_EQ(model->scales.lines, expected.lines);
  EXPECT_EQ(model->scales.darkness_low, expected.darkness_low);
  EXPECT_EQ(model->scales.darkness_high, expected.darkness_high);
  EXPECT_EQ(model->scales.log_contrast, expected.log_contrast);
  EXPECT_EQ(model->scales.incidence_high_rad, expected.incidence_high_rad);
}

TEST(StoredModel, OfAPlainCalibrationIsEmpty) {
  const test::TemporaryFolder folder;
  const auto model = read_model(folder.write("result.json", result_as_json({})));
  ASSERT_TRUE(model.ok()) << model.error().text();
  EXPECT_TRUE(model->effects.empty());
}

struct Spoiled {
  std::string name;
  std::function<void(json&)> spoil;
  std::string message;
};
std::ostream& operator<<(std::ostream& out, const Spoiled& s) {
  return out << s.name;
}

class SpoiledModel : public ::testing::TestWithParam<Spoiled> {};

TEST_P(SpoiledModel, IsNamedWithItsKey) {
  const test::TemporaryFolder folder;
  json j = json::parse(result_as_json(with_two_effects()));
  GetParam().spoil(j);
  const auto path = folder.write("result.json", j.dump());
  const auto model = read_model(path);
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().kind, ErrorKind::kInput);
  EXPECT_EQ(model.error().where, path.string());
  EXPECT_THAT(model.error().text(), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Files, SpoiledModel,
    ::testing::Values(
        Spoiled{"NoModel", [](json& j) { j.erase("model"); }, "holds no model"},
        Spoiled{"ModelIsText", [](json& j) { j["model"] = "x"; }, "holds no model"},
        Spoiled{"NoEffects", [](json& j) { j["model"].erase("effects"); }, "model.effects"},
        Spoiled{"NoScales", [](json& j) { j["model"].erase("scales"); }, "model.scales"},
        Spoiled{"ScaleIsText", [](json& j) { j["model"]["scales"]["log_contrast"] = "x"; },
                "model.scales.log_contrast"},
        Spoiled{"DarknessTurnedRound",
                [](json& j) {
                  j["model"]["scales"]["darkness"] = {1, 0};
                },
                "model.scales.darkness"},
        Spoiled{"LinesUnsorted",
                [](json& j) {
                  j["model"]["scales"]["lines"] = {7, 2};
                },
                "model.scales.lines"},
        Spoiled{"UnknownEffect", [](json& j) { j["model"]["effects"][0]["id"] = "range_wlak"; },
                "did you mean 'range_walk'"},
        Spoiled{"NoId", [](json& j) { j["model"]["effects"][1].erase("id"); },
                "model.effects[1].id"},
        Spoiled{"ParameterMissing",
                [](json& j) { j["model"]["effects"][1]["parameters"].erase(0); },
                "2 parameters that 'channel_range_offset' has"},
        Spoiled{"ValueIsNull",
                [](json& j) { j["model"]["effects"][0]["parameters"][0]["value"] = nullptr; },
                "model.effects[0].parameters[0]"},
        Spoiled{"OtherUnit",
                [](json& j) { j["model"]["effects"][0]["parameters"][0]["unit"] = "m"; },
                "is not a value of 'a' in mm"},
        Spoiled{"OtherName",
                [](json& j) { j["model"]["effects"][1]["parameters"][0]["name"] = "a3"; }, "'a2'"}),
    [](const auto& info) { return info.param.name; });

TEST(StoredModel, FilesThatAreNoResultsAreNamed) {
  const test::TemporaryFolder folder;
  for (const char* text : {"", "[1]", "{\"model\": ", "hello"}) {
    const auto model = read_model(folder.write("result.json", text));
    ASSERT_FALSE(model.ok()) << text;
    EXPECT_THAT(model.error().text(), HasSubstr("result.json: "));
  }
  EXPECT_THAT(read_model(folder.path() / "no.json").error().text(), HasSubstr("not found"));
}

TEST(PoseUse, AModelThatIsNotWholePromisesNothingOfRawClouds) {
  CalibrationResult result;
  EXPECT_FALSE(pose_use(result).corrected);
  result.model = {{"range_walk", {{"a", "mm", 1e-3, 0.01, 0.001}}}};
  EXPECT_TRUE(pose_use(result).corrected);
  EXPECT_EQ(pose_use(result).model.text(), "Base model + Range walk");
  EXPECT_EQ(pose_use(result).effects.front().text(), "Range walk: a = 10 mm");
  result.model = {{"corner_bias", {{"b", "px", 1.0, 0.1, 0.01}}}};
  EXPECT_FALSE(pose_use(result).corrected) << "the points stay where they are";
  result.model_scales.log_contrast = std::nan("");
  EXPECT_TRUE(pose_use(result).corrected);
  EXPECT_EQ(pose_use(result).model.text(), "Base model + corner_bias");
}

}  // namespace
}  // namespace lvcalib
