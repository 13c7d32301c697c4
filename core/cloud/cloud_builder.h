// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "cloud/cloud.h"
#include "cloud/field_decoder.h"

namespace lvcalib {

/// Seconds per tick of a time field, from its values, as files do not tell. In this order:
/// 1. Times since 1970 (years 2000 to 2099): the unit that puts `first` there, if the span is a
///    minute at most.
/// 2. Floating-point fields: seconds, unless the span would exceed a minute (Livox writes
///    nanoseconds as double).
/// 3. The finest of ns, µs, ms that makes the span at least a millisecond: one packet of a
///    scanner. Drivers of Ouster, Livox and Velodyne count nanoseconds in 32 bits.
double time_unit_s(bool is_integer, double first, double span);

/// Turns blocks of raw points into the columns of a Cloud, leaving out points that are no
/// returns unless all are wanted. Holds no more than the columns.
class CloudBuilder {
 public:
  /// `time_is_integer`: the file's own type, where `layout` describes converted values.
  /// `expected_points`: memory to reserve; never more than the file can hold.
  CloudBuilder(const BlockLayout& layout, bool time_is_integer, std::uint64_t expected_points,
               PointChoice choice = PointChoice::kReturns);

  /// Takes `count` points, laid out from `block` on.
  void append(const char* block, std::size_t count);

  /// Points taken so far, with those left out.
  [[nodiscard]] std::uint64_t seen() const { return seen_; }

  /// Completes the cloud. Times become seconds from the earliest one. A field that is finite
  /// nowhere is dropped; points where it is not finite otherwise (unless all are wanted). Error if
  /// no return is left. `rows`: of an organised cloud. Warns of points that end before the file.
  Result<Cloud> finish(const std::string& name, std::uint64_t rows = 1);

 private:
  static constexpr std::size_t kBlock = 2048;  // scratch stays in the fastest cache

  void append_small(const char* block, std::size_t first, std::size_t count);
  std::size_t choose_points(std::uint64_t before, std::size_t count);
  void note_zeros(const char* block, std::size_t first, std::size_t count);
  void append_times(const char* block, std::size_t first, std::size_t count, std::size_t kept);
  void append_column(const std::array<float, kBlock>& values, std::size_t kept, bool all,
                     std::vector<float>& column);
  void drop_not_finite(std::vector<float>& column);
  [[nodiscard]] bool is_return(std::size_t i) const;
  [[nodiscard]] bool is_cut_off(std::uint64_t rows) const;
  [[nodiscard]] bool is_zeroed(std::uint64_t rows) const;
  void scale_times();

  BlockLayout layout_;
  bool time_is_integer_;
  PointChoice choice_;
  Cloud cloud_;
  std::uint64_t seen_ = 0;
  std::uint64_t returns_ = 0;
  std::uint64_t last_return_ = 0;  ///< Points up to and with the last return.
  std::uint64_t zeros_ = 0;       ///< Of the blocks so far, how many points of zero bytes end them.
  std::uint64_t most_zeros_ = 0;  ///< The longest of such stretches,
  std::uint64_t zeros_end_ = 0;   ///< and up to which point it goes.
  std::optional<ExactTime> first_time_;
  std::array<float, kBlock> x_ = {}, y_ = {}, z_ = {}, scratch_ = {};
  std::array<std::uint16_t, kBlock> lines_ = {}, kept_ = {};
};

}  // namespace lvcalib
