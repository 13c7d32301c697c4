// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/model_work.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "pipeline/model_discovery.h"
#include "runner/workspace.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

std::string key_of(const std::vector<ModelDecision>& decisions) {
  std::string key;
  for (const ModelDecision& d : decisions) {
    key += std::to_string(static_cast<int>(d.change)) + '\t' + d.spec;
    for (const double value : d.values) key += formatted("\t%a", value);
    key += '\n';
  }
  return key;
}

constexpr char kContext[] = "lvcalib::widgets::ModelWork";

// An effect by its title; a formula or curve as it was entered.
DescribedCommand::Words words_of(const char* text, const std::string& spec) {
  return {text, {}, effect_named(spec)};
}

}  // namespace

std::vector<ModelDecision> ModelWork::Place::in_force() const {
  return {decisions.begin(), decisions.begin() + static_cast<std::ptrdiff_t>(current)};
}

// A change of the model; steps are kept elsewhere, so going back and forth only shows others.
class ModelWork::Command : public DescribedCommand {
 public:
  Command(ModelWork& work, const Words& words, Place after)
      : DescribedCommand(kContext, words),
        work_(work),
        before_(work.place_),
        after_(std::move(after)) {}
  void undo() override { work_.turn_to(before_); }
  void redo() override { work_.turn_to(after_); }

 private:
  ModelWork& work_;
  Place before_;
  Place after_;
};

ModelWork::ModelWork(Workspace& workspace, QObject* parent)
    : QObject(parent), workspace_(workspace) {
  connect(&workspace_, &Workspace::opened, this, &ModelWork::take_workspace);
  connect(&workspace_, &Workspace::result_changed, this, [this] {
    if (workspace_.result() == source_) return;
    forget();
    start();
    search_with_.clear();
  });
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString& stage, double fraction, const QString& text) {
            Q_EMIT progressed(stage, fraction, text);
          });
  connect(&runner_, &Runner::finished, this, [this] { Q_EMIT ended(QString()); });
  connect(&runner_, &Runner::cancelled, this, [this] { Q_EMIT ended(tr("Cancelled")); });
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Runner::unexpected(message, {}, Message("the model is as it was; try again")));
    Q_EMIT ended(tr("Failed"));
  });
}

ModelStepPtr ModelWork::step() const {
  return place_.current < steps_.size() ? steps_[place_.current] : nullptr;
}

std::shared_ptr<const ModelRanking> ModelWork::ranking() const {
  const auto at = rankings_.find(key_of(place_.in_force()));
  return at == rankings_.end() ? nullptr : at->second;
}

bool ModelWork::can_start() const {
  return workspace_.result() != nullptr;
}

bool ModelWork::behind() const {
  if (!busy_at_all()) return false;
  // A step with no effect in use is the calibration itself.
  const bool has_effects = step() ? !step()->in_use().empty() : place_.current > 0;
  if (!result_) return has_effects;
  return result_key_ != key_of(place_.in_force());
}

std::shared_ptr<const Discovery> ModelWork::discovery() const {
  std::vector<ModelStepPtr> made;
  for (std::size_t k = 0; k <= place_.current && k < steps_.size(); ++k) {
    if (steps_[k]) made.push_back(steps_[k]);
  }
  if (made.empty() || made.back() != step()) return nullptr;
  return std::make_shared<const Discovery>(as_discovery(made, ranking().get()));
}

void ModelWork::take_workspace() {
  search_with_.clear();
  told_.clear();
  place_ = {workspace_.model(), workspace_.model().size()};
  forget();
}

void ModelWork::forget() {
  // What it makes belongs to what is forgotten, and another may start at once.
  const bool ran = runner_.running();
  runner_.abandon();
  results_.abandon();
  source_ = nullptr;
  made_.clear();
  rankings_.clear();
  fresh_ = {};
  base_ = nullptr;
  take_result(nullptr);
  update_steps();
  Q_EMIT changed();
  Q_EMIT ranking_changed();
  Q_EMIT result_changed();
  if (ran) Q_EMIT ended(tr("Cancelled"));
}

