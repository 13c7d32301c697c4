// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QGraphicsItem>
#include <QLineF>
#include <QPolygonF>
#include <QRgb>
#include <cstdint>
#include <vector>

namespace lvcalib::widgets {

/// What is drawn over an image, in pixels as OpenCV counts them (the centre of the top-left pixel
/// is (0, 0)).
struct ImageOverlay {
  struct Tag {
    int id = 0;
    QPolygonF corners;  ///< Detected, from the lower left.
    bool used = true;
    bool left_out = false;  ///< Not used because the user does not want it.
  };
  struct Corner {
    int feature_id = 0;
    int corner = 0;
    QPointF detected;
    QPointF predicted;  ///< Where the solution puts it.
    bool used = true;
    bool has_prediction = false;
  };
  struct Circle {
    int id = 0;
    QPolygonF edge;  ///< Projected with the current extrinsic.
    QPointF center;  ///< Of the refined LiDAR node.
    bool valid = true;
    bool left_out = false;  ///< Not valid because the user does not want it.
  };
  std::vector<Tag> tags;
  std::vector<Corner> corners;
  std::vector<Circle> circles;
  QPolygonF outline;               ///< The board's edge as the LiDAR sees it.
  std::vector<QPointF> points;     ///< LiDAR points.
  std::vector<QRgb> point_colors;  ///< As many as points.
  /// LiDAR points that the program refused, and that the user left out; drawn as crosses.
  std::vector<QPointF> refused_points;
  std::vector<QPointF> left_out_points;
  /// Part of the board that something seems to cover, or that the user left out.
  struct Part {
    QPolygonF edge;
    bool used = false;      ///< All the same.
    bool left_out = false;  ///< Because the user does not want it.
  };
  std::vector<Part> parts;
  struct Outline {
    QPolygonF points;
    QRgb color = 0;
  };
  std::vector<Outline> outlines;  ///< Closed lines in colours of their own.
  std::vector<QLineF> shifts;     ///< Drawn as arrows, longer by the residual factor.
};

/// Which parts of an overlay are shown.
struct OverlayParts {
  bool tags = true;
  bool residuals = true;
  bool circles = true;
  bool points = false;
  bool unused = true;  ///< LiDAR points and parts of the board that are not used.
};

/// Draws an overlay; its scene coordinates are image pixels. Lines keep their width on the screen.
class OverlayItem : public QGraphicsItem {
 public:
  /// Of the arrows of residuals and shifts.
  static QColor shiftColor();
  void setOverlay(ImageOverlay overlay);
  [[nodiscard]] const ImageOverlay& overlay() const { return overlay_; }
  void setParts(const OverlayParts& parts);
  [[nodiscard]] const OverlayParts& parts() const { return parts_; }
  /// Residual arrows are drawn this much longer than they are.
  void setResidualFactor(double factor);
  [[nodiscard]] double residualFactor() const { return factor_; }
  /// Rings around places; the chosen tag is emphasised (−1: none).
  void setHighlights(std::vector<QPointF> places, int tag);
  [[nodiscard]] const std::vector<QPointF>& highlights() const { return highlights_; }
  [[nodiscard]] int highlightedTag() const { return highlighted_tag_; }

  /// Part of the scene that drawing may touch; set with the image's rectangle.
  void setBounds(const QRectF& bounds);
  [[nodiscard]] QRectF boundingRect() const override { return bounds_; }
  void paint(QPainter* painter, const QStyleOptionGraphicsItem* option, QWidget* widget) override;

 private:
  void paintPoints(QPainter& painter, const QRectF& visible) const;
  void paintUnusedPoints(QPainter& painter, double scale) const;
  void paintParts(QPainter& painter) const;
  void paintTags(QPainter& painter, double scale) const;
  void paintResiduals(QPainter& painter, double scale) const;
  void paintCircles(QPainter& painter, double scale) const;
  void paintShifts(QPainter& painter, double scale) const;
  void paintHighlights(QPainter& painter, double scale) const;

  ImageOverlay overlay_;
  OverlayParts parts_;
  double factor_ = 50.0;
  std::vector<QPointF> highlights_;
  int highlighted_tag_ = -1;
  QRectF bounds_;
};

}  // namespace lvcalib::widgets
