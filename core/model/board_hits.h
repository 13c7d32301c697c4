// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "model/scene_geometry.h"
#include "model/table_builder.h"

namespace lvcalib {

/// A point of a scene's cloud that hits the board.
struct BoardHit {
  std::size_t point = 0;  ///< In the scene's board points.
  BeamPoint beam;
  Print print = Print::kWhite;
  bool pure = false;        ///< Sees one print only, as ranges go: two σ of the footprint.
  bool plain = false;       ///< As intensities go: a percent of white is much beside black.
  double residual_m = 0.0;  ///< Measured − predicted range.
};

/// Standard deviations by print; zero where too few points tell.
struct PrintNoise {
  std::array<double, kPrints> range_m{};
  std::array<double, kPrints> log_intensity{};
};

/// The points of one scene that hit the board, in the order of the scan, before thinning. Which
/// print a point sees is decided by geometry alone.
class BoardHits {
 public:
  BoardHits(const SceneMeasurements& input, int scene, const SceneGeometry& geometry,
            const Target& target, const TableOptions& options);
  [[nodiscard]] const std::vector<BoardHit>& list() const { return hits_; }
  /// Median raw intensity of each print; zero where too few points tell.
  [[nodiscard]] std::array<double, kPrints> levels() const;
  /// Range noise from near-replicates; where there are too few, from the plane.
  [[nodiscard]] PrintNoise noise() const;

 private:
  void collect();
  void sort_hits();
  [[nodiscard]] Print print_at(const Eigen::Vector2d& board_m) const;
  [[nodiscard]] bool sees_only(Print print, const BeamPoint& beam, double sigmas,
                               int directions) const;
  void set_near_edge(BeamPoint& beam) const;

  const SceneMeasurements& input_;
  int scene_;
  SceneGeometry geometry_;
  const Target& target_;
  const TableOptions& options_;
  std::vector<TargetNode> nodes_;
  std::vector<BoardHit> hits_;
};

}  // namespace lvcalib
