// SPDX-License-Identifier: GPL-3.0-or-later
#include "selection/model_session.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "selection/proposals.h"
#include "support/pose_matchers.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double unexplained(const ModelStep& step, Channel channel) {
  for (const ChannelSummary& c : step.channels) {
    if (c.channel == channel) return c.unexplained;
  }
  ADD_FAILURE() << "no such channel";
  return NAN;
}

std::vector<std::string> specs(const ModelStep& step) {
  std::vector<std::string> out;
  for (const ModelTerm& term : step.terms) out.push_back(term.spec);
  return out;
}

// Dark print reads 8 mm far, corners are 0.3 px out.
test::Disturbance two_effects() {
  test::Disturbance wrong;
  wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  wrong.corner_px = [](const CornerRow& row) -> Eigen::Vector2d {
    return 0.3 * row.from_tag_px.normalized();
  };
  return wrong;
}

class Session : public ::testing::Test {
 protected:
  static ModelStepPtr start(const test::Disturbance& wrong, std::uint64_t seed = 1) {
    test::TableRecipe recipe;
    recipe.seed = seed;
    auto made = test::synthetic_table(recipe, wrong);
    auto step = start_model(made.table, made.truth, {}, {});
    EXPECT_TRUE(step) << step.error().text();
    return *step;
  }
  RunContext context_;
};

TEST_F(Session, AddingWhatIsHiddenTakesTheUnexplainedErrorAway) {
  const ModelStepPtr base = start(two_effects());
  EXPECT_TRUE(base->terms.empty());
  EXPECT_GT(unexplained(*base, Channel::kRange), 2.0);
  ASSERT_FALSE(base->structure.empty());
  const auto added = add_effect(base, "range_walk", std::nullopt, context_);
  ASSERT_TRUE(added) << added.error().text();
  EXPECT_THAT(specs(**added), ElementsAre("range_walk"));
  EXPECT_EQ((*added)->change, ModelChange::kAdd);
  EXPECT_EQ((*added)->changed, "range_walk");
  // A tenth of the squares; the root of a difference of squares is no sharper than that.
  EXPECT_LT(std::pow(unexplained(**added, Channel::kRange), 2),
            0.1 * std::pow(unexplained(*base, Channel::kRange), 2));
  const ParameterEstimate a = (*added)->terms[0].estimates().front();
  EXPECT_GT(a.sigma, 0.0);
  EXPECT_NEAR(a.value, 0.008, 4.0 * a.sigma);
  EXPECT_TRUE(base->terms.empty()) << "the step before is as it was";
}

TEST_F(Session, TheStatedDeviationOfAValueHoldsOverManyTables) {
  double squares = 0.0;
  constexpr int kTables = 12;
  for (int seed = 1; seed <= kTables; ++seed) {
    test::TableRecipe recipe;
    recipe.seed = static_cast<std::uint64_t>(seed);
    recipe.range_rows = 400;
    auto made = test::synthetic_table(recipe, two_effects());
    const auto base = start_model(std::move(made.table), made.truth, {}, context_);
    ASSERT_TRUE(base);
    const auto added = add_effect(*base, "range_walk", 0.0, context_);
    ASSERT_TRUE(added);
    const ParameterEstimate a = (*added)->terms[0].estimates().front();
    squares += std::pow((a.value - 0.008) / a.sigma, 2);
  }
  // χ² with 12 degrees of freedom: 99.8 % lie between 2.2 and 33.
  EXPECT_GT(squares, 2.2);
  EXPECT_LT(squares, 33.0);
}

TEST_F(Session, RemovingGivesTheModelBefore) {
  const ModelStepPtr base = start(two_effects());
  const auto added = add_effect(base, "range_walk", 0.0, context_);
  ASSERT_TRUE(added);
  const auto removed = remove_effect(*added, 0, context_);
  ASSERT_TRUE(removed);
  EXPECT_TRUE((*removed)->terms.empty());
  EXPECT_NEAR(unexplained(**removed, Channel::kRange), unexplained(*base, Channel::kRange), 0.02);
  EXPECT_LT(
      translation_distance_m((*removed)->state.camera_from_lidar, base->state.camera_from_lidar),
      0.2 * std::sqrt(base->covariance(0, 0)) + 1e-4);
}

