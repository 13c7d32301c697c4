// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/scene_copies.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include "pipeline/board_images.h"
#include "pipeline/calibration.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

constexpr float kSamePlace_m = 1e-4F;

// The share of `points` that `others`, sorted by x, have as well.
double share_in(const Cloud& points, const Cloud& others, const std::vector<std::uint32_t>& by_x) {
  constexpr std::size_t kEnough = 1000;  // Half of so many is known to a few per cent.
  const std::size_t step = 1 + points.size() / kEnough;
  const bool intensities = points.has_intensity() && others.has_intensity();
  std::size_t found = 0;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < points.size(); i += step) {
    ++asked;
    const Eigen::Vector3f& p = points.points_m[i];
    const auto is_twin = [&](std::uint32_t k) {
      if (!((others.points_m[k] - p).cwiseAbs().maxCoeff() <= kSamePlace_m)) return false;
      // Text keeps six digits.
      return !intensities || std::abs(others.intensity[k] - points.intensity[i]) <=
                                 1e-5F * std::abs(points.intensity[i]);
    };
    auto at =
        std::lower_bound(by_x.begin(), by_x.end(), p.x() - kSamePlace_m,
                         [&](std::uint32_t k, float x) { return others.points_m[k].x() < x; });
    for (; at != by_x.end() && others.points_m[*at].x() <= p.x() + kSamePlace_m; ++at) {
      if (!is_twin(*at)) continue;
      ++found;
      break;
    }
  }
  return asked == 0 ? 0.0 : static_cast<double>(found) / static_cast<double>(asked);
}

std::vector<std::uint32_t> order_by_x(const Cloud& cloud) {
  std::vector<std::uint32_t> order(cloud.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return cloud.points_m[a].x() < cloud.points_m[b].x();
  });
  return order;
}

// The points about the place that is most likely the board; null where none was found.
const Cloud* likely_board(const SceneResult& scene) {
  if (!scene.search || scene.search->candidates.empty()) return nullptr;
  const std::size_t patch = scene.search->candidates.front().patch;
  return patch < scene.search->patch_points.size() ? &scene.search->patch_points[patch] : nullptr;
}

}  // namespace

std::vector<SameContent> same_content(const Dataset& dataset, bool use_crops,
                                      const std::vector<InputFile>& inputs) {
  std::map<std::string, const InputFile*> by_path;
  for (const InputFile& file : inputs) by_path.emplace(file.path, &file);
  std::map<std::string, std::size_t> images;
  std::map<std::string, std::size_t> clouds;
  // The first scene with a file's content, if that is another.
  const auto first = [&](auto& seen, const fs::path& path,
                         std::size_t s) -> std::optional<std::size_t> {
    const auto file = by_path.find(path.lexically_relative(dataset.path).generic_string());
    if (file == by_path.end() || file->second->bytes == 0 || file->second->sha256.empty())
      return std::nullopt;
    const auto [at, is_new] = seen.try_emplace(file->second->sha256, s);
    return is_new ? std::nullopt : std::optional(at->second);
  };
  std::vector<SameContent> out(dataset.scenes.size());
  for (std::size_t s = 0; s < out.size(); ++s) {
    const SceneFiles& f = dataset.scenes[s];
    out[s].image = first(images, f.image, s);
    out[s].cloud = first(clouds, use_crops && !f.crop.empty() ? f.crop : f.cloud, s);
  }
  return out;
}

bool same_returns(const Cloud& a, const Cloud& b) {
  constexpr double kMost = 0.5;  // A cloud that was cut or thinned keeps as many.
  return share_in(a, b, order_by_x(b)) > kMost || share_in(b, a, order_by_x(a)) > kMost;
}

void find_copies(const std::vector<SceneResult>& scenes, std::vector<SameContent>& same) {
  for (std::size_t s = 1; s < scenes.size(); ++s) {
    if (!scenes[s].reason.empty()) continue;
    const Cloud* board = likely_board(scenes[s]);
    for (std::size_t other = 0; other < s; ++other) {
      const SceneResult& one = scenes[other];
      if (!one.reason.empty()) continue;
      if (!same[s].image && scenes[s].view && one.view && same_corners(*scenes[s].view, *one.view))
        same[s].image = other;
      const Cloud* others = likely_board(one);
      if (!same[s].cloud && board != nullptr && others != nullptr && same_returns(*board, *others))
        same[s].cloud = other;
    }
  }
}

void note_same_content(CalibrationResult& result, const std::vector<SameContent>& same) {
  for (std::size_t s = 0; s < same.size(); ++s) {
    SceneResult& scene = result.scenes[s];
    if (!scene.reason.empty()) continue;
    const std::optional<std::size_t>& image = same[s].image;
    const std::optional<std::size_t>& cloud = same[s].cloud;
    const auto first = std::find_if(
        same.begin(), same.begin() + static_cast<std::ptrdiff_t>(s), [&](const SameContent& other) {
          const auto t = static_cast<std::size_t>(&other - &same[0]);
          return image == other.image.value_or(t) && cloud == other.cloud.value_or(t);
        });
    if (first != same.begin() + static_cast<std::ptrdiff_t>(s)) {
      const SceneResult& one = result.scenes[static_cast<std::size_t>(first - same.begin())];
      if (!one.reason.empty()) continue;
      // Where the files tell, nobody has looked at them.
      scene.reason = scene.view
                         ? Message(
                               "its corners and its returns are those of scene %1, of which it is "
                               "a copy that counts once",
                               one.name)
                         : Message("the same files as scene %1, which counts once", one.name);
      // A copy says nothing more about the camera either.
      scene.view.reset();
      scene.search.reset();
      scene.shared_file = {};
      continue;
    }
    if (image) {
      scene.shared_file =
          Message("scene %1 has the same image as scene %2: one of the two is not the scene's own",
                  scene.name, result.scenes[*image].name);
    }
    if (cloud) {
      scene.shared_file =
          Message("scene %1 has the same cloud as scene %2: one of the two is not the scene's own",
                  scene.name, result.scenes[*cloud].name);
    }
  }
}

}  // namespace lvcalib
