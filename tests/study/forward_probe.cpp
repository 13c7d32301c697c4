// SPDX-License-Identifier: GPL-3.0-or-later
// Calibrates a dataset and prints what the joint solve over all returns says scene by scene; with
// splits, how far random halves of the scenes disagree.
//
//   forward_probe DATASET [--crops] [--truth FILE] [--splits N] [--free]
//                 [--discover | --given] [--with ID]
//
// --free: intrinsics with a prior as wide as a factory's (1 % of the focal length, 10 px).
// --discover: the splits to first order about the solution of all scenes, without effects and with
// those that discovery finds; --with: with this effect from the start.
// --given: the same with the effects of --with alone.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "base/random.h"
#include "base/statistics.h"
#include "pipeline/calibration.h"
#include "pipeline/forward_stage.h"
#include "pipeline/model_discovery.h"
#include "report/result_file.h"
#include "solve/forward_solver.h"

namespace lvcalib {
namespace {

std::vector<ForwardScene> forward_scenes(const CalibrationResult& result) {
  std::vector<ForwardScene> scenes;
  std::size_t k = 0;
  for (const SceneResult& scene : result.scenes) {
    if (!scene.view || !scene.refinement) continue;
    const SceneSolution& solution = result.extrinsic.scenes[k++];
    if (!solution.used) continue;
    ForwardScene f;
    for (std::size_t i = 0; i < scene.view->corners.size(); ++i) {
      if (solution.corners[i].used) f.corners.push_back(scene.view->corners[i]);
    }
    f.board_points = &scene.board_points;
    f.camera_from_board = solution.camera_from_board;
    f.lidar_from_board = scene.refinement->lidar_from_board;
    f.range_sigma_m = std::max(scene.refinement->plane.group_sigma_m[0],
                               scene.refinement->plane.group_sigma_m[1]);
    scenes.push_back(std::move(f));
  }
  return scenes;
}

void print_solution(const ForwardSolution& s, const ExtrinsicSolution& from) {
  std::vector<std::string> names;
  for (const SceneSolution& scene : from.scenes)
    if (scene.used) names.push_back(scene.name);
  const Matrix6d& c = s.camera_from_lidar.covariance;
  std::printf(
      "t %.4f %.4f %.4f m; sigma %.3f %.3f %.3f mm, %.3f %.3f %.3f mrad; dof %.0f; %d "
      "iterations%s\n",
      s.state.camera_from_lidar.translation.x(), s.state.camera_from_lidar.translation.y(),
      s.state.camera_from_lidar.translation.z(), 1e3 * std::sqrt(c(0, 0)), 1e3 * std::sqrt(c(1, 1)),
      1e3 * std::sqrt(c(2, 2)), 1e3 * std::sqrt(c(3, 3)), 1e3 * std::sqrt(c(4, 4)),
      1e3 * std::sqrt(c(5, 5)), s.dof, s.iterations, s.converged ? "" : ", NOT CONVERGED");
  const Eigen::Matrix2d& b = s.state.beam.blur_rad2;
  const Eigen::Matrix2d& j = s.state.beam.jitter_rad2;
  std::printf("blur %.3f x %.3f mrad (cov %.3f), jitter %.3f x %.3f mrad; corner %.4f px; \n",
              1e3 * std::sqrt(b(0, 0)), 1e3 * std::sqrt(b(1, 1)), 1e6 * b(0, 1),
              1e3 * std::sqrt(j(0, 0)), 1e3 * std::sqrt(j(1, 1)), s.noise.corner_px);
  std::printf("camera %.2f %.2f %.2f %.2f %.5f %.5f %.5f %.5f\n", s.state.camera.fx,
              s.state.camera.fy, s.state.camera.cx, s.state.camera.cy, s.state.camera.distortion(0),
              s.state.camera.distortion(1), s.state.camera.distortion(2),
              s.state.camera.distortion(3));
  std::printf("shared:");
  for (const double v : s.noise.shared) std::printf(" %.4f", 1e3 * std::sqrt(v));
  std::printf(" (x 1e-3)\n");
  for (std::size_t i = 0; i < s.scenes.size(); ++i) {
    const ForwardSceneResult& r = s.scenes[i];
    std::printf(
        "  %-6s rows %6zu of %6zu (%zu refused) corr %.3f margin %6.1f left %.3f chi r %.2f i %.2f "
        "c %.2f; range %.1f %.1f mm infl %.2f, levels %.1f %.1f noise %.2f %.2f infl %.2f\n",
        names[i].c_str(), r.returns, r.on_board, r.refused, r.print_correlation, r.print_margin,
        r.intensity_left, r.range_chi, r.intensity_chi, r.corner_chi, 1e3 * r.noise.range_white_m,
        1e3 * r.noise.range_black_m, r.noise.range_inflation, s.state.levels[i].white,
        s.state.levels[i].black, r.noise.intensity_white, r.noise.intensity_black,
        r.noise.intensity_inflation);
    const Eigen::VectorXd& u = s.state.shared[i];
    if (u.size() > 0)
      std::printf("         board %.2f %.2f %.2f mm %.2f %.2f %.2f mrad\n", 1e3 * u(0), 1e3 * u(1),
                  1e3 * u(2), 1e3 * u(3), 1e3 * u(4), 1e3 * u(5));
    if (u.size() > 0) {
      const Rigid3 lb = s.state.lidar_from_board(i);
      const Eigen::Vector3d c = lb * Eigen::Vector3d(0.19, 0.285, 0);
      const Eigen::Vector3d d = lb.rotation * Eigen::Vector3d(u(0), u(1), u(2));
      const BeamAxes axes = beam_axes(c.normalized());
      const auto px = s.state.camera.project(s.state.camera_from_lidar * c);
      std::printf(
          "         at az %.1f el %.1f deg r %.2f; moved h %.2f v %.2f mm; pixel %.0f %.0f\n",
          57.3 * std::atan2(c.y(), c.x()), 57.3 * std::asin(c.z() / c.norm()), c.norm(),
          1e3 * d.dot(axes.horizontal), 1e3 * d.dot(axes.vertical), px ? px->x() : 0.0,
          px ? px->y() : 0.0);
    }
  }
}

void compare_truth(const char* name, const UncertainRigid3& x, const std::string& file) {
  const auto truth = read_truth(file);
  if (!truth) return;
  const ExtrinsicError e = compare_extrinsics({x.transform, x.covariance}, *truth);
  std::printf("%s: %.3f mm %.3f mrad off truth; in sigma", name, e.translation_mm, e.rotation_mrad);
  for (int k = 0; k < 6; ++k) std::printf(" %.2f", e.normalized(k));
  std::printf("\n");
}

// Solves some of the scenes; nothing if they do not determine the extrinsic.
using HalfSolver =
    std::function<std::optional<UncertainRigid3>(const std::vector<std::size_t>& scenes)>;

// How far random halves of the scenes disagree, and what they state.
void print_splits(const char* name, std::size_t scenes, int splits, const HalfSolver& solve) {
  Random random(1);
  std::vector<double> mm, mrad;
  int inside = 0, whole = 0, components = 0;
  double chi = 0.0;
  for (int k = 0; k < splits; ++k) {
    std::vector<std::size_t> order(scenes);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[random.below(static_cast<std::uint32_t>(i))]);
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
    const auto x = solve({order.begin(), middle});
    const auto y = solve({middle, order.end()});
    if (!x || !y) continue;
    const Rigid3& tx = x->transform;
    const Rigid3& ty = y->transform;
    mm.push_back(1e3 * translation_distance_m(tx.inverse(), ty.inverse()));
    mrad.push_back(1e3 * rotation_distance_rad(tx, ty));
    const Vector6d xi = se3_log(tx * ty.inverse());
    const Matrix6d cov = x->covariance + y->covariance;
    const Eigen::Vector3d apart = 1e3 * (ty.inverse().translation - tx.inverse().translation);
    const Eigen::Vector3d turned = 1e3 * so3_log((tx.inverse() * ty).rotation);
    std::printf(
        "split %zu: camera in lidar %.1f %.1f %.1f mm, rotation %.2f %.2f %.2f mrad, sigma %.1f "
        "%.1f %.1f mm\n",
        mm.size(), apart.x(), apart.y(), apart.z(), turned.x(), turned.y(), turned.z(),
        1e3 * std::sqrt(cov(0, 0)), 1e3 * std::sqrt(cov(1, 1)), 1e3 * std::sqrt(cov(2, 2)));
    chi += xi.dot(cov.ldlt().solve(xi)) / 6.0;
    int here = 0;
    for (int i = 0; i < 6; ++i) here += std::abs(xi(i)) < 2.0 * std::sqrt(cov(i, i)) ? 1 : 0;
    inside += here;
    whole += here == 6 ? 1 : 0;
    components += 6;
  }
  if (mm.empty()) return;
  std::printf(
      "%s, splits %zu: median %.2f mm %.3f mrad; within twice combined sigma %.1f %% of the "
      "components, all six in %.0f %%; mean chi2/6 %.2f\n",
      name, mm.size(), median(mm), median(mrad), 100.0 * inside / components,
      100.0 * whole / static_cast<double>(mm.size()), chi / static_cast<double>(mm.size()));
}

// The same of the base model to first order about the solution of all scenes, and of the model that
// discovery finds, its effects estimated anew from each half.
void print_splits_of_model(const CalibrationResult& result, const std::vector<std::string>& with,
                           bool given, int splits) {
  if (!result.forward) return;
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < result.extrinsic.scenes.size(); ++k) {
    if (result.extrinsic.scenes[k].used) used.push_back(k);
  }
  const auto halves = [&](const SubsetSolver& subset) {
    return [&used, subset](const std::vector<std::size_t>& half) {
      std::vector<std::size_t> some;
      for (const std::size_t i : half) some.push_back(used[i]);
      return subset(some);
    };
  };
  print_splits("first order", used.size(), splits,
               halves(forward_subsets(*result.forward, result.extrinsic)));
  DiscoveryOptions options = discovery_options(result);
  options.with = with;
  if (given) options.max_effects = 0;
  options.advise_scenes = false;
  const auto found = discover(result, options, {});
  if (!found) {
    std::fprintf(stderr, "%s\n", found.error().text().c_str());
    return;
  }
  const Vector6d apart =
      se3_log(found->state.camera_from_lidar * result.forward->state.camera_from_lidar.inverse());
  std::printf("model from calibration, in the calibration's sigma:");
  for (int k = 0; k < 6; ++k)
    std::printf(" %.3f", apart(k) / std::sqrt(result.forward->camera_from_lidar.covariance(k, k)));
  std::printf("\nmodel's channels:");
  for (const double v : found->fit->variances.channel) std::printf(" %.3f", v);
  std::printf("; groups:");
  for (const double v : found->fit->variances.group) std::printf(" %.4f", 1e3 * std::sqrt(v));
  std::printf(" (x 1e-3)\n");
  for (const EffectInUse& use : found->model)
    std::printf("%s: %s\n", use.effect->info().id.c_str(),
                (std::ostringstream() << use.values.transpose()).str().c_str());
  std::string model = "with";
  for (const std::string& id : found->selected) model += " " + id;
  print_splits(model.c_str(), used.size(), splits,
               halves(model_subsets(found->fit, found->state.camera_from_lidar, result.extrinsic)));
}

}  // namespace
}  // namespace lvcalib

