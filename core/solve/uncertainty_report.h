// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solve/feature_solver.h"

namespace lvcalib {

/// The extrinsic from one half of the scenes against that from the other.
struct SplitHalf {
  Message name;                    ///< "near/far", "left/right", "flat/tilted"
  std::vector<std::string> first;  ///< Scenes of the first half (near, left, flat).
  std::vector<std::string> second;
  double translation_mm = 0.0;  ///< Difference, of the LiDAR's origin in the camera frame.
  double rotation_mrad = 0.0;
  double expected_translation_mm = 0.0;  ///< What noise alone makes of it, root mean square.
  double expected_rotation_mrad = 0.0;
  double chi_square = 0.0;  ///< ξᵀ(Σ₁ + Σ₂)⁻¹ξ, six degrees of freedom.
  double gate = 0.0;        ///< Exceeded by noise alone once in a thousand.
  [[nodiscard]] bool agrees() const { return chi_square <= gate; }
};

/// How an uncertainty shows in the image: the extrinsic's, or the intrinsics'.
struct ProjectedUncertainty {
  int columns = 0;
  int rows = 0;
  double range_m = 0.0;                ///< 0: of a direction.
  std::vector<Eigen::Vector2d> pixel;  ///< Row by row.
  std::vector<double> sigma_px;  ///< Root of the trace of the pixel's covariance; NaN: no ray.
  /// The best and the worst place of the image; nothing where no ray is seen.
  [[nodiscard]] std::optional<std::pair<double, double>> reach_px() const;
};

inline constexpr int kMapColumns = 24;  ///< Of every map over the image.

/// How it shows in space: at this distance along the camera's axis.
struct RangeUncertainty {
  double range_m = 0.0;
  double across_mm = 0.0;  ///< Root of the trace of the covariance across the ray.
  double along_mm = 0.0;
};

struct UncertaintyReport {
  std::vector<SplitHalf> splits;
  Message splits_reason;                   ///< Why there are none: "not enough scenes for …".
  std::vector<ProjectedUncertainty> maps;  ///< One per range.
  std::vector<RangeUncertainty> by_range;
};

/// Covariance of an extrinsic (left perturbation in the camera frame) together with that of the
/// intrinsics (fx fy cx cy, eight distortion entries) of the camera that it goes with. Estimated
/// together they err together: a principal point that is off is taken up by a turn, and a LiDAR
/// point falls into the image better than either alone would have it.
struct ProjectionCovariance {
  Matrix6d extrinsic = Matrix6d::Zero();
  Eigen::Matrix<double, 12, 6> cross = Eigen::Matrix<double, 12, 6>::Zero();
  Eigen::Matrix<double, 12, 12> intrinsics = Eigen::Matrix<double, 12, 12>::Zero();
  /// With the intrinsics held.
  static ProjectionCovariance held(const Matrix6d& extrinsic) {
    ProjectionCovariance out;
    out.extrinsic = extrinsic;
    return out;
  }
};

/// The extrinsic from some of the scenes (indices); nothing if they do not determine it.
using SubsetSolver =
    std::function<std::optional<UncertainRigid3>(const std::vector<std::size_t>& scenes)>;

/// Compares halves of the scenes, and projects `covariance`. Halves need two scenes each; three
/// for targets without circles. Halves are solved by `subset`, or, without it, from nodes and
/// planes.
UncertaintyReport assess_uncertainty(const FeatureInput& in, const ExtrinsicSolution& joint,
                                     const ProjectionCovariance& covariance,
                                     const SubsetSolver& subset = {});

/// The same projections of another covariance (the total one), without halves.
UncertaintyReport project_uncertainty(const Camera& camera, const ProjectionCovariance& covariance);

/// How far a direction that is known in the camera's frame may fall elsewhere in the image when the
/// intrinsics (fx fy cx cy, eight distortion entries) have this covariance: J Σ Jᵀ with J = ∂π/∂θ.
/// An extrinsic that is estimated with this camera takes up the part that a turn of the camera
/// would do as well.
ProjectedUncertainty project_intrinsics(const Camera& camera,
                                        const Eigen::Matrix<double, 12, 12>& covariance,
                                        int columns = kMapColumns);

/// Covariance (px²) of the pixel of a LiDAR point, which lies at `point_in_camera_m`. Nothing where
/// the camera sees no such point.
std::optional<Eigen::Matrix2d> pixel_covariance(const Camera& camera,
                                                const Eigen::Vector3d& point_in_camera_m,
                                                const ProjectionCovariance& covariance);

}  // namespace lvcalib
