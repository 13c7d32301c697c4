// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pipeline/dataset.h"
#include "report/exports.h"
#include "report/report_figures.h"
#include "report/report_images.h"
#include "report/report_sections.h"

namespace lvcalib {
namespace {

using nlohmann::json;

Rigid3 pose_of(const json& rows) {
  Eigen::Matrix4d m;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c)
      m(r, c) = rows.at(static_cast<std::size_t>(r)).at(static_cast<std::size_t>(c)).get<double>();
  }
  return Rigid3::from_matrix(m);
}

Eigen::Vector3d point_of(const json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

std::string coordinates(const std::vector<Eigen::Vector2d>& points) {
  std::string out;
  char text[64];
  for (const Eigen::Vector2d& p : points) {
    std::snprintf(text, sizeof text, "%.2f,%.2f ", p.x(), p.y());
    out += text;
  }
  return out;
}

// What the overlay needs to put LiDAR features into the image.
class Overlay {
 public:
  Overlay(const Camera& camera, const json& result, const json& scene)
      : camera_(camera),
        camera_from_lidar_(pose_of(result.at("T_camera_lidar").at("matrix"))),
        lidar_from_board_(pose_of(scene.at("T_lidar_board"))),
        radius_m_(result.at("board").at("circle_radius_m").get<double>()) {
    const auto corner = [&](const char* key) {
      const json& c = result.at("board").at(key);
      return Eigen::Vector2d(c.at(0).get<double>(), c.at(1).get<double>());
    };
    low_ = corner("lower_left_m");
    high_ = corner("upper_right_m");
  }

  [[nodiscard]] std::vector<Eigen::Vector2d> outline() const {
    return project({{low_.x(), low_.y(), 0},
                    {high_.x(), low_.y(), 0},
                    {high_.x(), high_.y(), 0},
                    {low_.x(), high_.y(), 0}});
  }

  // The circle about a node as the LiDAR measured it.
  [[nodiscard]] std::vector<Eigen::Vector2d> circle(const Eigen::Vector3d& center_lidar) const {
    constexpr int kSteps = 48;
    const Eigen::Vector3d center = lidar_from_board_.inverse() * center_lidar;
    std::vector<Eigen::Vector3d> points;
    for (int k = 0; k < kSteps; ++k) {
      const double a = 2.0 * std::numbers::pi * k / kSteps;
      points.emplace_back(center.x() + radius_m_ * std::cos(a),
                          center.y() + radius_m_ * std::sin(a), center.z());
    }
    return project(points);
  }

 private:
  [[nodiscard]] std::vector<Eigen::Vector2d> project(
      const std::vector<Eigen::Vector3d>& on_board) const {
    std::vector<Eigen::Vector2d> out;
    for (const Eigen::Vector3d& p : on_board) {
      if (const auto pixel = camera_.project(camera_from_lidar_ * (lidar_from_board_ * p)))
        out.push_back(*pixel);
    }
    return out;
  }

  const Camera& camera_;
  Rigid3 camera_from_lidar_;
  Rigid3 lidar_from_board_;
  double radius_m_;
  Eigen::Vector2d low_, high_;
};

std::optional<std::filesystem::path> image_of(const json& result, const std::string& scene) {
  const auto dataset =
      open_dataset(result.at("dataset").get<std::string>(), UnusableScenes::kLeaveOut);
  if (!dataset) return std::nullopt;
  for (const SceneFiles& files : dataset->scenes) {
    if (files.name == scene) return files.image;
  }
  return std::nullopt;
}

std::string photograph(const json& result, const json& scene, std::vector<Message>& warnings) {
  const std::string name = scene.at("name").get<std::string>();
  const auto camera = camera_from_json_text(result.dump());
  if (!camera || !scene.contains("T_lidar_board")) return "";
  const Overlay overlay(*camera, result, scene);
  const auto outline = overlay.outline();
  const auto path = image_of(result, name);
  if (outline.size() < 3 || !path) {
    warnings.push_back(Message(
        "scene %1: its image is no longer at the dataset's place; the report goes without it",
        name));
    return "<p class=\"note\">The image is no longer where it was.</p>\n";
  }
  Eigen::Vector2d low = outline.front();
  Eigen::Vector2d high = low;
  for (const auto& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector2d room = 0.12 * (high - low);
  const auto image = page_image(*path, low - room, high + room, 1000);
  if (!image) {
    warnings.push_back(Message("scene %1: its image cannot be read", name));
    return "<p class=\"note\">The image cannot be read.</p>\n";
  }
  char box[160];
  std::snprintf(box, sizeof box, "%.2f %.2f %.2f %.2f", image->from_px.x(), image->from_px.y(),
                image->size_px.x(), image->size_px.y());
  char place[160];
  std::snprintf(place, sizeof place, "x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"",
                image->from_px.x(), image->from_px.y(), image->size_px.x(), image->size_px.y());
  const std::string stroke = shown(image->size_px.x() / 500.0, 3);
  std::string out =
      std::string("<figure><svg class=\"photo\" viewBox=\"") + box +
      "\" role=\"img\" aria-label=\"image with the board as the LiDAR measured it\"><image " +
      place + " href=\"" + image->data_uri + "\"/><g fill=\"none\" stroke-width=\"" + stroke +
      "\"><polygon stroke=\"#3f7fd0\" points=\"" + coordinates(outline) + "\"/>";
  for (const json& node : scene.at("nodes")) {
    if (!node.at("valid").get<bool>()) continue;
    out += "<polygon stroke=\"#e0532c\" points=\"" +
           coordinates(overlay.circle(point_of(node.at("center_lidar_m")))) + "\"/>";
  }
  return out + "</g></svg><figcaption>" +
         (scene.at("nodes").empty()
              ? "The board's outline (blue) as the LiDAR measured it, through the extrinsic."
              : "Circles (orange) and board outline (blue) as the LiDAR measured them, through the "
                "extrinsic.") +
         "</figcaption></figure>\n";
}

void collect(const json& nodes, std::vector<Eigen::Vector2d>& points) {
  for (const json& node : nodes) {
    for (const json& bin : node.at("angle_midpoint_sigma"))
      points.emplace_back(180.0 / std::numbers::pi * bin.at(0).get<double>(),
                          bin.at(1).get<double>());
  }
}

std::string refinement_figures(const json& refinement) {
  if (!refinement.contains("profile") || !refinement["profile"].contains("before")) return "";
  std::vector<Eigen::Vector2d> before;
  std::vector<Eigen::Vector2d> after;
  collect(refinement["profile"]["before"], before);
  collect(refinement["profile"]["after"], after);
  std::vector<double> values;
  for (const auto* points : {&before, &after}) {
    for (const auto& p : *points) values.push_back(p.y());
  }
  const AxisRange y = axis_about(values);
  SvgPlot plot({-180.0, 180.0}, y, "angle around the circle [°]", "mid-level [mm]");
  plot.line({{-180.0, 0.0}, {180.0, 0.0}}, "#999", 1.0);
  plot.dots(before, "#b0b7c3", 2.2);
  plot.dots(after, "#23793b", 2.2);
  std::string out = "<figure>" + plot.svg("edge of every circle before and after refinement") +
                    "<figcaption>Edges of all circles by angle: grey before the refinement, green "
                    "after.</figcaption></figure>\n";
  std::vector<Eigen::Vector2d> updates;
  const json& list = refinement.at("max_update_mm");
  for (std::size_t k = 0; k < list.size(); ++k)
    updates.emplace_back(static_cast<double>(k + 1),
                         std::log10(std::max(1e-6, list[k].get<double>())));
  values.clear();
  for (const auto& p : updates) values.push_back(p.y());
  SvgPlot steps({0.5, static_cast<double>(updates.size()) + 0.5}, axis_about(values), "iteration",
                "log₁₀ largest move [mm]");
  steps.line(updates, "#345c9c");
  steps.dots(updates, "#345c9c", 2.5);
  return out + "<figure>" + steps.svg("largest move of a node in every iteration") +
         "<figcaption>Largest move of a node in every iteration.</figcaption></figure>\n";
}

std::string node_table(const json& nodes) {
  std::vector<std::vector<std::string>> rows = {
      {"node", "σ [mm]", "bins", "residual x, y, z [mm]", ""}};
  for (const json& node : nodes) {
    std::string residual = "–";
    if (node.contains("residual_mm")) {
      const Eigen::Vector3d r = point_of(node["residual_mm"]);
      residual = shown(r.x(), 3) + ", " + shown(r.y(), 3) + ", " + shown(r.z(), 3);
    }
    rows.push_back({std::to_string(node.at("id").get<int>()),
                    shown(node.at("sigma_mm").get<double>(), 3),
                    std::to_string(node.at("valid_bins").get<int>()), residual,
                    html_escaped(node.value("reason", ""))});
  }
  return html_table(rows);
}

}  // namespace

std::string scene_section(const json& result, const json& scene, std::vector<Message>& warnings) {
  std::string out = "<section class=\"scene\"><h2>Scene " +
                    html_escaped(scene.at("name").get<std::string>()) + "</h2>\n";
  const std::string reason = scene.at("reason").get<std::string>();
  if (!scene.at("used").get<bool>())
    out += "<p><b>Not used</b>" + (reason.empty() ? "" : ": " + html_escaped(reason)) + "</p>\n";
  // A board without tags has none to count, one without circles no centres to compare.
  const int tags = scene.at("tags").get<int>();
  const json& rms_mm = scene.at("rms_mm");
  out += "<p>" + (tags > 0 ? std::to_string(tags) + " tags, " : "") +
         std::to_string(scene.at("board_points").get<long>()) +
         " LiDAR points on the board; corners " + shown(scene.at("rms_px").get<double>()) + " px" +
         (rms_mm.is_number() ? ", circles " + shown(rms_mm.get<double>()) + " mm" : "") +
         " RMS.</p>\n";
  if (scene.contains("nodes")) {
    out += photograph(result, scene, warnings);
    if (!scene["nodes"].empty()) {
      out += "<div class=\"figures\">" + refinement_figures(scene.at("refinement")) + "</div>\n" +
             node_table(scene["nodes"]);
    }
  }
  return out + "</section>\n";
}

}  // namespace lvcalib
