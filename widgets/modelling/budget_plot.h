// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "discovery/model_session.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// The error of every channel after each step of the model: how much of the base model's squared
/// error is noise, explained by effects, and unexplained, with the error of scenes held out beside
/// it. A click goes to a step.
class BudgetPlot : public PlotView {
  Q_OBJECT

 public:
  explicit BudgetPlot(QWidget* parent = nullptr);
  /// Steps from the base model; null ones are left out.
  void setSteps(std::vector<ModelStepPtr> steps, std::size_t current);

  /// Shares of the base model's squared error; they add up to 1 or, where a model is worse, more.
  struct Shares {
    double floor = 0.0;
    double explained = 0.0;
    double unexplained = 0.0;
    double heldout = 0.0;  ///< Squared held-out error by the base model's squared error.
  };
  static QColor noiseColor(const PlotColors& colors);
  static QColor explainedColor(const PlotColors& colors);
  static Shares shares(const ChannelSummary& base, const ChannelSummary& now);

 Q_SIGNALS:
  void stepClicked(int step);

 protected:
  void rebuild() override;

 private:
  void drawChannel(int channel, int first);
  void showTip(const QPoint& place);
  [[nodiscard]] int stepAt(double x) const;

  std::vector<ModelStepPtr> steps_;
  std::size_t current_ = 0;
};

}  // namespace lvcalib::widgets
