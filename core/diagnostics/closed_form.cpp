// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics/closed_form.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>

#include <Eigen/Cholesky>

#include "model/row_covariates.h"
#include "solve/fit_inference.h"

namespace lvcalib {
namespace {

constexpr std::size_t kMostRows = 40000;
constexpr int kWaves = 16;  // wave lengths from two intervals to an eighth of one
constexpr int kSteps = 7;   // places of a step, at equal shares of the rows

// One term of a formula: one function, or a sine with its cosine.
struct Term {
  std::vector<std::string> text;  // "%" stands for the covariate
  std::vector<std::function<double(double)>> value;
};

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

std::vector<Term> simple_terms() {
  return {{{"1"}, {[](double) { return 1.0; }}},
          {{"%"}, {[](double x) { return x; }}},
          {{"%^2"}, {[](double x) { return x * x; }}},
          {{"ln(%)"}, {[](double x) { return std::log(x); }}},
          {{"1/%"}, {[](double x) { return 1.0 / x; }}},
          {{"sqrt(%)"}, {[](double x) { return std::sqrt(x); }}},
          {{"tan(%)"}, {[](double x) { return std::tan(x); }}},
          {{"cos(2*%)"}, {[](double x) { return std::cos(2.0 * x); }}}};
}

std::vector<Term> terms_for(std::vector<float> sorted) {
  std::vector<Term> out = simple_terms();
  std::sort(sorted.begin(), sorted.end());
  const double low = sorted.front();
  const double width = sorted.back() - low;
  for (const double share : {0.1, 0.3, 1.0}) {
    const double rate = std::stod(number(1.0 / (share * width)));
    out.push_back(
        {{"exp(-" + number(rate) + "*%)"}, {[rate](double x) { return std::exp(-rate * x); }}});
  }
  for (int k = 1; k <= kWaves; ++k) {
    const double rate = std::stod(number(std::numbers::pi * k / width));
    out.push_back({{"sin(" + number(rate) + "*%)", "cos(" + number(rate) + "*%)"},
                   {[rate](double x) { return std::sin(rate * x); },
                    [rate](double x) { return std::cos(rate * x); }}});
  }
  for (int k = 1; k <= kSteps; ++k) {
    const double at =
        std::stod(number(sorted[static_cast<std::size_t>(k) * sorted.size() / (kSteps + 1)]));
    out.push_back(
        {{"(% > " + number(at) + " ? 1 : 0)"}, {[at](double x) { return x > at ? 1.0 : 0.0; }}});
  }
  return out;
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// What the best of n sets of two columns gains by chance in one case of twenty: squares are in
// units of the noise, and χ² with two degrees of freedom exceeds 2 ln(n/α) with probability α/n.
double by_chance(double sets) {
  constexpr double kFalseAlarm = 0.05;
  return 2.0 * std::log(sets / kFalseAlarm);
}

// Whitened cross products of one scene after its nuisance: all terms' columns, then the residual.
struct SceneCrossSums {
  Eigen::MatrixXd products;
};

class FormSearch {
 public:
  FormSearch(const Covariate& covariate, const ChannelResiduals& residuals, int scenes)
      : terms_(terms_for(covariate.values)) {
    drop_undefined(covariate);
    scale(covariate);
    accumulate(covariate, residuals, scenes);
  }

  // The best set of at most two terms; the smaller within one standard error.
  std::vector<std::size_t> run() {
    std::vector<std::size_t> best_one;
    std::vector<std::size_t> best_two;
    for (std::size_t a = 0; a < terms_.size(); ++a) keep_better({a}, best_one);
    for (std::size_t a = 0; a < terms_.size(); ++a) {
      for (std::size_t b = a + 1; b < terms_.size(); ++b) keep_better({a, b}, best_two);
    }
    const auto n = static_cast<double>(terms_.size());
    const auto one = drops(best_one);
    if (!is_gain(one) || total(one) < by_chance(n)) best_one.clear();
    if (best_two.empty()) return best_one;
    const auto two = drops(best_two);
    std::vector<double> more;
    for (std::size_t s = 0; s < two.size(); ++s)
      more.push_back(two[s] - (best_one.empty() ? 0.0 : one[s]));
    return is_gain(more) && total(more) > by_chance(0.5 * n * (n - 1.0)) ? best_two : best_one;
  }

  [[nodiscard]] double score(const std::vector<std::size_t>& set) const {
    return before_ > 0.0 ? total(drops(set)) / before_ : 0.0;
  }

  [[nodiscard]] std::vector<std::string> texts(const std::vector<std::size_t>& set) const {
    std::vector<std::string> out;
    for (const std::size_t t : set)
      out.insert(out.end(), terms_[t].text.begin(), terms_[t].text.end());
    return out;
  }

 private:
  void drop_undefined(const Covariate& covariate) {
    std::erase_if(terms_, [&](const Term& term) {
      return std::any_of(covariate.values.begin(), covariate.values.end(), [&](float x) {
        const double v = term.value.front()(x);
        return !std::isfinite(v) || std::abs(v) > 1e6;
      });
    });
  }

  void scale(const Covariate& covariate) {
    for (const Term& term : terms_) {
      first_.push_back(columns_);
      for (const auto& f : term.value) {
        double squares = 0.0;
        for (const float x : covariate.values) squares += f(x) * f(x);
        const double rms = std::sqrt(squares / static_cast<double>(covariate.values.size()));
        scale_.push_back(rms > 0.0 ? 1.0 / rms : 0.0);
        ++columns_;
      }
    }
  }

  void accumulate(const Covariate& covariate, const ChannelResiduals& residuals, int scenes) {
    const Eigen::Index all = columns_ + 1;
    std::vector<Eigen::MatrixXd> cross(static_cast<std::size_t>(scenes));
    std::vector<Eigen::MatrixXd> nuisance(static_cast<std::size_t>(scenes));
    for (auto& m : cross) m.setZero(LocalLayout::kFixed, all);
    for (auto& m : nuisance) m.setZero(LocalLayout::kFixed, LocalLayout::kFixed);
    sums_.assign(static_cast<std::size_t>(scenes), {Eigen::MatrixXd::Zero(all, all)});
    Eigen::VectorXd row(all);
    const std::size_t stride = 1 + residuals.values.size() / kMostRows;
    for (std::size_t k = 0; k < residuals.values.size(); k += stride) {
      const auto s = static_cast<std::size_t>(residuals.scene[k]);
      fill(covariate.values[k], residuals.values[k], row);
      row /= residuals.sigma[k];
      const NuisanceRow z = residuals.nuisance[k] / residuals.sigma[k];
      sums_[s].products.selfadjointView<Eigen::Upper>().rankUpdate(row);
      cross[s].noalias() += z * row.transpose();
      nuisance[s].noalias() += z * z.transpose();
    }
    total_.setZero(all, all);
    for (std::size_t s = 0; s < sums_.size(); ++s) {
      Eigen::MatrixXd& m = sums_[s].products;
      m = Eigen::MatrixXd(m.selfadjointView<Eigen::Upper>());
      for (int c = 0; c < LocalLayout::kFixed; ++c) {
        if (nuisance[s](c, c) <= 0.0) nuisance[s](c, c) = 1.0;
      }
      m -= cross[s].transpose() * nuisance[s].ldlt().solve(cross[s]);
      total_ += m;
      before_ += m(columns_, columns_);
    }
  }

  void fill(double x, double residual, Eigen::VectorXd& row) const {
    Eigen::Index c = 0;
    for (const Term& term : terms_) {
      for (const auto& f : term.value) {
        row(c) = scale_[static_cast<std::size_t>(c)] * f(x);
        ++c;
      }
    }
    row(c) = residual;
  }

  // Fall of each scene's squares when the others predict it.
  [[nodiscard]] std::vector<double> drops(const std::vector<std::size_t>& set) const {
    std::vector<Eigen::Index> at;
    for (const std::size_t t : set) {
      for (std::size_t k = 0; k < terms_[t].value.size(); ++k)
        at.push_back(first_[t] + static_cast<Eigen::Index>(k));
    }
    std::vector<double> out;
    if (at.empty()) return std::vector<double>(sums_.size(), 0.0);
    for (const SceneCrossSums& s : sums_) {
      Eigen::MatrixXd others = total_(at, at) - s.products(at, at);
      others.diagonal().array() += 1e-6 * (1.0 + others.trace());
      const Eigen::VectorXd c =
          others.ldlt().solve(total_(at, columns_) - s.products(at, columns_));
      out.push_back(2.0 * c.dot(Eigen::VectorXd(s.products(at, columns_))) -
                    c.dot(Eigen::MatrixXd(s.products(at, at)) * c));
    }
    return out;
  }

  void keep_better(const std::vector<std::size_t>& set, std::vector<std::size_t>& best) const {
    // What comes earlier is simpler and stays if the later is no better than rounding of the data.
    constexpr double kBetter = 2.0;
    const double value = total(drops(set));
    if (std::isfinite(value) && value > (best.empty() ? 0.0 : total(drops(best)) + kBetter))
      best = set;
  }

  std::vector<Term> terms_;
  std::vector<Eigen::Index> first_;
  std::vector<double> scale_;
  Eigen::Index columns_ = 0;
  std::vector<SceneCrossSums> sums_;
  Eigen::MatrixXd total_;
  double before_ = 0.0;
};

// "a*t1+b*t2" with the covariate's identifier in place.
std::string as_formula(const std::vector<std::string>& texts, Channel channel,
                       const std::string& identifier) {
  std::string out = std::string("formula:") + name_of(channel) + ":";
  char coefficient = 'a';
  for (std::string text : texts) {
    for (std::size_t at = text.find('%'); at != std::string::npos;
         at = text.find('%', at + identifier.size()))
      text.replace(at, 1, identifier);
    out += (coefficient == 'a' ? "" : "+") + std::string(1, coefficient);
    if (text != "1") out += "*" + text;
    ++coefficient;
  }
  return out;
}

}  // namespace

ClosedForm closed_form_of(const Covariate& covariate, Channel channel,
                          const ChannelResiduals& residuals, int scenes) {
  if (covariate.categories || covariate.values.empty()) return {};
  const RowCovariate* described = find_covariate(channel, covariate.name);
  if (described == nullptr) return {};
  FormSearch search(covariate, residuals, scenes);
  const auto set = search.run();
  if (set.empty()) return {};
  return {as_formula(search.texts(set), channel, described->identifier()), search.score(set)};
}

void suggest_closed_forms(const MeasurementTable& table, const ModelState& state,
                          const std::vector<EffectInUse>& in_use, std::size_t most,
                          const RunContext& context, std::vector<StructureScore>& scores) {
  const int scenes = static_cast<int>(table.scenes.size());
  for (std::size_t k = 0; k < std::min(most, scores.size()); ++k) {
    if (context.stopped()) return;
    if (!scores[k].second_covariate.empty()) continue;  // formulas of one covariate
    const ChannelResiduals residuals = residuals_of(table, state, in_use, scores[k].channel);
    for (const Covariate& c : covariates_of(table, scores[k].channel, residuals)) {
      if (c.name != scores[k].covariate) continue;
      const ClosedForm form = closed_form_of(c, scores[k].channel, residuals, scenes);
      scores[k].formula = form.formula;
      scores[k].formula_score = form.score;
    }
  }
}

}  // namespace lvcalib
