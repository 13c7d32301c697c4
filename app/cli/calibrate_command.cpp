// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <optional>

#include "base/text.h"
#include "calibration_arguments.h"
#include "command.h"
#include "report/result_file.h"

namespace lvcalib::cli {
namespace {

// Good is what these scenes could test: which part they could not, a warning says.
std::string verdict_of(const CalibrationResult& result) {
  const bool open = result.quality == Quality::kGood && !result.unverified.empty();
  return name_of(result.quality) + (open ? ", camera not verified" : "");
}

std::string summary_of(const CalibrationResult& result, const std::string& output) {
  const auto& x = result.extrinsic;
  const Eigen::Vector3d& t = x.camera_from_lidar.transform.translation;
  const Vector6d sigma = x.camera_from_lidar.covariance.diagonal().cwiseSqrt();
  const Vector6d total = result.covariance_total.diagonal().cwiseSqrt();
  char text[512];
  std::snprintf(text, sizeof text,
                "%s: %d of %zu scenes, t = [%.4f %.4f %.4f] ± [%.2f %.2f %.2f] mm, rotation ± "
                "[%.2f %.2f %.2f] mrad, in total ± [%.2f %.2f %.2f] mm [%.2f %.2f %.2f] mrad, "
                "%.3f px",
                verdict_of(result).c_str(), x.used_scenes, result.scenes.size(), t.x(), t.y(),
                t.z(), 1e3 * sigma(0), 1e3 * sigma(1), 1e3 * sigma(2), 1e3 * sigma(3),
                1e3 * sigma(4), 1e3 * sigma(5), 1e3 * total(0), 1e3 * total(1), 1e3 * total(2),
                1e3 * total(3), 1e3 * total(4), 1e3 * total(5), x.rms_px);
  // A distance to circles that the clouds do not show is none.
  const bool measured = x.uses_nodes() && x.rms_mm <= 1e3 * result.target.circle_radius_m;
  return text + (measured ? formatted(", %.3f mm", x.rms_mm) : "") + " -> " + output;
}

// The ablation as lines of a table; a dash where there is nothing to hold out.
void print_ablation(const std::vector<AblationStep>& steps, Session& session) {
  const auto cell = [](const std::optional<double>& value) {
    char text[32] = "-";
    if (value) std::snprintf(text, sizeof text, "%.3f", *value);
    return std::string(text);
  };
  char line[256];
  std::snprintf(line, sizeof line, "%-14s %9s %9s %13s %13s %11s %13s", "step", "rms [px]",
                "rms [mm]", "heldout [px]", "heldout [mm]", "moves [mm]", "moves [mrad]");
  session.print(line);
  for (const AblationStep& step : steps) {
    const MethodResult& m = step.method;
    std::snprintf(line, sizeof line, "%-14s %9.3f %9.3f %13s %13s %11.3f %13.3f", m.name.c_str(),
                  m.rms_px, m.rms_mm, cell(m.heldout_px).c_str(), cell(m.heldout_mm).c_str(),
                  m.translation_mm, m.rotation_mrad);
    session.print(line);
  }
}

Result<std::string> run(const CalibrationArguments& arguments, Session& session) {
  auto result = run_calibration(arguments, session);
  if (!result) return result.error();
  if (Status s = write_results(*result, arguments.output, arguments.frames); !s) return s.error();
  if (!result->ablation.empty()) print_ablation(result->ablation, session);
  if (result->quality == Quality::kFailed || result->extrinsic.used_scenes < 2)
    return untrusted_result(*result, arguments);
  return summary_of(*result, arguments.output);
}

}  // namespace

Command add_calibrate_command(CLI::App& app) {
  auto arguments = std::make_shared<CalibrationArguments>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Find T_camera_lidar from a dataset of board scenes");
  add_calibration_arguments(*command, *arguments, "folder for result.json and result.yaml");
  command->add_flag("--methods", arguments->ablation,
                    "also what each departure from the paper's method is worth, one at a time: a "
                    "table, and the key ablation of result.json");
  return {command, [arguments](Session& session) { return run(*arguments, session); }};
}

}  // namespace lvcalib::cli
