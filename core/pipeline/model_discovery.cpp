// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/model_discovery.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "model/beam_blur.h"
#include "model/correction.h"
#include "model/residuals.h"
#include "model/scan_velocity.h"
#include "model/scene_geometry.h"
#include "pipeline/ablation.h"
#include "pipeline/forward_stage.h"
#include "pipeline/quality.h"
#include "pipeline/refusals.h"
#include "pipeline/verdict.h"

namespace lvcalib {
namespace {

bool takes_part(const SceneResult& scene) {
  return scene.used && scene.view && scene.refinement;
}

const SceneSolution* solution_of(const CalibrationResult& result, const std::string& name) {
  for (const SceneSolution& s : result.extrinsic.scenes) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

// What the effects of a model do to a LiDAR point (the measured from the true one), to a point of
// the print, and to a corner's image.
class ModelledMovements {
 public:
  // Beams are of the result's scenes, by their place among them; a scene that has no part in the
  // model is told by those around it.
  ModelledMovements(const Discovery& discovery, const CalibrationResult& result)
      : model_(discovery.model), table_(empty_table(discovery.scales)) {
    if (result.scenes.empty()) return;
    const std::size_t boards = std::max<std::size_t>(1, discovery.state.camera_from_board.size());
    table_.scenes.assign(result.scenes.size(), {});
    std::size_t next = 0;
    for (std::size_t s = 0; s < result.scenes.size(); ++s) {
      const std::size_t board = std::min(next, boards - 1);
      if (takes_part(result.scenes[s])) ++next;
      table_.scenes[s].clock = scene_clock(board, boards);
      if (board >= discovery.state.camera_from_board.size()) continue;
      SceneGeometry(discovery.state.camera_from_lidar, discovery.state.camera_from_board[board])
          .tell_middle(result.target.outline().center_m(), table_.scenes[s]);
    }
  }

  [[nodiscard]] Eigen::Vector3d point(const BeamPoint& beam) const {
    Eigen::Vector3d out = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> scratch;
    for (const EffectInUse& use : model_) out += point_movement(use, beam, table_, scratch);
    return out;
  }
  // By how much the print is seen beside its place.
  [[nodiscard]] Eigen::Vector3d spot(const BeamPoint& beam) const {
    return sum<Eigen::Vector3d>([&](const EffectInUse& use, auto moves) {
      use.effect->spot(beam, table_, use.shape, moves);
    });
  }
  [[nodiscard]] Eigen::Vector3d print(const PrintPoint& at, const Target& target) const {
    return sum<Eigen::Vector3d>([&](const EffectInUse& use, auto moves) {
      use.effect->board(at, target, use.shape, moves);
    });
  }

 private:
  template <class Vector, class Add>
  [[nodiscard]] Vector sum(const Add& add) const {
    Vector out = Vector::Zero();
    for (const EffectInUse& use : model_) {
      std::vector<Vector> moves(static_cast<std::size_t>(use.values.size()), Vector::Zero());
      add(use, std::span<Vector>(moves));
      for (std::size_t k = 0; k < moves.size(); ++k)
        out += use.values(static_cast<Eigen::Index>(k)) * moves[k];
    }
    return out;
  }

  const std::vector<EffectInUse>& model_;
  MeasurementTable table_;
};

// By how much farther black print reads than white with the effects of a model, square to the beam
// at a usual range.
double dark_offset_m(const ModelledMovements& movements) {
  BeamPoint beam;
  beam.range_m = 3.0;
  beam.darkness = 1.0;
  beam.white = 0.0;
  const double black = beam.direction.dot(movements.point(beam));
  beam.darkness = 0.0;
  beam.white = 1.0;
  return black - beam.direction.dot(movements.point(beam));
}

// By which share the print is larger along its axes than the target says, over the whole board.
Eigen::Vector2d print_scale(const ModelledMovements& movements, const Target& target) {
  const BoardOutline outline = target.outline();
  const Eigen::Vector2d half = 0.5 * outline.size_m();
  const auto at = [&](double x, double y) {
    PrintPoint point;
    point.board_m = outline.center_m() + Eigen::Vector2d(x, y);
    return Eigen::Vector2d(movements.print(point, target).head<2>());
  };
  return {(at(half.x(), 0).x() - at(-half.x(), 0).x()) / (2.0 * half.x()),
          (at(0, half.y()).y() - at(0, -half.y()).y()) / (2.0 * half.y())};
}

// Share of the board that is black.
double black_share(const Target& target) {
  constexpr int kSide = 60;
  const BoardOutline outline = target.outline();
  double black = 0.0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const Eigen::Vector2d at =
          outline.lower_left_m +
          outline.size_m().cwiseProduct(Eigen::Vector2d(i + 0.5, j + 0.5)) / kSide;
      black += 1.0 - target.albedo(at).value_or(1.0);
    }
  }
  return black / (kSide * kSide);
}

// The beam towards a point of a board, as dark as the board on average, of no line in particular:
// what is told of a circle is a mean over many returns.
BeamPoint beam_towards(const Eigen::Vector3d& point_m, std::size_t scene,
                       const Rigid3& lidar_from_board, double darkness) {
  BeamPoint beam;
  beam.scene = static_cast<int>(scene);
  static_cast<void>(SceneGeometry(Rigid3(), lidar_from_board).describe(point_m.normalized(), beam));
  beam.darkness = darkness;
  beam.white = 1.0 - darkness;
  beam.line = -1;
  return beam;
}

// A board's corners with what effects do to their images taken out, as the model predicts it.
std::vector<CornerObservation> corners_without(const std::vector<EffectInUse>& effects,
                                               const ModelScales& scales, const Camera& camera,
                                               const Target& target,
                                               std::vector<CornerObservation> corners,
                                               const Rigid3& camera_from_board) {
  MeasurementTable table = empty_table(scales);
  table.target = target;
  table.camera = camera;
  ModelState state;
  state.camera_from_board = {camera_from_board};
  SceneMeasurements scene;
  scene.corners = corners;
  add_corners(scene, 0, state, 1.0, table);
  const auto without = residuals_of(table, state, {}, Channel::kCorner);
  const auto with = residuals_of(table, state, effects, Channel::kCorner);
  if (with.values.size() != without.values.size() || with.values.size() != 2 * corners.size())
    return corners;  // A corner that no camera sees has no rows; then none is touched.
  std::size_t next = 0;
  for (CornerObservation& c : corners) {
    for (Eigen::Index axis = 0; axis < 2; ++axis, ++next)
      c.pixel(axis) += with.values[next] - without.values[next];
  }
  return corners;
}

// By which share a board looks larger along its axes than it is: one that reads farther does, and
// one whose angles are stretched.
Eigen::Vector2d seen_scale(const ModelledMovements& movements, const BoardOutline& outline,
                           double darkness, std::size_t scene, const Rigid3& lidar_from_board) {
  const Eigen::Vector2d half = 0.5 * outline.size_m();
  const auto beam_at = [&](const Eigen::Vector2d& from_middle) {
    const Eigen::Vector2d at = outline.center_m() + from_middle;
    return beam_towards(lidar_from_board * Eigen::Vector3d(at.x(), at.y(), 0.0), scene,
                        lidar_from_board, darkness);
  };
  // Of a place of the board, across its beam, along an axis of the board.
  const auto aside = [&](const Eigen::Vector2d& from_middle, Eigen::Index axis) {
    const BeamPoint beam = beam_at(from_middle);
    const Eigen::Vector3d moved = movements.point(beam);
    const Eigen::Vector3d across = moved - beam.direction * beam.direction.dot(moved);
    return Eigen::Vector3d(lidar_from_board.rotation.conjugate() * across)(axis);
  };
  const BeamPoint middle = beam_at(Eigen::Vector2d::Zero());
  const double farther = middle.direction.dot(movements.point(middle)) / middle.range_m;
  Eigen::Vector2d out;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d end = half(axis) * Eigen::Vector2d::Unit(axis);
    out(axis) = farther + (aside(end, axis) - aside(-end, axis)) / (2.0 * half(axis));
  }
  return out;
}

