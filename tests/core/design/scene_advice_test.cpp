// SPDX-License-Identifier: GPL-3.0-or-later
#include "design/scene_advice.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "selection/findings.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// By hand: unknowns (nuisance 1, A, B) with rows x = (1, a, b).
Eigen::MatrixXd information(std::initializer_list<Eigen::Vector3d> rows) {
  Eigen::MatrixXd h = 1e-9 * Eigen::MatrixXd::Identity(3, 3);
  for (const Eigen::Vector3d& r : rows) h += r * r.transpose();
  return h;
}

TEST(TOptimality, IsZeroForTwinsAndGrowsWithTheRowThatTells) {
  const InformationBlock a{1, 1};
  const InformationBlock b{2, 1};
  const std::vector<InformationBlock> rest{{0, 1}};
  const Eigen::VectorXd value = Eigen::VectorXd::Constant(1, 2.0);
  const auto twins = information({{1, 0, 0}, {1, 1, 1}});
  EXPECT_NEAR(t_optimality(twins, twins, a, b, rest, value), 0.0, 1e-6);
  // Rows that see A alone.
  const auto weak = information({{1, 0, 0}, {1, 1, 1}, {0, 0.5, 0}});
  const auto strong = information({{1, 0, 0}, {1, 1, 1}, {0, 2, 0}});
  EXPECT_GT(t_optimality(twins, weak, a, b, rest, value), 0.01);
  EXPECT_GT(t_optimality(twins, strong, a, b, rest, value),
            t_optimality(twins, weak, a, b, rest, value));
}

TEST(TOptimality, NoncentralityIsWhatIsLeftOfTheEffect) {
  // y = θ at one row, and the nuisance is known from another only to 1: ½ θ² is left.
  const auto h = information({{1, 0, 0}, {1, 1, 0}});
  EXPECT_NEAR(noncentrality(h, {1, 1}, {{0, 1}}, Eigen::VectorXd::Constant(1, 3.0)), 4.5, 1e-6);
}

std::vector<std::string> advice_for(const EffectSearch& search,
                                    const std::vector<EffectFinding>& findings,
                                    const DiscoveryOptions& options, const RunContext& context) {
  std::vector<std::string> out;
  for (const Message& advice :
       advise_scenes(scenes_taken(search), open_questions(search, findings), options.grid, context))
    out.push_back(advice.text());
  return out;
}

TEST(AdviseScenes, NamesAPoseThatShowsWhatIsUnseen) {
  const auto made = test::synthetic_table({});
  const DiscoveryOptions options;
  const RunContext context;
  EffectSearch search(made.table, made.truth, options, context);
  search.rank();
  auto findings = judge_effects(search, {}, options);
  const auto advice = advice_for(search, findings, options, context);
  ASSERT_FALSE(advice.empty());
  // Every sentence names a place for the board or what to measure instead.
  for (const std::string& a : advice) {
    const bool pose = a.find("with the board at ") != std::string::npos;
    const bool measure = a.find("measure instead") != std::string::npos;
    EXPECT_TRUE(pose != measure) << a;
  }
}

// A window says the title of an effect, not what one types for it.
TEST(AdviseScenes, NamesEffectsSoThatTheyCanBeTranslated) {
  const auto made = test::synthetic_table({});
  const DiscoveryOptions options;
  const RunContext context;
  EffectSearch search(made.table, made.truth, options, context);
  search.rank();
  const auto findings = judge_effects(search, {}, options);
  int named = 0;
  for (const Message& advice : advise_scenes(scenes_taken(search), open_questions(search, findings),
                                             options.grid, context)) {
    if (!advice.text().starts_with("To see whether there is ")) continue;
    ++named;
    EXPECT_TRUE(advice.arguments()[0].arguments()[0].translatable()) << advice.text();
  }
  EXPECT_GT(named, 0);
}

TEST(AdviseScenes, StopsWhenAsked) {
  const auto made = test::synthetic_table({});
  const DiscoveryOptions options;
  std::stop_source stop;
  RunContext context;
  context.stop = stop.get_token();
  EffectSearch search(made.table, made.truth, options, context);
  search.rank();
  const auto findings = judge_effects(search, {}, options);
  stop.request_stop();
  EXPECT_TRUE(advice_for(search, findings, options, context).empty());
}

TEST(AdviseScenes, TellsAliasesApartOrSaysThatNothingWill) {
  // A print that grew is the same as a LiDAR whose ranges shrank, whatever the pose.
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.004 * beam.range_m; };
  const auto made = test::synthetic_table({}, wrong);
  const DiscoveryOptions options;
  const RunContext context;
  EffectSearch search(made.table, made.truth, options, context);
  search.add(find_effect("range_scale"), 0.0);
  search.rank();
  Selection scale{"range_scale", {"print_scale"}, 0.0, 0.0, 1.0};
  const auto advice = advice_for(search, judge_effects(search, {scale}, options), options, context);
  EXPECT_THAT(advice, Contains(HasSubstr("range_scale from print_scale")));
}

}  // namespace
}  // namespace lvcalib
