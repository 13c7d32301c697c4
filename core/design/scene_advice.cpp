// SPDX-License-Identifier: BSD-3-Clause
#include "design/scene_advice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>

#include "base/symmetric.h"
#include "base/text.h"
#include "design/predicted_scene.h"

namespace lvcalib {
namespace {

constexpr double kTells = 3.0;       // σ by which a difference must stand out
constexpr double kWorthwhile = 1.2;  // a scene that gains less is not worth the way
// With nine such scenes an effect would be seen; more nobody takes for one question.
constexpr double kHelps = kTells / 3.0;

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

// The effects that the questions are about, and what is known of them and of the extrinsic.
struct Knowledge {
  struct Involved {
    EffectColumns columns;  // In the linearisation of the scenes taken.
    Block block;
  };
  std::map<std::string, Involved> involved;
  std::vector<Block> own;  // Of the effects in use, in their order.
  Eigen::MatrixXd now;     // Information of the scenes taken.
  std::vector<GridPose> poses;
  std::vector<Eigen::MatrixXd> added;  // By a scene at each pose; none when stopped.
};

const std::string& id_of(const EffectColumns& columns) {
  return columns.effect->info().id;
}

// Information of the scenes taken and of every pose of the grid, over all that is involved.
Knowledge collect(const ScenesTaken& taken, const OpenQuestions& questions,
                  const BoardGridOptions& grid, const RunContext& context) {
  Knowledge out;
  ColumnSubset subset;
  EffectColumnsList predicted;
  const auto involve = [&](const EffectColumns& columns) {
    if (out.involved.count(id_of(columns)) != 0) return;
    const auto first = 6 + static_cast<Eigen::Index>(subset.columns.size());
    out.involved[id_of(columns)] = {columns, {first, columns.count()}};
    append_columns(columns, nullptr, subset);
    predicted.add(columns.effect, columns.shape, taken.table);
  };
  const auto& list = taken.linear.columns.list();
  for (std::size_t k = 0; k < taken.in_use.size(); ++k) {
    involve(list[k]);
    out.own.push_back(out.involved.at(id_of(list[k])).block);
  }
  for (const AliasedPair& pair : questions.aliased) involve(list[pair.alias]);
  for (const UnseenEffect& unseen : questions.unseen) involve(list[unseen.effect]);
  const auto size = 6 + static_cast<Eigen::Index>(subset.columns.size());
  out.now = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t k = 0; k < subset.columns.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k) + 6;
    out.now(at, at) = 1.0 / (subset.prior_sigma[k] * subset.prior_sigma[k]);
  }
  for (const SceneProducts& scene : taken.linear.scenes)
    out.now += scene_term(scene, subset, taken.variances).information;
  const SensorModel sensors = sensors_of(taken.table);
  const Rigid3& camera_from_lidar = taken.state.camera_from_lidar;
  out.poses = board_grid(taken.table.target, taken.table.camera, grid);
  std::erase_if(out.poses, [&](const GridPose& pose) {
    return !lidar_sees(sensors, taken.table.target,
                       camera_from_lidar.inverse() * pose.camera_from_board);
  });
  std::iota(subset.columns.begin(), subset.columns.end(), 0);
  out.added = predicted_information(
      out.poses, {sensors, taken.table, camera_from_lidar, predicted, subset, taken.variances},
      context);
  return out;
}

// The pose with the largest value of a function of the information with it.
template <class Value>
std::pair<std::size_t, double> best_pose(const Knowledge& known, Value&& value) {
  std::pair<std::size_t, double> out{0, -HUGE_VAL};
  for (std::size_t k = 0; k < known.added.size(); ++k) {
    const double v = value(known.now + known.added[k]);
    if (v > out.second) out = {k, v};
  }
  return out;
}

