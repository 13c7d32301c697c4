// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/project_result.h"

#include "pipeline/model_discovery.h"

namespace lvcalib {

std::shared_ptr<const CalibrationResult> result_at(
    const std::shared_ptr<const CalibrationResult>& base, const std::vector<ModelStepPtr>& steps) {
  if (steps.size() < 2) return base;
  const Discovery discovery = as_discovery(steps, nullptr);
  if (discovery.model.empty()) return base;
  return std::make_shared<const CalibrationResult>(with_model(*base, discovery));
}

Result<std::shared_ptr<const CalibrationResult>> calibrate_project(const Project& project,
                                                                   const RunContext& context) {
  const auto opened = open_project_dataset(project);
  if (!opened) return opened.error();
  if (opened->dataset_moved) {
    return Error::input("the project's dataset is not there", project.dataset.string(),
                        "open the project and say where the dataset is now, then save it");
  }
  const SessionRun run = run_session(opened->dataset, project.decisions, {}, context);
  if (run.error) return *run.error;
  const auto base = run.state.latest;
  if (project.model.empty()) return base;
  auto step = start_model(discovery_input(*base), discovery_options(base->options), context);
  if (!step) return step.error();
  std::vector<ModelStepPtr> steps = {*step};
  for (const ModelDecision& decision : project.model) {
    auto next = apply_decision(steps.back(), decision, context);
    if (!next) return next.error();
    steps.push_back(*next);
  }
  return result_at(base, steps);
}

}  // namespace lvcalib
