// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/options.h"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace lvcalib {
namespace {

using ::testing::HasSubstr;

TEST(Options, EveryDeclarationIsCompleteAndUnique) {
  std::set<std::string> keys;
  for (const OptionDeclaration& d : option_declarations()) {
    EXPECT_TRUE(keys.insert(d.key).second) << d.key;
    EXPECT_NE(d.key.find('.'), std::string::npos) << d.key;
    EXPECT_FALSE(d.unit.empty()) << d.key;
    EXPECT_FALSE(d.stage.empty()) << d.key;
    EXPECT_TRUE(d.description.ends_with('.')) << d.key;
    EXPECT_LT(d.low, d.high) << d.key;
    EXPECT_GE(d.default_value(), d.low) << d.key;
    EXPECT_LE(d.default_value(), d.high) << d.key;
  }
}

TEST(Options, EveryDeclarationRoundTripsAndTouchesItsOwnFieldOnly) {
  for (const OptionDeclaration& d : option_declarations()) {
    for (const double value : {d.low, d.high}) {
      CalibrationOptions options;
      const Status status = set_option(options, d.key, value);
      ASSERT_TRUE(status.ok()) << status.error().text();
      EXPECT_EQ(d.get(options), value) << d.key;
      for (const OptionDeclaration& other : option_declarations()) {
        if (other.key == d.key) continue;
        EXPECT_EQ(other.get(options), other.default_value()) << d.key;
      }
    }
  }
}

TEST(Options, ValuesOutsideTheRangeAreRefusedWithIt) {
  for (const OptionDeclaration& d : option_declarations()) {
    CalibrationOptions options;
    for (const double value : {d.low - 1.0, d.high + 1.0 + d.high * 1e-6, std::nan(""), HUGE_VAL}) {
      const Status status = set_option(options, d.key, value);
      ASSERT_FALSE(status.ok()) << d.key << " = " << value;
      EXPECT_THAT(status.error().message, HasSubstr(d.key));
      EXPECT_THAT(status.error().message, HasSubstr("between"));
      EXPECT_EQ(d.get(options), d.default_value());
    }
    if (d.whole && d.low + 0.5 < d.high) {
      const Status status = set_option(options, d.key, d.low + 0.5);
      ASSERT_FALSE(status.ok()) << d.key;
      EXPECT_THAT(status.error().message, HasSubstr("whole number"));
    }
  }
}

TEST(Options, RangesAreGivenInUnitsThatHaveAName) {
  CalibrationOptions options;
  const auto refused = [&](const char* key) {
    return set_option(options, key, -5.0).error().message.text();
  };
  EXPECT_THAT(refused("detection.min_tags"), HasSubstr("between 1 and 1000, found -5"));
  EXPECT_THAT(refused("clouds.use_intensity"), HasSubstr("between 0 and 1, found -5"));
  EXPECT_THAT(refused("clouds.max_unpacked_mib"), HasSubstr("between 1 and 4096 MiB, found -5"));
}

TEST(Options, UnknownKeysNameTheNearestKnownOne) {
  CalibrationOptions options;
  const Status status = set_option(options, "refinement.max_bin", 12);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::kUsage);
  EXPECT_THAT(status.error().message, HasSubstr("did you mean 'refinement.max_bins'?"));
  EXPECT_THAT(set_option(options, "xyz", 1).error().message, HasSubstr("unknown option 'xyz'"));
}

TEST(Options, AFormerNameIsHeeded) {
  CalibrationOptions options;
  ASSERT_TRUE(set_option(options, "discovery.speaking_nats", 3.0).ok());
  EXPECT_EQ(options.discovery.informative_nats, 3.0);
}

TEST(OptionsFile, NestedAndFlatKeysMeanTheSame) {
  const test::TemporaryFolder folder;
  const auto nested = read_options(folder.write(
      "a.yaml",
      "refinement: {max_bins: 12, tolerance_m: 1e-4}\nlocalization:\n  search_walls: true\n"));
  const auto flat = read_options(folder.write(
      "b.yaml",
      "refinement.max_bins: 12\nrefinement.tolerance_m: 1e-4\nlocalization.search_walls: 1\n"));
  ASSERT_TRUE(nested.ok() && flat.ok());
  EXPECT_TRUE(nested->warnings.empty());
  for (const OptionDeclaration& d : option_declarations()) {
    EXPECT_EQ(d.get(nested->options), d.get(flat->options)) << d.key;
  }
  EXPECT_EQ(nested->options.refinement.max_bins, 12);
  EXPECT_EQ(nested->options.refinement.tolerance_m, 1e-4);
  EXPECT_TRUE(nested->options.localization.search_walls);
}

TEST(OptionsFile, UnknownKeysWarnWithTheirLine) {
  const test::TemporaryFolder folder;
  const auto file =
      read_options(folder.write("a.yaml", "refinement:\n  max_bins: 12\n  max_bns: 14\n"));
  ASSERT_TRUE(file.ok());
  ASSERT_EQ(file->warnings.size(), 1U);
  EXPECT_THAT(file->warnings[0], HasSubstr("a.yaml:3"));
  EXPECT_THAT(file->warnings[0], HasSubstr("refinement.max_bins"));
  EXPECT_EQ(file->options.refinement.max_bins, 12);
}

TEST(OptionsFile, BadContentIsRefusedWithFileAndLine) {
  const test::TemporaryFolder folder;
  for (const char* text : {"refinement:\n  max_bins: many\n", "refinement:\n  max_bins: 100000\n",
                           "refinement:\n  max_bins: 7.5\n", "refinement:\n  max_bins: [1, 2]\n",
                           "refinement:\n  max_bins: .nan\n"}) {
    const auto file = read_options(folder.write("bad.yaml", text));
    ASSERT_FALSE(file.ok()) << text;
    EXPECT_EQ(file.error().kind, ErrorKind::kInput);
    EXPECT_THAT(file.error().text(), HasSubstr("bad.yaml")) << text;
    EXPECT_THAT(file.error().text(), HasSubstr("2")) << text;
  }
  EXPECT_FALSE(read_options(folder.write("bare.yaml", "refinement:\n  max_bins:\n")).ok());
  EXPECT_FALSE(read_options(folder.write("broken.yaml", "a: [1, 2\nb: {")).ok());
  EXPECT_FALSE(read_options(folder.path() / "missing.yaml").ok());
  // An empty file is more likely a mistake than a wish.
  EXPECT_FALSE(read_options(folder.write("empty.yaml", "")).ok());
}

TEST(OptionsFile, AListInsteadOfKeysIsRefused) {
  const test::TemporaryFolder folder;
  const auto file = read_options(folder.write("list.yaml", "- 1\n- 2\n"));
  EXPECT_FALSE(file.ok());
}

}  // namespace
}  // namespace lvcalib
