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

constexpr std::size_t kMostRows = 40000;  // A wave in them is known to 0.7 % of a row's noise.
constexpr int kWaves = 16;                // wave lengths from two intervals to an eighth of one
constexpr int kSteps = 7;                 // places of a step, at equal shares of the rows

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

// Whitened cross products after each scene's nuisance: all terms' columns, then the residual.
struct FormSums {
  std::vector<Term> terms;
  std::vector<Eigen::Index> first;  // Each term's first column.
  std::vector<double> scale;        // Of each column.
  std::vector<Eigen::MatrixXd> scenes;
  Eigen::MatrixXd total;
  double before = 0.0;  // Squares of the residuals.
  [[nodiscard]] Eigen::Index columns() const { return static_cast<Eigen::Index>(scale.size()); }
};

// Those of all terms that are defined wherever there are rows.
std::vector<Term> defined_terms(const std::vector<float>& values) {
  std::vector<Term> out = terms_for(values);
  std::erase_if(out, [&](const Term& term) {
    return std::any_of(values.begin(), values.end(), [&](float x) {
      const double v = term.value.front()(x);
      return !std::isfinite(v) || std::abs(v) > 1e6;
    });
  });
  return out;
}

// Each column as large as the others.
void scale_columns(const std::vector<float>& values, FormSums& out) {
  for (const Term& term : out.terms) {
    out.first.push_back(out.columns());
    for (const auto& f : term.value) {
      double squares = 0.0;
      for (const float x : values) squares += f(x) * f(x);
      const double rms = std::sqrt(squares / static_cast<double>(values.size()));
      out.scale.push_back(rms > 0.0 ? 1.0 / rms : 0.0);
    }
  }
}

void fill(const FormSums& form, double x, double residual, Eigen::VectorXd& row) {
  Eigen::Index c = 0;
  for (const Term& term : form.terms) {
    for (const auto& f : term.value) {
      row(c) = form.scale[static_cast<std::size_t>(c)] * f(x);
      ++c;
    }
  }
  row(c) = residual;
}

void add_rows(const Covariate& covariate, const ChannelResiduals& residuals, int scenes,
              FormSums& out) {
  const Eigen::Index last = out.columns();
  const Eigen::Index all = last + 1;
  std::vector<Eigen::MatrixXd> cross(static_cast<std::size_t>(scenes));
  std::vector<Eigen::MatrixXd> nuisance(static_cast<std::size_t>(scenes));
  for (auto& m : cross) m.setZero(LocalLayout::kFixed, all);
  for (auto& m : nuisance) m.setZero(LocalLayout::kFixed, LocalLayout::kFixed);
  out.scenes.assign(static_cast<std::size_t>(scenes), Eigen::MatrixXd::Zero(all, all));
  Eigen::VectorXd row(all);
  const std::size_t stride = 1 + residuals.values.size() / kMostRows;
  for (std::size_t k = 0; k < residuals.values.size(); k += stride) {
    const auto s = static_cast<std::size_t>(residuals.scene[k]);
    fill(out, covariate.values[k], residuals.values[k], row);
    row /= residuals.sigma[k];
    const NuisanceRow z = residuals.nuisance[k] / residuals.sigma[k];
    out.scenes[s].selfadjointView<Eigen::Upper>().rankUpdate(row);
    cross[s].noalias() += z * row.transpose();
    nuisance[s].noalias() += z * z.transpose();
  }
  out.total.setZero(all, all);
  for (std::size_t s = 0; s < out.scenes.size(); ++s) {
    Eigen::MatrixXd& m = out.scenes[s];
    m = Eigen::MatrixXd(m.selfadjointView<Eigen::Upper>());
    for (int c = 0; c < LocalLayout::kFixed; ++c) {
      if (nuisance[s](c, c) <= 0.0) nuisance[s](c, c) = 1.0;
    }
    m -= cross[s].transpose() * nuisance[s].ldlt().solve(cross[s]);
    out.total += m;
    out.before += m(last, last);
  }
}

