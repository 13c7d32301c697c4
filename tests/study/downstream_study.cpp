// SPDX-License-Identifier: GPL-3.0-or-later
// Scan-to-map registration past reflectivity edges, point to plane, with and without the calibrated
// noise of boundary points. The map is the true one, so that only the weights differ.
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include <Eigen/Cholesky>

#include "base/random.h"
#include "base/statistics.h"
#include "cloud/plane.h"
#include "evidence_rigs.h"
#include "simulation/beam.h"
#include "simulation/printed_board.h"

namespace lvcalib::study {
namespace {

using simulation::PrintedBoard;
using simulation::Room;
using simulation::Surface;

constexpr int kPoses = 6;
constexpr int kPoints = 12'000;

// kBoundary: the calibrated covariance on edges, range noise elsewhere. kEverywhere: its angular
// part on every point, since a beam that jitters does so everywhere; its range part on edges.
enum class Weights { kUniform, kRangeOnly, kBoundary, kEverywhere };
constexpr std::size_t kWeights = 4;

// Paint of black and white on a wall, as dense in edges as road markings and signs.
Target paint() {
  Target target;
  target.tag_size_m = 0.4;
  target.circle_radius_m = 0.1;
  target.margin_m = 0.1;
  return target;
}

Surface painted(const PrintedBoard& board, const Eigen::Vector3d& center, const Eigen::Vector3d& u,
                const Eigen::Vector3d& v) {
  Surface s;
  s.center_m = center;
  s.u = u;
  s.v = v;
  s.half_u_m = 0.5 * board.outline().size_m().x();
  s.half_v_m = 0.5 * board.outline().size_m().y();
  s.board = &board;
  return s;
}

// A closed white room with paint on its front wall, left wall, right wall and floor. World frame:
// x along the trajectory, z up.
Room painted_room(const PrintedBoard& board) {
  const auto X = Eigen::Vector3d::UnitX();
  const auto Y = Eigen::Vector3d::UnitY();
  const auto Z = Eigen::Vector3d::UnitZ();
  Room room;
  const auto face = [&](const Eigen::Vector3d& center, const Eigen::Vector3d& u,
                        const Eigen::Vector3d& v, double half_u, double half_v) {
    Surface s;
    s.center_m = center;
    s.u = u;
    s.v = v;
    s.half_u_m = half_u;
    s.half_v_m = half_v;
    s.texture.base = 0.85;
    room.surfaces.push_back(s);
  };
  face({8, 0, 1}, Y, Z, 3, 3);
  face({-4, 0, 1}, Y, Z, 3, 3);
  face({2, 3, 1}, X, Z, 6, 3);
  face({2, -3, 1}, X, Z, 6, 3);
  face({2, 0, -2}, X, Y, 6, 3);
  face({2, 0, 4}, X, Y, 6, 3);
  constexpr double kProud = 1e-4;  // Paint lies on the wall.
  room.surfaces.push_back(painted(board, {8 - kProud, 0, 0.5}, -Y, Z));
  room.surfaces.push_back(painted(board, {4.5, 3 - kProud, 0.5}, X, Z));
  room.surfaces.push_back(painted(board, {4.5, -3 + kProud, 0.5}, -X, Z));
  room.surfaces.push_back(painted(board, {4.0, 0, -2 + kProud}, X, Y));
  return room;
}

struct MapPlane {
  Eigen::Vector3d normal;
  double offset;
};

// The room's faces as a map.
std::array<MapPlane, 6> map_planes() {
  const auto X = Eigen::Vector3d::UnitX();
  const auto Y = Eigen::Vector3d::UnitY();
  const auto Z = Eigen::Vector3d::UnitZ();
  return {{{X, 8}, {X, -4}, {Y, 3}, {Y, -3}, {Z, -2}, {Z, 4}}};
}

// The LiDAR's boundary noise, calibrated on a simulated rig of its own.
struct LidarNoise {
  Eigen::Matrix3d boundary = Eigen::Matrix3d::Zero();
  double range_m = 0.0;
};

std::optional<LidarNoise> calibrated_noise(const simulation::LidarOptions& lidar,
                                           std::uint64_t seed) {
  simulation::SimulationOptions options;
  options.seed = seed;
  options.lidar = lidar;
  options.lidar.points = 0;
  options.image.width_px = 320;
  options.image.height_px = 240;
  RunContext context;
  context.threads = 1;
  const auto rig = simulation::simulate(options, context);
  if (!rig) return std::nullopt;
  std::vector<BoardRefinement> refinements;
  std::vector<double> noise;
  for (const auto& scene : rig->scenes) {
    auto refinement = refine_board(scene.cloud, rig->target, scene.lidar_from_board, {}, context);
    if (!refinement) return std::nullopt;
    noise.push_back(refinement->plane.sigma_range_m);
    refinements.push_back(std::move(*refinement));
  }
  std::vector<ResponseInput> inputs;
  for (std::size_t s = 0; s < refinements.size(); ++s)
    inputs.push_back({rig->scenes[s].name, &rig->scenes[s].cloud, &refinements[s]});
  const auto response = calibrate_boundary_response(inputs, rig->target, {}, context);
  if (!response || !response->all) return std::nullopt;
  return LidarNoise{response->all->covariance, median(noise)};
}

// A front end's view of an edge: an intensity that is neither black nor white.
bool on_edge(float intensity, double scale) {
  const double level = (static_cast<double>(intensity) / scale - PrintedBoard::kBlack) /
                       (PrintedBoard::kWhite - PrintedBoard::kBlack);
  return level > 0.2 && level < 0.8;
}

double variance_of(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, bool edge,
                   const LidarNoise& noise, Weights weights) {
  if (weights == Weights::kUniform) return noise.range_m * noise.range_m;
  const Eigen::Vector3d sight = point.normalized();
  if (weights == Weights::kRangeOnly || (!edge && weights == Weights::kBoundary))
    return std::pow(noise.range_m * normal.dot(sight), 2) + 1e-8;
  const Eigen::Vector3d yaw = Eigen::Vector3d::UnitZ().cross(sight).normalized();
  Eigen::Matrix3d j;
  j << point.norm() * sight.cross(yaw), point.norm() * yaw, sight;
  Eigen::Matrix3d covariance = noise.boundary;
  if (!edge) {
    covariance.row(2).setZero();
    covariance.col(2).setZero();
    covariance(2, 2) = noise.range_m * noise.range_m;
  }
  return normal.dot(j * covariance * j.transpose() * normal) + 1e-8;
}

// Point-to-plane registration from a disturbed start.
Rigid3 registered(const Cloud& cloud, Rigid3 world_from_lidar, const LidarNoise& noise,
                  double scale, Weights weights) {
  const auto planes = map_planes();
  for (int i = 0; i < 12; ++i) {
    Matrix6d normal = Matrix6d::Zero();
    Vector6d rhs = Vector6d::Zero();
    const double gate = i < 4 ? 0.15 : 0.06;
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      const Eigen::Vector3d p = cloud.points_m[k].cast<double>();
      const Eigen::Vector3d q = world_from_lidar * p;
      const MapPlane* nearest = nullptr;
      double best = gate;
      int near = 0;
      for (const MapPlane& plane : planes) {
        const double d = std::abs(plane.normal.dot(q) - plane.offset);
        near += d < 0.2 ? 1 : 0;
        if (d >= best) continue;
        best = d;
        nearest = &plane;
      }
      if (nearest == nullptr || near > 1) continue;  // No plane, or a corner of the room.
      const Eigen::Vector3d in_lidar = world_from_lidar.rotation.conjugate() * nearest->normal;
      const double weight =
          1.0 / variance_of(p, in_lidar, on_edge(cloud.intensity[k], scale), noise, weights);
      Vector6d j;
      j << nearest->normal, q.cross(nearest->normal);
      normal += weight * j * j.transpose();
      rhs -= weight * j * (nearest->normal.dot(q) - nearest->offset);
    }
    world_from_lidar = se3_exp(normal.ldlt().solve(rhs)) * world_from_lidar;
  }
  return world_from_lidar;
}

struct Errors {
  std::array<std::vector<double>, kWeights> mm, mrad;
  std::vector<double> edge_share;
};

void run_seed(const Room& room, const simulation::LidarOptions& lidar, const LidarNoise& noise,
              std::uint64_t seed, Errors& errors) {
  std::array<double, kWeights> mm{};
  std::array<double, kWeights> mrad{};
  double edges = 0.0;
  for (int pose = 0; pose < kPoses; ++pose) {
    const auto stream = seed * 100 + static_cast<std::uint64_t>(pose);
    const Eigen::Vector3d origin(0.4 * pose, 0.1 * std::sin(pose), 0.0);
    Room seen = room;  // in the LiDAR's frame
    for (Surface& s : seen.surfaces) s.center_m -= origin;
    const simulation::ScanPattern pattern(lidar, Random(stream, 1));
    const simulation::RayCaster caster(seen, Eigen::Vector3d::Zero());
    const Cloud cloud = simulation::scan(lidar, pattern, caster, Random(stream, 2), {});
    for (const float v : cloud.intensity)
      edges += on_edge(v, lidar.intensity_scale) ? 1.0 / static_cast<double>(cloud.size()) : 0.0;
    const Rigid3 truth{Eigen::Quaterniond::Identity(), origin};
    Random random(stream, 3);
    Vector6d xi;
    for (double& v : xi) v = 0.01 * random.normal();
    for (std::size_t w = 0; w < kWeights; ++w) {
      const Rigid3 found = registered(cloud, se3_exp(xi) * truth, noise, lidar.intensity_scale,
                                      static_cast<Weights>(w));
      mm[w] += 1e6 * std::pow(translation_distance_m(found, truth), 2) / kPoses;
      mrad[w] += 1e6 * std::pow(rotation_distance_rad(found, truth), 2) / kPoses;
    }
  }
  for (std::size_t w = 0; w < kWeights; ++w) {
    errors.mm[w].push_back(std::sqrt(mm[w]));
    errors.mrad[w].push_back(std::sqrt(mrad[w]));
  }
  errors.edge_share.push_back(edges / kPoses);
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out;
  for (std::size_t k = 0; k < a.size(); ++k) out.push_back(a[k] - b[k]);
  return out;
}

void table(const char* title, const simulation::LidarOptions& lidar, int seeds,
           std::uint64_t first_seed) {
  const auto noise = calibrated_noise(lidar, first_seed);
  if (!noise) {
    std::printf("%s: no boundary response\n", title);
    return;
  }
  const PrintedBoard board(paint());
  const Room room = painted_room(board);
  Errors errors;
  for (int k = 0; k < seeds; ++k)
    run_seed(room, lidar, *noise, first_seed + static_cast<std::uint64_t>(k), errors);
  std::printf(
      "\n%s: %s of the points on edges\n\n| weights | translation [mm] | rotation [mrad] |\n"
      "| --- | --- | --- |\n",
      title, mean_text(errors.edge_share).c_str());
  const char* const names[] = {"uniform", "range noise alone", "calibrated, on edges",
                               "calibrated, everywhere"};
  for (std::size_t w = 0; w < kWeights; ++w)
    std::printf("| %s | %s | %s |\n", names[w], mean_text(errors.mm[w]).c_str(),
                mean_text(errors.mrad[w]).c_str());
  for (std::size_t w = 1; w < kWeights; ++w) {
    std::printf("| %s − uniform | %s | %s |\n", names[w],
                mean_text(difference(errors.mm[w], errors.mm[0])).c_str(),
                mean_text(difference(errors.mrad[w], errors.mrad[0])).c_str());
  }
}

}  // namespace

void study_downstream(int seeds, std::uint64_t first_seed) {
  simulation::LidarOptions lidar;
  lidar.kind = simulation::LidarKind::kAvia;
  lidar.points = kPoints;
  table("Default LiDAR", lidar, seeds, first_seed);
  lidar.angle_sigma_deg = 0.15;
  lidar.beam_horizontal_mrad = lidar.beam_vertical_mrad = 0.0;
  lidar.range_sigma_m = 0.009;
  lidar.range_dark_exponent = 0.0;
  table("The paper's noise", lidar, seeds, first_seed);
}

}  // namespace lvcalib::study
