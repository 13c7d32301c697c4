// SPDX-License-Identifier: BSD-3-Clause
#include "response/edge_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.h"
#include "base/text.h"
#include "refinement/node_fit.h"

namespace lvcalib {
namespace {

// Points farther off the plane (in standard deviations of the dark print's range noise) are mixed
// with something behind or before the board.
constexpr double kPlaneGate = 5.0;

// Unit vectors across a line of sight: yaw and pitch grow along them.
struct SightAxes {
  Eigen::Vector3d yaw;
  Eigen::Vector3d pitch;
};

SightAxes sight_axes(const Eigen::Vector3d& sight) {
  const bool along_z = std::abs(sight.z()) > 0.95;
  const Eigen::Vector3d up = along_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d yaw = up.cross(sight).normalized();
  return {yaw, sight.cross(yaw)};
}

// Everything about the board that the samples share.
class EdgeCollector {
 public:
  EdgeCollector(const BoardRefinement& refinement, const std::vector<Eigen::AlignedBox2d>& covered,
                const Target& target)
      : refinement_(refinement),
        covered_(covered),
        window_(node_window(target)),
        board_from_lidar_(refinement.lidar_from_board.inverse()),
        normal_(refinement.lidar_from_board.rotation * Eigen::Vector3d::UnitZ()),
        height_(normal_.dot(refinement.lidar_from_board.translation)),
        gate_m_(kPlaneGate * *std::max_element(refinement.plane.group_sigma_m.begin(),
                                               refinement.plane.group_sigma_m.begin() + 2)) {
    const Eigen::Matrix3d to_plane =
        plane_axes(refinement.plane) * refinement.lidar_from_board.rotation.toRotationMatrix();
    const Eigen::Matrix2d turn = to_plane.topLeftCorner<2, 2>();
    footprint_ = turn.transpose() * refinement.footprint_m2 * turn;
  }

  void add(const Eigen::Vector3d& point, float intensity, std::vector<BoundarySample>& out) const {
    const double range = point.norm();
    const Eigen::Vector3d sight = point / range;
    const double across = normal_.dot(sight);
    if (std::abs(across) < 1e-6) return;
    const double board_range = height_ / across;
    if (!(std::abs(range - board_range) <= gate_m_)) return;
    const Eigen::Vector2d hit = (board_from_lidar_ * (board_range * sight)).head<2>();
    const auto node = nearest_node(hit);
    if (!node || is_covered(hit)) return;
    const Eigen::Vector2d radial = hit - refinement_.nodes[*node].board_m;
    const double radius = radial.norm();
    const double distance = radius - window_.radius_m;
    if (distance < -window_.inside_m || distance > window_.outside_m || radius <= 0.0) return;
    out.push_back(describe_sample(point, range, board_range, hit, radial / radius, distance));
    out.back().intensity = intensity;
    out.back().node = static_cast<int>(*node);
  }

 private:
  static Eigen::Matrix3d plane_axes(const FittedPlane& plane) {
    Eigen::Matrix3d axes;
    axes << plane.axis_u.transpose(), plane.axis_v.transpose(), plane.normal.transpose();
    return axes;
  }

  [[nodiscard]] std::optional<std::size_t> nearest_node(const Eigen::Vector2d& hit) const {
    const double reach = window_.radius_m + window_.outside_m;
    std::optional<std::size_t> best;
    double best_sq = reach * reach;
    for (std::size_t k = 0; k < refinement_.nodes.size(); ++k) {
      const double sq = (hit - refinement_.nodes[k].board_m).squaredNorm();
      if (sq >= best_sq) continue;
      best_sq = sq;
      best = k;
    }
    return best;
  }

  [[nodiscard]] bool is_covered(const Eigen::Vector2d& hit) const {
    return std::any_of(covered_.begin(), covered_.end(),
                       [&](const Eigen::AlignedBox2d& part) { return part.contains(hit); });
  }

