// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QMainWindow>
#include <QPointer>
#include <memory>
#include <optional>

#include "base/error.h"
#include "dialogs/choices.h"
#include "models/scene_model.h"
#include "recording/import.h"
#include "runner/model_work.h"
#include "runner/preview_work.h"
#include "runner/scene_data.h"
#include "runner/watch_work.h"
#include "runner/workspace.h"
#include "start/app_settings.h"
#include "words/quality_text.h"

namespace lvcalib::widgets {

class DemoTour;
class ErrorDialog;
class FilesDialog;
class GuideDialog;
class ImportDialog;
class LogDock;
class MainActions;
class PageStack;
class ParametersDock;
class ResultActions;
class ScenesDock;
class StatusLine;
class WatchWindow;

/// The window: puts the parts together and connects them, nothing else.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  /// `settings` and `choices` must outlive the window.
  MainWindow(AppSettings& settings, Choices& choices, QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens a dataset folder or a project file, after asking about unsaved decisions; of a recording
  /// the dialog that makes a dataset of it.
  void open(const QString& path);
  /// The truth of a simulation, for whatever is opened; without it, NAME-truth.json beside a
  /// dataset NAME is taken where it is there.
  void set_truth(const QString& path) { truth_path_ = path; }
  /// What the demo simulates; tests take something smaller.
  void set_demo(const simulation::SimulationOptions& options) { demo_ = options; }
  /// Offers decisions that an earlier program did not save.
  void offer_recovery();

  [[nodiscard]] Workspace& workspace() { return *workspace_; }
  [[nodiscard]] ModelWork& model_work() { return *model_work_; }
  [[nodiscard]] WatchWork& watch_work() { return *watch_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void connect_actions();
  void connect_docks();
  void connect_workspace();
  void connect_pages();
  void connect_preview();
  void connect_results();
  void connect_model();
  void connect_import();
  void connect_watch();
  void watch_files(bool wanted);
  void show_watch_window();
  void take_new_scenes();
  void compare();
  void check();
  void plan_scenes();
  void import_recording(const QString& path);
  void import_files(const QString& folder);
  void take_imported(const QString& dataset, const ImportSummary& summary);
  bool calibrate_new(const QString& dataset);
  void read_truth_of(const Dataset& dataset);
  void add_scenes(const QStringList& folders);
  void start_tour();
  void restore_window();
  bool may_drop_decisions();
  bool save(bool ask_for_path);
  ErrorDialog* show_error(const Error& error);
  void show_failed(const Error& error);
  void take_opened();
  void take_result();
  void show_result();
  void show_quality();
  void look_at(const QString& scene);
  void update_actions();
  void update_title();
  /// The calibration with the model's effects, or as it was run.
  [[nodiscard]] std::shared_ptr<const CalibrationResult> final_result() const;
  /// What the verdict on it rests on.
  [[nodiscard]] Standing standing() const;
  [[nodiscard]] QString scene_name(int index) const;
  [[nodiscard]] int scene_index(const QString& name) const;

  AppSettings& settings_;
  Choices& choices_;
  simulation::SimulationOptions demo_;
  std::unique_ptr<Workspace> workspace_;
  std::unique_ptr<ModelWork> model_work_;
  std::unique_ptr<PreviewWork> preview_;
  std::unique_ptr<WatchWork> watch_;
  SceneLoader loader_;
  SceneModel model_;
  QString scene_;  // The one looked at.
  QString truth_path_;
  QString folder_wanted_;  // The last one that was to be opened as a dataset.
  MainActions* actions_ = nullptr;
  ScenesDock* scenes_;
  ParametersDock* parameters_;
  LogDock* log_;
  PageStack* pages_;
  StatusLine* status_;
  ResultActions* results_;
  DemoTour* tour_ = nullptr;
  QPointer<ImportDialog> import_;
  QPointer<FilesDialog> files_;
  QPointer<WatchWindow> watch_window_;
  QPointer<GuideDialog> guide_;
  // Once the dataset that is being made of these is open: where to look, and what it holds already.
  std::optional<PairOptions> watch_next_;
  QStringList watch_known_;
  bool watch_imported_ = false;   // What is imported from files next is to be watched.
  bool scenes_preview_ = false;   // The last look ahead was at scenes left out.
  bool demo_opening_ = false;     // What opens next is the demo.
  bool run_when_opened_ = false;  // What opens next is to be calibrated at once.
};

}  // namespace lvcalib::widgets
