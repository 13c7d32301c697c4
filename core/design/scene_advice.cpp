// SPDX-License-Identifier: BSD-3-Clause
#include "design/scene_advice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "base/text.h"
#include "design/predicted_scene.h"

namespace lvcalib {
namespace {

constexpr double kTells = 3.0;       // σ by which a difference must stand out
constexpr double kWorthwhile = 1.2;  // a scene that gains less is not worth the way

using Block = InformationBlock;

std::vector<Eigen::Index> indices_of(const std::vector<Block>& blocks) {
  std::vector<Eigen::Index> out;
  for (const Block& b : blocks) {
    for (Eigen::Index k = 0; k < b.count; ++k) out.push_back(b.first + k);
  }
  return out;
}

// Information of `mine` once `rest` is integrated out.
Eigen::MatrixXd schur(const Eigen::MatrixXd& h, const std::vector<Eigen::Index>& mine,
                      const std::vector<Eigen::Index>& rest) {
  const Eigen::MatrixXd cross = h(rest, mine);
  return Eigen::MatrixXd(h(mine, mine)) -
         cross.transpose() * Eigen::MatrixXd(h(rest, rest)).ldlt().solve(cross);
}

class Adviser {
 public:
  Adviser(const ScenesTaken& taken, const OpenQuestions& questions, const BoardGridOptions& grid,
          const RunContext& context)
      : taken_(taken), questions_(questions), grid_(grid), context_(context) {}

  std::vector<std::string> run() {
    if (!collect()) return {};
    for (const auto& [a, b] : questions_.aliased) tell_apart(id_of(a), id_of(b));
    for (const UnseenEffect& unseen : questions_.unseen) make_visible(unseen);
    shrink_extrinsic();
    return std::move(out_);
  }

 private:
  struct Involved {
    EffectColumns columns;  // in the linearisation of the scenes taken
    Block block;
  };

  [[nodiscard]] const std::string& id_of(std::size_t k) const {
    return taken_.linear.columns.list()[k].effect->info().id;
  }

  void involve(const EffectColumns& columns) {
    const std::string& id = columns.effect->info().id;
    if (involved_.count(id) != 0) return;
    const auto first = 6 + static_cast<Eigen::Index>(subset_.columns.size());
    involved_[id] = {columns, {first, columns.count()}};
    append_columns(columns, nullptr, subset_);
    predicted_columns_.add(columns.effect, columns.shape, taken_.table);
  }

  // Information of the scenes taken and of every pose of the grid, over all that is involved.
  bool collect() {
    const auto& list = taken_.linear.columns.list();
    for (std::size_t k = 0; k < taken_.in_use.size(); ++k) {
      involve(list[k]);
      own_.push_back(involved_.at(list[k].effect->info().id).block);
    }
    for (const AliasedPair& pair : questions_.aliased) involve(list[pair.alias]);
    for (const UnseenEffect& unseen : questions_.unseen) involve(list[unseen.effect]);
    const ModelVariances& variances = taken_.variances;
    const auto size = 6 + static_cast<Eigen::Index>(subset_.columns.size());
    now_ = Eigen::MatrixXd::Zero(size, size);
    for (std::size_t k = 0; k < subset_.columns.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k) + 6;
      now_(at, at) = 1.0 / (subset_.prior_sigma[k] * subset_.prior_sigma[k]);
    }
    for (const SceneProducts& scene : taken_.linear.scenes)
      now_ += scene_term(scene, subset_, variances).information;
    const SensorModel sensors = sensors_of(taken_.table);
    const Rigid3& camera_from_lidar = taken_.state.camera_from_lidar;
    poses_ = board_grid(taken_.table.target, taken_.table.camera, grid_);
    std::erase_if(poses_, [&](const GridPose& pose) {
      return !lidar_sees(sensors, taken_.table.target,
                         camera_from_lidar.inverse() * pose.camera_from_board);
    });
    ColumnSubset subset = subset_;
    std::iota(subset.columns.begin(), subset.columns.end(), 0);
    added_ = predicted_information(poses_, sensors, taken_.table, camera_from_lidar,
                                   predicted_columns_, subset, variances, context_);
    return !added_.empty();
  }

  // The pose with the largest value of a function of the information with it.
  template <class Value>
  std::pair<std::size_t, double> best(Value&& value) const {
    std::pair<std::size_t, double> out{0, -HUGE_VAL};
    for (std::size_t k = 0; k < added_.size(); ++k) {
      const double v = value(now_ + added_[k]);
      if (v > out.second) out = {k, v};
    }
    return out;
  }