void ModelWork::start() {
  if (!workspace_.result() || runner_.running()) return;
  if (source_ == workspace_.result() && step()) {
    if (!ranking()) rank();
    return;
  }
  run(place_, {});
}

ModelStepPtr ModelWork::find(const std::vector<ModelDecision>& decisions) const {
  const auto at = made_.find(key_of(decisions));
  return at == made_.end() ? nullptr : at->second;
}

void ModelWork::keep(const std::vector<ModelDecision>& decisions, const ModelStepPtr& step) {
  made_[key_of(decisions)] = step;
}

void ModelWork::keep_ranking(const Key& key, ModelRanking ranking) {
  rankings_[key] = std::make_shared<const ModelRanking>(std::move(ranking));
  Q_EMIT ranking_changed();
  // "good" does not stand beside "something is missing", what is handed on has the budget, and the
  // total uncertainty of a model with effects is that with it.
  const auto shown = result_ ? result_ : source_;
  const auto missing = this->ranking();
  if (!missing) return;
  const bool judged = shown && missing->speaks_against_good() && shown->quality == Quality::kGood;
  const bool budgeted = shown && shown->budget.empty() && !missing->budget.empty();
  if (results_.running() || judged || budgeted) build_result();
}

void ModelWork::update_steps() {
  steps_.clear();
  if (made_.empty()) return;
  for (std::size_t k = 0; k <= place_.decisions.size(); ++k)
    steps_.push_back(find(
        {place_.decisions.begin(), place_.decisions.begin() + static_cast<std::ptrdiff_t>(k)}));
}

// Shows a place; what is missing of it is made in the background.
void ModelWork::arrive(const Place& place) {
  place_ = place;
  workspace_.set_model(place_.in_force());
  update_steps();
  Q_EMIT changed();
  Q_EMIT ranking_changed();
  if (step()) {
    build_result();
    return;
  }
  results_.abandon();
  take_result(nullptr);
  Q_EMIT result_changed();
  if (workspace_.result()) run(place_, {});
}

// Of the place that is shown.
void ModelWork::take_result(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  result_key_ = key_of(place_.in_force());
}

// By undo and redo. What is under way is of the place that is left: it would come back with it.
void ModelWork::turn_to(const Place& place) {
  if (pushing_) return arrive(place);
  runner_.cancel();
  arrive(place);
  if (step() && !ranking()) rank();
}

void ModelWork::push(Place place, const DescribedCommand::Words& words) {
  pushing_ = true;
  workspace_.undo_stack().push(new Command(*this, words, std::move(place)));
  pushing_ = false;
}

void ModelWork::decide(ModelDecision decision, const char* text) {
  if (!step() || !workspace_.result()) return;
  const DescribedCommand::Words words = words_of(text, decision.spec);
  Place goal{place_.in_force(), place_.current + 1};
  goal.decisions.push_back(std::move(decision));
  run(std::move(goal), words);
}

