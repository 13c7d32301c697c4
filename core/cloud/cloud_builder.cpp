// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/cloud_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lvcalib {
namespace {

// What a tenth of the points adds to standard deviations is a twentieth of them: less is no loss
// that anybody would see.
constexpr std::uint64_t kWorthTelling = 10;

// A scene of a minute is long, and no sweep is over within a millisecond.
constexpr double kLongestScan_s = 60.0;
constexpr double kShortestScan_s = 1e-3;
// Times since 1970, as clocks give them.
constexpr double kYear2000_s = 946'684'800.0;
constexpr double kYear2100_s = 4'102'444'800.0;

FieldLayout moved(FieldLayout field, std::size_t points) {
  field.offset += points * field.stride;
  return field;
}

}  // namespace

double time_unit_s(bool is_integer, double first, double span) {
  for (const double unit : {1.0, 1e-3, 1e-6, 1e-9}) {
    if (is_integer && unit == 1.0) continue;
    const double first_s = first * unit;
    if (first_s >= kYear2000_s && first_s < kYear2100_s && span * unit <= kLongestScan_s) {
      return unit;
    }
  }
  if (!is_integer && span <= kLongestScan_s) return 1.0;
  for (const double unit : {1e-9, 1e-6}) {
    if (span * unit >= kShortestScan_s) return unit;
  }
  return 1e-3;
}

CloudBuilder::CloudBuilder(const BlockLayout& layout, bool time_is_integer,
                           std::uint64_t expected_points, PointChoice choice)
    : layout_(layout), time_is_integer_(time_is_integer), choice_(choice) {
  const auto count = static_cast<std::size_t>(expected_points);
  cloud_.points_m.reserve(count);
  if (layout_.fields[kIntensity]) cloud_.intensity.reserve(count);
  if (layout_.fields[kTime]) cloud_.time_s.reserve(count);
  if (layout_.fields[kLine]) cloud_.line.reserve(count);
}

void CloudBuilder::append(const char* block, std::size_t count) {
  for (std::size_t first = 0; first < count; first += kBlock) {
    append_small(block, first, std::min(kBlock, count - first));
  }
  seen_ += count;
}

void CloudBuilder::append_small(const char* block, std::size_t first, std::size_t count) {
  const auto field = [&](Role role) { return moved(*layout_.fields[role], first); };
  const bool swap = layout_.swap_bytes;
  decode_floats(block, field(kX), swap, count, x_.data());
  decode_floats(block, field(kY), swap, count, y_.data());
  decode_floats(block, field(kZ), swap, count, z_.data());
  const std::size_t kept = choose_points(seen_ + first, count);
  note_zeros(block, first, count);
  if (kept == 0) return;
  const bool all = kept == count;

  const std::size_t old_size = cloud_.points_m.size();
  cloud_.points_m.resize(old_size + kept);
  Eigen::Vector3f* to = cloud_.points_m.data() + old_size;
  for (std::size_t k = 0; k < kept; ++k) {
    const std::size_t i = kept_[k];
    to[k] = {x_[i], y_[i], z_[i]};
  }
  if (layout_.fields[kIntensity]) {
    decode_floats(block, field(kIntensity), swap, count, scratch_.data());
    append_column(scratch_, kept, all, cloud_.intensity);
  }
  if (layout_.fields[kTime]) append_times(block, first, count, kept);
  if (layout_.fields[kLine]) {
    decode_lines(block, field(kLine), swap, count, lines_.data());
    for (std::size_t k = 0; k < kept; ++k) lines_[k] = lines_[kept_[k]];
    cloud_.line.insert(cloud_.line.end(), lines_.begin(),
                       lines_.begin() + static_cast<std::ptrdiff_t>(kept));
  }
}

// Lists the points that are finite and not at the origin, `before` others having been seen;
// returns their number.
std::size_t CloudBuilder::choose_points(std::uint64_t before, std::size_t count) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    kept_[kept] = static_cast<std::uint16_t>(i);
    // Zero times a finite number is zero, times anything else NaN.
    const float zero = 0.0F * x_[i] + 0.0F * y_[i] + 0.0F * z_[i];
    const bool origin = x_[i] == 0.0F && y_[i] == 0.0F && z_[i] == 0.0F;
    kept += static_cast<std::size_t>(zero == 0.0F && !origin);
  }
  if (kept > 0) last_return_ = before + kept_[kept - 1] + 1U;
  returns_ += kept;
  if (choice_ == PointChoice::kAll) {
    std::iota(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(count), std::uint16_t{0});
    return count;
  }
  cloud_.dropped += count - kept;
  return kept;
}

// Counts blocks in a row that are nothing but zero bytes: what a disk that was full or a download
// that broke off puts in place of points. Where a beam met nothing its time or line is there.
void CloudBuilder::note_zeros(const char* block, std::size_t first, std::size_t count) {
  const auto is_zero = [&](const std::optional<FieldLayout>& field) {
    if (!field) return true;
    for (std::size_t k = first; k < first + count; ++k) {
      const char* at = block + field->offset + k * field->stride;
      if (!std::all_of(at, at + scalar_size(field->type), [](char c) { return c == 0; }))
        return false;
    }
    return true;
  };
  const bool zeros = std::all_of(layout_.fields.begin(), layout_.fields.end(), is_zero);
  zeros_ = zeros ? zeros_ + count : 0;
  if (zeros_ <= most_zeros_) return;
  most_zeros_ = zeros_;
  zeros_end_ = seen_ + first + count;
}

