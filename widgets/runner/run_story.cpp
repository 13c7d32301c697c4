// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/run_story.h"

#include <QCoreApplication>
#include <QStringList>

namespace lvcalib::widgets {
namespace {

bool same_guess(const std::optional<Rigid3>& a, const std::optional<Rigid3>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->matrix() == b->matrix();
}

// Everything that has changed since the last whole run.
QStringList reasons(const SessionState& before, const SessionRun& run) {
  if (!before.whole) return {QCoreApplication::translate("RunStory", "first run, or asked for")};
  if (run.solved_only)
    return {QCoreApplication::translate("RunStory",
                                        "the scenes in use or options of the solve changed")};
  const CalibrationRequest& a = before.request;
  const CalibrationRequest& b = run.state.request;
  QStringList out;
  if (!same_options(a.options, b.options))
    out << QCoreApplication::translate("RunStory", "options changed");
  if (before.scene_names != run.state.scene_names)
    out << QCoreApplication::translate("RunStory", "scenes were added or removed");
  if (a.rejected != b.rejected || a.insisted != b.insisted)
    out << QCoreApplication::translate("RunStory", "the scenes in use changed");
  if (a.crop_boxes != b.crop_boxes || a.use_crops != b.use_crops)
    out << QCoreApplication::translate("RunStory", "crops changed");
  if (a.edits != b.edits)
    out << QCoreApplication::translate("RunStory", "what is left out by hand changed");
  if (!same_guess(a.guess, b.guess))
    out << QCoreApplication::translate("RunStory", "the rough extrinsic changed");
  if (out.isEmpty())
    out << QCoreApplication::translate("RunStory", "it was asked for, or files changed");
  return out;
}

}  // namespace

QString run_story(const SessionState& before, const SessionRun& run) {
  const StageTimes& times = run.state.latest->times;
  struct Stage {
    QString name;
    double ms;
  };
  // A stage that only takes what was kept takes no time of its own.
  const Stage features[] = {
      {QCoreApplication::translate("RunStory", "images"), times.detect_ms},
      {QCoreApplication::translate("RunStory", "search in the clouds"), times.localize_ms},
      {QCoreApplication::translate("RunStory", "refinement"), times.refine_ms}};
  constexpr double kNothing_ms = 1.0;
  QStringList ran;
  QStringList kept;
  const auto took = [&](const QString& name, double ms) {
    ran << QCoreApplication::translate("RunStory", "%1 %2 s").arg(name).arg(1e-3 * ms, 0, 'f', 2);
  };
  for (const Stage& stage : features) {
    if (run.solved_only || stage.ms < kNothing_ms) {
      kept << stage.name;
    } else {
      took(stage.name, stage.ms);
    }
  }
  took(QCoreApplication::translate("RunStory", "joint solve"), times.optimize_ms);
  QString text = QCoreApplication::translate("RunStory", "Ran (%1): %2.")
                     .arg(reasons(before, run).join(QStringLiteral("; ")))
                     .arg(ran.join(QCoreApplication::translate("RunStory", ", ")));
  if (!kept.isEmpty())
    text += QLatin1Char(' ') + QCoreApplication::translate("RunStory", "Kept: %1.")
                                   .arg(kept.join(QCoreApplication::translate("RunStory", ", ")));
  return text;
}

}  // namespace lvcalib::widgets
