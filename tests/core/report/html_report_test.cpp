// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/html_report.h"

#include <cctype>
#include <fstream>
#include <regex>
#include <stack>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/discovery_file.h"
#include "report/exports.h"
#include "report/result_file.h"
#include "support/ordinary_boards.h"
#include "support/simulated_dataset.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Tags open and close in order; void elements and the doctype aside. Names what is wrong.
// Written as a scan: std::regex recurses once per character and an embedded image is one attribute.
std::string nesting_error(const std::string& html) {
  std::stack<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find_first_of("<>", at + 1);
    if (end == std::string::npos || html[end] == '<') continue;
    const bool closes = html[at + 1] == '/';
    const std::size_t first = at + (closes ? 2 : 1);
    std::size_t last = first;
    while (last < end && std::isalnum(static_cast<unsigned char>(html[last])) != 0) ++last;
    if (last == first || html[end - 1] == '/') continue;
    const std::string name = html.substr(first, last - first);
    if (!closes) {
      open.push(name);
    } else if (open.empty() || open.top() != name) {
      return "</" + name + "> closes " + (open.empty() ? "nothing" : "<" + open.top() + ">");
    } else {
      open.pop();
    }
  }
  return open.empty() ? "" : "<" + open.top() + "> stays open";
}

class HtmlReportTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new test::SimulatedDataset(test::dataset_options(1, 3));
    auto result = calibrate(data_->open(), {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    result_ = new CalibrationResult(std::move(*result));
  }
  static void TearDownTestSuite() {
    delete result_;
    delete data_;
  }
  static test::SimulatedDataset* data_;
  static CalibrationResult* result_;
  test::TemporaryFolder out_;
};
test::SimulatedDataset* HtmlReportTest::data_ = nullptr;
CalibrationResult* HtmlReportTest::result_ = nullptr;

// What a search that found range walk would hand over.
Discovery example_discovery() {
  Discovery d;
  ChannelSummary range{Channel::kRange, 4321, 9.5, 8.25, 4.75, 9.6};
  d.channels = {range};
  d.history.push_back({"", {range}, {}});
  range.rms = 8.3125;
  range.unexplained = 0.625;
  d.history.push_back({"range_walk", {range}, {}});
  EffectFinding found;
  found.id = "range_walk";
  found.verdict = EffectVerdict::kPresent;
  found.parameters = {{"a", "mm", 1e-3, 0.00812, 0.00013}};
  found.heldout_gain = 0.42;
  found.explanation = Message("Dark print reads far & wide.");
  EffectFinding unseen;
  unseen.id = "range_offset";
  unseen.verdict = EffectVerdict::kNotTestable;
  unseen.parameters = {{"a", "mm", 1e-3, 0.0, 0.004}};
  unseen.extrinsic_move_mm = 8.765;
  unseen.unabsorbed_share = 0.006;
  unseen.explanation = Message("These scenes could not show it.");
  d.effects = {found, unseen};
  d.selected = {"range_walk"};
  BudgetItem limit;
  limit.id = "range_offset";
  limit.parameter = "a";
  limit.unit = "mm";
  limit.size = 6.58;
  limit.translation_mm = 8.765;
  limit.rotation_mrad = 0.125;
  d.budget = {limit};
  d.advice = {Message("Take one more scene at 60 degrees.")};
  return d;
}

TEST_F(HtmlReportTest, TellsTheModelAndWhatItStillMisses) {
  ASSERT_TRUE(write_results(*result_, out_.path()).ok());
  const auto without = html_report(out_.path(), {});
  ASSERT_TRUE(without.ok());
  EXPECT_THAT(without->html, HasSubstr("Missing effects were not looked for"));
  const Discovery discovery = example_discovery();
  ASSERT_TRUE(write_discovery(discovery, *result_, out_.path()).ok());
  const auto stored = html_report(out_.path(), {});
  ASSERT_TRUE(stored.ok()) << stored.error().text();
  EXPECT_EQ(nesting_error(stored->html), "");
  for (const char* part : {"Error before and after", "8.31", "0.625", "Added: range_walk", "42 %",
                           "far &amp; wide", "What could be there unseen", "a = 6.58 mm", "8.77",
                           "0.125", "0.6 %", "Take one more scene at 60 degrees."}) {
    EXPECT_THAT(stored->html, HasSubstr(part));
  }
  CalibrationResult modelled = *result_;
  modelled.model = {{"range_walk", discovery.effects[0].parameters, 0.0}};
  const auto fresh = html_report(modelled, &discovery, {});
  ASSERT_TRUE(fresh.ok());
  EXPECT_THAT(fresh->html, HasSubstr("8.12"));
  out_.write("discovery.json", "[1, 2");
  EXPECT_FALSE(html_report(out_.path(), {}).ok()) << "a broken file is named, not passed over";
}

