// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Kinds of corrupted datasets whose truth is known, and what a calibration makes of them. Used by
// the corruption study and, on one small rig, by the tests.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibration.h"
#include "simulation/simulator.h"

namespace lvcalib::test {

/// What is written: the rig as changed, its files' contents and, where asked for, a rig.yaml.
struct CorruptedRig {
  simulation::SimulatedRig rig;
  std::string rig_yaml = {};  ///< Empty: none.
  /// Scenes to write once more under another name: from → to.
  std::vector<std::pair<std::string, std::string>> copies = {};
  /// Where the true extrinsic is after the change; nothing if there is none.
  std::optional<Rigid3> truth = {};
};

/// Which list a corruption belongs to.
enum class CorruptionFamily { kNone, kCamera, kCloud, kImage, kTarget, kRough, kScenes, kPlanted };
std::string name_of(CorruptionFamily family);

/// When the right words must be said.
enum class MustSay {
  kUnlessRight,  ///< Where the result is not good and right all the same.
  kAlways,       ///< Even then.
};

/// One kind of corruption.
struct Corruption {
  std::string name;
  /// Words of which one must be in what the program says, where a right diagnosis exists.
  std::vector<std::string> diagnosis = {};
  std::function<void(CorruptedRig&)> apply = [](CorruptedRig&) {};
  CorruptionFamily family = CorruptionFamily::kNone;
  MustSay must_say = MustSay::kUnlessRight;
  /// Effects planted by the simulator, which makes the rig again with them before `apply`.
  std::map<std::string, double> effects = {};
  /// Scenes that the rig needs for the change to be one.
  std::size_t fewest_scenes = 1;
};

/// All kinds, in a fixed order. The first is "clean".
std::vector<Corruption> corruptions();

enum class Outcome {
  kRight,          ///< Good, and within three total standard deviations or what matters.
  kDoubted,        ///< Doubtful or failed, or an error.
  kSilentlyWrong,  ///< Good and wrong.
};

/// What came of one corrupted dataset.
struct CorruptionOutcome {
  bool applies = true;  ///< False: this rig cannot be corrupted so; the rest says nothing.
  Outcome outcome = Outcome::kDoubted;
  std::string quality;    ///< Or "error".
  std::string said;       ///< Reasons, warnings or the error, in one line.
  bool diagnosed = true;  ///< One of the corruption's words is in what was said, where it must be.
  bool absurd = false;    ///< A number was printed that no rig can have.
  double error_mm = 0.0, error_mrad = 0.0;
  double sigmas = 0.0;  ///< Largest component of the error in total standard deviations.
};

/// Writes the corrupted dataset into `folder`, calibrates it and compares.
CorruptionOutcome run_corruption(const simulation::SimulatedRig& rig, const Corruption& corruption,
                                 const std::filesystem::path& folder);

}  // namespace lvcalib::test
