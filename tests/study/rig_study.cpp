// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrates many simulated rigs with nothing hidden and compares the results with truth and with
// the Cramér–Rao bound. One CSV line per rig on standard output, the summary at the end.
//
//   rig_study [RIGS] [FIRST_SEED] [FOLDER] [FIRST_INDEX]
//
// Rig k, counted from FIRST_INDEX (0), takes the k-th of three scanners in turn, a board with
// circles or without, and 3 to 10 scenes; seeds are consecutive. An interrupt (Ctrl+C) ends it
// after the rig at hand, with the summary.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include "base/statistics.h"
#include "information_bound.h"
#include "pipeline/calibration.h"
#include "report/result_file.h"
#include "simulation/dataset_writer.h"
#include "simulation/simulator.h"

namespace lvcalib::study {
namespace {

struct RigOutcome {
  int scenes = 0;
  int found = 0;  // scenes whose board is found within 3 cm
  int wrong = 0;  // scenes with a wrong board accepted
  bool solved = false;
  double translation_mm = 0, rotation_mrad = 0;
  double bound_mm = 0, bound_mrad = 0;
  double stated_mm = 0, stated_mrad = 0;
  Vector6d normalized = Vector6d::Zero();
  double dof = 0.0;
  // Components within the 95 % interval.
  [[nodiscard]] int inside() const {
    const boost::math::students_t student(std::max(1.0, dof));
    return static_cast<int>(
        (normalized.cwiseAbs().array() < boost::math::quantile(student, 0.975)).count());
  }
  double bound_chi = 0.0;  // eᵀFe/6
  double node_chi = 0.0;   // The same of the joint solve over nodes and planes.
  int scanner = 0;
  bool circles = true;
  // Squared distance of the extrinsic from what localization agreed on, in the latter's σ.
  double place_chi = 0.0;
  std::vector<double> node_errors_mm;
  std::vector<double> corner_errors_px;
  std::vector<double> view_chi;  // Of the boards' poses from their images alone, eᵀC⁻¹e/6.
  std::string quality;
};

simulation::SimulationOptions rig_options(int index, std::uint64_t seed) {
  using simulation::LidarKind;
  simulation::SimulationOptions options;
  options.seed = seed;
  options.scenes = 3 + (index / 6) % 8;
  options.target.tag_spacing = 0.1 / 0.12;
  if ((index / 3) % 2 == 1) options.target.type = TargetType::kAprilGrid;
  constexpr LidarKind kKinds[] = {LidarKind::kRosette, LidarKind::kAvia, LidarKind::kSpinning};
  options.lidar.kind = kKinds[index % 3];
  return options;
}

void compare_scene(const simulation::SimulatedRig& rig, const simulation::SimulatedScene& truth,
                   const SceneResult& scene, RigOutcome& outcome) {
  if (scene.view) {
    const UncertainRigid3& seen = scene.view->camera_from_board;
    const Vector6d off = se3_log(truth.camera_from_board * seen.transform.inverse());
    outcome.view_chi.push_back(off.dot(seen.covariance.ldlt().solve(off)) / 6.0);
    for (const CornerObservation& c : scene.view->corners) {
      const auto p = rig.camera.project(truth.camera_from_board *
                                        Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
      if (!p) continue;
      outcome.corner_errors_px.push_back(c.pixel.x() - p->x());
      outcome.corner_errors_px.push_back(c.pixel.y() - p->y());
    }
  }
  if (!scene.refinement || !scene.used) return;
  for (const RefinedNode& node : scene.refinement->nodes) {
    if (!node.valid) continue;
    outcome.node_errors_mm.push_back(
        1e3 * (node.center_lidar_m -
               truth.lidar_from_board * Eigen::Vector3d(node.board_m.x(), node.board_m.y(), 0.0))
                  .norm());
  }
}

RigOutcome run_rig(int index, std::uint64_t seed, const std::filesystem::path& folder) {
  RigOutcome outcome;
  const auto options = rig_options(index, seed);
  auto rig = simulation::simulate(options, {});
  if (!rig) {
    outcome.quality = rig.error().text();
    return outcome;
  }
  outcome.scenes = options.scenes;
  const auto path = folder / ("rig" + std::to_string(seed));
  if (auto s = simulation::write_dataset(*rig, path, true); !s) {
    outcome.quality = s.error().text();
    return outcome;
  }
  const auto dataset = open_dataset(path);
  auto result = dataset ? calibrate(*dataset, {}, {}) : Result<CalibrationResult>(dataset.error());
  std::filesystem::remove_all(path);
  std::filesystem::remove(path.string() + "-truth.json");
  if (!result) {
    outcome.quality = result.error().text();
    return outcome;
  }
  outcome.solved = true;
  outcome.quality = name_of(result->quality);
  for (const Message& reason : result->quality_reasons)
    std::fprintf(stderr, "%llu: %s\n", static_cast<unsigned long long>(seed),
                 reason.text().c_str());
  const Rigid3 lidar_from_camera = result->extrinsic.camera_from_lidar.transform.inverse();
  for (std::size_t s = 0; s < rig->scenes.size(); ++s) {
    compare_scene(*rig, rig->scenes[s], result->scenes[s], outcome);
    if (!result->scenes[s].used) continue;
    // Where the joint solve puts the board, which may be elsewhere than it was localized.
    const Eigen::Vector2d c = rig->target.outline().center_m();
    const Eigen::Vector3d middle(c.x(), c.y(), 0.0);
    const auto& solved = result->extrinsic.scenes;
    const auto own = std::find_if(solved.begin(), solved.end(), [&](const SceneSolution& x) {
      return x.name == result->scenes[s].name;
    });
    if (own == solved.end()) continue;
    const Rigid3 board = lidar_from_camera * own->camera_from_board;
    const bool right = (board * middle - rig->scenes[s].lidar_from_board * middle).norm() < 0.03 &&
                       rotation_distance_rad(board, rig->scenes[s].lidar_from_board) < 0.05;
    (right ? outcome.found : outcome.wrong) += 1;
  }
  const ExtrinsicError error = compare_extrinsics({result->extrinsic.camera_from_lidar.transform,
                                                   result->extrinsic.camera_from_lidar.covariance},
                                                  rig->camera_from_lidar);
  outcome.translation_mm = error.translation_mm;
  outcome.rotation_mrad = error.rotation_mrad;
  outcome.normalized = error.normalized;
  const UncertainRigid3& agreed = result->consensus.camera_from_lidar;
  const Vector6d off_agreed =
      se3_log(result->extrinsic.camera_from_lidar.transform * agreed.transform.inverse());
  outcome.place_chi = off_agreed.dot(agreed.covariance.ldlt().solve(off_agreed));
  Matrix6d information = Matrix6d::Zero();
  for (std::size_t s = 0; s < rig->scenes.size(); ++s) {
    if (result->scenes[s].used) information += scene_information(*rig, rig->scenes[s]);
  }
  const auto off = [&](const Rigid3& estimate) -> double {
    const Vector6d e = se3_log(rig->camera_from_lidar * estimate.inverse());
    return e.dot(information * e) / 6.0;
  };
  outcome.bound_chi = off(result->extrinsic.camera_from_lidar.transform);
  for (const MethodResult& m : result->methods) {
    if (m.name == "joint_refined") outcome.node_chi = off(m.camera_from_lidar);
  }
  outcome.scanner = index % 3;
  outcome.circles = rig->target.has_circles();
  outcome.dof = result->forward ? result->forward->dof : 0.0;
  const Matrix6d bound = information.inverse();
  // Translation of the transform itself: δt = ρ + ω × t.
  Eigen::Matrix<double, 3, 6> map;
  map.leftCols<3>().setIdentity();
  map.rightCols<3>() = -skew(rig->camera_from_lidar.translation);
  const Matrix6d& stated = result->extrinsic.camera_from_lidar.covariance;
  outcome.stated_mm = 1e3 * std::sqrt((map * stated * map.transpose()).trace());
  outcome.stated_mrad = 1e3 * std::sqrt(stated.bottomRightCorner<3, 3>().trace());
  outcome.bound_mm = 1e3 * std::sqrt((map * bound * map.transpose()).trace());
  outcome.bound_mrad = 1e3 * std::sqrt(bound.bottomRightCorner<3, 3>().trace());
  return outcome;
}

// Medians and mean of eᵀFe/6 of one scanner and board.
void summarize_kind(const std::vector<RigOutcome>& all, int scanner, bool circles) {
  constexpr const char* kNames[] = {"rosette", "avia", "spinning"};
  std::vector<double> t, r, chi, nodes;
  double sum = 0.0;
  for (const RigOutcome& o : all) {
    if (!o.solved || o.scanner != scanner || o.circles != circles) continue;
    t.push_back(o.translation_mm);
    r.push_back(o.rotation_mrad);
    chi.push_back(o.bound_chi);
    nodes.push_back(o.node_chi);
    sum += o.bound_chi;
  }
  if (t.empty()) return;
  std::printf(
      "%-8s %-15s %3zu rigs: median %.3f mm, %.3f mrad; e'Fe/6 mean %.2f, median %.2f (nodes and "
      "planes %.2f)\n",
      kNames[scanner], circles ? "circles" : "without circles", t.size(), median(t), median(r),
      sum / static_cast<double>(t.size()), median(chi), median(nodes));
}

void summarize(const std::vector<RigOutcome>& all) {
  int scenes = 0, found = 0, wrong = 0, unsolved = 0, inside = 0, components = 0;
  std::vector<double> few_t, few_r, many_t, many_r, t, r, bt, br, nodes, corners, views;
  for (const RigOutcome& o : all) {
    scenes += o.scenes;
    found += o.found;
    wrong += o.wrong;
    unsolved += o.solved ? 0 : 1;
    nodes.insert(nodes.end(), o.node_errors_mm.begin(), o.node_errors_mm.end());
    corners.insert(corners.end(), o.corner_errors_px.begin(), o.corner_errors_px.end());
    views.insert(views.end(), o.view_chi.begin(), o.view_chi.end());
    if (!o.solved) continue;
    t.push_back(o.translation_mm);
    r.push_back(o.rotation_mrad);
    bt.push_back(o.bound_mm);
    br.push_back(o.bound_mrad);
    if (o.scenes == 3) few_t.push_back(o.translation_mm), few_r.push_back(o.rotation_mrad);
    if (o.scenes >= 6) many_t.push_back(o.translation_mm), many_r.push_back(o.rotation_mrad);
    inside += o.inside();
    components += 6;
  }
  std::printf(
      "rigs %zu, not solved %d; scenes %d, board found in %d (%.2f %%), wrong board accepted in "
      "%d\n",
      all.size(), unsolved, scenes, found, 100.0 * found / std::max(1, scenes), wrong);
  std::printf("three scenes: median error %.3f mm, %.3f mrad (%zu rigs)\n", median(few_t),
              median(few_r), few_t.size());
  std::printf("six or more:  median error %.3f mm, %.3f mrad (%zu rigs)\n", median(many_t),
              median(many_r), many_t.size());
  std::printf("RMS %.3f mm, %.3f mrad; bound %.3f mm, %.3f mrad; ratio %.3f, %.3f\n", rms(t),
              rms(r), rms(bt), rms(br), rms(t) / rms(bt), rms(r) / rms(br));
  std::printf("node centres %.3f mm RMS (%zu); corners %.4f px RMS per axis (%zu)\n", rms(nodes),
              nodes.size(), rms(corners), corners.size());
  std::printf("poses of boards in images: mean e'C^-1e/6 %.3f (%zu)\n",
              std::accumulate(views.begin(), views.end(), 0.0) /
                  std::max<double>(1.0, static_cast<double>(views.size())),
              views.size());
  double chi = 0.0;
  for (const RigOutcome& o : all) chi += o.solved ? o.bound_chi : 0.0;
  std::printf("mean of e'Fe/6 over all rigs: %.3f\n",
              chi / std::max<double>(1.0, static_cast<double>(t.size())));
  for (int scanner = 0; scanner < 3; ++scanner) {
    for (const bool circles : {true, false}) summarize_kind(all, scanner, circles);
  }
  std::printf("95 %% intervals cover the truth in %.1f %% of %d components\n",
              100.0 * inside / std::max(1, components), components);
}

volatile std::sig_atomic_t interrupted = 0;

}  // namespace
}  // namespace lvcalib::study

int main(int argc, char** argv) {
  using namespace lvcalib::study;
  const int rigs = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const std::filesystem::path folder = argc > 3 ? argv[3] : std::filesystem::temp_directory_path();
  const int first_index = argc > 4 ? std::atoi(argv[4]) : 0;
  std::vector<RigOutcome> all;
  std::printf(
      "seed,scenes,found,wrong,translation_mm,rotation_mrad,bound_mm,bound_mrad,stated_mm,stated_"
      "mrad,chi,node_chi,place_chi,dof,inside,quality,tx,ty,tz,rx,ry,rz\n");
  std::signal(SIGINT, [](int) { interrupted = 1; });
  for (int k = 0; k < rigs && interrupted == 0; ++k) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(k);
    all.push_back(run_rig(first_index + k, seed, folder));
    const RigOutcome& o = all.back();
    std::printf("%llu,%d,%d,%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.2f,%.0f,%d,%s",
                static_cast<unsigned long long>(seed), o.scenes, o.found, o.wrong, o.translation_mm,
                o.rotation_mrad, o.bound_mm, o.bound_mrad, o.stated_mm, o.stated_mrad, o.bound_chi,
                o.node_chi, o.place_chi, o.dof, o.inside(), o.quality.c_str());
    // Each component's error in its stated standard deviations.
    for (const double z : o.normalized) std::printf(",%.2f", z);
    std::printf("\n");
    std::fflush(stdout);
  }
  summarize(all);
  return 0;
}
