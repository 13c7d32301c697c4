// SPDX-License-Identifier: BSD-3-Clause
#include "refinement/board_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/statistics.h"
#include "refinement/layout.h"
#include "refinement/node_fit.h"
#include "refinement/transition.h"

namespace lvcalib {
namespace {

// Shares of the circle's radius between which the footprint is looked for: finer than a hundredth
// cannot be told from a step, wider than the radius leaves no plateau.
constexpr double kSmallestFootprint = 0.01;
constexpr double kLargestFootprint = 1.0;
constexpr double kFirstFootprint = 0.15;
// Footprint and noise are re-estimated this often, then kept: with few samples they would go on
// swapping bins in and out for ever.
constexpr int kSettlingRounds = 8;
// From this iteration on steps shrink as 1/2, 1/3, …: a bin that is refused in one round and
// taken in the next would keep the layout swinging by a fraction of its standard deviation.
constexpr int kDampedFrom = 12;

// Points on the board, parted into white and black print, whose range noise differs.
struct BoardPoints {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<std::uint8_t> groups;
};

// Points inside the outline (shrunk, since beams on the edge mix board and background).
BoardPoints points_on_board(const Cloud& cloud, const Target& target,
                            const Rigid3& lidar_from_board) {
  const BoardOutline outline = target.outline();
  const bool print_is_placed = target.has_tags() && cloud.has_contrast();
  const double shrink = 0.02 * outline.size_m().minCoeff();
  const Rigid3 board_from_lidar = lidar_from_board.inverse();
  BoardPoints out;
  out.points_m.reserve(cloud.size());
  out.groups.reserve(cloud.size());
  for (const Eigen::Vector3f& p : cloud.points_m) {
    // Along the ray to the board, so that range noise does not decide.
    const Eigen::Vector3d q = board_from_lidar * p.cast<double>().eval();
    const Eigen::Vector3d origin = board_from_lidar.translation;
    const double along = origin.z() - q.z();
    if (std::abs(along) < 1e-9) continue;
    const Eigen::Vector3d hit = origin + (q - origin) * (origin.z() / along);
    if (hit.x() > outline.lower_left_m.x() + shrink &&
        hit.x() < outline.upper_right_m.x() - shrink &&
        hit.y() > outline.lower_left_m.y() + shrink &&
        hit.y() < outline.upper_right_m.y() - shrink) {
      out.points_m.push_back(p);
      // By geometry: the noisy intensity would sort noise. Where the outline alone placed the
      // board, its print is not placed well enough.
      const bool dark = print_is_placed && target.albedo(hit.head<2>()).value_or(1.0) < 0.5;
      out.groups.push_back(dark ? 1 : 0);
    }
  }
  return out;
}

FittedPlane plane_guess(const Rigid3& lidar_from_board, const Target& target) {
  const Eigen::Matrix3d R = lidar_from_board.rotation.toRotationMatrix();
  const Eigen::Vector2d center = target.outline().center_m();
  FittedPlane plane;
  plane.normal = R.col(2);
  plane.axis_u = R.col(0);
  plane.axis_v = R.col(1);
  plane.center_m = lidar_from_board * Eigen::Vector3d(center.x(), center.y(), 0.0);
  return plane;
}

// What all iterations are given.
struct NodeInput {
  const RefinementOptions& options;
  NodeWindow window;
  std::vector<TargetNode> nodes;
  std::vector<std::vector<PlaneSample>> samples;  // per node
};

// Where the iteration stands.
struct NodeState {
  TransitionModel model;
  LayoutPose layout;
  std::vector<NodeFit> fits;  // per node
};

bool by_midpoints(const RefinementOptions& options) {
  return options.estimator == CenterEstimator::kMidpoint;
}

// The layout where the coarse pose puts it.
LayoutPose first_layout(const FittedPlane& plane, const Rigid3& lidar_from_board) {
  const Eigen::Vector3d x_axis = lidar_from_board.rotation * Eigen::Vector3d::UnitX();
  LayoutPose out;
  out.translation_m = plane.to_plane(lidar_from_board.translation);
  out.angle_rad = std::atan2(plane.axis_v.dot(x_axis), plane.axis_u.dot(x_axis));
  return out;
}

// Samples that the nodes may still reach while the layout moves, per node.
std::vector<std::vector<PlaneSample>> samples_about(const NodeInput& in, const FittedPlane& plane,
                                                    const LayoutPose& layout, const Cloud& cloud) {
  const double reach = in.window.radius_m + in.window.outside_m + 4.0 * in.options.max_step_m;
  std::vector<std::vector<PlaneSample>> out(in.nodes.size());
  const auto& sigmas = plane.group_sigma_m;
  const double gate = 5.0 * std::max(sigmas[0], sigmas[1]);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const auto residual = plane.range_residual_m(p);
    if (!residual || std::abs(*residual) > gate) continue;
    const auto uv = in.options.along_rays ? plane.ray_hit(p) : std::optional(plane.to_plane(p));
    if (!uv) continue;
    for (std::size_t n = 0; n < in.nodes.size(); ++n) {
      if ((*uv - layout * in.nodes[n].center_m).squaredNorm() < reach * reach) {
        out[n].push_back({*uv, cloud.intensity[i]});
      }
    }
  }
  return out;
}

// Distances measured from the fitted circle instead of the predicted one.
void append_centred(const TransitionModel& model, const std::vector<UnwrappedSample>& samples,
                    const NodeFit& fit, std::vector<UnwrappedSample>& out) {
  for (UnwrappedSample s : samples) {
    const Eigen::Vector3d by_wave(s.cos_psi, s.sin_psi, 1.0);
    s.distance_m -= by_wave.dot(fit.record.wave_m);
    s.leverage = model.leverage(s, by_wave.dot(fit.covariance_m2 * by_wave));
    out.push_back(s);
  }
}

// Projects the step-limited centres to the layout; returns the largest move of a node.
double move_layout(const NodeInput& in, double share, NodeState& at) {
  std::vector<Eigen::Vector2d> centers;
  std::vector<Eigen::Vector2d> model;
  std::vector<double> weights;
  for (std::size_t n = 0; n < in.nodes.size(); ++n) {
    if (!at.fits[n].record.valid) continue;
    Eigen::Vector2d step = at.fits[n].record.wave_m.head<2>();
    if (step.norm() > in.options.max_step_m) step *= in.options.max_step_m / step.norm();
    centers.push_back(at.fits[n].record.center_uv_m + share * step);
    model.push_back(in.nodes[n].center_m);
    weights.push_back(at.fits[n].weight);
  }
  if (centers.size() < 2) return 0.0;
  const LayoutPose next = fit_layout(centers, model, weights);
  double largest = 0.0;
  for (const TargetNode& node : in.nodes) {
    largest = std::max(largest, (next * node.center_m - at.layout * node.center_m).norm());
  }
  at.layout = next;
  return largest;
}

IterationRecord iterate(const NodeInput& in, int iteration, NodeState& at) {
  IterationRecord record;
  std::vector<std::vector<UnwrappedSample>> unwrapped(in.nodes.size());
  std::vector<NodeRecord> records(in.nodes.size());
  for (std::size_t n = 0; n < in.nodes.size(); ++n) {
    records[n].id = in.nodes[n].id;
    unwrapped[n] = unwrap_node(in.samples[n], at.layout * in.nodes[n].center_m, in.window,
                               at.model.mean_sigma_m(), records[n]);
  }
  at.fits.clear();
  std::vector<UnwrappedSample> centred;
  for (std::size_t n = 0; n < in.nodes.size(); ++n) {
    if (unwrapped[n].empty()) {
      NodeFit none;
      none.record = records[n];
      at.fits.push_back(std::move(none));
      continue;
    }
    at.fits.push_back(fit_node(unwrapped[n], records[n], in.window, at.model, in.options));
    if (at.fits.back().record.valid)
      append_centred(at.model, unwrapped[n], at.fits.back(), centred);
  }
  if (!centred.empty() && iteration < kSettlingRounds && !by_midpoints(in.options)) {
    at.model.update(centred, kSmallestFootprint * in.window.radius_m,
                    kLargestFootprint * in.window.radius_m);
  }
  record.transition_sigma_m = at.model.mean_sigma_m();
  record.max_update_m = move_layout(in, 1.0 / std::max(1, iteration - kDampedFrom + 2), at);
  for (const NodeFit& fit : at.fits) record.nodes.push_back(fit.record);
  return record;
}

// The centres as the paper has them: constrained to the layout, and one σ from the scatter of the
// circle's midpoints about their wave.
void place_on_layout(const LayoutPose& layout, double sigma_floor_m, const NodeFit& fit,
                     RefinedNode& node) {
  node.center_uv_m = layout * node.board_m;
  double weights = 0.0;
  for (const BinRecord& bin : fit.record.bins) {
    if (bin.state == BinState::kUsed) weights += 1.0 / (bin.sigma_m * bin.sigma_m);
  }
  const double scatter = weights > 0.0 ? std::sqrt(fit.chi_square / weights) : 0.0;
  const double sigma = std::max(sigma_floor_m, scatter);
  node.covariance_m2 = sigma * sigma * Eigen::Matrix2d::Identity();
}

void finish(const NodeInput& in, const NodeState& at, const LayoutPose& first,
            BoardRefinement& result) {
  // Bins that scatter more than their standard deviations say: widen all by the common factor.
  double chi_square = 0.0;
  int freedom = 0;
  for (const NodeFit& fit : at.fits) {
    if (!fit.record.valid) continue;
    chi_square += fit.chi_square;
    freedom += fit.degrees_of_freedom;
  }
  const double excess = freedom > 0 ? std::max(1.0, chi_square / freedom) : 1.0;
  std::vector<Eigen::Vector2d> centers;
  std::vector<Eigen::Vector2d> model;
  std::vector<double> variances;
  for (std::size_t n = 0; n < in.nodes.size(); ++n) {
    const NodeFit& fit = at.fits[n];
    RefinedNode node;
    node.id = in.nodes[n].id;
    node.valid = fit.record.valid;
    node.reason = fit.record.reason;
    node.board_m = in.nodes[n].center_m;
    node.center_uv_m = fit.record.center_uv_m + fit.record.wave_m.head<2>();
    node.covariance_m2 = excess * fit.covariance_m2.topLeftCorner<2, 2>();
    if (node.valid) {
      centers.push_back(node.center_uv_m);
      model.push_back(node.board_m);
      variances.push_back(0.5 * node.covariance_m2.trace());
    }
    if (by_midpoints(in.options))
      place_on_layout(at.layout, in.options.midpoint_sigma_floor_m, fit, node);
    node.center_lidar_m = result.plane.to_lidar(node.center_uv_m);
    node.raw_lidar_m = result.plane.to_lidar(first * node.board_m);
    node.valid_bins = static_cast<int>(
        std::count_if(fit.record.bins.begin(), fit.record.bins.end(),
                      [](const BinRecord& b) { return b.state == BinState::kUsed; }));
    result.nodes.push_back(std::move(node));
  }
  const LayoutScale scale = measure_scale(centers, model, variances);
  result.scale = scale.scale;
  result.scale_sigma = scale.sigma;
  result.footprint_m2 = at.model.footprint_m2();
  const TransitionNoise& noise = at.model.noise();
  result.intensity_noise = std::sqrt(0.5 * (noise.variance(-4.0) + noise.variance(4.0)));
  result.lidar_from_board = Rigid3::from_matrix(result.plane.turned(at.layout.angle_rad),
                                                result.plane.to_lidar(at.layout.translation_m));
}

}  // namespace

