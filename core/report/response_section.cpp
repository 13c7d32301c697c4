// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

#include "base/statistics.h"
#include "report/report_figures.h"
#include "report/report_sections.h"

namespace lvcalib {
namespace {

using nlohmann::json;

constexpr const char* kColors[] = {"#345c9c", "#b3541e", "#23793b",
                                   "#7a3e8e", "#8a6d00", "#1f7a85"};

std::string with_sigma(const json& j, const std::string& key, const std::string& sigma) {
  return shown(j.at(key).get<double>(), 3) + " ± " + shown(j.at(sigma).get<double>(), 2);
}

std::vector<std::string> statistics_row(const std::string& name, const json& j) {
  std::vector<std::string> row = {name, std::to_string(j.at("n").get<long>())};
  if (!j.contains("mean_pitch_deg")) {
    row.push_back(html_escaped(j.value("reason", "not enough samples")));
    row.resize(8, "–");
    return row;
  }
  for (const char* what : {"mean", "std"}) {
    for (const char* of : {"pitch_deg", "yaw_deg", "range_mm"}) {
      row.push_back(
          with_sigma(j, std::string(what) + "_" + of, std::string(what) + "_sigma_" + of));
    }
  }
  return row;
}

const std::vector<std::string>& head() {
  static const std::vector<std::string> cells = {"",
                                                 "N",
                                                 "mean pitch [°]",
                                                 "mean yaw [°]",
                                                 "mean range [mm]",
                                                 "σ pitch [°]",
                                                 "σ yaw [°]",
                                                 "σ range [mm]"};
  return cells;
}

// Intensity by distance, scaled to the levels of each scene, and the common fit.
std::string transition_figure(const json& response) {
  SvgPlot plot({-30.0, 30.0}, {-0.2, 1.2}, "distance from the circle [mm]",
               "intensity, black 0 to white 1");
  std::size_t k = 0;
  for (const json& scene : response.at("scenes")) {
    if (!scene.contains("transition")) continue;
    const json& t = scene["transition"];
    const double in = t.at("mu_in").get<double>();
    const double contrast = t.at("mu_out").get<double>() - in;
    std::vector<Eigen::Vector2d> points;
    for (const json& bin : scene.at("curve")) {
      const double d = bin.at("d_mm").get<double>();
      if (std::abs(d) < 30.0 && bin.at("n").get<int>() >= 3)
        points.emplace_back(d, (bin.at("mean").get<double>() - in) / contrast);
    }
    plot.dots(points, kColors[k++ % std::size(kColors)], 2.2);
  }
  const json& t = response.at("transition");
  if (t.is_object()) {
    std::vector<Eigen::Vector2d> curve;
    for (double d = -30.0; d <= 30.0; d += 0.5)
      curve.emplace_back(
          d, normal_cdf((d - t.at("delta_mm").get<double>()) / t.at("sigma_mm").get<double>()));
    plot.line(curve, "#111", 1.4);
  }
  std::string caption =
      "Mean intensity by signed distance, one colour per scene; the line is the "
      "error function fitted to all.";
  if (t.is_object()) {
    caption += " δ = " + with_sigma(t, "delta_mm", "delta_sigma_mm") +
               " mm, σ = " + with_sigma(t, "sigma_mm", "sigma_sigma_mm") + " mm.";
  }
  return "<figure>" + plot.svg("intensity transition") + "<figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::vector<Eigen::Vector2d> ellipse_of(const json& statistics) {
  const json& c = statistics.at("covariance");
  const auto at = [&](std::size_t r, std::size_t k) { return c.at(r).at(k).get<double>(); };
  // Yaw to the right, pitch up; the factor of a lower triangular matrix.
  const double a = std::sqrt(std::max(0.0, at(1, 1)));
  const double b = a > 0 ? at(0, 1) / a : 0.0;
  const double d = std::sqrt(std::max(0.0, at(0, 0) - b * b));
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k <= 72; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / 72;
    const double u = std::cos(phi);
    const double v = std::sin(phi);
    out.push_back(180.0 / std::numbers::pi * Eigen::Vector2d(a * u, b * u + d * v));
  }
  return out;
}

std::string ellipse_figure(const json& response) {
  std::vector<std::vector<Eigen::Vector2d>> rings;
  for (const json& scene : response.at("scenes")) {
    if (scene.contains("covariance")) rings.push_back(ellipse_of(scene));
  }
  const auto all = ellipse_of(response.at("all"));
  double reach = 0.0;
  for (const auto& p : all) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  for (const auto& ring : rings) {
    for (const auto& p : ring) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  }
  reach = std::max(1e-6, 1.1 * reach);
  SvgPlot plot({-reach, reach}, {-reach, reach}, "yaw [°]", "pitch [°]", 320, 304);
  for (std::size_t k = 0; k < rings.size(); ++k)
    plot.line(rings[k], kColors[k % std::size(kColors)], 1.0);
  plot.line(all, "#111", 2.0);
  return "<figure>" + plot.svg("one-sigma ellipses") +
         "<figcaption>One-sigma ellipses of pitch and yaw: scenes in colour, all in "
         "black.</figcaption></figure>\n";
}

std::string histogram_figure(const json& response) {
  std::map<int, double> bins;
  for (const json& scene : response.at("scenes")) {
    for (const json& bin : scene.at("range_histogram"))
      bins[bin.at("low_mm").get<int>()] += bin.at("n").get<double>();
  }
  if (bins.empty()) return "";
  double most = 0.0;
  for (const auto& [low, n] : bins) most = std::max(most, n);
  SvgPlot plot({-60.0, 60.0}, {0.0, 1.05 * most}, "range off the board [mm]", "points");
  for (const auto& [low, n] : bins) {
    if (low >= -60 && low < 60) plot.bar(low, low + 2.0, n, "#88a5cf");
  }
  const double sigma = response.at("all").at("std_range_mm").get<double>();
  for (const double x : {-sigma, sigma}) plot.line({{x, 0.0}, {x, 1.05 * most}}, "#111", 1.0);
  return "<figure>" + plot.svg("range residuals") +
         "<figcaption>Ranges of the overlap samples off the board's plane; lines at one "
         "sigma.</figcaption></figure>\n";
}

std::string cell_table(const json& cells) {
  std::vector<std::vector<std::string>> rows = {head()};
  for (const json& cell : cells) {
    const auto span = [&](const char* key, const char* unit) {
      return shown(cell.at(key).at(0).get<double>(), 3) + "–" +
             shown(cell.at(key).at(1).get<double>(), 3) + " " + unit;
    };
    rows.push_back(statistics_row(span("range_m", "m") + ", " + span("incidence_deg", "°"), cell));
  }
  return html_table(rows);
}

std::string refused_nodes(const json& response) {
  std::string out;
  for (const json& scene : response.at("scenes")) {
    for (const json& node : scene.at("nodes")) {
      const std::string reason = node.at("reason").get<std::string>();
      if (reason.empty()) continue;
      out += "<li>scene " + html_escaped(scene.at("name").get<std::string>()) + ", node " +
             std::to_string(node.at("id").get<int>()) + ": " + html_escaped(reason) + "</li>";
    }
  }
  return out.empty() ? "" : "<p>Circles left out:</p><ul>" + out + "</ul>\n";
}

}  // namespace

std::string response_section(const json& result) {
  std::string out = "<section class=\"scene\"><h2>Boundary response</h2>\n";
  const json& response = result.at("boundary_response");
  if (!response.at("all").value("covariance", json()).is_array()) {
    return out + "<p class=\"note\">" +
           html_escaped(response.value("reason", "not enough samples")) + "</p>\n" +
           refused_nodes(response) + "</section>\n";
  }
  std::vector<std::vector<std::string>> rows = {head()};
  for (const json& scene : response.at("scenes"))
    rows.push_back(statistics_row(html_escaped(scene.at("name").get<std::string>()), scene));
  rows.push_back(statistics_row("all", response.at("all")));
  out +=
      "<p class=\"note\">How returns scatter about a reflectivity edge: mean of the residuals "
      "to the nearest ideal boundary points, and the standard deviations of a beam on the edge. "
      "Statement ± its own standard deviation.</p>\n" +
      html_table(rows) + "<div class=\"figures\">" + transition_figure(response) +
      ellipse_figure(response) + histogram_figure(response) + "</div>\n";
  out += "<h3>By range and incidence</h3>\n" + cell_table(response.at("by_range_and_incidence"));
  return out + refused_nodes(response) + "</section>\n";
}

}  // namespace lvcalib
