// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QStringList>
#include <QTimer>
#include <QUndoStack>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "pipeline/project_file.h"
#include "pipeline/session.h"
#include "report/frame_names.h"
#include "runner/autosave.h"
#include "runner/decision_command.h"
#include "runner/runner.h"
#include "simulation/simulation_options.h"

namespace lvcalib::widgets {

/// What is open: a dataset, the user's decisions about it (undoable), its results and the runs
/// that make them. Long work runs in a worker thread; everything here is called and signalled in
/// the interface thread. Once there is a result, a changed decision brings it up to date by itself.
class Workspace : public QObject {
  Q_OBJECT

 public:
  /// How long changes of options are collected before they run.
  static constexpr int kSettleMs = 300;

  /// `data_folder`: where autosaves and the demo go.
  explicit Workspace(const QString& data_folder, QObject* parent = nullptr);
  ~Workspace() override;

  [[nodiscard]] bool is_open() const { return !dataset_.path.empty(); }
  [[nodiscard]] const Dataset& dataset() const { return dataset_; }
  [[nodiscard]] const Decisions& decisions() const { return decisions_; }
  /// Scenes that the project decides about and that are not on disk.
  [[nodiscard]] const QStringList& missing_scenes() const { return missing_; }
  /// Null before the first run.
  [[nodiscard]] std::shared_ptr<const CalibrationResult> result() const { return state_.latest; }
  /// What the last runs left, for looks ahead.
  [[nodiscard]] const SessionState& state() const { return state_; }
  /// True if the result answers the present decisions.
  [[nodiscard]] bool up_to_date() const { return up_to_date_; }
  [[nodiscard]] QString project_path() const { return project_path_; }
  [[nodiscard]] bool dirty() const { return dirty_; }
  /// Reading, simulating or calibrating.
  [[nodiscard]] bool busy() const { return runner_.running(); }
  [[nodiscard]] QUndoStack& undo_stack() { return undo_; }
  [[nodiscard]] Project project() const;
  /// What the user calls the frames of this rig, which the project keeps.
  [[nodiscard]] FrameNames frames() const { return frames_; }
  /// Names for a project that has none.
  void set_default_frames(const FrameNames& names) { default_frames_ = names; }
  /// A word about exports: no step to undo, and kept with the project.
  void set_frames(const FrameNames& names);
  /// What was done to the model of effects, in order; part of the project.
  [[nodiscard]] const std::vector<ModelDecision>& model() const { return model_; }
  /// To be called by commands on the undo stack.
  void set_model(std::vector<ModelDecision> model) { model_ = std::move(model); }

  /// Opens in the background; opened(), dataset_moved() or failed() follows.
  void open_dataset(const QString& path);
  void open_project(const QString& path);
  /// Opens what an autosave held; it counts as unsaved. The old autosave goes once there is a new
  /// one.
  void open_recovery(const Recovery& recovery);
  /// After dataset_moved(): opens the same project with its dataset elsewhere.
  void open_moved(const QString& dataset_path);
  /// Simulates the demo and opens it.
  void open_demo(const simulation::SimulationOptions& options);
  /// Saves the project; it then belongs to that file.
  Status save(const QString& path);

  /// Undoable decisions.
  void set_use(const QStringList& scenes, bool use);
  /// Uses scenes that the program refused all the same, or no longer.
  void set_insist(const QStringList& scenes, bool insist);
  /// What is left out by hand, or used all the same, of these scenes.
  void set_edits(const std::map<QString, SceneEdits>& edits);
  /// Words about a scene, which change no result.
  void set_note(const QString& scene, const QString& note);
  /// In which order scenes are listed; changes no result.
  void set_scene_order(const QStringList& scenes);
  void set_crop(const QString& scene, const std::optional<CropBox>& box);
  /// The value must lie in the option's range.
  void set_option(const OptionDeclaration& option, double value);
  void reset_options();
  void set_use_crops(bool use);
  /// A rough T_camera_lidar, which narrows the search for the board; nothing: rig.yaml's, or none.
  void set_guess(const std::optional<Rigid3>& camera_from_lidar);
  /// Errors as add_scenes() of the session; nothing is added then.
  Status add_scene_folders(const QStringList& folders);

  /// Scene folders that have appeared in the dataset since it was opened, or are complete now. No
  /// decision: opening the dataset again would find them too. Runs at once; scenes_appeared()
  /// comes before. Errors as add_scenes() of the session; nothing is taken then.
  Status take_new_scenes(const QStringList& folders);

  /// Reads what is open again from disk: images or camera.yaml have changed there. No decision, and
  /// a result is brought up to date. Errors as open_dataset(); all stays as it is then.
  Status reread();

  /// Runs what is not up to date.
  void run();
  /// Runs all stages of these scenes again.
  void run_again(const QStringList& scenes);
  void cancel();

 Q_SIGNALS:
  void opened();
  /// The project's dataset is not at `path` any more.
  void dataset_moved(const QString& path);
  /// The dataset has more scenes; those before it are the same.
  void scenes_appeared(const QStringList& scenes);
  void decisions_changed();
  void dirty_changed(bool dirty);
  void run_started();
  void progressed(const QString& stage, double fraction, const QString& text);
  /// Live: the points that a scene's refinement is about to work on.
  void board_found(int scene, const std::shared_ptr<const lvcalib::Cloud>& board_points);
  /// Live: a scene's refinement after one more iteration.
  void iterated(int scene, const std::shared_ptr<const lvcalib::BoardRefinement>& partial);
  void result_changed();
  /// A run of any kind has ended; `message` says how, in a line.
  void run_ended(const QString& message);
  /// Something could not be done. `modest`: only a solve after a scene was taken out.
  void failed(const lvcalib::Error& error, bool modest);
  void logged(const QString& line);

 private:
  struct Opening;
  void start(const Runner::Work& work);
  void open_in_background(const Runner::Work& work);
  void take_opened(Opening opening);
  void take_run(SessionRun run);
  void decide(DecisionCommand::Words words, Decisions after, const QString& merge_key = {});
  void apply(const Decisions& decisions);
  void schedule(int delay_ms);
  void bring_up_to_date();
  void set_dirty(bool dirty);
  void keep_or_clear_autosave();

  QString data_folder_;
  Dataset dataset_;
  Decisions decisions_;
  std::vector<ModelDecision> model_;
  FrameNames frames_;
  FrameNames default_frames_;
  bool unsaved_frames_ = false;
  QStringList missing_;
  QString project_path_;
  std::unique_ptr<Opening> waiting_;  // A project whose dataset has moved.
  std::optional<Recovery> taken_up_;  // Its file is still the only copy.
  SessionState state_;
  bool up_to_date_ = false;
  bool dirty_ = false;
  bool unsaved_recovery_ = false;
  QUndoStack undo_;
  QTimer settle_;
  Autosave autosave_;
  Runner runner_;  // Last: abandoned before what it uses goes.
};

}  // namespace lvcalib::widgets