Message tell_apart(const Knowledge& known, const ScenesTaken& taken, const std::string& a,
                   const std::string& b) {
  const Block& block_a = known.involved.at(a).block;
  const Block& block_b = known.involved.at(b).block;
  std::vector<Block> rest{{0, 6}};
  Eigen::VectorXd values;
  for (std::size_t k = 0; k < known.own.size(); ++k) {
    if (known.own[k].first == block_a.first)
      values = taken.in_use[k].values;
    else
      rest.push_back(known.own[k]);
  }
  const auto sigmas = [&](const Eigen::MatrixXd& h) {
    return std::sqrt(std::max(0.0, t_optimality(known.now, h, block_a, block_b, rest, values)));
  };
  const auto [pose, after] = best_pose(known, sigmas);
  const double before = sigmas(known.now);
  if (after < kTells || after < kWorthwhile * before) {
    return Message(
        "No further scene of this board will tell %1 from %2 (at best %3 σ); measure instead: %4",
        effect_named(a), effect_named(b), formatted("%.1f", after),
        Message::listed(known.involved.at(b).columns.effect->info().discriminating_pose));
  }
  return Message(
      "To tell %1 from %2, take a scene with the board %3; the difference would stand %4 σ (now "
      "%5 σ)",
      effect_named(a), effect_named(b), known.poses[pose].description(), formatted("%.1f", after),
      formatted("%.1f", before));
}

Message make_visible(const Knowledge& known, const std::string& id, const UnseenEffect& unseen) {
  const Knowledge::Involved& effect = known.involved.at(id);
  std::vector<Block> rest{{0, 6}};
  rest.insert(rest.end(), known.own.begin(), known.own.end());
  const auto mine = indices_of({effect.block});
  const auto others = indices_of(rest);
  const auto t = [&](const Eigen::MatrixXd& h) {
    const Eigen::MatrixXd covariance = symmetric_inverse(schur(h, mine, others));
    double least = HUGE_VAL;
    for (Eigen::Index k = 0; k < effect.block.count; ++k) {
      const double wanted = effect.columns.parameters[static_cast<std::size_t>(k)].size_of_interest;
      least = std::min(least, wanted / std::sqrt(std::max(1e-300, covariance(k, k))));
    }
    return least;
  };
  const auto [pose, after] = best_pose(known, t);
  const double before = t(known.now);
  const Message what = Message("%1 (it could move the extrinsic by %2 mm and %3 mrad)",
                               effect_named(id), formatted("%.1f", unseen.extrinsic_move_mm),
                               formatted("%.2f", unseen.extrinsic_move_mrad));
  if (after < kHelps || after < kWorthwhile * before) {
    return Message("No further scene of this board will show %1; measure instead: %2", what,
                   Message::listed(effect.columns.effect->info().discriminating_pose));
  }
  return Message(
      "To see whether there is %1, take a scene with the board %2; at its size of interest it "
      "would stand %3 σ (now %4 σ)",
      what, known.poses[pose].description(), formatted("%.1f", after), formatted("%.1f", before));
}

// Nothing if no pose is worth the way.
std::optional<Message> shrink_extrinsic(const Knowledge& known) {
  std::vector<Eigen::Index> mine(6);
  std::iota(mine.begin(), mine.end(), 0);
  const auto others = indices_of(known.own);
  const auto worst = [&](const Eigen::MatrixXd& h) {
    const Eigen::MatrixXd information =
        others.empty() ? Eigen::MatrixXd(h(mine, mine)) : schur(h, mine, others);
    // A milliradian weighs as much as a millimetre: they are alike at one metre.
    return 1e3 / std::sqrt(std::max(1e-12, axes_of(information).values.minCoeff()));
  };
  const auto [pose, after] = best_pose(known, [&](const Eigen::MatrixXd& h) { return -worst(h); });
  const double before = worst(known.now);
  if (-after * kWorthwhile > before) return std::nullopt;
  return Message(
      "The extrinsic's weakest direction gains most from a scene with the board %1: its standard "
      "deviation falls from %2 to %3 mm (or mrad)",
      known.poses[pose].description(), formatted("%.2g", before), formatted("%.2g", -after));
}

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

std::vector<Message> advise_scenes(const ScenesTaken& taken, const OpenQuestions& questions,
                                   const BoardGridOptions& grid, const RunContext& context) {
  const Knowledge known = collect(taken, questions, grid, context);
  if (known.added.empty()) return {};
  std::vector<Message> out;
  const auto& list = taken.linear.columns.list();
  for (const auto& [a, b] : questions.aliased)
    out.push_back(tell_apart(known, taken, id_of(list[a]), id_of(list[b])));
  for (const UnseenEffect& unseen : questions.unseen)
    out.push_back(make_visible(known, id_of(list[unseen.effect]), unseen));
  if (const auto scene = shrink_extrinsic(known)) out.push_back(*scene);
  return out;
}

}  // namespace lvcalib
