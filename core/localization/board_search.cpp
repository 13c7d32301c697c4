// SPDX-License-Identifier: BSD-3-Clause
#include "localization/board_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/units.h"
#include "cloud/plane.h"
#include "localization/outline_match.h"
#include "localization/pattern_match.h"

namespace lvcalib {
namespace {

// Local maxima taken from the coarse search: the true place and shifts by one tag; how many of
// them are tried in every symmetric assignment; how many are refined on fine cells.
constexpr std::size_t kPosesPerPatch = 6;
constexpr std::size_t kTurnedPoses = 3;
constexpr std::size_t kMostPosesPerPatch = 8;
// A patch whose best coarse pose gains less than this share of the best patch's is not looked at
// again; a board cut in half still gains half.
constexpr double kLeastGainShare = 0.2;

// A patch with the board poses found in it.
struct PatchMatches {
  PlanarPatch patch;
  std::vector<PatternMatch> matches;
  [[nodiscard]] double best_gain() const { return matches.empty() ? 0.0 : matches.front().gain(); }
};

// What the search is given, and the board's size.
struct SearchInput {
  const Cloud& cloud;
  const Target& target;
  const PatternPyramid& pyramid;
  const BoardSearchOptions& options;
  const RunContext& context;
  BoardOutline outline;
  Eigen::Vector2d size;
};

// Of the ranges at which the camera sees the board.
VoxelCloud voxels_of(const SearchInput& in, double camera_distance_m,
                     const std::optional<BoardSearchRegion>& region) {
  VoxelCloud::Options options;
  // Fine enough to keep the circles and tags apart, coarse enough for a quick search.
  options.voxel_m = in.size.minCoeff() / 40.0;
  options.cell_m = 0.3 * in.size.minCoeff();
  const double around = in.options.max_lever_arm_m + 0.5 * in.size.norm();
  options.min_range_m = std::max(in.options.min_range_m, camera_distance_m - around);
  options.max_range_m = camera_distance_m + around;
  if (region) {
    options.region_center_m = region->center_m;
    options.region_radius_m = region->radius_m;
  }
  return VoxelCloud(in.cloud, options, in.context);
}

bool plausible_size(const SearchInput& in, const PlanarPatch& patch) {
  if (patch.open) return in.options.search_walls;
  const double longer = in.size.maxCoeff();
  const double shorter = in.size.minCoeff();
  // A quarter larger: stand, cables and neighbours that touch; smaller: partly out of view.
  return patch.extent_m.x() < 1.25 * std::hypot(longer, shorter) &&
         patch.extent_m.y() < 1.25 * longer && patch.extent_m.x() > 0.4 * shorter;
}

// A wall that grows by next to nothing from one connection gap to the next need not be searched
// again: that takes long. Of small patches each one is tried, since their planes differ more.
void drop_copies(double shorter_side_m, std::vector<PlanarPatch>& patches) {
  std::vector<PlanarPatch> kept;
  for (PlanarPatch& patch : patches) {
    const auto points = static_cast<double>(patch.voxels.size());
    const bool copy = std::any_of(kept.begin(), kept.end(), [&](const PlanarPatch& other) {
      return other.open && patch.open &&
             (other.center_m - patch.center_m).norm() < 0.02 * shorter_side_m &&
             std::abs(other.normal.dot(patch.normal)) > std::cos(1.0 * kRadPerDeg) &&
             std::abs(static_cast<double>(other.voxels.size()) - points) < 0.01 * points;
    });
    if (!copy) kept.push_back(std::move(patch));
  }
  patches = std::move(kept);
}

std::vector<PlanarPatch> patches_in(const SearchInput& in, const VoxelCloud& voxels) {
  PatchSearchOptions options;
  options.board_width_m = in.size.x();
  options.board_height_m = in.size.y();
  options.plane_tolerance_m = in.options.plane_tolerance_m;
  auto patches = find_planar_patches(voxels, options, in.context);
  drop_copies(in.size.minCoeff(), patches);
  return patches;
}

// The same board seen through different connection gaps gives the same patch twice.
void drop_repeated(std::vector<PatchMatches>& found) {
  std::vector<PatchMatches> kept;
  for (PatchMatches& item : found) {
    const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const PatchMatches& other) {
      const auto& a = item.matches.front().pose.center_m;
      const auto& b = other.matches.front().pose.center_m;
      const Eigen::Vector3d pa = item.patch.to_lidar(a);
      const Eigen::Vector3d pb = other.patch.to_lidar(b);
      return (pa - pb).norm() < 0.1 * other.patch.extent_m.y() &&
             item.patch.normal.dot(other.patch.normal) > std::cos(5.0 * kRadPerDeg);
    });
    if (!repeated) kept.push_back(std::move(item));
  }
  found = std::move(kept);
}

