// SPDX-License-Identifier: BSD-3-Clause
#include "model/residuals.h"

#include <array>
#include <cmath>

#include "base/parallel.h"
#include "model/effect_rows.h"
#include "model/fitted_model.h"
#include "model/print_rows.h"
#include "model/scene_geometry.h"

namespace lvcalib {
namespace {

void push(double value, double sigma, int scene, std::size_t row, ChannelResiduals& out) {
  out.values.push_back(value);
  out.sigma.push_back(sigma);
  out.scene.push_back(scene);
  out.row.push_back(row);
}

// What the print tells of a row, and the row's standard deviation.
struct Measured {
  std::optional<PrintRow> row;
  double sigma = 0.0;
};

// Rows of a channel that see the print, scene by scene in parts of even length on all threads.
// `predict` gives what is measured of a row.
template <class Row, class Predict>
void push_print(const FittedModel& model, const std::vector<Row>& rows, bool with_nuisance,
                const RunContext& context, const Predict& predict, ChannelResiduals& out) {
  constexpr std::size_t kPart = 4096;  // Some milliseconds of work, far above what a thread costs.
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool fresh = starts.empty() || k - starts.back() == kPart ||
                       rows[k].beam.scene != rows[k - 1].beam.scene;
    if (fresh) starts.push_back(k);
  }
  std::vector<ChannelResiduals> parts(starts.size());
  parallel_for(parts.size(), context.thread_count(), [&](std::size_t part) {
    if (context.stopped()) return;
    const std::size_t end = part + 1 < starts.size() ? starts[part + 1] : rows.size();
    const int scene = rows[starts[part]].beam.scene;
    PrintRows print(model.table, model.state, static_cast<std::size_t>(scene), model.effects);
    for (std::size_t k = starts[part]; k < end; ++k) {
      const Measured measured = predict(print, rows[k]);
      if (!measured.row) continue;
      push(measured.row->residual, measured.sigma, scene, k, parts[part]);
      if (!with_nuisance) continue;
      parts[part].nuisance.emplace_back();
      parts[part].nuisance.back() << measured.row->by_board_pose, measured.row->by_levels;
    }
  });
  const auto join = [&](auto ChannelResiduals::*values) {
    std::size_t size = 0;
    for (const ChannelResiduals& part : parts) size += (part.*values).size();
    (out.*values).reserve(size);
    for (ChannelResiduals& part : parts) {
      (out.*values).insert((out.*values).end(), (part.*values).begin(), (part.*values).end());
      (part.*values) = {};
    }
  };
  join(&ChannelResiduals::values);
  join(&ChannelResiduals::sigma);
  join(&ChannelResiduals::scene);
  join(&ChannelResiduals::row);
  join(&ChannelResiduals::nuisance);
}

void push_corners(const MeasurementTable& table, const ModelState& state,
                  const std::vector<EffectInUse>& in_use, bool with_nuisance,
                  ChannelResiduals& out) {
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
      push(residual(axis), r.sigma_px, r.scene, k, out);
      if (!with_nuisance) continue;
      out.nuisance.emplace_back(NuisanceRow::Zero());
      out.nuisance.back().head<6>() = p->by_pose.row(axis).transpose();
    }
  }
}

ChannelResiduals residuals_of(const MeasurementTable& table, const ModelState& state,
                              const std::vector<EffectInUse>& in_use, Channel channel,
                              bool with_nuisance, const RunContext& context) {
  ChannelResiduals out;
  out.channel = channel;
  const auto fill = [&](const auto& rows, const auto& predict) {
    push_print({table, state, in_use}, rows, with_nuisance, context, predict, out);
  };
  switch (channel) {
    case Channel::kCorner:
      push_corners(table, state, in_use, with_nuisance, out);
      break;
    case Channel::kRange:
      fill(table.range, [](PrintRows& print, const RangeRow& r) {
        return Measured{print.range(r), r.sigma_m};
      });
      break;
    case Channel::kBoundary:
      fill(table.boundary, [](PrintRows& print, const BoundaryRow& r) {
        return Measured{print.edge(r), r.sigma_m};
      });
      break;
    case Channel::kIntensity:
      fill(table.intensity, [](PrintRows& print, const IntensityRow& r) {
        return Measured{print.intensity(r), r.sigma};
      });
      break;
  }
  return out;
}

}  // namespace

ChannelResiduals residuals_of(const MeasurementTable& table, const ModelState& state,
                              const std::vector<EffectInUse>& in_use, Channel channel,
                              const RunContext& context) {
  return residuals_of(table, state, in_use, channel, false, context);
}

ChannelResiduals residuals_and_nuisance(const MeasurementTable& table, const ModelState& state,
                                        const std::vector<EffectInUse>& in_use, Channel channel,
                                        const RunContext& context) {
  return residuals_of(table, state, in_use, channel, true, context);
}

EveryResidual every_residual(const MeasurementTable& table, const ModelState& state,
                             const std::vector<EffectInUse>& in_use, const RunContext& context) {
  EveryResidual out;
  for (std::size_t k = 0; k < kChannels && !context.stopped(); ++k)
    out[k] = residuals_and_nuisance(table, state, in_use, kAllChannels[k], context);
  return out;
}

}  // namespace lvcalib