// Fall of each scene's squares when the others predict it.
std::vector<double> drops(const FormSums& form, const std::vector<std::size_t>& set) {
  std::vector<Eigen::Index> at;
  for (const std::size_t t : set) {
    for (std::size_t k = 0; k < form.terms[t].value.size(); ++k)
      at.push_back(form.first[t] + static_cast<Eigen::Index>(k));
  }
  std::vector<double> out;
  if (at.empty()) return std::vector<double>(form.scenes.size(), 0.0);
  for (const Eigen::MatrixXd& scene : form.scenes) {
    Eigen::MatrixXd others = form.total(at, at) - scene(at, at);
    others.diagonal().array() += 1e-6 * (1.0 + others.trace());
    const Eigen::VectorXd c =
        others.ldlt().solve(form.total(at, form.columns()) - scene(at, form.columns()));
    out.push_back(2.0 * c.dot(Eigen::VectorXd(scene(at, form.columns()))) -
                  c.dot(Eigen::MatrixXd(scene(at, at)) * c));
  }
  return out;
}

void keep_better(const FormSums& form, const std::vector<std::size_t>& set,
                 std::vector<std::size_t>& best) {
  // What comes earlier is simpler and stays if the later is no better than rounding of the data.
  constexpr double kBetter = 2.0;
  const double value = total(drops(form, set));
  if (std::isfinite(value) && value > (best.empty() ? 0.0 : total(drops(form, best)) + kBetter))
    best = set;
}

// The best set of at most two terms; the smaller within one standard error.
std::vector<std::size_t> best_set(const FormSums& form) {
  std::vector<std::size_t> best_one;
  std::vector<std::size_t> best_two;
  for (std::size_t a = 0; a < form.terms.size(); ++a) keep_better(form, {a}, best_one);
  for (std::size_t a = 0; a < form.terms.size(); ++a) {
    for (std::size_t b = a + 1; b < form.terms.size(); ++b) keep_better(form, {a, b}, best_two);
  }
  const auto n = static_cast<double>(form.terms.size());
  const auto one = drops(form, best_one);
  if (!is_gain(one) || total(one) < by_chance(n)) best_one.clear();
  if (best_two.empty()) return best_one;
  const auto two = drops(form, best_two);
  std::vector<double> more;
  for (std::size_t s = 0; s < two.size(); ++s)
    more.push_back(two[s] - (best_one.empty() ? 0.0 : one[s]));
  return is_gain(more) && total(more) > by_chance(0.5 * n * (n - 1.0)) ? best_two : best_one;
}

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
  FormSums form;
  form.terms = defined_terms(covariate.values);
  scale_columns(covariate.values, form);
  add_rows(covariate, residuals, scenes, form);
  const auto set = best_set(form);
  if (set.empty()) return {};
  std::vector<std::string> texts;
  for (const std::size_t t : set)
    texts.insert(texts.end(), form.terms[t].text.begin(), form.terms[t].text.end());
  return {as_formula(texts, channel, described->identifier()),
          form.before > 0.0 ? total(drops(form, set)) / form.before : 0.0};
}

void suggest_closed_forms(const MeasurementTable& table, const ModelState& state,
                          const std::vector<EffectInUse>& in_use, std::size_t most,
                          const RunContext& context, std::vector<StructureScore>& scores) {
  const int scenes = static_cast<int>(table.scenes.size());
  for (std::size_t k = 0; k < std::min(most, scores.size()); ++k) {
    if (context.stopped()) return;
    if (!scores[k].second_covariate.empty()) continue;  // formulas of one covariate
    const ChannelResiduals residuals =
        residuals_and_nuisance(table, state, in_use, scores[k].channel);
    for (const Covariate& c : covariates_of(table, scores[k].channel, residuals)) {
      if (c.name != scores[k].covariate) continue;
      const ClosedForm form = closed_form_of(c, scores[k].channel, residuals, scenes);
      scores[k].formula = form.formula;
      scores[k].formula_score = form.score;
    }
  }
}

}  // namespace lvcalib
