// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "recording/file_pairs.h"
#include "verification/edge_agreement.h"

namespace lvcalib {

/// Images and clouds of a folder, to check a calibration with: the scenes of a dataset, or pairs of
/// files as find_pairs() finds them. Nothing is opened. Scenes that lack a file are left out.
/// Errors (kInput): no folder, or nothing that belongs together.
Result<std::vector<FilePair>> find_fresh_data(const std::filesystem::path& folder);

struct FreshViews {
  static constexpr std::size_t kMostDrawn = 30'000;
  std::vector<EdgeView> views;
  std::vector<std::size_t> pairs;  ///< Which pair each is of.
  /// As many: points of each cloud to draw, some kMostDrawn spread evenly over it.
  std::vector<std::vector<Eigen::Vector3f>> points_m;
  std::vector<Message> warnings;        ///< Pairs that were left out, and why.
  std::vector<Message> cloud_warnings;  ///< Clouds that may not be whole; see about_cloud().
};

/// Reads pairs and finds their edges, as many at a time as the context has threads; what cannot be
/// used is left out with a warning. Errors: kInput if none can; kCancelled.
Result<FreshViews> read_fresh_views(const std::vector<FilePair>& pairs, const Camera& camera,
                                    const Rigid3& rough_camera_from_lidar,
                                    const RunContext& context);

}  // namespace lvcalib
