// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/message.h"
#include "model/channel.h"
#include "model/measurement_table.h"

namespace lvcalib {

/// One row of the table, of whatever channel: what a covariate is read from. The pointers that do
/// not belong to the row's channel are null.
struct CovariateSource {
  const BeamPoint* beam = nullptr;
  const RangeRow* range = nullptr;
  const BoundaryRow* boundary = nullptr;
  const CornerRow* corner = nullptr;
  const IntensityRow* intensity = nullptr;
  const Camera* camera = nullptr;  ///< Of a corner.
  int axis = 0;                    ///< Of a corner: 0 for u, 1 for v.

  static CovariateSource of(const BeamPoint& beam);
  static CovariateSource of(const RangeRow& row);
  static CovariateSource of(const BoundaryRow& row);
  static CovariateSource of(const IntensityRow& row);
  static CovariateSource of(const CornerRow& row, const Camera& camera, int axis);
};

/// What the place of a row's measurement is described by.
struct RowCovariate {
  const char* name;  ///< For people: "tilt direction".
  const char* unit;  ///< SI or px; "1" for pure numbers, empty for labels.
  bool categories;   ///< Values are labels (tag, node, line), not a scale.
  bool of_beam;      ///< Needs nothing but the beam.
  bool scanned;      ///< Takes part in the search for structure.
  bool needs_time;
  bool needs_line;
  double (*value)(const MeasurementTable& table, const CovariateSource& row);

  /// The name as formulas write it: lower case, words joined by "_" ("tilt_direction").
  [[nodiscard]] std::string identifier() const;
};

/// All covariates of a channel in a fixed order, whether this or that table has them or not.
const std::vector<RowCovariate>& row_covariates(Channel channel);

/// A covariate by name or identifier; nullptr if there is none.
const RowCovariate* find_covariate(Channel channel, std::string_view name);

/// A covariate as a place of a message, in the reader's words ("laser line" of "line"); or several.
Message covariates_named(const std::vector<std::string>& names);

/// Whether the table has what the covariate needs.
bool has_covariate(const MeasurementTable& table, const RowCovariate& covariate);

/// Every row of a channel as a source of covariates; corners give two, u and v.
std::vector<CovariateSource> covariate_sources(const MeasurementTable& table, Channel channel);

}  // namespace lvcalib
