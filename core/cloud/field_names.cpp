// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/field_names.h"

#include <algorithm>

namespace lvcalib {
namespace {

const std::array<std::vector<std::string_view>, kRoleCount>& known_names() {
  static const std::array<std::vector<std::string_view>, kRoleCount> names = {{
      {"x"},
      {"y"},
      {"z"},
      {"intensity", "intensities", "reflectivity", "reflectance", "remission", "i"},
      {"time", "t", "timestamp", "time_stamp", "offset_time", "time_offset", "gps_time", "gpstime"},
      {"line", "ring", "channel", "ring_id", "laser_id"},
  }};
  return names;
}

std::string plain_name(std::string_view name) {
  std::string plain(name);
  // Not std::tolower: it follows the locale.
  std::transform(plain.begin(), plain.end(), plain.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  constexpr std::string_view prefix = "scalar_";
  if (plain.size() > prefix.size() && plain.starts_with(prefix)) plain.erase(0, prefix.size());
  return plain;
}

}  // namespace

Result<RoleFields> assign_roles(const std::vector<std::string>& names, const std::string& where) {
  std::vector<std::string> plain;
  plain.reserve(names.size());
  std::transform(names.begin(), names.end(), std::back_inserter(plain), plain_name);

  RoleFields fields;
  fields.fill(-1);
  for (std::size_t role = 0; role < kRoleCount; ++role) {
    for (const std::string_view candidate : known_names()[role]) {
      const auto found = std::find(plain.begin(), plain.end(), candidate);
      if (found == plain.end()) continue;
      fields[role] = static_cast<int>(found - plain.begin());
      break;
    }
  }
  for (const Role role : {kX, kY, kZ}) {
    if (fields[role] >= 0) continue;
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : " ") + name;
    return Error::input(Message("has no field '%1'; expected x y z, found: %2", role_name(role),
                                list.empty() ? Message("none") : Message::verbatim(list)),
                        where);
  }
  return fields;
}

std::string_view role_name(Role role) {
  return known_names()[role].front();
}

}  // namespace lvcalib
