// SPDX-License-Identifier: BSD-3-Clause
#include "model/mixed_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace lvcalib {
namespace {

// Columns of a scene's products that a subset uses.
struct Indices {
  int local = 0;
  std::vector<int> global;  // extrinsic, then the subset
  int residual = 0;
};

Indices indices_of(const SceneProducts& scene, const ColumnSubset& subset) {
  Indices out;
  out.local = scene.layout.size();
  for (int k = 0; k < 6; ++k) out.global.push_back(out.local + k);
  for (const int c : subset.columns) out.global.push_back(out.local + 6 + c);
  out.residual = static_cast<int>(scene.products[0].cols()) - 1;
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

Blocks blocks_of(const SceneProducts& scene, const Indices& at,
                 const std::array<double, kChannels>& channel) {
  const auto g = static_cast<Eigen::Index>(at.global.size());
  Blocks out;
  out.local.setZero(at.local, at.local);
  out.cross.setZero(at.local, g);
  out.global.setZero(g, g);
  out.local_gradient.setZero(at.local);
  out.global_gradient.setZero(g);
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (scene.rows[c] == 0) continue;
    const double w = 1.0 / channel[c];
    const Eigen::MatrixXd& m = scene.products[c];
    out.local += w * m.topLeftCorner(at.local, at.local);
    out.local_gradient += w * m.col(at.residual).head(at.local);
    for (Eigen::Index j = 0; j < g; ++j) {
      const int column = at.global[static_cast<std::size_t>(j)];
      out.cross.col(j) += w * m.col(column).head(at.local);
      out.global_gradient(j) += w * m(column, at.residual);
      for (Eigen::Index i = 0; i < g; ++i)
        out.global(i, j) += w * m(at.global[static_cast<std::size_t>(i)], column);
    }
    out.squares += w * m(at.residual, at.residual);
  }
  return out;
}

// The scene's own unknowns with what is believed of them beforehand.
void add_priors(const LocalLayout& layout, const ModelVariances& variances, Blocks& b) {
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    const auto [first, count] = layout.columns_of(static_cast<VarianceGroup>(k));
    for (int c = first; c < first + count; ++c) b.local(c, c) += 1.0 / variances.group[k];
  }
  // What this scene does not measure (levels without intensity) must not make it singular.
  for (int c = 0; c < LocalLayout::kFixed; ++c) {
    if (b.local(c, c) <= 0.0) b.local(c, c) = 1.0;
  }
}

// A channel's products on the joint unknowns of a scene, times a vector or traced with a matrix.
double squares_of(const Eigen::MatrixXd& m, const Indices& at, const Eigen::VectorXd& local,
                  const Eigen::VectorXd& global) {
  Eigen::VectorXd full = Eigen::VectorXd::Zero(m.cols());
  full.head(at.local) = local;
  for (std::size_t k = 0; k < at.global.size(); ++k)
    full(at.global[k]) = global(static_cast<Eigen::Index>(k));
  full(at.residual) = -1.0;
  return std::max(0.0, full.dot(m.selfadjointView<Eigen::Upper>() * full));
}

class Fitter {
 public:
  Fitter(const Linearization& linear, const ColumnSubset& subset, const ModelVariances& start,
         const MixedModelOptions& options)
      : linear_(linear), options_(options) {
    fit_.subset = subset;
    fit_.variances = start;
    for (const SceneProducts& scene : linear.scenes) indices_.push_back(indices_of(scene, subset));
    const auto g = static_cast<Eigen::Index>(6 + subset.columns.size());
    fit_.prior.information.setZero(g, g);
    fit_.prior.gradient.setZero(g);
    for (std::size_t k = 0; k < subset.columns.size(); ++k) {
      const double weight = 1.0 / (subset.prior_sigma[k] * subset.prior_sigma[k]);
      const auto i = static_cast<Eigen::Index>(6 + k);
      fit_.prior.information(i, i) = weight;
      fit_.prior.gradient(i) = weight * subset.prior_mean[k];
      fit_.prior.constant +=
          0.5 * std::log(weight) - 0.5 * weight * subset.prior_mean[k] * subset.prior_mean[k];
    }
    for (const auto& [first, count] : subset.zero_sums) hold_sum(first, count);
  }

