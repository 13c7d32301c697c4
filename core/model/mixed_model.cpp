// SPDX-License-Identifier: BSD-3-Clause
#include "model/mixed_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "base/parallel.h"

namespace lvcalib {
namespace {

// A scene that was not taken: its channels weigh by what all have.
constexpr auto kPlanned = static_cast<std::size_t>(-1);

bool moves_board(std::size_t group) {
  return std::find(kBoardMotions.begin(), kBoardMotions.end(), static_cast<VarianceGroup>(group)) !=
         kBoardMotions.end();
}

// Which of a scene's own unknowns take part.
enum class Locals {
  kFixed,    // Pose and levels,
  kPresent,  // and the random effects whose variance is not held absent: the others stay zero,
  kAll,      // or all of them.
};

// Columns of a scene's products that take part: the scene's own unknowns, the extrinsic, the
// subset, the residual.
struct Columns {
  std::vector<int> joint;
  Eigen::Index locals = 0;
  Eigen::Index globals = 0;
  // Where each group of random effects stands among the unknowns; no columns if it is left out.
  std::array<std::pair<Eigen::Index, Eigen::Index>, kVarianceGroups> groups{};
};

Columns columns_of(const SceneProducts& scene, const ColumnSubset& subset,
                   const ModelVariances& variances, Locals locals) {
  Columns out;
  for (int c = 0; c < LocalLayout::kFixed; ++c) out.joint.push_back(c);
  for (std::size_t k = 0; k < kVarianceGroups && locals != Locals::kFixed; ++k) {
    if (locals == Locals::kPresent && variances.group[k] <= kAbsentVariance[k]) continue;
    const auto [first, count] = scene.layout.columns_of(static_cast<VarianceGroup>(k));
    out.groups[k] = {static_cast<Eigen::Index>(out.joint.size()), count};
    for (int c = first; c < first + count; ++c) out.joint.push_back(c);
  }
  out.locals = static_cast<Eigen::Index>(out.joint.size());
  out.globals = static_cast<Eigen::Index>(6 + subset.columns.size());
  const int extrinsic = scene.layout.size();
  for (int k = 0; k < 6; ++k) out.joint.push_back(extrinsic + k);
  for (const int c : subset.columns) out.joint.push_back(extrinsic + 6 + c);
  out.joint.push_back(static_cast<int>(scene.products[0].cols()) - 1);
  return out;
}

// Products of the columns that take part, per channel; empty where a channel has no rows.
using JointProducts = std::array<Eigen::MatrixXd, kChannels>;
JointProducts gather(const SceneProducts& scene, const Columns& at) {
  JointProducts out;
  const auto size = static_cast<Eigen::Index>(at.joint.size());
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (scene.rows[c] == 0) continue;
    out[c].resize(size, size);
    for (Eigen::Index j = 0; j < size; ++j) {
      const auto column = scene.products[c].col(at.joint[static_cast<std::size_t>(j)]);
      for (Eigen::Index i = 0; i < size; ++i)
        out[c](i, j) = column(at.joint[static_cast<std::size_t>(i)]);
    }
  }
  return out;
}

// Normal equations of one scene, split into local and global unknowns.
struct Blocks {
  Eigen::MatrixXd local;
  Eigen::MatrixXd cross;  // local × global
  Eigen::MatrixXd global;
  Eigen::VectorXd local_gradient;
  Eigen::VectorXd global_gradient;
  double squares = 0.0;
};

// With what is believed of the scene's own unknowns beforehand.
Blocks blocks_of(const JointProducts& products, const Columns& at, const ModelVariances& variances,
                 std::size_t scene) {
  const ChannelVariances& channel = variances.channel_of(scene);
  const auto size = static_cast<Eigen::Index>(at.joint.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (products[c].size() > 0) sum += 1.0 / channel[c] * products[c];
  }
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    const auto [first, count] = at.groups[k];
    sum.diagonal().segment(first, count).array() += 1.0 / variances.group[k];
  }
  // What this scene does not measure (levels without intensity) must not make it singular.
  for (int c = 0; c < LocalLayout::kFixed; ++c) {
    if (sum(c, c) <= 0.0) sum(c, c) = 1.0;
  }
  const Eigen::Index n = at.locals;
  const Eigen::Index g = at.globals;
  return {sum.topLeftCorner(n, n),   sum.block(0, n, n, g),           sum.block(n, n, g, g),
          sum.col(size - 1).head(n), sum.col(size - 1).segment(n, g), sum(size - 1, size - 1)};
}