// How large print and boards look by the model.
void tell_scales(const Discovery& discovery, const ModelledMovements& movements,
                 CalibrationResult& result) {
  const Eigen::Vector2d of_print = print_scale(movements, result.target);
  const BoardOutline outline = result.target.outline();
  const double darkness = black_share(result.target);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  std::size_t next = 0;
  for (std::size_t s = 0; s < result.scenes.size(); ++s) {
    SceneResult& scene = result.scenes[s];
    scene.modelled_scale = 0.0;
    if (!takes_part(scene) || next >= discovery.state.camera_from_board.size()) continue;
    const Rigid3 lidar_from_board =
        discovery.state.camera_from_lidar.inverse() * discovery.state.camera_from_board[next++];
    const Eigen::Vector2d seen = seen_scale(movements, outline, darkness, s, lidar_from_board);
    sum += seen;
    scene.modelled_scale = (seen + of_print).mean();
  }
  result.modelled_print_scale = of_print;
  if (next > 0) result.modelled_print_scale += sum / static_cast<double>(next);
}

// What spoke against intrinsics and target in the images, asked again without what the model's
// effects do to these.
void ask_again(const Discovery& discovery, CalibrationResult& result) {
  std::vector<EffectInUse> others;
  std::copy_if(discovery.model.begin(), discovery.model.end(), std::back_inserter(others),
               [](const EffectInUse& use) { return !use.effect->info().of_intrinsics; });
  const auto without = [&](const std::vector<EffectInUse>& effects) {
    return [&](const std::vector<CornerObservation>& corners, const Rigid3& camera_from_board) {
      return corners_without(effects, discovery.scales, result.camera, result.target, corners,
                             camera_from_board);
    };
  };
  ask_images_again(result, without(others), without(discovery.model));
}