  ModelFit run() {
    solve();
    for (int round = 0; round < options_.rounds; ++round) {
      const double change = update_variances();
      solve();
      if (change < options_.tolerance) break;
    }
    return std::move(fit_);
  }

 private:
  // A measurement of the sum, a thousand times as precise as what is believable of one of them.
  void hold_sum(std::size_t first, std::size_t count) {
    constexpr double kPrecise = 1e-3;
    const ColumnSubset& subset = fit_.subset;
    const double weight = std::pow(kPrecise * subset.prior_sigma[first], -2.0);
    const auto at = static_cast<Eigen::Index>(6 + first);
    const auto n = static_cast<Eigen::Index>(count);
    double mean = 0.0;
    for (std::size_t k = 0; k < count; ++k) mean += subset.prior_mean[first + k];
    fit_.prior.information.block(at, at, n, n).array() += weight;
    fit_.prior.gradient.segment(at, n).array() += weight * mean;
    fit_.prior.constant += 0.5 * std::log(weight) - 0.5 * weight * mean * mean;
  }

  void solve() {
    fit_.scenes.clear();
    factors_.clear();
    blocks_.clear();
    Eigen::MatrixXd information = fit_.prior.information;
    Eigen::VectorXd gradient = fit_.prior.gradient;
    double constant = fit_.prior.constant;
    for (std::size_t s = 0; s < linear_.scenes.size(); ++s) {
      eliminate(s);
      information += fit_.scenes.back().information;
      gradient += fit_.scenes.back().gradient;
      constant += fit_.scenes.back().constant;
    }
    const Eigen::LDLT<Eigen::MatrixXd> ldlt(information);
    fit_.solution = ldlt.solve(gradient);
    fit_.covariance = ldlt.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols()));
    fit_.log_likelihood = constant + 0.5 * gradient.dot(fit_.solution) -
                          0.5 * ldlt.vectorD().cwiseAbs().array().max(1e-300).log().sum();
    fit_.local.clear();
    for (std::size_t s = 0; s < linear_.scenes.size(); ++s) {
      fit_.local.push_back(
          factors_[s].solve(blocks_[s].local_gradient - blocks_[s].cross * fit_.solution));
    }
  }

  void eliminate(std::size_t s) {
    const SceneProducts& scene = linear_.scenes[s];
    Blocks b = blocks_of(scene, indices_[s], fit_.variances.channel);
    double log_prior = 0.0;
    add_priors(scene.layout, fit_.variances, b);
    for (std::size_t k = 0; k < kVarianceGroups; ++k) {
      const int count = scene.layout.columns_of(static_cast<VarianceGroup>(k)).second;
      log_prior -= 0.5 * count * std::log(fit_.variances.group[k]);
    }
    Eigen::LLT<Eigen::MatrixXd> llt(b.local);
    SceneTerm term;
    const Eigen::MatrixXd x = llt.solve(b.cross);
    const Eigen::VectorXd y = llt.solve(b.local_gradient);
    term.information = b.global - b.cross.transpose() * x;
    term.gradient = b.global_gradient - b.cross.transpose() * y;
    term.constant = -0.5 * (b.squares - b.local_gradient.dot(y)) + log_prior -
                    llt.matrixL().toDenseMatrix().diagonal().array().log().sum();
    for (std::size_t c = 0; c < kChannels; ++c)
      term.constant -= 0.5 * scene.rows[c] * std::log(fit_.variances.channel[c]);
    fit_.scenes.push_back(std::move(term));
    factors_.push_back(std::move(llt));
    blocks_.push_back(std::move(b));
  }

  // Largest move of a log-variance.
  double update_variances() {
    std::array<double, kVarianceGroups> squares{};
    std::array<double, kVarianceGroups> determined{};
    std::array<double, kChannels> residual{};
    std::array<double, kChannels> freedom{};
    for (std::size_t s = 0; s < linear_.scenes.size(); ++s)
      collect(s, squares, determined, residual, freedom);
    double change = 0.0;
    const auto move = [&change](double& value, double next) {
      change = std::max(change, std::abs(std::log(next / value)));
      value = next;
    };
    for (std::size_t k = 0; k < kVarianceGroups; ++k) {
      double& value = fit_.variances.group[k];
      if (value <= kAbsentVariance[k]) continue;
      // At most a hundredfold at a time, either way.
      const double next = squares[k] / std::max(determined[k], 1e-3);
      move(value, std::max(kAbsentVariance[k], std::clamp(next, 0.01 * value, 100.0 * value)));
    }
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (freedom[c] < 2.0) continue;
      move(fit_.variances.channel[c], std::clamp(residual[c] / freedom[c], 0.05, 1e4));
    }
    return change;
  }

  void collect(std::size_t s, std::array<double, kVarianceGroups>& squares,
               std::array<double, kVarianceGroups>& determined,
               std::array<double, kChannels>& residual, std::array<double, kChannels>& freedom) {
    const SceneProducts& scene = linear_.scenes[s];
    const Indices& at = indices_[s];
    const Eigen::MatrixXd x = factors_[s].solve(blocks_[s].cross);
    const Eigen::MatrixXd cross = -x * fit_.covariance;  // local × global covariance
    Eigen::MatrixXd local = factors_[s].solve(Eigen::MatrixXd::Identity(at.local, at.local));
    local.noalias() -= cross * x.transpose();
    for (std::size_t k = 0; k < kVarianceGroups; ++k) {
      const auto [first, count] = scene.layout.columns_of(static_cast<VarianceGroup>(k));
      if (count == 0) continue;
      squares[k] += fit_.local[s].segment(first, count).squaredNorm();
      determined[k] +=
          count - local.diagonal().segment(first, count).sum() / fit_.variances.group[k];
    }
    for (std::size_t c = 0; c < kChannels; ++c) {
      if (scene.rows[c] == 0) continue;
      const Eigen::MatrixXd& m = scene.products[c];
      residual[c] += squares_of(m, at, fit_.local[s], fit_.solution);
      double used = local.cwiseProduct(m.topLeftCorner(at.local, at.local)).sum();
      const auto g = static_cast<Eigen::Index>(at.global.size());
      for (Eigen::Index j = 0; j < g; ++j) {
        const int column = at.global[static_cast<std::size_t>(j)];
        used += 2.0 * cross.col(j).dot(m.col(column).head(at.local));
        for (Eigen::Index i = 0; i < g; ++i)
          used += fit_.covariance(i, j) * m(at.global[static_cast<std::size_t>(i)], column);
      }
      freedom[c] += scene.rows[c] - used / fit_.variances.channel[c];
    }
  }

  const Linearization& linear_;
  const MixedModelOptions& options_;
  ModelFit fit_;
  std::vector<Indices> indices_;
  std::vector<Blocks> blocks_;
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors_;
};

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
  return Fitter(linear, subset, start, options).run();
}

