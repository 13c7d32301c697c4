// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"

namespace lvcalib::cli {

/// Refuses to write onto a file that is read: what was measured would be gone for good.
inline Status refuse_overwriting(const std::string& output, const std::string& input) {
  std::error_code code;
  if (!std::filesystem::equivalent(output, input, code) || code) return Done{};
  return Error::usage(Message("the output is the input itself"), output,
                      Message("give another name with -o"));
}

}  // namespace lvcalib::cli
