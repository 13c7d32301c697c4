// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/surface_residuals.h"

#include <algorithm>
#include <cmath>

#include "model/residuals.h"

namespace lvcalib {
namespace {

// Below a footprint's width neighbours share their returns.
constexpr double kFinestCell_m = 5e-3;
// A mean of so many scatters by a quarter of what single returns do.
constexpr double kSamplesPerCell = 16.0;
constexpr int kMostCells = 1000;  // Along one side.

double usual_cell_m(const BoardOutline& outline, std::size_t samples) {
  const Eigen::Vector2d size = outline.size_m();
  const double shared =
      std::sqrt(kSamplesPerCell * size.x() * size.y() / static_cast<double>(1 + samples));
  return std::clamp(shared, kFinestCell_m, std::max(kFinestCell_m, size.minCoeff()));
}

}  // namespace

std::vector<SurfaceSample> range_samples(const FittedModel& model, int scene) {
  const ChannelResiduals residuals =
      residuals_of(model.table, model.state, model.effects, Channel::kRange);
  std::vector<SurfaceSample> out;
  for (std::size_t k = 0; k < residuals.values.size(); ++k) {
    if (residuals.scene[k] != scene) continue;
    out.push_back({model.table.range[residuals.row[k]].beam.board_m, residuals.values[k]});
  }
  return out;
}

std::vector<SurfaceSample> range_samples(const Cloud& cloud,
                                         const std::vector<std::uint32_t>& points,
                                         const BoardPredictor& predictor) {
  std::vector<SurfaceSample> out;
  for (const std::uint32_t i : points) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const auto predicted = predictor.predict(p.normalized());
    if (predicted) out.push_back({predicted->board_m, p.norm() - predicted->range_m});
  }
  return out;
}

SurfaceResiduals::SurfaceResiduals(const BoardOutline& outline,
                                   const std::vector<SurfaceSample>& samples, double cell_m)
    : outline_(outline), cell_m_(cell_m > 0.0 ? cell_m : usual_cell_m(outline, samples.size())) {
  const auto count = [this](double length_m) {
    return std::clamp(static_cast<int>(std::ceil(length_m / cell_m_)), 1, kMostCells);
  };
  columns_ = count(outline.size_m().x());
  rows_ = count(outline.size_m().y());
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  sum_m_.assign(cells, 0.0);
  count_.assign(cells, 0);
  for (const SurfaceSample& sample : samples) {
    const auto at = cell(sample.board_m);
    if (!at) continue;
    sum_m_[*at] += sample.residual_m;
    ++count_[*at];
  }
}

std::optional<std::size_t> SurfaceResiduals::cell(const Eigen::Vector2d& board_m) const {
  const Eigen::Vector2d share = (board_m - outline_.lower_left_m).cwiseQuotient(outline_.size_m());
  if (!(share.minCoeff() >= 0.0 && share.maxCoeff() <= 1.0)) return std::nullopt;
  const int x = std::min(static_cast<int>(share.x() * columns_), columns_ - 1);
  const int y = std::min(static_cast<int>(share.y() * rows_), rows_ - 1);
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(x);
}

std::optional<double> SurfaceResiduals::mean_m(const Eigen::Vector2d& board_m) const {
  const auto at = cell(board_m);
  if (!at || count_[*at] == 0) return std::nullopt;
  return sum_m_[*at] / count_[*at];
}

}  // namespace lvcalib
