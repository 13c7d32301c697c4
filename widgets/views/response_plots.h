// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <vector>

#include "response/boundary_response.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {

/// What the figures of a boundary response show: one scene, or all of them together. The scenes
/// are borrowed and must stay until other ones are set.
struct ResponseScope {
  std::vector<const SceneResponse*> scenes;
  std::vector<int> colors;            ///< Of each scene: its place in PlotColors::series().
  std::vector<BoardOutline> covered;  ///< Parts of their boards that something seems to cover.
  /// Parts (polygons) and circles of their boards that are left out by hand.
  std::vector<std::vector<Eigen::Vector2d>> left_out_m = {};
  std::vector<int> left_out_circles = {};
  const TransitionFit* transition = nullptr;
  const ResponseStatistics* statistics = nullptr;
  Message reason;  ///< Why there are no statistics; empty otherwise.

  /// Samples of the scenes about circles in use, at most `most` of them, evenly thinned.
  [[nodiscard]] std::vector<const BoundarySample*> samples(bool overlap_only,
                                                           std::size_t most) const;
};

/// Intensity against signed distance: samples, those of the overlap region in another colour,
/// means in classes, the fitted error function with δ and σ. One scene in its own intensities,
/// several from black 0 to white 1.
class TransitionPlot : public PlotView {
  Q_OBJECT

 public:
  explicit TransitionPlot(QWidget* parent = nullptr);
  void setScope(const ResponseScope& scope);

 protected:
  void rebuild() override;

 private:
  struct Levels {
    double black = 0.0;
    double scale = 1.0;
  };
  [[nodiscard]] Levels levelsOf(const SceneResponse& scene) const;
  void drawSamples();
  void drawMeans(const SceneResponse& scene, const QColor& color, std::vector<QStringList>& rows);
  void drawFit();
  void drawCaption();
  void explain();
  [[nodiscard]] QColor overlapColor() const;
  void fit();

  ResponseScope scope_;
};

/// Pitch against yaw of the overlap samples to their nearest boundary points, with the ellipses of
/// one and two standard deviations of a beam on the edge.
class AnglePlot : public PlotView {
  Q_OBJECT

 public:
  explicit AnglePlot(QWidget* parent = nullptr);
  void setScope(const ResponseScope& scope);

 protected:
  void rebuild() override;

 private:
  [[nodiscard]] std::vector<QStringList> tableRows() const;
  void drawEllipse(const Eigen::Matrix2d& covariance_rad2, double sigmas, const QPen& pen);
  void fit();

  ResponseScope scope_;
};

/// Ranges of the overlap samples off the board's plane, with ±σ.
class RangePlot : public PlotView {
  Q_OBJECT

 public:
  explicit RangePlot(QWidget* parent = nullptr);
  void setScope(const ResponseScope& scope);

 protected:
  void rebuild() override;

 private:
  void drawSigma();

  ResponseScope scope_;
};

}  // namespace lvcalib::widgets
