// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// What a column of a cloud file may mean to us.
enum Role : std::size_t { kX, kY, kZ, kIntensity, kTime, kLine, kRoleCount };

/// For each role the index of the field that has it, or −1.
using RoleFields = std::array<int, kRoleCount>;

/// Assigns roles to the fields of a file by name. Case does not matter, nor does CloudCompare's
/// prefix "scalar_". Among several candidates the name listed first wins, so that `intensity` is
/// preferred to `reflectivity`; among equal names the first field. Error without x, y or z.
Result<RoleFields> assign_roles(const std::vector<std::string>& names, const std::string& where);

/// "x", "intensity", … for messages.
std::string_view role_name(Role role);

}  // namespace lvcalib
