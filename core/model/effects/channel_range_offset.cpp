// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class ChannelRangeOffset final : public CatalogueEffect {
 public:
  ChannelRangeOffset()
      : CatalogueEffect(
            {.id = "channel_range_offset",
             .group = "LiDAR range",
             .title = "Range offset of each line",
             .physics = "Every laser has its own delay.",
             .formula = "dr = a(line), sum zero",
             .source = "HDL-64E S3 manual; Glennie and Lichti 2011",
             .discriminating_pose = "boards that every line crosses at several distances",
             .needs = {.line = true}},
            {}) {}

  // One parameter per laser line; what all have in common is a range offset, an effect of its own.
  [[nodiscard]] std::vector<EffectParameter> parameters(
      const MeasurementTable& table) const override {
    return one_per_line(table, {.name = "a",
                                .unit = "mm",
                                .unit_in_si = 1e-3,
                                .size_of_interest = 2e-3,
                                .prior_sigma = 0.03});
  }

  [[nodiscard]] std::vector<std::size_t> zero_sums(const MeasurementTable& table) const override {
    return {table.lines.size()};
  }

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const auto k = line_index(table, beam.line);
    if (k < by.size()) by[k] = beam.direction;
  }
};

}  // namespace

EffectPtr make_channel_range_offset() {
  return std::make_shared<ChannelRangeOffset>();
}

}  // namespace lvcalib
