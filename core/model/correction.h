// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "cloud/cloud.h"
#include "cloud/local_normals.h"
#include "model/linear_model.h"
#include "model/model_scales.h"

namespace lvcalib {

struct CorrectionOptions {
  std::vector<std::string> skip;  ///< Effects to leave in the cloud.
  /// When the scan was taken, 0 … 1 over the calibration's scenes; drifts need it.
  std::optional<double> clock;
  LocalNormalOptions normals;  ///< For effects of the incidence.
};

/// What a correction could do about one effect of the model.
enum class CorrectionState {
  kTakenOut,
  kSkipped,    ///< As asked.
  kNoClock,    ///< Drifts from scene to scene, and no clock was given.
  kBoardOnly,  ///< Depends on the place on the board or the nearness of its edges.
  kNoPoints,   ///< Moves images, edges or intensities, not points.
};

struct EffectCorrection {
  std::string id;
  CorrectionState state = CorrectionState::kTakenOut;
  std::size_t points = 0;  ///< Points that it moved.
  double rms_m = 0.0;      ///< Movement of these.
  double largest_m = 0.0;
};

/// What was done to a cloud.
struct CorrectionSummary {
  std::size_t points = 0;  ///< Returns in the cloud.
  std::size_t no_surface =
      0;  ///< Kept an effect of the incidence: their surroundings are not flat.
  std::size_t unknown_line =
      0;                 ///< Kept an effect of single lines: calibration did not see theirs.
  std::size_t held = 0;  ///< Darker, brighter or more slanted than the board ever was.
  double rms_m = 0.0;    ///< Movement of all returns.
  double largest_m = 0.0;
  std::vector<EffectCorrection> effects;  ///< In the model's order.
};

/// Takes the effects of a model out of a cloud, in place: p_true = p − Σ value · movement, the
/// movements evaluated at the corrected range (fixed point). Any cloud of the same LiDAR, not only
/// of the board: range walk uses each point's raw intensity on the calibration's scale, the
/// incidence comes from the flat patch around a point. Where intensity or incidence lie outside of
/// what calibration has seen, they are held at its limits. Points that are no returns, order and
/// fields stay as they are.
/// Errors: kInput if the cloud lacks a field that an effect needs (named); kUsage for an effect to
/// skip that is not in the model or a clock outside of 0 … 1; kCancelled, the cloud then being
/// partly corrected.
Result<CorrectionSummary> correct_cloud(Cloud& cloud, const std::vector<EffectInUse>& model,
                                        const ModelScales& scales, const CorrectionOptions& options,
                                        const RunContext& context);

/// Displacement (LiDAR frame, m) of the measured from the true point by one effect at its values.
Eigen::Vector3d point_movement(const EffectInUse& use, const BeamPoint& beam,
                               const MeasurementTable& table,
                               std::vector<Eigen::Vector3d>& scratch);

/// What an effect's movement of points depends on, found by trying: an effect needs no
/// declarations of its own.
struct CorrectionReads {
  bool moves_points = false;  ///< On a surface without edges nearby.
  bool incidence = false;
  bool darkness = false;
  bool clock = false;
  bool time = false;
  bool line = false;
  bool scan = false;   ///< Scan velocity.
  bool board = false;  ///< Place on the board, tilt direction or edges.
};
CorrectionReads correction_reads(const EffectInUse& use, const ModelScales& scales);

}  // namespace lvcalib