// A channel's squared residuals at given unknowns.
double squares_of(const Eigen::MatrixXd& products, const Eigen::VectorXd& local,
                  const Eigen::VectorXd& global) {
  Eigen::VectorXd full(products.rows());
  full << local, global, -1.0;
  return std::max(0.0, full.dot(products * full));
}

// What a fit reads of one scene, whatever the variances.
struct GatheredScene {
  Columns columns;
  JointProducts products;
  std::array<int, kChannels> rows;
};

std::vector<GatheredScene> gather_scenes(const Linearization& linear, const ColumnSubset& subset,
                                         const ModelVariances& variances, int threads) {
  std::vector<GatheredScene> out(linear.scenes.size());
  parallel_for(out.size(), threads, [&](std::size_t s) {
    const SceneProducts& scene = linear.scenes[s];
    const Columns columns = columns_of(scene, subset, variances, Locals::kPresent);
    out[s] = {columns, gather(scene, columns), scene.rows};
  });
  return out;
}

// A measurement of the sum, a thousand times as precise as what is believable of one of them.
void hold_sum(const ColumnSubset& subset, std::size_t first, std::size_t count, SceneTerm& prior) {
  constexpr double kPrecise = 1e-3;
  const double weight = std::pow(kPrecise * subset.prior_sigma[first], -2.0);
  const auto at = static_cast<Eigen::Index>(6 + first);
  const auto n = static_cast<Eigen::Index>(count);
  double mean = 0.0;
  for (std::size_t k = 0; k < count; ++k) mean += subset.prior_mean[first + k];
  prior.information.block(at, at, n, n).array() += weight;
  prior.gradient.segment(at, n).array() += weight * mean;
  prior.constant += 0.5 * std::log(weight) - 0.5 * weight * mean * mean;
}

// What is believed of the extrinsic and the effects beforehand.
SceneTerm prior_of(const ColumnSubset& subset) {
  SceneTerm prior;
  const auto g = static_cast<Eigen::Index>(6 + subset.columns.size());
  prior.information.setZero(g, g);
  prior.gradient.setZero(g);
  for (std::size_t k = 0; k < subset.columns.size(); ++k) {
    const double weight = 1.0 / (subset.prior_sigma[k] * subset.prior_sigma[k]);
    const auto i = static_cast<Eigen::Index>(6 + k);
    prior.information(i, i) = weight;
    prior.gradient(i) = weight * subset.prior_mean[k];
    prior.constant +=
        0.5 * std::log(weight) - 0.5 * weight * subset.prior_mean[k] * subset.prior_mean[k];
  }
  for (const auto& [first, count] : subset.zero_sums) hold_sum(subset, first, count, prior);
  return prior;
}

// A scene at given variances, its own unknowns eliminated from its term.
struct Eliminated {
  SceneTerm term;
  Blocks blocks;
  Eigen::LLT<Eigen::MatrixXd> factor;  // Of the local block.
  Eigen::MatrixXd by_globals;          // Solved for the cross block.
};

Eliminated eliminate(const GatheredScene& scene, const ModelVariances& variances, std::size_t s) {
  Blocks b = blocks_of(scene.products, scene.columns, variances, s);
  double log_prior = 0.0;
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    log_prior -=
        0.5 * static_cast<double>(scene.columns.groups[k].second) * std::log(variances.group[k]);
  }
  Eigen::LLT<Eigen::MatrixXd> llt(b.local);
  SceneTerm term;
  Eigen::MatrixXd x = llt.solve(b.cross);
  const Eigen::VectorXd y = llt.solve(b.local_gradient);
  term.information = b.global - b.cross.transpose() * x;
  term.gradient = b.global_gradient - b.cross.transpose() * y;
  term.constant = -0.5 * (b.squares - b.local_gradient.dot(y)) + log_prior -
                  llt.matrixL().toDenseMatrix().diagonal().array().log().sum();
  for (std::size_t c = 0; c < kChannels; ++c)
    term.constant -= 0.5 * scene.rows[c] * std::log(variances.channel_of(s)[c]);
  return {std::move(term), std::move(b), std::move(llt), std::move(x)};
}

