// SPDX-License-Identifier: BSD-3-Clause
#include "model/measurement_table.h"

namespace lvcalib {

std::size_t MeasurementTable::size(Channel channel) const {
  switch (channel) {
    case Channel::kCorner:
      return corner.size();
    case Channel::kRange:
      return range.size();
    case Channel::kBoundary:
      return boundary.size();
    case Channel::kIntensity:
      break;
  }
  return intensity.size();
}

MeasurementTable MeasurementTable::without_rows() const {
  MeasurementTable out;
  out.target = target;
  out.camera = camera;
  out.scenes = scenes;
  out.lines = lines;
  out.has_time = has_time;
  out.has_intensity = has_intensity;
  out.level = level;
  out.log_contrast = log_contrast;
  out.placed_by = placed_by;
  out.print = print;
  out.structure_variances = structure_variances;
  out.sensor_variances = sensor_variances;
  return out;
}

}  // namespace lvcalib
