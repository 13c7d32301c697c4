// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "selection/discovery_options.h"
#include "selection/effect_finding.h"
#include "solve/fit_inference.h"

namespace lvcalib {

/// What speaks against a candidate although scenes held out are predicted better with it.
enum class Contradiction {
  kNone,
  kPrints,  ///< White and black print tell different stories about it (see print_contrast.h).
  kScenes,  ///< Tried in the model, it predicts scenes held out worse (see predicts_worse()), or
            ///< nothing is left of it.
  kLevels,  ///< It acts on edges alone, and the intensities in which these are found are doubted.
  kCurve,   ///< Beside a curve over a covariate, which predicts far better, it says nothing.
  kPlace,   ///< Something local predicts better, and with it in the model most of that stays.
};

/// One effect at one shape number, tried in addition to the model.
struct Candidate {
  std::size_t columns = 0;  ///< Index into the linearisation's list.
  ModelFit fit;
  std::vector<double> scene_gain;  ///< Predictive log-density over that without it, per scene.
  /// The density itself: candidates that are compared with different models are ranked by it.
  std::vector<double> scene_density;
  std::vector<double> scene_squares_fall;        ///< Held-out squares over all channels, per scene.
  std::array<double, kChannels> heldout_gain{};  ///< Relative fall of squares, per channel.
  std::array<double, kChannels> heldout_fall{};  ///< Fall of squares, units of the noise.
  /// Largest share of a channel's rows on which one of its parameters acts.
  std::array<double, kChannels> acting_share{1.0, 1.0, 1.0, 1.0};
  double p_value = 1.0;
  double extrinsic_move_sigmas = 0.0;
  MoveLimit limit;          ///< Of the extrinsic if the effect is left out.
  ExtrinsicMove tolerance;  ///< What such a move has to exceed to matter.
  /// The channel that has to show it: of an effect that changes intensities these. Edges alone
  /// cannot tell it from what else moves edges.
  std::optional<Channel> must_show;
  /// Squared distance of the estimate from values that a device can have, in standard deviations.
  double beyond_possible = 0.0;
  [[nodiscard]] bool possible() const;
  /// Share of what is unexplained that it takes away in its main channel, and in the one in which
  /// it acts if it acts in no other, where these miss by more than their noise; 1 elsewhere.
  double explained_share = 1.0;
  Channel explained_in = Channel::kRange;  ///< The channel that this share is of.
  Contradiction contradiction = Contradiction::kNone;
  [[nodiscard]] double total_gain() const;
  [[nodiscard]] double total_density() const;
  [[nodiscard]] double best_heldout_gain() const;
  [[nodiscard]] bool acts_on_edges_alone() const;
  /// The channel whose held-out squares fall most, counted in units of the noise.
  [[nodiscard]] Channel main_channel() const;
  /// Takes the falls of squares from the sums over scenes with and without it; `rows` is what pure
  /// noise would give.
  void set_heldout(const std::array<double, kChannels>& with,
                   const std::array<double, kChannels>& without,
                   const std::array<double, kChannels>& rows);
};

/// The model that candidates are compared with.
struct Reference {
  ColumnSubset subset;  ///< Effects in use: increments of their parameters.
  ModelFit fit;
  std::vector<double> density;                         ///< Per scene.
  std::vector<std::array<double, kChannels>> heldout;  ///< Squares per scene and channel.
};

/// Rows of every channel over all scenes.
std::array<double, kChannels> row_counts(const Linearization& linear);

/// Held-out squares of every scene from the solution without it.
std::vector<std::array<double, kChannels>> heldout_squares(const Linearization& linear,
                                                           const ModelFit& fit, int threads = 1);

/// A scene held out: the squares that are left of each channel, over σ², of how many rows, and the
/// sum of these rows' 1/σ².
struct HeldoutScene {
  std::array<double, kChannels> squares{};
  std::array<double, kChannels> rows{};
  std::array<double, kChannels> weight{};
};
using HeldoutScenes = std::vector<HeldoutScene>;
HeldoutScenes heldout_scenes(const MeasurementTable& table, const Linearization& linear,
                             const Reference& reference);

/// Sum of a channel's squares.
double total_squares(const HeldoutScenes& scenes, Channel channel);

/// Whether scenes held out are predicted worse than before over all channels: n·ln(mean square),
/// minus twice the log-likelihood of n rows whose common σ is what they scatter by, rises by more
/// than its standard error over scenes and by more than `least` a row. So no channel with much that
/// is not explained yet decides alone. The two models may stand on different tables of the same
/// scenes: worse is what is worse both over the σ that each table states and in px, mm and
/// logarithms.
bool predicts_worse(const HeldoutScenes& before, const HeldoutScenes& after, double least);

Reference make_reference(const Linearization& linear, const ColumnSubset& subset,
                         const ModelVariances& start, const MixedModelOptions& options);

/// Evaluates one candidate against the reference; variances are re-estimated with it in the model.
Candidate evaluate_candidate(const Linearization& linear, const Reference& reference,
                             std::size_t columns, const Tolerance& tolerance,
                             const MixedModelOptions& options);

/// Every rule that an effect must pass, with value and threshold:
///   p_value           of the F test, times the candidates tried
///   mean_gain         of the predictive log-density over scenes held out, in standard errors
///   total_gain        of the same, against what the best of so many gains by chance
///   scenes_improved   share of the scenes that say anything which are predicted better
///   two_scenes        how many those are
///   possible          distance from values that a device can have, σ²
///   explained         share of what its channel misses by
///   held_out          fall of held-out squares over the least that counts, or of the extrinsic's
///                     move
/// and whether nothing speaks against it (1, else 0):
///   prints_agree      white and black print tell the same about it
///   edges_trusted     it does not act on edges alone where these are doubted
///   beside_curve      beside a curve that predicts far better it has something left to say
///   beside_place      it takes away half of what predicts better at a place
///   scenes_agree      tried in the model, it predicts scenes held out no worse and stays
/// reason_of() says why each is asked.
/// How large it is, and what it does to the extrinsic, are no rules: what is there is there.
std::vector<Criterion> criteria_of(const Candidate& candidate, std::size_t tried,
                                   std::size_t scenes, const DiscoveryOptions& options);

/// Whether it is there, however small: the test after correction for the search rejects zero and
/// held-out scenes are predicted better.
bool is_sure(const Candidate& candidate, std::size_t tried, const DiscoveryOptions& options);

/// Whether held-out scenes and the test after correction for the search speak for it.
bool is_accepted(const Candidate& candidate, std::size_t tried, std::size_t scenes,
                 const DiscoveryOptions& options);

/// Largest canonical correlation of two candidates' effects after all nuisances.
double correlation_of(const Linearization& linear, const Reference& reference, std::size_t a,
                      std::size_t b);

/// True if held-out scenes do not tell which of the two is better.
bool indistinguishable(const Candidate& a, const Candidate& b);

}  // namespace lvcalib