RefinementOptions as_in_paper(RefinementOptions options) {
  options.estimator = CenterEstimator::kMidpoint;
  options.along_rays = false;
  return options;
}

Message describe(BinState state) {
  switch (state) {
    case BinState::kUsed:
      return Message("used");
    case BinState::kTooFewSamples:
      return Message("too few samples");
    case BinState::kWeakContrast:
      return Message("contrast too weak for the noise");
    case BinState::kOneSided:
      return Message("samples on one side of the edge only");
    case BinState::kNoCrossing:
      return Message("no crossing of the mid-level");
    case BinState::kOutlier:
      return Message("contradicts the other bins");
  }
  return {};
}

double RefinedNode::sigma_m() const {
  return std::sqrt(0.5 * covariance_m2.trace());
}

int BoardRefinement::valid_nodes() const {
  return static_cast<int>(
      std::count_if(nodes.begin(), nodes.end(), [](const RefinedNode& n) { return n.valid; }));
}

Result<BoardPlane> fit_board_plane(const Cloud& board_points, const Target& target,
                                   const Rigid3& lidar_from_board) {
  BoardPlane out;
  out.lidar_from_board = lidar_from_board;
  const Eigen::Vector2d center = target.outline().center_m();
  // Twice: the second time with the points that the first plane puts inside the outline.
  for (int round = 0; round < 2; ++round) {
    const BoardPoints points = points_on_board(board_points, target, out.lidar_from_board);
    out.board_points = points.points_m.size();
    const auto plane =
        fit_plane(points.points_m, plane_guess(out.lidar_from_board, target), points.groups);
    const Eigen::Vector3d middle =
        out.lidar_from_board * Eigen::Vector3d(center.x(), center.y(), 0.0);
    if (!plane || std::abs(plane->normal.dot(middle)) < 1e-9) {
      return Error::input(Message("no plane fits the board's %1 LiDAR points; at least ten, not "
                                  "all on one scan line, are needed",
                                  out.board_points),
                          {}, Message("let the scanner dwell longer or bring the board nearer"));
    }
    out.plane = *plane;
    // The pose follows the plane: same place and turn, new normal.
    Eigen::Matrix3d R;
    R.col(2) = plane->normal;
    const Eigen::Vector3d x = out.lidar_from_board.rotation * Eigen::Vector3d::UnitX();
    R.col(0) = (x - plane->normal * plane->normal.dot(x)).normalized();
    R.col(1) = R.col(2).cross(R.col(0));
    const double along = plane->normal.dot(middle);
    const Eigen::Vector3d on_plane = middle * (plane->normal.dot(plane->center_m) / along);
    out.lidar_from_board =
        Rigid3::from_matrix(R, on_plane - R * Eigen::Vector3d(center.x(), center.y(), 0.0));
  }
  return out;
}