// The patches worth a closer look, best first.
void keep_best(int most, bool by_pattern, std::vector<PatchMatches>& found) {
  std::stable_sort(found.begin(), found.end(), [](const PatchMatches& a, const PatchMatches& b) {
    return a.best_gain() > b.best_gain();
  });
  drop_repeated(found);
  if (found.size() > static_cast<std::size_t>(most)) found.resize(static_cast<std::size_t>(most));
  while (by_pattern && found.size() > 1 &&
         found.back().best_gain() < kLeastGainShare * found.front().best_gain()) {
    found.pop_back();
  }
}

// Two poses closer than half a tag pitch (or half a ChArUco board's square) are the same local
// maximum.
double separation_m(const SearchInput& in) {
  return in.target.has_tags() ? 0.5 * in.target.tag_pitch_m() : 0.25 * in.size.minCoeff();
}

std::vector<PatternMatch> search_patch(const SearchInput& in, const VoxelCloud& voxels,
                                       const PlanarPatch& patch) {
  std::vector<PlanarSample> samples;
  samples.reserve(patch.voxels.size());
  for (const auto i : patch.voxels) {
    const auto& voxel = voxels.voxels()[i];
    samples.push_back(
        {patch.to_plane(voxel.mean_m.cast<double>()).cast<float>(), voxel.mean_intensity});
  }
  const OutlineFit outline = fit_outline(samples, in.size);
  PatternSearchRange range;
  range.center_m = outline.center_m;
  // A patch of the board's own size leaves little room; cut-off or grown ones leave the
  // difference, and any angle.
  const double misfit = outline.side_error_m.cwiseAbs().maxCoeff();
  range.slack_m =
      0.06 * in.size.minCoeff() + (patch.open ? 0.6 * patch.extent_m.x() : 0.6 * misfit);
  range.step_m = 0.03 * in.size.minCoeff();
  // Seen this coarsely one turn of the symmetric assignments looks like the others, and
  // starting_poses() adds them; but turned squares have black where there was white.
  const int symmetry = in.target.outline_symmetry();
  const int turns = in.target.has_squares() ? symmetry : 1;
  if (misfit < 0.12 * in.size.minCoeff()) {
    for (int turn = 0; turn < turns; ++turn) {
      for (int d = -2; d <= 2; ++d) {
        range.angles_rad.push_back(outline.angle_rad +
                                   (turn * 360.0 / symmetry + 3.0 * d) * kRadPerDeg);
      }
    }
  } else {
    for (int d = 0; d < 72 * turns / symmetry; ++d)
      range.angles_rad.push_back(5.0 * d * kRadPerDeg);
  }
  range.separation_m = separation_m(in);
  range.count = kPosesPerPatch;
  return search_pattern(samples, in.pyramid.levels.front(), in.outline.center_m(), range,
                        in.context);
}

// Voxel means are calmer than single points: allow for several times the thickness.
double tolerance_m(const SearchInput& in, const PlanarPatch& patch) {
  return std::max(0.05 * in.size.minCoeff(), 6.0 * patch.thickness_m);
}