// A scene's returns on the board as effects see them.
class BoardBeams {
 public:
  BoardBeams(const CalibrationResult& result, std::size_t scene, const Rigid3& lidar_from_board,
             const Discovery& discovery, double black)
      : cloud_(result.scenes[scene].board_points),
        scene_(static_cast<int>(scene)),
        geometry_(Rigid3(), lidar_from_board),
        scales_(discovery.scales),
        dark_(scales_.log_contrast > 0.0 && cloud_.has_intensity()),
        black_(black),
        velocities_(scan_velocities(cloud_)) {}

  [[nodiscard]] const Cloud& cloud() const { return cloud_; }
  [[nodiscard]] const SceneGeometry& geometry() const { return geometry_; }
  // Nothing where the ray misses the board's plane.
  [[nodiscard]] std::optional<BeamPoint> of(std::size_t i) const {
    BeamPoint beam;
    if (!geometry_.describe(cloud_.points_m[i].cast<double>().normalized(), beam))
      return std::nullopt;
    beam.scene = scene_;
    beam.darkness = dark_ ? scales_.darkness_of(cloud_.intensity[i]) : black_;
    beam.white = std::clamp(1.0 - beam.darkness, 0.0, 1.0);
    beam.line = cloud_.has_line() ? cloud_.line[i] : -1;
    if (cloud_.has_time()) beam.time_s = cloud_.time_s[i];
    if (!velocities_.empty()) beam.scan_rad_s = velocities_[i];
    return beam;
  }

 private:
  const Cloud& cloud_;
  int scene_;
  SceneGeometry geometry_;
  const ModelScales& scales_;
  bool dark_;
  double black_;
  std::vector<Eigen::Vector2d> velocities_;
};

// The board's plane as it would be without the effects: fitted to the returns, each with what they
// do to its range taken out. A robust plane does not follow its returns' mean: black print that
// reads far off hardly pulls it. Nothing where no plane fits.
std::optional<FittedPlane> plane_without_effects(const BoardBeams& beams,
                                                 const SceneObservations& scene,
                                                 const ModelledMovements& movements,
                                                 const Target& target) {
  Cloud corrected = beams.cloud();
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    const auto beam = beams.of(i);
    if (!beam) continue;
    PrintPoint at;
    at.board_m = beam->board_m;
    const Eigen::Vector3d bend(0.0, 0.0, movements.print(at, target).z());
    const double farther_m =
        beams.geometry()
            .range_row(beam->direction)
            .dot(movements.point(*beam) + scene.lidar_from_board.rotation * bend);
    corrected.points_m[i] -= (farther_m * beam->direction).cast<float>();
  }
  const auto plane = fit_board_plane(corrected, target, scene.lidar_from_board);
  if (!plane) return std::nullopt;
  return plane->plane;
}