TEST_F(Session, SwitchedOffAnEffectKeepsItsPlaceAndValues) {
  const ModelStepPtr base = start(two_effects());
  const auto added = add_effect(base, "range_walk", 0.0, context_);
  ASSERT_TRUE(added);
  const double value = (*added)->terms[0].use.values(0);
  const auto off = switch_effect(*added, 0, false, context_);
  ASSERT_TRUE(off);
  EXPECT_THAT(specs(**off), ElementsAre("range_walk"));
  EXPECT_TRUE((*off)->in_use().empty());
  EXPECT_EQ((*off)->terms[0].use.values(0), value);
  EXPECT_GT(unexplained(**off, Channel::kRange), 2.0);
  const auto on = add_effect(*off, "range_walk", std::nullopt, context_);
  ASSERT_TRUE(on) << "adding what is switched off switches it on";
  EXPECT_EQ((*on)->change, ModelChange::kSwitchOn);
  EXPECT_LT(unexplained(**on, Channel::kRange), 1.3);
}

TEST_F(Session, HeldValuesStayAndTheOthersAdapt) {
  const ModelStepPtr base = start(two_effects());
  auto step = add_effect(base, "range_walk", 0.0, context_);
  ASSERT_TRUE(step);
  step = add_effect(*step, "corner_bias", 0.0, context_);
  ASSERT_TRUE(step);
  const auto held = hold_effect(*step, 0, Eigen::VectorXd::Constant(1, 0.004), context_);
  ASSERT_TRUE(held);
  EXPECT_DOUBLE_EQ((*held)->terms[0].use.values(0), 0.004);
  EXPECT_EQ((*held)->terms[0].sigma(0), 0.0);
  EXPECT_GT((*held)->terms[1].sigma(0), 0.0);
  EXPECT_NEAR((*held)->terms[1].use.values(0), 0.3, 0.03);
  EXPECT_GT(unexplained(**held, Channel::kRange), 1.0) << "half of it is left";
  const auto freed = hold_effect(*held, 0, std::nullopt, context_);
  ASSERT_TRUE(freed);
  EXPECT_EQ((*freed)->change, ModelChange::kRelease);
  EXPECT_NEAR((*freed)->terms[0].use.values(0), 0.008, 0.0006);
}

// The last step of a search is the one told before, ranked.
void expect_same_model(const ModelStep& a, const ModelStep& b) {
  EXPECT_TRUE(a.state.camera_from_lidar.translation == b.state.camera_from_lidar.translation);
  EXPECT_TRUE(a.covariance == b.covariance);
  ASSERT_EQ(a.terms.size(), b.terms.size());
  for (std::size_t k = 0; k < a.terms.size(); ++k) {
    EXPECT_EQ(a.terms[k].spec, b.terms[k].spec);
    EXPECT_TRUE(a.terms[k].use.values == b.terms[k].use.values);
  }
}

TEST_F(Session, FindAllAddsWhatIsHiddenStepByStep) {
  const ModelStepPtr base = start(two_effects());
  std::vector<ModelStepPtr> seen;
  const auto found = find_all(
      base, [&](const ModelStepPtr& step) { seen.push_back(step); }, context_);
  ASSERT_TRUE(found);
  EXPECT_THAT(specs(**found), ::testing::UnorderedElementsAre("range_walk", "corner_bias"));
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0]->terms.size(), 1U);
  expect_same_model(*seen[1], **found);
}

// A search may swap an earlier effect for its alias while it adds another one.
TEST(DecisionsBetween, TellDropsSwapsAndWhatComesBack) {
  const auto step = [](std::initializer_list<std::pair<const char*, bool>> terms) {
    ModelStep out;
    for (const auto& [spec, on] : terms) {
      out.terms.emplace_back();
      out.terms.back().spec = spec;
      out.terms.back().on = on;
    }
    return out;
  };
  const ModelStep before = step({{"ink_gain", true}, {"range_walk", true}, {"board_bow", false}});
  const ModelStep after = step(
      {{"boundary_bias", true}, {"range_walk", true}, {"board_bow", true}, {"blooming", true}});
  const std::vector<ModelDecision> expected{{ModelChange::kRemove, "ink_gain", {}},
                                            {ModelChange::kAdd, "boundary_bias", {}},
                                            {ModelChange::kAdd, "board_bow", {}},
                                            {ModelChange::kAdd, "blooming", {}}};
  EXPECT_EQ(decisions_between(before, after), expected);
  EXPECT_TRUE(decisions_between(after, after).empty());
}

