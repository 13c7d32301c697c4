// SPDX-License-Identifier: BSD-3-Clause
#include "selection/print_contrast.h"

#include <algorithm>
#include <memory>

#include "base/symmetric.h"
#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

// A constant by which black print reads farther than white.
class PrintDifference final : public CatalogueEffect {
 public:
  PrintDifference() : CatalogueEffect({}, {{"a", "mm", 1e-3, 2e-3, 0.05}}) {}
  void lidar(const BeamPoint& beam, const MeasurementTable& /*table*/, double /*shape*/,
             std::span<Eigen::Vector3d> by) const override {
    by[0] = beam.darkness * beam.direction;
  }
};

// A candidate, its print contrast and a constant difference between the prints beside the model.
class PrintContrast {
 public:
  PrintContrast(const ModelInUse& model, const EffectColumns& candidate, Channel channel,
                const DiscoveryOptions& options, const RunContext& context)
      : model_(model),
        channel_(channel),
        options_(options),
        with_(model.columns),
        at_(model.columns.list().size()) {
    with_.add(candidate.effect, candidate.shape, model.table);
    with_.add_print_contrast(candidate.effect, candidate.shape, model.table);
    with_.add(std::make_shared<PrintDifference>(), 0.0, model.table);
    linear_ = linearize(model.table, model.state, model.effects, with_, context);
  }

  [[nodiscard]] bool disagrees() const {
    const bool told =
        std::any_of(model_.effects.begin(), model_.effects.end(),
                    [](const EffectInUse& use) { return use.effect->is_about_prints(); });
    ModelFit fit = fitted(!told && channel_ == Channel::kRange);
    // A constant between the prints is the contrast of an offset itself: who is it? What is about
    // prints comes first, and the offset is asked again beside it.
    if (!told && !is_determined(fit)) fit = fitted(false);
    if (!is_determined(fit) || f_test(fit, count()) > alarm()) return false;
    return one_shows_nothing(fit);
  }

 private:
  // Every effect of the catalogue may be asked.
  [[nodiscard]] double alarm() const {
    return options_.false_alarm / static_cast<double>(effect_catalogue().size());
  }
  [[nodiscard]] Eigen::Index count() const { return with_.list()[at_].count(); }

  [[nodiscard]] ModelFit fitted(bool beside_difference) const {
    ColumnSubset all = model_.subset;
    if (beside_difference) append_columns(with_.list()[at_ + 2], nullptr, all);
    append_columns(with_.list()[at_], nullptr, all);
    append_columns(with_.list()[at_ + 1], nullptr, all);
    return fit_model(linear_, all, model_.variances, {.rounds = 3});
  }

  [[nodiscard]] bool is_determined(const ModelFit& fit) const {
    constexpr double kDetermined = 1e-3;
    return determined_share(fit, fit.solution.size() - count(), count()) > kDetermined;
  }

  // The effect is the sum on white print and the difference on black.
  [[nodiscard]] bool one_shows_nothing(const ModelFit& fit) const {
    const Eigen::Index p = count();
    // What the data tell of the contrast once everything else has adapted, measures sizes: what
    // pose and levels take over is no story of a print.
    const Eigen::MatrixXd told = information_of_last(fit, p);
    const auto size = [&](const Eigen::VectorXd& theta) { return theta.dot(told * theta); };
    const Eigen::VectorXd by_effect = fit.solution.segment(fit.solution.size() - 2 * p, p);
    const Eigen::VectorXd by_contrast = fit.solution.tail(p);
    constexpr double kThird = 1.0 / 3.0;
    const double least = (1.0 - kThird) / (1.0 + kThird);
    if (size(by_contrast) >= least * least * size(by_effect)) return true;
    const Eigen::MatrixXd c = fit.covariance.bottomRightCorner(2 * p, 2 * p);
    const Eigen::MatrixXd both = c.topLeftCorner(p, p) + c.bottomRightCorner(p, p);
    const Eigen::MatrixXd cross = c.topRightCorner(p, p) + c.bottomLeftCorner(p, p);
    const auto is_nothing = [&](const Eigen::VectorXd& theta, const Eigen::MatrixXd& covariance) {
      const double length = squared_mahalanobis(theta, covariance);
      return f_test(length, p, linear_.scenes.size()) > options_.false_alarm;
    };
    const Eigen::VectorXd white = by_effect + by_contrast;
    const Eigen::VectorXd black = by_effect - by_contrast;
    return size(white) < size(black) ? is_nothing(white, both + cross)
                                     : is_nothing(black, both - cross);
  }

  const ModelInUse& model_;
  Channel channel_;
  const DiscoveryOptions& options_;
  EffectColumnsList with_;
  std::size_t at_;  // of the candidate among the columns; its contrast and the difference follow
  Linearization linear_;
};

}  // namespace

bool prints_disagree(const ModelInUse& model, const EffectColumns& candidate, Channel channel,
                     const DiscoveryOptions& options, const RunContext& context) {
  if (candidate.effect->is_about_prints()) return false;
  const PrintContrast contrast(model, candidate, channel, options, context);
  return !context.stopped() && contrast.disagrees();
}

}  // namespace lvcalib
