// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/model_text.h"

#include <QCoreApplication>
#include <cmath>
#include <map>

#include "base/text.h"
#include "model/row_covariates.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

QString translated(const char* text) {
  return QCoreApplication::translate("ModelText", text);
}

const char* criterion_name(const std::string& name) {
  static const std::map<std::string, const char*> names = {
      {"p_value",
       QT_TRANSLATE_NOOP("ModelText", "chance of something this large, after the search")},
      {"mean_gain", QT_TRANSLATE_NOOP("ModelText", "gain in scenes held out, standard errors")},
      {"total_gain", QT_TRANSLATE_NOOP("ModelText", "gain, against what chance finds in a search")},
      {"scenes_improved", QT_TRANSLATE_NOOP("ModelText", "share of scenes predicted better")},
      {"two_scenes", QT_TRANSLATE_NOOP("ModelText", "scenes predicted better")},
      {"possible", QT_TRANSLATE_NOOP("ModelText", "distance from what devices have, σ²")},
      {"explained", QT_TRANSLATE_NOOP("ModelText", "share of what its channel misses by")},
      {"held_out",
       QT_TRANSLATE_NOOP("ModelText", "fall of held-out squares, over the least asked")},
      {"prints_agree", QT_TRANSLATE_NOOP("ModelText", "white and black print agree")},
      {"edges_trusted", QT_TRANSLATE_NOOP("ModelText", "edges can be trusted")},
      {"beside_curve", QT_TRANSLATE_NOOP("ModelText", "it says something beside a curve")},
      {"beside_place", QT_TRANSLATE_NOOP("ModelText", "it explains what sits at a place")},
      {"scenes_agree", QT_TRANSLATE_NOOP("ModelText", "tried, it predicts no worse")}};
  const auto found = names.find(name);
  return found == names.end() ? nullptr : found->second;
}

}  // namespace

QString channel_name(Channel channel) {
  switch (channel) {
    case Channel::kCorner:
      return translated(QT_TRANSLATE_NOOP("ModelText", "corner"));
    case Channel::kRange:
      return translated(QT_TRANSLATE_NOOP("ModelText", "range"));
    case Channel::kBoundary:
      return translated(QT_TRANSLATE_NOOP("ModelText", "boundary"));
    case Channel::kIntensity:
      break;
  }
  return translated(QT_TRANSLATE_NOOP("ModelText", "intensity"));
}

QString unit_text(Channel channel) {
  return channel == Channel::kIntensity
             ? translated(QT_TRANSLATE_NOOP("ModelText", "log. intensity"))
             : QString::fromLatin1(unit_of(channel));
}

QString covariate_name(const std::string& name) {
  return core_text(covariates_named({name}));
}

QString category_name(const std::string& covariate, double value) {
  if (covariate == "print") {
    const char* names[] = {QT_TRANSLATE_NOOP("ModelText", "white"),
                           QT_TRANSLATE_NOOP("ModelText", "black"),
                           QT_TRANSLATE_NOOP("ModelText", "circle")};
    const auto k = static_cast<std::size_t>(value);
    if (k < std::size(names)) return translated(names[k]);
  }
  return QString::number(value);
}

QString verdict_name(EffectVerdict verdict) {
  switch (verdict) {
    case EffectVerdict::kPresent:
      return translated(QT_TRANSLATE_NOOP("ModelText", "present"));
    case EffectVerdict::kAbsent:
      return translated(QT_TRANSLATE_NOOP("ModelText", "absent"));
    case EffectVerdict::kAliased:
      return translated(QT_TRANSLATE_NOOP("ModelText", "one of several"));
    case EffectVerdict::kNotTestable:
      break;
  }
  return translated(QT_TRANSLATE_NOOP("ModelText", "cannot tell"));
}

QString effect_title(const std::string& spec) {
  const EffectPtr effect = find_effect(spec);
  if (!effect || effect->info().title.empty()) return QString::fromStdString(spec);
  return core_text(Message::listed(effect->info().title));
}

QString unit_behind(const std::string& unit) {
  return unit.empty() || unit == "1" ? QString() : QLatin1Char(' ') + QString::fromStdString(unit);
}

QString value_text(const ParameterEstimate& p, bool held) {
  const QString unit = unit_behind(p.unit);
  const double value = p.value / p.unit_in_si;
  const double sigma = p.sigma / p.unit_in_si;
  if (held)
    return translated(QT_TRANSLATE_NOOP("ModelText", "%1%2 (held)"))
        .arg(QString::number(value, 'g', 4), unit);
  return QString::fromStdString(with_sigma(value, sigma)) + unit;
}

QString values_text(const std::vector<ParameterEstimate>& parameters, bool held) {
  constexpr std::size_t kShown = 3;
  QString out;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (k == kShown) return out + QStringLiteral(", …");
    if (k > 0) out += QStringLiteral(", ");
    out += parameter_name(parameters[k].name) + QStringLiteral(" = ") +
           value_text(parameters[k], held);
  }
  return out;
}