// Solves for everything linear at the variances in `fit`. Returns the scenes as they were
// eliminated.
std::vector<Eliminated> solve(const std::vector<GatheredScene>& scenes, int threads,
                              ModelFit& fit) {
  fit.scenes.clear();
  std::vector<Eliminated> out(scenes.size());
  parallel_for(scenes.size(), threads,
               [&](std::size_t s) { out[s] = eliminate(scenes[s], fit.variances, s); });
  Eigen::MatrixXd information = fit.prior.information;
  Eigen::VectorXd gradient = fit.prior.gradient;
  double constant = fit.prior.constant;
  for (Eliminated& scene : out) {
    fit.scenes.push_back(std::move(scene.term));
    information += fit.scenes.back().information;
    gradient += fit.scenes.back().gradient;
    constant += fit.scenes.back().constant;
  }
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(information);
  fit.solution = ldlt.solve(gradient);
  fit.covariance = ldlt.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
  fit.log_likelihood = constant + 0.5 * gradient.dot(fit.solution) -
                       0.5 * ldlt.vectorD().cwiseAbs().array().max(1e-300).log().sum();
  fit.local.clear();
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    fit.local.push_back(
        out[s].factor.solve(out[s].blocks.local_gradient - out[s].blocks.cross * fit.solution));
  }
  return out;
}

// What variances are estimated from: squares of the random effects and how many of them the rows
// determine; squares of the residuals and their degrees of freedom.
struct VarianceSums {
  std::array<double, kVarianceGroups> squares{};
  std::array<double, kVarianceGroups> determined{};
  std::array<double, kChannels> residual{};
  std::array<double, kChannels> freedom{};
  void add(const VarianceSums& other) {
    const auto add_to = [](auto& to, const auto& from) {
      for (std::size_t k = 0; k < to.size(); ++k) to[k] += from[k];
    };
    add_to(squares, other.squares);
    add_to(determined, other.determined);
    add_to(residual, other.residual);
    add_to(freedom, other.freedom);
  }
};

VarianceSums sums_of(const GatheredScene& scene, const Eliminated& eliminated, const ModelFit& fit,
                     std::size_t s) {
  VarianceSums sums;
  const Columns& at = scene.columns;
  const Eigen::Index n = at.locals;
  const Eigen::Index g = at.globals;
  // Covariance of local and global unknowns together.
  const Eigen::MatrixXd& x = eliminated.by_globals;
  Eigen::MatrixXd covariance(n + g, n + g);
  covariance.topRightCorner(n, g).noalias() = -x * fit.covariance;
  covariance.bottomLeftCorner(g, n) = covariance.topRightCorner(n, g).transpose();
  covariance.bottomRightCorner(g, g) = fit.covariance;
  covariance.topLeftCorner(n, n) = eliminated.factor.solve(Eigen::MatrixXd::Identity(n, n));
  covariance.topLeftCorner(n, n).noalias() -= covariance.topRightCorner(n, g) * x.transpose();
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    const auto [first, count] = at.groups[k];
    if (count == 0) continue;
    sums.squares[k] += fit.local[s].segment(first, count).squaredNorm();
    sums.determined[k] +=
        static_cast<double>(count) -
        covariance.diagonal().segment(first, count).sum() / fit.variances.group[k];
  }
  for (std::size_t c = 0; c < kChannels; ++c) {
    const Eigen::MatrixXd& m = scene.products[c];
    if (m.size() == 0) continue;
    sums.residual[c] += squares_of(m, fit.local[s], fit.solution);
    const double used = covariance.cwiseProduct(m.topLeftCorner(n + g, n + g)).sum();
    sums.freedom[c] += scene.rows[c] - used / fit.variances.channel_of(s)[c];
  }
  return sums;
}

// Returns the largest move of a log-variance.
double update_variances(const VarianceSums& sums, Estimated estimated, ModelVariances& variances) {
  double change = 0.0;
  const auto move = [&change](double& value, double next) {
    change = std::max(change, std::abs(std::log(next / value)));
    value = next;
  };
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    double& value = variances.group[k];
    if (value <= kAbsentVariance[k]) continue;
    if (estimated == Estimated::kBoards && !moves_board(k)) continue;
    // At most a hundredfold at a time, either way.
    const double next = sums.squares[k] / std::max(sums.determined[k], 1e-3);
    move(value, std::max(kAbsentVariance[k], std::clamp(next, 0.01 * value, 100.0 * value)));
  }
  const bool channels = estimated == Estimated::kAll && variances.scene_channel.empty();
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (!channels || sums.freedom[c] < 2.0) continue;
    move(variances.channel[c], std::clamp(sums.residual[c] / sums.freedom[c], 0.05, 1e4));
  }
  return change;
}

