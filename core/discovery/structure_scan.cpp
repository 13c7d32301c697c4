// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/structure_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

#include "base/parallel.h"

namespace lvcalib {
namespace {

constexpr int kSplines = 8;
constexpr int kKnots = kSplines - 3;  // intervals
constexpr int kNuisance = LocalLayout::kFixed;

// Cubic B-splines over quantiles of the covariate; categories have one column each.
class Basis {
 public:
  explicit Basis(const Covariate& covariate) : categories_(covariate.categories) {
    std::vector<float> sorted = covariate.values;
    std::sort(sorted.begin(), sorted.end());
    if (categories_) {
      sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
      labels_ = std::move(sorted);
      return;
    }
    // Equal shares of rows between knots keep every spline supported.
    for (int k = 0; k <= kKnots; ++k) {
      const auto at = static_cast<std::size_t>(static_cast<double>(k) / kKnots *
                                               static_cast<double>(sorted.size() - 1));
      quantiles_.push_back(sorted[at]);
    }
  }

  [[nodiscard]] int size() const {
    return categories_ ? static_cast<int>(labels_.size()) : kSplines;
  }

  // Up to four non-zero columns; returns the first, the values in `out`.
  int evaluate(float x, std::array<double, 4>& out) const {
    if (categories_) {
      out = {1.0, 0.0, 0.0, 0.0};
      return static_cast<int>(std::lower_bound(labels_.begin(), labels_.end(), x) -
                              labels_.begin());
    }
    int interval = 0;
    while (interval < kKnots - 1 && x >= quantiles_[static_cast<std::size_t>(interval) + 1])
      ++interval;
    const double low = quantiles_[static_cast<std::size_t>(interval)];
    const double high = quantiles_[static_cast<std::size_t>(interval) + 1];
    const double t = high > low ? std::clamp((x - low) / (high - low), 0.0, 1.0) : 0.0;
    const double u = 1.0 - t;
    out = {u * u * u / 6.0, (3 * t * t * t - 6 * t * t + 4) / 6.0,
           (3 * u * u * u - 6 * u * u + 4) / 6.0, t * t * t / 6.0};
    return interval;
  }

 private:
  bool categories_;
  std::vector<float> labels_;
  std::vector<float> quantiles_;
};

// Whitened cross products of one scene: curve, nuisance, residual.
struct SceneSums {
  Eigen::MatrixXd curve;           // b × b
  Eigen::MatrixXd curve_nuisance;  // b × 8
  Eigen::MatrixXd nuisance = Eigen::MatrixXd::Zero(kNuisance, kNuisance);
  Eigen::VectorXd curve_residual;
  Eigen::VectorXd nuisance_residual = Eigen::VectorXd::Zero(kNuisance);
  double squares = 0.0;
  double weight = 0.0;
};

std::vector<SceneSums> accumulate(const Covariate& covariate, const Basis& basis,
                                  const ChannelResiduals& residuals, int scenes) {
  std::vector<SceneSums> sums(static_cast<std::size_t>(scenes));
  for (SceneSums& s : sums) {
    s.curve.setZero(basis.size(), basis.size());
    s.curve_nuisance.setZero(basis.size(), kNuisance);
    s.curve_residual.setZero(basis.size());
  }
  std::array<double, 4> b{};
  for (std::size_t k = 0; k < residuals.values.size(); ++k) {
    SceneSums& s = sums[static_cast<std::size_t>(residuals.scene[k])];
    const double w = 1.0 / (residuals.sigma[k] * residuals.sigma[k]);
    const int first = basis.evaluate(covariate.values[k], b);
    const int count = covariate.categories ? 1 : 4;
    for (int i = 0; i < count; ++i) {
      const double wi = w * b[static_cast<std::size_t>(i)];
      s.curve_residual(first + i) += wi * residuals.values[k];
      s.curve_nuisance.row(first + i) += wi * residuals.nuisance[k].transpose();
      for (int j = 0; j < count; ++j)
        s.curve(first + i, first + j) += wi * b[static_cast<std::size_t>(j)];
    }
    s.nuisance.noalias() += w * residuals.nuisance[k] * residuals.nuisance[k].transpose();
    s.nuisance_residual += w * residuals.values[k] * residuals.nuisance[k];
    s.squares += w * residuals.values[k] * residuals.values[k];
    s.weight += w;
  }
  return sums;
}

// Takes a scene's own nuisance out of its sums.
void project(SceneSums& s) {
  for (int c = 0; c < kNuisance; ++c) {
    if (s.nuisance(c, c) <= 0.0) s.nuisance(c, c) = 1.0;
  }
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(s.nuisance);
  const Eigen::MatrixXd x = ldlt.solve(s.curve_nuisance.transpose());
  const Eigen::VectorXd y = ldlt.solve(s.nuisance_residual);
  s.curve -= s.curve_nuisance * x;
  s.curve_residual -= s.curve_nuisance * y;
  s.squares -= s.nuisance_residual.dot(y);
}

}  // namespace

StructureScore structure_score(const Covariate& covariate, Channel channel,
                               const ChannelResiduals& residuals, int scenes) {
  StructureScore out{channel, covariate.name, 0.0, 0.0};
  const Basis basis(covariate);
  std::vector<SceneSums> sums = accumulate(covariate, basis, residuals, scenes);
  Eigen::MatrixXd curve = Eigen::MatrixXd::Zero(basis.size(), basis.size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(basis.size());
  double weight = 0.0;
  for (SceneSums& s : sums) {
    weight += s.weight;
    project(s);
    curve += s.curve;
    gradient += s.curve_residual;
  }
  // Shrinks what few rows support: one row's weight as a prior about zero.
  const double ridge = weight / std::max<double>(1.0, static_cast<double>(residuals.values.size()));
  double before = 0.0;
  double after = 0.0;
  double fitted = 0.0;
  for (const SceneSums& s : sums) {
    Eigen::MatrixXd others = curve - s.curve;
    others.diagonal().array() += ridge;
    const Eigen::VectorXd c = others.ldlt().solve(gradient - s.curve_residual);
    before += s.squares;
    const double drop = 2.0 * c.dot(s.curve_residual) - c.dot(s.curve * c);
    after += s.squares - drop;
    fitted += c.dot(s.curve * c);
  }
  if (!(before > 0.0) || !std::isfinite(after)) return out;
  out.score = 1.0 - after / before;
  out.amplitude =
      weight > 0.0 ? display_factor(channel) * std::sqrt(std::max(0.0, fitted) / weight) : 0.0;
  return out;
}

std::vector<StructureScore> scan_structure(const MeasurementTable& table, const ModelState& state,
                                           const std::vector<EffectInUse>& in_use,
                                           const RunContext& context) {
  const int scenes = static_cast<int>(table.scenes.size());
  std::vector<StructureScore> out;
  for (const Channel channel : kAllChannels) {
    if (table.size(channel) == 0 || context.stopped()) continue;
    const ChannelResiduals residuals = residuals_of(table, state, in_use, channel);
    const auto covariates = covariates_of(table, channel, residuals);
    std::vector<StructureScore> scores(covariates.size());
    parallel_for(covariates.size(), context.thread_count(), [&](std::size_t k) {
      if (!context.stopped())
        scores[k] = structure_score(covariates[k], channel, residuals, scenes);
    });
    out.insert(out.end(), scores.begin(), scores.end());
  }
  std::stable_sort(out.begin(), out.end(), [](const StructureScore& a, const StructureScore& b) {
    return a.score > b.score;
  });
  return out;
}

}  // namespace lvcalib
