// SPDX-License-Identifier: BSD-3-Clause
#include "localization/scene_consensus.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

// One reading of one scene: the extrinsic it implies.
struct Proposal {
  std::size_t scene = 0;
  std::size_t candidate = 0;
  double gain = 0.0;
  UncertainRigid3 camera_from_lidar;
};

// Chance of refusing a true match: one in ten thousand.
double agreement_gate() {
  static const double gate = chi_square_gate(6, 1e-4);
  return gate;
}

double squared_distance(const UncertainRigid3& a, const UncertainRigid3& b) {
  const Vector6d delta = se3_log(a.transform * b.transform.inverse());
  return squared_mahalanobis<6>(delta, a.covariance + b.covariance);
}

std::vector<Proposal> propose(const std::vector<SceneHypotheses>& scenes,
                              const std::optional<Rigid3>& guess, const ConsensusOptions& options) {
  std::vector<Proposal> out;
  Matrix6d systematic = Matrix6d::Zero();
  systematic.diagonal().head<3>().setConstant(std::pow(options.systematic_translation_m, 2));
  systematic.diagonal().tail<3>().setConstant(std::pow(options.systematic_rotation_rad, 2));
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    for (std::size_t k = 0; k < scenes[s].candidates.size(); ++k) {
      const BoardCandidate& candidate = scenes[s].candidates[k];
      const auto add = [&](const Rigid3& camera_from_board) {
        Proposal p;
        p.scene = s;
        p.candidate = k;
        p.gain = candidate.gain;
        // The systematic part acts at the board, where the two sensors meet, not at the camera.
        UncertainRigid3 camera{camera_from_board, scenes[s].camera_from_board.covariance};
        const Matrix6d ad =
            Rigid3{Eigen::Quaterniond::Identity(), camera_from_board.translation}.adjoint();
        camera.covariance += ad * systematic * ad.transpose();
        p.camera_from_lidar = camera * candidate.lidar_from_board.inverse();
        if (guess && (translation_distance_m(p.camera_from_lidar.transform.inverse(),
                                             guess->inverse()) > options.guess_translation_m ||
                      rotation_distance_rad(p.camera_from_lidar.transform, *guess) >
                          options.guess_rotation_rad)) {
          return;
        }
        out.push_back(std::move(p));
      };
      add(scenes[s].camera_from_board.transform);
      if (scenes[s].alternative_camera_from_board) add(*scenes[s].alternative_camera_from_board);
    }
  }
  return out;
}

struct Vote {
  double score = 0.0;
  std::vector<std::optional<std::size_t>> proposals;  // per scene, index into the proposals
  std::vector<double> values;                         // per scene, what they add to the score
};

Vote count_votes(const std::vector<Proposal>& proposals, std::size_t scenes,
                 const UncertainRigid3& extrinsic, bool own_scene_exact, std::size_t own) {
  Vote vote;
  vote.proposals.resize(scenes);
  vote.values.assign(scenes, 0.0);
  for (std::size_t p = 0; p < proposals.size(); ++p) {
    const Proposal& proposal = proposals[p];
    if (own_scene_exact && proposal.scene == proposals[own].scene && p != own) continue;
    const double d =
        own_scene_exact && p == own ? 0.0 : squared_distance(proposal.camera_from_lidar, extrinsic);
    if (d > agreement_gate()) continue;
    const double value = proposal.gain - 0.5 * d;
    if (!vote.proposals[proposal.scene] || value > vote.values[proposal.scene]) {
      vote.proposals[proposal.scene] = p;
      vote.values[proposal.scene] = value;
    }
  }
  for (const double value : vote.values) vote.score += value;
  return vote;
}

// The part of a vote that comes from boards which stand elsewhere than those of another one. Boards
// side by side are a board's width apart, of which the narrowest that a LiDAR resolves has twice
// this; readings of one board differ by less, or turn it about its middle.
double evidence_elsewhere(const std::vector<SceneHypotheses>& scenes,
                          const std::vector<Proposal>& proposals, const Vote& vote,
                          const Vote& chosen) {
  constexpr double kApart_m = 0.2;
  const auto middle = [&](std::size_t s, std::size_t p) -> Eigen::Vector3d {
    const Eigen::Vector2d& at = scenes[s].board_middle_m;
    return scenes[s].candidates[proposals[p].candidate].lidar_from_board.transform *
           Eigen::Vector3d(at.x(), at.y(), 0.0);
  };
  double out = 0.0;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!vote.proposals[s] || !chosen.proposals[s]) continue;
    if ((middle(s, *vote.proposals[s]) - middle(s, *chosen.proposals[s])).norm() > kApart_m)
      out += vote.values[s];
  }
  return out;
}

// The mean of the agreeing proposals, at least one.
UncertainRigid3 fuse(const std::vector<Proposal>& proposals, const Vote& vote) {
  std::vector<UncertainRigid3> agreeing;
  for (const auto& index : vote.proposals) {
    if (index) agreeing.push_back(proposals[*index].camera_from_lidar);
  }
  return information_mean(agreeing);
}

}  // namespace

std::optional<SceneConsensus> decide_scenes(const std::vector<SceneHypotheses>& scenes,
                                            const std::optional<Rigid3>& guess,
                                            const ConsensusOptions& options) {
  const std::vector<Proposal> proposals = propose(scenes, guess, options);
  if (proposals.empty()) return std::nullopt;
  std::vector<Vote> votes;
  std::size_t best = 0;
  for (std::size_t p = 0; p < proposals.size(); ++p) {
    votes.push_back(count_votes(proposals, scenes.size(), proposals[p].camera_from_lidar, true, p));
    if (votes[p].score > votes[best].score) best = p;
  }
  SceneConsensus result;
  result.camera_from_lidar = fuse(proposals, votes[best]);
  // A second count about the mean: the first is only as good as the scene it started from.
  const Vote final_vote = count_votes(proposals, scenes.size(), result.camera_from_lidar, false, 0);
  if (final_vote.score > 0.0 && final_vote.score >= votes[best].score) {
    result.camera_from_lidar = fuse(proposals, final_vote);
    votes[best] = final_vote;
  }
  result.score = votes[best].score;
  result.chosen.resize(scenes.size());
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    if (!votes[best].proposals[s]) continue;
    result.chosen[s] = proposals[*votes[best].proposals[s]].candidate;
    ++result.agreeing;
  }
  for (std::size_t p = 0; p < proposals.size(); ++p) {
    if (squared_distance(proposals[p].camera_from_lidar, result.camera_from_lidar) >
        agreement_gate()) {
      result.runner_up = std::max(result.runner_up, votes[p].score);
      result.elsewhere =
          std::max(result.elsewhere, evidence_elsewhere(scenes, proposals, votes[p], votes[best]));
    }
  }
  return result;
}

}  // namespace lvcalib
