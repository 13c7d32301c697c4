// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "base/message.h"

namespace lvcalib {

/// A cloud's warning as it is said of the scene that the cloud belongs to, wherever one is read.
inline Message about_cloud(const std::string& scene, const Message& warning) {
  return Message("scene %1: its cloud: %2", scene, warning);
}

}  // namespace lvcalib