void CloudBuilder::append_times(const char* block, std::size_t first, std::size_t count,
                                std::size_t kept) {
  const FieldLayout field = moved(*layout_.fields[kTime], first);
  const std::size_t before = cloud_.points_m.size() - kept;
  for (std::size_t k = 0; k < kept && !first_time_; ++k) {
    // What stands where nothing came back is often zero and no time.
    if (!is_return(before + k)) continue;
    const ExactTime time = decode_time(block, field, layout_.swap_bytes, kept_[k]);
    if (std::isfinite(time.value)) first_time_ = time;
  }
  decode_times(block, field, layout_.swap_bytes, count, first_time_.value_or(ExactTime{}),
               scratch_.data());
  append_column(scratch_, kept, kept == count, cloud_.time_s);
}

void CloudBuilder::append_column(const std::array<float, kBlock>& values, std::size_t kept,
                                 bool all, std::vector<float>& column) {
  if (all) {
    column.insert(column.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept));
    return;
  }
  for (std::size_t k = 0; k < kept; ++k) column.push_back(values[kept_[k]]);
}

void CloudBuilder::drop_not_finite(std::vector<float>& column) {
  const auto bad = static_cast<std::size_t>(
      std::count_if(column.begin(), column.end(), [](float v) { return !std::isfinite(v); }));
  if (bad == 0) return;
  if (bad == column.size()) {
    column.clear();
    column.shrink_to_fit();
    return;
  }
  if (choice_ == PointChoice::kAll) return;
  const std::size_t size = column.size();
  const auto compact = [&](auto& other, const std::vector<char>& keep) {
    if (other.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < size; ++i) {
      if (keep[i] != 0) other[to++] = other[i];
    }
    other.resize(to);
  };
  std::vector<char> keep(size);
  std::transform(column.begin(), column.end(), keep.begin(),
                 [](float v) { return static_cast<char>(std::isfinite(v)); });
  compact(cloud_.points_m, keep);
  compact(cloud_.intensity, keep);
  compact(cloud_.time_s, keep);
  compact(cloud_.line, keep);
  cloud_.dropped += bad;
}

void CloudBuilder::scale_times() {
  if (cloud_.time_s.empty()) return;
  float earliest = std::numeric_limits<float>::infinity();
  float latest = -earliest;
  for (std::size_t i = 0; i < cloud_.time_s.size(); ++i) {
    if (!is_return(i) || !std::isfinite(cloud_.time_s[i])) continue;
    earliest = std::min(earliest, cloud_.time_s[i]);
    latest = std::max(latest, cloud_.time_s[i]);
  }
  if (earliest > latest) {
    cloud_.time_s.clear();
    return;
  }
  const double span = static_cast<double>(latest) - earliest;
  const double unit = time_unit_s(time_is_integer_, first_time_->value, span);
  for (float& time : cloud_.time_s) {
    time = static_cast<float>((static_cast<double>(time) - earliest) * unit);
  }
}

bool CloudBuilder::is_return(std::size_t i) const {
  const Eigen::Vector3f& p = cloud_.points_m[i];
  return choice_ == PointChoice::kReturns || (p.allFinite() && !p.isZero(0.0F));
}

// Whether the returns end long before the file, as where a recording was cut off and its file had
// been given its length before, and not as this LiDAR misses elsewhere.
bool CloudBuilder::is_cut_off(std::uint64_t rows) const {
  const std::uint64_t tail = seen_ - last_return_;
  const std::uint64_t missing_before = last_return_ - returns_;
  if (kWorthTelling * tail < seen_ || tail <= missing_before) return false;
  // Where a row is a laser line, the last lines may look into the sky. A line measures more often
  // than there are lines.
  const std::uint64_t columns = rows > 0 ? seen_ / rows : 0;
  return rows <= 1 || rows > columns || tail % columns != 0;
}

// Whether a tenth of the points or more is zero bytes in a row before the last return. Where a row
// is a laser line, whole lines that look into the sky may be filled with zeros.
bool CloudBuilder::is_zeroed(std::uint64_t rows) const {
  if (rows > 1 && rows * rows <= seen_) return false;
  return kWorthTelling * most_zeros_ >= seen_ && most_zeros_ > 0 && zeros_end_ <= last_return_;
}

Result<Cloud> CloudBuilder::finish(const std::string& name, std::uint64_t rows) {
  if (seen_ == 0) return Error::input(Message("holds no points (its header says 0)"), name);
  drop_not_finite(cloud_.intensity);
  drop_not_finite(cloud_.time_s);
  if (cloud_.points_m.empty() || returns_ == 0) {
    return Error::input(
        Message("none of its %1 points is usable: all are NaN, infinite or at the origin", seen_),
        name, Message("check the driver or the export that wrote the file"));
  }
  if (is_cut_off(rows)) {
    cloud_.warnings.push_back(
        Message("from point %1 of %2 on none is a return (all are NaN, infinite or at the origin), "
                "as if the recording had been cut off",
                last_return_ + 1, seen_));
  }
  if (is_zeroed(rows)) {
    cloud_.warnings.push_back(
        Message("points %1 to %2 of %3 are nothing but zero bytes, as if a part of the file had "
                "been lost",
                zeros_end_ - most_zeros_ + 1, zeros_end_, seen_));
  }
  scale_times();
  if (choice_ == PointChoice::kAll) cloud_.rows = static_cast<std::size_t>(rows);
  return std::move(cloud_);
}

}  // namespace lvcalib
