// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/figure_source.h"

#include <cmath>

namespace lvcalib::widgets {
namespace {

// Mean square over the stated variance: how much an effect stands out of the noise.
double visibility(const ChannelView& view, const std::vector<float>& pattern) {
  double sum = 0.0;
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    const double z = static_cast<double>(pattern[k]) / static_cast<double>(view.columns.sigma[k]);
    sum += z * z;
  }
  return sum;
}

}  // namespace

QString telling_covariate(const ChannelView& view, const std::vector<float>& pattern) {
  const ResidualColumns& c = view.columns;
  double best = 0.0;
  QString name;
  for (const Covariate& along : c.covariates) {
    double held = 0.0;
    for (const ResidualBin& bin :
         bin_residuals(along.values, along.categories, {pattern, c.sigma, c.scene}, 12))
      held += static_cast<double>(bin.residual.n) * bin.residual.mean * bin.residual.mean;
    if (held <= best) continue;
    best = held;
    name = QString::fromStdString(along.name);
  }
  return name;
}

FigureSource::FigureSource(QObject* parent) : QObject(parent) {}

void FigureSource::setSteps(const ModelStepPtr& step, const ModelStepPtr& before) {
  if (step == step_ && before == before_) return;
  step_ = step;
  before_ = before;
  views_ = {};
  laid_over_ = {};
  figure_.cancel();
  pattern_.cancel();
  board_.cancel();
}

void FigureSource::keep(const ModelStepPtr& step, Channel channel,
                        const std::shared_ptr<const ChannelView>& view) {
  if (step == step_) views_[static_cast<std::size_t>(channel)] = view;
}

bool FigureSource::LaidOver::is(Channel wanted, const EffectInUse& other) const {
  return overlay && channel == wanted && effect.effect == other.effect &&
         effect.shape == other.shape && effect.values.size() == other.values.size() &&
         effect.values == other.values;
}

void FigureSource::request(Channel channel, const QString& covariate,
                           const std::optional<EffectInUse>& effect) {
  if (!step_) return;
  std::shared_ptr<const Overlay> laid_over;
  if (effect && laid_over_.is(channel, *effect)) laid_over = laid_over_.overlay;
  figure_.start([this, step = step_, before = before_, channel, covariate, effect, laid_over,
                 view = views_[static_cast<std::size_t>(channel)]](
                    const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    auto shown = view;
    if (!shown) {
      shown = std::make_shared<const ChannelView>(make_channel_view(*step, *before, channel));
      post([this, step, channel, shown] { keep(step, channel, shown); });
    }
    if (context.stopped()) return {};
    auto overlay = laid_over;
    if (effect && !overlay) {
      overlay = std::make_shared<const Overlay>(
          Overlay{QString::fromStdString(effect->effect->info().id),
                  effect_pattern(step->fitted(), *effect, channel, true)});
      post([this, step, channel, effect, overlay] {
        if (step == step_) laid_over_ = {channel, *effect, overlay};
      });
    }
    const auto figure = make_residual_figure(shown, covariate, overlay, context.stop);
    if (context.stopped()) return {};
    return [this, figure] { Q_EMIT figureReady(figure); };
  });
}

void FigureSource::requestPattern(const EffectInUse& effect) {
  if (!step_) return;
  pattern_.start([this, step = step_, before = before_, effect, views = views_](
                     const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    std::shared_ptr<const ChannelView> best_view;
    auto overlay = std::make_shared<Overlay>();
    double best = 0.0;
    for (const Channel channel : channels_of(*effect.effect, effect.shape, step->fitted())) {
      if (context.stopped()) return {};
      auto view = views[static_cast<std::size_t>(channel)];
      if (!view) {
        view = std::make_shared<const ChannelView>(make_channel_view(*step, *before, channel));
        post([this, step, channel, view] { keep(step, channel, view); });
      }
      auto pattern = effect_pattern(step->fitted(), effect, channel, true);
      const double seen = visibility(*view, pattern);
      if (seen <= best) continue;
      best = seen;
      best_view = view;
      overlay->pattern = std::move(pattern);
    }
    std::shared_ptr<const ResidualFigure> figure;
    if (best_view) {
      figure = make_residual_figure(best_view, telling_covariate(*best_view, overlay->pattern),
                                    overlay, context.stop);
    }
    if (context.stopped()) return {};
    return [this, figure] { Q_EMIT patternReady(figure); };
  });
}

void FigureSource::requestBoard(int scene) {
  if (!step_) return;
  board_.start([this, step = step_, scene](const RunContext& context,
                                           const Runner::Post&) -> Runner::Deliver {
    auto board = std::make_shared<const BoardIntensity>(board_intensity(step->fitted(), scene));
    if (context.stopped()) return {};
    return [this, board] { Q_EMIT boardReady(board); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_figure_source.cpp"