  void tell_apart(const std::string& a, const std::string& b) {
    const Block& block_a = involved_.at(a).block;
    const Block& block_b = involved_.at(b).block;
    std::vector<Block> rest{{0, 6}};
    Eigen::VectorXd values;
    for (std::size_t k = 0; k < own_.size(); ++k) {
      if (own_[k].first == block_a.first)
        values = taken_.in_use[k].values;
      else
        rest.push_back(own_[k]);
    }
    const auto sigmas = [&](const Eigen::MatrixXd& h) {
      return std::sqrt(std::max(0.0, t_optimality(now_, h, block_a, block_b, rest, values)));
    };
    const auto [pose, after] = best(sigmas);
    const double before = sigmas(now_);
    if (after < kTells || after < kWorthwhile * before) {
      out_.push_back("No further scene of this board will tell " + a + " from " + b +
                     formatted(" (at best %.1f σ); measure instead: ", after) +
                     involved_.at(b).columns.effect->info().discriminating_pose);
      return;
    }
    out_.push_back("To tell " + a + " from " + b + ", take a scene with the board " +
                   poses_[pose].text() +
                   formatted("; the difference would stand %.1f σ (now %.1f σ)", after, before));
  }

  void make_visible(const UnseenEffect& unseen) {
    const std::string& id = id_of(unseen.effect);
    const Involved& effect = involved_.at(id);
    std::vector<Block> rest{{0, 6}};
    rest.insert(rest.end(), own_.begin(), own_.end());
    const auto mine = indices_of({effect.block});
    const auto others = indices_of(rest);
    const auto t = [&](const Eigen::MatrixXd& h) {
      const Eigen::MatrixXd covariance =
          schur(h, mine, others)
              .ldlt()
              .solve(Eigen::MatrixXd::Identity(effect.block.count, effect.block.count));
      double least = HUGE_VAL;
      for (Eigen::Index k = 0; k < effect.block.count; ++k) {
        const double material = effect.columns.parameters[static_cast<std::size_t>(k)].material;
        least = std::min(least, material / std::sqrt(std::max(1e-300, covariance(k, k))));
      }
      return least;
    };
    const auto [pose, after] = best(t);
    const double before = t(now_);
    const std::string what =
        id + formatted(" (it could move the extrinsic by %.1f mm and %.2f mrad)",
                       unseen.extrinsic_move_mm, unseen.extrinsic_move_mrad);
    if (after < kWorthwhile * before) {
      out_.push_back("No further scene of this board will show " + what +
                     "; measure instead: " + effect.columns.effect->info().discriminating_pose);
      return;
    }
    out_.push_back(
        "To see whether there is " + what + ", take a scene with the board " + poses_[pose].text() +
        formatted("; what matters of it would stand %.1f σ (now %.1f σ)", after, before));
  }

  void shrink_extrinsic() {
    std::vector<Eigen::Index> mine(6);
    std::iota(mine.begin(), mine.end(), 0);
    const auto others = indices_of(own_);
    const auto worst = [&](const Eigen::MatrixXd& h) {
      const Eigen::MatrixXd information =
          others.empty() ? Eigen::MatrixXd(h(mine, mine)) : schur(h, mine, others);
      // A milliradian weighs as much as a millimetre: they are alike at one metre.
      return 1e3 /
             std::sqrt(std::max(1e-12, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(information)
                                           .eigenvalues()
                                           .minCoeff()));
    };
    const auto [pose, after] = best([&](const Eigen::MatrixXd& h) { return -worst(h); });
    const double before = worst(now_);
    if (-after * kWorthwhile > before) return;
    out_.push_back(
        "The extrinsic's weakest direction gains most from a scene with the board " +
        poses_[pose].text() +
        formatted(": its standard deviation falls from %.2g to %.2g mm (or mrad)", before, -after));
  }

  const ScenesTaken& taken_;
  const OpenQuestions& questions_;
  const BoardGridOptions& grid_;
  const RunContext& context_;
  std::map<std::string, Involved> involved_;
  std::vector<Block> own_;
  ColumnSubset subset_;
  EffectColumnsList predicted_columns_;
  Eigen::MatrixXd now_;
  std::vector<GridPose> poses_;
  std::vector<Eigen::MatrixXd> added_;
  std::vector<std::string> out_;
};

}  // namespace

double noncentrality(const Eigen::MatrixXd& information, const InformationBlock& mine,
                     const std::vector<InformationBlock>& rest, const Eigen::VectorXd& values) {
  return values.dot(schur(information, indices_of({mine}), indices_of(rest)) * values);
}

double t_optimality(const Eigen::MatrixXd& now, const Eigen::MatrixXd& with_scene,
                    const InformationBlock& a, const InformationBlock& b,
                    const std::vector<InformationBlock>& rest, const Eigen::VectorXd& values) {
  const auto both = schur(now, indices_of({a, b}), indices_of(rest));
  const Eigen::VectorXd mimic = Eigen::MatrixXd(both.bottomRightCorner(b.count, b.count))
                                    .ldlt()
                                    .solve(both.bottomLeftCorner(b.count, a.count) * values);
  std::vector<InformationBlock> without_a = rest;
  without_a.push_back(b);
  std::vector<InformationBlock> without_b = rest;
  without_b.push_back(a);
  return 0.5 * (noncentrality(with_scene, a, without_a, values) +
                noncentrality(with_scene, b, without_b, mimic));
}

std::vector<std::string> advise_scenes(const ScenesTaken& taken, const OpenQuestions& questions,
                                       const BoardGridOptions& grid, const RunContext& context) {
  return Adviser(taken, questions, grid, context).run();
}

}  // namespace lvcalib
