// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class ChannelAngleOffset final : public CatalogueEffect {
 public:
  ChannelAngleOffset()
      : CatalogueEffect({.id = "channel_angle_offset",
                         .group = "LiDAR angle",
                         .title = "Angle offsets of each line",
                         .physics = "Every laser points slightly elsewhere than its table says.",
                         .formula = "del = b(line), daz = c(line), each with sum zero",
                         .source = "HDL-64E S3 manual; Glennie and Lichti 2011",
                         .discriminating_pose = "boards that every line crosses",
                         .needs = {.line = true}},
                        {}) {}

  // Two parameters per laser line; what all have in common is a turn of the frame, which no data
  // can tell from the extrinsic.
  [[nodiscard]] std::vector<EffectParameter> parameters(
      const MeasurementTable& table) const override {
    auto out = one_per_line(table, {.name = "b",
                                    .unit = "mrad",
                                    .unit_in_si = 1e-3,
                                    .size_of_interest = 0.3e-3,
                                    .prior_sigma = 0.01});
    const auto azimuth = one_per_line(table, {.name = "c",
                                              .unit = "mrad",
                                              .unit_in_si = 1e-3,
                                              .size_of_interest = 0.3e-3,
                                              .prior_sigma = 0.01});
    out.insert(out.end(), azimuth.begin(), azimuth.end());
    return out;
  }

  [[nodiscard]] std::vector<std::size_t> zero_sums(const MeasurementTable& table) const override {
    return {table.lines.size(), table.lines.size()};
  }

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    const std::size_t lines = by.size() / 2;
    const auto k = line_index(table, beam.line);
    if (k >= lines) return;
    by[k] = angle_axes(beam).elevation_m;
    by[lines + k] = angle_axes(beam).azimuth_m;
  }
};

}  // namespace

EffectPtr make_channel_angle_offset() {
  return std::make_shared<ChannelAngleOffset>();
}

}  // namespace lvcalib
