// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>

#include "command.h"
#include "design/planning.h"
#include "overwriting.h"
#include "report/plan_file.h"

namespace lvcalib::cli {
namespace {

struct PlanArguments {
  std::string target;
  std::string camera;
  std::string lidar;
  std::string output;
  PlanOptions plan;
};

std::string summary_of(const ScenePlan& plan, const std::string& output) {
  std::string text = std::to_string(plan.scenes.size()) + " scenes of " +
                     std::to_string(plan.poses_tried) + " poses";
  if (!plan.scenes.empty() && plan.scenes.back().determined) {
    const Matrix6d& c = plan.scenes.back().covariance;
    char part[96];
    std::snprintf(part, sizeof part, "; predicted sigma %.2g mm, %.2g mrad",
                  1e3 * std::sqrt(c.diagonal().head<3>().sum()),
                  1e3 * std::sqrt(c.diagonal().tail<3>().sum()));
    text += part;
  }
  return text + " -> " + output;
}

Result<std::string> run(const PlanArguments& options, Session& session) {
  if (Status s = check_output(options.output, {options.target, options.camera, options.lidar}); !s)
    return s.error();
  const auto target = read_target(options.target);
  if (!target) return target.error();
  const auto camera = read_camera(options.camera);
  if (!camera) return camera.error();
  const auto lidar = read_lidar(options.lidar);
  if (!lidar) return lidar.error();
  for (const auto* warnings : {&target->warnings, &camera->warnings, &lidar->warnings}) {
    for (const Message& warning : *warnings) session.warn(warning);
  }
  auto plan =
      plan_scenes(target->target, camera->camera, lidar->lidar, options.plan, session.context);
  if (!plan) return plan.error();
  for (const Message& warning : plan->warnings) session.warn(warning);
  if (Status s = write_plan(*plan, options.output); !s) return s.error();
  return summary_of(*plan, options.output);
}

}  // namespace

Command add_plan_command(CLI::App& app) {
  auto options = std::make_shared<PlanArguments>();
  CLI::App* command = app.add_subcommand("plan", "Propose board poses worth taking");
  command->add_option("--target", options->target, "target.yaml")->required();
  command->add_option("--camera", options->camera, "camera.yaml")->required();
  command->add_option("--lidar", options->lidar, "description of the LiDAR (see resources/lidars)")
      ->required();
  command->add_option("--scenes", options->plan.scenes, "how many scenes")
      ->required()
      ->check(CLI::Range(1, 100));
  command->add_option("-o,--output", options->output, "plan.json to write")->required();
  command->add_option("--effect", options->plan.effects,
                      "an effect that shall become testable (repeatable)");
  command
      ->add_option("--corner-noise", options->plan.corner_sigma_px,
                   "standard deviation of a corner, px")
      ->check(CLI::Range(1e-4, 100.0));
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
