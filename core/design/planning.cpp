// SPDX-License-Identifier: BSD-3-Clause
#include "design/planning.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

#include "base/symmetric.h"
#include "base/text.h"
#include "base/yaml_file.h"

namespace lvcalib {
namespace {

// Before any scene: nothing is known. Metres and radians.
constexpr double kKnownBefore = 1.0;

// Structure that nothing explains is not foreseen: calibrate asks for it, and states it, once there
// are measurements.
ModelVariances noise_alone() {
  ModelVariances out;
  out.group = kAbsentVariance;
  return out;
}

MeasurementTable bare_table(const Target& target, const Camera& camera,
                            const LidarDescription& lidar) {
  MeasurementTable out;
  out.target = target;
  out.camera = camera;
  out.print = std::make_shared<const BlurredPrint>(target);
  if (lidar.lines.size() > 1) out.lines = lidar.lines;
  out.has_time = lidar.has_time;
  out.has_intensity = lidar.has_intensity;
  // Print that returns a tenth of white; the numbers cancel in all that is planned.
  out.level = {1.0, 0.1};
  out.log_contrast = std::log(10.0);
  return out;
}

// why_not_testable() looks at rows, and there are none yet.
Message why_not(const Effect& effect, const MeasurementTable& table) {
  const EffectNeeds& needs = effect.info().needs;
  if (needs.time && !table.has_time) return Message("the LiDAR's description says no time");
  if (needs.line && table.lines.empty())
    return Message("the LiDAR's description has one line only");
  if (needs.intensity && !table.has_intensity)
    return Message("the LiDAR's description says no intensity");
  if (needs.tags && !table.target.has_tags()) return Message("this board has no tags");
  if (effect.is_gauge()) return Message("no data can tell it from a turn of the LiDAR frame");
  return {};
}

// Of a shape number that nobody knows yet, the middle of its grid.
Result<EffectColumnsList> columns_for(const std::vector<std::string>& ids,
                                      const MeasurementTable& table) {
  std::vector<std::string> known;
  for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
  EffectColumnsList out;
  for (const std::string& id : ids) {
    const EffectPtr effect = find_effect(id);
    if (effect == nullptr) {
      const std::string near = nearest_word(id, known);
      return Error::usage(near.empty()
                              ? Message("there is no effect '%1'", id)
                              : Message("there is no effect '%1'; did you mean '%2'?", id, near));
    }
    if (const Message why = why_not(*effect, table); !why.empty())
      return Error::input(Message("the effect '%1' cannot be planned for: %2", id, why));
    const auto shapes = effect->shapes(table);
    out.add(effect, shapes[shapes.size() / 2], table);
  }
  return out;
}

// Poses of the grid that both sensors see.
Result<std::vector<GridPose>> poses_in_view(const MeasurementTable& table,
                                            const SensorModel& sensors,
                                            const Rigid3& camera_from_lidar,
                                            const BoardGridOptions& grid) {
  std::vector<GridPose> poses = board_grid(table.target, table.camera, grid);
  const std::size_t in_image = poses.size();
  std::erase_if(poses, [&](const GridPose& pose) {
    return !lidar_sees(sensors, table.target, camera_from_lidar.inverse() * pose.camera_from_board);
  });
  if (poses.empty()) {
    return Error::input(
        Message(
            "no board pose of the grid is in view of both sensors (%1 are in view of the camera)",
            in_image),
        {}, Message("check the field of view and T_camera_lidar, or use a smaller board"));
  }
  return poses;
}

// Information on the extrinsic and the effects before any scene.
Eigen::MatrixXd information_before(const std::optional<Matrix6d>& known,
                                   const ColumnSubset& subset) {
  const auto size = 6 + static_cast<Eigen::Index>(subset.columns.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Identity(size, size) / (kKnownBefore * kKnownBefore);
  if (known) out.topLeftCorner<6, 6>() += symmetric_inverse(*known);
  for (std::size_t k = 0; k < subset.columns.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k) + 6;
    out(at, at) = 1.0 / (subset.prior_sigma[k] * subset.prior_sigma[k]);
  }
  return out;
}

// Of the grid, by the sum of squares over the board's corners.
std::size_t nearest_to(const Rigid3& camera_from_board, const std::vector<GridPose>& poses,
                       const BoardOutline& outline) {
  const auto apart = [&](const GridPose& pose) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d at =
          outline.lower_left_m + Eigen::Vector2d(k % 2, k / 2).cwiseProduct(outline.size_m());
      const Eigen::Vector3d corner(at.x(), at.y(), 0.0);
      sum += (camera_from_board * corner - pose.camera_from_board * corner).squaredNorm();
    }
    return sum;
  };
  return static_cast<std::size_t>(
      std::min_element(poses.begin(), poses.end(),
                       [&](const GridPose& a, const GridPose& b) { return apart(a) < apart(b); }) -
      poses.begin());
}

// Smallest |t| of the size of interest over an effect's parameters, with the extrinsic free.
double visibility(const EffectColumns& c, const Eigen::MatrixXd& h) {
  std::vector<Eigen::Index> at(6);
  std::iota(at.begin(), at.end(), 0);
  for (int k = 0; k < c.count(); ++k) at.push_back(6 + c.first + k);
  const Eigen::MatrixXd covariance = symmetric_inverse(Eigen::MatrixXd(h(at, at)));
  double least = HUGE_VAL;
  for (int k = 0; k < c.count(); ++k) {
    const double sigma = std::sqrt(std::max(1e-300, covariance(6 + k, 6 + k)));
    least = std::min(least, c.parameters[static_cast<std::size_t>(k)].size_of_interest / sigma);
  }
  return least;
}

