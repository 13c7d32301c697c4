// SPDX-License-Identifier: BSD-3-Clause
#include "model/model_scales.h"

#include <algorithm>
#include <cmath>

namespace lvcalib {

double ModelScales::darkness_of(double intensity) const {
  if (!(log_contrast > 0.0)) return 0.0;
  if (!(intensity > 0.0)) return darkness_high;
  const double white = level[static_cast<std::size_t>(Print::kWhite)];
  return std::clamp(std::log(white / intensity) / log_contrast, darkness_low, darkness_high);
}

double ModelScales::intensity_at(double darkness) const {
  return level[static_cast<std::size_t>(Print::kWhite)] * std::exp(-darkness * log_contrast);
}

ModelScales scales_of(const MeasurementTable& table) {
  ModelScales out;
  out.level = table.level;
  out.log_contrast = table.has_intensity ? table.log_contrast : 0.0;
  out.lines = table.lines;
  for (const RangeRow& row : table.range) {
    out.darkness_low = std::min(out.darkness_low, row.beam.darkness);
    out.darkness_high = std::max(out.darkness_high, row.beam.darkness);
    out.incidence_high_rad = std::max(out.incidence_high_rad, row.beam.incidence_rad);
  }
  return out;
}

MeasurementTable empty_table(const ModelScales& scales) {
  MeasurementTable table;
  table.scenes.push_back({});
  table.level = scales.level;
  table.log_contrast = scales.log_contrast;
  table.has_intensity = scales.log_contrast > 0.0;
  table.lines = scales.lines;
  table.has_time = true;
  return table;
}

}  // namespace lvcalib
