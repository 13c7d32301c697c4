// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "model/effect.h"

namespace lvcalib {

/// Errors of all twelve intrinsics (fx fy cx cy and eight distortion entries), each by itself. Not
/// an effect to be found: what a solve that holds the intrinsics leaves out.
EffectPtr camera_intrinsics();

}  // namespace lvcalib
