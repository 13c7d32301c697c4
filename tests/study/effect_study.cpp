// SPDX-License-Identifier: GPL-3.0-or-later
// Rigs with hidden effects: simulates, calibrates, discovers, and compares with what was planted.
//
//   effect_study run RECORDS.jsonl [MINUTES] [FIRST_SEED] [FIRST_TASK] [FOLDER]
//   effect_study table RECORDS.jsonl…
//   effect_study write FIRST_SEED TASK DATASET
//
// `run` appends one JSON object per rig until the time is over; `table` prints markdown tables of
// all records on standard output; `write` writes one rig's dataset to look at it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "effect_records.h"
#include "evidence_rigs.h"
#include "pipeline/model_discovery.h"
#include "report/result_file.h"
#include "simulation/dataset_writer.h"
#include "support/effect_rigs.h"

namespace lvcalib::study {
namespace {

using namespace lvcalib::test;
using nlohmann::json;

const EffectFinding* finding_of(const Discovery& discovery, const std::string& id) {
  for (const EffectFinding& f : discovery.effects) {
    if (f.id == id) return &f;
  }
  return nullptr;
}

json finding_json(const EffectFinding& f) {
  json parameters = json::array();
  for (const ParameterEstimate& p : f.parameters)
    parameters.push_back({{"name", p.name}, {"value", p.value}, {"sigma", p.sigma}});
  return {{"id", f.id},
          {"verdict", name_of(f.verdict)},
          {"aliases", f.aliases},
          {"parameters", parameters}};
}

json channels_json(const std::vector<ChannelSummary>& channels) {
  json out = json::object();
  for (const ChannelSummary& c : channels) {
    out[name_of(c.channel)] = {{"rms", c.rms},
                               {"floor", c.noise_floor},
                               {"unexplained", c.unexplained},
                               {"heldout", c.heldout_rms}};
  }
  return out;
}

json extrinsic_json(const Rigid3& estimate, const Matrix6d& covariance, const Rigid3& truth) {
  const ExtrinsicError e = compare_extrinsics({estimate, covariance}, truth);
  json normalized = json::array();
  for (int k = 0; k < 6; ++k) normalized.push_back(e.normalized(k));
  return {{"mm", e.translation_mm}, {"mrad", e.rotation_mrad}, {"normalized", normalized}};
}

json record_of(const EffectTask& task, const simulation::SimulatedRig& rig,
               const CalibrationResult& result, const Discovery& d) {
  json out = {{"scenes", d.state.camera_from_board.size()}, {"selected", d.selected}};
  out["findings"] = json::array();
  for (const std::string& id : d.selected) {
    if (const EffectFinding* f = finding_of(d, id)) out["findings"].push_back(finding_json(*f));
  }
  out["planted_findings"] = json::array();
  out["truth"] = json::object();
  for (const auto& [id, value] : task.planted) {
    if (const EffectFinding* f = finding_of(d, id))
      out["planted_findings"].push_back(finding_json(*f));
    out["truth"][id] = true_parameters(id, rig);
  }
  out["before"] = channels_json(d.channels);
  out["after"] = channels_json(d.history.back().channels);
  out["extrinsic_before"] =
      extrinsic_json(result.extrinsic.camera_from_lidar.transform,
                     result.extrinsic.camera_from_lidar.covariance, rig.camera_from_lidar);
  out["extrinsic_after"] =
      extrinsic_json(d.state.camera_from_lidar, d.covariance, rig.camera_from_lidar);
  const auto structure_json = [](const std::vector<StructureScore>& scores) {
    json list = json::array();
    for (const StructureScore& s : scores)
      list.push_back({{"channel", name_of(s.channel)},
                      {"covariate", joined(s.covariates(), " and ")},
                      {"score", s.score}});
    return list;
  };
  out["structure"] = structure_json(d.structure);
  out["unknown"] = structure_json(d.unknown);
  return out;
}

struct SearchedRig {
  simulation::SimulatedRig rig;
  CalibrationResult result;
  Discovery discovery;
};

// As the command does.
Result<SearchedRig> search_rig(const EffectTask& task, const std::filesystem::path& folder) {
  RunContext one;
  one.threads = 1;
  auto rig = simulation::simulate(effect_rig_options(task), one);
  if (!rig) return rig.error();
  auto result = calibrate_rig(*rig, folder);
  if (!result) return result.error();
  const auto explained = explain_refused_scenes(*result, {}, one);
  if (explained && *explained)
    return SearchedRig{std::move(*rig), std::move(*result), (*explained)->discovery};
  auto discovery = discover(*result, {}, one);
  if (!discovery) return discovery.error();
  return SearchedRig{std::move(*rig), std::move(*result), std::move(*discovery)};
}

// How far each planted effect that was called absent moves the final extrinsic: the same rig,
// searched without it. Asked only where the extrinsic is off by more than the tolerance; else no
// effect can be what took it there.
json moves_of_absent(const EffectTask& task, const Discovery& d,
                     const std::filesystem::path& folder) {
  json out = json::object();
  for (const auto& [id, value] : task.planted) {
    const EffectFinding* f = finding_of(d, id);
    if (f == nullptr || f->verdict != EffectVerdict::kAbsent) continue;
    EffectTask without = task;
    without.planted.erase(id);
    const auto searched = search_rig(without, folder);
    if (!searched) continue;
    const ExtrinsicError e = compare_extrinsics({d.state.camera_from_lidar, d.covariance},
                                                searched->discovery.state.camera_from_lidar);
    out[id] = {{"mm", e.translation_mm}, {"mrad", e.rotation_mrad}};
  }
  return out;
}

json run_rig(const EffectTask& task, const std::filesystem::path& folder) {
  json out = {{"set", name_of(task.set)}, {"seed", task.seed}, {"planted", task.planted}};
  const auto searched = search_rig(task, folder);
  if (!searched) {
    out["error"] = searched.error().text();
    return out;
  }
  out.update(record_of(task, searched->rig, searched->result, searched->discovery));
  if (is_off(out["extrinsic_after"]))
    out["moves_of_absent"] = moves_of_absent(task, searched->discovery, folder);
  return out;
}

int run(const std::string& path, double minutes, std::uint64_t first_seed, std::size_t first_task,
        const std::filesystem::path& folder) {
  using Clock = std::chrono::steady_clock;
  std::ofstream file(path, std::ios::app);
  const auto end = Clock::now() + std::chrono::duration<double, std::ratio<60>>(minutes);
  for (std::size_t k = first_task; Clock::now() < end && file; ++k)
    file << run_rig(effect_task(k, first_seed), folder).dump() << std::endl;
  if (file) return 0;
  std::fprintf(stderr, "%s cannot be written\n", path.c_str());
  return 1;
}

int write(std::uint64_t first_seed, std::size_t task, const std::filesystem::path& dataset) {
  const auto rig = simulation::simulate(effect_rig_options(effect_task(task, first_seed)), {});
  Status done = rig ? simulation::write_dataset(*rig, dataset, true) : Status(rig.error());
  if (done) return 0;
  std::fprintf(stderr, "%s\n", done.error().text().c_str());
  return 1;
}

int table(int count, char** paths) {
  std::vector<EffectRecord> records;
  for (int k = 0; k < count; ++k) {
    std::ifstream file(paths[k]);
    if (!file) {
      std::fprintf(stderr, "%s cannot be read\n", paths[k]);
      return 1;
    }
    for (std::string line; std::getline(file, line);) {
      const json record = json::parse(line, nullptr, false);
      if (record.is_object()) records.push_back(read_record(record));
    }
  }
  print_set_table(records);
  print_effect_table(records);
  print_misses(records);
  return 0;
}

}  // namespace
}  // namespace lvcalib::study

int main(int argc, char** argv) {
  using namespace lvcalib::study;
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "table" && argc > 2) return table(argc - 2, argv + 2);
  if (what == "write" && argc > 4)
    return write(std::strtoull(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10), argv[4]);
  if (what == "run" && argc > 2) {
    const double minutes = argc > 3 ? std::atof(argv[3]) : 60.0;
    const std::uint64_t seed = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1;
    const std::size_t task = argc > 5 ? std::strtoull(argv[5], nullptr, 10) : 0;
    return run(argv[2], minutes, seed, task,
               argc > 6 ? argv[6] : std::filesystem::temp_directory_path().string());
  }
  std::fprintf(stderr,
               "usage: effect_study run RECORDS.jsonl [MINUTES] [FIRST_SEED] [FIRST_TASK] "
               "[FOLDER]\n       effect_study table RECORDS.jsonl...\n"
               "       effect_study write FIRST_SEED TASK DATASET\n");
  return 2;
}
