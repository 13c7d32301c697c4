// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "model/curve_basis.h"
#include "model/effect.h"

namespace lvcalib {

/// How the users' own effects are bounded and smoothed. Sizes per channel in the order of Channel
/// (px, m, m, 1), of the effect's root mean square over the rows.
struct UserEffectOptions {
  /// Standard deviation of what is believable: the prior.
  std::array<double, kChannels> believable{10.0, 0.1, 0.02, 3.0};
  /// What planned scenes shall show, see EffectParameter.
  std::array<double, kChannels> size_of_interest{0.05, 2e-3, 0.3e-3, 0.1};
  int curve_splines = 10;  ///< Of a curve of one covariate.
  int tensor_splines = 8;  ///< Along each of two covariates.
  int most_labels = 256;   ///< Of a covariate of labels.
  [[nodiscard]] Status check() const;
};

/// A user's own effect, taken apart:
///   formula:CHANNEL:EXPRESSION            an expression of the channel's covariates and of
///                                         coefficients that it is linear in
///   curve:CHANNEL:COVARIATE[,COVARIATE]   a penalised spline; "[low..high]" or "[1|2|3]" behind a
///                                         covariate fixes where it is defined
/// The value is what is added to the measurement: m (range, boundary), px (corner, both axes) or
/// the logarithm of the intensity. Covariates are in SI units (and px).
struct UserEffectSpec {
  enum class Kind { kFormula, kCurve };
  Kind kind = Kind::kFormula;
  Channel channel = Channel::kRange;
  std::string id;                       ///< The text without spaces around its parts.
  std::string body;                     ///< Expression, or covariates.
  std::vector<std::string> covariates;  ///< Of a curve: names.
  std::vector<CurveAxis> axes;          ///< Of a curve: as far as given; low = high if not.
};

/// True for texts that begin as a user's own effect does.
bool is_user_effect(const std::string& text);

/// Takes the text apart and checks all that needs no data.
/// Errors: kUsage for unknown channels and covariates (with the nearest name), syntax (with the
/// position), a formula without coefficient.
Result<UserEffectSpec> parse_user_effect(const std::string& text);

/// Makes the effect on a table: intervals of curves as far as not given, sizes of the priors.
/// Errors: as parse_user_effect; kInput if it cannot be used on these data: a covariate is missing
/// or does not vary, values are not finite on some rows (says how many), it is not linear in a
/// coefficient, is not zero without coefficients, or coefficients cannot be told apart.
Result<EffectPtr> make_user_effect(const std::string& text, const MeasurementTable& table,
                                   const UserEffectOptions& options);

/// Makes an effect again from its EffectInfo::spec, to apply known values without the data.
/// Errors: as parse_user_effect; kUsage if a curve's intervals are not in the text.
Result<EffectPtr> make_user_effect(const std::string& text);

/// A curve's own view of itself, for plots and files.
class CurveView {
 public:
  virtual ~CurveView() = default;
  CurveView() = default;
  CurveView(const CurveView&) = delete;
  CurveView& operator=(const CurveView&) = delete;
  [[nodiscard]] virtual const CurveBasis& basis() const = 0;
  [[nodiscard]] virtual Channel channel() const = 0;
  /// Names and units of the covariates.
  [[nodiscard]] virtual std::vector<std::string> covariate_names() const = 0;
  [[nodiscard]] virtual std::vector<std::string> covariate_units() const = 0;
  /// Derivative of the curve (SI) by the effect's parameters at a place.
  virtual void columns_at(std::span<const double> at, double shape,
                          std::span<double> by_parameter) const = 0;
};

/// The effect as a curve; nullptr if it is none.
const CurveView* as_curve(const Effect& effect);

}  // namespace lvcalib
