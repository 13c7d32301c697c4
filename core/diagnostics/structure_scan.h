// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "diagnostics/covariates.h"
#include "solve/fit_inference.h"

namespace lvcalib {

/// Structure that a covariate explains in held-out scenes.
struct StructureScore {
  Channel channel = Channel::kCorner;
  std::string covariate;
  double score = 0.0;      ///< Share of held-out variance.
  double amplitude = 0.0;  ///< RMS of the curve, display units.
  /// A closed form that predicts scenes held out as well, as a formula to ask for; empty if none.
  std::string formula = {};
  double formula_score = 0.0;  ///< Share of held-out variance that it explains.
  /// Of surfaces: largest deviation from the median, in standard deviations of one row.
  double height = 0.0;
  /// Gain of every scene held out, in units of log-density (half the fall of whitened squares).
  std::vector<double> scene_gain = {};
  /// What a curve or surface over it would do to the extrinsic, where it was asked for, and whether
  /// that exceeds the tolerance.
  ExtrinsicMove extrinsic_move = {};
  bool matters = false;
  /// Of a surface over two covariates; empty of a curve.
  std::string second_covariate = {};
  /// What one number for all rows of the channel explains of it: over every covariate alike.
  double everywhere = 0.0;
  /// Whether it is at a place: on the board, in the field of view, in the image. Of curves those
  /// over azimuth and along the board; over elevation also what differs from line to line shows.
  [[nodiscard]] bool is_at_a_place() const;
  /// What is not everywhere alike.
  [[nodiscard]] double local_score() const { return score - everywhere; }
  /// One name, or the two of a surface.
  [[nodiscard]] std::vector<std::string> covariates() const {
    if (second_covariate.empty()) return {covariate};
    return {covariate, second_covariate};
  }
};

/// What a scan found, best first, scenes held out one by one.
struct StructureScan {
  /// Of every covariate of every channel, the share of held-out variance that a smooth curve
  /// explains: cubic B-splines (shrunken means for categories) fitted on all scenes but one and
  /// predicted on that one, whose pose and levels are fitted again. `amplitude` is the curve's RMS.
  /// Not above zero if there is none. Eight splines, or thirty-two if the rows bear them and scenes
  /// held out prefer them.
  std::vector<StructureScore> curves;
  /// Something local, a bump on the board or a flaw in the field of view, hardly shows over one
  /// covariate: surfaces over the board and over azimuth and elevation (8 × 8 splines), those that
  /// predict scenes held out better than the curves of their covariates.
  std::vector<StructureScore> places;
};
StructureScan scan_structure(const MeasurementTable& table, EveryResidual residuals,
                             const RunContext& context);
StructureScan scan_structure(const MeasurementTable& table, const ModelState& state,
                             const std::vector<EffectInUse>& in_use, const RunContext& context);

/// What a curve or surface of the kind of `place` (one of a StructureScan) predicts of other
/// residuals of its channel, best of one curve or surface.
StructureScore place_score(const StructureScore& place, const MeasurementTable& table,
                           ChannelResiduals residuals);

/// Orders scores by the share that they explain, those that are equal as they were.
void sort_best_first(std::vector<StructureScore>& scores);

}  // namespace lvcalib
