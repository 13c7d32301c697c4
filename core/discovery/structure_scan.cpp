// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/structure_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include "base/parallel.h"
#include "base/statistics.h"
#include "discovery/candidate.h"
#include "discovery/structure_basis.h"

namespace lvcalib {
namespace {

constexpr int kCoarse = 8;  // splines of a covariate
constexpr int kFine = 32;   // where rows are many: ripples of several periods over the board
constexpr std::size_t kRowsPerSpline = 50;
constexpr int kNuisance = LocalLayout::kFixed;

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

template <class Shape>
std::vector<SceneSums> accumulate(const Shape& shape, const ChannelResiduals& residuals,
                                  int scenes) {
  std::vector<SceneSums> sums(static_cast<std::size_t>(scenes));
  for (SceneSums& s : sums) {
    s.curve.setZero(shape.size(), shape.size());
    s.curve_nuisance.setZero(shape.size(), kNuisance);
    s.curve_residual.setZero(shape.size());
  }
  BasisRow b;
  for (std::size_t k = 0; k < residuals.values.size(); ++k) {
    SceneSums& s = sums[static_cast<std::size_t>(residuals.scene[k])];
    const double w = 1.0 / (residuals.sigma[k] * residuals.sigma[k]);
    shape.evaluate(k, b);
    const auto count = static_cast<std::size_t>(b.count);
    for (std::size_t i = 0; i < count; ++i) {
      const double wi = w * b.value[i];
      s.curve_residual(b.column[i]) += wi * residuals.values[k];
      s.curve_nuisance.row(b.column[i]) += wi * residuals.nuisance[k].transpose();
      for (std::size_t j = 0; j < count; ++j) s.curve(b.column[i], b.column[j]) += wi * b.value[j];
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

// Sums of all scenes, their own nuisance taken out.
struct AllSums {
  std::vector<SceneSums> scenes;
  Eigen::MatrixXd curve;
  Eigen::VectorXd gradient;
  double weight = 0.0;
};

template <class Shape>
AllSums all_sums(const Shape& shape, const ChannelResiduals& residuals, int scenes) {
  AllSums out;
  out.scenes = accumulate(shape, residuals, scenes);
  out.curve.setZero(shape.size(), shape.size());
  out.gradient.setZero(shape.size());
  for (SceneSums& s : out.scenes) {
    out.weight += s.weight;
    project(s);
    out.curve += s.curve;
    out.gradient += s.curve_residual;
  }
  return out;
}

// What the shape fitted to the other scenes predicts of each, with coefficients shrunk by a ridge.
void predict_scenes(const AllSums& sums, double ridge, StructureScore& out) {
  out.scene_gain.clear();
  double before = 0.0;
  double after = 0.0;
  double fitted = 0.0;
  for (const SceneSums& s : sums.scenes) {
    Eigen::MatrixXd others = sums.curve - s.curve;
    others.diagonal().array() += ridge;
    const Eigen::VectorXd c = others.ldlt().solve(sums.gradient - s.curve_residual);
    before += s.squares;
    const double drop = 2.0 * c.dot(s.curve_residual) - c.dot(s.curve * c);
    after += s.squares - drop;
    out.scene_gain.push_back(0.5 * drop);
    fitted += c.dot(s.curve * c);
  }
  if (!(before > 0.0) || !std::isfinite(after)) return;
  out.score = 1.0 - after / before;
  out.amplitude = sums.weight > 0.0
                      ? display_factor(out.channel) * std::sqrt(std::max(0.0, fitted) / sums.weight)
                      : 0.0;
}

// Largest deviation (all but half a percent of the rows) of the fitted shape from its median, in
// standard deviations of one row.
template <class Shape>
double height_of(const Shape& shape, const ChannelResiduals& residuals, const AllSums& sums,
                 double ridge) {
  constexpr double kAlmostAll = 0.995;
  if (!shape.kLocal) return 0.0;
  Eigen::MatrixXd curve = sums.curve;
  curve.diagonal().array() += ridge;
  const Eigen::VectorXd c = curve.ldlt().solve(sums.gradient);
  std::vector<double> values(residuals.values.size());
  BasisRow b;
  for (std::size_t k = 0; k < values.size(); ++k) {
    shape.evaluate(k, b);
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.count); ++i)
      values[k] += b.value[i] * c(b.column[i]);
  }
  const double middle = median(values);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = std::abs(values[k] - middle) / residuals.sigma[k];
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(kAlmostAll * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

template <class Shape>
void score(const Shape& shape, const ChannelResiduals& residuals, int scenes, StructureScore& out) {
  const AllSums sums = all_sums(shape, residuals, scenes);
  // Shrinks what few rows support: one row's weight as a prior about zero. Something local leaves
  // most of a surface flat: there stronger priors are tried as well, and scenes held out choose.
  const double one_row =
      sums.weight / std::max<double>(1.0, static_cast<double>(residuals.values.size()));
  const StructureScore start = out;
  for (const double rows : Shape::kPriorRows) {
    StructureScore tried = start;
    predict_scenes(sums, rows * one_row, tried);
    if (rows > 1.0 && tried.score <= out.score) continue;
    out = tried;
    out.height = height_of(shape, residuals, sums, rows * one_row);
  }
}

const Covariate* find_in(const std::vector<Covariate>& covariates, const std::string& name) {
  const auto at = std::find_if(covariates.begin(), covariates.end(),
                               [&](const Covariate& c) { return c.name == name; });
  return at == covariates.end() ? nullptr : &*at;
}

void sort_best_first(std::vector<StructureScore>& scores) {
  std::stable_sort(
      scores.begin(), scores.end(),
      [](const StructureScore& a, const StructureScore& b) { return a.score > b.score; });
}

// Places in two dimensions where something local may sit, on the board or in the field of view; and
// what comes near or at a slant on one print only, as of a receiver that saturates.
constexpr std::array<std::pair<const char*, const char*>, 4> kPlaces{
    {{"board x", "board y"}, {"azimuth", "elevation"}, {"print", "range"}, {"print", "incidence"}}};

// By more than one standard error over scenes: two covariates are not named where one will do.
bool is_better(const StructureScore& surface, const StructureScore& curve) {
  if (surface.score <= curve.score) return false;
  if (surface.scene_gain.size() != curve.scene_gain.size()) return true;
  std::vector<double> more;
  for (std::size_t s = 0; s < surface.scene_gain.size(); ++s)
    more.push_back(surface.scene_gain[s] - curve.scene_gain[s]);
  return is_gain(more);
}

// Surfaces that predict held-out scenes better than either of their covariates alone.
std::vector<StructureScore> surfaces(const std::vector<Covariate>& covariates,
                                     const std::vector<StructureScore>& alone,
                                     const ChannelResiduals& residuals, int scenes) {
  std::vector<StructureScore> out;
  for (const auto& [first, second] : kPlaces) {
    const Covariate* x = find_in(covariates, first);
    const Covariate* y = find_in(covariates, second);
    if (x == nullptr || y == nullptr) continue;
    const Surface surface(*x, *y);
    if (x->values.size() < kRowsPerSpline * static_cast<std::size_t>(surface.size())) continue;
    StructureScore s{residuals.channel, x->name, 0.0, 0.0};
    s.second_covariate = y->name;
    score(surface, residuals, scenes, s);
    const auto worse = [&](const StructureScore& one) {
      return (one.covariate != first && one.covariate != second) || is_better(s, one);
    };
    if (std::all_of(alone.begin(), alone.end(), worse)) out.push_back(s);
  }
  return out;
}

// Something local in the lens displaces corners in both directions of the image.
std::vector<StructureScore> image_surface(const std::vector<Covariate>& covariates,
                                          const std::vector<StructureScore>& alone,
                                          const ChannelResiduals& residuals, int scenes) {
  const Covariate* x = find_in(covariates, "image x");
  const Covariate* y = find_in(covariates, "image y");
  if (x == nullptr || y == nullptr) return {};
  const ImageSurface surface(*x, *y, residuals.row);
  if (x->values.size() < static_cast<std::size_t>(surface.size())) return {};
  StructureScore s{residuals.channel, x->name, 0.0, 0.0};
  s.second_covariate = y->name;
  score(surface, residuals, scenes, s);
  const bool better = std::all_of(alone.begin(), alone.end(),
                                  [&](const StructureScore& one) { return is_better(s, one); });
  return better ? std::vector{s} : std::vector<StructureScore>{};
}

// Chance lets the best of so many covariates gain ln(tried/α) at most; and structure of one scene
// alone, as of a warped board, is no gain in most.
bool scenes_agree(const StructureScore& score, std::size_t tried, const DiscoveryOptions& options) {
  const double total = std::accumulate(score.scene_gain.begin(), score.scene_gain.end(), 0.0);
  if (!(total > std::log(static_cast<double>(tried) / options.false_alarm))) return false;
  const auto speaking =
      std::count_if(score.scene_gain.begin(), score.scene_gain.end(),
                    [&](double gain) { return std::abs(gain) >= options.speaking_nats; });
  const auto improved = std::count_if(score.scene_gain.begin(), score.scene_gain.end(),
                                      [&](double gain) { return gain >= options.speaking_nats; });
  return is_gain(score.scene_gain) &&
         static_cast<double>(improved) >= options.scenes_improved * static_cast<double>(speaking);
}

}  // namespace

StructureScore structure_score(const Covariate& covariate, const ChannelResiduals& residuals,
                               int scenes) {
  StructureScore out{residuals.channel, covariate.name, 0.0, 0.0};
  score(Curve(covariate, kCoarse), residuals, scenes, out);
  if (covariate.categories || covariate.values.size() < kRowsPerSpline * kFine) return out;
  StructureScore fine = out;
  score(Curve(covariate, kFine), residuals, scenes, fine);
  return fine.score > out.score ? fine : out;
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
      if (!context.stopped()) scores[k] = structure_score(covariates[k], residuals, scenes);
    });
    out.insert(out.end(), scores.begin(), scores.end());
  }
  sort_best_first(out);
  return out;
}

std::vector<StructureScore> scan_places(const MeasurementTable& table, const ModelState& state,
                                        const std::vector<EffectInUse>& in_use,
                                        const std::vector<StructureScore>& alone,
                                        const RunContext& context) {
  const int scenes = static_cast<int>(table.scenes.size());
  std::vector<std::vector<StructureScore>> found(kAllChannels.size());
  parallel_for(kAllChannels.size(), context.thread_count(), [&](std::size_t k) {
    const Channel channel = kAllChannels[k];
    if (table.size(channel) == 0 || context.stopped()) return;
    const ChannelResiduals residuals = residuals_of(table, state, in_use, channel);
    std::vector<StructureScore> same;
    for (const StructureScore& s : alone) {
      if (s.channel == channel) same.push_back(s);
    }
    // Corners have two axes, which no single surface over the board describes.
    const auto covariates = covariates_of(table, channel, residuals);
    found[k] = channel == Channel::kCorner ? image_surface(covariates, same, residuals, scenes)
                                           : surfaces(covariates, same, residuals, scenes);
  });
  std::vector<StructureScore> out;
  for (const auto& one : found) out.insert(out.end(), one.begin(), one.end());
  sort_best_first(out);
  return out;
}

bool is_notable(const StructureScore& score, std::size_t tried, const DiscoveryOptions& options) {
  if (score.score >= options.min_structure) return true;
  // What is local has a small share of the variance by nature: a bump is judged by its height.
  const bool local = score.channel == Channel::kRange && score.height >= options.min_height;
  return (score.score >= options.min_sure_structure || local) &&
         scenes_agree(score, tried, options);
}

std::vector<StructureScore> notable_of(std::vector<StructureScore> scores,
                                       const DiscoveryOptions& options) {
  const std::size_t tried = scores.size();
  std::erase_if(scores, [&](const StructureScore& s) { return !is_notable(s, tried, options); });
  sort_best_first(scores);
  return scores;
}

std::vector<StructureScore> notable_structure(const MeasurementTable& table,
                                              const ModelState& state,
                                              const std::vector<EffectInUse>& in_use,
                                              const DiscoveryOptions& options,
                                              const RunContext& context) {
  std::vector<StructureScore> out = scan_structure(table, state, in_use, context);
  const auto places = scan_places(table, state, in_use, out, context);
  out.insert(out.end(), places.begin(), places.end());
  return notable_of(std::move(out), options);
}

}  // namespace lvcalib
