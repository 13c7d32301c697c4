// SPDX-License-Identifier: GPL-3.0-or-later
#include "words/quality_text.h"

#include <QCoreApplication>

namespace lvcalib::widgets {
namespace {

QString word_of(Quality quality) {
  switch (quality) {
    case Quality::kGood:
      return QCoreApplication::translate("CoreWords", "good");
    case Quality::kDoubtful:
      return QCoreApplication::translate("CoreWords", "doubtful");
    case Quality::kFailed:
      break;
  }
  return QCoreApplication::translate("CoreWords", "failed");
}

}  // namespace

ToldQuality told_quality(const CalibrationResult& result, const Standing& standing) {
  ToldQuality out;
  out.quality = result.quality == Quality::kGood && standing.missing == Missing::kSomething
                    ? Quality::kDoubtful
                    : result.quality;
  out.words = word_of(out.quality);
  // Until it is known what is missing, a good result is neither good nor doubtful.
  const bool unasked = out.quality == Quality::kGood && standing.missing != Missing::kNothing;
  out.open = unasked || !standing.up_to_date;
  if (!standing.up_to_date) {
    out.words = QCoreApplication::translate("CoreWords", "%1 (out of date)").arg(out.words);
  } else if (unasked && standing.missing == Missing::kSought) {
    out.words =
        QCoreApplication::translate("CoreWords", "good so far; still looking for what is missing");
  } else if (unasked) {
    out.words = QCoreApplication::translate("CoreWords",
                                            "good so far; nobody has looked for what is missing");
  }
  return out;
}

}  // namespace lvcalib::widgets
