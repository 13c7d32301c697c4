// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "base/error.h"
#include "base/progress.h"
#include "base/rigid3.h"
#include "camera/camera.h"
#include "target/target.h"

namespace lvcalib {

/// A grey image, row by row; values 0…255 whatever the file's depth (16-bit files keep their
/// finer steps).
struct GrayImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> pixels;
  [[nodiscard]] float at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x)];
  }
};

/// Reads png, jpg, bmp or tiff; colour, grey, palette, with alpha, 8 or 16 bit.
Result<GrayImage> read_image(const std::filesystem::path& path);
/// The same of a file's content; errors name `where`.
Result<GrayImage> read_image(std::string_view file, const std::string& where);

/// One corner of the board's pattern found in an image.
struct CornerObservation {
  int feature_id = 0;  ///< Tag id, or the index of a checkerboard corner.
  int corner =
      0;  ///< 0 lower left, 1 lower right, 2 upper right, 3 upper left; 0 for checkerboards.
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  /// Standard deviation of either coordinate as the pixels' noise alone explains it; 0 unknown.
  double sigma_px = 0.0;
};

/// Radius of the board's circles as an image shows them; 0 where it does not.
struct MeasuredRadius {
  double radius_m = 0.0;
  double pixel_m = 0.0;  ///< What a pixel is on the board.
};

/// What one image tells about the board.
struct BoardView {
  std::vector<CornerObservation> corners;
  int tag_count = 0;  ///< Tags or markers found (checkerboard: 0).
  /// Board pose from the corners alone; covariance of the left perturbation.
  UncertainRigid3 camera_from_board;
  /// A checkerboard whose squares have the other colours than the target has (see
  /// Target::white_first).
  bool other_colors = false;
  /// The other pose of the planar ambiguity, if its fit is not clearly worse.
  std::optional<Rigid3> alternative_pose;
  double sigma_px =
      0.0;  ///< Standard deviation of one corner coordinate, estimated from the residuals.
  double rms_px = 0.0;
  MeasuredRadius circle_radius;
  std::vector<Message> warnings;
};

struct DetectionOptions {
  /// Image reduction for the first search; corners use full resolution. Tags below some 30 px are
  /// missed at 2, but are then looked for where the tags that were found say they must be.
  double quad_decimate = 2.0;
  /// A tag whose corners miss the board's pose by more is dropped.
  double max_reprojection_px = 5.0;
  int min_tags = 2;  ///< Fewer make the image unusable; a board of one tag needs that one.
  /// Corners that could not be refined have about this standard deviation.
  double unrefined_sigma_px = 0.3;
  /// The other pose of the planar ambiguity is reported unless its likelihood is so much smaller
  /// that a true pose would look so bad with this probability.
  double ambiguity_tail = 1e-6;
};

/// Finds the board in an image: tags, markers or checkerboard corners, refined to sub-pixel
/// accuracy, and its pose with covariance and resolved planar ambiguity. A checkerboard that looks
/// the same when turned gets the one of its frames whose y axis points most upwards in the image (x
/// when that is a tie); it is never mirrored. Errors (kInput): image size differs from the
/// intrinsics; no tags (and whether the mirrored image has some); tags of other ids; too few tags;
/// the board twice; no checkerboard.
Result<BoardView> find_board_in_image(const GrayImage& image, const Target& target,
                                      const Camera& camera, const DetectionOptions& options,
                                      const RunContext& context);

/// Estimates the board's pose anew from a view's own corners under another camera: pose, the other
/// pose of the planar ambiguity, noise. A view whose corners fit no pose is left as it is.
void refit_view(BoardView& view, const Camera& camera, const DetectionOptions& options);

}  // namespace lvcalib
