// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "detection/board_view.h"
#include "model/board_prediction.h"
#include "model/effect.h"
#include "solve/board_returns.h"
#include "solve/pointing_jitter.h"

namespace lvcalib {

/// What one scene brings to the joint solve: corners that are in use, and the points about the
/// board.
struct ForwardScene {
  std::vector<CornerObservation> corners;
  const Cloud* board_points = nullptr;
  Rigid3 camera_from_board;                  ///< Start, from the corners alone.
  Rigid3 lidar_from_board;                   ///< Start, from the cloud alone.
  double range_sigma_m = 0.01;               ///< Start.
  std::vector<BoardOutline> uncovered = {};  ///< See ReturnSelection.
};

/// A line has an error of its own if so many of its returns are on the board; with fewer its mean
/// is known little better than a single return.
inline constexpr std::size_t kLineRows = 8;

/// Errors of the LiDAR's ranges that all scenes share (m, random effects): one of all ranges, what
/// black print reads farther than white, and one per laser line.
struct SensorErrors {
  static constexpr Eigen::Index kFirstLine = 2;
  std::vector<std::uint16_t> lines;  ///< Rising; none if fewer than two are seen.
  Eigen::VectorXd values;            ///< As last estimated; empty before.
  [[nodiscard]] Eigen::Index count() const {
    return kFirstLine + static_cast<Eigen::Index>(lines.size());
  }
};

/// All unknowns of the base model.
struct ForwardState {
  Rigid3 camera_from_lidar;
  std::vector<Rigid3> camera_from_board;
  std::vector<BoardLevels> levels;
  BeamSpread beam;
  Camera camera;
  /// Per scene the shared errors as last estimated, in the order of its columns; empty before.
  std::vector<Eigen::VectorXd> shared;
  SensorErrors sensor;
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
  kRangeShape,   ///< Range over the board: Legendre products of degree 2 to 4, per scene (m).
  kBoardShift,   ///< Between what camera and LiDAR see, the board moves in its plane (m),
  kBoardNormal,  ///< along its normal (m),
  kBoardTilt,    ///< tilts (rad),
  kBoardSpin,    ///< turns about its normal (rad); all about its middle, per scene.
  kPrintPatch,   ///< The print moves patch by patch of 0.2 m (m).
  kCornerGroup,  ///< The corners of one tag (or of one patch of a checkerboard) move (px).
  kLineGain,     ///< Intensities of one line in one scene are scaled (1).
  kLineRange,    ///< Ranges of one line in one scene are off (m).
  kSensorRange,  ///< All ranges of all scenes are off (m),
  kSensorDark,   ///< those on black print against those on white (m),
  kSensorLine,   ///< those of one line (m).
};
inline constexpr std::size_t kSharedErrors = 12;
/// Kinds from here on are of the sensor; those before of single scenes.
inline constexpr std::size_t kSceneErrors = 9;
using SharedVariances = std::array<double, kSharedErrors>;
/// Variances so small that no data see them: a kind of shared error that is not there (m², rad²,
/// px², 1).
inline constexpr SharedVariances kAbsentShared{1e-12, 1e-12, 1e-12, 1e-12, 1e-12, 1e-12,
                                               1e-7,  1e-9,  1e-12, 1e-12, 1e-12, 1e-12};

/// Whether a kind is a motion of whole boards. What moves a board between camera and LiDAR is
/// rarely independent from scene to scene: intrinsics, ranges and angles that are a little wrong
/// move it as smooth functions of where it stands. Weighing by it would trust the precise less for
/// what all of a scene's measurements share, and draws the estimate by chance; so it widens what is
/// stated and has no weight in the estimate (generalized estimating equations with a working
/// covariance: Liang & Zeger 1986).
constexpr bool moves_board(std::size_t kind) {
  return kind >= static_cast<std::size_t>(SharedError::kBoardShift) &&
         kind <= static_cast<std::size_t>(SharedError::kBoardSpin);
}

/// Standard deviations of everything.
struct ForwardNoise {
  double corner_px = 0.1;
  std::vector<SceneNoise> scenes;
  SharedVariances shared{};
  std::array<bool, kSharedErrors> admitted{};  ///< Kinds of shared error that the data show.
};

/// Unknowns that all scenes share: the extrinsic's left perturbation (6), the three numbers of the
/// beam's blur, as its Cholesky factor (a, b, c): Σ = [a 0; b c][a 0; b c]ᵀ, and the camera's
/// intrinsics (fx fy cx cy and eight distortion entries). Behind these stand the sensor's errors,
/// as many as SensorErrors::count(), once shared errors are in the model.
inline constexpr Eigen::Index kIntrinsics = 12;
inline constexpr Eigen::Index kFirstIntrinsic = 6 + kBlurParameters;
inline constexpr Eigen::Index kGlobals = kFirstIntrinsic + kIntrinsics;
/// What images of the board without a cloud say about the intrinsics, to second order about a
/// camera, their boards' poses eliminated: twice the log-likelihood changes by
/// 2 gᵀd − dᵀ Λ d for intrinsics that differ by d from `at`.
struct IntrinsicsEvidence {
  Camera at;
  Eigen::Matrix<double, kIntrinsics, kIntrinsics> information =
      Eigen::Matrix<double, kIntrinsics, kIntrinsics>::Zero();
  Eigen::Matrix<double, kIntrinsics, 1> gradient = Eigen::Matrix<double, kIntrinsics, 1>::Zero();
};
/// And of one scene, before the shared errors: T_camera_board (6) and its levels.
inline constexpr Eigen::Index kLocals = 6 + kLevelParameters;

/// Which columns of a scene's shared errors belong to which kind.
struct SharedErrorColumns {
  std::array<Eigen::Index, kSharedErrors> first{};
  std::array<Eigen::Index, kSharedErrors> count{};
  Eigen::Index total = 0;
};

/// Faults that the solve does not have, as columns of the LiDAR's rows: those that every device has
/// (see DeviceFault); where times tell, a velocity of the boards against the LiDAR while it scans
/// (m/s, LiDAR frame), and a lag of the intensities along the scan (s).
inline constexpr int kFirstAngle = static_cast<int>(DeviceFault::kAzimuthScale);
inline constexpr int kFirstOrigin = static_cast<int>(DeviceFault::kOriginAcross);
inline constexpr int kFirstMotion = kDeviceFaults;
inline constexpr int kAngleFaults = kFirstOrigin - kFirstAngle;
inline constexpr int kOriginFaults = kFirstMotion - kFirstOrigin;
inline constexpr int kMotionFaults = 3;
inline constexpr int kLagFault = kFirstMotion + kMotionFaults;
inline constexpr int kFaults = kLagFault + 1;
using FaultRow = Eigen::Matrix<double, 1, kFaults>;
using FaultMatrix = Eigen::Matrix<double, kFaults, kFaults>;

/// Normal equations of one scene about the current state, in the order: globals, locals, shared
/// errors (whose prior 1/D is not in yet). N x = g.
struct SceneEquations {
  Eigen::Index globals = kGlobals;
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  SharedErrorColumns columns;
  Eigen::VectorXd shared;  ///< The shared errors at the linearization; x holds their change.
  /// If asked for: by how much the gradient changes with the faults, and what the rows say of them:
  /// information and gradient.
  Eigen::Matrix<double, Eigen::Dynamic, kFaults> by_faults;
  FaultMatrix faults = FaultMatrix::Zero();
  FaultRow fault_gradient = FaultRow::Zero();
};

/// How well the rows of one scene fit at the state of the linearization.
struct SceneFit {
  std::size_t range_rows = 0, intensity_rows = 0, corner_rows = 0;
  double range_squares = 0.0;  ///< Σ w (e/σ)², robust.
  double intensity_squares = 0.0;
  double corner_squares = 0.0;
  double intensity_variance_share = 1.0;  ///< Var(residual)/Var(intensity), robust weights applied.
  SceneNoise noise;                       ///< Re-estimated from these residuals.
  JitterRegression jitter;
};

struct LinearizationOptions {
  bool shared_errors = true;      ///< Off while the solve is still far from its end.
  std::size_t stride = 1;         ///< Every how many-th return; 1 at the end.
  double robust_threshold = 3.0;  ///< Huber's, in σ.
  double patch_m = 0.2;
  bool faults = false;  ///< Fill SceneEquations' faults.
};

/// Measurements of all scenes, and the state and noise to linearize at. Refers to all of it.
struct LinearizationInput {
  const std::vector<ForwardScene>& scenes;
  const std::vector<BoardReturns>& returns;  ///< One per scene.
  const BlurredPrint& print;
  const ForwardState& state;
  const ForwardNoise& noise;
};

/// One of each per scene.
struct LinearizedScenes {
  std::vector<SceneEquations> equations;
  std::vector<SceneFit> fits;
};

/// Linearizes corners, ranges and intensities of all scenes at a state, in parallel. `seen`: per
/// scene one per return, kept from one linearization to the next.
LinearizedScenes linearize_scenes(const LinearizationInput& in, const LinearizationOptions& options,
                                  std::vector<std::vector<LocalPrint>>& seen, int threads);

/// The beam's blur as its Cholesky factor (a, b, c), and back.
Eigen::Vector3d blur_factor(const Eigen::Matrix2d& blur_rad2);
Eigen::Matrix2d blur_from_factor(const Eigen::Vector3d& factor);
/// ∂(hh, hv, vv)/∂(a, b, c).
Eigen::Matrix3d blur_by_factor(const Eigen::Vector3d& factor);

}  // namespace lvcalib