  [[nodiscard]] BoundarySample describe_sample(const Eigen::Vector3d& point, double range,
                                               double board_range, const Eigen::Vector2d& hit,
                                               const Eigen::Vector2d& outward,
                                               double distance) const {
    const Eigen::Vector2d edge = hit - distance * outward;
    const Eigen::Vector3d ideal =
        refinement_.lidar_from_board * Eigen::Vector3d(edge.x(), edge.y(), 0.0);
    const double ideal_range = ideal.norm();
    const Eigen::Vector3d sight = ideal / ideal_range;
    const SightAxes axes = sight_axes(sight);
    const double cosine = normal_.dot(sight);
    BoundarySample s;
    s.board_m = hit.cast<float>();
    s.outward = outward.cast<float>();
    s.distance_m = static_cast<float>(distance);
    s.range_m = static_cast<float>(ideal_range);
    s.cos_incidence = static_cast<float>(std::abs(cosine));
    s.range_residual_m = static_cast<float>(range - board_range);
    const double forward = point.dot(sight);
    s.residual = Eigen::Vector3f(static_cast<float>(std::atan2(point.dot(axes.pitch), forward)),
                                 static_cast<float>(std::atan2(point.dot(axes.yaw), forward)),
                                 static_cast<float>(range - ideal_range));
    // A ray turned by α about the sight: the hit moves by r(a − sight (n·a)/(n·sight)) per radian.
    const Eigen::Vector3d outward_lidar =
        refinement_.lidar_from_board.rotation * Eigen::Vector3d(outward.x(), outward.y(), 0.0);
    const auto moved = [&](const Eigen::Vector3d& axis) {
      const double slant = -ideal_range * normal_.dot(axis) / cosine;
      const double across = outward_lidar.dot(ideal_range * axis + slant * sight);
      return Eigen::Vector2d(across, slant);
    };
    const Eigen::Vector2d by_pitch = moved(axes.pitch);
    const Eigen::Vector2d by_yaw = moved(axes.yaw);
    s.across_m = Eigen::Vector2f(static_cast<float>(by_pitch.x()), static_cast<float>(by_yaw.x()));
    s.slant_m = Eigen::Vector2f(static_cast<float>(by_pitch.y()), static_cast<float>(by_yaw.y()));
    s.width_m = static_cast<float>(std::sqrt(outward.dot(footprint_ * outward)));
    return s;
  }

