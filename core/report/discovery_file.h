// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"
#include "selection/discovery.h"

namespace lvcalib {

/// The text of discovery.json (keys: see resources/guide/effects.md). Parameters in their display
/// units.
std::string discovery_as_json(const Discovery& discovery);

/// A summary that a technician understands: what was found, how sure, what it does to the
/// extrinsic, what is left, what to do next.
std::string discovery_summary(const Discovery& discovery);

/// Writes discovery.json and discovery.txt into a folder, each atomically.
Status write_discovery(const Discovery& discovery, const std::filesystem::path& folder);

}  // namespace lvcalib
