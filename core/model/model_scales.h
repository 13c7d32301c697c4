// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "model/measurement_table.h"

namespace lvcalib {

/// What the numbers of a model refer to. Kept with them, so that the model can be applied to other
/// clouds of the same LiDAR.
struct ModelScales {
  std::array<double, kPrints> level{1.0, 1.0};  ///< Usual raw intensity of each print.
  double log_contrast = 0.0;        ///< ln(white/black); 0 if the clouds had no intensity.
  double darkness_low = 0.0;        ///< Range of BeamPoint::darkness on the boards …
  double darkness_high = 1.0;       ///< … outside of which the model is not known.
  double incidence_high_rad = 0.0;  ///< Largest incidence on the boards.
  std::vector<int> lines;           ///< Laser lines, as MeasurementTable::lines.

  /// BeamPoint::darkness of a raw intensity, held within the range of the boards; the darkest for
  /// no intensity at all.
  [[nodiscard]] double darkness_of(double intensity) const;
  /// Raw intensity of a darkness.
  [[nodiscard]] double intensity_at(double darkness) const;
};

ModelScales scales_of(const MeasurementTable& table);

/// A table without rows, with one scene: what effects read beside the beam.
MeasurementTable empty_table(const ModelScales& scales);

}  // namespace lvcalib
