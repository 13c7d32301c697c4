// SPDX-License-Identifier: BSD-3-Clause
#include "model/row_covariates.h"

#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

using Table = MeasurementTable;
using Source = CovariateSource;

using Value = double (*)(const Table&, const Source&);

// Kinds of covariates: of any row, of the beam alone, labels.
constexpr RowCovariate of_row(const char* name, const char* unit, Value value) {
  return {.name = name,
          .unit = unit,
          .categories = false,
          .of_beam = false,
          .scanned = true,
          .needs_time = false,
          .needs_line = false,
          .value = value};
}
constexpr RowCovariate of_beam(const char* name, const char* unit, Value value) {
  RowCovariate out = of_row(name, unit, value);
  out.of_beam = true;
  return out;
}
constexpr RowCovariate labels(const char* name, Value value) {
  RowCovariate out = of_row(name, "", value);
  out.categories = true;
  return out;
}
constexpr RowCovariate timed(RowCovariate covariate) {
  covariate.needs_time = true;
  return covariate;
}
constexpr RowCovariate line_of_beam() {
  RowCovariate out = labels(
      "line", [](const Table&, const Source& s) { return static_cast<double>(s.beam->line); });
  out.of_beam = true;
  out.needs_line = true;
  return out;
}
// 0 for u and 1 for v: lets a formula act along one axis only.
constexpr RowCovariate axis_of_corner() {
  RowCovariate out =
      labels("axis", [](const Table&, const Source& s) { return static_cast<double>(s.axis); });
  out.scanned = false;
  return out;
}

double scan_across_edge(const Table&, const Source& s) {
  return s.boundary->beam.scan_rad_s.dot(lidar_angle_of(*s.boundary));
}

double sub_pixel_phase(const Table&, const Source& s) {
  const double p = s.corner->pixel(s.axis);
  return p - std::floor(p);
}

Eigen::Vector2d from_image_center(const Source& s) {
  return s.corner->pixel - Eigen::Vector2d(s.camera->cx, s.camera->cy);
}

std::vector<RowCovariate> beam_covariates() {
  std::vector<RowCovariate> out{
      of_beam("board x", "m", [](const Table&, const Source& s) { return s.beam->board_m.x(); }),
      of_beam("board y", "m", [](const Table&, const Source& s) { return s.beam->board_m.y(); }),
      of_beam("board radius", "m",
              [](const Table& t, const Source& s) {
                return (s.beam->board_m - t.target.outline().center_m()).norm();
              }),
      of_beam("range", "m", [](const Table&, const Source& s) { return s.beam->range_m; }),
      of_beam("azimuth", "rad", [](const Table&, const Source& s) { return s.beam->azimuth_rad; }),
      of_beam("elevation", "rad",
              [](const Table&, const Source& s) { return s.beam->elevation_rad; }),
      of_beam("incidence", "rad",
              [](const Table&, const Source& s) { return s.beam->incidence_rad; }),
      of_beam("tilt direction", "rad",
              [](const Table&, const Source& s) { return s.beam->slope_rad; }),
      of_beam("scene clock", "1",
              [](const Table& t, const Source& s) {
                return t.scenes[static_cast<std::size_t>(s.beam->scene)].clock;
              }),
      timed(of_beam("time in scan", "s",
                    [](const Table&, const Source& s) { return s.beam->time_s; })),
      timed(of_beam("scan speed", "rad/s",
                    [](const Table&, const Source& s) { return s.beam->scan_rad_s.norm(); })),
      timed(of_beam("scan direction", "rad",
                    [](const Table&, const Source& s) {
                      return std::atan2(s.beam->scan_rad_s.y(), s.beam->scan_rad_s.x());
                    })),
      line_of_beam()};
  return out;
}

std::vector<RowCovariate> corner_covariates() {
  return {
      of_row("image x", "px", [](const Table&, const Source& s) { return s.corner->pixel.x(); }),
      of_row("image y", "px", [](const Table&, const Source& s) { return s.corner->pixel.y(); }),
      of_row("image radius", "px",
             [](const Table&, const Source& s) { return from_image_center(s).norm(); }),
      of_row("radial from image centre", "px",
             [](const Table&, const Source& s) { return from_image_center(s)(s.axis); }),
      of_row("radial from tag centre", "1",
             [](const Table&, const Source& s) {
               return image_direction_from_tag(*s.corner)(s.axis);
             }),
      of_row("tag size", "px",
             [](const Table&, const Source& s) { return s.corner->from_tag_px.norm(); }),
      of_row("board x", "m", [](const Table&, const Source& s) { return s.corner->board_m.x(); }),
      of_row("board y", "m", [](const Table&, const Source& s) { return s.corner->board_m.y(); }),
      of_row("sub-pixel phase", "px", sub_pixel_phase),
      labels("tag",
             [](const Table&, const Source& s) { return static_cast<double>(s.corner->feature); }),
      labels("corner",
             [](const Table&, const Source& s) {
               return static_cast<double>(2 * s.corner->corner + s.axis);
             }),
      axis_of_corner()};
}

