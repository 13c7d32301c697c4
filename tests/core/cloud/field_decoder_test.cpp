// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloud/field_decoder.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/cloud/cloud_text.h"

namespace lvcalib {
namespace {

using test::bytes;

template <class T>
void expect_decoded(ScalarType type, T value) {
  for (const bool reversed : {false, true}) {
    // Three values at an odd offset with an odd stride: nothing is aligned.
    std::string block = "#";
    for (int i = 0; i < 3; ++i) block += bytes(value, reversed) + "?";
    const FieldLayout field{type, 1, sizeof(T) + 1};
    float out[3] = {};
    decode_floats(block.data(), field, reversed, 3, out);
    for (const float decoded : out) EXPECT_EQ(decoded, static_cast<float>(value));
    EXPECT_EQ(decode_scalar(block.data() + 1, type, reversed), static_cast<double>(value));
  }
  EXPECT_EQ(scalar_size(type), sizeof(T));
  EXPECT_EQ(is_integer(type), std::is_integral_v<T>);
}

TEST(FieldDecoder, DecodesEveryTypeInBothByteOrders) {
  using enum ScalarType;
  expect_decoded<std::int8_t>(kI8, -100);
  expect_decoded<std::uint8_t>(kU8, 200);
  expect_decoded<std::int16_t>(kI16, -30'000);
  expect_decoded<std::uint16_t>(kU16, 60'000);
  expect_decoded<std::int32_t>(kI32, -2'000'000'000);
  expect_decoded<std::uint32_t>(kU32, 4'000'000'000U);
  expect_decoded<std::int64_t>(kI64, -(std::int64_t{1} << 60));
  expect_decoded<std::uint64_t>(kU64, std::uint64_t{1} << 63);
  expect_decoded<float>(kF32, 1.5F);
  expect_decoded<double>(kF64, -2.25);
}

template <class T>
std::uint16_t line_of(ScalarType type, T value) {
  std::uint16_t line = 0;
  decode_lines(bytes(value).data(), {type, 0, 0}, false, 1, &line);
  return line;
}

TEST(FieldDecoder, LinesAreClampedToTheirRange) {
  using enum ScalarType;
  EXPECT_EQ(line_of<std::uint8_t>(kU8, 127), 127);
  EXPECT_EQ(line_of<std::int8_t>(kI8, -1), 0);
  EXPECT_EQ(line_of<std::uint16_t>(kU16, 65535), 65535);
  EXPECT_EQ(line_of<std::uint32_t>(kU32, 70'000), 65535);
  EXPECT_EQ(line_of<std::int64_t>(kI64, -5), 0);
  EXPECT_EQ(line_of<float>(kF32, 63.0F), 63);
  EXPECT_EQ(line_of<float>(kF32, std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(line_of<double>(kF64, 1e300), 65535);
  EXPECT_EQ(line_of<double>(kF64, -INFINITY), 0);
}

TEST(FieldDecoder, TimeDifferencesOfLargeIntegersAreExact) {
  const std::uint64_t epoch = 1'700'000'000'123'456'789U;
  const std::string block = bytes(epoch) + bytes(epoch + 7) + bytes(epoch - 3);
  const FieldLayout field{ScalarType::kU64, 0, 8};
  float out[3] = {};
  decode_times(block.data(), field, false, 3, decode_time(block.data(), field, false, 0), out);
  EXPECT_EQ(out[0], 0.0F);
  EXPECT_EQ(out[1], 7.0F);
  EXPECT_EQ(out[2], -3.0F);
}

TEST(FieldDecoder, KnowsPcdTypes) {
  EXPECT_EQ(pcd_scalar_type('F', 8), ScalarType::kF64);
  EXPECT_EQ(pcd_scalar_type('U', 1), ScalarType::kU8);
  EXPECT_EQ(pcd_scalar_type('I', 8), ScalarType::kI64);
  EXPECT_FALSE(pcd_scalar_type('F', 2));
  EXPECT_FALSE(pcd_scalar_type('U', 3));
  EXPECT_FALSE(pcd_scalar_type('X', 4));
}

}  // namespace
}  // namespace lvcalib