TEST_F(HtmlReportTest, HoldsEverySectionAndLoadsNothing) {
  ASSERT_TRUE(write_results(*result_, out_.path()).ok());
  const auto report = html_report(out_.path(), {});
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_TRUE(report->warnings.empty());
  const std::string& html = report->html;
  EXPECT_EQ(nesting_error(html), "");
  for (const char* part : {"Pose", "Uncertainty", "Methods side by side", "Scene A", "Scene C",
                           "Boundary response", "Conventions", "Provenance", "joint_refined",
                           "pnp_raw", "@page { margin", "data:image/jpeg;base64,", "<svg"}) {
    EXPECT_THAT(html, HasSubstr(part));
  }
  // Self-contained: no address, script or style from elsewhere.
  for (const char* foreign : {"http://", "https://", "<script", "<link", "url(", "@import"})
    EXPECT_THAT(html, Not(HasSubstr(foreign)));
  ASSERT_EQ(result_->inputs.size(), 8U);
  for (const InputFile& file : result_->inputs) EXPECT_THAT(html, HasSubstr(file.sha256));
  for (const char* no_number : {">nan", "\"nan", ",nan", " nan", "-nan"})
    EXPECT_THAT(html, Not(HasSubstr(no_number)));
}

// Who reads no further than the first page knows what it is, how good, and what to do.
TEST_F(HtmlReportTest, TheFirstPageConcludesAndSaysNothingTwice) {
  CalibrationResult result = *result_;
  result.quality = Quality::kDoubtful;
  result.quality_reasons = {Message("the board is bowed")};
  result.warnings = {Message("result: the board is bowed"), Message("result: it was dark")};
  result.covariance_total = result.extrinsic.camera_from_lidar.covariance;
  result.covariance_total(0, 0) = 0.0345 * 0.0345;
  const auto doubtful = html_report(result, nullptr, {});
  ASSERT_TRUE(doubtful.ok());
  const std::string first = doubtful->html.substr(0, doubtful->html.find("<h2>"));
  for (const char* part : {"What was calibrated:", "3 of 3 scenes", "± 3", "Not before",
                           "clouds as the LiDAR gives them", "it was dark", "What to do next:"})
    EXPECT_THAT(first, HasSubstr(part));
  EXPECT_EQ(first.find("bowed"), first.rfind("bowed")) << "said twice";
  EXPECT_TRUE(std::regex_search(first, std::regex("20[0-9]{2}-[0-9]{2}-[0-9]{2}")));
  result.quality = Quality::kGood;
  result.quality_reasons.clear();
  result.verified = true;
  const auto good = html_report(result, nullptr, {});
  ASSERT_TRUE(good.ok());
  EXPECT_THAT(good->html, HasSubstr("Can it be used?</b> Yes."));
  result.verified = false;
  const auto unverified = html_report(result, nullptr, {});
  ASSERT_TRUE(unverified.ok());
  EXPECT_THAT(unverified->html, HasSubstr("larger of the two errors"));
}

TEST_F(HtmlReportTest, IsTheSameOfAStoredAndOfAFreshResult) {
  ASSERT_TRUE(write_results(*result_, out_.path()).ok());
  const auto stored = html_report(out_.path(), {});
  const auto fresh = html_report(*result_, nullptr, {});
  ASSERT_TRUE(stored.ok() && fresh.ok());
  EXPECT_EQ(stored->html, fresh->html);
  const auto read = read_export_input(out_.path() / "result.json");
  ASSERT_TRUE(read.ok()) << read.error().text();
  for (const ExportFormat& format : export_formats()) {
    if (format.needs_imu) continue;
    const auto a = export_result(*read, format.name);
    const auto b = export_result(export_input_of(*result_), format.name);
    ASSERT_EQ(a.ok(), b.ok()) << format.name;
    if (a.ok()) {
      EXPECT_EQ(*a, *b);
    }
  }
}

// Whose results have no circles, no nodes and no boundary response.
TEST_F(HtmlReportTest, BoardsWithoutCirclesHaveAReportInTheirWords) {
  struct Case {
    Target target;
    const char* origin;
    bool tags;
  };
  for (const Case& c :
       {Case{test::checkerboard_target(), "origin at the first inner corner", false},
        Case{test::charuco_target(), "origin at the lower left inner corner", true},
        Case{test::single_tag_target(), "origin at the outer lower-left corner", true}}) {
    SCOPED_TRACE(c.origin);
    simulation::SimulationOptions options = test::dataset_options(3, 3);
    options.target = c.target;
    const test::SimulatedDataset data(options);
    const auto result = calibrate(data.open(), {}, {});
    ASSERT_TRUE(result.ok()) << result.error().text();
    ASSERT_TRUE(write_results(*result, out_.path()).ok());
    const auto report = html_report(out_.path(), {});
    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_THAT(report->html, HasSubstr(c.origin));
    EXPECT_THAT(report->html, HasSubstr("Scene A"));
    EXPECT_THAT(report->html, Not(HasSubstr("Circles (orange)")));
    EXPECT_THAT(report->html, Not(HasSubstr("nodes widened")));
    EXPECT_THAT(report->html, Not(HasSubstr("0 tags")));
    EXPECT_EQ(report->html.find(" tags, ") != std::string::npos, c.tags);
    EXPECT_EQ(nesting_error(report->html), "");
  }
}

