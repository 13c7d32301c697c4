// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <string>
#include <vector>

#include "selection/proposals.h"

namespace lvcalib::widgets {

/// Words of the core library as the user's language has them.
QString channel_name(Channel channel);
/// Unit of a channel's residuals on an axis.
QString unit_text(Channel channel);
QString covariate_name(const std::string& name);
/// A category of a covariate ("print" 0: white); else the number.
QString category_name(const std::string& covariate, double value);
QString verdict_name(EffectVerdict verdict);
/// Title of an effect; its specification if it has none.
QString effect_title(const std::string& spec);

/// " mm", to be set behind a number; nothing of a number without a unit.
QString unit_behind(const std::string& unit);

/// A number to so many digits, and never as 1.7e+03: whole where it is large, "1.0·10⁻⁷" where it
/// is tiny, ∞ where it has no meaning but that.
QString plain_number(double value, int digits = 3);
/// "8.1 ± 0.1 mm"; "8.1 mm (held)".
QString value_text(const ParameterEstimate& parameter, bool held);
/// "a = 8.1 ± 0.1 mm, b = …", the first few.
QString values_text(const std::vector<ParameterEstimate>& parameters, bool held);
/// "1.3 mm, 0.2 mrad".
QString move_text(double mm, double mrad);

/// The rules that an effect had to pass, one by one, as HTML: which hold, value and threshold, and
/// whether it matters. Empty if nobody asked.
QString criteria_html(const EffectProposal& proposal);

/// A step of the history in a few words: "base", "+ Range walk"; in brackets if nothing came of it.
QString step_text(const ModelStep& step);

}  // namespace lvcalib::widgets