double misfit(const Linearization& linear, const ColumnSubset& subset,
              const ModelVariances& variances) {
  double out = 0.0;
  for (std::size_t k = 0; k < subset.columns.size(); ++k)
    out += std::pow(subset.prior_mean[k] / subset.prior_sigma[k], 2);
  for (const SceneProducts& scene : linear.scenes) {
    Blocks b = blocks_of(scene, indices_of(scene, subset), variances.channel);
    add_priors(scene.layout, variances, b);
    const Eigen::Index random = b.local.rows() - LocalLayout::kFixed;
    const Eigen::VectorXd gradient = b.local_gradient.tail(random);
    out +=
        b.squares - gradient.dot(b.local.bottomRightCorner(random, random).llt().solve(gradient));
  }
  return out;
}

SceneTerm scene_term(const SceneProducts& products, const ColumnSubset& subset,
                     const ModelVariances& variances) {
  Blocks b = blocks_of(products, indices_of(products, subset), variances.channel);
  add_priors(products.layout, variances, b);
  SceneTerm out;
  const Eigen::LLT<Eigen::MatrixXd> llt(b.local);
  out.information = b.global - b.cross.transpose() * llt.solve(b.cross);
  out.gradient = b.global_gradient - b.cross.transpose() * llt.solve(b.local_gradient);
  return out;
}

