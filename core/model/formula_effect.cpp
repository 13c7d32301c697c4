// SPDX-License-Identifier: BSD-3-Clause
#include "model/formula_effect.h"

#include <algorithm>
#include <cmath>

#include "base/symmetric.h"
#include "model/covariate_effect.h"
#include "model/formula_expression.h"

namespace lvcalib {
namespace {

constexpr std::size_t kProbes = 200;  // rows on which linearity is tried

class FormulaEffect final : public CovariateEffect {
 public:
  FormulaEffect(EffectInfo info, Channel channel, std::vector<const RowCovariate*> covariates,
                FormulaExpression expression)
      : CovariateEffect(std::move(info), channel, std::move(covariates)),
        expression_(std::move(expression)) {
    info_.physics = "A formula of the user.";
    info_.spec = info_.id;
  }

  void columns(std::span<const double> covariates, double /*shape*/,
               std::span<double> by_parameter) const override {
    expression_.columns(covariates, by_parameter);
  }

  Status bind(const MeasurementTable& table, const UserEffectOptions& options);
  Status bind_without_data(const UserEffectOptions& options) {
    if (Status s = check_linear(probe_rows()); !s) return s;
    std::vector<EffectParameter> out;
    for (const std::string& name : expression_.coefficients())
      out.push_back(user_parameter(name, acts_on(), 1.0, options));
    set_parameters(std::move(out));
    return Done{};
  }

 private:
  [[nodiscard]] Error error(const Message& what, const Message& hint = {}) const {
    return Error::input(Message("the effect '%1' cannot be used: %2", info_.id, what), {}, hint);
  }
  [[nodiscard]] std::vector<std::vector<double>> probe_rows() const;
  [[nodiscard]] Status check_linear(const std::vector<std::vector<double>>& rows) const;
  [[nodiscard]] bool adds_up(const std::vector<double>& row, std::span<const double> columns,
                             const std::vector<double>& coefficients) const;

