// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/board_images.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "base/text.h"

namespace lvcalib {

BoardImage look_at_image(const std::filesystem::path& path, const Target& target,
                         const std::function<Camera(int width_px, int height_px)>& camera_for,
                         const DetectionOptions& options, const RunContext& context) {
  BoardImage out;
  out.path = path;
  const auto image = read_image(path);
  if (!image) {
    out.reason = image.error().message;
    return out;
  }
  out.width_px = image->width_px;
  out.height_px = image->height_px;
  auto view = find_board_in_image(*image, target, camera_for(image->width_px, image->height_px),
                                  options, context);
  if (view) {
    out.view = std::move(*view);
  } else {
    out.reason = view.error().message;
  }
  return out;
}

Result<std::vector<BoardImage>> look_at_images(
    const std::vector<std::filesystem::path>& paths, const Target& target,
    const std::function<Camera(int width_px, int height_px)>& camera_for,
    const DetectionOptions& options, const RunContext& context, ProgressShare share) {
  std::vector<BoardImage> out(paths.size());
  RunContext quiet = context.silent();
  // One thread per image where there are enough images.
  const auto count = std::max<std::size_t>(1, paths.size());
  quiet.threads = std::max(1, context.thread_count() / static_cast<int>(count));
  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(paths.size(), context.thread_count(), [&](std::size_t k) {
    if (context.stopped()) return;
    out[k] = look_at_image(paths[k], target, camera_for, options, quiet);
    const std::lock_guard lock(mutex);
    ++done;
    const double part = static_cast<double>(done) / static_cast<double>(count);
    context.report("detect", share.first + (share.last - share.first) * part,
                   Message::verbatim(paths[k].filename().string()));
  });
  if (context.stopped()) return Error::cancelled();
  return out;
}

bool same_corners(const BoardView& a, const BoardView& b) {
  // The standard deviations are known to a factor of two or three; a tenth lies beyond that.
  constexpr double kFarBelow = 0.1;
  if (a.corners.empty() || a.corners.size() != b.corners.size()) return false;
  double squares = 0.0;
  double variances = 0.0;
  for (std::size_t k = 0; k < a.corners.size(); ++k) {
    const CornerObservation& x = a.corners[k];
    const CornerObservation& y = b.corners[k];
    if (x.feature_id != y.feature_id || x.corner != y.corner) return false;
    squares += (x.pixel - y.pixel).squaredNorm();
    variances += 2.0 * (x.sigma_px * x.sigma_px + y.sigma_px * y.sigma_px);
  }
  return squares <= kFarBelow * kFarBelow * variances;
}

double corner_rms_px(const std::vector<CornerObservation>& corners, const Camera& camera,
                     const Rigid3& camera_from_board) {
  const double limit_px = 0.1 * camera.width_px;
  double squares = 0.0;
  for (const CornerObservation& c : corners) {
    const auto pixel =
        camera.project(camera_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    const double e = pixel ? std::min((*pixel - c.pixel).norm(), limit_px) : limit_px;
    squares += 0.5 * e * e;
  }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, corners.size())));
}

Message stray_reason(double rms_px, double usual_px, double floor_px) {
  // Five standard deviations of one corner, as all of an image's corners together hardly ever are.
  constexpr double kFactor = 5.0;
  if (rms_px <= std::max(floor_px, kFactor * usual_px)) return {};
  return Message(
      "its corners miss the camera of the other images by %1 px RMS; was it taken in motion, or is "
      "it of another board or camera?",
      formatted("%.2f", rms_px));
}

}  // namespace lvcalib
