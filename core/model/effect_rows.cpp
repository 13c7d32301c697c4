// SPDX-License-Identifier: BSD-3-Clause
#include "model/effect_rows.h"

namespace lvcalib {

double log_contrast(const BoardLevels& levels) {
  const double white = std::max(levels.white, 1e-12);
  return std::log(white / std::max(levels.black, kLeastShare * white));
}

std::optional<BoundaryRow> edge_beside(const BeamPoint& beam, double log_contrast) {
  if (!beam.edge) return std::nullopt;
  BoundaryRow edge;
  edge.beam = beam;
  edge.psi_rad = beam.edge->psi_rad;
  edge.transition_m = beam.edge->transition_m;
  edge.log_contrast = log_contrast;
  return edge;
}

EffectColumnsList columns_in_use(const std::vector<EffectInUse>& in_use,
                                 const MeasurementTable& table) {
  EffectColumnsList out;
  for (const EffectInUse& use : in_use) out.add(use.effect, use.shape, table);
  return out;
}

std::optional<CornerPrediction> predict(const CornerRow& row, const Camera& camera,
                                        const Rigid3& camera_from_board) {
  const Eigen::Vector3d p =
      camera_from_board * Eigen::Vector3d(row.board_m.x(), row.board_m.y(), 0.0);
  Eigen::Matrix<double, 2, 3> by_point;
  const auto pixel = camera.project(p, &by_point);
  if (!pixel) return std::nullopt;
  CornerPrediction out;
  out.residual = row.pixel - *pixel;
  out.normalized = p.head<2>() / p.z();
  out.by_board_move = by_point * camera_from_board.rotation.toRotationMatrix();
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << Eigen::Matrix3d::Identity(), -skew(p);
  out.by_pose = by_point * by_pose;
  return out;
}

}  // namespace lvcalib