// What the effects do to points, as a mean over the returns at a circle's edge: when they were
// taken and how the beam moved then. Where there are none, what they do to `beam` itself.
Eigen::Vector3d movement_about(const Eigen::Vector3d& center_m, double radius_m,
                               const BeamPoint& beam, const BoardBeams& beams,
                               const ModelledMovements& movements) {
  constexpr double kWidth = 0.3;  // Of the radius, on either side of the edge.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (std::size_t i = 0; i < beams.cloud().size(); ++i) {
    const Eigen::Vector3d from_middle = beams.cloud().points_m[i].cast<double>() - center_m;
    if (!(std::abs(from_middle.norm() - radius_m) < kWidth * radius_m)) continue;
    const auto one = beams.of(i);
    if (!one) continue;
    sum += movements.point(*one);
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Vector3d(sum / count) : movements.point(beam);
}

// The observations of the classical solve with a model's effects taken out of them; `planes` are
// the scenes' without the effects, `index` their places in the result.
void take_out(const Discovery& discovery, const ModelledMovements& movements, const Camera& camera,
              const Target& target, const std::vector<std::size_t>& index,
              const std::vector<BoardBeams>& beams,
              const std::vector<std::optional<FittedPlane>>& planes,
              std::vector<SceneObservations>& observations) {
  const double darkness = black_share(target);
  for (std::size_t s = 0; s < observations.size(); ++s) {
    SceneObservations& o = observations[s];
    if (planes[s]) o.plane = *planes[s];
    const auto without_effects = [&](const Eigen::Vector3d& place_m, const RefinedNode& node) {
      PrintPoint at;
      at.board_m = node.board_m;
      const Eigen::Vector3d bent = movements.print(at, target);
      const BeamPoint beam = beam_towards(place_m, index[s], o.lidar_from_board, darkness);
      const Eigen::Vector3d moved =
          movements.spot(beam) +
          movement_about(place_m, target.circle_radius_m, beam, beams[s], movements);
      const Eigen::Vector3d place = place_m - moved;
      // Its height is the plane's, its place on it its own. A board that is bent is met elsewhere
      // along the ray.
      const auto on_plane = o.plane.ray_hit(place);
      Eigen::Vector3d out = on_plane ? o.plane.to_lidar(*on_plane) : place;
      const Eigen::Vector3d normal = o.lidar_from_board.rotation * Eigen::Vector3d::UnitZ();
      const Eigen::Vector3d ray = place.normalized();
      out += bent.z() * (ray / normal.dot(ray) - normal);
      out -= o.lidar_from_board.rotation * Eigen::Vector3d(bent.x(), bent.y(), 0.0);
      return out;
    };
    for (RefinedNode& node : o.nodes) {
      if (!node.valid) continue;
      node.center_lidar_m = without_effects(node.center_lidar_m, node);
      node.raw_lidar_m = without_effects(node.raw_lidar_m, node);
    }
    o.corners = corners_without(discovery.model, discovery.scales, camera, target,
                                std::move(o.corners), o.camera_from_board);
  }
}

// Pose of the LiDAR and of the boards in use, in their order.
void put_poses(const Discovery& discovery, CalibrationResult& result) {
  result.extrinsic.camera_from_lidar = {discovery.state.camera_from_lidar, discovery.covariance};
  std::size_t next = 0;
  for (const SceneResult& scene : result.scenes) {
    if (!takes_part(scene)) continue;
    for (SceneSolution& s : result.extrinsic.scenes) {
      if (s.name == scene.name && next < discovery.state.camera_from_board.size())
        s.camera_from_board = discovery.state.camera_from_board[next];
    }
    ++next;
  }
}

