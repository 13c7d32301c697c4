// SPDX-License-Identifier: BSD-3-Clause
// The part of EffectSearch that settles shape numbers.
#include <algorithm>
#include <cmath>

#include <boost/math/tools/minima.hpp>

#include "base/parallel.h"
#include "discovery/effect_search.h"
#include "model/shape_slope.h"

namespace lvcalib {
namespace {

constexpr int kBits = 10;  // a thousandth of the bracket
constexpr std::uintmax_t kMostEvaluations = 14;

// Neighbours of a value on a grid.
std::pair<double, double> bracket(std::vector<double> grid, double value) {
  std::sort(grid.begin(), grid.end());
  double low = grid.front();
  double high = grid.back();
  for (const double g : grid) {
    if (g < value) low = g;
    if (g > value) {
      high = g;
      break;
    }
  }
  return {low, high};
}

}  // namespace

double EffectSearch::preferred_shape(const EffectPtr& effect) const {
  const std::vector<double> shapes = shapes_worth_trying(*effect);
  if (shapes.size() == 1) return shapes.front();
  EffectColumnsList columns = own_columns();
  const ColumnSubset subset = own_subset(columns);
  for (const double shape : shapes) columns.add(effect, shape, table());
  const Linearization linear = linearize(table(), state_, model(), columns, context_);
  if (context_.stopped()) return shapes.front();
  const Reference reference = make_reference(linear, subset, variances_, {});
  std::vector<double> gain(shapes.size(), -HUGE_VAL);
  parallel_for(shapes.size(), context_.thread_count(), [&](std::size_t k) {
    if (!context_.stopped())
      gain[k] =
          evaluate_candidate(linear, reference, own_count() + k, options_.tolerance, {.rounds = 3})
              .total_gain();
  });
  return shapes[static_cast<std::size_t>(std::max_element(gain.begin(), gain.end()) -
                                         gain.begin())];
}

EffectSearch::ShapeProfile::ShapeProfile(const EffectSearch& search, std::size_t k)
    : search_(search), k_(k) {
  const EffectColumnsList columns = search.own_columns();
  all_ = linearize(search.table(), search.state_, search.model(), columns, search.context_);
  if (search.context_.stopped()) return;
  const EffectColumns& mine = columns.list()[k];
  for (const Channel channel : kAllChannels) {
    for (int p = 0; p < mine.count(); ++p)
      acts_[static_cast<std::size_t>(channel)] |= all_.squares(channel, mine.first + p) > 0.0;
  }
}

double EffectSearch::ShapeProfile::operator()(double shape) const {
  std::vector<EffectInUse> in_use = search_.model();
  in_use[k_].shape = shape;
  EffectColumnsList columns;
  for (const EffectInUse& use : in_use) columns.add(use.effect, use.shape, search_.table());
  Linearization linear =
      linearize(search_.table(), search_.state_, in_use, columns, search_.context_, acts_);
  if (search_.context_.stopped()) return 0.0;
  for (std::size_t s = 0; s < linear.scenes.size(); ++s) {
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (acts_[c]) continue;
      linear.scenes[s].products[c] = all_.scenes[s].products[c];
      linear.scenes[s].rows[c] = all_.scenes[s].rows[c];
    }
  }
  return fit_model(linear, search_.own_subset(columns), search_.variances_, {.rounds = 0})
      .log_likelihood;
}

bool EffectSearch::move_shape(std::size_t k) {
  const std::vector<double> shapes = in_use_[k].effect->shapes(table());
  if (in_use_[k].held || !in_use_[k].effect->has_smooth_shape() || shapes.size() < 2) return false;
  const auto [low, high] = bracket(shapes, in_use_[k].shape);
  const ShapeProfile profile(*this, k);
  if (context_.stopped()) return false;
  std::uintmax_t most = kMostEvaluations;
  const auto [shape, value] = boost::math::tools::brent_find_minima(
      [&](double s) { return context_.stopped() ? 0.0 : -profile(s); }, low, high, kBits, most);
  if (context_.stopped() || -value < profile(in_use_[k].shape)) return false;
  in_use_[k].shape = shape;
  return true;
}

void EffectSearch::refine_shape(std::size_t k) {
  if (move_shape(k)) refit();
}

void EffectSearch::refine_shapes() {
  bool moved = false;
  for (std::size_t k = 0; k < in_use_.size() && !context_.stopped(); ++k)
    moved = move_shape(k) || moved;
  if (moved) refit();
  estimate_joint_covariance();
}

void EffectSearch::estimate_joint_covariance() {
  EffectColumnsList columns = own_columns();
  ColumnSubset subset = own_subset(columns);
  std::vector<std::size_t> shaped;
  for (std::size_t k = 0; k < in_use_.size(); ++k) {
    if (in_use_[k].held || !in_use_[k].effect->has_smooth_shape() ||
        in_use_[k].effect->shapes(table()).size() < 2)
      continue;
    columns.add(make_shape_slope(in_use_[k], table()), 0.0, table());
    append_columns(columns.list().back(), nullptr, subset);
    shaped.push_back(k);
  }
  if (shaped.empty() || context_.stopped()) return;
  const Linearization linear = linearize(table(), state_, model(), columns, context_);
  if (context_.stopped()) return;
  const ModelFit fit = fit_model(linear, subset, variances_, {.rounds = 0});
  const auto own = fit.covariance.rows() - static_cast<Eigen::Index>(shaped.size());
  joint_covariance_ = fit.covariance.topLeftCorner(own, own);
  shape_sigmas_.assign(in_use_.size(), 0.0);
  for (std::size_t j = 0; j < shaped.size(); ++j) {
    const auto at = own + static_cast<Eigen::Index>(j);
    shape_sigmas_[shaped[j]] = std::sqrt(std::max(0.0, fit.covariance(at, at)));
  }
}

}  // namespace lvcalib
