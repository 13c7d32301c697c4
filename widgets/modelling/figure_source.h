// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <array>
#include <memory>
#include <optional>

#include "diagnostics/board_intensity.h"
#include "modelling/residual_figure.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// Makes what the model page draws, in worker threads: residuals of a step, figures along a
/// covariate, patterns of effects, images of the board's intensity. A new request takes the place
/// of the one before of its kind.
class FigureSource : public QObject {
  Q_OBJECT

 public:
  explicit FigureSource(QObject* parent = nullptr);

  /// The step to show and the one to compare it with; null: nothing.
  void setSteps(const ModelStepPtr& step, const ModelStepPtr& before);
  [[nodiscard]] const ModelStepPtr& step() const { return step_; }
  /// Asks for a figure; `effect` is laid over (the pattern that it would leave).
  void request(Channel channel, const QString& covariate, const std::optional<EffectInUse>& effect);
  /// Asks for a small figure of an effect's pattern beside what is seen, in the channel and along
  /// the covariate where it shows most.
  void requestPattern(const EffectInUse& effect);
  void requestBoard(int scene);

 Q_SIGNALS:
  /// Null: the channel has no residuals or no such covariate.
  void figureReady(const std::shared_ptr<const lvcalib::widgets::ResidualFigure>& figure);
  void patternReady(const std::shared_ptr<const lvcalib::widgets::ResidualFigure>& figure);
  void boardReady(const std::shared_ptr<const lvcalib::BoardIntensity>& board);

 private:
  using Views = std::array<std::shared_ptr<const ChannelView>, kChannels>;
  void keep(const ModelStepPtr& step, Channel channel,
            const std::shared_ptr<const ChannelView>& view);

  /// The last pattern laid over: another covariate needs the same one.
  struct LaidOver {
    Channel channel = Channel::kCorner;
    EffectInUse effect;
    std::shared_ptr<const Overlay> overlay;
    [[nodiscard]] bool is(Channel wanted, const EffectInUse& other) const;
  };

  ModelStepPtr step_;
  ModelStepPtr before_;
  Views views_;
  LaidOver laid_over_;
  Runner board_, pattern_, figure_;  // Last: abandoned before what they use goes.
};

/// The covariate of a view along which a pattern varies most, by the share of its variance that
/// the groups' means hold; empty if it is zero.
QString telling_covariate(const ChannelView& view, const std::vector<float>& pattern);

}  // namespace lvcalib::widgets
