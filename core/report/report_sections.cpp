// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_sections.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "report/report_figures.h"
#include "report/result_file.h"
#include "target/target_text.h"

namespace lvcalib {
namespace {

using nlohmann::json;

// Numbers that JSON could not hold are null.
double number_of(const json& j) {
  return j.is_number() ? j.get<double>() : std::nan("");
}

std::string items(const json& list) {
  std::string out;
  for (const json& item : list) out += "<li>" + html_escaped(item.get<std::string>()) + "</li>";
  return out.empty() ? "" : "<ul>" + out + "</ul>\n";
}

std::string matrix_table(const json& rows) {
  std::vector<std::vector<std::string>> cells = {{"", "x", "y", "z", "t [m]"}};
  const char* const names[] = {"x", "y", "z", ""};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::string> row = {names[std::min<std::size_t>(r, 3)]};
    for (const json& v : rows[r]) row.push_back(shown(v.get<double>(), 8));
    cells.push_back(std::move(row));
  }
  return html_table(cells);
}

std::string leave_one_out(const json& result) {
  std::string out = "<h3>Leaving one scene out</h3>\n";
  const json& list = result.at("leave_one_out");
  if (list.empty()) return out + "<p class=\"note\">not enough scenes: three are needed</p>\n";
  std::vector<std::vector<std::string>> rows = {{"without", "moves by [mm]", "turns by [mrad]"}};
  for (const json& l : list) {
    rows.push_back({html_escaped(l.at("without").get<std::string>()),
                    shown(l.at("translation_mm").get<double>()),
                    shown(l.at("rotation_mrad").get<double>())});
  }
  return out + html_table(rows);
}

std::string split_half(const json& uncertainty) {
  std::string out = "<h3>Halves of the scenes against each other</h3>\n";
  if (uncertainty.contains("split_half_reason")) {
    return out + "<p class=\"note\">" +
           html_escaped(uncertainty["split_half_reason"].get<std::string>()) + "</p>\n";
  }
  std::vector<std::vector<std::string>> rows = {
      {"halves", "difference", "by noise alone", "χ² (6)", ""}};
  for (const json& s : uncertainty.at("split_half")) {
    const auto pair = [&](const char* mm, const char* mrad) {
      return shown(s.at(mm).get<double>(), 3) + " mm, " + shown(s.at(mrad).get<double>(), 3) +
             " mrad";
    };
    rows.push_back({html_escaped(s.at("name").get<std::string>()),
                    pair("translation_mm", "rotation_mrad"),
                    pair("expected_translation_mm", "expected_rotation_mrad"),
                    shown(s.at("chi_square").get<double>(), 3),
                    s.at("agrees").get<bool>() ? "agree" : "<b>disagree</b>"});
  }
  return out + html_table(rows);
}

std::string map_figure(const json& map, const json& camera) {
  const int columns = map.at("columns").get<int>();
  const int rows = map.at("rows").get<int>();
  const json& sigma = map.at("sigma_px");
  if (columns < 2 || rows < 2 ||
      sigma.size() != static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    return "";
  std::vector<double> values;
  for (const json& v : sigma) values.push_back(number_of(v));
  double low = HUGE_VAL;
  double high = 0.0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const double width_px = camera.at("width").get<double>();
  const double height_px = camera.at("height").get<double>();
  const double wide = width_px / columns;
  const double high_px = height_px / rows;
  SvgPlot plot({0.0, width_px}, {0.0, height_px}, "across the image [px]",
               "above its lower edge [px]");
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double v = values[static_cast<std::size_t>(r * columns + c)];
      if (!std::isfinite(v)) continue;
      plot.rect({wide * c, high_px * (rows - 1.0 - r)},
                {wide * (c + 1.0), high_px * (rows - 0.0 - r)},
                heat_color(high > low ? (v - low) / (high - low) : 0.5), shown(v, 3) + " px");
    }
  }
  return "<figure>" + plot.svg("uncertainty over the image") + heat_bar(low, high, "px") +
         "<figcaption>Standard deviation of a projected LiDAR point at " +
         shown(map.at("range_m").get<double>(), 3) +
         " m over the image, in pixels.</figcaption></figure>\n";
}

