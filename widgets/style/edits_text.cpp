// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/edits_text.h"

#include <QCoreApplication>
#include <QStringList>
#include <vector>

#include "pipeline/refusals.h"

namespace lvcalib::widgets {
namespace {

struct EditsText {
  Q_DECLARE_TR_FUNCTIONS(EditsText)
};

// Nearly always one, and English has no catalogue that would tell one from many.
QString parts_text(int count) {
  return count == 1 ? EditsText::tr("a part of the board")
                    : EditsText::tr("%n parts of the board", nullptr, count);
}

}  // namespace

QString ids_text(const std::vector<int>& ids) {
  QStringList texts;
  for (const int id : ids) texts << QString::number(id);
  return texts.join(EditsText::tr(", "));
}

QString kept_text(const SceneEdits& edits) {
  QStringList kept;
  if (!edits.kept_tags.empty()) kept << EditsText::tr("tag no. %1").arg(ids_text(edits.kept_tags));
  if (!edits.kept_circles.empty())
    kept << EditsText::tr("circle no. %1").arg(ids_text(edits.kept_circles));
  if (!edits.kept_patches.empty()) kept << parts_text(static_cast<int>(edits.kept_patches.size()));
  if (kept.isEmpty()) return {};
  return EditsText::tr("Used all the same: %1.").arg(kept.join(EditsText::tr(", ")));
}

QString edits_text(const SceneResult& scene) {
  const SceneEdits& edits = scene.edits;
  QStringList out;
  if (scene.left_out_points.size() > 0) {
    out << EditsText::tr("%n points", nullptr, static_cast<int>(scene.left_out_points.size()));
  }
  if (!edits.tags.empty()) out << EditsText::tr("tag no. %1").arg(ids_text(edits.tags));
  if (!edits.circles.empty()) out << EditsText::tr("circle no. %1").arg(ids_text(edits.circles));
  QStringList all;
  if (!out.isEmpty())
    all << EditsText::tr("Left out by hand: %1.").arg(out.join(EditsText::tr(", ")));
  if (const QString kept = kept_text(edits); !kept.isEmpty()) all << kept;
  return all.join(QLatin1Char(' '));
}

QString refusals_text(const CalibrationResult& result, const std::string& scene) {
  std::vector<int> tags;
  std::vector<int> circles;
  std::size_t points = 0;
  int parts = 0;
  for (const Refusal& refusal : refusals(result)) {
    if (refusal.scene != scene) continue;
    if (refusal.what == Refusal::What::kTag) tags.push_back(refusal.id);
    if (refusal.what == Refusal::What::kCircle) circles.push_back(refusal.id);
    parts += refusal.what == Refusal::What::kPatch;
    if (refusal.what == Refusal::What::kPoints || refusal.what == Refusal::What::kPatch)
      points += refusal.points;
  }
  QStringList out;
  if (parts > 0) out << parts_text(parts);
  if (points > 0) out << EditsText::tr("%n points", nullptr, static_cast<int>(points));
  if (!tags.empty()) out << EditsText::tr("tag no. %1").arg(ids_text(tags));
  if (!circles.empty()) out << EditsText::tr("circle no. %1").arg(ids_text(circles));
  if (out.isEmpty()) return {};
  return EditsText::tr("Left out by the program: %1.").arg(out.join(EditsText::tr(", ")));
}

}  // namespace lvcalib::widgets
