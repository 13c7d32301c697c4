// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/model_scales.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "model/effect.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

TEST(ModelScales, DarknessIsZeroForWhiteAndOneForBlack) {
  ModelScales scales;
  scales.level = {100.0, 10.0};
  scales.log_contrast = std::log(10.0);
  scales.darkness_low = -0.2;
  scales.darkness_high = 1.3;
  EXPECT_DOUBLE_EQ(scales.darkness_of(100.0), 0.0);
  EXPECT_DOUBLE_EQ(scales.darkness_of(10.0), 1.0);
  EXPECT_NEAR(scales.darkness_of(31.6227766), 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(scales.darkness_of(1e6), -0.2);
  EXPECT_DOUBLE_EQ(scales.darkness_of(1e-6), 1.3);
  EXPECT_DOUBLE_EQ(scales.darkness_of(0.0), 1.3);
  EXPECT_DOUBLE_EQ(scales.darkness_of(std::numeric_limits<double>::quiet_NaN()), 1.3);
  for (const double d : {-0.2, 0.0, 0.7, 1.3})
    EXPECT_NEAR(scales.darkness_of(scales.intensity_at(d)), d, 1e-12);
}

TEST(ModelScales, WithoutIntensityNothingIsDark) {
  EXPECT_EQ(ModelScales{}.darkness_of(3.0), 0.0);
}

TEST(ModelScales, OfATableHoldWhatItsBoardsShowed) {
  const auto made = test::synthetic_table({});
  const ModelScales scales = scales_of(made.table);
  EXPECT_EQ(scales.level, made.table.level);
  EXPECT_EQ(scales.lines, made.table.lines);
  EXPECT_DOUBLE_EQ(scales.log_contrast, std::log(10.0));
  double incidence = 0.0;
  for (const RangeRow& row : made.table.range)
    incidence = std::max(incidence, row.beam.incidence_rad);
  EXPECT_DOUBLE_EQ(scales.incidence_high_rad, incidence);
  EXPECT_EQ(scales.darkness_low, 0.0);
  EXPECT_EQ(scales.darkness_high, 1.0);
}

TEST(ModelScales, EmptyTableGivesEffectsTheirParameters) {
  ModelScales scales;
  scales.lines = {2, 5};
  const MeasurementTable table = empty_table(scales);
  const auto parameters = find_effect("channel_range_offset")->parameters(table);
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[1].name, "a5");
  EXPECT_EQ(table.scenes.size(), 1U);
}

}  // namespace
}  // namespace lvcalib
