// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "refinement/board_refinement.h"
#include "refinement/node_samples.h"
#include "views/color_map.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// One node in one iteration: what an angle–distance plot shows.
struct AngleDistanceData {
  NodeRecord record;
  std::vector<NodeSample> samples;  ///< About record.center_uv_m; may be empty.
  ColorScale intensity;             ///< Colours of the samples, common to all nodes.
  double reach_m = 0.02;            ///< Half height of the plot.
  /// Of each bin of the record, or empty: its returns are left out by hand.
  std::vector<bool> by_hand = {};
};

/// Polar angle (degrees) against signed distance from the circle (mm): samples coloured by
/// intensity, bin midpoints with error bars, refused bins shaded and crossed, the fitted
/// first-order wave and the zero line; what is left out by hand is violet.
class AngleDistancePlot : public PlotView {
  Q_OBJECT

 public:
  explicit AngleDistancePlot(QWidget* parent = nullptr);

  /// Small plots of an overview go without axis titles and draw at most `kSmallSamples` samples.
  void setCompact(bool compact);
  void setTitle(const QString& title);
  void setData(AngleDistanceData data);
  void clear(const QString& message);
  /// Strikes the plot through: its circle is not used, perhaps because the user does not want it.
  void setRefused(bool refused, bool by_hand = false);
  [[nodiscard]] bool isRefused() const { return refused_; }
  /// Emphasises these bins.
  void setChosenBins(std::vector<int> bins);

  [[nodiscard]] const AngleDistanceData& data() const { return data_; }

 Q_SIGNALS:
  /// Bins of which a sample or the mark lies in a rectangle that was drawn; `add` to those chosen.
  void binsBrushed(const std::vector<int>& bins, bool add);

 protected:
  void rebuild() override;

 private:
  static constexpr std::size_t kSmallSamples = 900;

  void retranslate();
  void emitBrush(const QRect& rect, bool add);
  [[nodiscard]] bool isByHand(std::size_t bin) const;
  [[nodiscard]] QColor refusalColor() const;
  void drawBands();
  void drawBand(std::size_t bin, double width_deg, const QBrush& brush);
  void drawSamples();
  void drawWave();
  void drawBins();
  void explain();
  void drawRefusal();
  void drawLabel();
  [[nodiscard]] std::vector<QStringList> tableRows() const;

  AngleDistanceData data_;
  QString title_;
  QString message_;
  bool compact_ = false;
  bool refused_ = false;
  bool by_hand_ = false;
  std::vector<int> chosen_bins_;
};

}  // namespace lvcalib::widgets
