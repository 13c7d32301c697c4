// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/cloud.h"

#include <algorithm>
#include <functional>
#include <new>
#include <stdexcept>

#include "cloud/input.h"
#include "cloud/readers.h"

namespace lvcalib {
namespace {

Result<Cloud> read(Input& input, PointChoice choice, std::uint64_t max_unpacked_bytes) {
  auto enough = input.require(4);
  if (!enough) return enough.error();
  if (input.remaining() == 0) return input.error(Message("is empty, expected a PCD or PLY file"));
  const std::string_view start = input.rest();
  try {
    if (start.starts_with("ply")) return read_ply(input, choice);
    // A PCD file starts with a comment or with one of its header's entries.
    for (const std::string_view sign : {"#", "VERSION", "FIELDS", "COLUMNS", "\r", "\n"}) {
      if (start.starts_with(sign)) return read_pcd(input, choice, max_unpacked_bytes);
    }
  } catch (const std::bad_alloc&) {
    return input.error(Message("does not fit into memory"));
  } catch (const std::length_error&) {
    return input.error(Message("does not fit into memory"));
  }
  return input.error(Message("is neither a PCD nor a PLY file"),
                     Message("convert it to PCD with x y z intensity"));
}

}  // namespace

bool Cloud::has_contrast() const {
  return std::adjacent_find(intensity.begin(), intensity.end(), std::not_equal_to<>()) !=
         intensity.end();
}

Result<Cloud> read_cloud(const std::filesystem::path& path, std::stop_token stop,
                         PointChoice choice, std::uint64_t max_unpacked_bytes) {
  auto input = Input::open(path, std::move(stop));
  if (!input) return input.error();
  return read(*input, choice, max_unpacked_bytes);
}

Result<Cloud> read_cloud_from_memory(std::string_view content, const std::string& name,
                                     PointChoice choice, std::uint64_t max_unpacked_bytes) {
  Input input = Input::from_memory(content, name);
  return read(input, choice, max_unpacked_bytes);
}

}  // namespace lvcalib
