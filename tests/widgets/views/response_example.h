// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A boundary response as the calibration gives it, with known numbers.

#include <cmath>
#include <numbers>
#include <random>

#include "base/statistics.h"
#include "views/response_plots.h"

namespace lvcalib::widgets::test {

inline constexpr double kBlack = 20.0;
inline constexpr double kWhite = 120.0;
inline constexpr double kPitchSigmaDeg = 0.12;
inline constexpr double kYawSigmaDeg = 0.2;
inline constexpr double kRangeSigmaM = 0.009;

/// One circle in use (radius 60 mm about the board's origin), samples to 20 mm about its edge.
inline SceneResponse response_scene(const std::string& name, int samples) {
  SceneResponse scene;
  scene.name = name;
  NodeResponse node;
  node.state = NodeResponseState::kUsed;
  node.samples = samples;
  scene.nodes = {node};
  TransitionFit fit;
  fit.mu_in = kBlack;
  fit.mu_out = kWhite;
  fit.sigma_m = 0.004;
  fit.delta_m = 0.0005;
  scene.transition = fit;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> distance(-0.02, 0.02);
  std::normal_distribution<double> normal;
  constexpr double kRadians = std::numbers::pi / 180.0;
  for (int k = 0; k < samples; ++k) {
    BoundarySample s;
    const double d = distance(random);
    const double angle = 2.0 * std::numbers::pi * k / samples;
    s.outward =
        Eigen::Vector2f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)));
    s.board_m = static_cast<float>(0.06 + d) * s.outward;
    s.distance_m = static_cast<float>(d);
    const double white = normal_cdf((d - fit.delta_m) / fit.sigma_m);
    s.intensity = static_cast<float>(kBlack + white * (kWhite - kBlack) + normal(random));
    s.overlap = std::abs(d) < 0.01;
    s.range_residual_m = static_cast<float>(kRangeSigmaM * normal(random));
    s.residual = Eigen::Vector3f(static_cast<float>(kRadians * kPitchSigmaDeg * normal(random)),
                                 static_cast<float>(kRadians * kYawSigmaDeg * normal(random)),
                                 s.range_residual_m);
    scene.nodes[0].overlap += s.overlap ? 1 : 0;
    scene.samples.push_back(s);
  }
  ResponseStatistics statistics;
  statistics.n = scene.nodes[0].overlap;
  statistics.covariance.diagonal() << std::pow(kRadians * kPitchSigmaDeg, 2),
      std::pow(kRadians * kYawSigmaDeg, 2), std::pow(kRangeSigmaM, 2);
  statistics.paired = statistics.covariance;
  scene.statistics = statistics;
  return scene;
}

/// The scenes must outlive the scope.
inline ResponseScope scope_of(const std::vector<const SceneResponse*>& scenes) {
  ResponseScope scope;
  scope.scenes = scenes;
  for (std::size_t k = 0; k < scenes.size(); ++k) scope.colors.push_back(static_cast<int>(k));
  scope.transition = &*scenes.front()->transition;
  scope.statistics = &*scenes.front()->statistics;
  return scope;
}

}  // namespace lvcalib::widgets::test
