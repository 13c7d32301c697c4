// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace lvcalib {
namespace {

TEST(MessageTest, PlacesAreFilledInTheirOrderOfNumbers) {
  EXPECT_EQ(Message("scene %1 of %2", "A", 3).text(), "scene A of 3");
  EXPECT_EQ(Message("%2 before %1", 1, 2).text(), "2 before 1");
  EXPECT_EQ(Message("%1 and %1", "x").text(), "x and x");
}

TEST(MessageTest, WhatFillsAPlaceIsNotReadAgain) {
  EXPECT_EQ(Message("%1: %2", "%2", "100 %1").text(), "%2: 100 %1");
}

TEST(MessageTest, PercentSignsAndPlacesWithoutArgumentsStay) {
  EXPECT_EQ(Message("12 % of it").text(), "12 % of it");
  EXPECT_EQ(Message("12 %").text(), "12 %");
  EXPECT_EQ(Message("%1 and %2", "x").text(), "x and %2");
}

TEST(MessageTest, MessagesFillMessages) {
  const Message inner("only %1 points", 7);
  const Message outer("scene %1: %2", "A", inner);
  EXPECT_EQ(outer.text(), "scene A: only 7 points");
  ASSERT_EQ(outer.arguments().size(), 2U);
  EXPECT_FALSE(outer.arguments()[0].translatable());
  EXPECT_EQ(outer.arguments()[1], inner);
  EXPECT_EQ(outer.id(), "scene %1: %2");
}

TEST(MessageTest, WordsAndListedTexts) {
  EXPECT_FALSE(Message::verbatim("100 %1").translatable());
  EXPECT_EQ(Message::verbatim("100 %1").text(), "100 %1");
  EXPECT_TRUE(Message::listed("Range walk").translatable());
  EXPECT_FALSE(Message::listed("").translatable());
  EXPECT_TRUE(Message().empty());
  EXPECT_FALSE(Message("used") == Message::verbatim("used"));
}

TEST(MessageTest, OneBehindTheOther) {
  Message said("a");
  said += Message();
  EXPECT_EQ(said, Message("a"));
  said += Message("; b %1", 2);
  EXPECT_EQ(said.text(), "a; b 2");
  EXPECT_EQ((Message() + Message("c")), Message("c"));
  EXPECT_EQ(joined(std::vector<Message>{}, ", ").text(), "");
  std::vector<Message> many(12, Message("x"));
  EXPECT_EQ(joined(many, ", ").text(), "x, x, x, x, x, x, x, x, x, x, x, x");
}

TEST(MessageTest, SeveralAreEnumerated) {
  const Message a("a"), b("b %1", 2), c("c");
  EXPECT_EQ(all_of({}).text(), "");
  EXPECT_EQ(all_of({a}), a);
  EXPECT_EQ(all_of({a, b}).text(), "a and b 2");
  EXPECT_EQ(all_of({a, b, c}).text(), "a, b 2 and c");
  EXPECT_EQ(one_of({a, b, c}).text(), "a, b 2 or c");
}

TEST(MessageTest, AnErrorIsASentence) {
  const Error error = Error::input(Message("file not found"), "/a", Message("look again"));
  EXPECT_EQ(error.sentence().text(), "/a: file not found (look again)");
  EXPECT_EQ(error.text(), error.sentence().text());
  EXPECT_EQ(Error::usage(Message("x")).sentence(), Message("x"));
}

}  // namespace
}  // namespace lvcalib
