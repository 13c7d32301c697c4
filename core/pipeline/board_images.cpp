// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/board_images.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "base/statistics.h"
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

namespace {

// Σ of squared residuals of all corners' coordinates under a fit, px².
double squares_of(const std::vector<CornerView>& views, const IntrinsicsFit& fit) {
  double sum = 0.0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const double rms = corner_rms_px(*views[v].corners, fit.camera, fit.camera_from_board[v]);
    sum += rms * rms * static_cast<double>(2 * views[v].corners->size());
  }
  return sum;
}

// By how much a view adds to the residuals of others, as an RMS of its corners' coordinates, px,
// whatever camera all would agree on.
double added_rms_px(const std::vector<CornerView>& others, const IntrinsicsFit& alone,
                    const CornerView& view, const Camera& given) {
  std::vector<CornerView> with = others;
  with.push_back(view);
  const auto together = fit_intrinsics(with, given, wide_intrinsics_sigma(given));
  if (!together) return HUGE_VAL;
  const double added = squares_of(with, *together) - squares_of(others, alone);
  return std::sqrt(std::max(0.0, added) / (2.0 * static_cast<double>(view.corners->size())));
}

// What it adds by chance at most: noise of its own, as its replicates tell it, against that of the
// others.
double addable_rms_px(const IntrinsicsFit& alone, const CornerView& view) {
  constexpr double kTail = 1e-4;  // Of hundreds of images hardly one is left out for nothing.
  // Corners of one image are harder to see than those of another beyond what replicates tell: six
  // of a simulated rig added 0.7 to 1.3 times the noise, those of eight other cameras 2.2 to 10.7.
  constexpr double kUneven = 1.5;
  constexpr int kPose = 6;  // Parameters of the board's pose, which take as much of the noise.
  const auto coordinates = static_cast<int>(2 * view.corners->size());
  const double noise_px = std::max(alone.sigma_px, replicate_noise({view}, alone.camera));
  const double gate = f_gate(std::max(1, coordinates - kPose), alone.freedom, kTail);
  return kUneven * noise_px * std::sqrt(gate / coordinates);
}

}  // namespace

std::vector<Message> strays_among(const std::vector<CornerView>& views, std::size_t scenes,
                                  const Camera& given, const IntrinsicsFit& fit) {
  // Focal lengths and the middle of the image follow from two views, distortion from a third.
  constexpr std::size_t kFewestScenes = 3;
  std::vector<double> rms_px;
  for (std::size_t v = 0; v < views.size(); ++v)
    rms_px.push_back(corner_rms_px(*views[v].corners, fit.camera, fit.camera_from_board[v]));
  const double usual = median(rms_px);
  std::vector<Message> out;
  for (std::size_t v = scenes; v < views.size(); ++v) out.push_back(stray_reason(rms_px[v], usual));
  if (scenes < kFewestScenes) return out;
  const std::vector<CornerView> of_scenes(views.begin(),
                                          views.begin() + static_cast<std::ptrdiff_t>(scenes));
  const auto alone = fit_intrinsics(of_scenes, given, wide_intrinsics_sigma(given));
  if (!alone) return out;
  std::vector<Message> asked;
  for (std::size_t v = scenes; v < views.size(); ++v) {
    asked.push_back(stray_reason(added_rms_px(of_scenes, *alone, views[v], given), 0.0,
                                 addable_rms_px(*alone, views[v])));
  }
  const auto found = static_cast<std::size_t>(std::count_if(
      asked.begin(), asked.end(), [](const Message& reason) { return !reason.empty(); }));
  return found <= std::max<std::size_t>(1, asked.size() / 2) ? asked : out;
}

}  // namespace lvcalib
