// SPDX-License-Identifier: GPL-3.0-or-later
// The window's side of the Model page and of the demo's tour.
#include "docks/log_dock.h"
#include "modelling/model_page.h"
#include "words/core_text.h"
#include "workbench/demo_tour.h"
#include "workbench/main_actions.h"
#include "workbench/main_window.h"
#include "workbench/page_stack.h"
#include "workbench/result_actions.h"
#include "workbench/status_line.h"

namespace lvcalib::widgets {

void MainWindow::connect_model() {
  const ModelWork* work = model_work_.get();
  connect(work, &ModelWork::started, this, [this] {
    status_->show_progress({}, 0.0, {});
    show_quality();
    update_actions();
  });
  connect(work, &ModelWork::ranking_changed, this, &MainWindow::show_quality);
  connect(work, &ModelWork::progressed, status_, &StatusLine::show_progress);
  connect(work, &ModelWork::ended, this, [this](const QString& message) {
    if (!workspace_->busy()) status_->show_idle(message);
    show_quality();
    update_actions();
  });
  connect(work, &ModelWork::failed, this, [this](const Error& error) {
    // Too few scenes is no accident: the page says so.
    if (error.kind == ErrorKind::kUntrusted && model_work_->steps().empty()) {
      pages_->model_page()->setReason(error.sentence());
      status_->show_idle(core_text(error.message));
    } else {
      show_error(error);
    }
  });
  connect(work, &ModelWork::logged, log_, &LogDock::append);
  connect(work, &ModelWork::result_changed, this, &MainWindow::show_result);
  connect(work, &ModelWork::fell_behind, this, [this] {
    show_quality();
    update_actions();
  });
  connect(pages_->model_page(), &ModelPage::compareWanted, this, &MainWindow::compare);
}

std::shared_ptr<const CalibrationResult> MainWindow::final_result() const {
  return model_work_->result() ? model_work_->result() : workspace_->result();
}

Standing MainWindow::standing() const {
  const auto ranking = model_work_->ranking();
  const Missing missing = model_work_->busy()              ? Missing::kSought
                          : !ranking                       ? Missing::kNotSought
                          : ranking->speaks_against_good() ? Missing::kSomething
                                                           : Missing::kNothing;
  return {missing, workspace_->up_to_date() && !model_work_->behind()};
}

void MainWindow::show_quality() {
  const Standing now = standing();
  status_->show_quality(final_result(), now);
  pages_->set_standing(now);
  results_->follow(final_result(), now);
}

void MainWindow::compare() {
  results_->compare({final_result(), model_work_->source(), model_work_->steps(),
                     model_work_->current(), workspace_->dataset().scenes});
}

void MainWindow::check() {
  if (!workspace_->is_open()) return;
  const Dataset& dataset = workspace_->dataset();
  const auto& guess = workspace_->decisions().guess;
  results_->check(final_result(), dataset, guess ? guess : dataset.rough_camera_from_lidar,
                  guess.has_value());
}

// The pose of the model in force; the LiDAR by the scenes' measurements.
void MainWindow::plan_scenes() {
  PlanBasis basis;
  if (workspace_->is_open()) {
    const Dataset& dataset = workspace_->dataset();
    basis.target = dataset.target;
    basis.camera = dataset.camera;
    basis.rough_camera_from_lidar = dataset.rough_camera_from_lidar;
    basis.result = final_result();
    for (const SceneFiles& files : dataset.scenes) {
      if (basis.cloud.empty()) basis.cloud = files.cloud;
    }
  }
  results_->plan_scenes(basis);
}

void MainWindow::start_tour() {
  delete tour_;
  tour_ = new DemoTour(*this, *workspace_, *model_work_);
  tour_->start();
}

}  // namespace lvcalib::widgets
