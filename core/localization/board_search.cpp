// SPDX-License-Identifier: BSD-3-Clause
#include "localization/board_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

class BoardSearch {
 public:
  BoardSearch(const Cloud& cloud, const Target& target, const PatternPyramid& pyramid,
              const BoardSearchOptions& options, const RunContext& context)
      : cloud_(cloud),
        target_(target),
        pyramid_(pyramid),
        options_(options),
        context_(context),
        outline_(target.outline()),
        size_(outline_.size_m()) {}

  BoardSearchResult run(double camera_distance_m, const std::optional<BoardSearchRegion>& region) {
    BoardSearchResult result;
    VoxelCloud::Options voxel_options;
    // Fine enough to keep the circles and tags apart, coarse enough for a quick search.
    voxel_options.voxel_m = size_.minCoeff() / 40.0;
    voxel_options.cell_m = 0.3 * size_.minCoeff();
    const double around = options_.max_lever_arm_m + 0.5 * size_.norm();
    voxel_options.min_range_m = std::max(options_.min_range_m, camera_distance_m - around);
    voxel_options.max_range_m = camera_distance_m + around;
    if (region) {
      voxel_options.region_center_m = region->center_m;
      voxel_options.region_radius_m = region->radius_m;
    }
    const VoxelCloud voxels(cloud_, voxel_options, context_);
    PatchSearchOptions patch_options;
    patch_options.board_width_m = size_.x();
    patch_options.board_height_m = size_.y();
    patch_options.plane_tolerance_m = options_.plane_tolerance_m;
    auto patches = find_planar_patches(voxels, patch_options, context_);

    drop_copies(patches);
    std::vector<PatchMatches> found;
    const bool by_pattern = matches_by_pattern(target_, cloud_);
    for (PlanarPatch& patch : patches) {
      if (context_.stopped()) return {};
      if (!plausible_size(patch)) continue;
      ++result.patches;
      PatchMatches item;
      item.matches =
          by_pattern ? search_patch(voxels, patch) : outline_poses(voxels, patch, target_);
      item.patch = std::move(patch);
      for (const PatternMatch& m : item.matches) {
        result.best_correlation = std::max(result.best_correlation, m.correlation);
      }
      if (!item.matches.empty()) found.push_back(std::move(item));
    }
    std::stable_sort(found.begin(), found.end(), [](const PatchMatches& a, const PatchMatches& b) {
      return a.best_gain() > b.best_gain();
    });
    drop_repeated(found);
    if (found.size() > static_cast<std::size_t>(options_.max_patches)) {
      found.resize(static_cast<std::size_t>(options_.max_patches));
    }
    while (by_pattern && found.size() > 1 &&
           found.back().best_gain() < kLeastGainShare * found.front().best_gain()) {
      found.pop_back();
    }
    collect(found, by_pattern, result);
    return result;
  }

 private:
  [[nodiscard]] bool plausible_size(const PlanarPatch& patch) const {
    if (patch.open) return options_.search_walls;
    const double longer = size_.maxCoeff();
    const double shorter = size_.minCoeff();
    // A quarter larger: stand, cables and neighbours that touch; smaller: partly out of view.
    return patch.extent_m.x() < 1.25 * std::hypot(longer, shorter) &&
           patch.extent_m.y() < 1.25 * longer && patch.extent_m.x() > 0.4 * shorter;
  }

  // A wall that grows by next to nothing from one connection gap to the next need not be searched
  // again: that takes long. Of small patches each one is tried, since their planes differ more.
  void drop_copies(std::vector<PlanarPatch>& patches) const {
    std::vector<PlanarPatch> kept;
    for (PlanarPatch& patch : patches) {
      const auto points = static_cast<double>(patch.voxels.size());
      const bool copy = std::any_of(kept.begin(), kept.end(), [&](const PlanarPatch& other) {
        return other.open && patch.open &&
               (other.center_m - patch.center_m).norm() < 0.02 * size_.minCoeff() &&
               std::abs(other.normal.dot(patch.normal)) > std::cos(1.0 * kRadPerDeg) &&
               std::abs(static_cast<double>(other.voxels.size()) - points) < 0.01 * points;
      });
      if (!copy) kept.push_back(std::move(patch));
    }
    patches = std::move(kept);
  }

