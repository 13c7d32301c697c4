// SPDX-License-Identifier: BSD-3-Clause
#include "design/planning.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>

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

class Planner {
 public:
  Planner(const Target& target, const Camera& camera, const LidarDescription& lidar,
          const PlanOptions& options, const RunContext& context)
      : table_(bare_table(target, camera, lidar)),
        sensors_(lidar.sensors),
        options_(options),
        context_(context) {
    sensors_.corner_sigma_px = options.corner_sigma_px;
    out_.camera_from_lidar = lidar.camera_from_lidar.value_or(forward_looking_mount());
  }

  Result<ScenePlan> run() {
    if (Status s = options_.check(); !s) return s.error();
    if (Status s = add_effects(); !s) return s.error();
    if (Status s = collect(); !s) return s.error();
    for (int k = 0; k < options_.scenes; ++k) {
      if (context_.stopped()) return Error::cancelled();
      context_.report("plan", 0.5 + 0.5 * k / options_.scenes, Message("choosing scene %1", k + 1));
      if (!choose_next()) break;
    }
    warn();
    context_.report("plan", 1.0, Message("done"));
    return std::move(out_);
  }

 private:
  Status add_effects() {
    std::vector<std::string> known;
    for (const EffectPtr& effect : effect_catalogue()) known.push_back(effect->info().id);
    for (const std::string& id : options_.effects) {
      const EffectPtr effect = find_effect(id);
      if (effect == nullptr) {
        const std::string near = nearest_word(id, known);
        return Error::usage(near.empty()
                                ? Message("there is no effect '%1'", id)
                                : Message("there is no effect '%1'; did you mean '%2'?", id, near));
      }
      if (const Message why = why_not(*effect); !why.empty())
        return Error::input(Message("the effect '%1' cannot be planned for: %2", id, why));
      // Of a shape number that nobody knows yet, the middle of its grid.
      const auto shapes = effect->shapes(table_);
      columns_.add(effect, shapes[shapes.size() / 2], table_);
    }
    for (const EffectColumns& c : columns_.list()) append_columns(c, nullptr, subset_);
    return Done{};
  }

  // why_not_testable() looks at rows, and there are none yet.
  [[nodiscard]] Message why_not(const Effect& effect) const {
    const EffectNeeds& needs = effect.info().needs;
    if (needs.time && !table_.has_time) return Message("the LiDAR's description says no time");
    if (needs.line && table_.lines.empty())
      return Message("the LiDAR's description has one line only");
    if (needs.intensity && !table_.has_intensity)
      return Message("the LiDAR's description says no intensity");
    if (needs.tags && !table_.target.has_tags()) return Message("this board has no tags");
    if (effect.is_gauge()) return Message("no data can tell it from a turn of the LiDAR frame");
    return {};
  }