  const BoardRefinement& refinement_;
  const std::vector<Eigen::AlignedBox2d>& covered_;
  NodeWindow window_;
  Rigid3 board_from_lidar_;
  Eigen::Vector3d normal_;
  double height_;
  double gate_m_;
  Eigen::Matrix2d footprint_;
};

// Tags nearer than this many widths mix their black into a sample.
constexpr double kTagWidths = 2.0;

// Distance to the nearest of the four tags about a circle, from a point at `radius` from its
// centre.
double tag_distance_m(const Eigen::Vector2f& outward, double radius, const Target& target) {
  const double half_gap = 0.5 * target.tag_spacing * target.tag_size_m;
  const Eigen::Vector2d p = radius * outward.cast<double>();
  return std::hypot(std::max(0.0, half_gap - std::abs(p.x())),
                    std::max(0.0, half_gap - std::abs(p.y())));
}

struct Plateau {
  std::vector<double> values;
  double level = 0.0, noise = 0.0, lowest = 0.0, highest = 0.0;
  double at_lowest = 0.0, at_highest = 0.0;  // Shares of values at the ends of the scale.
};

void measure(Plateau& plateau, float scale_low, float scale_high) {
  const auto share = [&](double end) {
    return static_cast<double>(std::count(plateau.values.begin(), plateau.values.end(), end)) /
           static_cast<double>(plateau.values.size());
  };
  plateau.at_lowest = share(scale_low);
  plateau.at_highest = share(scale_high);
  plateau.noise = mad_sigma(plateau.values);
  plateau.lowest = quantile(plateau.values, 0.05);
  plateau.highest = quantile(plateau.values, 0.95);
  plateau.level = median(plateau.values);
}

// Samples of one node parted into its two plateaus.
struct NodePlateaus {
  Plateau in, out;
  int samples = 0;
};

std::string percent(double share) {
  return std::to_string(std::lround(100.0 * share)) + " %";
}

// A plateau is clipped if much of it lies at the end of the scale while the rest, or the other
// plateau, shows noise: an intensity without any noise is no sign of clipping.
Message clipped_reason(const NodePlateaus& node, const ResponseOptions& options) {
  const auto clipped = [&](const Plateau& p, const Plateau& other, double share) {
    const bool noisy = p.highest > p.lowest || other.noise > 0.0;
    return share > options.max_clipped_share && noisy;
  };
  if (clipped(node.out, node.in, node.out.at_highest))
    return Message("intensity clipped: %1 of the paper's samples at the highest value",
                   percent(node.out.at_highest));
  if (clipped(node.out, node.in, node.out.at_lowest))
    return Message("intensity clipped: %1 of the paper's samples at the lowest value",
                   percent(node.out.at_lowest));
  if (clipped(node.in, node.out, node.in.at_highest))
    return Message("intensity clipped: %1 of the circle's samples at the highest value",
                   percent(node.in.at_highest));
  if (clipped(node.in, node.out, node.in.at_lowest))
    return Message("intensity clipped: %1 of the circle's samples at the lowest value",
                   percent(node.in.at_lowest));
  return {};
}

void judge(NodeResponse& node, NodePlateaus& plateaus, float low, float high,
           const ResponseOptions& options) {
  constexpr std::size_t kLevelSamples = 8;  // Their median is known to half of a sample's noise.
  const auto refuse = [&](NodeResponseState state, Message reason) {
    node.state = state;
    node.reason = std::move(reason);
  };
  if (plateaus.in.values.size() < kLevelSamples || plateaus.out.values.size() < kLevelSamples ||
      node.overlap < options.min_node_samples) {
    return refuse(
        NodeResponseState::kTooFewSamples,
        Message("not enough samples: %1",
                Message("%1 in the overlap region, %2 on the circle, %3 on the paper; needed %4, "
                        "%5 and %6",
                        node.overlap, plateaus.in.values.size(), plateaus.out.values.size(),
                        options.min_node_samples, kLevelSamples, kLevelSamples)));
  }
  measure(plateaus.in, low, high);
  measure(plateaus.out, low, high);
  const double contrast = plateaus.out.level - plateaus.in.level;
  const double noise = std::max(plateaus.in.noise, plateaus.out.noise);
  if (!(contrast > options.min_contrast * noise) || !(contrast > 0.0)) {
    return refuse(
        NodeResponseState::kNoContrast,
        Message("no contrast: %1",
                Message("black %1, white %2, noise %3", formatted("%.4g", plateaus.in.level),
                        formatted("%.4g", plateaus.out.level), formatted("%.3g", noise))));
  }
  if (Message reason = clipped_reason(plateaus, options); !reason.empty())
    return refuse(NodeResponseState::kClipped, std::move(reason));
  node.state = NodeResponseState::kUsed;
}

}  // namespace

std::vector<BoundarySample> collect_edge_samples(const ResponseInput& scene, const Target& target) {
  std::vector<BoundarySample> samples;
  const Cloud& cloud = *scene.board_points;
  if (!cloud.has_intensity() || scene.refinement->nodes.empty()) return samples;
  const EdgeCollector collector(*scene.refinement, scene.covered, target);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    collector.add(cloud.points_m[i].cast<double>(), cloud.intensity[i], samples);
  return samples;
}

double overlap_half_width_m(const BoundarySample& sample, const Target& target,
                            const ResponseOptions& options) {
  // Half a millimetre: far below the width of any transition that a LiDAR's beam leaves.
  constexpr double kStep = 5e-4;
  const NodeWindow window = node_window(target);
  const double width = static_cast<double>(sample.width_m);
  const double wanted =
      std::min({options.overlap_sigmas * width, window.inside_m, window.outside_m});
  if (tag_distance_m(sample.outward, window.radius_m + wanted, target) >= kTagWidths * width)
    return wanted;
  double reach = 0.0;
  while (reach + kStep < wanted && tag_distance_m(sample.outward, window.radius_m + reach + kStep,
                                                  target) >= kTagWidths * width)
    reach += kStep;
  return reach;
}

bool clear_of_tags(const BoundarySample& sample, const Target& target) {
  const double radius = target.circle_radius_m + static_cast<double>(sample.distance_m);
  return tag_distance_m(sample.outward, radius, target) >=
         kTagWidths * static_cast<double>(sample.width_m);
}

std::vector<NodeResponse> judge_nodes(const BoardRefinement& refinement,
                                      std::vector<BoundarySample>& samples, double shift_m,
                                      const Target& target, const ResponseOptions& options) {
  std::vector<NodeResponse> nodes(refinement.nodes.size());
  std::vector<NodePlateaus> plateaus(nodes.size());
  const NodeWindow window = node_window(target);
  float low = 0.0F;
  float high = 0.0F;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    low = k == 0 ? samples[k].intensity : std::min(low, samples[k].intensity);
    high = k == 0 ? samples[k].intensity : std::max(high, samples[k].intensity);
  }
  for (BoundarySample& s : samples) {
    const auto n = static_cast<std::size_t>(s.node);
    const double distance = static_cast<double>(s.distance_m) - shift_m;
    // Where tags leave less than half a width there is nothing to be learnt.
    const double half_width = overlap_half_width_m(s, target, options);
    s.overlap =
        std::abs(distance) <= half_width && half_width >= 0.5 * static_cast<double>(s.width_m);
    ++nodes[n].samples;
    nodes[n].overlap += s.overlap ? 1 : 0;
    // Plateaus begin two widths from the edge, but keep half of the ring.
    const double clear = 2.0 * static_cast<double>(s.width_m);
    if (distance < -std::min(clear, 0.5 * window.inside_m))
      plateaus[n].in.values.push_back(static_cast<double>(s.intensity));
    if (distance > std::min(clear, 0.5 * window.outside_m) && clear_of_tags(s, target))
      plateaus[n].out.values.push_back(static_cast<double>(s.intensity));
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n].id = refinement.nodes[n].id;
    if (!refinement.nodes[n].valid) {
      nodes[n].state = NodeResponseState::kNotRefined;
      const Message& why = refinement.nodes[n].reason;
      nodes[n].reason = why.empty() ? describe(nodes[n].state) : Message("not refined: %1", why);
      // Why the refinement had no use for it is often found here too, and then said more exactly.
      NodeResponse probe = nodes[n];
      judge(probe, plateaus[n], low, high, options);
      if (probe.state != NodeResponseState::kUsed) nodes[n] = probe;
      continue;
    }
    judge(nodes[n], plateaus[n], low, high, options);
  }
  for (BoundarySample& s : samples) {
    if (nodes[static_cast<std::size_t>(s.node)].state != NodeResponseState::kUsed)
      s.overlap = false;
  }
  return nodes;
}

}  // namespace lvcalib
