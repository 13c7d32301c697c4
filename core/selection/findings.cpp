// SPDX-License-Identifier: BSD-3-Clause
#include "selection/findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/text.h"
#include "model/row_covariates.h"
#include "model/user_effect.h"
#include "selection/advice_text.h"

namespace lvcalib {
namespace {

Message lowest_text(const EffectColumns& columns) {
  std::vector<Message> parts;
  for (const EffectParameter& p : columns.parameters) {
    if (std::isfinite(p.lowest))
      parts.push_back(
          parameter_is(columns.effect->info().id, p.name,
                       formatted("%.3g", p.lowest / p.unit_in_si) + behind_number(p.unit)));
  }
  return joined(parts, ", ");
}

void set_parameters(const EffectColumns& columns, const Eigen::VectorXd& values,
                    const Eigen::MatrixXd& covariance, EffectFinding& finding) {
  finding.shape = columns.shape;
  for (int k = 0; k < columns.count(); ++k) {
    const EffectParameter& p = columns.parameters[static_cast<std::size_t>(k)];
    finding.parameters.push_back(
        {p.name, p.unit, p.unit_in_si, values(k), std::sqrt(std::max(0.0, covariance(k, k)))});
  }
}

void set_move(const ExtrinsicMove& move, EffectFinding& finding) {
  finding.extrinsic_move_mm = 1e3 * move.translation_m;
  finding.extrinsic_move_mrad = 1e3 * move.rotation_rad;
}

// The curve over its intervals, with its standard deviation.
FoundCurve found_curve(const EffectInUse& use, const Eigen::MatrixXd& covariance) {
  constexpr int kAlong = 33;
  constexpr int kTensor = 9;
  FoundCurve out;
  const CurveView* view = as_curve(*use.effect);
  if (view == nullptr) return out;
  out.channel = view->channel();
  out.covariates = view->covariate_names();
  out.units = view->covariate_units();
  const auto& axes = view->basis().axes();
  const auto places = [](const CurveAxis& axis, int count) {
    if (axis.categories()) return axis.labels;
    std::vector<double> values;
    for (int k = 0; k < count; ++k)
      values.push_back(axis.low + (axis.high - axis.low) * k / (count - 1.0));
    return values;
  };
  const bool tensor = axes.size() > 1;
  Eigen::VectorXd by(use.values.size());
  for (const double x : places(axes[0], tensor ? kTensor : kAlong)) {
    for (const double y : tensor ? places(axes[1], kTensor) : std::vector<double>{0.0}) {
      const std::array<double, 2> at{x, y};
      view->columns_at(std::span(at).first(axes.size()), use.shape,
                       {by.data(), static_cast<std::size_t>(by.size())});
      out.points.push_back({x, y, by.dot(use.values), std::sqrt(by.dot(covariance * by))});
    }
  }
  return out;
}

// What was found of an effect: its values, or of a curve how far it reaches.
Message found_text(const EffectFinding& f) {
  if (f.curve.points.empty()) return values_text(f);
  const auto& p = f.curve.points;
  const auto [low, high] = std::minmax_element(
      p.begin(), p.end(),
      [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; });
  double squares = 0.0;
  for (const CurvePoint& point : p) squares += point.sigma * point.sigma;
  const double factor = display_factor(f.curve.channel);
  const std::string unit = behind_number(unit_of(f.curve.channel));
  const double sigma = std::sqrt(squares / static_cast<double>(p.size()));
  return Message("it runs from %1 to %2 over %3, known to %4",
                 formatted("%.3g", factor * low->value),
                 formatted("%.3g", factor * high->value) + unit,
                 covariates_named(f.curve.covariates), formatted("%.2g", factor * sigma) + unit);
}

// Chance lets the best of so many covariates gain ln(tried/α) at most; and structure of one scene
// alone, as of a warped board, is no gain in most.
bool scenes_agree(const StructureScore& score, std::size_t tried, const DiscoveryOptions& options) {
  const double total = std::accumulate(score.scene_gain.begin(), score.scene_gain.end(), 0.0);
  if (!(total > std::log(static_cast<double>(tried) / options.false_alarm))) return false;
  const auto informative =
      std::count_if(score.scene_gain.begin(), score.scene_gain.end(),
                    [&](double gain) { return std::abs(gain) >= options.informative_nats; });
  const auto improved =
      std::count_if(score.scene_gain.begin(), score.scene_gain.end(),
                    [&](double gain) { return gain >= options.informative_nats; });
  return is_gain(score.scene_gain) &&
         static_cast<double>(improved) >=
             options.scenes_improved * static_cast<double>(informative);
}

// The extrinsic's bias by an effect in use, from the final model's information.
ExtrinsicMove bias_of(const EffectSearch& search, std::size_t k, Eigen::Index at, Eigen::Index n) {
  const ModelFit& fit = search.reference().fit;
  Eigen::MatrixXd h = fit.prior.information;
  for (const SceneTerm& scene : fit.scenes) h += scene.information;
  std::vector<Eigen::Index> rest;
  for (Eigen::Index i = 0; i < h.rows(); ++i) {
    if (i < at || i >= at + n) rest.push_back(i);
  }
  const Eigen::MatrixXd hr = h(rest, rest);
  const Eigen::VectorXd cross = h(rest, Eigen::seqN(at, n)) * search.in_use()[k].values;
  const Eigen::VectorXd move = hr.ldlt().solve(cross);
  return {move.head<3>().norm(), move.segment<3>(3).norm()};
}

std::string mm(const EffectFinding& f) {
  return formatted("%.1f", f.extrinsic_move_mm);
}
std::string mrad(const EffectFinding& f) {
  return formatted("%.2f", f.extrinsic_move_mrad);
}

void explain_selected(const Effect& effect, EffectFinding& f) {
  const EffectInfo& info = effect.info();
  const Message physics = Message::listed(info.physics);
  if (effect.shape_name().empty()) {
    f.explanation =
        Message("%1 Found: %2; leaving it out would move the extrinsic by %3 mm and %4 mrad.",
                physics, found_text(f), mm(f), mrad(f));
  } else {
    f.explanation = Message(
        "%1 Found: %2; %3 = %4; leaving it out would move the extrinsic by %5 mm and %6 mrad.",
        physics, found_text(f), Message::listed(effect.shape_name()),
        f.shape_sigma > 0.0 ? formatted("%.4g ± %.2g", f.shape, f.shape_sigma)
                            : formatted("%.3g", f.shape),
        mm(f), mrad(f));
  }
  if (!f.aliases.empty()) f.explanation += not_told_apart(f, info);
}

// What is known of an effect that is in the model. `stated`: where its values and their standard
// deviations are read.
EffectFinding selected_finding(const EffectSearch& search, const EffectSearch& stated,
                               const Selection& s, const DiscoveryOptions& options) {
  EffectFinding f;
  f.id = s.id;
  f.verdict = s.aliases.empty() ? EffectVerdict::kPresent : EffectVerdict::kAliased;
  f.aliases = s.aliases;
  f.heldout_gain = s.heldout_gain;
  f.log_density_gain = s.log_density_gain;
  f.p_value = s.p_value;
  f.criteria = s.criteria;
  const auto& in_use = stated.in_use();
  std::size_t k = 0;
  Eigen::Index at = 6;
  for (; in_use[k].effect->info().id != s.id; ++k) at += in_use[k].values.size();
  const Eigen::Index n = in_use[k].values.size();
  const Eigen::MatrixXd covariance = stated.joint_covariance().block(at, at, n, n);
  set_parameters(search.linear().columns.list()[k], in_use[k].values, covariance, f);
  f.shape_sigma = stated.shape_sigma(k);
  f.shape_name = in_use[k].effect->shape_name();
  f.spec = in_use[k].effect->info().spec;
  f.curve = found_curve(in_use[k], covariance);
  const ExtrinsicMove move = bias_of(search, k, at, n);
  set_move(move, f);
  f.matters = move.exceeds(tolerated(options.tolerance, search.reference().fit));
  explain_selected(*in_use[k].effect, f);
  return f;
}

// Whether the data say more of it than what is believable beforehand: a third of that, or less.
bool is_told(const EffectColumns& columns, const EffectFinding& f) {
  constexpr double kTold = 1.0 / 3.0;
  for (std::size_t k = 0; k < f.parameters.size(); ++k) {
    if (f.parameters[k].sigma > kTold * columns.parameters[k].prior_sigma) return false;
  }
  return true;
}

// Absent if at its limit it would not move the extrinsic by more than is tolerated. Not testable
// if the data could not exclude that even where they saw nothing of it, or hardly see it at all.
void judge_other(const EffectSearch& search, const Candidate& c, const DiscoveryOptions& options,
                 EffectFinding& f) {
  const EffectColumns& columns = columns_of(search, c);
  f.unabsorbed_share = unabsorbed_share(c.fit, c.fit.solution.tail(columns.count()));
  set_move(c.limit.most, f);
  const bool told = is_told(columns, f);
  const Message values = values_text(f);
  const Message pose = Message::listed(columns.effect->info().discriminating_pose);
  const bool sure = is_sure(c, search.candidates().size(), options);
  if (!f.matters && told) {
    f.verdict = EffectVerdict::kAbsent;
    f.explanation =
        sure ? Message(
                   "Too small to matter: %1; it moves the extrinsic by %2 mm and %3 mrad at "
                   "most.",
                   values, mm(f), mrad(f))
             : Message(
                   "Not there as far as it matters: %1; it moves the extrinsic by %2 mm and "
                   "%3 mrad at most.",
                   values, mm(f), mrad(f));
    return;
  }
  f.verdict = EffectVerdict::kNotTestable;
  if (c.contradiction == Contradiction::kLevels) {
    f.explanation = Message(
        "White and black return unlike shares of light as range and incidence change, which no "
        "effect explains; edges are found in these intensities and cannot tell: %1.",
        values);
  } else if (c.contradiction == Contradiction::kScenes) {
    f.explanation = Message(
        "Tried in the model it predicts scenes held out worse, or nothing is left of it: %1; too "
        "few of them show it, or something else does what it explains. To decide: %2.",
        values, pose);
  } else if (c.contradiction == Contradiction::kCurve) {
    f.explanation = Message(
        "Beside a curve over what is left in the %1 channel it is not there: %2; something that "
        "no effect explains is at work.",
        word_for(c.main_channel()), values);
  } else if (c.contradiction == Contradiction::kPlace) {
    f.explanation = Message(
        "It leaves most of what is at one place as it is: %1; something that no effect explains is "
        "at work.",
        values);
  } else if (c.contradiction == Contradiction::kPrints) {
    f.explanation = Message(
        "White and black print contradict each other about it: %1 of both together; something "
        "that depends on the print is at work.",
        values);
  } else if (!c.possible()) {
    f.explanation = Message(
        "What fits best is impossible: %1, while no device has less than %2; something else is "
        "at work.",
        values, lowest_text(columns));
  } else if (c.explained_share < options.min_explained && sure) {
    f.explanation = Message(
        "It explains %1 % of what is wrong in the %2 channel: %3; something else is at work "
        "there.",
        formatted("%.0f", 100.0 * std::max(0.0, c.explained_share)), word_for(c.explained_in),
        values);
  } else if (!told || c.limit.unknown.exceeds(c.tolerance)) {
    f.explanation = Message(
        "Cannot be told from these scenes: %1; it may move the extrinsic by %2 mm and %3 mrad. "
        "To see it: %4.",
        values, mm(f), mrad(f), pose);
  } else {
    f.explanation = Message(
        "Undecided: %1 is neither excluded nor confirmed by scenes held out; it may move the "
        "extrinsic by %2 mm and %3 mrad. To decide: %4.",
        values, mm(f), mrad(f), pose);
  }
}

// What is known of an effect that is not in the model, from its best candidate.
EffectFinding other_finding(const EffectSearch& search, const Candidate& c,
                            const std::vector<Selection>& selected,
                            const DiscoveryOptions& options) {
  const EffectColumns& columns = columns_of(search, c);
  EffectFinding f;
  f.id = columns.effect->info().id;
  f.heldout_gain = c.best_heldout_gain();
  f.log_density_gain = c.total_gain();
  f.p_value = c.p_value;
  f.criteria = criteria_of(c, search.candidates().size(), search.table().scenes.size(), options);
  f.matters = c.limit.most.exceeds(c.tolerance);
  const Eigen::Index p = columns.count();
  const Eigen::VectorXd theta = c.fit.solution.tail(p);
  const Eigen::MatrixXd covariance = c.fit.covariance.bottomRightCorner(p, p);
  set_parameters(columns, theta, covariance, f);
  judge_other(search, c, options, f);
  for (const Selection& s : selected) {
    if (std::find(s.aliases.begin(), s.aliases.end(), f.id) == s.aliases.end()) continue;
    f.verdict = EffectVerdict::kAliased;
    f.aliases.assign(1, s.id);
    f.explanation = Message(
        "Explains the same as %1, which is in the model: these scenes cannot tell the two apart. "
        "To tell: %2.",
        effect_named(s.id), Message::listed(columns.effect->info().discriminating_pose));
  }
  return f;
}

// Part of the beam's blur, which every model holds: the least squares of what the effect adds to
// the three numbers of the blur. Measured, so there is nothing to test; the value is told.
void set_measured(const Effect& effect, const MeasuredBlur& blur, const MeasurementTable& table,
                  EffectFinding& finding) {
  const std::vector<EffectParameter> parameters = effect.parameters(table);
  std::vector<Eigen::Vector3d> by(parameters.size(), Eigen::Vector3d::Zero());
  effect.blur({}, table, 0.0, by);
  Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < by.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = by[k];
  const Eigen::MatrixXd inverse = columns.completeOrthogonalDecomposition().pseudoInverse();
  const Eigen::VectorXd values = inverse * blur.rad2;
  const Eigen::MatrixXd covariance = inverse * blur.covariance * inverse.transpose();
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    finding.parameters.push_back({parameters[k].name, parameters[k].unit, parameters[k].unit_in_si,
                                  values(i), std::sqrt(std::max(0.0, covariance(i, i)))});
  }
}

EffectFinding untestable_finding(const EffectSearch& search, const Effect& effect,
                                 const Message& reason) {
  EffectFinding f;
  f.id = effect.info().id;
  f.verdict = EffectVerdict::kNotTestable;
  f.explanation = Message("Not testable: %1.", reason);
  const auto blur = effect.is_in_base_model() ? search.measured_blur() : std::nullopt;
  if (blur) set_measured(effect, *blur, search.table(), f);
  return f;
}

}  // namespace

