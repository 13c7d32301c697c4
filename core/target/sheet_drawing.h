// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "target/sheet.h"

// Drawing in terms of Cairo, without its header: only sheet*.cpp files include it.
extern "C" {
typedef struct _cairo cairo_t;  // NOLINT: Cairo's own name
}

namespace lvcalib {

/// All values of target.yaml on one line.
std::string sheet_parameters(const Target& target);

/// Draws one page with the current source as ink; user units must be millimetres from the page's
/// top-left corner. False if stopped.
bool draw_sheet_page(cairo_t* cairo, const Target& target, const SheetLayout& layout, int row,
                     int column, const RunContext& context);

}  // namespace lvcalib
