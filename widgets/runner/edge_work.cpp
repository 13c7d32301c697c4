// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/edge_work.h"

#include <utility>

namespace lvcalib::widgets {
namespace {

Result<std::shared_ptr<const EdgePlaces>> read(std::vector<FilePair> pairs, const Camera& camera,
                                               const Rigid3& rough, const RunContext& context) {
  auto views = read_fresh_views(pairs, camera, rough, context);
  if (!views) return views.error();
  auto out = std::make_shared<EdgePlaces>();
  out->pairs = std::move(pairs);
  out->camera = camera;
  out->read = std::move(*views);
  return std::shared_ptr<const EdgePlaces>(std::move(out));
}

std::shared_ptr<const EdgeLook> look_at(const EdgePlaces& places, std::size_t place,
                                        const Rigid3& camera_from_lidar) {
  auto out = std::make_shared<EdgeLook>();
  out->score = edge_score(places.read.views, places.camera, camera_from_lidar);
  if (place >= places.read.views.size()) return out;
  out->edges = projected_edges(places.read.views[place], places.camera, camera_from_lidar);
  for (const Eigen::Vector3f& p : places.read.points_m[place]) {
    const Eigen::Vector3d point = p.cast<double>();
    const auto pixel = places.camera.project(camera_from_lidar * point);
    if (pixel && places.camera.in_image(*pixel)) out->points.push_back({*pixel, point.norm()});
  }
  return out;
}

}  // namespace

EdgeWork::EdgeWork(QObject* parent) : QObject(parent) {
  relay(runner_, this);
  connect(&runner_, &Runner::cancelled, this, &EdgeWork::ended);
  relay_failure(looker_, this);
  connect(&looker_, &Runner::finished, this, &EdgeWork::start_look);
}

void EdgeWork::load(const std::vector<FilePair>& pairs, const Camera& camera, const Rigid3& rough) {
  runner_.start([this, pairs, camera, rough](const RunContext& context,
                                             const Runner::Post&) -> Runner::Deliver {
    auto places = read(pairs, camera, rough, context);
    if (places) return [this, made = *places] { Q_EMIT loaded(made); };
    if (places.error().kind == ErrorKind::kCancelled) return {};
    return [this, error = places.error()] { Q_EMIT failed(error); };
  });
}

void EdgeWork::load_folder(const QString& folder, const Camera& camera, const Rigid3& rough) {
  runner_.start([this, path = folder.toStdString(), camera, rough](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto pairs = find_fresh_data(path);
    auto places = pairs ? read(std::move(*pairs), camera, rough, context)
                        : Result<std::shared_ptr<const EdgePlaces>>(pairs.error());
    if (places) return [this, made = *places] { Q_EMIT loaded(made); };
    if (places.error().kind == ErrorKind::kCancelled) return {};
    return [this, error = places.error()] { Q_EMIT failed(error); };
  });
}

void EdgeWork::look(const std::shared_ptr<const EdgePlaces>& places, std::size_t place,
                    const Rigid3& camera_from_lidar) {
  wish_ = Wish{places, place, camera_from_lidar};
  if (!looker_.running()) start_look();
}

void EdgeWork::start_look() {
  if (!wish_) return;
  looker_.start([this, wish = *std::exchange(wish_, std::nullopt)](
                    const RunContext&, const Runner::Post&) -> Runner::Deliver {
    return [this, made = look_at(*wish.places, wish.place, wish.camera_from_lidar)] {
      Q_EMIT looked(made);
    };
  });
}

void EdgeWork::check(const std::shared_ptr<const EdgePlaces>& places,
                     const Rigid3& camera_from_lidar, const EdgeCheckOptions& options) {
  runner_.start([this, places, camera_from_lidar, options](const RunContext& context,
                                                           const Runner::Post&) -> Runner::Deliver {
    auto check =
        check_edges(places->read.views, places->camera, camera_from_lidar, options, context);
    if (check) {
      return [this, made = std::make_shared<const EdgeCheck>(std::move(*check))] {
        Q_EMIT checked(made);
      };
    }
    if (check.error().kind == ErrorKind::kCancelled) return {};
    return [this, error = check.error()] { Q_EMIT failed(error); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_edge_work.cpp"
