// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/edits_text.h"

#include <QCoreApplication>
#include <QStringList>
#include <vector>

namespace lvcalib::widgets {
namespace {

struct EditsText {
  Q_DECLARE_TR_FUNCTIONS(EditsText)
};

}  // namespace

QString ids_text(const std::vector<int>& ids) {
  QStringList texts;
  for (const int id : ids) texts << QString::number(id);
  return texts.join(QStringLiteral(", "));
}

QString edits_text(const SceneResult& scene) {
  const SceneEdits& edits = scene.edits;
  QStringList out;
  if (scene.left_out_points.size() > 0) {
    out << EditsText::tr("%n points", nullptr, static_cast<int>(scene.left_out_points.size()));
  }
  if (!edits.tags.empty()) out << EditsText::tr("tags %1").arg(ids_text(edits.tags));
  if (!edits.circles.empty()) out << EditsText::tr("circles %1").arg(ids_text(edits.circles));
  QStringList all;
  if (!out.isEmpty())
    all << EditsText::tr("Left out by hand: %1.").arg(out.join(QStringLiteral(", ")));
  QStringList kept;
  if (!edits.kept_tags.empty()) kept << EditsText::tr("tags %1").arg(ids_text(edits.kept_tags));
  if (!edits.kept_circles.empty())
    kept << EditsText::tr("circles %1").arg(ids_text(edits.kept_circles));
  if (!kept.isEmpty())
    all << EditsText::tr("Used all the same: %1.").arg(kept.join(QStringLiteral(", ")));
  return all.join(QLatin1Char(' '));
}

}  // namespace lvcalib::widgets
