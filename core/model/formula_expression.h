// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// An arithmetic expression of named variables and free coefficients. Variables are those offered;
/// a coefficient is a single letter, perhaps with digits behind it (a, b, k1). Functions and
/// operators are muParser's (+ - * / ^, sin, cos, tan, exp, ln, sqrt, abs, sign, min, max, …,
/// comparisons, ?:); `ln` and `log` are natural; `_pi` and `_e` are constants.
/// May be evaluated from several threads at the same time.
class FormulaExpression {
 public:
  /// Errors: kUsage with the position for syntax; for a name that is neither a variable nor a
  /// coefficient, with the nearest variable; without a coefficient.
  static Result<FormulaExpression> parse(const std::string& text,
                                         const std::vector<std::string>& variables);

  FormulaExpression(FormulaExpression&&) noexcept;
  FormulaExpression& operator=(FormulaExpression&&) noexcept;
  ~FormulaExpression();

  /// Variables that occur, as indices into those offered, in that order.
  [[nodiscard]] const std::vector<std::size_t>& variables() const;
  /// Coefficients in alphabetic order.
  [[nodiscard]] const std::vector<std::string>& coefficients() const;

  /// Value at values of variables() and coefficients(), in their orders. Not finite where the
  /// expression is not defined (division by zero, roots and logarithms of negative numbers).
  [[nodiscard]] double evaluate(std::span<const double> variables,
                                std::span<const double> coefficients) const;
  /// Values with one coefficient at 1 and the others at 0: the columns of a linear formula.
  void columns(std::span<const double> variables, std::span<double> by_coefficient) const;

 private:
  struct Content;
  explicit FormulaExpression(std::unique_ptr<Content> content);
  std::unique_ptr<Content> content_;
};

}  // namespace lvcalib
