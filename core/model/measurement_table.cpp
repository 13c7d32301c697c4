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

}  // namespace lvcalib