// Scenes that contradict the base model may agree once the effect that it lacks is taken out of
// their observations. They are no reason to doubt then, though the model was fitted without them;
// and what the user insisted on is not objected to any more. To agree, the solve that refuses bad
// scenes must keep a scene and fit the others as well as without it.
void ask_scenes_again(std::vector<SceneObservations> observations,
                      const std::vector<std::size_t>& index, const Target& target,
                      const ExtrinsicSolution& without, CalibrationResult& result) {
  const auto refused = [](const SceneResult& scene) {
    return scene.contradicts && can_be_insisted_on(scene);
  };
  const auto insisted = [&](const SceneResult& scene) {
    return scene.used && !scene.objection.empty() &&
           !(target.has_circles() && scene.refinement->nodes.empty());
  };
  bool any = false;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const SceneResult& scene = result.scenes[index[k]];
    observations[k].use = observations[k].use || refused(scene);
    any = any || refused(scene) || insisted(scene);
  }
  if (!any) return;
  const auto with = solve_extrinsic(observations, result.camera, target, result.options.extrinsic);
  if (!with || with->node_scale > std::max(1.0, without.node_scale) ||
      with->plane_scale > std::max(1.0, without.plane_scale))
    return;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    SceneResult& scene = result.scenes[index[k]];
    if (!with->scenes[k].used) continue;
    if (insisted(scene)) scene.objection = {};
    if (!refused(scene)) continue;
    scene.contradicts = false;
    scene.reason = Message(
        "it contradicts the others only without the effects of this model: use it all the same "
        "(--insist) and search again");
  }
}

// A scene's board returns with what the effects did to them taken out, a bent board's height too.
Cloud cloud_without(const BoardBeams& beams, const ModelledMovements& movements,
                    const Target& target) {
  Cloud out = beams.cloud();
  const Eigen::Vector3d normal = beams.geometry().normal();
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto beam = beams.of(i);
    if (!beam) continue;
    PrintPoint at;
    at.board_m = beam->board_m;
    const double bent_m = movements.print(at, target).z() / normal.dot(beam->direction);
    out.points_m[i] -= (movements.point(*beam) + bent_m * beam->direction).cast<float>();
  }
  return out;
}

// The boundary response of returns, circles and planes without the effects.
void respond_without(const Discovery& discovery, const ModelledMovements& movements,
                     const std::vector<BoardBeams>& beams,
                     const std::vector<SceneObservations>& observations,
                     const std::vector<std::size_t>& index, const Target& target,
                     CalibrationResult& result) {
  std::vector<Cloud> clouds(observations.size());
  std::vector<BoardRefinement> refined(observations.size());
  std::vector<ResponseInput> inputs;
  std::size_t board = 0;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const SceneResult& scene = result.scenes[index[k]];
    if (!takes_part(scene) || board >= discovery.state.camera_from_board.size()) continue;
    const Rigid3 lidar_from_board =
        discovery.state.camera_from_lidar.inverse() * discovery.state.camera_from_board[board++];
    if (scene.refinement->nodes.empty()) continue;
    clouds[k] = cloud_without(beams[k], movements, target);
    refined[k] = *scene.refinement;
    refined[k].nodes = observations[k].nodes;
    refined[k].plane = observations[k].plane;
    refined[k].lidar_from_board = lidar_from_board;
    inputs.push_back({scene.name, &clouds[k], &refined[k]});
  }
  if (auto response = calibrate_boundary_response(inputs, target, result.options.response, {}))
    result.response = std::move(*response);
}

// The beam as the model measures it.
void tell_beam(const Discovery& discovery, ForwardSolution& forward) {
  forward.state.beam = discovery.state.beam;
  if (!discovery.fit || !forward.uses_intensity) return;
  const Eigen::Index at = blur_place(discovery.model);
  const Eigen::MatrixXd& covariance = discovery.fit->covariance;
  if (covariance.rows() >= at + 3) forward.blur_covariance = covariance.block<3, 3>(at, at);
}