ModelFit fit_at_start(const ColumnSubset& subset, const ModelVariances& variances) {
  ModelFit fit;
  fit.subset = subset;
  fit.variances = variances;
  fit.prior = prior_of(subset);
  return fit;
}

// What each scene's rows scatter by, correlation of neighbours included, per channel: a scene
// with few of them takes what all have.
std::vector<ChannelVariances> scene_variances(const Linearization& linear,
                                              const ColumnSubset& subset,
                                              const ModelVariances& variances, int threads) {
  constexpr double kFewest = 20.0;  // A variance from fewer is known to a third at best, √(2/n).
  const std::vector<GatheredScene> scenes = gather_scenes(linear, subset, variances, threads);
  ModelFit fit = fit_at_start(subset, variances);
  const std::vector<Eliminated> eliminated = solve(scenes, threads, fit);
  std::vector<ChannelVariances> out(scenes.size(), variances.channel);
  parallel_for(scenes.size(), threads, [&](std::size_t s) {
    const VarianceSums sums = sums_of(scenes[s], eliminated[s], fit, s);
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (sums.freedom[c] >= kFewest)
        out[s][c] = std::clamp(sums.residual[c] / sums.freedom[c], 0.05, 1e4);
      out[s][c] *= linear.scenes[s].inflation[c];
    }
  });
  return out;
}

// What the gradient of the globals scatters by motions of the whole board that have no weight.
Eigen::MatrixXd board_spread(const Linearization& linear, std::size_t scene,
                             const ColumnSubset& subset, const ModelVariances& variances) {
  const Columns at = columns_of(linear.scenes[scene], subset, variances, Locals::kPresent);
  const Blocks b = blocks_of(gather(linear.scenes[scene], at), at, variances, scene);
  std::vector<Eigen::Index> kept;
  std::vector<std::pair<Eigen::Index, double>> boards;  // Column and variance.
  for (Eigen::Index i = 0; i < LocalLayout::kFixed; ++i) kept.push_back(i);
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    const bool moves = moves_board(k);
    const auto [first, count] = at.groups[k];
    for (Eigen::Index i = first; i < first + count; ++i) {
      if (moves) {
        boards.emplace_back(i, variances.group[k]);
      } else {
        kept.push_back(i);
      }
    }
  }
  const Eigen::MatrixXd cross = b.cross(kept, Eigen::all);
  const Eigen::MatrixXd x = b.local(kept, kept).llt().solve(cross);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(at.globals, at.globals);
  for (const auto& [i, variance] : boards) {
    const Eigen::VectorXd column = b.local.col(i);
    const Eigen::VectorXd by = b.cross.row(i).transpose() - x.transpose() * column(kept);
    out += variance * by * by.transpose();
  }
  return out;
}

// ½hᵀH⁻¹h − ½ log|H|: the log of the integral over the unknowns.
double log_integral(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient) {
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(information);
  return 0.5 * gradient.dot(ldlt.solve(gradient)) -
         0.5 * ldlt.vectorD().cwiseAbs().array().max(1e-300).log().sum();
}

}  // namespace

void append_columns(const EffectColumns& columns, const Eigen::VectorXd* in_use,
                    ColumnSubset& subset) {
  std::size_t run = subset.columns.size();
  for (const std::size_t count : columns.zero_sums) {
    subset.zero_sums.emplace_back(run, count);
    run += count;
  }
  for (int k = 0; k < columns.count(); ++k) {
    subset.columns.push_back(columns.first + k);
    subset.prior_sigma.push_back(columns.parameters[static_cast<std::size_t>(k)].prior_sigma);
    subset.prior_mean.push_back(in_use != nullptr ? -(*in_use)(k) : 0.0);
  }
}