  Status collect() {
    context_.report("plan", 0.0, Message("predicting measurements"));
    poses_ = board_grid(table_.target, table_.camera, options_.grid);
    const std::size_t in_image = poses_.size();
    std::erase_if(poses_, [&](const GridPose& pose) {
      return !lidar_sees(sensors_, table_.target,
                         out_.camera_from_lidar.inverse() * pose.camera_from_board);
    });
    if (poses_.empty()) {
      return Error::input(
          Message(
              "no board pose of the grid is in view of both sensors (%1 are in view of the camera)",
              in_image),
          {}, Message("check the field of view and T_camera_lidar, or use a smaller board"));
    }
    out_.poses_tried = poses_.size();
    taken_.assign(poses_.size(), false);
    for (const Rigid3& pose : options_.taken) taken_[nearest_to(pose)] = true;
    added_ = predicted_information(poses_, sensors_, table_, out_.camera_from_lidar, columns_,
                                   subset_, noise_alone(), context_);
    if (added_.empty()) return Error::cancelled();
    const auto size = 6 + static_cast<Eigen::Index>(subset_.columns.size());
    now_ = Eigen::MatrixXd::Identity(size, size) / (kKnownBefore * kKnownBefore);
    if (options_.known)
      now_.topLeftCorner<6, 6>() += options_.known->ldlt().solve(Matrix6d::Identity());
    out_.known = options_.known;
    for (std::size_t k = 0; k < subset_.columns.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k) + 6;
      now_(at, at) = 1.0 / (subset_.prior_sigma[k] * subset_.prior_sigma[k]);
    }
    return Done{};
  }

  // Of the grid, by the sum of squares over the board's corners.
  [[nodiscard]] std::size_t nearest_to(const Rigid3& camera_from_board) const {
    const BoardOutline outline = table_.target.outline();
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
    return static_cast<std::size_t>(std::min_element(poses_.begin(), poses_.end(),
                                                     [&](const GridPose& a, const GridPose& b) {
                                                       return apart(a) < apart(b);
                                                     }) -
                                    poses_.begin());
  }

  // Smallest |t| of a material size over an effect's parameters, with the extrinsic free.
  [[nodiscard]] double visibility(const EffectColumns& c, const Eigen::MatrixXd& h) const {
    std::vector<Eigen::Index> at(6);
    std::iota(at.begin(), at.end(), 0);
    for (int k = 0; k < c.count(); ++k) at.push_back(6 + c.first + k);
    const auto n = static_cast<Eigen::Index>(at.size());
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd(h(at, at)).ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    double least = HUGE_VAL;
    for (int k = 0; k < c.count(); ++k) {
      const double sigma = std::sqrt(std::max(1e-300, covariance(6 + k, 6 + k)));
      least = std::min(least, c.parameters[static_cast<std::size_t>(k)].material / sigma);
    }
    return least;
  }

  [[nodiscard]] double merit(const Eigen::MatrixXd& h) const {
    const Matrix6d extrinsic = h.topLeftCorner<6, 6>();
    double out = extrinsic.ldlt().vectorD().cwiseAbs().array().max(1e-300).log().sum();
    // As much as if the effect were one more unknown, until it is testable.
    for (const EffectColumns& c : columns_.list())
      out += 2.0 * std::min(0.0, std::log(visibility(c, h) / options_.testable));
    return out;
  }

  bool choose_next() {
    std::size_t best = added_.size();
    double best_merit = -HUGE_VAL;
    for (std::size_t k = 0; k < added_.size(); ++k) {
      if (taken_[k]) continue;
      const double m = merit(now_ + added_[k]);
      if (m > best_merit) {
        best_merit = m;
        best = k;
      }
    }
    if (best == added_.size()) return false;
    taken_[best] = true;
    now_ += added_[best];
    PlannedScene scene;
    scene.pose = poses_[best];
    scene.lidar_from_board = out_.camera_from_lidar.inverse() * scene.pose.camera_from_board;
    const Matrix6d h = now_.topLeftCorner<6, 6>();
    scene.covariance = h.ldlt().solve(Matrix6d::Identity());
    scene.determined = scene.covariance.diagonal().cwiseSqrt().maxCoeff() < 0.1 * kKnownBefore;
    for (const EffectColumns& c : columns_.list())
      scene.effects.push_back({c.effect->info().id, visibility(c, now_)});
    out_.scenes.push_back(std::move(scene));
    return true;
  }

  void warn() {
    if (out_.scenes.empty()) return;
    if (static_cast<int>(out_.scenes.size()) < options_.scenes)
      out_.warnings.push_back(Message("the grid has no more poses than %1", out_.scenes.size()));
    const PlannedScene& last = out_.scenes.back();
    if (!last.determined)
      out_.warnings.push_back(Message("so few scenes do not determine the extrinsic"));
    for (const EffectVisibility& e : last.effects) {
      if (e.sigmas >= options_.testable) continue;
      out_.warnings.push_back(
          Message("%1 stays hard to test: what matters of it stands %2 σ above zero; to see it: %3",
                  e.id, formatted("%.1f", e.sigmas),
                  Message::listed(find_effect(e.id)->info().discriminating_pose)));
    }
  }

  MeasurementTable table_;
  SensorModel sensors_;
  const PlanOptions& options_;
  const RunContext& context_;
  EffectColumnsList columns_;
  ColumnSubset subset_;
  std::vector<GridPose> poses_;
  std::vector<Eigen::MatrixXd> added_;
  std::vector<bool> taken_;
  Eigen::MatrixXd now_;
  ScenePlan out_;
};

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
  return Planner(target, camera, lidar, options, context).run();
}

}  // namespace lvcalib