// Everything that is told of the scenes, under the model's effects: residuals, methods, what single
// scenes and halves would give. Where the classical solve does not bear the corrected observations
// the base's stands, with the model's pose.
void report_model(const Discovery& discovery, const ModelledMovements& movements,
                  CalibrationResult& result) {
  std::vector<bool> use;
  for (const SceneResult& scene : result.scenes) use.push_back(scene.used);
  std::vector<std::size_t> index;
  auto observations = observations_of(result, use, index);
  const Target target = target_in_use(result, observations);
  auto paper = with_paper_nodes(observations, result, index);
  std::vector<BoardBeams> beams;
  std::vector<std::optional<FittedPlane>> planes;
  const double black = black_share(target);
  for (std::size_t k = 0; k < observations.size(); ++k) {
    beams.emplace_back(result, index[k], observations[k].lidar_from_board, discovery, black);
    planes.push_back(plane_without_effects(beams[k], observations[k], movements, target));
  }
  take_out(discovery, movements, result.camera, target, index, beams, planes, paper);
  take_out(discovery, movements, result.camera, target, index, beams, planes, observations);
  respond_without(discovery, movements, beams, observations, index, target, result);
  if (result.forward) tell_beam(discovery, *result.forward);
  const ExtrinsicOptions& how = result.options.extrinsic;
  const auto again = solve_extrinsic(observations, result.camera, target, how);
  if (again) ask_scenes_again(observations, index, target, *again, result);
  const auto& solved = result.extrinsic.scenes;
  const auto boards = static_cast<std::size_t>(
      std::count_if(solved.begin(), solved.end(), [](const SceneSolution& s) { return s.used; }));
  if (!discovery.fit || solved.size() != observations.size() ||
      boards != discovery.state.camera_from_board.size()) {
    // Not made by one solve: what it says of its measurements stays.
    put_poses(discovery, result);
    return;
  }
  ExtrinsicSolution nodes = result.extrinsic;
  const auto same_scenes = [&](const ExtrinsicSolution& other) {
    return std::equal(
        other.scenes.begin(), other.scenes.end(), nodes.scenes.begin(), nodes.scenes.end(),
        [](const SceneSolution& a, const SceneSolution& b) { return a.used == b.used; });
  };
  if (again && same_scenes(*again)) nodes = *again;
  ReportedPose pose{{discovery.state.camera_from_lidar, discovery.covariance},
                    discovery.state.camera_from_board};
  if (result.forward) {
    pose.uses_intensity = result.forward->uses_intensity;
    pose.converged = result.forward->converged;
    pose.iterations = result.forward->iterations;
  }
  const SubsetSolver subsets =
      model_subsets(discovery.fit, discovery.state.camera_from_lidar, nodes);
  result.extrinsic = report_forward(pose, subsets, nodes, observations, result.camera, target, how);
  result.extrinsic.camera_from_lidar = pose.camera_from_lidar;
  MethodOptions methods;
  methods.paper = JointVariant{"joint_paper", std::move(paper), paper_objective(how)};
  methods.other = {"forward_model", discovery.state.camera_from_lidar, subsets};
  result.methods = compare_methods(observations, result.camera, target, nodes, how, methods);
  result.ablation.clear();  // Of the base model.
  result.uncertainty =
      assess_uncertainty(observations, result.camera, target, result.extrinsic, how, {}, subsets);
}

}  // namespace

DiscoveryInput discovery_input(const CalibrationResult& result) {
  DiscoveryInput input;
  input.target = result.target;
  input.camera = result.camera;
  input.sigma_px = result.extrinsic.sigma_px;
  input.state.camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  for (const SceneResult& scene : result.scenes) {
    const SceneSolution* solution = solution_of(result, scene.name);
    if (!takes_part(scene) || solution == nullptr) continue;
    SceneMeasurements m;
    m.name = scene.name;
    for (std::size_t k = 0; k < scene.view->corners.size(); ++k) {
      // Corners that the joint solve left out as outliers stay out.
      if (k < solution->corners.size() && solution->corners[k].used)
        m.corners.push_back(scene.view->corners[k]);
    }
    m.board_points = &scene.board_points;
    m.uncovered = scene.edits.kept_patches;
    input.scenes.push_back(std::move(m));
    input.state.camera_from_board.push_back(solution->camera_from_board);
  }
  if (result.forward && result.forward->state.levels.size() == input.scenes.size()) {
    const ForwardSolution& forward = *result.forward;
    input.print = result.print;
    input.noise = forward.noise;
    input.state = {forward.state.camera_from_lidar, forward.state.camera_from_board,
                   forward.state.levels, forward.state.beam};
  }
  return input;
}