std::string method_boxes(const json& methods, const char* key, const char* label) {
  std::vector<double> all;
  for (const json& m : methods) {
    for (const json& v : m.at(key)) all.push_back(number_of(v));
  }
  all.push_back(0.0);
  SvgPlot plot({0.0, static_cast<double>(methods.size())}, axis_about(all), "", label, 520, 260);
  std::vector<std::pair<double, std::string>> names;
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const double x = static_cast<double>(k) + 0.5;
    std::vector<double> five;
    for (const json& v : methods[k].at(key)) five.push_back(number_of(v));
    const std::string name = methods[k].at("name").get<std::string>();
    plot.box(x, 0.3, five, name == "forward_model" ? "#23793b" : "#345c9c");
    // Two words on an axis that has room for one.
    const auto at = name.find('_');
    const char* const centers = name.ends_with("raw")       ? "·raw"
                                : name.ends_with("refined") ? "·ref"
                                                            : "";
    names.emplace_back(x, name.substr(0, at) + centers);
  }
  plot.x_names(names);
  return plot.svg(std::string("residuals by method, ") + label);
}

}  // namespace

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<table>";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const char* const tag = r == 0 ? "th" : "td";
    out += "<tr>";
    for (const std::string& cell : rows[r])
      out += std::string("<") + tag + ">" + cell + "</" + tag + ">";
    out += "</tr>";
  }
  return out + "</table>\n";
}

std::string verdict_section(const json& result, const std::optional<PoseUse>& use,
                            const std::string& day) {
  const std::string quality = result.at("quality").get<std::string>();
  const bool good = quality == "good";
  const bool known = good || quality == "doubtful" || quality == "failed";
  const bool verified = result.value("verified", false);
  const json reasons = result.value("quality_reasons", json::array());
  const auto paragraph = [](const std::string& title, const std::string& text) {
    return "<p><b>" + title + "</b> " + text + "</p>\n";
  };
  std::string out = "<h1>LiDAR–camera calibration</h1>\n<p class=\"note\">" +
                    html_escaped(result.value("dataset", "")) + ", " + html_escaped(day) +
                    "</p>\n<p><span class=\"verdict " + (known ? quality : "failed") + "\">" +
                    html_escaped(quality) + "</span></p>\n";
  std::size_t used = 0;
  for (const json& scene : result.at("scenes")) used += scene.value("used", false) ? 1 : 0;
  out += paragraph("What was calibrated:",
                   "where the camera is to the LiDAR, and how it is turned, from " +
                       std::to_string(used) + " of " + std::to_string(result.at("scenes").size()) +
                       " scenes of a printed board.");
  const auto how_well = [&](const char* key) {
    const json& covariance = result.at(key);
    std::array<double, 2> squares{};
    for (std::size_t k = 0; k < 6; ++k)
      squares[k / 3] += std::max(0.0, covariance.at(k).at(k).get<double>());
    return "± " + shown(1e3 * std::sqrt(squares[0]), 2) + " mm and ± " +
           shown(1e3 * std::sqrt(squares[1]), 2) + " mrad";
  };
  out += paragraph("How well:", how_well("covariance") +
                                    " statistically (one standard deviation of place and turn); " +
                                    how_well("covariance_total") +
                                    " with what usual faults could still do that these scenes do "
                                    "not show.");
  out += paragraph("Can it be used?", good && verified ? "Yes."
                                      : good ? "Yes, but count with the larger of the two errors: "
                                               "these scenes do not verify the camera's intrinsics."
                                      : known && quality == "doubtful"
                                          ? "Not before what speaks against it is settled."
                                          : "No.");
  if (use)
    out += paragraph("For which clouds?", html_escaped(use->clouds.text()) + " (" +
                                              html_escaped(use->model.text()) + ".)");
  if (!reasons.empty()) out += "<p><b>What speaks against it:</b></p>" + items(reasons);
  // Each warning once: those that are a reason stand above.
  json others = json::array();
  for (const json& warning : result.at("warnings")) {
    std::string text = warning.get<std::string>();
    if (text.starts_with("result: ")) text.erase(0, 8);  // Here everything is about the result.
    const bool said = std::any_of(reasons.begin(), reasons.end(), [&](const json& reason) {
      return text.find(reason.get<std::string>()) != std::string::npos;
    });
    if (!said) others.push_back(text);
  }
  if (!others.empty()) out += "<p><b>Worth knowing:</b></p>" + items(others);
  return out + paragraph("What to do next:",
                         !good ? "Settle what is listed above, the first line first, and "
                                 "calibrate again."
                         : verified
                             ? "Check it on scenes that it was not made from (lvcalib check)."
                             : "Take the scene that is named above and calibrate again, or "
                               "check on scenes that it was not made from (lvcalib check).");
}

