// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lvcalib::study {

/// What became of a planted effect.
enum class Found {
  kRight,    ///< Selected.
  kAlias,    ///< One that the tool says it cannot be told from is selected.
  kDoubted,  ///< Not selected, and the verdict says that these scenes cannot tell.
  kMissed,   ///< Not selected, nothing else either, and called absent.
  kWrong,    ///< Another is selected instead.
};

/// One rig of the study, judged.
struct EffectRecord {
  std::string set;
  unsigned long long seed = 0;
  std::map<std::string, double> planted;
  std::string error;  ///< Empty if the rig was calibrated.
  std::vector<std::string> selected;
  std::map<std::string, Found> found;  ///< Of every planted effect of the catalogue.
  std::map<std::string, std::string> verdict;
  /// Of planted effects that were called absent: whether it moves the final extrinsic by more than
  /// the tolerance. Where the record does not say, whether that is off by more.
  std::map<std::string, bool> absent_but_moves;
  std::map<std::string, double> attainable;  ///< Largest |true parameter|/σ, 0 if unknown.
  int inside = 0;                            ///< True parameters within ±1.96 σ …
  int parameters = 0;                        ///< … of so many.
  std::vector<std::string> extra;            ///< Selected beyond the planted and their aliases.
  bool signature = false;                    ///< An outsider's channel and covariate are named.
  bool claims_structure = false;             ///< Some that no effect explains is reported.
  double removed = 0.0;          ///< Share of the unexplained RMS of the main channel that is gone.
  bool had_unexplained = false;  ///< There was some: half of the noise floor or more.
  double heldout_over_floor = 0.0;  ///< Of the main channel.
  bool off = false;                 ///< The final extrinsic, by more than the tolerance.
  double before_mm = 0.0, after_mm = 0.0, before_mrad = 0.0, after_mrad = 0.0;
  int pose_inside = 0;  ///< Of six components of the final extrinsic, within ±1.96 σ.
};

/// Whether a recorded distance of extrinsics exceeds the tolerance of model and verdict.
bool is_off(const nlohmann::json& distance);

EffectRecord read_record(const nlohmann::json& record);

/// Markdown: the sets of hidden-effect rigs with their shares and 95 % intervals.
void print_set_table(const std::vector<EffectRecord>& records);
/// Markdown: one row per planted effect.
void print_effect_table(const std::vector<EffectRecord>& records);
/// Every miss of the single-effect rigs: what was selected instead.
void print_misses(const std::vector<EffectRecord>& records);

}  // namespace lvcalib::study