Result<BoardRefinement> refine_board(const Cloud& board_points, const Target& target,
                                     const Rigid3& lidar_from_board,
                                     const RefinementOptions& options, const RunContext& context,
                                     const RefinementObserver& on_iteration) {
  const auto plane = fit_board_plane(board_points, target, lidar_from_board);
  if (!plane) return plane.error();
  return refine_nodes(board_points, target, *plane, options, context, on_iteration);
}

Result<BoardRefinement> refine_nodes(const Cloud& board_points, const Target& target,
                                     const BoardPlane& plane, const RefinementOptions& options,
                                     const RunContext& context,
                                     const RefinementObserver& on_iteration) {
  BoardRefinement result;
  result.plane = plane.plane;
  result.lidar_from_board = plane.lidar_from_board;
  result.board_points = plane.board_points;
  if (!target.has_circles() || !board_points.has_contrast()) {
    result.converged = true;
    return result;
  }
  const LayoutPose first = first_layout(result.plane, result.lidar_from_board);
  NodeInput in{options, node_window(target), target.nodes(), {}};
  in.samples = samples_about(in, result.plane, first, board_points);
  NodeState at{TransitionModel(kFirstFootprint * target.circle_radius_m), first, {}};
  for (int i = 0; i < options.max_iterations && !result.converged; ++i) {
    if (context.stopped()) return Error::cancelled();
    result.history.push_back(iterate(in, i, at));
    if (on_iteration) on_iteration(result);
    // The footprint settles during the first rounds; a still layout before that means nothing.
    result.converged = result.history.back().max_update_m < options.tolerance_m && i >= 2;
  }
  finish(in, at, first, result);
  if (!result.converged)
    result.warnings.push_back(Message("refinement did not settle within its iterations"));
  return result;
}

}  // namespace lvcalib
