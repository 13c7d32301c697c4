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

class Collector {
 public:
  Collector(const MeasurementTable& table, const ModelState& state,
            const std::vector<EffectInUse>& in_use)
      : table_(table),
        state_(state),
        in_use_(in_use),
        columns_(columns_in_use(in_use, table)),
        rows_(table, columns_.list()) {}

  ChannelResiduals run(Channel channel) {
    out_.channel = channel;
    // Corners need no print.
    for (std::size_t s = 0; s < table_.scenes.size() && channel != Channel::kCorner; ++s)
      print_.emplace_back(table_, state_, s, in_use_);
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
    push(print_of(r.beam.scene).range(r), r.sigma_m, r.beam.scene, k);
  }

  void boundary(std::size_t k) {
    const BoundaryRow& r = table_.boundary[k];
    push(print_of(r.beam.scene).edge(r), r.sigma_m, r.beam.scene, k);
  }

  void intensity(std::size_t k) {
    const IntensityRow& r = table_.intensity[k];
    push(print_of(r.beam.scene).intensity(r), r.sigma, r.beam.scene, k);
  }

  const MeasurementTable& table_;
  const ModelState& state_;
  const std::vector<EffectInUse>& in_use_;
  EffectColumnsList columns_;
  EffectRows rows_;
  std::deque<PrintRows> print_;
  ChannelResiduals out_;
};

}  // namespace

ChannelResiduals residuals_of(const MeasurementTable& table, const ModelState& state,
                              const std::vector<EffectInUse>& in_use, Channel channel) {
  return Collector(table, state, in_use).run(channel);
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
