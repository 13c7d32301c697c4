// SPDX-License-Identifier: BSD-3-Clause
#include "model/sensor_errors.h"

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

// Callers know how large it is: the prior of what is believable is theirs to set.
EffectParameter offset() {
  return {
      .name = "a", .unit = "mm", .unit_in_si = 1e-3, .size_of_interest = 1e-3, .prior_sigma = 0.05};
}

EffectInfo described(const char* id, const char* title, const char* formula) {
  return {.id = id,
          .group = "LiDAR range",
          .title = title,
          .physics = "Ranges are off in all scenes, and no effect of the model says why.",
          .formula = formula,
          .source = "derived",
          .discriminating_pose = "boards turned to ±40 degrees at several distances",
          .needs = {}};
}

class AllRanges final : public CatalogueEffect {
 public:
  AllRanges()
      : CatalogueEffect(described("sensor_range", "Error of all ranges", "dr = a"), {offset()}) {}
  void range(const RangeRow& /*row*/, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<double> by) const override {
    by[0] = 1.0;
  }
};

class BlackRanges final : public CatalogueEffect {
 public:
  BlackRanges()
      : CatalogueEffect(
            described("sensor_dark", "Error of ranges on black print", "dr = a on black"),
            {offset()}) {}
  void range(const RangeRow& row, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<double> by) const override {
    by[0] = row.print == Print::kBlack ? 1.0 : 0.0;
  }
};

class LineRanges final : public CatalogueEffect {
 public:
  LineRanges()
      : CatalogueEffect(described("sensor_line", "Error of each line's ranges", "dr = a(line)"),
                        {}) {}
  [[nodiscard]] std::vector<EffectParameter> parameters(
      const MeasurementTable& table) const override {
    return one_per_line(table, offset());
  }
  void range(const RangeRow& row, const MeasurementTable& table, double /*shape*/,
             std::span<double> by) const override {
    const auto k = line_index(table, row.beam.line);
    if (k < by.size()) by[k] = 1.0;
  }
};

}  // namespace

EffectPtr sensor_error(std::size_t kind) {
  static const std::array<EffectPtr, kSensorErrors> all{std::make_shared<AllRanges>(),
                                                        std::make_shared<BlackRanges>(),
                                                        std::make_shared<LineRanges>()};
  return all.at(kind);
}

}  // namespace lvcalib