std::string pose_section(const json& result) {
  const json& pose = result.at("T_camera_lidar");
  const json& covariance = result.at("covariance");
  std::vector<std::vector<std::string>> sigma = {{"", "x", "y", "z"},
                                                 {"translation [mm]"},
                                                 {"rotation [mrad]"},
                                                 {"translation, in total [mm]"},
                                                 {"rotation, in total [mrad]"}};
  const auto add_sigmas = [&](const json& of, std::size_t first_row) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double variance = of.at(k).at(k).get<double>();
      sigma[first_row + k / 3].push_back(shown(1e3 * std::sqrt(std::max(0.0, variance)), 3));
    }
  };
  add_sigmas(covariance, 1);
  add_sigmas(result.at("covariance_total"), 3);
  std::string quaternion;
  for (const json& v : pose.at("quaternion_xyzw"))
    quaternion += (quaternion.empty() ? "" : ", ") + shown(v.get<double>(), 9);
  // An older result has no names.
  const json frames = result.value("frames", json::object());
  const auto name = [&](const char* sensor) {
    return "<code>" + html_escaped(frames.value(sensor, sensor)) + "</code>";
  };
  return "<h2>Pose</h2>\n<p>T_camera_lidar takes a point from the LiDAR frame (" + name("lidar") +
         ") to the camera frame (" + name("camera") + "; x right, y down, z forward).</p>\n" +
         matrix_table(pose.at("matrix")) + "<p>Quaternion x, y, z, w: <code>" + quaternion +
         "</code></p>\n<h3>Standard deviations</h3>\n<p class=\"note\">Of the left perturbation in "
         "the camera frame, from the noise estimated: corners " +
         shown(result.at("sigma_px").get<double>(), 3) + " px, " +
         (result.at("rms_mm").is_number()
              ? "LiDAR nodes widened " + shown(result.at("node_noise_scale").get<double>(), 3) +
                    " times, "
              : "") +
         "planes widened " + shown(result.at("plane_noise_scale").get<double>(), 3) + " times. " +
         total_uncertainty_note().text() + "</p>\n" + html_table(sigma) + "<p>Residuals: corners " +
         shown(result.at("rms_px").get<double>(), 4) + " px" +
         (result.at("rms_mm").is_number()
              ? ", circles " + shown(result.at("rms_mm").get<double>(), 4) + " mm"
              : "") +
         " (RMS).</p>\n";
}

std::string uncertainty_section(const json& result) {
  const json& u = result.at("uncertainty");
  std::string out = "<h2>Uncertainty</h2>\n";
  const json& weak = result.at("weak_directions");
  out += weak.empty() ? "<p>All six directions are determined about equally well.</p>\n"
                      : "<p>Weak directions:</p>" + items(weak);
  std::vector<std::vector<std::string>> rows = {
      {"distance [m]", "across the view [mm]", "along it [mm]"}};
  for (const json& r : u.at("by_range")) {
    rows.push_back({shown(r.at("range_m").get<double>()), shown(number_of(r.at("across_mm")), 3),
                    shown(number_of(r.at("along_mm")), 3)});
  }
  out += "<h3>At a distance (one sigma)</h3>\n<div class=\"figures\">" + html_table(rows);
  for (const json& map : u.at("maps")) out += map_figure(map, result.at("camera"));
  return out + "</div>\n" + leave_one_out(result) + split_half(u);
}

// What each departure from the paper is worth; nothing where it was not asked for.
std::string ablation_table(const json& result) {
  if (!result.contains("ablation")) return {};
  std::vector<std::vector<std::string>> rows = {{"step", "what changes", "RMS [px]", "RMS [mm]",
                                                 "held out [px]", "held out [mm]",
                                                 "to the result [mm]", "to the result [mrad]"}};
  for (const json& step : result.at("ablation")) {
    rows.push_back(
        {html_escaped(step.at("name").get<std::string>()),
         html_escaped(step.at("change").get<std::string>()), shown(number_of(step.at("rms_px"))),
         shown(number_of(step.at("rms_mm"))), shown(number_of(step.at("heldout_px"))),
         shown(number_of(step.at("heldout_mm"))), shown(number_of(step.at("translation_mm")), 3),
         shown(number_of(step.at("rotation_mrad")), 3)});
  }
  return "<h3>From the paper's method to the result, one change at a time</h3>\n" +
         html_table(rows);
}

