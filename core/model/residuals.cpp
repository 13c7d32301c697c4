// SPDX-License-Identifier: BSD-3-Clause
#include "model/residuals.h"

#include <array>
#include <cmath>
#include <deque>

#include "base/parallel.h"
#include "model/effect_rows.h"
#include "model/print_rows.h"
#include "model/scene_geometry.h"

namespace lvcalib {
namespace {

void push(double value, double sigma, int scene, std::size_t row, const NuisanceRow& nuisance,
          ChannelResiduals& out) {
  out.values.push_back(value);
  out.sigma.push_back(sigma);
  out.scene.push_back(scene);
  out.row.push_back(row);
  out.nuisance.push_back(nuisance);
}

void push(const std::optional<PrintRow>& row, double sigma, int scene, std::size_t k,
          ChannelResiduals& out) {
  if (!row) return;
  NuisanceRow nuisance;
  nuisance << row->by_board_pose, row->by_levels;
  push(row->residual, sigma, scene, k, nuisance, out);
}

void push_corners(const MeasurementTable& table, const ModelState& state,
                  const std::vector<EffectInUse>& in_use, ChannelResiduals& out) {
  const EffectColumnsList columns = columns_in_use(in_use, table);
  EffectRows rows(table, columns.list());
  for (std::size_t k = 0; k < table.corner.size(); ++k) {
    const CornerRow& r = table.corner[k];
    const auto p =
        predict(r, table.camera, state.camera_from_board[static_cast<std::size_t>(r.scene)]);
    if (!p) continue;
    Eigen::Vector2d residual = p->residual;
    rows.corner(r, p->normalized, p->by_board_move,
                [&](const EffectColumns& c, std::span<const Eigen::Vector2d> by) {
                  const auto at = static_cast<std::size_t>(&c - columns.list().data());
                  for (std::size_t j = 0; j < by.size(); ++j)
                    residual -= by[j] * in_use[at].values(static_cast<Eigen::Index>(j));
                });
    for (int axis = 0; axis < 2; ++axis) {
      NuisanceRow nuisance = NuisanceRow::Zero();
      nuisance.head<6>() = p->by_pose.row(axis).transpose();
      push(residual(axis), r.sigma_px, r.scene, k, nuisance, out);
    }
  }
}

}  // namespace

ChannelResiduals residuals_of(const MeasurementTable& table, const ModelState& state,
                              const std::vector<EffectInUse>& in_use, Channel channel) {
  ChannelResiduals out;
  out.channel = channel;
  // Corners need no print.
  std::deque<PrintRows> print;
  for (std::size_t s = 0; s < table.scenes.size() && channel != Channel::kCorner; ++s)
    print.emplace_back(table, state, s, in_use);
  const auto print_of = [&](const BeamPoint& beam) -> PrintRows& {
    return print[static_cast<std::size_t>(beam.scene)];
  };
  switch (channel) {
    case Channel::kCorner:
      push_corners(table, state, in_use, out);
      break;
    case Channel::kRange:
      for (std::size_t k = 0; k < table.range.size(); ++k) {
        const RangeRow& r = table.range[k];
        push(print_of(r.beam).range(r), r.sigma_m, r.beam.scene, k, out);
      }
      break;
    case Channel::kBoundary:
      for (std::size_t k = 0; k < table.boundary.size(); ++k) {
        const BoundaryRow& r = table.boundary[k];
        push(print_of(r.beam).edge(r), r.sigma_m, r.beam.scene, k, out);
      }
      break;
    case Channel::kIntensity:
      for (std::size_t k = 0; k < table.intensity.size(); ++k) {
        const IntensityRow& r = table.intensity[k];
        push(print_of(r.beam).intensity(r), r.sigma, r.beam.scene, k, out);
      }
      break;
  }
  return out;
}

EveryResidual every_residual(const MeasurementTable& table, const ModelState& state,
                             const std::vector<EffectInUse>& in_use, const RunContext& context) {
  EveryResidual out;
  parallel_for(kChannels, context.thread_count(), [&](std::size_t k) {
    if (!context.stopped()) out[k] = residuals_of(table, state, in_use, kAllChannels[k]);
  });
  return out;
}

}  // namespace lvcalib
