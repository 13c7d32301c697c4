// SPDX-License-Identifier: BSD-3-Clause
#include "report/plan_file.h"

#include "base/file_io.h"
#include "report/json_values.h"
#include "report/result_file.h"

namespace lvcalib {
namespace {

ordered_json scene_json(const PlannedScene& scene, std::size_t number) {
  ordered_json effects = ordered_json::array();
  for (const EffectVisibility& e : scene.effects)
    effects.push_back({{"id", e.id}, {"sigmas", e.sigmas}});
  const Vector6d sigma = 1e3 * scene.covariance.diagonal().cwiseSqrt();
  const auto known = [&](const Eigen::Vector3d& v) {
    return scene.determined ? list_of(v) : ordered_json(nullptr);
  };
  return {{"number", number},
          {"description", "board " + scene.pose.text()},
          {"distance_m", scene.pose.distance_m},
          {"tilt_x_deg", scene.pose.tilt_x_deg},
          {"tilt_y_deg", scene.pose.tilt_y_deg},
          {"roll_deg", scene.pose.roll_deg},
          {"T_camera_board", rows_of(scene.pose.camera_from_board.matrix())},
          {"T_lidar_board", rows_of(scene.lidar_from_board.matrix())},
          {"sigma_translation_mm", known(sigma.head<3>())},
          {"sigma_rotation_mrad", known(sigma.tail<3>())},
          {"effects", std::move(effects)}};
}

}  // namespace

std::string plan_as_json(const ScenePlan& plan) {
  ordered_json j;
  j["version"] = version();
  j["T_camera_lidar"] = rows_of(plan.camera_from_lidar.matrix());
  j["poses_tried"] = plan.poses_tried;
  j["scenes"] = ordered_json::array();
  for (std::size_t k = 0; k < plan.scenes.size(); ++k)
    j["scenes"].push_back(scene_json(plan.scenes[k], k + 1));
  if (!plan.scenes.empty() && plan.scenes.back().determined)
    j["covariance"] = rows_of(plan.scenes.back().covariance);
  if (plan.known) j["covariance_before"] = rows_of(*plan.known);
  j["warnings"] = plan.warnings;
  return j.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

Status write_plan(const ScenePlan& plan, const std::filesystem::path& path) {
  return write_file_atomically(path, plan_as_json(plan));
}

}  // namespace lvcalib