std::string name_of(EffectVerdict verdict) {
  switch (verdict) {
    case EffectVerdict::kPresent:
      return "present";
    case EffectVerdict::kAbsent:
      return "absent";
    case EffectVerdict::kAliased:
      return "aliased";
    case EffectVerdict::kNotTestable:
      break;
  }
  return "not_testable";
}

const EffectColumns& columns_of(const EffectSearch& search, const Candidate& candidate) {
  return search.linear().columns.list()[candidate.columns];
}

std::vector<std::string> aliases_of(const EffectSearch& search, std::size_t chosen,
                                    const DiscoveryOptions& options) {
  const auto& candidates = search.candidates();
  const auto& list = search.linear().columns.list();
  const Candidate& best = candidates[chosen];
  const std::string& own = list[best.columns].effect->info().id;
  std::set<std::string> out;
  for (const Candidate& other : candidates) {
    const std::string& id = list[other.columns].effect->info().id;
    if (id == own) continue;
    const bool alike = correlation_of(search.linear(), search.reference(), best.columns,
                                      other.columns) > options.alias_correlation;
    // Effects of different channels may both be there; that they gain alike is chance.
    const bool tie = other.main_channel() == best.main_channel() &&
                     is_accepted(other, candidates.size(), search.table().scenes.size(), options) &&
                     indistinguishable(best, other);
    // Where a candidate with more parameters contains the other's pattern, only a tie in prediction
    // makes them aliases.
    const bool same_size = list[best.columns].count() == list[other.columns].count();
    if (tie || (alike && same_size)) out.insert(id);
  }
  return {out.begin(), out.end()};
}

