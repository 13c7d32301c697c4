// SPDX-License-Identifier: BSD-3-Clause
#include "model/residuals.h"

#include <array>
#include <cmath>
#include <deque>

#include "model/effect_rows.h"
#include "model/print_rows.h"
#include "model/scene_geometry.h"

namespace lvcalib {
namespace {

class Collector {
 public:
  Collector(const MeasurementTable& table, const ModelState& state,
            const std::vector<EffectInUse>& in_use)
      : table_(table),
        state_(state),
        in_use_(in_use),
        columns_(columns_in_use(in_use, table)),
        rows_(table, columns_.list()) {
    for (std::size_t s = 0; s < table.scenes.size(); ++s) {
      geometry_.emplace_back(state.camera_from_lidar, state.camera_from_board[s]);
      if (table.print) print_.emplace_back(table, state, s, in_use);
    }
  }

  ChannelResiduals run(Channel channel) {
    out_.channel = channel;
    switch (channel) {
      case Channel::kCorner:
        for (std::size_t k = 0; k < table_.corner.size(); ++k) corner(k);
        break;
      case Channel::kRange:
        for (std::size_t k = 0; k < table_.range.size(); ++k) range(k);
        break;
      case Channel::kBoundary:
        for (std::size_t k = 0; k < table_.boundary.size(); ++k) boundary(k);
        break;
      case Channel::kIntensity:
        for (std::size_t k = 0; k < table_.intensity.size(); ++k) intensity(k);
        break;
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] double used(const EffectColumns& c, std::span<const double> by) const {
    const auto at = static_cast<std::size_t>(&c - columns_.list().data());
    double sum = 0.0;
    for (std::size_t k = 0; k < by.size(); ++k)
      sum += by[k] * in_use_[at].values(static_cast<Eigen::Index>(k));
    return sum;
  }

  void push(double value, double sigma, int scene, std::size_t row, const NuisanceRow& nuisance) {
    out_.values.push_back(value);
    out_.sigma.push_back(sigma);
    out_.scene.push_back(scene);
    out_.row.push_back(row);
    out_.nuisance.push_back(nuisance);
  }

  void corner(std::size_t k) {
    const CornerRow& r = table_.corner[k];
    const auto p =
        predict(r, table_.camera, state_.camera_from_board[static_cast<std::size_t>(r.scene)]);
    if (!p) return;
    Eigen::Vector2d residual = p->residual;
    rows_.corner(r, p->normalized, p->by_board_move,
                 [&](const EffectColumns& c, std::span<const Eigen::Vector2d> by) {
                   const auto at = static_cast<std::size_t>(&c - columns_.list().data());
                   for (std::size_t j = 0; j < by.size(); ++j)
                     residual -= by[j] * in_use_[at].values(static_cast<Eigen::Index>(j));
                 });
    for (int axis = 0; axis < 2; ++axis) {
      NuisanceRow nuisance = NuisanceRow::Zero();
      nuisance.head<6>() = p->by_pose.row(axis).transpose();
      push(residual(axis), r.sigma_px, r.scene, k, nuisance);
    }
  }

  void push(const std::optional<PrintRow>& row, double sigma, int scene, std::size_t k) {
    if (!row) return;
    NuisanceRow nuisance;
    nuisance << row->by_board_pose, row->by_levels;
    push(row->residual, sigma, scene, k, nuisance);
  }
  PrintRows& print_of(int scene) { return print_[static_cast<std::size_t>(scene)]; }

  void range(std::size_t k) {
    const RangeRow& r = table_.range[k];
    if (table_.print) return push(print_of(r.beam.scene).range(r), r.sigma_m, r.beam.scene, k);
    const SceneGeometry& g = geometry_[static_cast<std::size_t>(r.beam.scene)];
    const auto predicted = g.range_m(r.beam.direction);
    if (!predicted) return;
    const Eigen::Vector3d a = g.range_row(r.beam.direction);
    double residual = r.measured_m - *predicted;
    rows_.range(
        r, a, g.lidar_from_board().rotation.toRotationMatrix(),
        [&](const EffectColumns& c, std::span<const double> by) { residual -= used(c, by); });
    NuisanceRow nuisance = NuisanceRow::Zero();
    nuisance.head<6>() = g.by_board_pose(a, *predicted * r.beam.direction);
    push(residual, r.sigma_m, r.beam.scene, k, nuisance);
  }

  void boundary(std::size_t k) {
    const BoundaryRow& r = table_.boundary[k];
    if (table_.print) return push(print_of(r.beam.scene).edge(r), r.sigma_m, r.beam.scene, k);
    const SceneGeometry& g = geometry_[static_cast<std::size_t>(r.beam.scene)];
    const Eigen::Matrix3d rotation = g.lidar_from_board().rotation.toRotationMatrix();
    const Eigen::Vector3d moved =
        rows_.displacement(r, rotation, [&](const EffectColumns& c, std::size_t j) {
          const auto at = static_cast<std::size_t>(&c - columns_.list().data());
          return in_use_[at].values(static_cast<Eigen::Index>(j));
        });
    const auto edge = predict(r, g, moved);
    if (!edge) return;
    // The displacement is in the prediction already; what is left of the effects moves the edge.
    double residual = edge->distance_m + edge->row.dot(moved);
    rows_.edge(r, edge->row, rotation, [&](const EffectColumns& c, std::span<const double> by) {
      residual -= used(c, by);
    });
    NuisanceRow nuisance = NuisanceRow::Zero();
    nuisance.head<6>() = g.by_board_pose(edge->row, edge->point_m);
    push(residual, r.sigma_m, r.beam.scene, k, nuisance);
  }

  void intensity(std::size_t k) {
    const IntensityRow& r = table_.intensity[k];
    if (table_.print) return push(print_of(r.beam.scene).intensity(r), r.sigma, r.beam.scene, k);
    double residual = r.log_intensity - std::log(table_.level_of(r.print));
    rows_.intensity(
        r, [&](const EffectColumns& c, std::span<const double> by) { residual -= used(c, by); });
    NuisanceRow nuisance = NuisanceRow::Zero();
    nuisance(LocalLayout::kPose + static_cast<int>(r.print)) = 1.0;
    push(residual, r.sigma, r.beam.scene, k, nuisance);
  }

  const MeasurementTable& table_;
  const ModelState& state_;
  const std::vector<EffectInUse>& in_use_;
  EffectColumnsList columns_;
  EffectRows rows_;
  std::vector<SceneGeometry> geometry_;
  std::deque<PrintRows> print_;  // Of a table with a print.
  ChannelResiduals out_;
};

}  // namespace

ChannelResiduals residuals_of(const MeasurementTable& table, const ModelState& state,
                              const std::vector<EffectInUse>& in_use, Channel channel) {
  return Collector(table, state, in_use).run(channel);
}

void remove_levels(const MeasurementTable& table, ChannelResiduals& residuals) {
  if (residuals.channel != Channel::kIntensity || table.print) return;
  struct Level {
    double sum = 0.0;
    double weight = 0.0;
  };
  std::vector<std::array<Level, kPrints>> levels(table.scenes.size());
  const auto level_of = [&](std::size_t k) -> Level& {
    const auto print = static_cast<std::size_t>(table.intensity[residuals.row[k]].print);
    return levels[static_cast<std::size_t>(residuals.scene[k])][print];
  };
  for (std::size_t k = 0; k < residuals.values.size(); ++k) {
    const double weight = 1.0 / (residuals.sigma[k] * residuals.sigma[k]);
    level_of(k).sum += weight * residuals.values[k];
    level_of(k).weight += weight;
  }
  for (std::size_t k = 0; k < residuals.values.size(); ++k)
    residuals.values[k] -= level_of(k).sum / level_of(k).weight;
}

}  // namespace lvcalib
