// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/residual_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/mixed_model.h"

namespace lvcalib {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

std::vector<int> components_of(const ChannelResiduals& r, Channel channel) {
  std::vector<int> out;
  if (channel != Channel::kCorner) return out;
  for (std::size_t k = 0; k < r.row.size(); ++k)
    out.push_back(k > 0 && r.row[k] == r.row[k - 1] ? 1 : 0);
  return out;
}

// Values of another list of residuals in the order of this one; both go through rows upwards.
std::vector<float> aligned(const ChannelResiduals& wanted, const ChannelResiduals& other,
                           double unit) {
  std::vector<float> out(wanted.row.size(), kNone);
  std::size_t j = 0;
  for (std::size_t k = 0; k < wanted.row.size(); ++k) {
    while (j < other.row.size() && other.row[j] < wanted.row[k]) ++j;
    if (j >= other.row.size() || other.row[j] != wanted.row[k]) continue;
    out[k] = static_cast<float>(unit * other.values[j++]);
  }
  return out;
}

// How extrinsic, board poses and intensity levels give way to an effect in a fit that does not know
// it: with all its weights and random effects, told the effect's values and told zeros, what they
// take over is the difference.
struct Adaptation {
  Adaptation(const FittedModel& model, const EffectInUse& effect) {
    EffectColumnsList columns;
    columns.add(effect.effect, effect.shape, model.table);
    const Linearization linear = linearize(model.table, model.state, model.effects, columns, {});
    const auto& parameters = columns.list().front().parameters;
    ColumnSubset subset;
    append_columns(columns.list().front(), nullptr, subset);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      subset.prior_sigma[k] = 1e-6 * parameters[k].size_of_interest;
    }
    // One set of variances for both, so that the response is linear in the values.
    const ModelFit untold = fit_model(linear, subset, {}, {});
    for (std::size_t k = 0; k < parameters.size(); ++k)
      subset.prior_mean[k] = effect.values(static_cast<Eigen::Index>(k));
    const ModelFit told = fit_model(linear, subset, untold.variances, {.rounds = 0});
    extrinsic = untold.solution.head<6>() - told.solution.head<6>();
    for (std::size_t s = 0; s < untold.local.size(); ++s)
      local.emplace_back(untold.local[s].head(kLocal) - told.local[s].head(kLocal));
  }

  // What of it shows in a residual of such a derivative. The LiDAR sees the board through the
  // extrinsic: its derivative is the pose's negative.
  [[nodiscard]] double in_row(const NuisanceRow& row, int scene, bool sees_extrinsic) const {
    const double own = row.dot(local[static_cast<std::size_t>(scene)]);
    return sees_extrinsic ? own - row.head<6>().dot(extrinsic) : own;
  }

  static constexpr int kLocal = LocalLayout::kFixed;
  Vector6d extrinsic = Vector6d::Zero();
  std::vector<Eigen::VectorXd> local;
};

}  // namespace

const Covariate* ResidualColumns::find(const std::string& name) const {
  const auto at = std::find_if(covariates.begin(), covariates.end(),
                               [&](const Covariate& c) { return c.name == name; });
  return at == covariates.end() ? nullptr : &*at;
}

ResidualColumns residual_columns(const FittedModel& model, const FittedModel& before,
                                 Channel channel) {
  const MeasurementTable& table = model.table;
  const auto residuals_at = [&](const FittedModel& at) {
    return residuals_of(table, at.state, at.effects, channel);
  };
  const ChannelResiduals now = residuals_at(model);
  const double unit = display_factor(channel);
  ResidualColumns out;
  out.channel = channel;
  out.value.reserve(now.values.size());
  for (std::size_t k = 0; k < now.values.size(); ++k) {
    out.value.push_back(static_cast<float>(unit * now.values[k]));
    out.sigma.push_back(static_cast<float>(unit * now.sigma[k]));
  }
  const bool itself = &before.state == &model.state;
  out.before = itself ? out.value : aligned(now, residuals_at(before), unit);
  out.scene = now.scene;
  out.row = now.row;
  out.component = components_of(now, channel);
  out.covariates = covariates_of(table, channel, now);
  return out;
}

std::vector<float> effect_pattern(const FittedModel& model, const EffectInUse& effect,
                                  Channel channel, bool adapted) {
  std::optional<Adaptation> adaptation;
  if (adapted) adaptation.emplace(model, effect);
  const std::vector<double> with = residuals_of(model.table, model.state, {effect}, channel).values;
  const ChannelResiduals without = residuals_and_nuisance(model.table, model.state, {}, channel);
  const bool sees_extrinsic = channel == Channel::kRange || channel == Channel::kBoundary;
  std::vector<float> out;
  out.reserve(with.size());
  for (std::size_t k = 0; k < with.size(); ++k) {
    double value = without.values[k] - with[k];
    if (adaptation)
      value -= adaptation->in_row(without.nuisance[k], without.scene[k], sees_extrinsic);
    out.push_back(static_cast<float>(display_factor(channel) * value));
  }
  return out;
}

std::vector<Channel> channels_of(const Effect& effect, double shape, const FittedModel& model) {
  // A few rows of each channel tell.
  const MeasurementTable& table = model.table;
  MeasurementTable few = table.without_rows();
  const auto thin = [](const auto& from, auto& to) {
    const std::size_t stride = std::max<std::size_t>(1, from.size() / 500);
    for (std::size_t k = 0; k < from.size(); k += stride) to.push_back(from[k]);
  };
  thin(table.range, few.range);
  thin(table.boundary, few.boundary);
  thin(table.corner, few.corner);
  thin(table.intensity, few.intensity);
  const auto parameters = effect.parameters(table);
  std::vector<Channel> out;
  for (const Channel channel : kAllChannels) {
    const ChannelResiduals without = residuals_of(few, model.state, {}, channel);
    bool any = false;
    for (std::size_t p = 0; p < parameters.size() && !any; ++p) {
      // The pointer does not own: the effect outlives this call.
      EffectInUse use{EffectPtr(EffectPtr(), &effect), shape,
                      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()))};
      use.values(static_cast<Eigen::Index>(p)) = parameters[p].size_of_interest;
      const ChannelResiduals with = residuals_of(few, model.state, {use}, channel);
      for (std::size_t k = 0; k < with.values.size(); ++k)
        any = any || std::abs(with.values[k] - without.values[k]) > 1e-3 * without.sigma[k];
    }
    if (any) out.push_back(channel);
  }
  return out;
}

}  // namespace lvcalib