std::array<GroupScore, kVarianceGroups> group_scores(const Linearization& linear,
                                                     const ModelFit& fit) {
  std::array<GroupScore, kVarianceGroups> out{};
  std::array<double, kVarianceGroups> second{};
  for (std::size_t s = 0; s < linear.scenes.size(); ++s) {
    const SceneProducts& scene = linear.scenes[s];
    const Indices at = indices_of(scene, fit.subset);
    Blocks b = blocks_of(scene, at, fit.variances.channel);
    add_priors(scene.layout, fit.variances, b);
    const Eigen::LLT<Eigen::MatrixXd> llt(b.local);
    const Eigen::MatrixXd x = llt.solve(b.cross);
    for (std::size_t k = 0; k < kVarianceGroups; ++k) {
      const double v = fit.variances.group[k];
      const auto [first, count] = scene.layout.columns_of(static_cast<VarianceGroup>(k));
      if (v > kAbsentVariance[k] || count == 0) continue;
      // What the rows tell of these: I − C/v, C their covariance.
      const Eigen::MatrixXd own =
          llt.solve(Eigen::MatrixXd::Identity(at.local, at.local).middleCols(first, count))
              .middleRows(first, count);
      const Eigen::MatrixXd rows = x.middleRows(first, count);
      const Eigen::MatrixXd told = Eigen::MatrixXd::Identity(count, count) -
                                   (own + rows * fit.covariance * rows.transpose()) / v;
      out[k].squares += fit.local[s].segment(first, count).squaredNorm();
      out[k].determined += told.trace();
      second[k] += told.squaredNorm();
    }
  }
  for (std::size_t k = 0; k < kVarianceGroups; ++k) {
    if (second[k] > 0.0) out[k].effective = out[k].determined * out[k].determined / second[k];
  }
  return out;
}

double predictive_log_density(const ModelFit& fit, std::size_t scene) {
  Eigen::MatrixXd information = fit.prior.information;
  Eigen::VectorXd gradient = fit.prior.gradient;
  for (std::size_t s = 0; s < fit.scenes.size(); ++s) {
    if (s == scene) continue;
    information += fit.scenes[s].information;
    gradient += fit.scenes[s].gradient;
  }
  const double others = log_integral(information, gradient);
  information += fit.scenes[scene].information;
  gradient += fit.scenes[scene].gradient;
  return fit.scenes[scene].constant + log_integral(information, gradient) - others;
}

Eigen::VectorXd solution_without(const ModelFit& fit, std::size_t scene) {
  Eigen::MatrixXd information = fit.prior.information;
  Eigen::VectorXd gradient = fit.prior.gradient;
  for (std::size_t s = 0; s < fit.scenes.size(); ++s) {
    if (s == scene) continue;
    information += fit.scenes[s].information;
    gradient += fit.scenes[s].gradient;
  }
  return information.ldlt().solve(gradient);
}

std::array<double, kChannels> squares_at(const Linearization& linear, std::size_t scene,
                                         const ColumnSubset& subset, const Eigen::VectorXd& globals,
                                         const ModelVariances& variances) {
  const SceneProducts& products = linear.scenes[scene];
  const Indices at = indices_of(products, subset);
  const Blocks b = blocks_of(products, at, variances.channel);
  constexpr int kFixed = LocalLayout::kFixed;
  Eigen::MatrixXd fixed = b.local.topLeftCorner<kFixed, kFixed>();
  for (int c = 0; c < kFixed; ++c) {
    if (fixed(c, c) <= 0.0) fixed(c, c) = 1.0;
  }
  Eigen::VectorXd local = Eigen::VectorXd::Zero(at.local);
  local.head<kFixed>() =
      fixed.llt().solve(b.local_gradient.head<kFixed>() - b.cross.topRows<kFixed>() * globals);
  std::array<double, kChannels> out{};
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (products.rows[c] > 0) out[c] = squares_of(products.products[c], at, local, globals);
  }
  return out;
}

}  // namespace lvcalib
