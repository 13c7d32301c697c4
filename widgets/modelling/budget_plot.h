// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "discovery/model_session.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// What every channel is wrong by beyond its noise, after each step of the model: unexplained, and
/// explained by effects since the base model, each channel on its own scale, with large figures
/// above. What the noise alone may leave is grey. A click goes to a step.
class BudgetPlot : public PlotView {
  Q_OBJECT

 public:
  explicit BudgetPlot(QWidget* parent = nullptr);
  /// Steps from the base model; null ones are left out.
  void setSteps(std::vector<ModelStepPtr> steps, std::size_t current);

  /// A channel's error beyond its noise floor, display units.
  struct BeyondNoise {
    double unexplained = 0.0;
    double by_chance = 0.0;  ///< What noise alone leaves at most (95 %).
    double heldout = 0.0;    ///< Of scenes held out.
    [[nodiscard]] bool is_chance() const { return unexplained <= by_chance; }
  };
  static BeyondNoise beyond_noise(const ChannelSummary& now);
  static QColor noiseColor(const PlotColors& colors);
  static QColor explainedColor(const PlotColors& colors);

 Q_SIGNALS:
  void stepClicked(int step);

 protected:
  void rebuild() override;

 private:
  void drawChannel(const ChannelSummary& base, int first);
  void writeFigures(const ChannelSummary& base, double middle);
  void showTip(const QPoint& place);
  [[nodiscard]] int stepAt(double x) const;

  std::vector<ModelStepPtr> steps_;
  std::size_t current_ = 0;
};

}  // namespace lvcalib::widgets
