// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib {

/// Something measured that the program does not use.
struct Refusal {
  enum class What {
    kScene,     ///< All of it; id is −1.
    kCircle,    ///< One circle, by its id: in the solve of nodes and planes.
    kTag,       ///< The corners of one tag or square, by its id.
    kPoints,    ///< LiDAR points on the board; id is −1.
    kPatch,     ///< The LiDAR points of a part of the board; id counts them in the scene.
    kResponse,  ///< One circle, by its id, or the scene (−1): in the boundary response alone.
  };
  std::string scene;
  What what = What::kScene;
  int id = -1;
  std::size_t points = 0;  ///< How many, of kPoints and kPatch.
  Message reason;          ///< In words.
  /// The user can insist on it (CalibrationRequest::insisted, SceneEdits).
  bool can_be_used = false;
  Eigen::AlignedBox2d board_m = {};  ///< Where on the board, of kPatch.
};

/// Why the joint solve refused a node that was measured.
Message misses_the_pose(const NodeResidual& node);

/// The scene was refused by the program, and has what it takes to be used all the same.
bool can_be_insisted_on(const SceneResult& scene);

/// Writes into a scene's edits that what is refused there is to be used all the same; nothing for
/// what cannot be, and for whole scenes.
void keep(SceneEdits& edits, const Refusal& refusal);

/// Everything that the program refused, by scene. What the user left out is not in it, and of a
/// scene that is refused as a whole nothing else is listed.
std::vector<Refusal> refusals(const CalibrationResult& result);

/// The parts of a scene's board that the solve takes for covered (kPatch); none if the scene does
/// not take part.
std::vector<Eigen::AlignedBox2d> covered_parts(const CalibrationResult& result,
                                               const std::string& scene);

/// How far a tag (its worst corner) or a circle that takes part misses the board's pose, in
/// standard deviations: what the gate is held against.
struct GateDistance {
  Refusal::What what = Refusal::What::kTag;  ///< Or kCircle.
  double sigmas = 0.0;
  bool used = true;
};

/// Of every tag and circle of the scenes in use, refused ones included, at the result's solution.
std::vector<GateDistance> gate_distances(const CalibrationResult& result);

/// Places in a scene's board_points of the returns that the solve refused (Refusal::What::kPoints);
/// empty without a forward solution. Ascending.
std::vector<std::uint32_t> refused_returns(const CalibrationResult& result, std::size_t scene);

}  // namespace lvcalib
