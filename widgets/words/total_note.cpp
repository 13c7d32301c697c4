// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/total_note.h"

#include <QCoreApplication>

#include "report/stored_model.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

QString total_note(const CalibrationResult& result) {
  QString text = core_text(total_uncertainty_note());
  const bool to_come = !result.model.empty() && result.budget.empty();
  if (to_come)
    text += QLatin1Char(' ') +
            QCoreApplication::translate(
                "CoreWords",
                "These totals are still the base model's: this model's follow once the effects "
                "that it may lack have been looked for.");
  return text;
}

}  // namespace lvcalib::widgets
