// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/corruptions.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "report/result_file.h"
#include "simulation/dataset_writer.h"

namespace lvcalib::test {
namespace {
namespace fs = std::filesystem;
using simulation::SimulatedRig;

std::string all_said(const CalibrationResult& result) {
  std::string text;
  for (const Message& reason : result.quality_reasons) text += reason.text() + " | ";
  for (const Message& warning : result.warnings) text += warning.text() + " | ";
  return text;
}

bool mentions(const std::string& text, const std::vector<std::string>& words) {
  return words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& word) {
           return text.find(word) != std::string::npos;
         });
}

// Numbers that say nothing: not a number, a difference of none, and residuals of nodes that a good
// result cannot have.
bool is_absurd(const std::string& said, const CalibrationResult* result) {
  if (mentions(said, {"nan", "inf ", "about 0 %"})) return true;
  return result != nullptr && result->quality == Quality::kGood &&
         !(result->extrinsic.rms_mm < 1e3 * result->target.circle_radius_m);
}

// What matters at all: three of the smallest tolerances.
constexpr double kMatters_mm = 1.5;
constexpr double kMatters_mrad = 0.6;

void compare(const CorruptedRig& corrupted, const CalibrationResult& result,
             CorruptionOutcome& out) {
  out.quality = name_of(result.quality);
  const bool trusted = result.quality == Quality::kGood && result.extrinsic.used_scenes > 1;
  if (!corrupted.truth) {
    out.outcome = trusted ? Outcome::kSilentlyWrong : Outcome::kDoubted;
    return;
  }
  const ExtrinsicError error = compare_extrinsics(
      {result.extrinsic.camera_from_lidar.transform, result.covariance_total}, *corrupted.truth);
  out.error_mm = error.translation_mm;
  out.error_mrad = error.rotation_mrad;
  out.sigmas = error.normalized.cwiseAbs().maxCoeff();
  const bool wrong =
      out.sigmas > 3.0 && (out.error_mm > kMatters_mm || out.error_mrad > kMatters_mrad);
  out.outcome = !trusted ? Outcome::kDoubted : wrong ? Outcome::kSilentlyWrong : Outcome::kRight;
}

// The rig as the corruption makes it; nothing where it cannot.
std::optional<CorruptedRig> corrupt(const SimulatedRig& rig, const Corruption& corruption) {
  if (rig.scenes.size() < corruption.fewest_scenes) return std::nullopt;
  // What is done to boards is done to rows of tags with circles between them.
  if (corruption.family == CorruptionFamily::kTarget &&
      rig.target.type != TargetType::kAprilGridCircles)
    return std::nullopt;
  CorruptedRig corrupted{rig};
  if (!corruption.effects.empty()) {
    simulation::SimulationOptions options = rig.options;
    options.effects = corruption.effects;
    auto planted = simulation::simulate(options, {});
    if (!planted) return std::nullopt;
    corrupted.rig = std::move(*planted);
  }
  corrupted.truth = corrupted.rig.camera_from_lidar;
  corruption.apply(corrupted);
  return corrupted;
}

}  // namespace

std::string name_of(CorruptionFamily family) {
  switch (family) {
    case CorruptionFamily::kNone:
      break;
    case CorruptionFamily::kCamera:
      return "intrinsics";
    case CorruptionFamily::kCloud:
      return "clouds";
    case CorruptionFamily::kImage:
      return "images";
    case CorruptionFamily::kTarget:
      return "board and target.yaml";
    case CorruptionFamily::kRough:
      return "rig.yaml";
    case CorruptionFamily::kScenes:
      return "scenes against each other";
    case CorruptionFamily::kPlanted:
      return "planted effects";
  }
  return "clean";
}

CorruptionOutcome run_corruption(const SimulatedRig& rig, const Corruption& corruption,
                                 const fs::path& folder) {
  CorruptionOutcome out;
  const auto corrupted = corrupt(rig, corruption);
  if (!corrupted) {
    out.applies = false;
    return out;
  }
  out.quality = "error";
  const fs::path dataset = folder / "dataset";
  const auto clean_up = [&] {
    std::error_code ignored;
    fs::remove_all(dataset, ignored);
    fs::remove(folder / "dataset-truth.json", ignored);
  };
  clean_up();
  if (auto written = simulation::write_dataset(corrupted->rig, dataset); !written) {
    out.said = "not written: " + written.error().text();
    out.diagnosed = false;
    return out;
  }
  if (!corrupted->rig_yaml.empty()) std::ofstream(dataset / "rig.yaml") << corrupted->rig_yaml;
  for (const auto& [from, to] : corrupted->copies)
    fs::copy(dataset / "scenes" / from, dataset / "scenes" / to, fs::copy_options::recursive);
  const auto opened = open_dataset(dataset);
  CalibrationRequest request;
  if (opened) request.guess = opened->rough_camera_from_lidar;
  auto result =
      opened ? calibrate(*opened, request, {}) : Result<CalibrationResult>(opened.error());
  clean_up();
  if (!result) {
    out.said = result.error().text();
  } else {
    out.said = all_said(*result);
    compare(*corrupted, *result, out);
  }
  out.absurd = is_absurd(out.said, result ? &*result : nullptr);
  const bool must = corruption.must_say == MustSay::kAlways || out.outcome != Outcome::kRight;
  out.diagnosed = !must || mentions(out.said, corruption.diagnosis);
  return out;
}

}  // namespace lvcalib::test
