// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/units.h"
#include "report/exports.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

using nlohmann::json;

constexpr const char* kExplanation =
    R"(#
# Noise of a LiDAR point at a reflectivity edge (black against white, paint against asphalt):
# covariance of (pitch [rad], yaw [rad], range [m]) of the point about the edge, seen along the line
# of sight. pitch grows upwards, yaw towards z × sight; both are true angles. Row by row.
#   all:                     over all scenes
#   cells:                   by range [m] and angle of incidence [deg] (0: head-on), each [low, high)
#     n                      samples; cells with too few have no covariance: use `all`
#     mean                   mean offset of (pitch [rad], yaw [rad], range [m])
#   transition.width_rad     one sigma of the black-white transition, as an angle: how near to an
#                            edge a point must be for its intensity to be a mixture
#
# How to weigh a point-to-plane residual r = n·(R p + t − q) with it (C++, Eigen):
#
#   // p: point in the LiDAR frame; C: covariance from the cell of its range and incidence;
#   // n: unit normal of the map's plane, turned to the LiDAR frame; sigma_map: the plane's own.
#   Eigen::Vector3d s = p.normalized();
#   Eigen::Vector3d yaw = Eigen::Vector3d::UnitZ().cross(s).normalized();
#   Eigen::Matrix3d J;                       // point by (pitch, yaw, range)
#   J << p.norm() * s.cross(yaw), p.norm() * yaw, s;
#   double variance = n.dot(J * C * J.transpose() * n) + sigma_map * sigma_map;
#   double weight = 1.0 / variance;          // minimise the sum of weight * r * r
#
# A point is on an edge if its intensity lies between its neighbours' on either side. Points off
# edges take the angular part of C too when the LiDAR's beam jitters (it does so everywhere), with
# the front end's usual range noise in place of C(2, 2).
)";

std::string short_number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", v);
  return text;
}

std::string flow(const json& list) {
  std::string out = "[";
  for (const json& v : list) {
    if (out.size() > 1) out += ", ";
    out += v.is_array() ? flow(v) : short_number(v.get<double>());
  }
  return out + "]";
}

std::string statistics(const json& j, const std::string& indent) {
  const auto value = [&](const char* key) { return j.at(key).get<double>(); };
  std::string out = indent + "n: " + std::to_string(j.at("n").get<long>()) + "\n";
  if (!j.contains("covariance")) return out;
  out += indent + "mean: [" + short_number(kRadPerDeg * value("mean_pitch_deg")) + ", " +
         short_number(kRadPerDeg * value("mean_yaw_deg")) + ", " +
         short_number(1e-3 * value("mean_range_mm")) + "]\n";
  return out + indent + "covariance: " + flow(j.at("covariance")) + "\n";
}

std::string body(const json& response) {
  const json& all = response.at("all");
  std::string out = "boundary_response:\n  units: {pitch: rad, yaw: rad, range: m}\n  all:\n" +
                    statistics(all, "    ");
  const double width =
      kRadPerDeg * std::sqrt(0.5 * (std::pow(all.at("std_pitch_deg").get<double>(), 2) +
                                    std::pow(all.at("std_yaw_deg").get<double>(), 2)));
  out += "  transition:\n    width_rad: " + short_number(width) + "\n  cells:\n";
  for (const json& cell : response.at("by_range_and_incidence")) {
    out += "    - range_m: " + flow(cell.at("range_m")) +
           "\n      incidence_deg: " + flow(cell.at("incidence_deg")) + "\n" +
           statistics(cell, "      ");
  }
  return out;
}

}  // namespace

Result<std::string> export_boundary_response(const ExportInput& input) {
  const json j = parse_json(input.result_json);
  if (j.is_discarded() || !j.is_object() || !j.contains("boundary_response")) {
    return Error::untrusted(Message("this result holds no boundary response"), {},
                            Message("calibrate again with this version"));
  }
  try {
    const json& response = j.at("boundary_response");
    if (response.at("all").value("covariance", json()).is_null()) {
      const auto stated = response.find("reason");
      const Message reason = stated == response.end()
                                 ? Message("not enough samples")
                                 : Message::verbatim(stated->get<std::string>());
      return Error::untrusted(Message("there is no boundary response to export: %1", reason));
    }
    std::string notes;
    for (const std::string& note : origin_notes(input)) notes += "# " + note + "\n";
    return notes + kExplanation + body(response);
  } catch (const json::exception& e) {
    return Error::input(Message("the boundary response of this result is malformed: %1", e.what()));
  }
}

}  // namespace lvcalib
