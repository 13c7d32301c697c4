// SPDX-License-Identifier: BSD-3-Clause
// The part of EffectSearch that settles shape numbers.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "model/shape_slope.h"
#include "selection/effect_search.h"

namespace lvcalib {
namespace {

constexpr int kTried = 9;            // shapes at a time
constexpr double kPrecision = 1e-3;  // of the bracket

// Neighbours of the place on a grid that is nearest to a value: the grid follows the table, and a
// value that was on it may lie just beside it after the table was made again.
std::pair<double, double> bracket(std::vector<double> grid, double value) {
  std::sort(grid.begin(), grid.end());
  const auto nearest = std::min_element(grid.begin(), grid.end(), [&](double a, double b) {
    return std::abs(a - value) < std::abs(b - value);
  });
  const double low = nearest == grid.begin() ? *nearest : *(nearest - 1);
  const double high = nearest + 1 == grid.end() ? *nearest : *(nearest + 1);
  return {std::min(low, value), std::max(high, value)};
}

// Puts what an effect in use explains back into the residuals of one channel's products.
void take_back(const EffectColumns& columns, const Eigen::VectorXd& values, int effects,
               Eigen::MatrixXd& products) {
  const Eigen::Index residual = products.cols() - 1;
  for (Eigen::Index p = 0; p < values.size(); ++p) {
    const Eigen::Index column = effects + columns.first + p;
    products.col(residual) += values(p) * products.col(column);
    products.row(residual) += values(p) * products.row(column);
  }
}

}  // namespace

double EffectSearch::preferred_shape(const EffectPtr& effect) const {
  const std::vector<double> shapes = shapes_worth_trying(*effect);
  if (shapes.size() == 1) return shapes.front();
  EffectColumnsList columns = own_columns();
  const ColumnSubset subset = own_subset(columns);
  for (const double shape : shapes) columns.add(effect, shape, table());
  const Linearization linear = linearized(model(), columns);
  if (context_.stopped()) return shapes.front();
  const Reference reference = make_reference(linear, subset, variances_, how());
  std::vector<double> gain(shapes.size(), -HUGE_VAL);
  parallel_for(shapes.size(), context_.thread_count(), [&](std::size_t k) {
    if (!context_.stopped())
      gain[k] =
          evaluate_candidate(linear, reference, own_count() + k, options_->tolerance, {.rounds = 3})
              .total_gain();
  });
  return shapes[static_cast<std::size_t>(std::max_element(gain.begin(), gain.end()) -
                                         gain.begin())];
}

std::vector<double> EffectSearch::shape_profile(std::size_t k, const std::vector<double>& shapes,
                                                std::optional<Linearization>& elsewhere) const {
  const EffectInUse& use = in_use_[k];
  EffectColumnsList columns = own_columns();
  for (const double shape : shapes) columns.add(use.effect, shape, table());
  const EffectColumns mine = columns.list()[k];
  ChannelMask acts = kEveryChannel;
  if (elsewhere) {
    for (const Channel channel : kAllChannels) {
      bool& here = acts[static_cast<std::size_t>(channel)];
      here = false;
      for (int p = 0; p < mine.count(); ++p)
        here = here || elsewhere->squares(channel, mine.first + p) > 0.0;
    }
  }
  Linearization linear = linearized(model(), columns, acts);
  std::vector<double> out(shapes.size(), 0.0);
  if (context_.stopped()) return out;
  for (std::size_t s = 0; s < linear.scenes.size(); ++s) {
    SceneProducts& scene = linear.scenes[s];
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (acts[c]) {
        take_back(mine, use.values, scene.layout.size() + 6, scene.products[c]);
      } else {
        scene.products[c] = elsewhere->scenes[s].products[c];
        scene.rows[c] = elsewhere->scenes[s].rows[c];
      }
    }
  }
  parallel_for(shapes.size(), context_.thread_count(), [&](std::size_t j) {
    if (context_.stopped()) return;
    const ColumnSubset subset = own_subset(columns, OtherColumns{k, own_count() + j});
    out[j] = fit_model(linear, subset, variances_, {.rounds = 0}).log_likelihood;
  });
  if (!elsewhere) elsewhere = std::move(linear);
  return out;
}