// Makes the steps up to a place that are not there yet, shows it (as a change of these words; none:
// it is decided already), and looks for what is missing there.
void ModelWork::run(Place goal, const DescribedCommand::Words& words) {
  const auto source = workspace_.result();
  // Again for another calibration, or as decided.
  Q_EMIT logged(words.source != nullptr
                    ? tr("Model: %1").arg(DescribedCommand(kContext, words).description())
                : source_ == source ? tr("Model: going to another step")
                                    : tr("Model: fitted again, as the calibration is another"));
  // Only what the scenes were awaited for: another calibration, and with them.
  const bool search =
      source_ != source && !search_with_.empty() &&
      std::all_of(search_with_.begin(), search_with_.end(), [&](const QString& scene) {
        return decision_of(workspace_.decisions(), scene.toStdString()).insist;
      });
  source_ = source;
  looking_ = false;
  runner_.start([this, source, goal, words, search, made = made_](
                    const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    const auto fail = [this](const Error& error) -> Runner::Deliver {
      if (error.kind == ErrorKind::kCancelled) return {};
      return [this, error] {
        Q_EMIT logged(core_text(error));
        Q_EMIT failed(error);
      };
    };
    std::vector<ModelStepPtr> steps;
    std::vector<ModelDecision> done;
    const std::vector<ModelDecision> wanted = goal.in_force();
    for (std::size_t k = 0; k <= wanted.size(); ++k) {
      if (k > 0) done.push_back(wanted[k - 1]);
      if (const auto at = made.find(key_of(done)); at != made.end() && at->second) {
        steps.push_back(at->second);
        continue;
      }
      auto next = k == 0
                      ? start_model(discovery_input(*source), discovery_options(*source), context)
                      : apply_decision(steps.back(), wanted[k - 1], context);
      if (!next && words.source == nullptr && k > 0 && next.error().kind != ErrorKind::kCancelled) {
        // Decided elsewhere, as by another version: said, kept as it is, and the rest goes on.
        post([this, error = next.error(), key = key_of({wanted[k - 1]})] {
          Q_EMIT logged(core_text(error));
          // Every calibration asks for it again; whoever opened the project has read it.
          if (told_.insert(key).second) Q_EMIT failed(error);
        });
        auto carried = std::make_shared<ModelStep>(*steps.back());
        carried->change = wanted[k - 1].change;
        carried->changed = wanted[k - 1].spec;
        carried->without_change = true;
        next = ModelStepPtr(std::move(carried));
      }
      if (!next) return fail(next.error());
      steps.push_back(*next);
      post([this, done, step = *next] { keep(done, step); });
    }
    // Before the search for what is missing: every page waits for it.
    auto result = result_at(source, steps);
    post([this, goal, words, search, key = key_of(wanted), result = std::move(result)] {
      fresh_ = {key, result};
      looking_ = !search;
      if (words.source == nullptr) {
        arrive(goal);
      } else {
        push(goal, words);
      }
    });
    if (search) return search_all(steps.back(), wanted, context, post);
    auto ranking = rank_effects(*steps.back(), context);
    if (!ranking) return fail(ranking.error());
    return [this, key = key_of(wanted), found = std::move(*ranking)] { keep_ranking(key, found); };
  });
  Q_EMIT started();
}

void ModelWork::rank() {
  const ModelStepPtr shown = step();
  if (!shown) return;
  looking_ = true;
  runner_.start([this, shown, key = key_of(place_.in_force())](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto ranking = rank_effects(*shown, context);
    if (!ranking) return {};
    return [this, key, found = std::move(*ranking)] { keep_ranking(key, found); };
  });
  Q_EMIT started();
}

void ModelWork::add(const QString& spec) {
  decide({ModelChange::kAdd, spec.toStdString(), {}}, QT_TR_NOOP("add %1"));
}

void ModelWork::remove(std::size_t k) {
  if (!step() || k >= step()->terms.size()) return;
  const std::string& spec = step()->terms[k].spec;
  decide({ModelChange::kRemove, spec, {}}, QT_TR_NOOP("remove %1"));
}

void ModelWork::set_on(std::size_t k, bool on) {
  if (!step() || k >= step()->terms.size() || step()->terms[k].on == on) return;
  const std::string& spec = step()->terms[k].spec;
  decide({on ? ModelChange::kSwitchOn : ModelChange::kSwitchOff, spec, {}},
         on ? QT_TR_NOOP("switch %1 on") : QT_TR_NOOP("switch %1 off"));
}

