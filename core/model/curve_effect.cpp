// SPDX-License-Identifier: BSD-3-Clause
#include "model/curve_effect.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/covariate_effect.h"

namespace lvcalib {
namespace {

class CurveEffect final : public CovariateEffect, public CurveView {
 public:
  CurveEffect(EffectInfo info, Channel channel, std::vector<const RowCovariate*> covariates,
              CurveBasis basis, const UserEffectOptions& options)
      : CovariateEffect(std::move(info), channel, std::move(covariates)),
        basis_(std::move(basis)),
        believable_(options.believable[static_cast<std::size_t>(channel)]),
        size_of_interest_(options.size_of_interest[static_cast<std::size_t>(channel)]) {
    info_.physics = "A smooth curve that the user asked for; no physics stands behind it.";
    std::vector<EffectParameter> parameters;
    for (int k = 0; k < basis_.columns(); ++k)
      parameters.push_back(user_parameter("w" + std::to_string(k + 1), channel, 1.0, options));
    CovariateEffect::set_parameters(std::move(parameters));
  }

  // From stiff to loose, four to one apart.
  [[nodiscard]] std::vector<double> shapes(const MeasurementTable&) const override {
    std::vector<double> out;
    for (double size = 0.25 * size_of_interest_; size < 2.0 * believable_; size *= 4.0)
      out.push_back(size);
    return out;
  }
  [[nodiscard]] std::string shape_name() const override { return "roughness (SI)"; }
  [[nodiscard]] bool has_smooth_shape() const override { return false; }

  void columns(std::span<const double> covariates, double shape,
               std::span<double> by_parameter) const override {
    basis_.evaluate(covariates, by_parameter);
    // The weights of the bent part have the prior of everything else; the column says how large
    // it may be.
    const double scale = shape / believable_;
    for (auto k = static_cast<std::size_t>(basis_.free_columns()); k < by_parameter.size(); ++k)
      by_parameter[k] *= scale;
  }

  [[nodiscard]] const CurveBasis& basis() const override { return basis_; }
  [[nodiscard]] Channel channel() const override { return acts_on(); }
  [[nodiscard]] std::vector<std::string> covariate_names() const override {
    std::vector<std::string> out;
    for (const RowCovariate* c : covariates()) out.emplace_back(c->name);
    return out;
  }
  [[nodiscard]] std::vector<std::string> covariate_units() const override {
    std::vector<std::string> out;
    for (const RowCovariate* c : covariates()) out.emplace_back(c->unit);
    return out;
  }
  void columns_at(std::span<const double> at, double shape,
                  std::span<double> by_parameter) const override {
    columns(at, shape, by_parameter);
  }

 private:
  CurveBasis basis_;
  double believable_;
  double size_of_interest_;
};

Error error(const UserEffectSpec& spec, const Message& what) {
  return Error::input(Message("the effect '%1' cannot be used: %2", spec.id, what));
}

// The interval, or the labels, that the table's rows take.
Result<CurveAxis> axis_of(const UserEffectSpec& spec, const RowCovariate& covariate,
                          const MeasurementTable& table, const UserEffectOptions& options) {
  CurveAxis axis;
  std::vector<double> values;
  for (const CovariateSource& source : covariate_sources(table, spec.channel)) {
    values.push_back(covariate.value(table, source));
    if (!std::isfinite(values.back()))
      return error(spec, Message("%1 is not a finite number on some rows", covariate.name));
  }
  std::sort(values.begin(), values.end());
  if (values.empty()) return error(spec, Message("these data have no rows of its channel"));
  if (!(values.back() > values.front()))
    return error(spec, Message("%1 is the same on all rows", covariate.name));
  axis.low = values.front();
  axis.high = values.back();
  if (!covariate.categories) return axis;
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (static_cast<int>(values.size()) > options.most_labels) {
    return error(spec, Message("%1 has %2 different labels, expected at most %3", covariate.name,
                               values.size(), options.most_labels));
  }
  axis.labels = std::move(values);
  return axis;
}

std::string axis_text(const RowCovariate& covariate, const CurveAxis& axis) {
  const auto number = [](double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", v);
    return std::string(text);
  };
  std::string out = covariate.identifier() + "[";
  if (!axis.categories()) return out + number(axis.low) + ".." + number(axis.high) + "]";
  for (std::size_t k = 0; k < axis.labels.size(); ++k)
    out += (k == 0 ? "" : "|") + number(axis.labels[k]);
  return out + "]";
}

}  // namespace

const CurveView* as_curve(const Effect& effect) {
  return dynamic_cast<const CurveView*>(&effect);
}

Result<EffectPtr> make_curve_effect(const UserEffectSpec& spec, const MeasurementTable* table,
                                    const UserEffectOptions& options) {
  std::vector<const RowCovariate*> covariates;
  std::vector<CurveAxis> axes = spec.axes;
  std::string body;
  for (std::size_t k = 0; k < spec.covariates.size(); ++k) {
    const RowCovariate* covariate = find_covariate(spec.channel, spec.covariates[k]);
    covariates.push_back(covariate);
    const bool open = !axes[k].categories() && !(axes[k].high > axes[k].low);
    if (open && table == nullptr) {
      return Error::usage(
          Message("the effect '%1' lacks the interval of %2, expected '%3[low..high]'", spec.id,
                  covariate->name, covariate->identifier()));
    }
    if (open) {
      if (!has_covariate(*table, *covariate))
        return error(spec, Message("no %1 in these clouds", covariate->name));
      auto axis = axis_of(spec, *covariate, *table, options);
      if (!axis) return axis.error();
      axes[k] = *axis;
    }
    body += (k == 0 ? "" : ",") + axis_text(*covariate, axes[k]);
  }
  EffectInfo info = user_effect_info(spec, covariates);
  info.spec = std::string("curve:") + name_of(spec.channel) + ":" + body;
  const int splines = covariates.size() == 1 ? options.curve_splines : options.tensor_splines;
  return EffectPtr(std::make_shared<CurveEffect>(info, spec.channel, covariates,
                                                 CurveBasis(std::move(axes), splines), options));
}

}  // namespace lvcalib
