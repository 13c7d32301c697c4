// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <Eigen/Core>

#include "base/rigid3.h"
#include "target/blurred_print.h"

namespace lvcalib {

/// Covariances of a LiDAR's beam about its reported direction, in rad², beam frame: first axis
/// horizontal (LiDAR z × ray), second vertical (ray × horizontal).
struct BeamSpread {
  /// Of all that blurs what is seen on average: footprint and pointing jitter together.
  Eigen::Matrix2d blur_rad2 = Eigen::Matrix2d::Zero();
  /// Of the pointing jitter alone, which also makes single returns scatter at edges.
  Eigen::Matrix2d jitter_rad2 = Eigen::Matrix2d::Zero();
  /// The footprint: what is left of the blur without the jitter, never negative.
  [[nodiscard]] Eigen::Matrix2d footprint_rad2() const;
};

/// How one scene's returns show the print: I = (black + (white − black)·A)·(1 + slopeᵀx), where x
/// runs from −1 to 1 over the board.
struct BoardLevels {
  double white = 1.0;
  double black = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
};

/// Number of parameters of BoardLevels (white, black, two slopes) and of a blur (hh, hv, vv).
inline constexpr int kLevelParameters = 4;
inline constexpr int kBlurParameters = 3;

/// What one return on the board should say, and how that depends on the state.
struct ReturnPrediction {
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();  ///< Where the ray meets the board.
  double range_m = 0.0;  ///< Mean over the footprint, weighted with the received power.
  double intensity = 0.0;
  double white = 0.0;                                 ///< Share of white in the blurred spot, A.
  Eigen::Matrix2d spot_m2 = Eigen::Matrix2d::Zero();  ///< Covariance of the blurred spot, board.
  /// By the left perturbation of lidar_from_board, order (translation, rotation); m, m/rad, 1/m.
  Eigen::Matrix<double, 1, 6> range_by_pose;
  Eigen::Matrix<double, 1, 6> intensity_by_pose;
  Eigen::Matrix<double, 1, kLevelParameters> intensity_by_levels;
  Eigen::Matrix<double, 1, kBlurParameters> intensity_by_blur;  ///< By blur_rad2: hh, hv, vv.
  Eigen::RowVector2d intensity_by_shift;  ///< By a shift of the print on the board, 1/m.
  Eigen::RowVector2d range_by_shift;      ///< The same of the range: the pull of the footprint.
  Eigen::RowVector2d intensity_by_angle;  ///< By the beam's two angles, 1/rad.
  /// By black that grows all around, 1/m and 1. The intensity's only if it is asked for (see
  /// PrintChange), the range's is that of the nearest edge, moved.
  double intensity_by_growth = 0.0, range_by_growth = 0.0;
};

/// What effects do to the print.
struct PrintChange {
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();  ///< Displacement on the board.
  /// By how much black has grown all around (see PrintEdges); nothing: it has not, and what it
  /// would do to the intensity is not asked for.
  std::optional<double> growth_m = {};
};

/// The forward model of a LiDAR return on the board: the one place where it stands.
///
/// The ray meets the board's plane at h = r·d, r = n·t/(n·d). The spot that it sees there has the
/// covariance S = J Σ Jᵀ with J = ∂(u, v)/∂(angles), which holds the stretch by 1/cos θ. The mean
/// intensity follows from the print blurred by S, A = print ⊗ N(0, S) (see BlurredPrint). The range
/// is the mean over the footprint weighted with the received power P ∝ black + (white − black)·A:
/// r + ∇rᵀ Σ_f ∇ln P + ½ tr(Σ_f ∇∇ᵀr) (Stein's lemma, to second order in the footprint).
class BoardPredictor {
 public:
  BoardPredictor(const BlurredPrint& print, const Rigid3& lidar_from_board,
                 const BoardLevels& levels, const BeamSpread& beam);

  /// Of a return reported along the unit vector `direction`. Nothing if the ray does not meet the
  /// board's front side at less than 80° of incidence.
  [[nodiscard]] std::optional<ReturnPrediction> predict(const Eigen::Vector3d& direction) const {
    return predict(direction, PrintChange{});
  }
  /// The same with the print changed. What was seen of the print as it is drawn is taken from
  /// `known` if it was seen near enough; if it has to be looked up, `seen` gets it. Either may be
  /// null, or both the same.
  [[nodiscard]] std::optional<ReturnPrediction> predict(const Eigen::Vector3d& direction,
                                                        const PrintChange& change,
                                                        const LocalPrint* known = nullptr,
                                                        LocalPrint* seen = nullptr) const;

  /// Where a ray meets the board's plane, in board coordinates, and its range; the cheap part.
  struct Hit {
    Eigen::Vector2d board_m;
    double range_m;
  };
  [[nodiscard]] std::optional<Hit> hit(const Eigen::Vector3d& direction) const;

 private:
  [[nodiscard]] PrintSample look(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& spot,
                                 const LocalPrint* known, LocalPrint* seen) const;

  const BlurredPrint& print_;
  Eigen::Matrix3d board_from_lidar_;  // Rotation.
  Eigen::Vector3d origin_;            // Of the board, in the LiDAR frame.
  Eigen::Vector3d normal_;
  double height_;  // normal · origin.
  Eigen::Vector2d center_m_;
  double half_size_m_;
  BoardLevels levels_;
  BeamSpread beam_;
  Eigen::Matrix2d footprint_rad2_;
};

/// Left perturbation of T_lidar_board by a motion (translation, rotation) along the board's axes
/// about a point of the board.
Matrix6d board_motion(const Rigid3& lidar_from_board, const Eigen::Vector2d& center_m);

/// The beam frame at a unit direction: horizontal and vertical axis.
struct BeamAxes {
  Eigen::Vector3d horizontal, vertical;
};
BeamAxes beam_axes(const Eigen::Vector3d& direction);

/// What the spot of a return sees of the print: plain black or white, one straight edge, or several
/// (near a corner, in a pattern finer than the spot).
struct PrintView {
  enum class Kind { kPlain, kEdge, kMixed };
  Kind kind = Kind::kPlain;
  // Of an edge, and of plain print in whose spot an edge leaves a trace (else the slope is zero):
  double slope = 0.0;       ///< Of the intensity across it, 1/m.
  double width_m = 0.0;     ///< σ of the spot across it.
  double distance_m = 0.0;  ///< From it to the spot, on the white side positive.
  double psi_rad = 0.0;     ///< Polar angle of the way from black to white, board frame.
};
PrintView view_print(const ReturnPrediction& p, const BoardLevels& levels, const BeamSpread& beam);

}  // namespace lvcalib