// The command line searches in one go, the window step by step; where it was taken up again must
// not show, to the last digit.
TEST_F(Session, EveryWayToTheSameModelEndsAtTheSameDigits) {
  test::Disturbance wrong = two_effects();
  const auto made = test::synthetic_table({}, wrong);
  DiscoveryOptions options;
  options.with = {"range_cyclic"};
  const auto base = start_model(made.table, made.truth, options, context_);
  ASSERT_TRUE(base);
  const auto added = add_effect(*base, "range_cyclic", std::nullopt, context_);
  ASSERT_TRUE(added);
  std::vector<ModelStepPtr> steps{*base, *added};
  const auto found = find_all(
      *added, [&](const ModelStepPtr& step) { steps.push_back(step); }, context_);
  ASSERT_TRUE(found);
  ASSERT_GE(steps.size(), 4U) << "two effects are hidden";

  const auto expect_same = [](const ModelStep& a, const ModelStep& b) {
    EXPECT_EQ(a.state.camera_from_lidar.translation, b.state.camera_from_lidar.translation);
    EXPECT_EQ(a.covariance, b.covariance);
    ASSERT_EQ(specs(a), specs(b));
    for (std::size_t k = 0; k < a.terms.size(); ++k) {
      EXPECT_EQ(a.terms[k].use.values, b.terms[k].use.values);
      EXPECT_EQ(a.terms[k].use.shape, b.terms[k].use.shape);
    }
  };
  for (std::size_t k = 1; k + 1 < steps.size(); ++k) {
    const auto again = find_all(steps[k], {}, context_);
    ASSERT_TRUE(again);
    expect_same(**again, **found);
  }

  const auto one_go = discover_effects(made.table, made.truth, options, context_);
  ASSERT_TRUE(one_go);
  EXPECT_TRUE(std::ranges::all_of(specs(**found),
                                  [&](const std::string& id) { return one_go->holds(id); }));
  EXPECT_EQ(one_go->model.size(), specs(**found).size());
  EXPECT_EQ(one_go->state.camera_from_lidar.translation,
            (*found)->state.camera_from_lidar.translation);
  EXPECT_EQ(one_go->covariance, (*found)->covariance);
  const auto ranking = rank_effects(**found, context_);
  ASSERT_TRUE(ranking);
  const Discovery shown = as_discovery(steps, &*ranking);
  EXPECT_FALSE(one_go->structure.empty()) << "what two effects leave in the base model";
  EXPECT_EQ(shown.structure.size(), one_go->structure.size());
  ASSERT_EQ(shown.effects.size(), one_go->effects.size());
  for (std::size_t k = 0; k < shown.effects.size(); ++k) {
    const EffectFinding& a = shown.effects[k];
    const EffectFinding& b = one_go->effects[k];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.verdict, b.verdict);
    EXPECT_EQ(a.explanation, b.explanation);
    EXPECT_EQ(a.extrinsic_move_mm, b.extrinsic_move_mm);
  }
  EXPECT_EQ(shown.advice, one_go->advice);
  ASSERT_EQ(shown.history.size(), one_go->history.size());
  for (std::size_t k = 0; k < shown.history.size(); ++k)
    EXPECT_EQ(shown.history[k].added, one_go->history[k].added);
}

TEST_F(Session, WhatMakesTheSolveSingularIsRefused) {
  const ModelStepPtr base = start({});
  const auto scale = add_effect(base, "range_scale", std::nullopt, context_);
  ASSERT_TRUE(scale);
  const auto twice = add_effect(*scale, "formula:range:a*range", std::nullopt, context_);
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().kind, ErrorKind::kInput);
  EXPECT_THAT(twice.error().message, HasSubstr("range_scale do, which makes the solve singular"));
}

