// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "target/target.h"

namespace lvcalib {

/// As read_target(), of a text that is no file yet; `name` stands for the file in messages.
Result<TargetFile> target_from_text(std::string text, const std::string& name);

}  // namespace lvcalib