ModelFit fit_model(const Linearization& linear, const ColumnSubset& subset,
                   const ModelVariances& start, const MixedModelOptions& options) {
  const int threads = options.threads;
  const std::vector<GatheredScene> scenes = gather_scenes(linear, subset, start, threads);
  ModelFit fit = fit_at_start(subset, start);
  std::vector<Eliminated> eliminated = solve(scenes, threads, fit);
  for (int round = 0; round < options.rounds; ++round) {
    std::vector<VarianceSums> parts(scenes.size());
    parallel_for(scenes.size(), threads,
                 [&](std::size_t s) { parts[s] = sums_of(scenes[s], eliminated[s], fit, s); });
    VarianceSums sums;
    for (const VarianceSums& part : parts) sums.add(part);
    const double change = update_variances(sums, options.estimated, fit.variances);
    eliminated = solve(scenes, threads, fit);
    if (change < options.tolerance) break;
  }
  return fit;
}

bool moves_boards(const ModelVariances& variances) {
  return std::any_of(kBoardMotions.begin(), kBoardMotions.end(), [&](VarianceGroup group) {
    const auto k = static_cast<std::size_t>(group);
    return variances.group[k] > kAbsentVariance[k];
  });
}

StatedVariances stated_variances(const Linearization& linear, const ColumnSubset& subset,
                                 const ModelVariances& variances, int threads) {
  StatedVariances out{variances, variances};
  out.weights.scene_channel = scene_variances(linear, subset, variances, threads);
  for (const VarianceGroup group : kBoardMotions) {
    const auto k = static_cast<std::size_t>(group);
    out.weights.group[k] = kAbsentVariance[k];
  }
  out.weights = fit_model(linear, subset, out.weights, {.threads = threads}).variances;
  out.motion = out.weights;
  for (const VarianceGroup group : kBoardMotions) {
    const auto k = static_cast<std::size_t>(group);
    out.motion.group[k] = variances.group[k];
  }
  if (moves_boards(variances)) {
    out.motion =
        fit_model(linear, subset, out.motion, {.estimated = Estimated::kBoards, .threads = threads})
            .variances;
  }
  return out;
}

ModelFit fit_stated(const Linearization& linear, const ColumnSubset& subset,
                    const StatedVariances& variances, int threads) {
  ModelFit fit = fit_model(linear, subset, variances.weights, {.rounds = 0, .threads = threads});
  if (!moves_boards(variances.motion)) return fit;
  parallel_for(fit.scenes.size(), threads, [&](std::size_t s) {
    fit.scenes[s].spread = board_spread(linear, s, subset, variances.motion);
  });
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(fit.covariance.rows(), fit.covariance.cols());
  for (const SceneTerm& scene : fit.scenes) spread += scene.spread;
  fit.covariance += (fit.covariance * spread * fit.covariance).eval();
  return fit;
}

Linearization stepped(Linearization linear, const ModelFit& fit) {
  for (std::size_t s = 0; s < linear.scenes.size(); ++s) {
    const Eigen::Index extrinsic = linear.scenes[s].layout.size();
    for (Eigen::MatrixXd& m : linear.scenes[s].products) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(m.rows());
      step.head<LocalLayout::kFixed>() = fit.local[s].head<LocalLayout::kFixed>();
      step.segment<6>(extrinsic) = fit.solution.head<6>();
      for (std::size_t k = 0; k < fit.subset.columns.size(); ++k) {
        step(extrinsic + 6 + fit.subset.columns[k]) =
            fit.solution(6 + static_cast<Eigen::Index>(k));
      }
      const Eigen::Index residual = m.cols() - 1;
      m.col(residual) -= m * step;
      m.row(residual) -= step.transpose() * m;
    }
  }
  return linear;
}

double misfit(const Linearization& linear, const ColumnSubset& subset,
              const ModelVariances& variances, int threads) {
  std::vector<double> scenes(linear.scenes.size());
  parallel_for(scenes.size(), threads, [&](std::size_t s) {
    const Columns at = columns_of(linear.scenes[s], subset, variances, Locals::kPresent);
    const Blocks b = blocks_of(gather(linear.scenes[s], at), at, variances, s);
    const Eigen::Index random = b.local.rows() - LocalLayout::kFixed;
    const Eigen::VectorXd gradient = b.local_gradient.tail(random);
    scenes[s] =
        b.squares - gradient.dot(b.local.bottomRightCorner(random, random).llt().solve(gradient));
  });
  double out = 0.0;
  for (std::size_t k = 0; k < subset.columns.size(); ++k)
    out += std::pow(subset.prior_mean[k] / subset.prior_sigma[k], 2);
  for (const double scene : scenes) out += scene;
  return out;
}

