// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace lvcalib::widgets {

/// Has memory that was used go back to the system at once, for a process that stays open for hours:
/// clouds, images and tables are large and short-lived, and every thread would keep some of what
/// it once held. To be called before any worker starts.
void give_memory_back();

}  // namespace lvcalib::widgets
