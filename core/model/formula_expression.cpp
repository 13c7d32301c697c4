// SPDX-License-Identifier: BSD-3-Clause
#include "model/formula_expression.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <mutex>

#include <muParser.h>

#include "base/yaml_file.h"

namespace lvcalib {
namespace {

constexpr std::size_t kLongest = 2000;  // characters; muParser's own limit lies above

bool is_coefficient(const std::string& name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::all_of(name.begin() + 1, name.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

// An assignment would write into variables; comparisons are fine.
std::size_t assignment_at(const std::string& text) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '=') continue;
    const bool after = k > 0 && std::string("=<>!").find(text[k - 1]) != std::string::npos;
    const bool before = k + 1 < text.size() && text[k + 1] == '=';
    if (!after && !before) return k;
  }
  return std::string::npos;
}

Error syntax_error(const mu::Parser::exception_type& e, const std::string& text) {
  std::string message = e.GetMsg();
  while (!message.empty() && (message.back() == '.' || message.back() == '!')) message.pop_back();
  // The library counts from 0, says -1 where it means the whole, and lies beyond the end at times.
  const int position = std::min(static_cast<int>(e.GetPos()), static_cast<int>(text.size()));
  const bool inside = position >= 0;
  if (const auto at = message.find(" at position "); at != std::string::npos) message.resize(at);
  return Error::usage(
      inside ? Message("in the formula '%1' at character %2: %3", text, position + 1, message)
             : Message("in the formula '%1': %2", text, message));
}

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& w : words) out += (out.empty() ? "" : ", ") + w;
  return out;
}

std::vector<std::string> names_used(const std::string& text) {
  mu::Parser parser;
  parser.SetExpr(text);
  std::vector<std::string> out;
  for (const auto& [name, address] : parser.GetUsedVar()) out.push_back(name);
  return out;
}

}  // namespace

// A parser and the variables it reads; used by one thread at a time.
struct FormulaEvaluator {
  std::vector<double> values;
  mu::Parser parser;
};

struct FormulaExpression::Content {
  std::string text;
  std::vector<std::string> names;  // of the variables, then of the coefficients
  std::vector<std::size_t> variables;
  std::vector<std::string> coefficients;
  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<FormulaEvaluator>> idle;

  [[nodiscard]] std::unique_ptr<FormulaEvaluator> borrow() const {
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        auto out = std::move(idle.back());
        idle.pop_back();
        return out;
      }
    }
    auto out = std::make_unique<FormulaEvaluator>();
    out->values.assign(names.size(), 0.0);
    for (std::size_t k = 0; k < names.size(); ++k) out->parser.DefineVar(names[k], &out->values[k]);
    out->parser.SetExpr(text);
    return out;
  }

  void give_back(std::unique_ptr<FormulaEvaluator> evaluator) const {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(evaluator));
  }
};

FormulaExpression::FormulaExpression(std::unique_ptr<Content> content)
    : content_(std::move(content)) {}
FormulaExpression::FormulaExpression(FormulaExpression&&) noexcept = default;
FormulaExpression& FormulaExpression::operator=(FormulaExpression&&) noexcept = default;
FormulaExpression::~FormulaExpression() = default;

Result<FormulaExpression> FormulaExpression::parse(const std::string& text,
                                                   const std::vector<std::string>& variables) {
  if (text.size() > kLongest) {
    return Error::usage(
        Message("the formula has %1 characters, expected at most %2", text.size(), kLongest));
  }
  if (const auto at = assignment_at(text); at != std::string::npos) {
    return Error::usage(
        Message("in the formula '%1' at character %2: '=' assigns; expected an expression (write "
                "== to compare)",
                text, at + 1));
  }
  auto content = std::make_unique<Content>();
  content->text = text;
  try {
    for (const std::string& name : names_used(text)) {
      const auto at = std::find(variables.begin(), variables.end(), name);
      if (at != variables.end()) {
        content->variables.push_back(static_cast<std::size_t>(at - variables.begin()));
        continue;
      }
      if (is_coefficient(name)) {
        content->coefficients.push_back(name);
        continue;
      }
      const std::string near = nearest_word(name, variables);
      return Error::usage(
          near.empty()
              ? Message("in the formula '%1': there is no covariate '%2'", text, name)
              : Message("in the formula '%1': there is no covariate '%2'; did you mean '%3'?", text,
                        name, near),
          {}, Message("coefficients are single letters; this channel has %1", listed(variables)));
    }
    if (content->coefficients.empty()) {
      return Error::usage(Message(
          "the formula '%1' has no free coefficient; expected one or more, such as a in 'a*range'",
          text));
    }
    for (const std::size_t v : content->variables) content->names.push_back(variables[v]);
    for (const std::string& c : content->coefficients) content->names.push_back(c);
    auto first = content->borrow();
    first->parser.Eval();
    if (first->parser.GetNumResults() != 1) {
      return Error::usage(
          Message("the formula '%1' has %2 values separated by commas, expected one", text,
                  first->parser.GetNumResults()));
    }
    content->give_back(std::move(first));
  } catch (const mu::Parser::exception_type& e) {
    return syntax_error(e, text);
  }
  return FormulaExpression(std::move(content));
}

const std::vector<std::size_t>& FormulaExpression::variables() const {
  return content_->variables;
}

const std::vector<std::string>& FormulaExpression::coefficients() const {
  return content_->coefficients;
}

double FormulaExpression::evaluate(std::span<const double> variables,
                                   std::span<const double> coefficients) const {
  auto evaluator = content_->borrow();
  std::copy(variables.begin(), variables.end(), evaluator->values.begin());
  std::copy(coefficients.begin(), coefficients.end(),
            evaluator->values.begin() + static_cast<std::ptrdiff_t>(variables.size()));
  double out = std::numeric_limits<double>::quiet_NaN();
  try {
    out = evaluator->parser.Eval();
  } catch (const mu::Parser::exception_type&) {
    // Some functions throw outside their domain instead of returning NaN.
  }
  content_->give_back(std::move(evaluator));
  return out;
}

void FormulaExpression::columns(std::span<const double> variables,
                                std::span<double> by_coefficient) const {
  std::vector<double> unit(by_coefficient.size(), 0.0);
  for (std::size_t k = 0; k < unit.size(); ++k) {
    unit[k] = 1.0;
    by_coefficient[k] = evaluate(variables, unit);
    unit[k] = 0.0;
  }
}

}  // namespace lvcalib
