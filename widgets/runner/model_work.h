// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/calibration.h"
#include "runner/decision_command.h"
#include "runner/runner.h"
#include "selection/proposals.h"

class QUndoStack;

namespace lvcalib::widgets {

class Workspace;

/// The model of effects of what is open: its steps, what is missing in it, and the work on it in a
/// worker thread. Steps are kept, so that going back and forth is free; every change is a command
/// on the workspace's undo stack and part of the project. Another calibration result takes the same
/// decisions again.
class ModelWork : public QObject {
  Q_OBJECT

 public:
  /// The workspace must outlive it.
  explicit ModelWork(Workspace& workspace, QObject* parent = nullptr);

  /// The base model and one step per decision, also those that were gone back from. Empty before
  /// the first fit; steps that are not made yet are null.
  [[nodiscard]] const std::vector<ModelStepPtr>& steps() const { return steps_; }
  /// The step shown; null if there is none.
  [[nodiscard]] ModelStepPtr step() const;
  [[nodiscard]] std::size_t current() const { return place_.current; }
  /// What is missing in the step shown; null as long as nobody has looked.
  [[nodiscard]] std::shared_ptr<const ModelRanking> ranking() const;
  [[nodiscard]] bool busy() const { return runner_.running(); }
  /// Busy, but only with what is missing in a step that is there: the user may go on to another.
  [[nodiscard]] bool looking() const { return busy() && looking_; }
  /// There is a calibration to fit the model to.
  [[nodiscard]] bool can_start() const;
  /// The calibration with the effects that are in force is still being made: what result() has are
  /// others, or none.
  [[nodiscard]] bool behind() const;

  /// The calibration with the effects shown in its model, and once it is known what is missing with
  /// its budget; null where that is the calibration as it was.
  [[nodiscard]] std::shared_ptr<const CalibrationResult> result() const { return result_; }
  /// The calibration that the steps were made from; null before the first fit.
  [[nodiscard]] std::shared_ptr<const CalibrationResult> source() const {
    return steps_.empty() ? nullptr : source_;
  }
  /// The steps up to the one shown and what is missing, for the report; null before the first fit.
  [[nodiscard]] std::shared_ptr<const Discovery> discovery() const;

  /// Fits what is not up to date and looks for what is missing; done by itself when a calibration
  /// is there. Does nothing without one.
  void start();
  /// Looks for what is missing in the step shown.
  void rank();
  void add(const QString& spec);
  void remove(std::size_t k);
  void set_on(std::size_t k, bool on);
  /// Values in SI; none: fitted again.
  void hold(std::size_t k, const std::optional<Eigen::VectorXd>& values);
  /// Adds what held-out scenes speak for, until nothing is missing. Scenes that were refused for
  /// contradicting the others are used all the same (a decision as the user's) if they agree with
  /// what is found with them: the search follows once the workspace has calibrated with them.
  void find_all();
  /// Goes to a step (0: the base model); what is under way is given up.
  void go_to(std::size_t step);
  void cancel();

 Q_SIGNALS:
  /// Steps or the one shown are others.
  void changed();
  void ranking_changed();
  void result_changed();
  /// The calibration with the effects that are in force is being made, see behind().
  void fell_behind();
  void started();
  void progressed(const QString& stage, double fraction, const QString& text);
  /// The work has ended; `message` says how, may be empty.
  void ended(const QString& message);
  void failed(const lvcalib::Error& error);
  void logged(const QString& line);

 private:
  class Command;
  /// Decisions and how many of them are in force.
  struct Place {
    std::vector<ModelDecision> decisions;
    std::size_t current = 0;
    [[nodiscard]] std::vector<ModelDecision> in_force() const;
  };
  using Key = std::string;

  [[nodiscard]] bool busy_at_all() const { return runner_.running() || results_.running(); }
  void take_workspace();
  void forget();
  void decide(ModelDecision decision, const char* text);
  void run(Place goal, const DescribedCommand::Words& words);
  Runner::Deliver search_all(const ModelStepPtr& from, std::vector<ModelDecision> decisions,
                             const RunContext& context, const Runner::Post& post);
  void arrive(const Place& place);
  void turn_to(const Place& place);
  void take_result(std::shared_ptr<const CalibrationResult> result);
  void push(Place place, const DescribedCommand::Words& words);
  void keep(const std::vector<ModelDecision>& decisions, const ModelStepPtr& step);
  void keep_ranking(const Key& key, ModelRanking ranking);
  void update_steps();
  void build_result();
  [[nodiscard]] ModelStepPtr find(const std::vector<ModelDecision>& decisions) const;

  Workspace& workspace_;
  std::shared_ptr<const CalibrationResult> source_;  // What the steps were made from.
  std::map<Key, ModelStepPtr> made_;
  std::map<Key, std::shared_ptr<const ModelRanking>> rankings_;
  std::vector<ModelStepPtr> steps_;
  std::shared_ptr<const CalibrationResult> result_;
  std::shared_ptr<const CalibrationResult> base_;  // Without effects, with the budget.
  Key result_key_;                                 // The decisions whose effects it has.
  // What a run made of its last step, for the place where it arrives.
  std::pair<Key, std::shared_ptr<const CalibrationResult>> fresh_;
  Place place_;
  bool looking_ = false;  // What runs is only the search for what is missing.
  bool pushing_ = false;  // A change of its own arrives, not the user's undo or redo.
  std::set<Key> told_;    // Decisions of what is open that cannot be made.
  // The next calibration, with these refused scenes in use, is searched to the end.
  QStringList search_with_;
  Runner results_;  // Makes the calibration with the model.
  Runner runner_;   // Last: abandoned before what it uses goes.
};

}  // namespace lvcalib::widgets
