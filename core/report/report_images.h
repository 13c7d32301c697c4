// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <Eigen/Core>

namespace lvcalib {

/// A photograph for a page.
struct PageImage {
  std::string data_uri;                               ///< JPEG
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero();  ///< Upper left corner of what it shows.
  Eigen::Vector2d size_px = Eigen::Vector2d::Zero();  ///< In pixels of the original.
};

/// The part of an image file about [low, high] (pixels of the original), at most `most_px` wide.
/// Nothing if the file cannot be read.
std::optional<PageImage> page_image(const std::filesystem::path& path, const Eigen::Vector2d& low,
                                    const Eigen::Vector2d& high, int most_px);

/// Base64 of bytes (RFC 4648).
std::string base64(const unsigned char* bytes, std::size_t count);

}  // namespace lvcalib