double merit(const Eigen::MatrixXd& h, const EffectColumnsList& columns, double testable) {
  const Matrix6d extrinsic = h.topLeftCorner<6, 6>();
  double out = extrinsic.ldlt().vectorD().cwiseAbs().array().max(1e-300).log().sum();
  // As much as if the effect were one more unknown, until it is testable.
  for (const EffectColumns& c : columns.list())
    out += 2.0 * std::min(0.0, std::log(visibility(c, h) / testable));
  return out;
}

// What is known once a pose is taken, `information` being that of all scenes up to it.
PlannedScene planned_scene(const GridPose& pose, const Rigid3& camera_from_lidar,
                           const Eigen::MatrixXd& information, const EffectColumnsList& columns) {
  PlannedScene scene;
  scene.pose = pose;
  scene.lidar_from_board = camera_from_lidar.inverse() * pose.camera_from_board;
  const Matrix6d h = information.topLeftCorner<6, 6>();
  scene.covariance = symmetric_inverse(h);
  scene.determined = scene.covariance.diagonal().cwiseSqrt().maxCoeff() < 0.1 * kKnownBefore;
  for (const EffectColumns& c : columns.list())
    scene.effects.push_back({c.effect->info().id, visibility(c, information)});
  return scene;
}

void warn(const PlanOptions& options, ScenePlan& plan) {
  if (plan.scenes.empty()) return;
  if (static_cast<int>(plan.scenes.size()) < options.scenes)
    plan.warnings.push_back(Message("the grid has no more poses than %1", plan.scenes.size()));
  const PlannedScene& last = plan.scenes.back();
  if (!last.determined)
    plan.warnings.push_back(Message("so few scenes do not determine the extrinsic"));
  for (const EffectVisibility& e : last.effects) {
    if (e.sigmas >= options.testable) continue;
    plan.warnings.push_back(Message(
        "%1 stays hard to test: at its size of interest it stands %2 σ above zero; to see it: %3",
        e.id, formatted("%.1f", e.sigmas),
        Message::listed(find_effect(e.id)->info().discriminating_pose)));
  }
}

}  // namespace

Status PlanOptions::check() const {
  if (scenes < 1 || scenes > 100)
    return Error::usage(Message("scenes to plan: expected 1 to 100, found %1", scenes));
  if (!(testable > 0.0) || !(corner_sigma_px > 0.0))
    return Error::usage(Message("planning: expected a corner noise and a threshold above zero"));
  if (known && (!known->allFinite() || Eigen::LLT<Matrix6d>(*known).info() != Eigen::Success)) {
    return Error::usage(
        Message("planning: what is known of the extrinsic before must be a covariance without "
                "directions that are known exactly or not at all"));
  }
  return grid.check();
}

Result<ScenePlan> plan_scenes(const Target& target, const Camera& camera,
                              const LidarDescription& lidar, const PlanOptions& options,
                              const RunContext& context) {
  if (Status s = options.check(); !s) return s.error();
  const MeasurementTable table = bare_table(target, camera, lidar);
  SensorModel sensors = lidar.sensors;
  sensors.corner_sigma_px = options.corner_sigma_px;
  const auto columns = columns_for(options.effects, table);
  if (!columns) return columns.error();
  ColumnSubset subset;
  for (const EffectColumns& c : columns->list()) append_columns(c, nullptr, subset);
  context.report("plan", 0.0, Message("predicting measurements"));
  ScenePlan out;
  out.camera_from_lidar = lidar.camera_from_lidar.value_or(forward_looking_mount());
  out.known = options.known;
  const auto poses = poses_in_view(table, sensors, out.camera_from_lidar, options.grid);
  if (!poses) return poses.error();
  out.poses_tried = poses->size();
  std::vector<bool> taken(poses->size(), false);
  for (const Rigid3& pose : options.taken) taken[nearest_to(pose, *poses, target.outline())] = true;
  const ModelVariances variances = noise_alone();
  const auto added = predicted_information(
      *poses, {sensors, table, out.camera_from_lidar, *columns, subset, variances}, context);
  if (added.empty()) return Error::cancelled();
  Eigen::MatrixXd now = information_before(options.known, subset);
  for (int scene = 0; scene < options.scenes; ++scene) {
    if (context.stopped()) return Error::cancelled();
    context.report("plan", 0.5 + 0.5 * scene / options.scenes,
                   Message("choosing scene %1", scene + 1));
    std::optional<std::size_t> best;
    double best_merit = -HUGE_VAL;
    for (std::size_t k = 0; k < added.size(); ++k) {
      const double m = taken[k] ? -HUGE_VAL : merit(now + added[k], *columns, options.testable);
      if (m > best_merit) {
        best_merit = m;
        best = k;
      }
    }
    if (!best) break;
    taken[*best] = true;
    now += added[*best];
    out.scenes.push_back(planned_scene((*poses)[*best], out.camera_from_lidar, now, *columns));
  }
  warn(options, out);
  context.report("plan", 1.0, Message("done"));
  return out;
}

}  // namespace lvcalib