bool EffectSearch::move_shape(std::size_t k) {
  const std::vector<double> shapes = in_use_[k].effect->shapes(table());
  if (in_use_[k].held || !in_use_[k].effect->has_smooth_shape() || shapes.size() < 2) return false;
  const double before = in_use_[k].shape;
  auto [low, high] = bracket(shapes, before);
  const double precision = kPrecision * (high - low);
  std::optional<Linearization> elsewhere;
  double shape = before;
  // The second time between the neighbours of the best, which may be where it was.
  for (int round = 0; round < 2; ++round) {
    std::vector<double> tried;
    for (int j = 0; j < kTried; ++j) tried.push_back(low + (high - low) * j / (kTried - 1));
    tried.push_back(before);
    const std::vector<double> likelihood = shape_profile(k, tried, elsewhere);
    if (context_.stopped()) return false;
    const auto end = likelihood.end() - 1;
    const auto best = std::max_element(likelihood.begin(), end);
    const bool better = *best > likelihood.back();
    const double step = tried[1] - tried[0];
    if (!better && round == 0) {
      low = std::max(low, before - step);
      high = std::min(high, before + step);
      continue;
    }
    const auto at = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(best - likelihood.begin(), 1, kTried - 2));
    // Where it was is best: the vertex beside it, no other peak.
    if (!better && std::abs(tried[at] - before) > step) return false;
    low = tried[at - 1];
    high = tried[at + 1];
    // The vertex of the parabola through the best and its neighbours.
    const double bend = likelihood[at - 1] - 2.0 * likelihood[at] + likelihood[at + 1];
    const double slope = 0.5 * (likelihood[at + 1] - likelihood[at - 1]);
    shape = best == likelihood.begin() ? tried.front()
            : best == end - 1          ? tried[kTried - 1]
                                       : tried[at] - (bend < 0.0 ? slope / bend : 0.0) * step;
  }
  if (std::abs(shape - before) < precision) return false;
  in_use_[k].shape = shape;
  return true;
}

void EffectSearch::refine_shape(std::size_t k) {
  if (move_shape(k)) refit();
}

// What the likelihood says of other shapes is known to first order, and the table's rows follow the
// shapes in use: both are taken again until the shapes stand.
void EffectSearch::refine_shapes() {
  constexpr int kRounds = 4;       // Two are usual.
  constexpr double kStands = 0.2;  // Of a standard deviation: nothing beside what is known.
  for (int round = 0; round < kRounds && !context_.stopped(); ++round) {
    std::vector<double> before;
    for (const EffectInUse& use : in_use_) before.push_back(use.shape);
    bool moved = false;
    for (std::size_t k = 0; k < in_use_.size() && !context_.stopped(); ++k)
      moved = move_shape(k) || moved;
    if (moved) refit();
    estimate_joint_covariance();
    bool stand = true;
    for (std::size_t k = 0; k < in_use_.size(); ++k)
      stand = stand && std::abs(in_use_[k].shape - before[k]) <= kStands * shape_sigma(k);
    if (stand || round + 1 == kRounds) return;
    remake();
  }
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
  if (!with_slopes_) with_slopes_ = linearized(fitted(), columns);
  if (context_.stopped()) {
    with_slopes_.reset();
    return;
  }
  const ModelFit fit = fit_as_it_stands(*with_slopes_, subset);
  const auto own = fit.covariance.rows() - static_cast<Eigen::Index>(shaped.size());
  joint_covariance_ = fit.covariance.topLeftCorner(own, own);
  shape_sigmas_.assign(in_use_.size(), 0.0);
  for (std::size_t j = 0; j < shaped.size(); ++j) {
    const auto at = own + static_cast<Eigen::Index>(j);
    shape_sigmas_[shaped[j]] = std::sqrt(std::max(0.0, fit.covariance(at, at)));
  }
}

}  // namespace lvcalib
