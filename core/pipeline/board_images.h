// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "camera/camera.h"
#include "detection/board_view.h"
#include "solve/intrinsics_fit.h"
#include "target/target.h"

namespace lvcalib {

/// An image of the board without a cloud: for the camera alone.
struct BoardImage {
  std::filesystem::path path;
  int width_px = 0;  ///< 0 if it could not be read.
  int height_px = 0;
  std::optional<BoardView> view;
  Message reason;  ///< Why there is no view, or why it is not used.
  [[nodiscard]] bool used() const { return view && reason.empty(); }
};

/// Looks for the board in one image. `camera_for` gives the camera to look with, by the image's
/// size. An image that cannot be read or does not show the board says so in `reason`.
BoardImage look_at_image(const std::filesystem::path& path, const Target& target,
                         const std::function<Camera(int width_px, int height_px)>& camera_for,
                         const DetectionOptions& options, const RunContext& context);

/// The part of a whole work's progress that a work takes.
struct ProgressShare {
  double first = 0.0, last = 1.0;
};

/// The same for many images, on the context's threads. The only error is kCancelled.
Result<std::vector<BoardImage>> look_at_images(
    const std::vector<std::filesystem::path>& paths, const Target& target,
    const std::function<Camera(int width_px, int height_px)>& camera_for,
    const DetectionOptions& options, const RunContext& context, ProgressShare share);

/// Whether two views hold the same corners, of one image that is there twice (copied, or written
/// again with a bit changed): they differ by less than a tenth of what their own noise makes of two
/// images of one scene. Found under the same camera.
bool same_corners(const BoardView& a, const BoardView& b);

/// RMS of a corner coordinate's distance from where a camera sees it. A corner that the camera
/// does not image counts as a tenth of the image off.
double corner_rms_px(const std::vector<CornerObservation>& corners, const Camera& camera,
                     const Rigid3& camera_from_board);

/// Why an image is left out whose corners miss a camera that fits the others: it is of something
/// else, moved, bent, another board or camera. Empty unless it misses by five times the usual, and
/// by more than `floor_px`: the smear of a hand that is nearly still.
Message stray_reason(double rms_px, double usual_px, double floor_px = 0.3);

/// Why views of images for the camera alone are left out: those of `views` behind the first
/// `scenes`, which are the scenes' own; empty ones stay. A free camera can meet a single stray
/// halfway, so that all images miss alike under `fit`, that of all views: where the scenes alone
/// give a camera, each view is asked by itself what it adds to their residuals (F-test, see the
/// source). If that is too much of most of them, the lens is not of this model, or the scenes are
/// at fault, and it says nothing.
std::vector<Message> strays_among(const std::vector<CornerView>& views, std::size_t scenes,
                                  const Camera& given, const IntrinsicsFit& fit);

}  // namespace lvcalib
