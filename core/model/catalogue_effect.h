// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include "model/effect.h"

namespace lvcalib {

/// Base of the effects in effects/: a description and, mostly, fixed parameters. A prior_sigma lies
/// well beyond the sizes that `source` reports: it keeps finite what no data tell, and hardly draws
/// what they do.
class CatalogueEffect : public Effect {
 public:
  CatalogueEffect(EffectInfo info, std::vector<EffectParameter> parameters)
      : info_(std::move(info)), parameters_(std::move(parameters)) {}
  [[nodiscard]] const EffectInfo& info() const override { return info_; }
  [[nodiscard]] std::vector<EffectParameter> parameters(const MeasurementTable&) const override {
    return parameters_;
  }

 private:
  EffectInfo info_;
  std::vector<EffectParameter> parameters_;
};

/// A parameter, and others that differ from it in their names alone.
std::vector<EffectParameter> alike(const EffectParameter& first,
                                   std::initializer_list<const char*> others);

/// Displacements of a point at its range when azimuth·cos(elevation) or elevation grow by one rad.
struct AngleAxes {
  Eigen::Vector3d azimuth_m;
  Eigen::Vector3d elevation_m;
};
AngleAxes angle_axes(const BeamPoint& beam);

/// Change of (azimuth·cos elevation, elevation) by which a beam moves along the outward normal of
/// an edge, as a unit vector: the polar angle ψ′ against the LiDAR's axes.
Eigen::Vector2d lidar_angle_of(const BoundaryRow& row);

/// ln of the power that print sends back, cos θ/r², beside the same print seen squarely at three
/// metres.
double log_power(double range_m, double incidence_rad);

/// The same parameter once per laser line, named "a3" for line 3.
std::vector<EffectParameter> one_per_line(const MeasurementTable& table,
                                          const EffectParameter& parameter);
/// Place of a line among the table's lines; a large number if it is not there.
std::size_t line_index(const MeasurementTable& table, int line);

/// A board point with the outline at −1 and 1.
Eigen::Vector2d on_unit_square(const Eigen::Vector2d& board_m, const Target& target);

/// Unit vector in the image from the tag's centre to the corner; zero if the corner has no tag.
Eigen::Vector2d image_direction_from_tag(const CornerRow& row);

/// Wave lengths between 5 cm and 1 m, so dense that over the ranges in the table neighbours differ
/// by a quarter turn.
std::vector<double> period_grid(const MeasurementTable& table);

/// sin θ cos(ψ−α) (σ/cos θ)² I′(d)/I(d) at a beam whose spot sees one edge of the
/// print, in metres; zero elsewhere.
double edge_pull(const BeamPoint& beam, const MeasurementTable& table);

}  // namespace lvcalib
