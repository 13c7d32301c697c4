// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/fresh_data.h"

#include <atomic>
#include <optional>

#include "base/parallel.h"
#include "cloud/about_cloud.h"
#include "detection/board_view.h"
#include "pipeline/scene_lister.h"
#include "recording/pair_import.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

struct Read {
  EdgeView view;
  std::vector<Eigen::Vector3f> points_m;
  std::vector<Message> cloud_warnings;
};

Result<Read> read_pair(const FilePair& pair, const Camera& camera, const Rigid3& rough,
                       const RunContext& context) {
  const auto image = read_image(pair.image);
  if (!image) return image.error();
  const auto cloud = read_pair_cloud(pair.cloud, context);
  if (!cloud) return cloud.error();
  auto view = edge_view(pair.name, *image, *cloud, camera, rough);
  if (!view) return view.error();
  Read out{std::move(*view), {}, cloud->warnings};
  const std::size_t step = 1 + cloud->size() / FreshViews::kMostDrawn;
  for (std::size_t i = 0; i < cloud->size(); i += step) out.points_m.push_back(cloud->points_m[i]);
  return out;
}

}  // namespace

Result<std::vector<FilePair>> find_fresh_data(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder / "scenes", code)) {
    PairOptions options;
    options.images = folder;
    auto found = find_pairs(options);
    if (!found) return found.error();
    return std::move(found->pairs);
  }
  auto scenes = scene_lister(folder / "scenes")();
  if (!scenes) return scenes.error();
  if (scenes->pairs.empty())
    return Error::input(Message("no scene has an image and a cloud"), (folder / "scenes").string());
  return std::move(scenes->pairs);
}

Result<FreshViews> read_fresh_views(const std::vector<FilePair>& pairs, const Camera& camera,
                                    const Rigid3& rough_camera_from_lidar,
                                    const RunContext& context) {
  std::vector<std::optional<Result<Read>>> read(pairs.size());
  std::atomic<std::size_t> done = 0;
  const RunContext silent = context.silent();
  parallel_for(pairs.size(), context.thread_count(), [&](std::size_t k) {
    if (context.stopped()) return;
    read[k] = read_pair(pairs[k], camera, rough_camera_from_lidar, silent);
    context.report("load", static_cast<double>(++done) / static_cast<double>(pairs.size()),
                   Message("reading %1", pairs[k].name));
  });
  if (context.stopped()) return Error::cancelled();
  FreshViews out;
  for (std::size_t k = 0; k < read.size(); ++k) {
    std::optional<Result<Read>>& pair = read[k];
    if (pair && *pair) {
      out.views.push_back(std::move((*pair)->view));
      out.points_m.push_back(std::move((*pair)->points_m));
      out.pairs.push_back(k);
      for (const Message& warning : (*pair)->cloud_warnings)
        out.cloud_warnings.push_back(about_cloud(pairs[k].name, warning));
    } else if (pair) {
      out.warnings.push_back(Message("left out: %1", pair->error().sentence()));
    }
  }
  if (out.views.empty() && !out.warnings.empty()) return read.front()->error();
  if (out.views.empty()) return Error::input(Message("there is no image with a cloud to check"));
  return out;
}

}  // namespace lvcalib