// A patch's plane is that of all that hangs together: beside the board a stand, a strip of floor
// that is cut, a neighbour, which tilt it. The board's own is that of what lies within its outline
// where the best match puts it.
void take_board_plane(const SearchInput& in, const VoxelCloud& voxels, PatchMatches& item) {
  constexpr int kRounds = 2;  // A tilted plane leaves out the board's ends; with them once more.
  for (int round = 0; round < kRounds; ++round) {
    PlanarPatch& patch = item.patch;
    const PlanarPose& board = item.matches.front().pose;
    std::vector<std::uint32_t> ids;
    voxels.neighbours(patch.to_lidar(board.center_m).cast<float>(), 0.5 * in.size.norm(), ids);
    FittedPlane plane;
    static_cast<PlaneFrame&>(plane) = patch;
    const Eigen::Rotation2Dd to_board(-board.angle_rad);
    std::vector<Eigen::Vector3f> inside;
    for (const auto i : ids) {
      const Eigen::Vector3f& mean_m = voxels.voxels()[i].mean_m;
      const Eigen::Vector3d p = mean_m.cast<double>();
      const auto hit = plane.ray_hit(p);
      if (!hit || std::abs(patch.normal.dot(p - patch.center_m)) > tolerance_m(in, patch)) continue;
      const Eigen::Vector2d at = to_board * (*hit - board.center_m);
      if ((at.cwiseAbs() - 0.5 * in.size).maxCoeff() < 0.0) inside.push_back(mean_m);
    }
    const auto fitted = fit_plane(inside, plane);
    if (!fitted) return;
    for (PatternMatch& match : item.matches) {
      const auto center = fitted->ray_hit(patch.to_lidar(match.pose.center_m));
      if (!center) return;
      const Eigen::Vector3d along = patch.turned(match.pose.angle_rad).col(0);
      match.pose = {std::atan2(along.dot(fitted->axis_v), along.dot(fitted->axis_u)), *center};
    }
    static_cast<PlaneFrame&>(patch) = *fitted;
  }
}

// One pass over the cloud: the points about every patch, at full density.
std::vector<Cloud> gather(const SearchInput& in, const std::vector<PatchMatches>& found) {
  std::vector<Cloud> out(found.size());
  const auto radius_sq = static_cast<float>(std::pow(0.75 * in.size.norm(), 2));
  struct Slab {
    Eigen::Vector3f normal, center, board_center;
    float tolerance;
  };
  std::vector<Slab> slabs;
  for (const PatchMatches& item : found) {
    const Eigen::Vector2d c = item.matches.front().pose.center_m;
    const Eigen::Vector3d center = item.patch.to_lidar(c);
    slabs.push_back({item.patch.normal.cast<float>(), item.patch.center_m.cast<float>(),
                     center.cast<float>(), static_cast<float>(tolerance_m(in, item.patch))});
  }
  for (std::size_t i = 0; i < in.cloud.size(); ++i) {
    if ((i & 0xFFFF) == 0 && in.context.stopped()) return out;
    const Eigen::Vector3f& p = in.cloud.points_m[i];
    for (std::size_t k = 0; k < slabs.size(); ++k) {
      if ((p - slabs[k].board_center).squaredNorm() > radius_sq) continue;
      if (std::abs(slabs[k].normal.dot(p - slabs[k].center)) > slabs[k].tolerance) continue;
      append_point(out[k], in.cloud, i);
    }
  }
  return out;
}

bool same_place(const std::vector<PatternMatch>& done, const PatternMatch& match,
                double separation) {
  return std::any_of(done.begin(), done.end(), [&](const PatternMatch& other) {
    const double turn =
        std::remainder(other.pose.angle_rad - match.pose.angle_rad, 2 * std::numbers::pi);
    return (other.pose.center_m - match.pose.center_m).norm() < 0.3 * separation &&
           std::abs(turn) < 0.2;
  });
}

// Every local maximum of the search, and of the best ones every symmetric assignment.
std::vector<PlanarPose> starting_poses(const std::vector<PatternMatch>& matches, int symmetry) {
  std::vector<PlanarPose> poses;
  for (std::size_t m = 0; m < matches.size(); ++m) {
    const int turns = m < kTurnedPoses ? symmetry : 1;
    for (int turn = 0; turn < turns; ++turn) {
      poses.push_back({matches[m].pose.angle_rad + turn * 360.0 * kRadPerDeg / symmetry,
                       matches[m].pose.center_m});
    }
  }
  return poses;
}