bool is_notable(const StructureScore& score, std::size_t tried, const DiscoveryOptions& options) {
  if (score.score >= options.min_structure) return true;
  // What is local has a small share of the variance by nature: a bump is judged by its height.
  const bool local = score.channel == Channel::kRange && score.height >= options.min_height;
  return (score.score >= options.min_sure_structure || local) &&
         scenes_agree(score, tried, options);
}

std::vector<StructureScore> notable_of(std::vector<StructureScore> scores,
                                       const DiscoveryOptions& options) {
  const std::size_t tried = scores.size();
  std::erase_if(scores, [&](const StructureScore& s) { return !is_notable(s, tried, options); });
  sort_best_first(scores);
  return scores;
}

std::vector<StructureScore> notable_of(const StructureScan& scan, const DiscoveryOptions& options) {
  std::vector<StructureScore> all = scan.curves;
  all.insert(all.end(), scan.places.begin(), scan.places.end());
  return notable_of(std::move(all), options);
}

void judge_unknown(const EffectSearch& explained, const DiscoveryOptions& options,
                   std::vector<StructureScore>& unknown) {
  // Each asks for a linearization of all rows, and there are four channels: beyond the strongest of
  // each, other covariates mostly see the same structure.
  constexpr std::size_t kMost = 4;
  const ExtrinsicMove tolerance = tolerated(options.tolerance, explained.reference().fit);
  for (std::size_t k = 0; k < std::min(kMost, unknown.size()); ++k) {
    const auto curve = make_user_effect(curve_spec(unknown[k]), explained.table(), options.user);
    if (!curve) continue;
    const auto move = explained.move_without(*curve);
    if (!move) continue;
    unknown[k].extrinsic_move = *move;
    unknown[k].matters = move->exceeds(tolerance);
  }
}