  // The same board seen through different connection gaps gives the same patch twice.
  static void drop_repeated(std::vector<PatchMatches>& found) {
    std::vector<PatchMatches> kept;
    for (PatchMatches& item : found) {
      const bool repeated = std::any_of(kept.begin(), kept.end(), [&](const PatchMatches& other) {
        const auto& a = item.matches.front().pose.center_m;
        const auto& b = other.matches.front().pose.center_m;
        const Eigen::Vector3d pa =
            item.patch.center_m + a.x() * item.patch.axis_u + a.y() * item.patch.axis_v;
        const Eigen::Vector3d pb =
            other.patch.center_m + b.x() * other.patch.axis_u + b.y() * other.patch.axis_v;
        return (pa - pb).norm() < 0.1 * other.patch.extent_m.y() &&
               item.patch.normal.dot(other.patch.normal) > std::cos(5.0 * kRadPerDeg);
      });
      if (!repeated) kept.push_back(std::move(item));
    }
    found = std::move(kept);
  }

  std::vector<PatternMatch> search_patch(const VoxelCloud& voxels, const PlanarPatch& patch) const {
    std::vector<PlanarSample> samples;
    samples.reserve(patch.voxels.size());
    for (const auto i : patch.voxels) {
      const auto& voxel = voxels.voxels()[i];
      samples.push_back(
          {patch.to_plane(voxel.mean_m.cast<double>()).cast<float>(), voxel.mean_intensity});
    }
    const OutlineFit outline = fit_outline(samples, size_);
    PatternSearchRange range;
    range.center_m = outline.center_m;
    // A patch of the board's own size leaves little room; cut-off or grown ones leave the
    // difference, and any angle.
    const double misfit = outline.side_error_m.cwiseAbs().maxCoeff();
    range.slack_m =
        0.06 * size_.minCoeff() + (patch.open ? 0.6 * patch.extent_m.x() : 0.6 * misfit);
    range.step_m = 0.03 * size_.minCoeff();
    // One turn of the symmetric assignments is enough here: seen this coarsely the others look the
    // same, and starting_poses() adds them.
    const int symmetry = target_.outline_symmetry();
    if (misfit < 0.12 * size_.minCoeff()) {
      for (int d = -2; d <= 2; ++d)
        range.angles_rad.push_back(outline.angle_rad + 3.0 * d * kRadPerDeg);
    } else {
      for (int d = 0; d < 72 / symmetry; ++d) range.angles_rad.push_back(5.0 * d * kRadPerDeg);
    }
    return search_pattern(samples, pyramid_.levels.front(), outline_.center_m(), range,
                          separation_m(), kPosesPerPatch, context_);
  }

  // Two poses closer than half a tag pitch (or half a ChArUco board's square) are the same local
  // maximum.
  [[nodiscard]] double separation_m() const {
    return target_.has_tags() ? 0.5 * target_.tag_pitch_m() : 0.25 * size_.minCoeff();
  }

