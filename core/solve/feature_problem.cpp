// SPDX-License-Identifier: BSD-3-Clause
#include "solve/feature_problem.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "solve/cost_functions.h"

namespace lvcalib {
namespace {

using Block = std::array<double, 7>;

class JointProblem {
 public:
  JointProblem(const FeatureInput& in, const JointState& start, const NoiseScales& scales,
               const ObservationMask& mask, bool hold_extrinsic = false)
      : in_(in),
        scales_(scales),
        mask_(mask),
        probes_(plane_probe_points(in.target)),
        boards_(in.scenes.size()),
        problem_(problem_options()) {
    rigid_to_block(start.camera_from_lidar, extrinsic_.data());
    problem_.AddParameterBlock(extrinsic_.data(), 7, &manifold_);
    for (std::size_t s = 0; s < in.scenes.size(); ++s) {
      rigid_to_block(start.camera_from_board[s], boards_[s].data());
      if (!mask.scene[s]) continue;
      problem_.AddParameterBlock(boards_[s].data(), 7, &manifold_);
      add_scene(s);
    }
    if (hold_extrinsic) problem_.SetParameterBlockConstant(extrinsic_.data());
  }

  JointFit solve() {
    const ceres::Solver::Summary summary = descend();
    JointFit fit;
    fit.converged = summary.IsSolutionUsable() && summary.termination_type == ceres::CONVERGENCE;
    fit.state = state();
    analyse(fit);
    return fit;
  }

  std::vector<Rigid3> solve_boards() {
    descend();
    return state().camera_from_board;
  }

 private:
  ceres::Solver::Summary descend() {
    ceres::Solver::Options options;
    options.max_num_iterations = in_.options.max_iterations;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.function_tolerance = 1e-12;
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  [[nodiscard]] JointState state() const {
    JointState out;
    out.camera_from_lidar = rigid_from_block(extrinsic_.data());
    for (const Block& board : boards_)
      out.camera_from_board.push_back(rigid_from_block(board.data()));
    return out;
  }

  static ceres::Problem::Options problem_options() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  void add_scene(std::size_t s) {
    const SceneObservations& scene = in_.scenes[s];
    for (std::size_t k = 0; k < scene.corners.size(); ++k) {
      if (!mask_.corner[s][k]) continue;
      const CornerObservation& c = scene.corners[k];
      add(problem_.AddResidualBlock(
              new CornerCost(in_.camera, c.board_m, c.pixel, scales_.sigma_px), &loss_,
              boards_[s].data()),
          ResidualGroup::kCorner, 2);
    }
    PlaneAxes axes;
    axes.row(0) = scene.plane.axis_u.transpose();
    axes.row(1) = scene.plane.axis_v.transpose();
    axes.row(2) = scene.plane.normal.transpose();
    for (std::size_t k = 0; k < scene.nodes.size(); ++k) {
      if (mask_.node[s][k]) add_node(s, scene.nodes[k], axes);
    }
    // Otherwise the nodes' third axis stands for the plane.
    if (in_.options.node_term == NodeTerm::kInPlane) add_plane(s);
  }

  void add_node(std::size_t s, const RefinedNode& node, const PlaneAxes& axes) {
    const double floor_sq = in_.options.node_sigma_floor_m * in_.options.node_sigma_floor_m;
    const double scale_sq = scales_.node * scales_.node;
    const Eigen::Matrix2d in_plane =
        scale_sq * (node.covariance_m2 + floor_sq * Eigen::Matrix2d::Identity());
    if (in_.options.node_term == NodeTerm::kInPlane) {
      add(problem_.AddResidualBlock(
              new NodeCost(node.board_m, node.center_lidar_m, axes, whitening_2(in_plane)), &loss_,
              extrinsic_.data(), boards_[s].data()),
          ResidualGroup::kNode, 2);
      return;
    }
    const double variance = scale_sq * (node.sigma_m() * node.sigma_m() + floor_sq);
    Eigen::Matrix3d covariance = variance * Eigen::Matrix3d::Identity();
    if (in_.options.node_term == NodeTerm::kAllAxes) covariance.topLeftCorner<2, 2>() = in_plane;
    add(problem_.AddResidualBlock(
            new NodePointCost(node.board_m, node.center_lidar_m, axes, whitening_3(covariance)),
            &loss_, extrinsic_.data(), boards_[s].data()),
        ResidualGroup::kNode, 3);
  }

  void add_plane(std::size_t s) {
    const SceneObservations& scene = in_.scenes[s];
    const Eigen::Matrix3d covariance = scales_.plane * scales_.plane *
                                       probe_covariance(scene.plane, scene.lidar_from_board,
                                                        probes_, in_.options.plane_sigma_floor_m);
    add(problem_.AddResidualBlock(new PlaneCost(probes_, scene.plane.center_m, scene.plane.normal,
                                                whitening_3(covariance)),
                                  &loss_, extrinsic_.data(), boards_[s].data()),
        ResidualGroup::kPlane, 3);
  }

  void add(ceres::ResidualBlockId id, ResidualGroup group, int rows) {
    ids_.push_back(id);
    groups_.push_back(group);
    rows_.push_back(rows);
  }

  // Normal matrix at the solution (robust weights applied): information of the extrinsic and each
  // group's redundancy.
  void analyse(JointFit& fit) {
    ceres::Problem::EvaluateOptions options;
    options.residual_blocks = ids_;
    options.parameter_blocks.push_back(extrinsic_.data());
    for (std::size_t s = 0; s < boards_.size(); ++s) {
      if (mask_.scene[s]) options.parameter_blocks.push_back(boards_[s].data());
    }
    std::vector<double> residuals;
    ceres::CRSMatrix jacobian;
    if (!problem_.Evaluate(options, nullptr, &residuals, nullptr, &jacobian)) return;
    const Eigen::Index n = 6 * static_cast<Eigen::Index>(options.parameter_blocks.size());
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    for_each_row(jacobian, [&](std::size_t, const int* cols, const double* values, int count) {
      for (int a = 0; a < count; ++a) {
        for (int b = 0; b < count; ++b) normal(cols[a], cols[b]) += values[a] * values[b];
      }
    });
    // Arrow structure: every board pose meets only the extrinsic and itself.
    fit.information = normal.topLeftCorner<6, 6>();
    for (Eigen::Index at = 6; at < n; at += 6) {
      const Eigen::LDLT<Matrix6d> own(Matrix6d(normal.block<6, 6>(at, at)));
      const Matrix6d cross = normal.block<6, 6>(at, 0);
      fit.information -= cross.transpose() * own.solve(cross);
    }
    const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    std::size_t row = 0;
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      GroupFit& group = fit.groups[static_cast<std::size_t>(groups_[k])];
      for (int r = 0; r < rows_[k]; ++r, ++row) {
        const double e = residuals[row];
        group.chi_square += e * e;
        group.redundancy += 1.0 - leverage(jacobian, row, inverse);
        ++group.count;
      }
    }
  }