TEST_F(Session, FindAllLeavesACleanModelAlone) {
  const ModelStepPtr base = start({});
  const auto found = find_all(base, {}, context_);
  ASSERT_TRUE(found);
  expect_same_model(**found, *base);
}

TEST_F(Session, DecisionsMakeTheSameStepsAgain) {
  const ModelStepPtr base = start(two_effects());
  ModelStepPtr step = base;
  const std::vector<ModelDecision> decisions{
      {ModelChange::kAdd, "range_walk", {}},       {ModelChange::kAdd, "board_bow", {}},
      {ModelChange::kHold, "range_walk", {0.007}}, {ModelChange::kSwitchOff, "board_bow", {}},
      {ModelChange::kSwitchOn, "board_bow", {}},   {ModelChange::kRelease, "range_walk", {}},
      {ModelChange::kRemove, "board_bow", {}}};
  for (const ModelDecision& decision : decisions) {
    auto next = apply_decision(step, decision, context_);
    ASSERT_TRUE(next) << next.error().text();
    EXPECT_EQ((*next)->change, decision.change);
    step = *next;
  }
  EXPECT_THAT(specs(*step), ElementsAre("range_walk"));
  const auto missing = apply_decision(step, {ModelChange::kRemove, "board_bow", {}}, context_);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message, HasSubstr("board_bow"));
}

TEST_F(Session, WhatCannotBeDoneIsSaid) {
  const ModelStepPtr base = start({});
  const auto unknown = add_effect(base, "range_wlak", std::nullopt, context_);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("range_walk"));
  const auto once = add_effect(base, "range_walk", 0.0, context_);
  ASSERT_TRUE(once);
  EXPECT_FALSE(add_effect(*once, "range_walk", 0.0, context_));
  EXPECT_FALSE(hold_effect(*once, 0, Eigen::VectorXd::Zero(2), context_));
  EXPECT_FALSE(hold_effect(*once, 0, Eigen::VectorXd::Constant(1, NAN), context_));

  test::TableRecipe timeless;
  timeless.time = false;
  auto made = test::synthetic_table(timeless);
  const auto step = start_model(made.table, made.truth, {}, context_);
  ASSERT_TRUE(step);
  const auto needs_time = add_effect(*step, "scan_motion", std::nullopt, context_);
  ASSERT_FALSE(needs_time);
  EXPECT_THAT(needs_time.error().message, HasSubstr("time"));

  test::TableRecipe few;
  few.scenes = 2;
  made = test::synthetic_table(few);
  EXPECT_EQ(start_model(made.table, made.truth, {}, context_).error().kind, ErrorKind::kUntrusted);
}

TEST_F(Session, FormulasAndCurvesAreEffectsLikeOthers) {
  const ModelStepPtr base = start(two_effects());
  const auto formula = add_effect(base, "formula:range: a * darkness", std::nullopt, context_);
  ASSERT_TRUE(formula) << formula.error().text();
  const ParameterEstimate a = (*formula)->terms[0].estimates().front();
  EXPECT_NEAR(a.value, 0.008, 5.0 * a.sigma);
  EXPECT_LT(unexplained(**formula, Channel::kRange), 1.3);
  const auto curve = add_effect(base, "curve:range:darkness", std::nullopt, context_);
  ASSERT_TRUE(curve) << curve.error().text();
  EXPECT_LT(unexplained(**curve, Channel::kRange), 1.6);
  EXPECT_FALSE(add_effect(base, "formula:range:a*no_such_thing", std::nullopt, context_));
  EXPECT_FALSE(add_effect(*curve, "curve:range: darkness", std::nullopt, context_))
      << "the same, written otherwise";
}

TEST_F(Session, AStoppedOperationSaysSo) {
  const ModelStepPtr base = start({});
  std::stop_source stop;
  stop.request_stop();
  RunContext stopped;
  stopped.stop = stop.get_token();
  EXPECT_EQ(add_effect(base, "range_walk", std::nullopt, stopped).error().kind,
            ErrorKind::kCancelled);
  EXPECT_EQ(find_all(base, {}, stopped).error().kind, ErrorKind::kCancelled);
}

}  // namespace
}  // namespace lvcalib
