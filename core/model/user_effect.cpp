// SPDX-License-Identifier: BSD-3-Clause
#include "model/user_effect.h"

#include <algorithm>

#include "base/yaml_file.h"
#include "model/curve_effect.h"
#include "model/formula_effect.h"
#include "model/formula_expression.h"
#include "model/row_covariates.h"

namespace lvcalib {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::vector<std::string> split(const std::string& text, const std::string& between) {
  std::vector<std::string> out;
  std::size_t from = 0;
  for (;;) {
    const auto at = text.find(between, from);
    out.push_back(trimmed(text.substr(from, at - from)));
    if (at == std::string::npos) return out;
    from = at + between.size();
  }
}

Result<Channel> channel_named(const std::string& name, const std::string& id) {
  std::vector<std::string> known;
  for (const Channel channel : kAllChannels) {
    if (name == name_of(channel)) return channel;
    known.emplace_back(name_of(channel));
  }
  const std::string near = nearest_word(name, known);
  return Error::usage(
      near.empty()
          ? Message(
                "in '%1': there is no channel '%2' (expected corner, range, boundary or intensity)",
                id, name)
          : Message("in '%1': there is no channel '%2'; did you mean '%3'? (expected corner, "
                    "range, boundary or intensity)",
                    id, name, near));
}

// "low..high" or "1|2|3" into an axis.
bool read_axis(const std::string& text, CurveAxis& axis) {
  if (const auto ends = split(text, ".."); ends.size() == 2) {
    return parse_number(ends[0], axis.low) && parse_number(ends[1], axis.high) &&
           axis.high > axis.low;
  }
  for (const std::string& label : split(text, "|")) {
    axis.labels.push_back(0.0);
    if (!parse_number(label, axis.labels.back())) return false;
  }
  std::sort(axis.labels.begin(), axis.labels.end());
  return true;
}

Status read_covariate(const std::string& text, UserEffectSpec& spec) {
  const auto bracket = text.find('[');
  const std::string name = trimmed(text.substr(0, bracket));
  const RowCovariate* covariate = find_covariate(spec.channel, name);
  if (covariate == nullptr) {
    std::vector<std::string> known;
    for (const RowCovariate& c : row_covariates(spec.channel)) known.push_back(c.identifier());
    const std::string near = nearest_word(name, known);
    return Error::usage(near.empty()
                            ? Message("in '%1': there is no covariate '%2'", spec.id, name)
                            : Message("in '%1': there is no covariate '%2'; did you mean '%3'?",
                                      spec.id, name, near));
  }
  CurveAxis axis;
  if (bracket != std::string::npos) {
    if (text.back() != ']' || !read_axis(text.substr(bracket + 1, text.size() - bracket - 2), axis))
      return Error::usage(
          Message("in '%1': expected '[low..high]' or '[1|2|3]' after %2, found '%3'", spec.id,
                  name, text.substr(bracket)));
  }
  spec.covariates.push_back(covariate->identifier());
  spec.axes.push_back(std::move(axis));
  return Done{};
}

Status read_curve(UserEffectSpec& spec) {
  const auto parts = split(spec.body, ",");
  if (parts.size() > 2) {
    return Error::usage(
        Message("'%1' has %2 covariates, expected one or two", spec.id, parts.size()));
  }
  for (const std::string& part : parts) {
    if (Status s = read_covariate(part, spec); !s) return s;
  }
  if (parts.size() < 2) return Done{};
  if (spec.covariates[0] == spec.covariates[1])
    return Error::usage(Message("'%1' names the same covariate twice", spec.id));
  for (const std::string& name : spec.covariates) {
    if (find_covariate(spec.channel, name)->categories) {
      return Error::usage(Message(
          "'%1': %2 is a label; a curve over two covariates needs two scales", spec.id, name));
    }
  }
  return Done{};
}

Result<EffectPtr> make(const std::string& text, const MeasurementTable* table,
                       const UserEffectOptions& options) {
  auto spec = parse_user_effect(text);
  if (!spec) return spec.error();
  return spec->kind == UserEffectSpec::Kind::kFormula ? make_formula_effect(*spec, table, options)
                                                      : make_curve_effect(*spec, table, options);
}

}  // namespace

Status UserEffectOptions::check() const {
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (!(size_of_interest[c] > 0.0) || !(believable[c] > size_of_interest[c]))
      return Error::usage(
          Message("sizes of users' effects: expected 0 < size of interest < believable size"));
  }
  if (curve_splines < 5 || tensor_splines < 5 || curve_splines > 100 || tensor_splines > 20)
    return Error::usage(
        Message("splines of users' curves: expected 5 to 100, or 5 to 20 along each of two"));
  if (most_labels < 2) return Error::usage(Message("labels of a curve: expected 2 or more"));
  return Done{};
}

bool is_user_effect(const std::string& text) {
  const std::string t = trimmed(text);
  return t.rfind("formula:", 0) == 0 || t.rfind("curve:", 0) == 0 || t == "formula" || t == "curve";
}

Result<UserEffectSpec> parse_user_effect(const std::string& text) {
  UserEffectSpec spec;
  spec.id = trimmed(text);
  const auto first = spec.id.find(':');
  const auto second = first == std::string::npos ? first : spec.id.find(':', first + 1);
  const std::string kind = trimmed(spec.id.substr(0, first));
  if (second == std::string::npos || trimmed(spec.id.substr(second + 1)).empty()) {
    return Error::usage(
        Message("'%1' is not complete, expected '%2', such as '%3'", spec.id,
                kind == "curve" ? "curve:CHANNEL:COVARIATE" : "formula:CHANNEL:EXPRESSION",
                kind == "curve" ? "curve:range:azimuth" : "formula:range:a*darkness"));
  }
  spec.kind = kind == "curve" ? UserEffectSpec::Kind::kCurve : UserEffectSpec::Kind::kFormula;
  auto channel = channel_named(trimmed(spec.id.substr(first + 1, second - first - 1)), spec.id);
  if (!channel) return channel.error();
  spec.channel = *channel;
  spec.body = trimmed(spec.id.substr(second + 1));
  spec.id = kind + ":" + name_of(spec.channel) + ":" + spec.body;
  if (spec.kind == UserEffectSpec::Kind::kCurve) {
    if (Status s = read_curve(spec); !s) return s.error();
    return spec;
  }
  std::vector<std::string> variables;
  for (const RowCovariate& c : row_covariates(spec.channel)) variables.push_back(c.identifier());
  auto expression = FormulaExpression::parse(spec.body, variables);
  if (!expression) return expression.error();
  return spec;
}

Result<EffectPtr> make_user_effect(const std::string& text, const MeasurementTable& table,
                                   const UserEffectOptions& options) {
  if (Status s = options.check(); !s) return s.error();
  return make(text, &table, options);
}

Result<EffectPtr> make_user_effect(const std::string& text) {
  return make(text, nullptr, {});
}

}  // namespace lvcalib