SceneTerm scene_term(const SceneProducts& products, const ColumnSubset& subset,
                     const ModelVariances& variances) {
  const Columns at = columns_of(products, subset, variances, Locals::kPresent);
  const Blocks b = blocks_of(gather(products, at), at, variances, kPlanned);
  SceneTerm out;
  const Eigen::LLT<Eigen::MatrixXd> llt(b.local);
  out.information = b.global - b.cross.transpose() * llt.solve(b.cross);
  out.gradient = b.global_gradient - b.cross.transpose() * llt.solve(b.local_gradient);
  return out;
}

std::array<GroupScore, kVarianceGroups> group_scores(const Linearization& linear,
                                                     const ModelFit& fit, int threads) {
  // Of each scene; `effective`: the sum that all scenes' is made of.
  std::vector<std::array<GroupScore, kVarianceGroups>> scores(linear.scenes.size());
  parallel_for(scores.size(), threads, [&](std::size_t s) {
    const SceneProducts& scene = linear.scenes[s];
    const Columns at = columns_of(scene, fit.subset, fit.variances, Locals::kAll);
    const Blocks b = blocks_of(gather(scene, at), at, fit.variances, s);
    const Eigen::LLT<Eigen::MatrixXd> llt(b.local);
    const Eigen::MatrixXd x = llt.solve(b.cross);
    const Eigen::VectorXd local = llt.solve(b.local_gradient - b.cross * fit.solution);
    for (std::size_t k = 0; k < kVarianceGroups; ++k) {
      const double v = fit.variances.group[k];
      const auto [first, count] = at.groups[k];
      if (v > kAbsentVariance[k] || count == 0) continue;
      // What the rows tell of these: I − C/v, C their covariance.
      const Eigen::MatrixXd own =
          llt.solve(Eigen::MatrixXd::Identity(at.locals, at.locals).middleCols(first, count))
              .middleRows(first, count);
      const Eigen::MatrixXd rows = x.middleRows(first, count);
      const Eigen::MatrixXd told = Eigen::MatrixXd::Identity(count, count) -
                                   (own + rows * fit.covariance * rows.transpose()) / v;
      scores[s][k] = {local.segment(first, count).squaredNorm(), told.trace(), told.squaredNorm()};
    }
  });
  std::array<GroupScore, kVarianceGroups> out{};
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    double second = 0.0;
    for (const auto& scene : scores) {
      out[k].squares += scene[k].squares;
      out[k].determined += scene[k].determined;
      second += scene[k].effective;
    }
    if (second > 0.0) out[k].effective = out[k].determined * out[k].determined / second;
  }
  return out;
}

namespace {

// What the prior and all scenes but one say.
SceneTerm without(const ModelFit& fit, std::size_t scene) {
  SceneTerm out;
  out.information = fit.prior.information;
  out.gradient = fit.prior.gradient;
  for (std::size_t s = 0; s < fit.scenes.size(); ++s) {
    if (s == scene) continue;
    out.information += fit.scenes[s].information;
    out.gradient += fit.scenes[s].gradient;
  }
  return out;
}

}  // namespace

double predictive_log_density(const ModelFit& fit, std::size_t scene) {
  const SceneTerm& own = fit.scenes[scene];
  const SceneTerm others = without(fit, scene);
  const double with =
      log_integral(others.information + own.information, others.gradient + own.gradient);
  return own.constant + with - log_integral(others.information, others.gradient);
}

Eigen::VectorXd solution_without(const ModelFit& fit, std::size_t scene) {
  const SceneTerm others = without(fit, scene);
  return others.information.ldlt().solve(others.gradient);
}

std::array<double, kChannels> squares_at(const Linearization& linear, std::size_t scene,
                                         const ColumnSubset& subset, const Eigen::VectorXd& globals,
                                         const ModelVariances& variances) {
  const SceneProducts& products = linear.scenes[scene];
  const Columns at = columns_of(products, subset, variances, Locals::kFixed);
  const JointProducts joint = gather(products, at);
  const Blocks b = blocks_of(joint, at, variances, scene);
  const Eigen::VectorXd local = b.local.llt().solve(b.local_gradient - b.cross * globals);
  std::array<double, kChannels> out{};
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (joint[c].size() > 0) out[c] = squares_of(joint[c], local, globals);
  }
  return out;
}

}  // namespace lvcalib
