// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/fitted_model.h"

namespace lvcalib {

/// Intensity over a board, measured and as predicted from the print, the scenes' levels and the
/// model's effects; raw units. Cells without a return are NaN.
struct BoardIntensity {
  int columns = 0;
  int rows = 0;
  std::vector<float> measured;  ///< Row by row from the lower edge.
  std::vector<float> predicted;
  std::vector<float> difference;  ///< measured − predicted
};
/// One scene's (index into the table's), or of all together for −1. `cell_m`: size of a cell; 0:
/// as fine as the returns allow. Empty if the clouds have no intensity.
BoardIntensity board_intensity(const FittedModel& model, int scene, double cell_m = 0.0);

}  // namespace lvcalib
