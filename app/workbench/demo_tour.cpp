// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/demo_tour.h"

#include <QAction>
#include <QMainWindow>
#include <QTabBar>
#include <QTabWidget>
#include <QToolBar>
#include <utility>

#include "runner/model_work.h"
#include "runner/workspace.h"

namespace lvcalib::widgets {
namespace {

// A widget by name; null if it is not there.
std::function<QWidget*()> widget(QMainWindow& window, const char* name) {
  return [&window, name] { return window.findChild<QWidget*>(QString::fromLatin1(name)); };
}

// Several of them: what a text speaks of beside what it points at.
std::function<std::vector<QWidget*>()> widgets_named(QMainWindow& window,
                                                     std::vector<const char*> names) {
  return [&window, names = std::move(names)] {
    std::vector<QWidget*> out;
    for (const char* name : names)
      out.push_back(window.findChild<QWidget*>(QString::fromLatin1(name)));
    return out;
  };
}

}  // namespace

DemoTour::DemoTour(QMainWindow& window, Workspace& workspace, ModelWork& work)
    : QObject(&window),
      window_(window),
      workspace_(workspace),
      work_(work),
      marks_(new CoachMarks(&window)) {
  connect(marks_, &CoachMarks::ended, marks_, &QWidget::hide);
}

DemoTour::~DemoTour() {
  delete marks_;
}

void DemoTour::end() {
  marks_->end();
}

void DemoTour::start() {
  const auto run_button = [this]() -> QWidget* {
    auto* bar = window_.findChild<QToolBar*>(QStringLiteral("tool_bar"));
    auto* run = window_.findChild<QAction*>(QStringLiteral("run"));
    return bar == nullptr || run == nullptr ? nullptr : bar->widgetForAction(run);
  };
  const auto tab_bar = [this]() -> QWidget* {
    auto* tabs = window_.findChild<QTabWidget*>(QStringLiteral("pages"));
    return tabs == nullptr ? nullptr : tabs->tabBar();
  };
  const auto on_model_page = [this] {
    const auto* page = window_.findChild<QWidget*>(QStringLiteral("model_page"));
    return page != nullptr && page->isVisible();
  };
  marks_->start({
      {tr("These scenes were simulated just now, by a LiDAR with an error that the calibration "
          "does not know. Press <b>Run all</b>."),
       run_button, [this] { return workspace_.result() || workspace_.busy(); }},
      {tr("The calibration runs; what it is at stands below on the left. Meanwhile the window can "
          "be used: the <b>Refinement</b> page shows how the circles are found."),
       tab_bar,
       [this] { return workspace_.result() && !workspace_.busy(); },
       false,
       {},
       tr("The calibration has run. What it is at stands below on the left; meanwhile the window "
          "can be used. The <b>Refinement</b> page shows how the circles were found.")},
      {tr("The calibration is done. Below on the right stands how far it can be trusted, and the "
          "mouse over it says why. Open the <b>Model</b> page to ask what the model misses."),
       tab_bar, on_model_page},
      {tr("The effects that may be missing are being tried; scenes held out decide. The best one "
          "comes first, with a sentence on what was seen and how sure that is."),
       widget(window_, "proposals"), [this] { return work_.ranking() != nullptr; }, true,
       widgets_named(window_, {"proposal_text", "missing_verdict"}),
       tr("The effects that may be missing have been tried; scenes held out decided. The best one "
          "comes first, with a sentence on what was seen and how sure that is.")},
      {tr("The effect at the top of the list is the one that scenes held out speak for most. The "
          "orange curve is its pattern at the size found; the marks are what is measured."),
       widget(window_, "residual_plot"),
       {},
       false,
       widgets_named(window_, {"proposals"})},
      {tr("<b>Add</b> it to the model."), widget(window_, "add_proposal"),
       [this] { return work_.current() > 0; }, false,
       widgets_named(window_, {"proposals", "proposal_text"})},
      {tr("Red is what no effect explains, green what the model explains now; diamonds are scenes "
          "held out. The list on the left says by how much the extrinsic has moved. Click an "
          "earlier step or undo to compare."),
       widget(window_, "budget_plot"),
       {},
       false,
       widgets_named(window_, {"terms", "model_pose", "model_legend"})},
  });
}

}  // namespace lvcalib::widgets

#include "moc_demo_tour.cpp"