  template <class F>
  static void for_each_row(const ceres::CRSMatrix& m, F&& work) {
    for (std::size_t row = 0; row + 1 < m.rows.size(); ++row) {
      const int begin = m.rows[row];
      work(row, m.cols.data() + begin, m.values.data() + begin, m.rows[row + 1] - begin);
    }
  }

  static double leverage(const ceres::CRSMatrix& m, std::size_t row,
                         const Eigen::MatrixXd& inverse) {
    double sum = 0.0;
    for (int a = m.rows[row]; a < m.rows[row + 1]; ++a) {
      for (int b = m.rows[row]; b < m.rows[row + 1]; ++b) {
        const auto ia = static_cast<std::size_t>(a);
        const auto ib = static_cast<std::size_t>(b);
        sum += m.values[ia] * inverse(m.cols[ia], m.cols[ib]) * m.values[ib];
      }
    }
    return sum;
  }

  const FeatureInput in_;
  const NoiseScales& scales_;
  const ObservationMask& mask_;
  Eigen::Matrix3d probes_;
  Block extrinsic_{};
  std::vector<Block> boards_;
  RigidManifold manifold_;
  ceres::HuberLoss loss_{in_.options.robust_threshold};
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> ids_;
  std::vector<ResidualGroup> groups_;
  std::vector<int> rows_;
};

}  // namespace

ObservationMask mask_of(const ExtrinsicSolution& solution) {
  ObservationMask mask;
  for (const SceneSolution& scene : solution.scenes) {
    mask.scene.push_back(scene.used);
    std::vector<bool> corners;
    for (const CornerResidual& c : scene.corners) corners.push_back(c.used);
    mask.corner.push_back(std::move(corners));
    std::vector<bool> nodes;
    for (const NodeResidual& n : scene.nodes) nodes.push_back(n.used);
    mask.node.push_back(std::move(nodes));
  }
  return mask;
}

NoiseScales scales_of(const ExtrinsicSolution& solution) {
  return {solution.sigma_px, solution.node_scale, solution.plane_scale};
}

JointFit solve_joint(const FeatureInput& in, const JointState& start, const NoiseScales& scales,
                     const ObservationMask& mask) {
  return JointProblem(in, start, scales, mask).solve();
}

std::vector<Rigid3> solve_boards(const FeatureInput& in, const JointState& start,
                                 const NoiseScales& scales, const ObservationMask& mask) {
  return JointProblem(in, start, scales, mask, true).solve_boards();
}

Eigen::Matrix2d whitening_2(const Eigen::Matrix2d& covariance) {
  const Eigen::Matrix2d information = covariance.inverse();
  return information.llt().matrixU();
}

Eigen::Matrix3d whitening_3(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d information = covariance.inverse();
  return information.llt().matrixU();
}

Eigen::Matrix3d plane_probe_points(const Target& target) {
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d center = outline.center_m();
  const Eigen::Vector2d half = 0.5 * outline.size_m();
  Eigen::Matrix3d probes;
  probes.col(0) << center.x() - half.x(), center.y() - half.y(), 0.0;
  probes.col(1) << center.x() + half.x(), center.y() - half.y(), 0.0;
  probes.col(2) << center.x(), center.y() + half.y(), 0.0;
  return probes;
}

Eigen::Matrix3d probe_covariance(const FittedPlane& plane, const Rigid3& lidar_from_board,
                                 const Eigen::Matrix3d& probes_m, double floor_m) {
  // Height of a probe at (u, v): a + b u + c v.
  Eigen::Matrix3d map;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d uv = plane.to_plane(lidar_from_board * Eigen::Vector3d(probes_m.col(k)));
    map.row(k) << 1.0, uv.x(), uv.y();
  }
  return map * plane.covariance * map.transpose() + floor_m * floor_m * Eigen::Matrix3d::Identity();
}

}  // namespace lvcalib
