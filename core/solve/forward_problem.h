// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "detection/board_view.h"
#include "model/board_prediction.h"
#include "solve/board_returns.h"

namespace lvcalib {

/// What one scene brings to the joint solve: corners that are in use, and the points about the board.
struct ForwardScene {
  std::string name;
  std::vector<CornerObservation> corners;
  const Cloud* board_points = nullptr;
  Rigid3 camera_from_board;  ///< Start, from the corners alone.
  Rigid3 lidar_from_board;   ///< Start, from the cloud alone.
  double range_sigma_m = 0.01;  ///< Start.
};

/// All unknowns of the base model.
struct ForwardState {
  Rigid3 camera_from_lidar;
  std::vector<Rigid3> camera_from_board;
  std::vector<BoardLevels> levels;
  BeamSpread beam;
  [[nodiscard]] Rigid3 lidar_from_board(std::size_t scene) const {
    return camera_from_lidar.inverse() * camera_from_board[scene];
  }
};

/// Standard deviations of single measurements of one scene, on plain white and plain black.
struct SceneNoise {
  double range_white_m = 0.01, range_black_m = 0.01;
  double intensity_white = 1.0, intensity_black = 1.0;
  /// Variance inflation because neighbours along a line err alike, (1 + ρ)/(1 − ρ); 1 or more.
  double range_inflation = 1.0, intensity_inflation = 1.0;
};

/// Errors that many measurements share, as random effects u ~ N(0, D): V = I + Z D Zᵀ.
enum class SharedError {
  kRangeShape,   ///< Range over the board: Legendre products of degree 0 to 4, per scene (m).
  kPrintScene,   ///< The print as a whole moves, per scene (m).
  kPrintPatch,   ///< The print moves patch by patch of 0.2 m (m).
  kCornerGroup,  ///< The corners of one tag (or of one patch of a checkerboard) move (px).
  kLineGain,     ///< Intensities of one line in one scene are scaled (1).
};
inline constexpr std::size_t kSharedErrors = 5;
using SharedVariances = std::array<double, kSharedErrors>;

/// Standard deviations of everything.
struct ForwardNoise {
  double corner_px = 0.1;
  std::vector<SceneNoise> scenes;
  SharedVariances shared{1e-7, 1e-7, 1e-7, 1e-3, 1e-4};
};

/// Unknowns that all scenes share: the extrinsic's left perturbation (6) and the three numbers of the
/// beam's blur, as its Cholesky factor (a, b, c): Σ = [a 0; b c][a 0; b c]ᵀ.
inline constexpr Eigen::Index kGlobals = 6 + kBlurParameters;
/// And of one scene, before the shared errors: T_camera_board (6) and its levels.
inline constexpr Eigen::Index kLocals = 6 + kLevelParameters;

/// Which columns of a scene's shared errors belong to which kind.
struct SharedErrorColumns {
  std::array<Eigen::Index, kSharedErrors> first{};
  std::array<Eigen::Index, kSharedErrors> count{};
  Eigen::Index total = 0;
};

/// Normal equations of one scene about the current state, in the order: globals, locals, shared
/// errors (whose prior 1/D is not in yet). N x = g.
struct SceneEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  SharedErrorColumns columns;
};

/// How well the rows of one scene fit at the state of the linearization.
struct SceneFit {
  std::size_t range_rows = 0, intensity_rows = 0, corner_rows = 0;
  double range_squares = 0.0;      ///< Σ w (e/σ)², robust.
  double intensity_squares = 0.0;
  double corner_squares = 0.0;
  double intensity_variance_share = 1.0;  ///< Var(residual)/Var(intensity), robust weights applied.
  SceneNoise noise;                       ///< Re-estimated from these residuals.
  std::array<double, 2> jitter_sums{};    ///< Σ w g (e² − σ²): see estimate_jitter().
  Eigen::Matrix2d jitter_normal = Eigen::Matrix2d::Zero();
};

struct LinearizationOptions {
  bool shared_errors = true;    ///< Off while the solve is still far from its end.
  std::size_t stride = 1;       ///< Every how many-th return; 1 at the end.
  double robust_threshold = 3.0;  ///< Huber's, in σ.
  double patch_m = 0.2;
};

/// Linearizes corners, ranges and intensities of one scene at a state, in parallel.
SceneEquations linearize_scene(const ForwardScene& scene, std::size_t index,
                               const BoardReturns& returns, const BlurredPrint& print,
                               const Camera& camera, const ForwardState& state,
                               const ForwardNoise& noise, const LinearizationOptions& options,
                               int threads, SceneFit& fit);

/// Solution of the normal equations of all scenes.
struct GlobalSolution {
  Eigen::VectorXd globals;                ///< 6 + 3.
  Eigen::MatrixXd covariance;             ///< Of the globals.
  std::vector<Eigen::VectorXd> scenes;    ///< Locals and shared errors of every scene.
  SharedVariances squares{};              ///< Σu² per kind of shared error,
  SharedVariances determined{};           ///< and how many of them the data determine.
  double decrement = 0.0;                 ///< xᵀNx of the globals' step: its size in σ, squared.
  bool solvable = false;
};

/// Eliminates the scenes (Schur complement) and solves. `priors` of locals are in the equations.
/// With `determined` also measures what the shared errors' variances should be.
GlobalSolution solve_equations(const std::vector<SceneEquations>& scenes,
                               const SharedVariances& variances, bool measure_shared, int threads);

/// The beam's blur as its Cholesky factor (a, b, c), and back.
Eigen::Vector3d blur_factor(const Eigen::Matrix2d& blur_rad2);
Eigen::Matrix2d blur_from_factor(const Eigen::Vector3d& factor);
/// ∂(hh, hv, vv)/∂(a, b, c).
Eigen::Matrix3d blur_by_factor(const Eigen::Vector3d& factor);

}  // namespace lvcalib
