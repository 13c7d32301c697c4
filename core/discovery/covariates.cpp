// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/covariates.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

using RowValue = std::function<double(std::size_t row, std::size_t k)>;

class CovariateList {
 public:
  CovariateList(const MeasurementTable& table, const ChannelResiduals& residuals)
      : table_(table), residuals_(residuals) {}

  void add(const char* name, const char* unit, const RowValue& value, bool categories = false) {
    Covariate c{name, unit, categories, {}};
    c.values.reserve(residuals_.row.size());
    float low = HUGE_VALF;
    float high = -HUGE_VALF;
    for (std::size_t k = 0; k < residuals_.row.size(); ++k) {
      c.values.push_back(static_cast<float>(value(residuals_.row[k], k)));
      low = std::min(low, c.values.back());
      high = std::max(high, c.values.back());
    }
    if (high > low) out_.push_back(std::move(c));
  }

  template <class BeamOf>
  void add_beam(const BeamOf& beam) {
    add("board x", "m", [&](auto r, auto) { return beam(r).board_m.x(); });
    add("board y", "m", [&](auto r, auto) { return beam(r).board_m.y(); });
    const Eigen::Vector2d center = table_.target.outline().center_m();
    add("board radius", "m", [&](auto r, auto) { return (beam(r).board_m - center).norm(); });
    add("range", "m", [&](auto r, auto) { return beam(r).range_m; });
    add("azimuth", "rad", [&](auto r, auto) { return beam(r).azimuth_rad; });
    add("elevation", "rad", [&](auto r, auto) { return beam(r).elevation_rad; });
    add("incidence", "rad", [&](auto r, auto) { return beam(r).incidence_rad; });
    add("tilt direction", "rad", [&](auto r, auto) { return beam(r).slope_rad; });
    add("scene clock", "1",
        [&](auto r, auto) { return table_.scenes[static_cast<std::size_t>(beam(r).scene)].clock; });
    if (table_.has_time) {
      add("time in scan", "s", [&](auto r, auto) { return beam(r).time_s; });
      add("scan speed", "rad/s", [&](auto r, auto) { return beam(r).scan_rad_s.norm(); });
      add("scan direction", "rad",
          [&](auto r, auto) { return std::atan2(beam(r).scan_rad_s.y(), beam(r).scan_rad_s.x()); });
    }
    if (!table_.lines.empty())
      add(
          "line", "", [&](auto r, auto) { return beam(r).line; }, true);
  }

  std::vector<Covariate> take() { return std::move(out_); }

 private:
  const MeasurementTable& table_;
  const ChannelResiduals& residuals_;
  std::vector<Covariate> out_;
};

void add_corner(CovariateList& list, const MeasurementTable& table,
                const ChannelResiduals& residuals) {
  const auto& rows = table.corner;
  const Camera& camera = table.camera;
  const auto from_center = [&](std::size_t r) -> Eigen::Vector2d {
    return rows[r].pixel - Eigen::Vector2d(camera.cx, camera.cy);
  };
  // u and v rows alternate; a direction's component of this row.
  const auto axis = [&](std::size_t k) {
    return k > 0 && residuals.row[k] == residuals.row[k - 1] ? 1 : 0;
  };
  list.add("image x", "px", [&](auto r, auto) { return rows[r].pixel.x(); });
  list.add("image y", "px", [&](auto r, auto) { return rows[r].pixel.y(); });
  list.add("image radius", "px", [&](auto r, auto) { return from_center(r).norm(); });
  list.add("radial from image centre", "px",
           [&](auto r, auto k) { return from_center(r)(axis(k)); });
  list.add("radial from tag centre", "1",
           [&](auto r, auto k) { return image_direction_from_tag(rows[r])(axis(k)); });
  list.add("tag size", "px", [&](auto r, auto) { return rows[r].from_tag_px.norm(); });
  list.add("board x", "m", [&](auto r, auto) { return rows[r].board_m.x(); });
  list.add("board y", "m", [&](auto r, auto) { return rows[r].board_m.y(); });
  list.add("sub-pixel phase", "px", [&](auto r, auto k) {
    const double p = rows[r].pixel(axis(k));
    return p - std::floor(p);
  });
  list.add(
      "tag", "", [&](auto r, auto) { return rows[r].feature; }, true);
  list.add(
      "corner", "", [&](auto r, auto k) { return 2 * rows[r].corner + axis(k); }, true);
}

void add_range(CovariateList& list, const MeasurementTable& table) {
  const auto& rows = table.range;
  list.add_beam([&](std::size_t r) -> const BeamPoint& { return rows[r].beam; });
  list.add("darkness", "1", [&](auto r, auto) { return rows[r].beam.darkness; });
  list.add(
      "print", "", [&](auto r, auto) { return static_cast<int>(rows[r].print); }, true);
  list.add("intensity", "1", [&](auto r, auto) { return rows[r].intensity; });
  list.add("inverse range", "1/m", [&](auto r, auto) { return 1.0 / rows[r].beam.range_m; });
  list.add("distance to edge", "m",
           [&](auto r, auto) { return rows[r].beam.edge ? rows[r].beam.edge->distance_m : 1.0; });
}

void add_boundary(CovariateList& list, const MeasurementTable& table) {
  const auto& rows = table.boundary;
  list.add_beam([&](std::size_t r) -> const BeamPoint& { return rows[r].beam; });
  list.add("polar angle", "rad", [&](auto r, auto) { return rows[r].psi_rad; });
  list.add("polar angle to tilt", "rad", [&](auto r, auto) {
    return std::remainder(rows[r].psi_rad - rows[r].beam.slope_rad, 2.0 * M_PI);
  });
  list.add("polar angle to LiDAR axes", "rad", [&](auto r, auto) {
    const Eigen::Vector2d n = lidar_angle_of(rows[r]);
    return std::atan2(n.y(), n.x());
  });
  if (table.has_time) {
    list.add("scan across edge", "rad/s",
             [&](auto r, auto) { return rows[r].beam.scan_rad_s.dot(lidar_angle_of(rows[r])); });
  }
  list.add("contrast", "1", [&](auto r, auto) { return rows[r].log_contrast; });
  list.add(
      "node", "", [&](auto r, auto) { return rows[r].node; }, true);
}

}  // namespace

std::vector<Covariate> covariates_of(const MeasurementTable& table, Channel channel,
                                     const ChannelResiduals& residuals) {
  CovariateList list(table, residuals);
  switch (channel) {
    case Channel::kCorner:
      add_corner(list, table, residuals);
      break;
    case Channel::kRange:
      add_range(list, table);
      break;
    case Channel::kBoundary:
      add_boundary(list, table);
      break;
    case Channel::kIntensity:
      list.add_beam([&](std::size_t r) -> const BeamPoint& { return table.intensity[r].beam; });
      list.add(
          "print", "", [&](auto r, auto) { return static_cast<int>(table.intensity[r].print); },
          true);
      break;
  }
  return list.take();
}

}  // namespace lvcalib