  FormulaExpression expression_;
};

bool FormulaEffect::adds_up(const std::vector<double>& row, std::span<const double> columns,
                            const std::vector<double>& coefficients) const {
  double sum = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    sum += coefficients[k] * columns[k];
    size += std::abs(coefficients[k] * columns[k]);
  }
  const double value = expression_.evaluate(row, coefficients);
  return std::isfinite(value) && std::abs(value - sum) <= 1e-9 * (size + std::abs(value));
}

// Covariates that stand in for data where there are none yet: what is not linear in a coefficient
// is so wherever it is defined.
std::vector<std::vector<double>> FormulaEffect::probe_rows() const {
  // A formula that is no line in a coefficient shows it at two points; the others are for those
  // that have no value at some.
  constexpr int kTried = 16;
  constexpr double kGolden =
      0.6180339887;  // Its multiples' fractions fill the unit interval evenly.
  std::vector<std::vector<double>> rows;
  std::vector<double> columns(expression_.coefficients().size());
  double at = 0.0;
  for (int r = 0; r < kTried; ++r) {
    std::vector<double> row(covariates().size());
    for (double& value : row) {
      at += kGolden;
      value = at - std::floor(at);
    }
    expression_.columns(row, columns);
    const std::vector<double> none(columns.size(), 0.0);
    const bool finite = std::all_of(columns.begin(), columns.end(),
                                    [](double column) { return std::isfinite(column); });
    if (finite && std::isfinite(expression_.evaluate(row, none))) rows.push_back(std::move(row));
  }
  return rows;
}

// f(0) = 0, f(−2 eₖ) = −2 f(eₖ), and f(c) = Σ cₖ f(eₖ) for one c with all coefficients.
Status FormulaEffect::check_linear(const std::vector<std::vector<double>>& rows) const {
  const auto& names = expression_.coefficients();
  const std::size_t stride = std::max<std::size_t>(1, rows.size() / kProbes);
  std::vector<double> columns(names.size());
  for (std::size_t r = 0; r < rows.size(); r += stride) {
    expression_.columns(rows[r], columns);
    std::vector<double> c(names.size(), 0.0);
    if (expression_.evaluate(rows[r], c) != 0.0) {
      return error(Message("it is not zero when its coefficients are"),
                   Message("multiply every term with a coefficient"));
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      c[k] = -2.0;
      if (!adds_up(rows[r], columns, c)) {
        return error(Message("it is not linear in the coefficient %1", names[k]),
                     Message("write a number in its place, such as the 3 in 'a*sin(3*azimuth)'"));
      }
      c[k] = 0.0;
    }
    for (std::size_t k = 0; k < names.size(); ++k) c[k] = 0.3 + 0.7 * static_cast<double>(k);
    if (!adds_up(rows[r], columns, c)) {
      return error(Message("its coefficients do not act one by one: it is not linear in them"),
                   Message("write a sum of terms with one coefficient each"));
    }
  }
  return Done{};
}

Status FormulaEffect::bind(const MeasurementTable& table, const UserEffectOptions& options) {
  const auto& names = expression_.coefficients();
  const auto sources = covariate_sources(table, acts_on());
  std::vector<std::vector<double>> rows;
  std::vector<double> columns(names.size());
  const auto n = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(n, n);
  std::size_t bad = 0;
  std::string first_bad;
  for (const CovariateSource& source : sources) {
    std::vector<double> at = values_at(table, source);
    expression_.columns(at, columns);
    const Eigen::Map<const Eigen::VectorXd> x(columns.data(), n);
    if (!x.allFinite()) {
      for (std::size_t k = 0; k < at.size() && bad == 0; ++k)
        first_bad +=
            (k == 0 ? "" : ", ") + covariates()[k]->identifier() + " = " + std::to_string(at[k]);
      ++bad;
      continue;
    }
    squares += x * x.transpose();
    rows.push_back(std::move(at));
  }
  if (bad > 0) {
    Message what = Message("it is not a finite number on %1 of %2 rows of the channel %3", bad,
                           sources.size(), word_for(acts_on()));
    if (!first_bad.empty()) what += Message(", first where %1", first_bad);
    return error(what,
                 Message("divisions by zero, roots and logarithms of negative numbers do that"));
  }
  if (Status s = check_linear(rows); !s) return s;
  squares /= std::max<double>(1.0, static_cast<double>(rows.size()));
  const Eigen::VectorXd rms = squares.diagonal().cwiseSqrt();
  std::vector<EffectParameter> parameters;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!(rms(k) > 0.0))
      return error(Message("its coefficient %1 changes nothing on any row",
                           names[static_cast<std::size_t>(k)]));
    parameters.push_back(
        user_parameter(names[static_cast<std::size_t>(k)], acts_on(), rms(k), options));
  }
  const Eigen::MatrixXd correlation =
      rms.cwiseInverse().asDiagonal() * squares * rms.cwiseInverse().asDiagonal();
  const auto axes = axes_of(correlation);
  if (n > 1 && axes.values(0) < 1e-9) {
    std::vector<Message> together;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (std::abs(axes.vectors(k, 0)) > 0.05)
        together.push_back(Message::verbatim(names[static_cast<std::size_t>(k)]));
    }
    return error(
        Message("its coefficients %1 cannot be told apart on these data", all_of(together)),
        Message("leave one of them out"));
  }
  set_parameters(std::move(parameters));
  return Done{};
}

std::vector<std::string> identifiers_of(Channel channel) {
  std::vector<std::string> out;
  for (const RowCovariate& c : row_covariates(channel)) out.push_back(c.identifier());
  return out;
}

}  // namespace

Result<EffectPtr> make_formula_effect(const UserEffectSpec& spec, const MeasurementTable* table,
                                      const UserEffectOptions& options) {
  auto expression = FormulaExpression::parse(spec.body, identifiers_of(spec.channel));
  if (!expression) return expression.error();
  std::vector<const RowCovariate*> covariates;
  for (const std::size_t v : expression->variables())
    covariates.push_back(&row_covariates(spec.channel)[v]);
  auto effect = std::make_shared<FormulaEffect>(user_effect_info(spec, covariates), spec.channel,
                                                covariates, std::move(*expression));
  if (table == nullptr) {
    if (Status s = effect->bind_without_data(options); !s) return s.error();
    return EffectPtr(effect);
  }
  if (Status s = effect->bind(*table, options); !s) return s.error();
  return EffectPtr(effect);
}

}  // namespace lvcalib
