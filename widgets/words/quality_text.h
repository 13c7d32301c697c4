// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

/// What a search has found to be missing in the model whose quality is told.
enum class Missing {
  kNothing,  ///< Or nothing that matters.
  kSomething,
  kSought,     ///< The search is still going on.
  kNotSought,  ///< There was no search, or it came to no end.
};

/// What the verdict on a result rests on besides the result.
struct Standing {
  Missing missing = Missing::kNotSought;
  bool up_to_date = true;  ///< False: of older decisions, or of a model that is not in force.
  bool operator==(const Standing&) const = default;
};

/// A result's quality as it can be told now.
struct ToldQuality {
  Quality quality = Quality::kFailed;  ///< What is missing makes a good result doubtful.
  bool open = false;                   ///< It is out of date, or good only as far as is known.
  QString words;                       ///< "good so far; still looking for what is missing"
};

/// A result is called good, without more, only where nothing is missing in its model.
ToldQuality told_quality(const CalibrationResult& result, const Standing& standing);

}  // namespace lvcalib::widgets
