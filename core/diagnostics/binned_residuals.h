// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace lvcalib {

/// Mean of a group of residuals, how sure it is, and whether it differs from zero.
struct MeanResidual {
  double mean = 0.0;
  /// Standard deviation of the mean: the largest of what the stated noise, the scatter within the
  /// group and the scatter between scenes (cluster-robust; three scenes or more) give. Residuals of
  /// a scene err together, so that their number alone would promise too much.
  double sigma = 0.0;
  std::size_t n = 0;
  int scenes = 0;
  /// Student's t test at 5 %, divided by the number of groups that are looked at together.
  bool significant = false;
};

/// Columns of equal length that are grouped: residuals with their standard deviations and scenes.
struct ResidualSample {
  std::span<const float> value;
  std::span<const float> sigma;
  std::span<const int> scene;
};

/// Mean over some rows; `groups`: how many means are looked at together.
MeanResidual mean_residual(const ResidualSample& sample, std::span<const std::size_t> rows,
                           std::size_t groups);

/// Means along a covariate.
struct ResidualBin {
  double center = 0.0;  ///< Mean of the covariate in the bin.
  MeanResidual residual;
};
/// Groups by equal shares of rows along `x` (labels: one group each), of at least 8 rows.
std::vector<ResidualBin> bin_residuals(std::span<const float> x, bool labels,
                                       const ResidualSample& sample, int bins = 24);

/// Means over the cells of a plane, of one or two components (an arrow).
struct ResidualCell {
  double x = 0.0;  ///< Centre of the cell.
  double y = 0.0;
  MeanResidual first;
  MeanResidual second;  ///< n = 0 if there is one component only.
  [[nodiscard]] bool significant() const { return first.significant || second.significant; }
};
struct ResidualMap {
  double x_low = 0.0, x_high = 1.0, y_low = 0.0, y_high = 1.0;
  int columns = 0;
  int rows = 0;
  std::vector<ResidualCell> cells;  ///< Only those with enough rows.
};
/// Equal cells over the range of x and y, about `cells` along the longer side (less if there are
/// few rows). `component` (0 or 1 per row) tells the two of an arrow apart; empty: one.
ResidualMap map_residuals(std::span<const float> x, std::span<const float> y,
                          std::span<const int> component, const ResidualSample& sample,
                          int cells = 24);

}  // namespace lvcalib
