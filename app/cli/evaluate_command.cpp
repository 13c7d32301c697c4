// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "command.h"
#include "report/result_file.h"

namespace lvcalib::cli {
namespace {

struct EvaluateArguments {
  std::string result;
  std::string truth;
};

// What each step of the result's ablation is off the truth by.
void print_steps(const std::vector<StoredStep>& steps, const Rigid3& truth, Session& session) {
  char line[160];
  std::snprintf(line, sizeof line, "%-14s %9s %9s %9s %11s", "step", "rms [px]", "rms [mm]",
                "off [mm]", "off [mrad]");
  session.print(line);
  for (const StoredStep& step : steps) {
    const ExtrinsicError e = compare_extrinsics({step.camera_from_lidar, {}}, truth);
    std::snprintf(line, sizeof line, "%-14.40s %9.3f %9.3f %9.3f %11.3f", step.name.c_str(),
                  step.rms_px, step.rms_mm, e.translation_mm, e.rotation_mrad);
    session.print(line);
  }
}

Result<std::string> run(const EvaluateArguments& options, Session& session) {
  auto estimate = read_result(options.result);
  if (!estimate) return estimate.error();
  auto truth = read_truth(options.truth);
  if (!truth) return truth.error();
  const auto steps = read_ablation(options.result);
  if (!steps) return steps.error();
  if (!steps->empty()) print_steps(*steps, *truth, session);
  const ExtrinsicError e = compare_extrinsics(*estimate, *truth);
  const Vector6d& x = e.left_perturbation;
  const Vector6d& n = e.normalized;
  char text[512];
  std::snprintf(text, sizeof text,
                "translation %.3f mm, rotation %.3f mrad off; by axis [%.3f %.3f %.3f] mm [%.3f "
                "%.3f %.3f] mrad; ",
                e.translation_mm, e.rotation_mrad, 1e3 * x(0), 1e3 * x(1), 1e3 * x(2), 1e3 * x(3),
                1e3 * x(4), 1e3 * x(5));
  const std::string off = text;
  if (!n.allFinite()) return off + "the result states no standard deviations";
  std::snprintf(text, sizeof text, "in standard deviations [%.2f %.2f %.2f] [%.2f %.2f %.2f]", n(0),
                n(1), n(2), n(3), n(4), n(5));
  return off + text;
}

}  // namespace

Command add_evaluate_command(CLI::App& app) {
  auto options = std::make_shared<EvaluateArguments>();
  CLI::App* command = app.add_subcommand("evaluate", "Compare a result with a simulation's truth");
  command->add_option("RESULT", options->result, "result.json")->required();
  command->add_option("--truth", options->truth, "truth.json")->required();
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
