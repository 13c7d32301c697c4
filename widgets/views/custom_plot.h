// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// QCustomPlot's header relies on Qt's short keywords, which this project switches off.
#ifdef QT_NO_KEYWORDS
#define signals Q_SIGNALS
#define slots Q_SLOTS
#define foreach(variable, container) for (variable : container)
#include <qcustomplot.h>
#undef signals
#undef slots
#undef foreach
#else
#include <qcustomplot.h>
#endif