// The starts that survive a refinement on coarse cells: distinct, and not hopeless.
std::vector<PlanarPose> promising_poses(const SearchInput& in,
                                        const std::vector<PlanarSample>& samples,
                                        const std::vector<PatternMatch>& matches) {
  const auto cells = average_cells(samples, in.pyramid.levels.front().blur_sigma_m());
  std::vector<PatternMatch> kept;
  for (const PlanarPose& start : starting_poses(matches, in.target.outline_symmetry())) {
    const PatternMatch match =
        refine_pattern_pose(cells, in.pyramid.levels.front(), in.outline.center_m(), start);
    // Fine cells may raise a correlation, but not from half of what is needed.
    if (match.correlation > 0.5 * in.options.min_correlation &&
        !same_place(kept, match, separation_m(in)))
      kept.push_back(match);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const PatternMatch& a, const PatternMatch& b) {
    return a.gain() > b.gain();
  });
  std::vector<PlanarPose> poses;
  for (const PatternMatch& match : kept) {
    if (poses.size() < kMostPosesPerPatch) poses.push_back(match.pose);
  }
  return poses;
}

Rigid3 pose_of(const PlanarPatch& patch, const PlanarPose& pose,
               const Eigen::Vector2d& board_center_m) {
  const Eigen::Matrix3d rotation = patch.turned(pose.angle_rad);
  return Rigid3::from_matrix(
      rotation, patch.to_lidar(pose.center_m) -
                    rotation * Eigen::Vector3d(board_center_m.x(), board_center_m.y(), 0.0));
}

// Covariance of a pose known by position σ and rotation σ about the board's centre.
Matrix6d covariance_about_center(const Rigid3& pose, const Eigen::Vector2d& board_center_m,
                                 double across_m, double along_m, double tilt_rad,
                                 double turn_rad) {
  const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
  const Eigen::Vector3d center =
      pose * Eigen::Vector3d(board_center_m.x(), board_center_m.y(), 0.0);
  Matrix6d local = Matrix6d::Zero();
  local.diagonal() << across_m * across_m, across_m * across_m, along_m * along_m,
      tilt_rad * tilt_rad, tilt_rad * tilt_rad, turn_rad * turn_rad;
  const Matrix6d ad = Rigid3::from_matrix(R, center).adjoint();
  return ad * local * ad.transpose();
}

BoardCandidate pattern_candidate(const BoardOutline& outline, const PlanarPatch& patch,
                                 const PatternMatch& match, double cell, std::size_t index) {
  BoardCandidate candidate;
  candidate.lidar_from_board.transform = pose_of(patch, match.pose, outline.center_m());
  // Generous: the coarse pose is good to a fraction of the blur, the plane to its thickness.
  const double across = 0.5 * cell;
  const double radius = 0.25 * outline.size_m().minCoeff();
  const double along = std::max(0.5 * patch.thickness_m, 0.002);
  candidate.lidar_from_board.covariance =
      covariance_about_center(candidate.lidar_from_board.transform, outline.center_m(), across,
                              along, along / radius, across / radius);
  // Blurred cells overlap: about four hold one independent value.
  candidate.gain = match.gain(4.0);
  candidate.correlation = match.correlation;
  candidate.scale = match.scale;
  candidate.scale_sigma = match.scale_sigma;
  candidate.patch = index;
  return candidate;
}

BoardCandidate outline_candidate(const BoardOutline& outline, const PlanarPatch& patch,
                                 const PatternMatch& match, std::size_t index) {
  BoardCandidate candidate;
  candidate.lidar_from_board.transform = pose_of(patch, match.pose, outline.center_m());
  const double shorter = outline.size_m().minCoeff();
  const double across = 0.12 * shorter;
  const double along = std::max(patch.thickness_m, 0.01);
  candidate.lidar_from_board.covariance =
      covariance_about_center(candidate.lidar_from_board.transform, outline.center_m(), across,
                              along, 2.0 * along / (0.5 * shorter), 8.0 * kRadPerDeg);
  candidate.gain = match.gain();
  candidate.patch = index;
  return candidate;
}

