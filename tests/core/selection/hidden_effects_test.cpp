// SPDX-License-Identifier: GPL-3.0-or-later
// Every effect that the simulator can plant in its own physics, hidden in a rig of its own: found
// through images and clouds, measured, and taken out. Small versions of the study.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/model_discovery.h"
#include "report/discovery_file.h"
#include "simulation/disturbances/registry.h"
#include "support/effect_rigs.h"
#include "support/hidden_answer.h"
#include "support/hidden_rig.h"

namespace lvcalib {
namespace {

using test::finding;
using test::summary_of;
using test::with_aliases;
using ::testing::Contains;

bool is_footprint(const std::string& id) {
  const auto& all = test::always_simulated();
  return std::find(all.begin(), all.end(), id) != all.end();
}

// All that can be planted: whoever adds an effect to the simulator adds a case here.
std::vector<std::string> planted_ids(bool footprints) {
  std::vector<std::string> ids;
  for (const simulation::Disturbance& d : simulation::disturbances()) {
    if (!d.id.starts_with("x_") && is_footprint(d.id) == footprints) ids.push_back(d.id);
  }
  return ids;
}

double size_of(const std::string& id) {
  return simulation::find_disturbance(id)->typical;
}

simulation::SimulationOptions rig_with(const std::string& id) {
  constexpr std::uint64_t kSeed = 51;
  auto options = test::effect_rig_options({test::EffectSet::kSingle, {{id, size_of(id)}}, kSeed});
  // A glossy board has to face the beam in several scenes.
  if (id == "specular_lobe") options.placement.max_tilt_deg = 25.0;
  return options;
}

class Hidden : public ::testing::TestWithParam<std::string> {
 protected:
  static void expect_measured(const EffectFinding& f, const simulation::SimulatedRig& rig) {
    for (const auto& [name, truth] : test::true_parameters(f.id, rig)) {
      for (const ParameterEstimate& p : f.parameters) {
        if (p.name != name) continue;
        EXPECT_NEAR(p.value, truth, 3.3 * p.sigma) << f.id << ' ' << name;
      }
    }
    if (f.id == "detector_lag") {
      // An exponential's half is reached after ln 2 of its mean delay, later where a footprint
      // blurs the edge.
      const ParameterEstimate& lag = f.parameters[0];
      const double mean_s = 1e-6 * size_of(f.id);
      EXPECT_GT(lag.value, std::numbers::ln2 * mean_s - 3.3 * lag.sigma);
      EXPECT_LT(lag.value, mean_s + 3.3 * lag.sigma);
    }
  }
};

TEST_P(Hidden, IsFoundMeasuredAndTakenOut) {
  const std::string& id = GetParam();
  const test::HiddenRig rig(rig_with(id));
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  EXPECT_THAT(with_aliases(*discovery), Contains(id));
  EXPECT_EQ(test::beyond_the_footprint(discovery->selected).size(), 1U)
      << ::testing::PrintToString(discovery->selected);
  const EffectFinding& f = finding(*discovery, id);
  EXPECT_THAT(f.verdict, ::testing::AnyOf(EffectVerdict::kPresent, EffectVerdict::kAliased));
  if (f.verdict == EffectVerdict::kPresent) expect_measured(f, rig.rig());

  const Channel channel = test::main_channel(id);
  const ChannelSummary& before = summary_of(discovery->channels, channel);
  const ChannelSummary& after = summary_of(discovery->history.back().channels, channel);
  // Floors are estimates themselves, good to a few per cent. The gloss of the simulator has longer
  // flanks than the model's bell: a part stays.
  const bool other_form = id == "specular_lobe";
  EXPECT_LT(after.unexplained,
            std::max((other_form ? 0.5 : 0.1) * before.unexplained, 0.6 * after.noise_floor));
  EXPECT_LT(after.heldout_rms, (other_form ? 1.25 : 1.15) * after.noise_floor);
  EXPECT_LT(after.heldout_rms, (1.0 + 0.02) * before.heldout_rms);
  EXPECT_LT(rig.error_m(discovery->state.camera_from_lidar),
            rig.error_m(rig.result().extrinsic.camera_from_lidar.transform) + 5e-4);
}

INSTANTIATE_TEST_SUITE_P(Every, Hidden, ::testing::ValuesIn(planted_ids(false)),
                         [](const auto& info) { return info.param; });

// The footprint is in every model, as wide as the transitions show it: nothing is left to add.
class HiddenFootprint : public ::testing::TestWithParam<std::string> {};

TEST_P(HiddenFootprint, IsInTheModelAnyway) {
  const test::HiddenRig rig(rig_with(GetParam()));
  ASSERT_TRUE(rig.ok());
  const auto discovery = discover(rig.result(), {}, {});
  ASSERT_TRUE(discovery.ok()) << discovery.error().text();
  SCOPED_TRACE(discovery_summary(*discovery));
  EXPECT_THAT(test::beyond_the_footprint(discovery->selected), ::testing::IsEmpty());
  const ChannelSummary& edges = summary_of(discovery->history.back().channels, Channel::kBoundary);
  EXPECT_LT(edges.heldout_rms, 1.15 * edges.noise_floor);
  EXPECT_LT(rig.error_m(discovery->state.camera_from_lidar), 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Every, HiddenFootprint, ::testing::ValuesIn(planted_ids(true)),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace lvcalib