ScenesTaken scenes_taken(const EffectSearch& search) {
  return {search.table(), search.state(), search.in_use(), search.linear(),
          search.reference().fit.variances};
}

OpenQuestions open_questions(const EffectSearch& search,
                             const std::vector<EffectFinding>& findings) {
  // Each is a search over all poses and a sentence: the largest are what the next outing can
  // settle.
  constexpr std::size_t kMostPairs = 3;
  constexpr std::size_t kMostUnseen = 2;
  // Where an effect stands in the linearisation: the candidate that predicts best.
  const auto place = [&](const std::string& id) -> std::optional<std::size_t> {
    for (const Candidate& c : search.candidates()) {
      if (columns_of(search, c).effect->info().id == id) return c.columns;
    }
    return std::nullopt;
  };
  OpenQuestions out;
  for (const EffectFinding& f : findings) {
    const auto& in_use = search.in_use();
    const auto at = std::find_if(in_use.begin(), in_use.end(), [&](const EffectInUse& use) {
      return use.effect->info().id == f.id;
    });
    if (at == in_use.end()) continue;
    for (const std::string& id : f.aliases) {
      const auto alias = place(id);
      if (out.aliased.size() < kMostPairs && alias)
        out.aliased.push_back({static_cast<std::size_t>(at - in_use.begin()), *alias});
    }
  }
  for (const EffectFinding& f : findings) {
    const auto effect = place(f.id);
    if (f.verdict == EffectVerdict::kNotTestable && !f.parameters.empty() && f.matters && effect)
      out.unseen.push_back({*effect, f.extrinsic_move_mm, f.extrinsic_move_mrad});
  }
  std::stable_sort(out.unseen.begin(), out.unseen.end(),
                   [](const UnseenEffect& a, const UnseenEffect& b) {
                     return a.extrinsic_move_mm > b.extrinsic_move_mm;
                   });
  if (out.unseen.size() > kMostUnseen) out.unseen.resize(kMostUnseen);
  return out;
}

std::vector<EffectFinding> judge_effects(const EffectSearch& search,
                                         const std::vector<Selection>& selected,
                                         const DiscoveryOptions& options,
                                         const EffectSearch* stated) {
  std::vector<EffectFinding> out;
  for (const Selection& s : selected)
    out.push_back(selected_finding(search, stated != nullptr ? *stated : search, s, options));
  std::set<std::string> seen;
  for (const Candidate& c : search.candidates()) {
    if (seen.insert(columns_of(search, c).effect->info().id).second)
      out.push_back(other_finding(search, c, selected, options));
  }
  for (const EffectPtr& effect : effect_catalogue()) {
    const Message reason = why_not_testable(*effect, search.table());
    if (!reason.empty()) out.push_back(untestable_finding(search, *effect, reason));
  }
  for (std::size_t k = 0; k < out.size(); ++k) out[k].rank = static_cast<int>(k) + 1;
  return out;
}

}  // namespace lvcalib