std::vector<RowCovariate> range_covariates() {
  std::vector<RowCovariate> out = beam_covariates();
  out.push_back(
      of_beam("darkness", "1", [](const Table&, const Source& s) { return s.beam->darkness; }));
  out.push_back(labels(
      "print", [](const Table&, const Source& s) { return static_cast<double>(s.range->print); }));
  out.push_back(
      of_row("intensity", "1", [](const Table&, const Source& s) { return s.range->intensity; }));
  out.push_back(of_beam("inverse range", "1/m",
                        [](const Table&, const Source& s) { return 1.0 / s.beam->range_m; }));
  out.push_back(of_beam("distance to edge", "m", [](const Table&, const Source& s) {
    return s.beam->edge ? s.beam->edge->distance_m : 1.0;
  }));
  return out;
}

std::vector<RowCovariate> boundary_covariates() {
  std::vector<RowCovariate> out = beam_covariates();
  out.push_back(of_row("polar angle", "rad",
                       [](const Table&, const Source& s) { return s.boundary->psi_rad; }));
  out.push_back(of_row("polar angle to tilt", "rad", [](const Table&, const Source& s) {
    return std::remainder(s.boundary->psi_rad - s.boundary->beam.slope_rad, 2.0 * std::numbers::pi);
  }));
  out.push_back(of_row("polar angle to LiDAR axes", "rad", [](const Table&, const Source& s) {
    const Eigen::Vector2d n = lidar_angle_of(*s.boundary);
    return std::atan2(n.y(), n.x());
  }));
  out.push_back(timed(of_row("scan across edge", "rad/s", scan_across_edge)));
  out.push_back(of_row("contrast", "1",
                       [](const Table&, const Source& s) { return s.boundary->log_contrast; }));
  out.push_back(labels(
      "node", [](const Table&, const Source& s) { return static_cast<double>(s.boundary->node); }));
  return out;
}

std::vector<RowCovariate> intensity_covariates() {
  std::vector<RowCovariate> out = beam_covariates();
  out.push_back(labels("print", [](const Table&, const Source& s) {
    return static_cast<double>(s.intensity->print);
  }));
  return out;
}

std::string as_identifier(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    out += std::isalnum(u) != 0 ? static_cast<char>(std::tolower(u)) : '_';
  }
  return out;
}

}  // namespace

CovariateSource CovariateSource::of(const BeamPoint& beam) {
  CovariateSource out;
  out.beam = &beam;
  return out;
}

CovariateSource CovariateSource::of(const RangeRow& row) {
  CovariateSource out = of(row.beam);
  out.range = &row;
  return out;
}

CovariateSource CovariateSource::of(const BoundaryRow& row) {
  CovariateSource out = of(row.beam);
  out.boundary = &row;
  return out;
}

CovariateSource CovariateSource::of(const IntensityRow& row) {
  CovariateSource out = of(row.beam);
  out.intensity = &row;
  return out;
}

CovariateSource CovariateSource::of(const CornerRow& row, const Camera& camera, int axis) {
  CovariateSource out;
  out.corner = &row;
  out.camera = &camera;
  out.axis = axis;
  return out;
}

std::string RowCovariate::identifier() const {
  return as_identifier(name);
}

const std::vector<RowCovariate>& row_covariates(Channel channel) {
  static const std::array<std::vector<RowCovariate>, kChannels> all{
      corner_covariates(), range_covariates(), boundary_covariates(), intensity_covariates()};
  return all[static_cast<std::size_t>(channel)];
}

const RowCovariate* find_covariate(Channel channel, std::string_view name) {
  const std::string wanted = as_identifier(name);
  for (const RowCovariate& c : row_covariates(channel)) {
    if (c.identifier() == wanted) return &c;
  }
  return nullptr;
}

Message covariates_named(const std::vector<std::string>& names) {
  // Short where a formula names them, longer where nothing says what they belong to.
  static const std::map<std::string, const char*> longer{
      {"line", "laser line"}, {"corner", "corner and axis"}, {"node", "circle"}};
  std::vector<Message> out;
  for (const std::string& name : names) {
    const auto at = longer.find(name);
    out.push_back(Message::listed(at == longer.end() ? name : at->second));
  }
  return all_of(out);
}

bool has_covariate(const MeasurementTable& table, const RowCovariate& covariate) {
  return (!covariate.needs_time || table.has_time) &&
         (!covariate.needs_line || !table.lines.empty());
}

std::vector<CovariateSource> covariate_sources(const MeasurementTable& table, Channel channel) {
  std::vector<CovariateSource> out;
  switch (channel) {
    case Channel::kCorner:
      for (const CornerRow& r : table.corner) {
        out.push_back(CovariateSource::of(r, table.camera, 0));
        out.push_back(CovariateSource::of(r, table.camera, 1));
      }
      break;
    case Channel::kRange:
      for (const RangeRow& r : table.range) out.push_back(CovariateSource::of(r));
      break;
    case Channel::kBoundary:
      for (const BoundaryRow& r : table.boundary) out.push_back(CovariateSource::of(r));
      break;
    case Channel::kIntensity:
      for (const IntensityRow& r : table.intensity) out.push_back(CovariateSource::of(r));
      break;
  }
  return out;
}

}  // namespace lvcalib
