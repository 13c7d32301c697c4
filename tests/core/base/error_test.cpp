// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/error.h"

#include <memory>

#include <gtest/gtest.h>

namespace lvcalib {
namespace {

TEST(Error, TextNamesPlaceMessageAndHint) {
  EXPECT_EQ(Error::input(Message("no tags")).text(), "no tags");
  EXPECT_EQ(Error::input(Message("no tags"), "scene A").text(), "scene A: no tags");
  EXPECT_EQ(Error::input(Message("no tags"), "scene A", Message("check the family")).text(),
            "scene A: no tags (check the family)");
  EXPECT_EQ(Error::input(Message("no tags"), {}, Message("check the family")).text(),
            "no tags (check the family)");
}

TEST(Error, FactoriesSetTheKind) {
  EXPECT_EQ(Error::input(Message("x")).kind, ErrorKind::kInput);
  EXPECT_EQ(Error::untrusted(Message("x")).kind, ErrorKind::kUntrusted);
  EXPECT_EQ(Error::output(Message("x")).kind, ErrorKind::kOutput);
  EXPECT_EQ(Error::usage(Message("x")).kind, ErrorKind::kUsage);
  EXPECT_EQ(Error::cancelled().kind, ErrorKind::kCancelled);
  EXPECT_FALSE(Error::cancelled().text().empty());
}

TEST(Result, HoldsEitherAValueOrAnError) {
  Result<int> value(7);
  EXPECT_TRUE(value.ok());
  EXPECT_TRUE(static_cast<bool>(value));
  EXPECT_EQ(*value, 7);
  *value = 8;
  EXPECT_EQ(value.value(), 8);
  const Result<int> error(Error::usage(Message("bad")));
  EXPECT_FALSE(error.ok());
  EXPECT_EQ(error.error().message.text(), "bad");
}

TEST(Result, MovesItsValueOut) {
  Result<std::unique_ptr<int>> result(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 3);
  EXPECT_EQ(*result, nullptr);
}

}  // namespace
}  // namespace lvcalib