TEST_F(HtmlReportTest, TextIsEscapedAndAMissingDatasetIsSaid) {
  CalibrationResult result = *result_;
  result.dataset = "/nowhere/<b>&\"";
  result.warnings.push_back(Message("5 < 6 & <script>"));
  ASSERT_TRUE(write_results(result, out_.path()).ok());
  const auto report = html_report(out_.path(), {});
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->warnings.size(), 3U);
  EXPECT_THAT(report->html, HasSubstr("5 &lt; 6 &amp; &lt;script&gt;"));
  EXPECT_THAT(report->html, Not(HasSubstr("<script")));
  EXPECT_EQ(nesting_error(report->html), "");
}

TEST_F(HtmlReportTest, ABadResultFileIsRefused) {
  EXPECT_FALSE(html_report(out_.path(), {}).ok());
  for (const char* text : {"", "[]", "{}", "{\"quality\": 3}", "{\"quality\": \"good\""}) {
    std::ofstream(out_.path() / "result.json") << text;
    const auto report = html_report(out_.path(), {});
    ASSERT_FALSE(report.ok()) << text;
    EXPECT_EQ(report.error().kind, ErrorKind::kInput);
  }
  // Every key that may be missing.
  ASSERT_TRUE(write_results(*result_, out_.path()).ok());
  std::ifstream stream(out_.path() / "result.json");
  const auto whole = nlohmann::json::parse(stream);
  for (const auto& [key, value] : whole.items()) {
    auto less = whole;
    less.erase(key);
    std::ofstream(out_.path() / "result.json") << less.dump();
    const auto report = html_report(out_.path(), {});
    if (report.ok()) continue;
    EXPECT_EQ(report.error().kind, ErrorKind::kInput) << key;
  }
}

TEST_F(HtmlReportTest, StopsWhenAsked) {
  ASSERT_TRUE(write_results(*result_, out_.path()).ok());
  std::stop_source source;
  source.request_stop();
  RunContext context;
  context.stop = source.get_token();
  const auto report = html_report(out_.path(), context);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().kind, ErrorKind::kCancelled);
}

// What calibrate leaves in result.json for everything downstream.
TEST_F(HtmlReportTest, TheResultFileHoldsTheEvidence) {
  const auto j = nlohmann::json::parse(result_as_json(*result_));
  ASSERT_EQ(j["methods"].size(), 10U);
  EXPECT_FALSE(j.contains("ablation"));  // Nobody asked for it.
  for (const auto& m : j["methods"]) {
    EXPECT_EQ(m["scenes"].size(), 3U);
    EXPECT_EQ(m["box_mm"].size(), 5U);
    EXPECT_TRUE(m["heldout_mm"].is_number());
    EXPECT_EQ(m["T_camera_lidar"].size(), 4U);
  }
  EXPECT_EQ(j["methods"][7]["name"], "joint_refined");
  EXPECT_EQ(j["methods"][8]["name"], "joint_paper");
  EXPECT_EQ(j["methods"][9]["name"], "forward_model");
  EXPECT_NEAR(j["methods"][9]["rms_px"].get<double>(), j["rms_px"].get<double>(), 1e-3);
  // The result is that of the forward model, and what it measured stands beside it.
  EXPECT_EQ(j["methods"][9]["T_camera_lidar"], j["T_camera_lidar"]["matrix"]);
  EXPECT_EQ(j["applies_to"], "raw");
  EXPECT_GT(j["dof"].get<double>(), 1.0);
  EXPECT_GT(j["footprint"]["covariance_mrad2"][0][0].get<double>(), 0.5);
  EXPECT_LT(j["footprint"]["sigma_mrad2"][0].get<double>(), 0.2);
  EXPECT_TRUE(j["refused"].is_array());
  const auto& response = j["boundary_response"];
  ASSERT_EQ(response["scenes"].size(), 3U);
  for (const char* key : {"n", "mean_pitch_deg", "mean_yaw_deg", "mean_range_mm", "std_pitch_deg",
                          "std_yaw_deg", "std_range_mm"}) {
    EXPECT_TRUE(response["all"].contains(key)) << key;
    EXPECT_TRUE(response["scenes"][0].contains(key)) << key;
  }
  EXPECT_EQ(response["all"]["covariance"].size(), 3U);
  for (const char* key : {"mu_in", "mu_out", "delta_mm", "sigma_mm"})
    EXPECT_TRUE(response["transition"].contains(key)) << key;
  EXPECT_TRUE(j["uncertainty"].contains("split_half_reason"));
  EXPECT_TRUE(j["timing_ms"].contains("response"));
  EXPECT_EQ(j["camera"]["distortion_model"], "plumb_bob");
}

}  // namespace
}  // namespace lvcalib