std::string methods_section(const json& result) {
  const json& methods = result.at("methods");
  std::string out = "<h2>Methods side by side</h2>\n";
  if (methods.empty()) return out + "<p class=\"note\">none</p>\n";
  out +=
      "<p class=\"note\">All measured alike: with a method's extrinsic held, each board is set "
      "where corners, refined nodes and plane fit best; what remains is shown. Held out: the "
      "method solved without the scene. Transfer: corners predicted through the LiDAR's board "
      "pose.</p>\n";
  std::vector<std::vector<std::string>> rows = {{"method", "RMS [px]", "RMS [mm]", "held out [px]",
                                                 "held out [mm]", "transfer [px]", "to joint [mm]",
                                                 "to joint [mrad]"}};
  for (const json& m : methods) {
    rows.push_back({html_escaped(m.at("name").get<std::string>()), shown(number_of(m.at("rms_px"))),
                    shown(number_of(m.at("rms_mm"))), shown(number_of(m.at("heldout_px"))),
                    shown(number_of(m.at("heldout_mm"))), shown(number_of(m.at("transfer_px"))),
                    shown(number_of(m.at("to_joint").at("translation_mm")), 3),
                    shown(number_of(m.at("to_joint").at("rotation_mrad")), 3)});
  }
  return out + html_table(rows) + "<div class=\"figures\">" +
         method_boxes(methods, "box_px", "corner residual [px]") +
         method_boxes(methods, "box_mm", "node residual [mm]") + "</div>\n" +
         ablation_table(result);
}

// Where the board's frame begins, which depends on its kind.
std::string board_frame(const json& result) {
  const auto text = result.find("target_yaml");
  if (text == result.end() || !text->is_string()) return {};
  const auto file = target_from_text(text->get<std::string>(), "target.yaml");
  if (!file) return {};
  std::string where =
      "x right, y up, z out of the board; origin at the outer lower-left corner of "
      "the lowest tag";
  switch (file->target.type) {
    case TargetType::kCheckerboard:
      where =
          "x along the columns, y along the rows, z out of the board; origin at the first "
          "inner corner";
      break;
    case TargetType::kCharuco:
      where = "x right, y up, z out of the board; origin at the lower left inner corner";
      break;
    default:
      break;
  }
  return "<li>Board: " + where + ".</li>";
}

std::string provenance_section(const json& result) {
  std::string out =
      "<h2>Conventions</h2>\n<ul><li>T_a_b takes a point in frame b to frame a.</li>"
      "<li>Camera: x right, y down, z forward; pixel (0, 0) is the centre of the top-left "
      "pixel.</li>" +
      board_frame(result) +
      "<li>Covariances: left perturbation in the camera frame, order "
      "tx ty tz (m) rx ry rz (rad).</li><li>Pitch grows upwards, yaw towards z × line of sight; "
      "both are true angles.</li></ul>\n<h2>Provenance</h2>\n<p>LV-Calib " +
      html_escaped(result.at("version").get<std::string>()) + ", report by " +
      html_escaped(version()) + "</p>\n";
  std::vector<std::vector<std::string>> rows = {{"input", "bytes", "SHA-256"}};
  for (const json& file : result.at("inputs")) {
    const std::string hash = file.at("sha256").get<std::string>();
    rows.push_back(
        {html_escaped(file.at("path").get<std::string>()),
         std::to_string(file.at("bytes").get<std::uint64_t>()),
         "<span class=\"hash\">" + (hash.empty() ? "–" : html_escaped(hash)) + "</span>"});
  }
  out += html_table(rows);
  std::vector<std::vector<std::string>> times = {{"stage", "ms"}};
  for (const auto& [stage, ms] : result.at("timing_ms").items())
    times.push_back({html_escaped(stage), shown(ms.get<double>(), 4)});
  return out + "<h3>Time</h3>\n" + html_table(times);
}

}  // namespace lvcalib
