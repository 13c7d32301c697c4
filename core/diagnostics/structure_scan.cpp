// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/structure_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>

#include "base/parallel.h"
#include "base/statistics.h"
#include "base/symmetric.h"
#include "diagnostics/structure_basis.h"

namespace lvcalib {
namespace {

constexpr int kCoarse = 8;  // splines of a covariate
constexpr int kFine = 32;   // where rows are many: ripples of several periods over the board
constexpr std::size_t kRowsPerSpline = 50;  // A height is then known to a seventh of a row's noise.
constexpr int kNuisance = LocalLayout::kFixed;
constexpr int kFewNuisance = LocalLayout::kPose;

// One channel's residuals as the shapes see them, in units of their standard deviations. What each
// scene's own pose and levels can do is described by orthonormal columns over its rows, and taken
// out of the residuals: that is the same for every shape.
class OwnRows {
 public:
  using Nuisance = NuisanceRow;

  OwnRows(ChannelResiduals residuals, int scenes) : of_(std::move(residuals)) {
    const auto n = static_cast<std::size_t>(scenes);
    using Products = Eigen::Matrix<double, kNuisance, kNuisance>;
    std::vector<Products> products(n, Products::Zero());
    // In the place of what they are made of: of many rows there is no room for both.
    for (std::size_t k = 0; k < size(); ++k) {
      of_.sigma[k] = 1.0 / of_.sigma[k];
      of_.values[k] *= weight(k);
      of_.nuisance[k] *= weight(k);
      products[scene(k)].noalias() += nuisance(k) * nuisance(k).transpose();
    }
    std::vector<Products> basis;
    for (const Products& p : products) basis.push_back(orthonormal(p));
    few_ = std::all_of(basis.begin(), basis.end(), [](const Products& p) {
      return p.topRows<kNuisance - kFewNuisance>().isZero(0.0);
    });
    std::vector<Nuisance> along(n, Nuisance::Zero());
    for (std::size_t k = 0; k < size(); ++k) {
      of_.nuisance[k] = basis[scene(k)] * nuisance(k);
      along[scene(k)] += value(k) * nuisance(k);
    }
    squares_.assign(n, 0.0);
    weights_.assign(n, 0.0);
    for (std::size_t k = 0; k < size(); ++k) {
      of_.values[k] -= nuisance(k).dot(along[scene(k)]);
      squares_[scene(k)] += value(k) * value(k);
      weights_[scene(k)] += weight(k) * weight(k);
    }
  }

  [[nodiscard]] Channel channel() const { return of_.channel; }
  [[nodiscard]] const std::vector<std::size_t>& rows() const { return of_.row; }
  [[nodiscard]] std::size_t size() const { return of_.values.size(); }
  [[nodiscard]] std::size_t scenes() const { return squares_.size(); }
  [[nodiscard]] std::size_t scene(std::size_t k) const {
    return static_cast<std::size_t>(of_.scene[k]);
  }
  [[nodiscard]] double weight(std::size_t k) const { return of_.sigma[k]; }  // 1/σ
  [[nodiscard]] double value(std::size_t k) const { return of_.values[k]; }
  [[nodiscard]] const Nuisance& nuisance(std::size_t k) const { return of_.nuisance[k]; }
  /// Whether only the last kFewNuisance nuisance columns hold anything, as where levels do not act.
  [[nodiscard]] bool few_nuisances() const { return few_; }
  [[nodiscard]] double squares_of(std::size_t scene) const { return squares_[scene]; }
  [[nodiscard]] double weight_of(std::size_t scene) const { return weights_[scene]; }

 private:
  // Turns nuisance rows into orthonormal ones; directions that the rows do not tell become zero.
  static Eigen::Matrix<double, kNuisance, kNuisance> orthonormal(
      const Eigen::Matrix<double, kNuisance, kNuisance>& products) {
    constexpr double kRounding = 1e-10;
    Nuisance scale;
    for (int c = 0; c < kNuisance; ++c)
      scale(c) = products(c, c) > 0.0 ? 1.0 / std::sqrt(products(c, c)) : 0.0;
    const auto axes = axes_of<Eigen::Dynamic>(scale.asDiagonal() * products * scale.asDiagonal());
    Nuisance share;
    for (int c = 0; c < kNuisance; ++c) {
      const double size = axes.values(c);
      share(c) = size > kRounding ? 1.0 / std::sqrt(size) : 0.0;
    }
    return share.asDiagonal() * axes.vectors.transpose() * scale.asDiagonal();
  }

