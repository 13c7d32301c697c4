// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/kitti_points.h"

#include <utility>

#include "cloud/readers.h"

namespace lvcalib {

Result<Cloud> read_kitti_points(const std::filesystem::path& path, std::stop_token stop) {
  auto input = Input::open(path, std::move(stop));
  if (!input) return input.error();
  constexpr std::size_t point_bytes = 4 * sizeof(float);
  const std::uint64_t bytes = input->remaining();
  if (bytes == 0 || bytes % point_bytes != 0) {
    return input->error(Message(
        "holds %1 bytes; expected 16 for each point: x, y, z and reflectance as 4-byte floats",
        bytes));
  }
  BlockLayout layout;
  for (const Role role : {kX, kY, kZ, kIntensity})
    layout.fields[role] = FieldLayout{ScalarType::kF32, role * sizeof(float), point_bytes};
  CloudBuilder builder(layout, false, bytes / point_bytes);
  if (Status s = read_binary_points(*input, point_bytes, bytes / point_bytes, builder); !s)
    return s.error();
  return builder.finish(input->name());
}

}  // namespace lvcalib