  void collect(const std::vector<PatchMatches>& found, bool by_pattern, BoardSearchResult& result) {
    result.patch_points = gather(found);
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (by_pattern) {
        refine_patch(found[k], k, result);
      } else {
        for (const PatternMatch& match : found[k].matches) {
          result.candidates.push_back(outline_candidate(found[k].patch, match, k));
        }
      }
    }
    std::stable_sort(
        result.candidates.begin(), result.candidates.end(),
        [](const BoardCandidate& a, const BoardCandidate& b) { return a.gain > b.gain; });
  }

  // One pass over the cloud: the points about every patch, at full density.
  [[nodiscard]] std::vector<Cloud> gather(const std::vector<PatchMatches>& found) const {
    std::vector<Cloud> out(found.size());
    const auto radius_sq = static_cast<float>(std::pow(0.75 * size_.norm(), 2));
    struct Slab {
      Eigen::Vector3f normal, center, board_center;
      float tolerance;
    };
    std::vector<Slab> slabs;
    for (const PatchMatches& item : found) {
      const Eigen::Vector2d c = item.matches.front().pose.center_m;
      const Eigen::Vector3d center =
          item.patch.center_m + c.x() * item.patch.axis_u + c.y() * item.patch.axis_v;
      // Voxel means are calmer than single points: allow for several times the thickness.
      const double tolerance = std::max(0.05 * size_.minCoeff(), 6.0 * item.patch.thickness_m);
      slabs.push_back({item.patch.normal.cast<float>(), item.patch.center_m.cast<float>(),
                       center.cast<float>(), static_cast<float>(tolerance)});
    }
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      if ((i & 0xFFFF) == 0 && context_.stopped()) return out;
      const Eigen::Vector3f& p = cloud_.points_m[i];
      for (std::size_t k = 0; k < slabs.size(); ++k) {
        if ((p - slabs[k].board_center).squaredNorm() > radius_sq) continue;
        if (std::abs(slabs[k].normal.dot(p - slabs[k].center)) > slabs[k].tolerance) continue;
        append_point(out[k], cloud_, i);
      }
    }
    return out;
  }

  void refine_patch(const PatchMatches& item, std::size_t index, BoardSearchResult& result) const {
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
    const double cell = pyramid_.levels.back().blur_sigma_m();
    const auto cells = average_cells(samples, cell);
    std::vector<PatternMatch> done;
    for (const PlanarPose& start : promising_poses(samples, item.matches)) {
      const PatternMatch match =
          refine_pattern_pose(cells, pyramid_.levels.back(), outline_.center_m(), start);
      result.best_correlation = std::max(result.best_correlation, match.correlation);
      if (match.correlation < options_.min_correlation || same_place(done, match)) continue;
      done.push_back(match);
      result.candidates.push_back(pattern_candidate(item.patch, match, cell, index));
    }
  }

  [[nodiscard]] bool same_place(const std::vector<PatternMatch>& done,
                                const PatternMatch& match) const {
    return std::any_of(done.begin(), done.end(), [&](const PatternMatch& other) {
      const double turn =
          std::remainder(other.pose.angle_rad - match.pose.angle_rad, 2 * std::numbers::pi);
      return (other.pose.center_m - match.pose.center_m).norm() < 0.3 * separation_m() &&
             std::abs(turn) < 0.2;
    });
  }

  // The starts that survive a refinement on coarse cells: distinct, and not hopeless.
  [[nodiscard]] std::vector<PlanarPose> promising_poses(
      const std::vector<PlanarSample>& samples, const std::vector<PatternMatch>& matches) const {
    const auto cells = average_cells(samples, pyramid_.levels.front().blur_sigma_m());
    std::vector<PatternMatch> kept;
    for (const PlanarPose& start : starting_poses(matches)) {
      const PatternMatch match =
          refine_pattern_pose(cells, pyramid_.levels.front(), outline_.center_m(), start);
      // Fine cells may raise a correlation, but not from half of what is needed.
      if (match.correlation > 0.5 * options_.min_correlation && !same_place(kept, match))
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

  // Every local maximum of the search, and of the best ones every symmetric assignment.
  [[nodiscard]] std::vector<PlanarPose> starting_poses(
      const std::vector<PatternMatch>& matches) const {
    std::vector<PlanarPose> poses;
    const int symmetry = target_.outline_symmetry();
    for (std::size_t m = 0; m < matches.size(); ++m) {
      const int turns = m < kTurnedPoses ? symmetry : 1;
      for (int turn = 0; turn < turns; ++turn) {
        poses.push_back({matches[m].pose.angle_rad + turn * 360.0 * kRadPerDeg / symmetry,
                         matches[m].pose.center_m});
      }
    }
    return poses;
  }

  [[nodiscard]] Rigid3 pose_of(const PlanarPatch& patch, const PlanarPose& pose) const {
    const double c = std::cos(pose.angle_rad);
    const double s = std::sin(pose.angle_rad);
    Eigen::Matrix3d rotation;
    rotation.col(0) = c * patch.axis_u + s * patch.axis_v;
    rotation.col(1) = -s * patch.axis_u + c * patch.axis_v;
    rotation.col(2) = patch.normal;
    const Eigen::Vector3d center =
        patch.center_m + pose.center_m.x() * patch.axis_u + pose.center_m.y() * patch.axis_v;
    const Eigen::Vector2d oc = outline_.center_m();
    return Rigid3::from_matrix(rotation, center - rotation * Eigen::Vector3d(oc.x(), oc.y(), 0.0));
  }

  // Covariance of a pose known by position σ and rotation σ about the board's centre.
  [[nodiscard]] Matrix6d covariance_about_center(const Rigid3& pose, double across_m,
                                                 double along_m, double tilt_rad,
                                                 double turn_rad) const {
    const Eigen::Matrix3d R = pose.rotation.toRotationMatrix();
    const Eigen::Vector2d oc = outline_.center_m();
    const Eigen::Vector3d center = pose * Eigen::Vector3d(oc.x(), oc.y(), 0.0);
    Matrix6d local = Matrix6d::Zero();
    local.diagonal() << across_m * across_m, across_m * across_m, along_m * along_m,
        tilt_rad * tilt_rad, tilt_rad * tilt_rad, turn_rad * turn_rad;
    const Matrix6d ad = Rigid3::from_matrix(R, center).adjoint();
    return ad * local * ad.transpose();
  }

  [[nodiscard]] BoardCandidate pattern_candidate(const PlanarPatch& patch,
                                                 const PatternMatch& match, double cell,
                                                 std::size_t index) const {
    BoardCandidate candidate;
    candidate.lidar_from_board.transform = pose_of(patch, match.pose);
    // Generous: the coarse pose is good to a fraction of the blur, the plane to its thickness.
    const double across = 0.5 * cell;
    const double radius = 0.25 * size_.minCoeff();
    const double along = std::max(0.5 * patch.thickness_m, 0.002);
    candidate.lidar_from_board.covariance = covariance_about_center(
        candidate.lidar_from_board.transform, across, along, along / radius, across / radius);
    // Blurred cells overlap: about four hold one independent value.
    candidate.gain = match.gain(4.0);
    candidate.correlation = match.correlation;
    candidate.scale = match.scale;
    candidate.scale_sigma = match.scale_sigma;
    candidate.patch = index;
    return candidate;
  }

  [[nodiscard]] BoardCandidate outline_candidate(const PlanarPatch& patch,
                                                 const PatternMatch& match,
                                                 std::size_t index) const {
    BoardCandidate candidate;
    candidate.lidar_from_board.transform = pose_of(patch, match.pose);
    const double across = 0.12 * size_.minCoeff();
    const double along = std::max(patch.thickness_m, 0.01);
    candidate.lidar_from_board.covariance =
        covariance_about_center(candidate.lidar_from_board.transform, across, along,
                                2.0 * along / (0.5 * size_.minCoeff()), 8.0 * kRadPerDeg);
    candidate.gain = match.gain();
    candidate.patch = index;
    return candidate;
  }

  const Cloud& cloud_;
  const Target& target_;
  const PatternPyramid& pyramid_;
  const BoardSearchOptions& options_;
  const RunContext& context_;
  BoardOutline outline_;
  Eigen::Vector2d size_;
};

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

BoardSearchResult search_board(const Cloud& cloud, const Target& target,
                               const PatternPyramid& pyramid, double camera_distance_m,
                               const std::optional<BoardSearchRegion>& region,
                               const BoardSearchOptions& options, const RunContext& context) {
  return BoardSearch(cloud, target, pyramid, options, context).run(camera_distance_m, region);
}

}  // namespace lvcalib
