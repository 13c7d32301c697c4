// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/comparison_work.h"

#include <algorithm>

#include "pipeline/model_discovery.h"
#include "pipeline/project_file.h"

namespace lvcalib::widgets {
namespace {

std::shared_ptr<const CalibrationResult> at_step(const ComparisonBasis& basis, std::size_t step) {
  if (!basis.source || step == basis.current) return basis.result;
  std::vector<ModelStepPtr> made;
  for (std::size_t k = 0; k <= step && k < basis.steps.size(); ++k) {
    if (basis.steps[k]) made.push_back(basis.steps[k]);
  }
  return result_at(basis.source, made);
}

Result<StatedResult> calibrated(const QString& path, const RunContext& context) {
  const auto file = read_project(path.toStdString());
  if (!file) return file.error();
  const auto result = calibrate_project(file->project, context);
  if (!result) return result.error();
  return stated_result(**result);
}

Result<StatedResult> state(const ComparisonBasis& basis, const ComparedResult& what,
                           const RunContext& context) {
  switch (what.kind) {
    case ComparedResult::Kind::kFile:
      return read_stated_result(what.path.toStdString());
    case ComparedResult::Kind::kProject:
      return calibrated(what.path, context);
    default:
      return stated_result(*at_step(basis, what.step));
  }
}

std::shared_ptr<const Comparison> compare(const ComparisonBasis& basis, const StatedResult& first,
                                          const StatedResult& second) {
  auto out = std::make_shared<Comparison>();
  out->first = first;
  out->second = second;
  out->difference = difference_of(first.extrinsic, second.extrinsic);
  out->scenes = compare_scenes(first, second);
  // A truth has no scenes: those of what is open show what it means.
  for (const SceneResult& scene : basis.result->scenes) {
    const bool known = std::any_of(out->scenes.begin(), out->scenes.end(),
                                   [&](const SceneComparison& c) { return c.name == scene.name; });
    if (!known) out->scenes.push_back({scene.name, {}, {}});
  }
  for (const SceneComparison& row : out->scenes) {
    std::optional<ProjectionShift> shift;
    for (const SceneResult& scene : basis.result->scenes) {
      if (scene.name != row.name) continue;
      shift = board_shift(*basis.result, scene, first.extrinsic.camera_from_lidar,
                          second.extrinsic.camera_from_lidar);
    }
    out->shifts.push_back(std::move(shift));
  }
  return out;
}

}  // namespace

ComparisonWork::ComparisonWork(QObject* parent) : QObject(parent) {
  relay(runner_, this);
  connect(&runner_, &Runner::cancelled, this, &ComparisonWork::ended);
}

void ComparisonWork::request(const ComparisonBasis& basis, const ComparedResult& first,
                             const ComparedResult& second) {
  runner_.start([this, basis, first, second, kept = kept_](
                    const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    Stated sides[2];
    for (int k = 0; k < 2; ++k) {
      const ComparedResult& what = k == 0 ? first : second;
      if (const auto at = kept.find(what); at != kept.end()) {
        sides[k] = at->second;
        continue;
      }
      auto stated = state(basis, what, context);
      if (!stated) {
        if (stated.error().kind == ErrorKind::kCancelled) return {};
        return [this, error = stated.error()] { Q_EMIT failed(error); };
      }
      sides[k] = std::make_shared<const StatedResult>(std::move(*stated));
      post([this, what, made = sides[k]] { kept_[what] = made; });
    }
    return [this, made = compare(basis, *sides[0], *sides[1])] { Q_EMIT ready(made); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_comparison_work.cpp"