int main(int argc, char** argv) {
  using namespace lvcalib;
  using Clock = std::chrono::steady_clock;
  if (argc < 2) return 2;
  CalibrationRequest request;
  std::string truth;
  int splits = 0;
  bool find = false, given = false;
  std::vector<std::string> with;
  ForwardOptions how;
  for (int i = 2; i < argc; ++i) {
    if (std::strcmp(argv[i], "--crops") == 0) request.use_crops = true;
    if (std::strcmp(argv[i], "--truth") == 0) truth = argv[++i];
    if (std::strcmp(argv[i], "--no-intensity") == 0) request.options.clouds.use_intensity = false;
    if (std::strcmp(argv[i], "--free") == 0)
      how.intrinsics_sigma << 12, 12, 10, 10, 0.05, 0.05, 0.05, 0.05, 0, 0, 0, 0;
    if (std::strcmp(argv[i], "--discover") == 0) find = true;
    if (std::strcmp(argv[i], "--given") == 0) find = given = true;
    if (std::strcmp(argv[i], "--with") == 0) with.emplace_back(argv[++i]);
    if (std::strcmp(argv[i], "--splits") == 0) splits = std::atoi(argv[++i]);
  }
  const auto dataset = open_dataset(argv[1]);
  if (!dataset) return std::fprintf(stderr, "%s\n", dataset.error().text().c_str()), 3;
  const auto result = calibrate(*dataset, request, {});
  if (!result) return std::fprintf(stderr, "%s\n", result.error().text().c_str()), 1;
  const auto scenes = forward_scenes(*result);
  auto t0 = Clock::now();
  const BlurredPrint print(result->target);
  const auto solved =
      solve_forward({scenes, print, result->camera, result->extrinsic.camera_from_lidar.transform,
                     result->extrinsic.sigma_px},
                    how, {});
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - t0).count();
  if (!solved) return std::fprintf(stderr, "%s\n", solved.error().text().c_str()), 1;
  std::printf("calibrate %.0f ms, forward %.0f ms\n", result->times.total_ms, ms);
  print_solution(*solved, result->extrinsic);
  const Rigid3& a = result->extrinsic.camera_from_lidar.transform;
  const Rigid3& b = solved->camera_from_lidar.transform;
  std::printf("moved from the nodes' solution by %.2f mm %.3f mrad\n",
              1e3 * translation_distance_m(a.inverse(), b.inverse()),
              1e3 * rotation_distance_rad(a, b));
  if (!truth.empty()) {
    compare_truth("nodes  ", result->extrinsic.camera_from_lidar, truth);
    compare_truth("forward", solved->camera_from_lidar, truth);
  }
  if (find) {
    print_splits_of_model(*result, with, given, splits);
    return 0;
  }
  print_splits("solved anew", scenes.size(), splits, [&](const std::vector<std::size_t>& half) {
    std::vector<ForwardScene> some;
    for (const std::size_t i : half) some.push_back(scenes[i]);
    const auto x =
        solve_forward({some, print, result->camera, a, result->extrinsic.sigma_px}, how, {});
    return x ? std::optional(x->camera_from_lidar) : std::nullopt;
  });
  return 0;
}
