// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"

namespace lvcalib {

/// Which points of a file to read.
enum class PointChoice {
  kReturns,  ///< Those with finite coordinates (and fields) that are not at the origin.
  kAll,      ///< Every one, in its place: organised clouds stay organised.
};

/// A point cloud in the LiDAR frame, column by column. Points without finite coordinates, and
/// points at the origin (no return), are left out when a file is read, unless every point is asked
/// for. Fields that the file lacks are empty, never filled with zeros.
struct Cloud {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<float> intensity;     ///< As in the file, of any scale; empty if the file has none.
  std::vector<float> time_s;        ///< From the first time of the scan; empty if absent.
  std::vector<std::uint16_t> line;  ///< Laser line (ring, channel); empty if absent.
  std::size_t dropped = 0;  ///< Points left out because they are not finite or at the origin.
  std::size_t rows = 1;     ///< Of an organised cloud that was read with every point; 1 otherwise.
  /// Why its file may not be whole: it goes on after the last point that its header counts, or has
  /// no return from some point on. Whatever points there are stand here all the same.
  std::vector<Message> warnings;

  [[nodiscard]] std::size_t size() const { return points_m.size(); }
  [[nodiscard]] bool has_intensity() const { return !intensity.empty(); }
  /// Whether intensities tell surfaces apart: there are some, and they are not all the same (some
  /// drivers fill the field with one number).
  [[nodiscard]] bool has_contrast() const;
  [[nodiscard]] bool has_time() const { return !time_s.empty(); }
  [[nodiscard]] bool has_line() const { return !line.empty(); }
};

/// What a compressed cloud may unpack to unless more is asked for: a file can claim 88 times its
/// own size. Thirty million points of 32 bytes, more than ten seconds of the densest scanners.
constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{1} << 30;

/// Reads a PCD (ascii, binary, binary_compressed) or PLY (ascii, binary of both byte orders)
/// file, told apart by content. Field names: x y z, intensity (also: i, scalar_intensity,
/// reflectivity…), time (t, timestamp, offset_time, time_stamp…), line (ring, channel).
/// One pass, memory bounded by the file's real size whatever its header claims; of a compressed
/// file also by `max_unpacked_bytes`.
/// Errors name the file, what was expected and what was found; `stop` gives kCancelled.
Result<Cloud> read_cloud(const std::filesystem::path& path, std::stop_token stop = {},
                         PointChoice choice = PointChoice::kReturns,
                         std::uint64_t max_unpacked_bytes = kMaxUnpackedBytes);

/// The same from memory, for tests and fuzzing; `name` stands for the file in messages.
Result<Cloud> read_cloud_from_memory(std::string_view content, const std::string& name,
                                     PointChoice choice = PointChoice::kReturns,
                                     std::uint64_t max_unpacked_bytes = kMaxUnpackedBytes);

/// Writes a binary PCD with the fields and rows the cloud has, atomically.
Status write_pcd(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace lvcalib