void ModelWork::hold(std::size_t k, const std::optional<Eigen::VectorXd>& values) {
  if (!step() || k >= step()->terms.size()) return;
  const std::string& spec = step()->terms[k].spec;
  ModelDecision decision{values ? ModelChange::kHold : ModelChange::kRelease, spec, {}};
  if (values) decision.values.assign(values->data(), values->data() + values->size());
  decide(std::move(decision), values ? QT_TR_NOOP("hold %1") : QT_TR_NOOP("fit %1 again"));
}

void ModelWork::find_all() {
  if (!step()) return;
  looking_ = false;
  search_with_.clear();
  runner_.start([this, from = step(), source = source_, decided = place_.in_force()](
                    const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    // Scenes that the solve refused may show best what is missing.
    DiscoveryOptions options = discovery_options(*source);
    for (const ModelTerm& term : from->terms) {
      if (term.on) options.with.push_back(term.spec);
    }
    const auto explained = explain_refused_scenes(*source, options, context);
    if (!explained) return {};
    if (!*explained) return search_all(from, decided, context, post);
    QStringList scenes;
    for (const std::string& scene : (*explained)->scenes) scenes << QString::fromStdString(scene);
    return [this, scenes, why = explanations(**explained)] {
      for (const Message& line : why) Q_EMIT logged(core_text(line));
      search_with_ = scenes;
      workspace_.set_insist(scenes, true);
    };
  });
  Q_EMIT started();
}

// Finds all from a step that these decisions made; in the worker's thread.
Runner::Deliver ModelWork::search_all(const ModelStepPtr& from,
                                      std::vector<ModelDecision> decisions,
                                      const RunContext& context, const Runner::Post& post) {
  ModelStepPtr last = from;
  const auto found = lvcalib::find_all(
      from,
      [&](const ModelStepPtr& next) {
        for (ModelDecision& d : decisions_between(*last, *next)) decisions.push_back(std::move(d));
        last = next;
        post([this, next, decisions] {
          keep(decisions, next);
          push({decisions, decisions.size()}, words_of(QT_TR_NOOP("add %1"), next->changed));
        });
      },
      context);
  if (!found) return {};
  auto ranking = rank_effects(**found, context);
  if (!ranking) return {};
  return
      [this, key = key_of(decisions), result = std::move(*ranking)] { keep_ranking(key, result); };
}

void ModelWork::go_to(std::size_t step) {
  if (step == place_.current || step > place_.decisions.size() || !this->step()) return;
  // Looking for what is missing where nobody stands any more would only keep the user waiting.
  runner_.cancel();
  push({place_.decisions, step}, {QT_TR_NOOP("go to step %1"), QString::number(step)});
  if (!ranking()) rank();
}

void ModelWork::cancel() {
  runner_.cancel();
}

// Copies the calibration with its clouds: not on the interface thread.
void ModelWork::build_result() {
  const auto found = discovery();
  const auto missing = ranking();
  const bool base = !found || found->model.empty();
  if (!source_ || (base && (!missing || base_))) {
    results_.abandon();
    take_result(base_);
    Q_EMIT result_changed();
    return;
  }
  const auto fresh = std::exchange(fresh_, {});
  const Key key = key_of(place_.in_force());
  if (!missing && fresh.second && fresh.first == key) {
    results_.abandon();
    take_result(fresh.second);
    Q_EMIT result_changed();
    return;
  }
  results_.start([this, source = source_, found, base](const RunContext&,
                                                       const Runner::Post&) -> Runner::Deliver {
    auto made = std::make_shared<const CalibrationResult>(with_model(*source, *found));
    return [this, made, base] {
      if (base) base_ = made;
      take_result(made);
      Q_EMIT result_changed();
    };
  });
  // Until it is there, what is shown is of another place: pages say so. The calibration itself is
  // there at once.
  if (result_ && result_key_ == key) return;
  if (!base) {
    Q_EMIT fell_behind();
  } else if (result_) {
    take_result(nullptr);
    Q_EMIT result_changed();
  }
}

}  // namespace lvcalib::widgets

#include "moc_model_work.cpp"
