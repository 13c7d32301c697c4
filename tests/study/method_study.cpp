// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "evidence_rigs.h"

namespace lvcalib::study {
namespace {

// The paper's noise, three scenes: 9 mm of range and 0.15° of angle. What it measures as 0.15° is
// the spread of returns about an edge, to which the beam's jitter and its footprint both lead.
enum class Condition {
  kJitter,     // A needle beam that jitters by 0.15°: every sample is black or white.
  kFootprint,  // A steady beam whose footprint has 0.15°: edges are soft.
  kCamera,     // The same with a dim, noisy and blurred image: corners scatter by 0.3 px.
  kDense,  // All of it with a million points a scene: some ten thousand samples at edges, as the
           // paper's scenes have.
};

struct NamedCondition {
  Condition condition;
  const char* name;
  const char* title;
};
constexpr NamedCondition kConditions[] = {
    {Condition::kJitter, "jitter", "jitter"},
    {Condition::kFootprint, "footprint", "footprint"},
    {Condition::kCamera, "camera", "footprint and a noisy camera"},
    {Condition::kDense, "dense", "jitter, a noisy camera, a million points"}};

simulation::SimulationOptions paper_rig(std::uint64_t seed, Condition condition) {
  constexpr double kAngle_deg = 0.15;
  simulation::SimulationOptions options;
  options.seed = seed;
  options.lidar.range_sigma_m = 0.009;
  options.lidar.range_dark_exponent = 0.0;
  const bool dense = condition == Condition::kDense;
  const bool jitter = dense || condition == Condition::kJitter;
  if (dense) options.lidar.points = 1'000'000;
  if (jitter) options.lidar.angle_sigma_deg = kAngle_deg;
  const double footprint_mrad = jitter ? 0.0 : 1e3 * kAngle_deg * std::numbers::pi / 180.0;
  options.lidar.beam_horizontal_mrad = options.lidar.beam_vertical_mrad = footprint_mrad;
  if (dense || condition == Condition::kCamera) {
    options.image.blur_px = 2.0;
    options.image.full_well_e = 20.0;
    options.image.read_noise = 20.0;
  }
  return options;
}

struct Tally {
  std::map<std::string, std::vector<double>> px, mm, transfer, truth_mm, truth_mrad;
  int rigs = 0, within = 0, best_together = 0, best_held_out = 0, nearest = 0, refined_first = 0;
};

// The study compares objectives on the circles' centres; the forward model is none.
bool is_rival(const std::string& name) {
  return !name.starts_with("joint") && name != "forward_model";
}

// Whether joint_refined is best in both domains together: no method of another objective has a
// smaller sum of squares over corners and nodes, each in units of what joint_refined leaves there.
bool is_best_together(const std::map<std::string, const MethodResult*>& by_name, bool held_out) {
  const auto px = [&](const MethodResult& m) { return held_out ? *m.heldout_px : m.rms_px; };
  const auto mm = [&](const MethodResult& m) { return held_out ? *m.heldout_mm : m.rms_mm; };
  const MethodResult& joint = *by_name.at("joint_refined");
  double corners = 0.0;
  double nodes = 0.0;
  for (const MethodScene& scene : joint.scenes) {
    corners += static_cast<double>(scene.errors_px.size());
    nodes += static_cast<double>(scene.errors_mm.size());
  }
  for (const auto& [name, m] : by_name) {
    if (!is_rival(name)) continue;
    const double squares =
        corners * std::pow(px(*m) / px(joint), 2) + nodes * std::pow(mm(*m) / mm(joint), 2);
    if (squares < corners + nodes) return false;
  }
  return true;
}

// Whether it is nearer to the truth than every other objective, by the distance at the boards'
// range of some three metres.
bool is_nearest_truth(const std::map<std::string, const MethodResult*>& by_name,
                      const Rigid3& truth) {
  constexpr double kRange_m = 3.0;
  const auto error = [&](const MethodResult& m) {
    return translation_distance_m(m.camera_from_lidar, truth) +
           kRange_m * rotation_distance_rad(m.camera_from_lidar, truth);
  };
  const double joint = error(*by_name.at("joint_refined"));
  return std::all_of(by_name.begin(), by_name.end(), [&](const auto& entry) {
    return !is_rival(entry.first) || error(*entry.second) >= joint;
  });
}

void add(Tally& tally, const CalibrationResult& result, const Rigid3& truth) {
  std::map<std::string, const MethodResult*> by_name;
  for (const MethodResult& m : result.methods) {
    by_name[m.name] = &m;
    tally.px[m.name].push_back(m.rms_px);
    tally.mm[m.name].push_back(m.rms_mm);
    tally.transfer[m.name].push_back(m.transfer_px);
    tally.truth_mm[m.name].push_back(1e3 * translation_distance_m(m.camera_from_lidar, truth));
    tally.truth_mrad[m.name].push_back(1e3 * rotation_distance_rad(m.camera_from_lidar, truth));
  }
  ++tally.rigs;
  const MethodResult& joint = *by_name.at("joint_refined");
  tally.within += joint.rms_px <= 1.0 && joint.rms_mm <= 3.58 ? 1 : 0;
  tally.best_together += is_best_together(by_name, false) ? 1 : 0;
  tally.best_held_out += is_best_together(by_name, true) ? 1 : 0;
  tally.nearest += is_nearest_truth(by_name, truth) ? 1 : 0;
  bool ordered = true;
  for (const char* objective : {"svd", "wsvd", "pnp", "joint"}) {
    const std::string name = objective;
    ordered &= by_name.at(name + "_refined")->rms_mm <= by_name.at(name + "_raw")->rms_mm * 1.001;
  }
  tally.refined_first += ordered ? 1 : 0;
}

void study_condition(const NamedCondition& what, int rigs, std::uint64_t first_seed,
                     const std::filesystem::path& folder) {
  Tally tally;
  int failed = 0;
  for (int k = 0; k < rigs; ++k) {
    RunContext context;
    context.threads = 1;
    const auto rig = simulation::simulate(
        paper_rig(first_seed + static_cast<std::uint64_t>(k), what.condition), context);
    auto result = rig ? calibrate_rig(*rig, folder) : Result<CalibrationResult>(rig.error());
    if (!result || result->methods.size() < 8 || result->extrinsic.used_scenes < 3) {
      ++failed;
      std::fprintf(stderr, "seed %llu: %s\n",
                   static_cast<unsigned long long>(first_seed + static_cast<std::uint64_t>(k)),
                   result ? "not all scenes used" : result.error().text().c_str());
      for (const Message& w : result ? result->warnings : std::vector<Message>{})
        std::fprintf(stderr, "    %s\n", w.text().c_str());
      continue;
    }
    add(tally, *result, rig->camera_from_lidar);
  }
  std::printf("\n%s\n\n", what.title);
  std::printf(
      "| method | corners [px] | nodes [mm] | transfer [px] | off truth [mm] | off truth "
      "[mrad] |\n| --- | --- | --- | --- | --- | --- |\n");
  for (const char* objective : {"svd", "wsvd", "pnp", "joint"}) {
    for (const char* centers : {"_raw", "_refined"}) {
      const std::string name = std::string(objective) + centers;
      std::printf("| %s | %s | %s | %s | %s | %s |\n", name.c_str(),
                  mean_text(tally.px[name]).c_str(), mean_text(tally.mm[name]).c_str(),
                  mean_text(tally.transfer[name]).c_str(), mean_text(tally.truth_mm[name]).c_str(),
                  mean_text(tally.truth_mrad[name]).c_str());
    }
  }
  std::printf(
      "\n%d rigs, %d not solved with all scenes. joint_refined ≤ 1.0 px and ≤ 3.58 mm: %s; "
      "best in both domains together: %s, of held-out scenes: %s; nearest to the truth of all "
      "objectives: %s; refined ≤ "
      "raw in nodes for every objective: %s\n",
      rigs, failed, share_text(tally.within, tally.rigs).c_str(),
      share_text(tally.best_together, tally.rigs).c_str(),
      share_text(tally.best_held_out, tally.rigs).c_str(),
      share_text(tally.nearest, tally.rigs).c_str(),
      share_text(tally.refined_first, tally.rigs).c_str());
}

}  // namespace

void study_methods(int rigs, std::uint64_t first_seed, const std::filesystem::path& folder,
                   const std::string& condition) {
  for (const NamedCondition& known : kConditions) {
    if (condition.empty() || condition == known.name)
      study_condition(known, rigs, first_seed, folder);
  }
}

}  // namespace lvcalib::study
