// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "base/rigid3.h"
#include "selection/model_session.h"
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
  /// Whether the search says that something is missing in the step shown. As long as it does not,
  /// what is left beyond the scatter of independent rows (neighbours err alike) is not known to be
  /// an error of the model, and not red.
  void setSomethingMissing(bool something);
  /// The true T_camera_lidar, as of a simulation: the distance of every step to it stands beside
  /// the channels, mm (left bar) and mrad (right bar), each on its own scale.
  void setTruth(const std::optional<Rigid3>& camera_from_lidar);
  [[nodiscard]] bool knowsTruth() const { return truth_.has_value(); }

  /// A channel's error beyond its noise floor, display units.
  struct BeyondNoise {
    double unexplained = 0.0;
    double by_chance = 0.0;  ///< What noise alone leaves at most (95 %).
    double heldout = 0.0;    ///< Of scenes held out.
    [[nodiscard]] bool is_chance() const { return unexplained <= by_chance; }
  };
  static BeyondNoise beyond_noise(const ChannelSummary& now);
  /// Whether a step's error in a channel is shown as one of the model.
  [[nodiscard]] bool is_wrong(const ChannelSummary& now, std::size_t step) const {
    return !beyond_noise(now).is_chance() && (something_missing_ || step != current_);
  }
  static QColor noiseColor(const PlotColors& colors);
  static QColor explainedColor(const PlotColors& colors);

 Q_SIGNALS:
  void stepClicked(int step);

 protected:
  void rebuild() override;

 private:
  void drawChannel(const ChannelSummary& base, int first);
  void writeFigures(const ChannelSummary& base, double middle);
  struct Distance {
    double mm = 0.0;
    double mrad = 0.0;
  };
  [[nodiscard]] Distance toTruth(const ModelStep& step) const;
  void drawTruth(int first);
  /// Figures that would leave the picture are moved back into it.
  void keepInside();
  void frameStep(double x, double top);
  void writeFigure(double middle, const QString& text, const QColor& color);
  void showTip(const QPoint& place);
  [[nodiscard]] int stepAt(double x) const;

  std::vector<ModelStepPtr> steps_;
  std::size_t current_ = 0;
  bool something_missing_ = false;
  std::optional<Rigid3> truth_;
  std::vector<QCPItemText*> figures_;  // Of this picture.
};

}  // namespace lvcalib::widgets
