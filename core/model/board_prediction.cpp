// SPDX-License-Identifier: BSD-3-Clause
#include "model/board_prediction.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

// Beyond 80° the spot is six times as long as wide and ranges say nothing.
constexpr double kSmallestCosine = 0.17;
// Black print still returns some light; keeps ln P finite where levels are not known yet.
constexpr double kSmallestPowerShare = 0.02;

}  // namespace

Eigen::Matrix2d BeamSpread::footprint_rad2() const {
  return without_negative_axes<2>(blur_rad2 - jitter_rad2);
}

BeamAxes beam_axes(const Eigen::Vector3d& direction) {
  Eigen::Vector3d horizontal = Eigen::Vector3d::UnitZ().cross(direction);
  // Straight up or down horizontal is any direction.
  if (horizontal.squaredNorm() < 1e-12) horizontal = Eigen::Vector3d::UnitY();
  horizontal.normalize();
  return {horizontal, direction.cross(horizontal)};
}

Matrix6d board_motion(const Rigid3& lidar_from_board, const Eigen::Vector2d& center_m) {
  const Eigen::Matrix3d axes = lidar_from_board.rotation.toRotationMatrix();
  const Eigen::Vector3d middle =
      lidar_from_board * Eigen::Vector3d(center_m.x(), center_m.y(), 0.0);
  Matrix6d motion;
  motion << axes, skew(middle) * axes, Eigen::Matrix3d::Zero(), axes;
  return motion;
}

BoardPredictor::BoardPredictor(const BlurredPrint& print, const Rigid3& lidar_from_board,
                               const BoardLevels& levels, const BeamSpread& beam)
    : print_(print),
      board_from_lidar_(lidar_from_board.rotation.toRotationMatrix().transpose()),
      origin_(lidar_from_board.translation),
      normal_(board_from_lidar_.row(2).transpose()),
      height_(normal_.dot(origin_)),
      center_m_(print.outline().center_m()),
      half_size_m_(0.5 * print.outline().size_m().maxCoeff()),
      levels_(levels),
      beam_(beam),
      footprint_rad2_(beam.footprint_rad2()) {}

std::optional<BoardPredictor::Hit> BoardPredictor::hit(const Eigen::Vector3d& direction) const {
  const double along = normal_.dot(direction);
  if (along > -kSmallestCosine) return std::nullopt;
  const double range = height_ / along;
  if (!(range > 0.0)) return std::nullopt;
  return Hit{(board_from_lidar_ * (range * direction - origin_)).head<2>(), range};
}

PrintSample BoardPredictor::look(const Eigen::Vector2d& board_m, const Eigen::Matrix2d& spot,
                                 const LocalPrint* known, LocalPrint* seen) const {
  if (known != nullptr) {
    if (const auto near = known->at(board_m, spot)) return *near;
  }
  const PrintSample sample = print_.at(board_m, spot);
  if (seen != nullptr) *seen = LocalPrint(board_m, spot, sample);
  return sample;
}

