// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "cloud/cloud.h"
#include "detection/color_image.h"
#include "report/exports.h"

namespace lvcalib {

/// The points of a cloud that a camera sees, with the image's colours.
struct ColoredCloud {
  Cloud cloud;                    ///< LiDAR frame; fields as the given cloud has them.
  std::vector<std::uint8_t> rgb;  ///< Three of each point.
  std::size_t outside = 0;        ///< Points left out because they are not in the picture,
  std::size_t hidden = 0;         ///< or because something nearer covers them for the camera.
};

/// Colours points by bilinear interpolation at their pixels. A point counts as hidden where another
/// one that falls within three pixels of it is nearer to the camera by more than a tenth of its
/// distance and 0.1 m: the camera looks from elsewhere than the LiDAR.
ColoredCloud color_cloud(const Cloud& cloud, const ColorImage& image, const Camera& camera,
                         const Rigid3& camera_from_lidar);

/// Header of the PLY file that such a cloud becomes, with the export's notes as comments.
std::string colored_ply_header(const ExportInput& input, const Cloud& cloud);

/// Reads the image and the cloud of a scene of the result (empty: the first in use), colours the
/// points and writes them as binary PLY (x y z red green blue, intensity if there is one), whole or
/// not at all; returns what was written. Errors: kUsage for an unknown scene; of files that are not
/// there any more or that cannot be read; kCancelled.
Result<ColoredCloud> write_colored_ply(const ExportInput& input, const std::string& scene,
                                       const std::filesystem::path& path,
                                       const RunContext& context);

}  // namespace lvcalib