  ChannelResiduals of_;  // Its residuals and standard deviations as value() and weight().
  std::vector<double> squares_, weights_;  // By scene.
  bool few_ = false;
};

// Products of a shape's columns over one scene's rows, what the scene's own nuisance can do taken
// out.
struct SceneSums {
  Eigen::MatrixXd curve;
  Eigen::VectorXd residual;
};

// Adds a row to the products of the shape's columns with each other (the lower triangle is whole),
// with the residual and with the scene's nuisances.
template <int Run, class Nuisances, class NuisanceSums>
[[gnu::always_inline]] inline void add_row(const BasisRow& b, double weight, double residual,
                                           const Nuisances& nuisances, SceneSums& sums,
                                           NuisanceSums& by_nuisances) {
  using Values = Eigen::Matrix<double, Run, 1>;
  // Columns rise within a row.
  for (std::size_t i = 0; i < static_cast<std::size_t>(b.count); i += Run) {
    const Values own = weight * Values::Map(&b.value[i]);
    const int at = b.column[i];
    sums.residual.template segment<Run>(at) += residual * own;
    by_nuisances.template middleCols<Run>(at).noalias() += nuisances * own.transpose();
    for (std::size_t j = 0; j <= i; j += Run) {
      sums.curve.template block<Run, Run>(at, b.column[j]).noalias() +=
          own * (weight * Values::Map(&b.value[j])).transpose();
    }
  }
}

// Of the last `Nuisances` nuisance columns: those before hold nothing.
template <int Nuisances, class Shape>
std::vector<SceneSums> scene_sums(const Shape& shape, const OwnRows& rows) {
  std::vector<SceneSums> sums(rows.scenes());
  std::vector<Eigen::Matrix<double, Nuisances, Eigen::Dynamic>> nuisance(rows.scenes());
  for (std::size_t s = 0; s < sums.size(); ++s) {
    sums[s].curve.setZero(shape.size(), shape.size());
    sums[s].residual.setZero(shape.size());
    nuisance[s].setZero(Nuisances, shape.size());
  }
  BasisRow b;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t scene = rows.scene(k);
    shape.evaluate(k, b);
    const auto nuisances = rows.nuisance(k).template tail<Nuisances>();
    if (b.run == kSplineRun) {
      add_row<kSplineRun>(b, rows.weight(k), rows.value(k), nuisances, sums[scene],
                          nuisance[scene]);
    } else {
      add_row<1>(b, rows.weight(k), rows.value(k), nuisances, sums[scene], nuisance[scene]);
    }
  }
  for (std::size_t s = 0; s < sums.size(); ++s) {
    sums[s].curve.selfadjointView<Eigen::Lower>().rankUpdate(nuisance[s].transpose(), -1.0);
    sums[s].curve.triangularView<Eigen::StrictlyUpper>() = sums[s].curve.transpose();
  }
  return sums;
}

// Sums of all scenes.
struct AllSums {
  std::vector<SceneSums> scenes;
  Eigen::MatrixXd curve;
  Eigen::VectorXd gradient;
  double weight = 0.0;
};

template <class Shape>
AllSums all_sums(const Shape& shape, const OwnRows& rows) {
  AllSums out;
  out.scenes = rows.few_nuisances() ? scene_sums<kFewNuisance>(shape, rows)
                                    : scene_sums<kNuisance>(shape, rows);
  out.curve.setZero(shape.size(), shape.size());
  out.gradient.setZero(shape.size());
  for (std::size_t s = 0; s < out.scenes.size(); ++s) {
    out.weight += rows.weight_of(s);
    out.curve += out.scenes[s].curve;
    out.gradient += out.scenes[s].residual;
  }
  return out;
}

// What the shape fitted to the other scenes predicts of each, with coefficients shrunk by a ridge.
void predict_scenes(const AllSums& sums, const OwnRows& rows, double ridge, StructureScore& out) {
  out.scene_gain.clear();
  double before = 0.0;
  double after = 0.0;
  double fitted = 0.0;
  for (std::size_t k = 0; k < sums.scenes.size(); ++k) {
    const SceneSums& s = sums.scenes[k];
    Eigen::MatrixXd others = sums.curve - s.curve;
    others.diagonal().array() += ridge;
    const Eigen::VectorXd c = others.ldlt().solve(sums.gradient - s.residual);
    const double size = c.dot(s.curve * c);
    const double drop = 2.0 * c.dot(s.residual) - size;
    before += rows.squares_of(k);
    after += rows.squares_of(k) - drop;
    out.scene_gain.push_back(0.5 * drop);
    fitted += size;
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
double height_of(const Shape& shape, const OwnRows& rows, const AllSums& sums, double ridge) {
  constexpr double kAlmostAll = 0.995;
  if (!shape.kLocal) return 0.0;
  Eigen::MatrixXd curve = sums.curve;
  curve.diagonal().array() += ridge;
  const Eigen::VectorXd c = curve.ldlt().solve(sums.gradient);
  std::vector<double> values(rows.size());
  BasisRow b;
  for (std::size_t k = 0; k < values.size(); ++k) {
    shape.evaluate(k, b);
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.count); ++i)
      values[k] += b.value[i] * c(b.column[i]);
  }
  const double middle = median(values);
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = std::abs(values[k] - middle) * rows.weight(k);
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(kAlmostAll * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

template <class Shape>
void score(const Shape& shape, const OwnRows& rows, StructureScore& out) {
  const AllSums sums = all_sums(shape, rows);
  // Shrinks what few rows support: one row's weight as a prior about zero. Something local leaves
  // most of a surface flat: there stronger priors are tried as well, and scenes held out choose.
  const double one_row = sums.weight / std::max<double>(1.0, static_cast<double>(rows.size()));
  const StructureScore start = out;
  double chosen = 0.0;
  for (const double prior_rows : Shape::kPriorRows) {
    StructureScore tried = start;
    predict_scenes(sums, rows, prior_rows * one_row, tried);
    if (prior_rows > 1.0 && tried.score <= out.score) continue;
    out = tried;
    chosen = prior_rows * one_row;
  }
  out.height = height_of(shape, rows, sums, chosen);
}

const Covariate* find_in(const std::vector<Covariate>& covariates, const std::string& name) {
  const auto at = std::find_if(covariates.begin(), covariates.end(),
                               [&](const Covariate& c) { return c.name == name; });
  return at == covariates.end() ? nullptr : &*at;
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

// A surface over two covariates, of corners one in either direction of the image; nothing where the
// rows are too few for it.
std::optional<StructureScore> surface_score(const Covariate& x, const Covariate& y,
                                            const OwnRows& rows) {
  StructureScore out{rows.channel(), x.name, 0.0, 0.0};
  out.second_covariate = y.name;
  const auto take = [&](const auto& surface, std::size_t rows_per_spline) {
    if (rows.size() < rows_per_spline * static_cast<std::size_t>(surface.size())) return false;
    score(surface, rows, out);
    return true;
  };
  const bool taken = out.channel == Channel::kCorner ? take(ImageSurface(x, y, rows.rows()), 1)
                                                     : take(Surface(x, y), kRowsPerSpline);
  return taken ? std::optional(out) : std::nullopt;
}

// Whether a surface predicts held-out scenes better than either of its covariates alone. One of
// corners must beat every curve: something local in the lens displaces them in both directions of
// the image, which shows in other covariates as well.
bool says_more(const StructureScore& surface, const std::vector<StructureScore>& curves) {
  return std::all_of(curves.begin(), curves.end(), [&](const StructureScore& one) {
    if (one.channel != surface.channel) return true;
    const bool beside = surface.channel == Channel::kCorner || one.covariate == surface.covariate ||
                        one.covariate == surface.second_covariate;
    return !beside || is_better(surface, one);
  });
}

StructureScore score_of(const Covariate& covariate, const OwnRows& rows) {
  StructureScore out{rows.channel(), covariate.name, 0.0, 0.0};
  score(Curve(covariate, kCoarse), rows, out);
  if (covariate.categories || covariate.values.size() < kRowsPerSpline * kFine) return out;
  StructureScore fine = out;
  score(Curve(covariate, kFine), rows, fine);
  return fine.score > out.score ? fine : out;
}

// What one number explains. What a place shows of it is everywhere.
double score_everywhere(const OwnRows& rows) {
  StructureScore out{rows.channel(), {}};
  score(Constant(), rows, out);
  return std::max(0.0, out.score);
}

struct ScannedChannel {
  std::optional<OwnRows> rows;
  std::vector<Covariate> covariates;
  double everywhere = 0.0;
};

// What is scored: a curve over x, or a surface where there is a y.
struct Asked {
  std::size_t channel;
  const Covariate* x;
  const Covariate* y;
};

// Corners have two axes, which no single surface over the board describes.
void add_surfaces(std::size_t channel, const std::vector<Covariate>& covariates,
                  std::vector<Asked>& asked) {
  const auto add = [&](const char* first, const char* second) {
    const Covariate* x = find_in(covariates, first);
    const Covariate* y = find_in(covariates, second);
    if (x != nullptr && y != nullptr) asked.push_back({channel, x, y});
  };
  if (kAllChannels[channel] == Channel::kCorner) return add("image x", "image y");
  for (const auto& [first, second] : kPlaces) add(first, second);
}

}  // namespace

bool StructureScore::is_at_a_place() const {
  if (!second_covariate.empty()) return covariate != "print";
  return covariate == "azimuth" || covariate == "board x" || covariate == "board y";
}

StructureScore place_score(const StructureScore& place, const MeasurementTable& table,
                           ChannelResiduals residuals) {
  StructureScore none{residuals.channel, place.covariate};
  const std::vector<Covariate> covariates = covariates_of(table, residuals.channel, residuals);
  const Covariate* x = find_in(covariates, place.covariate);
  const bool surface = !place.second_covariate.empty();
  const Covariate* y = surface ? find_in(covariates, place.second_covariate) : nullptr;
  if (x == nullptr || (surface && y == nullptr)) return none;
  const OwnRows rows(std::move(residuals), static_cast<int>(table.scenes.size()));
  StructureScore out = surface ? surface_score(*x, *y, rows).value_or(none) : score_of(*x, rows);
  out.everywhere = score_everywhere(rows);
  return out;
}

StructureScan scan_structure(const MeasurementTable& table, EveryResidual residuals,
                             const RunContext& context) {
  std::array<ScannedChannel, kChannels> channels;
  parallel_for(kChannels, context.thread_count(), [&](std::size_t k) {
    ChannelResiduals& r = residuals[k];
    if (r.values.empty() || context.stopped()) return;
    channels[k].covariates = covariates_of(table, r.channel, r);
    channels[k].rows.emplace(std::move(r), static_cast<int>(table.scenes.size()));
    channels[k].everywhere = score_everywhere(*channels[k].rows);
  });
  StructureScan out;
  std::vector<Asked> asked;
  for (std::size_t k = 0; k < kChannels; ++k) {
    for (const Covariate& c : channels[k].covariates) asked.push_back({k, &c, nullptr});
  }
  out.curves.resize(asked.size());
  for (std::size_t k = 0; k < kChannels; ++k) add_surfaces(k, channels[k].covariates, asked);
  std::vector<std::optional<StructureScore>> surfaces(asked.size() - out.curves.size());
  // Surfaces take longest: they go first, so that all threads end together.
  parallel_for(asked.size(), context.thread_count(), [&](std::size_t task) {
    if (context.stopped()) return;
    const std::size_t k = asked.size() - 1 - task;
    const auto& [channel, x, y] = asked[k];
    const OwnRows& rows = *channels[channel].rows;
    if (y == nullptr) {
      out.curves[k] = score_of(*x, rows);
    } else {
      surfaces[k - out.curves.size()] = surface_score(*x, *y, rows);
    }
  });
  for (const auto& surface : surfaces) {
    if (surface && says_more(*surface, out.curves)) out.places.push_back(*surface);
  }
  for (auto* scores : {&out.curves, &out.places}) {
    for (StructureScore& one : *scores)
      one.everywhere = channels[static_cast<std::size_t>(one.channel)].everywhere;
  }
  sort_best_first(out.curves);
  sort_best_first(out.places);
  return out;
}

StructureScan scan_structure(const MeasurementTable& table, const ModelState& state,
                             const std::vector<EffectInUse>& in_use, const RunContext& context) {
  return scan_structure(table, every_residual(table, state, in_use, context), context);
}

void sort_best_first(std::vector<StructureScore>& scores) {
  std::stable_sort(
      scores.begin(), scores.end(),
      [](const StructureScore& a, const StructureScore& b) { return a.score > b.score; });
}

}  // namespace lvcalib
