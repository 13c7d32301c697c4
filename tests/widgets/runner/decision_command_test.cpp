// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/decision_command.h"

#include <QUndoStack>

#include <gtest/gtest.h>

#include "model/effect.h"

namespace lvcalib::widgets::decision_command_test {
namespace {

Decisions with_crops(bool use) {
  Decisions out;
  out.use_crops = use;
  return out;
}

TEST(DecisionCommand, IsDoneUndoneAndDescribed) {
  Decisions now = with_crops(false);
  QUndoStack stack;
  const auto apply = [&](const Decisions& d) { now = d; };
  stack.push(new DecisionCommand(apply, now, with_crops(true), {"reject %1", "A, %1"}, {}));
  EXPECT_TRUE(now.use_crops);
  EXPECT_EQ(stack.undoText(), "reject A, %1");
  stack.undo();
  EXPECT_FALSE(now.use_crops);
  stack.redo();
  EXPECT_TRUE(now.use_crops);
  EXPECT_EQ(dynamic_cast<const DecisionCommand*>(stack.command(0))->description(), "reject A, %1");
}

TEST(DecisionCommand, WhatTheCoreNamesIsSaidAsTheWindowSaysIt) {
  DescribedCommand command("Decisions", {"change %1", {}, effect_named("range_walk")});
  EXPECT_EQ(command.description(), "change Range walk");
}

TEST(DecisionCommand, OneKeyIsOneDecision) {
  Decisions now = with_crops(false);
  QUndoStack stack;
  const auto apply = [&](const Decisions& d) { now = d; };
  const auto push = [&](bool use, const QString& key) {
    stack.push(new DecisionCommand(apply, now, with_crops(use), {"change", {}}, key));
  };
  push(true, "k");
  push(false, "k");
  push(true, "k");
  EXPECT_EQ(stack.count(), 1);
  push(false, "other");
  push(true, {});
  push(false, {});
  EXPECT_EQ(stack.count(), 4);
  stack.setIndex(0);
  EXPECT_FALSE(now.use_crops);
}

}  // namespace
}  // namespace lvcalib::widgets::decision_command_test