QString move_text(double mm, double mrad) {
  return QStringLiteral("%1 mm, %2 mrad").arg(mm, 0, 'f', 1).arg(mrad, 0, 'f', 2);
}

QString plain_number(double value, int digits) {
  constexpr double kEndless = 1e6;
  constexpr double kTiny = 1e-3;
  static constexpr char16_t kRaised[] = u"⁰¹²³⁴⁵⁶⁷⁸⁹";
  if (!(std::abs(value) <= kEndless))
    return value < 0.0 ? QStringLiteral("−∞") : QStringLiteral("∞");
  const double rounded = QString::number(value, 'e', digits - 1).toDouble();
  if (std::abs(rounded) >= std::pow(10.0, digits)) return QString::number(value, 'f', 0);
  if (value == 0.0 || std::abs(value) >= kTiny) return QString::number(value, 'g', digits);
  const QStringList parts = QString::number(value, 'e', 1).split(QStringLiteral("e-"));
  QString exponent;
  for (const QChar digit : QString::number(parts[1].toInt()))
    exponent += kRaised[digit.digitValue()];
  return QStringLiteral("%1·10⁻%2").arg(parts[0], exponent);
}

QString criteria_html(const EffectProposal& proposal) {
  const EffectFinding& f = proposal.finding;
  if (f.criteria.empty()) return {};
  // Chances of many trials add up to more than certainty.
  const auto shown = [](const Criterion& c) {
    return c.name == "p_value" ? std::min(1.0, c.value) : c.value;
  };
  const auto plain = [](const char* text) { return translated(text).toHtmlEscaped(); };
  QString rows;
  bool against = false;
  for (const Criterion& c : f.criteria) {
    const char* name = criterion_name(c.name);
    const QString title = name != nullptr ? translated(name) : QString::fromStdString(c.name);
    // As the numbers are, not as they would have to be.
    const char16_t relation = c.at_most ? (c.holds() ? u'≤' : u'>') : (c.holds() ? u'≥' : u'<');
    // Yes or no: told where it is no, and once for all where nothing speaks against it.
    const bool is_question = c.threshold == 1.0 && !c.at_most && (c.value == 0.0 || c.value == 1.0);
    against = against || (is_question && !c.holds());
    if (is_question && c.holds()) continue;
    rows += QStringLiteral("<tr><td>%1&nbsp;</td><td>%2&nbsp;</td><td align=right>%3</td></tr>")
                .arg(c.holds() ? QChar(0x2713) : QChar(0x2717))
                .arg(title.toHtmlEscaped(), is_question
                                                ? QString()
                                                : QStringLiteral("%1&nbsp;%2&nbsp;%3")
                                                      .arg(plain_number(shown(c)),
                                                           QString(QChar(relation)).toHtmlEscaped(),
                                                           plain_number(c.threshold)));
    if (!c.holds())
      rows += QStringLiteral("<tr><td></td><td colspan=2><i>%1</i></td></tr>")
                  .arg(core_text(reason_of(c)).toHtmlEscaped());
  }
  if (!against) {
    rows += QStringLiteral("<tr><td>%1&nbsp;</td><td colspan=2>%2</td></tr>")
                .arg(QChar(0x2713))
                .arg(plain(QT_TRANSLATE_NOOP("ModelText", "nothing else speaks against it")));
  }
  const QString head = proposal.suggested
                           ? plain(QT_TRANSLATE_NOOP("ModelText", "Why it is suggested"))
                           : plain(QT_TRANSLATE_NOOP("ModelText", "Why it is not suggested"));
  const QString relevance =
      f.matters ? plain(QT_TRANSLATE_NOOP("ModelText",
                                          "Left out, it may move the extrinsic by more than the "
                                          "tolerance: it matters."))
                : plain(QT_TRANSLATE_NOOP(
                      "ModelText", "Left out, it moves the extrinsic by less than the tolerance."));
  return QStringLiteral("<p><b>%1</b></p><table>%2</table><p>%3</p>").arg(head, rows, relevance);
}

namespace {

QString change_text(const ModelStep& step) {
  const QString title = effect_title(step.changed);
  switch (step.change) {
    case ModelChange::kStart:
      return translated(QT_TRANSLATE_NOOP("ModelText", "base model"));
    case ModelChange::kAdd:
    case ModelChange::kSwitchOn:
      return QStringLiteral("+ ") + title;
    case ModelChange::kRemove:
    case ModelChange::kSwitchOff:
      return QStringLiteral("− ") + title;
    case ModelChange::kHold:
      return translated(QT_TRANSLATE_NOOP("ModelText", "%1 held")).arg(title);
    case ModelChange::kRelease:
      break;
  }
  return translated(QT_TRANSLATE_NOOP("ModelText", "%1 fitted")).arg(title);
}

}  // namespace

QString step_text(const ModelStep& step) {
  const QString text = change_text(step);
  return step.without_change
             ? translated(QT_TRANSLATE_NOOP("ModelText", "(%1: not possible)")).arg(text)
             : text;
}

}  // namespace lvcalib::widgets