std::optional<ReturnPrediction> BoardPredictor::predict(const Eigen::Vector3d& direction,
                                                        const PrintChange& change,
                                                        const LocalPrint* known,
                                                        LocalPrint* seen) const {
  const auto met = hit(direction);
  if (!met) return std::nullopt;
  const double along = normal_.dot(direction);
  const double r = met->range_m;
  const Eigen::Vector3d h = r * direction;
  const Eigen::Matrix<double, 2, 3> to_board = board_from_lidar_.topRows<2>();

  // How the beam's angles move the hit and change its range.
  const BeamAxes axes = beam_axes(direction);
  const Eigen::RowVector2d range_by_angle(-r * normal_.dot(axes.horizontal) / along,
                                          -r * normal_.dot(axes.vertical) / along);
  Eigen::Matrix2d hit_by_angle;
  hit_by_angle.col(0) = to_board * (r * axes.horizontal + range_by_angle(0) * direction);
  hit_by_angle.col(1) = to_board * (r * axes.vertical + range_by_angle(1) * direction);
  const Eigen::Matrix2d spot = hit_by_angle * beam_.blur_rad2 * hit_by_angle.transpose();

  ReturnPrediction out;
  out.board_m = met->board_m;
  out.spot_m2 = spot;
  const Eigen::Vector2d place_m = met->board_m - change.shift_m;
  PrintSample print = look(place_m, spot, known, seen);
  const double by_growth =
      change.growth_m ? print_.edges().grow(place_m, spot, *change.growth_m, print) : 0.0;
  out.white = print.white;

  // How a small motion of the board moves the hit: along the ray to the new plane, less what the
  // print moves itself.
  Eigen::Matrix<double, 3, 6> moved;  // ρ + ω × h
  moved.leftCols<3>().setIdentity();
  moved.rightCols<3>() = -skew(h);
  const Eigen::Matrix<double, 1, 6> hit_range_by_pose = normal_.transpose() * moved / along;
  const Eigen::Matrix<double, 2, 6> hit_by_pose =
      to_board * (direction * hit_range_by_pose - moved);

  const double contrast = levels_.white - levels_.black;
  const Eigen::Vector2d place = (met->board_m - center_m_) / half_size_m_;
  const double light = 1.0 + levels_.slope.dot(place);
  const double plain = levels_.black + contrast * print.white;
  const Eigen::RowVector2d by_hit = light * contrast * print.gradient_per_m.transpose() +
                                    plain * levels_.slope.transpose() / half_size_m_;
  out.intensity = plain * light;
  out.intensity_by_pose = by_hit * hit_by_pose;
  out.intensity_by_growth = -light * contrast * by_growth;
  out.intensity_by_shift = -light * contrast * print.gradient_per_m.transpose();
  out.intensity_by_angle = light * contrast * print.gradient_per_m.transpose() * hit_by_angle;
  out.intensity_by_levels << light * print.white, light * (1.0 - print.white), plain * place.x(),
      plain * place.y();
  // ∂A/∂S = ½∇∇ᵀA.
  const Eigen::Matrix2d by_blur =
      0.5 * light * contrast * hit_by_angle.transpose() * print.hessian_per_m2 * hit_by_angle;
  out.intensity_by_blur << by_blur(0, 0), 2.0 * by_blur(0, 1), by_blur(1, 1);

  // The darker part of the footprint weighs less.
  // Numbers whose white is not above zero are no power: what they would do to ranges is not known.
  const double floor = kSmallestPowerShare * std::max(levels_.white, 1e-12);
  const double power = std::max(plain, floor);
  const double share = levels_.white > 0.0 ? contrast / power : 0.0;
  const Eigen::Vector2d log_power = share * print.gradient_per_m;
  const Eigen::RowVector2d pull = range_by_angle * footprint_rad2_ * hit_by_angle.transpose();
  // A plane's range is curved over the angles: r·(δᵢⱼ + 2 ∂ᵢr ∂ⱼr/r²).
  const double curved = 0.5 * (r * footprint_rad2_.trace() +
                               2.0 / r * range_by_angle.dot(range_by_angle * footprint_rad2_));
  out.range_m = r + pull.dot(log_power) + curved;
  const Eigen::Matrix2d log_power_slope =
      share * print.hessian_per_m2 - log_power * log_power.transpose();
  out.range_by_shift = -pull * log_power_slope;
  // Growing black moves the edge towards white.
  const double steepness = print.gradient_per_m.norm();
  if (steepness > 0.0)
    out.range_by_growth = out.range_by_shift.dot(print.gradient_per_m) / steepness;
  out.range_by_pose = hit_range_by_pose - out.range_by_shift * hit_by_pose;
  return out;
}

PrintView view_print(const ReturnPrediction& p, const BoardLevels& levels, const BeamSpread& beam) {
  // Print plainer than this is white or black: what is left of an edge adds a hundredth.
  constexpr double kPlainPrint = 0.01;
  // A spot sees one edge if the print's slope is that of one within a fifth: at a corner, half a
  // width from it, it is a third less.
  constexpr double kOneEdge = 0.2;
  PrintView out;
  const Eigen::RowVector2d& by_angle = p.intensity_by_angle;
  const double slope = p.intensity_by_shift.norm();
  if (!(slope > 0.0)) return out;
  const double width = std::sqrt(by_angle.dot(by_angle * beam.blur_rad2)) / std::max(slope, 1e-12);
  // Of one straight edge the slope follows from the share of white; where it does not, the spot
  // sees several edges, and what widens dark print is not what moves them.
  const double z = normal_quantile(std::clamp(p.white, 1e-4, 1.0 - 1e-4));
  const double one_edge = std::abs(levels.white - levels.black) * normal_pdf(z) / width;
  if (p.white <= 1.0 - kPlainPrint && p.white >= kPlainPrint) {
    out.kind = std::abs(std::log(slope / one_edge)) <= kOneEdge ? PrintView::Kind::kEdge
                                                                : PrintView::Kind::kMixed;
  }
  if (out.kind == PrintView::Kind::kMixed) return out;
  out.slope = slope;
  out.width_m = width;
  out.distance_m = width * z;
  // A print moved along its own growing whiteness gets darker.
  const Eigen::RowVector2d outward = -p.intensity_by_shift;
  out.psi_rad = std::atan2(outward.y(), outward.x());
  return out;
}

}  // namespace lvcalib
