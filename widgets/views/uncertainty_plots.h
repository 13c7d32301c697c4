// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "solve/uncertainty_report.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// One standard deviation (px), over the image, of the pixel that a LiDAR point falls into by the
/// extrinsic's uncertainty, or that a direction falls into by the intrinsics'.
class UncertaintyMapPlot : public PlotView {
  Q_OBJECT

 public:
  enum class Of { kExtrinsic, kIntrinsics };
  explicit UncertaintyMapPlot(Of of, QWidget* parent = nullptr);

  /// Shows a map of an image of this size; nothing: says that there is none.
  void setMap(std::optional<ProjectedUncertainty> map, const QSize& image_px);

 protected:
  void rebuild() override;

 private:
  void fit();
  void drawCells(const ProjectedUncertainty& map);
  void styleScale();

  Of of_;
  std::optional<ProjectedUncertainty> map_;
  QSize image_px_;
  QSize fitted_to_;
  QCPColorScale* scale_ = nullptr;
};

/// One standard deviation (mm) of a LiDAR point in the camera frame against its range, across the
/// ray and along it: by noise alone, and in total where that is known.
class UncertaintyRangePlot : public PlotView {
  Q_OBJECT

 public:
  explicit UncertaintyRangePlot(QWidget* parent = nullptr);

  /// `total`: of the same ranges, or nothing.
  void setRanges(std::vector<RangeUncertainty> noise, std::vector<RangeUncertainty> total);

 protected:
  void rebuild() override;

 private:
  void drawCurve(const std::vector<RangeUncertainty>& ranges, bool across);

  std::vector<RangeUncertainty> noise_;
  std::vector<RangeUncertainty> total_;
};

}  // namespace lvcalib::widgets