void refine_patch(const SearchInput& in, const PatchMatches& item, std::size_t index,
                  BoardSearchResult& result) {
  const Cloud& points = result.patch_points[index];
  std::vector<PlanarSample> samples;
  samples.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Along the ray, so that range noise does not move the sample sideways.
    const Eigen::Vector3d ray = points.points_m[i].cast<double>();
    const double along = item.patch.normal.dot(ray);
    if (std::abs(along) < 1e-9) continue;
    const Eigen::Vector3d hit = ray * (item.patch.normal.dot(item.patch.center_m) / along);
    samples.push_back({item.patch.to_plane(hit).cast<float>(), points.intensity[i]});
  }
  const double cell = in.pyramid.levels.back().blur_sigma_m();
  const auto cells = average_cells(samples, cell);
  std::vector<PatternMatch> done;
  for (const PlanarPose& start : promising_poses(in, samples, item.matches)) {
    const PatternMatch match =
        refine_pattern_pose(cells, in.pyramid.levels.back(), in.outline.center_m(), start);
    result.best_correlation = std::max(result.best_correlation, match.correlation);
    if (match.correlation < in.options.min_correlation || same_place(done, match, separation_m(in)))
      continue;
    done.push_back(match);
    result.candidates.push_back(pattern_candidate(in.outline, item.patch, match, cell, index));
  }
}

}  // namespace

PatternPyramid::PatternPyramid(const Target& target) {
  const double side = target.outline().size_m().minCoeff();
  for (const double share : {0.025, 0.012}) levels.emplace_back(target, share * side);
}

bool matches_by_pattern(const Target& target, const Cloud& cloud) {
  // Which square of a checkerboard is black is not part of its description, so its intensities
  // have no sign to look for.
  return target.has_tags() && cloud.has_contrast();
}

BoardSearchResult search_board(const Cloud& cloud, const BoardSought& sought,
                               const BoardSearchOptions& options, const RunContext& context) {
  const Target& target = sought.target;
  const BoardOutline outline = target.outline();
  const SearchInput in{cloud, target, sought.pyramid, options, context, outline, outline.size_m()};
  BoardSearchResult result;
  const VoxelCloud voxels = voxels_of(in, sought.camera_distance_m, sought.region);
  std::vector<PatchMatches> found;
  const bool by_pattern = matches_by_pattern(target, cloud);
  const std::optional<Eigen::Vector3d> width = sought.region ? sought.region->width : std::nullopt;
  for (PlanarPatch& patch : patches_in(in, voxels)) {
    if (context.stopped()) return {};
    if (!plausible_size(in, patch)) continue;
    ++result.patches;
    PatchMatches item;
    item.matches =
        by_pattern ? search_patch(in, voxels, patch) : outline_poses(voxels, patch, target, width);
    item.patch = std::move(patch);
    for (const PatternMatch& m : item.matches)
      result.best_correlation = std::max(result.best_correlation, m.correlation);
    if (!item.matches.empty()) found.push_back(std::move(item));
  }
  keep_best(options.max_patches, by_pattern, found);
  for (PatchMatches& item : found) take_board_plane(in, voxels, item);
  result.patch_points = gather(in, found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (by_pattern) {
      refine_patch(in, found[k], k, result);
    } else {
      for (const PatternMatch& match : found[k].matches)
        result.candidates.push_back(outline_candidate(outline, found[k].patch, match, k));
    }
  }
  std::stable_sort(
      result.candidates.begin(), result.candidates.end(),
      [](const BoardCandidate& a, const BoardCandidate& b) { return a.gain > b.gain; });
  return result;
}

std::optional<Rigid3> likely_board(const Cloud& cloud, const Target& target,
                                   const RunContext& context) {
  BoardSearchOptions options;
  options.max_lever_arm_m = 25.0;  // About the LiDAR, wherever the camera is.
  const PatternPyramid pyramid(target);
  const BoardSearchResult found = search_board(cloud, {target, pyramid}, options, context);
  if (context.stopped() || found.candidates.empty()) return std::nullopt;
  return found.candidates.front().lidar_from_board.transform;
}

}  // namespace lvcalib