DiscoveryOptions discovery_options(const CalibrationResult& result) {
  DiscoveryOptions out = result.options.discovery;
  const QualityOptions& q = result.options.quality;
  out.tolerance = {{q.tolerance_m, q.tolerance_rad}, q.tolerance_sigmas};
  out.left_out = left_out_sizes(result);
  // The search holds the intrinsics wherever the calibration had estimated them.
  if (result.intrinsics.mode != IntrinsicsMode::kFixed)
    out.left_out.intrinsics = result.intrinsics.sigma;
  return out;
}

Result<Discovery> discover(const CalibrationResult& result, const DiscoveryOptions& options,
                           const RunContext& context) {
  auto out = discover_effects(discovery_input(result), options, context);
  if (!out || !out->model.empty()) return out;
  // With nothing in the model the calibration's own extrinsic stands, and its uncertainty.
  const UncertainRigid3& own = result.extrinsic.camera_from_lidar;
  out->covariance = own.covariance;
  out->covariance_total = result.covariance_total;
  out->covariance_with_budget = covariance_with_budget(out->covariance, out->budget);
  if (!out->history.empty()) out->history.back().camera_from_lidar = own.transform;
  return out;
}

CalibrationResult with_model(CalibrationResult result, const Discovery& discovery) {
  // With nothing selected the calibration's own extrinsic stands: it rests on every return.
  const bool changed = !discovery.model.empty();
  const ModelledMovements movements(discovery, result);
  result.budget = discovery.budget;
  result.covariance_with_budget = discovery.covariance_with_budget;
  // What an effect of the model explains is no longer left out. Before the total is known, what
  // was left out of the base model stands for it.
  if (changed && discovery.covariance_total.isZero(0.0)) {
    result.covariance_total += discovery.covariance - result.extrinsic.camera_from_lidar.covariance;
  } else if (changed) {
    result.covariance_total = discovery.covariance_total;
  }
  result.model_scales = discovery.scales;
  result.model.clear();
  for (const EffectFinding& f : discovery.effects) {
    for (const EffectInUse& use : discovery.model) {
      if (use.effect->info().id != f.id) continue;
      result.model.push_back({f.id, f.parameters, use.shape, f.shape_sigma, f.spec});
    }
  }
  result.model_fit = changed ? discovery.fit : nullptr;
  result.modelled_dark_offset_m = dark_offset_m(movements);
  tell_scales(discovery, movements, result);
  result.modelled_range_misfit = 0.0;
  result.unexplained.clear();
  std::copy_if(discovery.unknown.begin(), discovery.unknown.end(),
               std::back_inserter(result.unexplained),
               [](const StructureScore& s) { return s.matters; });
  result.lacking = discovery.lacking();
  if (!changed) {
    if (!result.unexplained.empty() || !result.lacking.empty())
      judge_quality(result, result.options.quality);
    return result;
  }
  const std::vector<ChannelSummary> none;
  for (const ChannelSummary& c :
       discovery.history.empty() ? none : discovery.history.back().channels) {
    if (c.channel == Channel::kRange && c.noise_floor > 0.0)
      result.modelled_range_misfit = c.rms / c.noise_floor;
  }
  report_model(discovery, movements, result);
  ask_again(discovery, result);
  // What the model explains is no fault of the result any more.
  judge_quality(result, result.options.quality);
  return result;
}

std::shared_ptr<const CalibrationResult> result_at(
    const std::shared_ptr<const CalibrationResult>& base, const std::vector<ModelStepPtr>& steps) {
  if (steps.size() < 2) return base;
  const Discovery discovery = as_discovery(steps, nullptr);
  if (discovery.model.empty()) return base;
  return std::make_shared<const CalibrationResult>(with_model(*base, discovery));
}

}  // namespace lvcalib
