// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/step_comparison.h"

#include "pipeline/model_discovery.h"

namespace lvcalib::widgets {
namespace {

// The calibration at the last of some steps.
std::shared_ptr<const CalibrationResult> result_at(
    const std::shared_ptr<const CalibrationResult>& source,
    const std::vector<ModelStepPtr>& steps) {
  if (steps.size() < 2) return source;
  const Discovery discovery = as_discovery(steps, nullptr);
  if (discovery.model.empty()) return source;
  return std::make_shared<const CalibrationResult>(with_model(*source, discovery));
}

std::vector<ModelStepPtr> made_until(const std::vector<ModelStepPtr>& steps, std::size_t last) {
  std::vector<ModelStepPtr> out;
  for (std::size_t k = 0; k <= last && k < steps.size(); ++k) {
    if (steps[k]) out.push_back(steps[k]);
  }
  return out;
}

}  // namespace

StepComparison::StepComparison(QObject* parent) : QObject(parent) {}

void StepComparison::request(const std::shared_ptr<const CalibrationResult>& source,
                             const std::vector<ModelStepPtr>& steps, std::size_t first,
                             std::size_t second) {
  runner_.start([this, source, a = made_until(steps, first), b = made_until(steps, second)](
                    const RunContext&, const Runner::Post&) -> Runner::Deliver {
    const auto one = result_at(source, a);
    const auto other = result_at(source, b);
    return [this, one, other] { Q_EMIT ready(one, other); };
  });
}

}  // namespace lvcalib::widgets
