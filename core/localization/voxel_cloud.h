// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "cloud/cloud.h"

namespace lvcalib {

/// A cloud thinned to one mean point per occupied voxel, with a coarse grid for radius queries.
/// Equalises the twenty-fold density differences of non-repetitive scanners.
class VoxelCloud {
 public:
  struct Voxel {
    Eigen::Vector3f mean_m = Eigen::Vector3f::Zero();
    float mean_intensity = 0.0F;
    std::uint32_t count = 0;
  };

  /// Single pass over the cloud. Only points with a range in [min_range_m, max_range_m] and,
  /// if `region_radius_m` > 0, within that distance of `region_center_m` take part.
  struct Options {
    double voxel_m = 0.02;
    double cell_m = 0.3;  ///< Side of the coarse grid.
    double min_range_m = 0.1;
    double max_range_m = 1e9;
    Eigen::Vector3d region_center_m = Eigen::Vector3d::Zero();
    double region_radius_m = 0.0;
  };
  VoxelCloud(const Cloud& cloud, const Options& options, const RunContext& context);

  [[nodiscard]] const std::vector<Voxel>& voxels() const { return voxels_; }

  /// Indices of voxels within `radius_m` of a point, appended to `out` (cleared first).
  void neighbours(const Eigen::Vector3f& point_m, double radius_m,
                  std::vector<std::uint32_t>& out) const;

  /// Index of one voxel per coarse cell: the one nearest to the mean of its cell.
  [[nodiscard]] std::vector<std::uint32_t> cell_representatives() const;

 private:
  [[nodiscard]] Eigen::Vector3i cell_of(const Eigen::Vector3f& point_m) const;
  void build_grid();

  Options options_;
  std::vector<Voxel> voxels_;
  std::vector<std::uint32_t> order_;  ///< Voxel indices sorted by cell.
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> cells_;
};

}  // namespace lvcalib
