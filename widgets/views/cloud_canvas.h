// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QElapsedTimer>
#include <QOpenGLWidget>
#include <QTimer>
#include <memory>

#include "views/cloud_pipeline.h"

namespace lvcalib::widgets {

/// How long frames take.
struct FrameStatistics {
  double points_per_ms = 0.0;  ///< Smoothed; what frame sizes are derived from.
  int frames = 0;              ///< Pictures begun since the widget exists.
  int portions = 0;            ///< Times that points were added to a picture.
};

/// The OpenGL surface of a CloudView. While the view moves only as many points are drawn as fit the
/// time of one frame; once it rests, the others are added frame by frame, so that the interface
/// never waits long.
class CloudCanvas : public QOpenGLWidget {
  Q_OBJECT

 public:
  explicit CloudCanvas(QWidget* parent = nullptr);
  ~CloudCanvas() override;

  [[nodiscard]] CloudPipeline& pipeline() { return *pipeline_; }
  /// Draws the picture from the beginning.
  void redraw();
  /// As redraw(), and the view counts as moving for a moment.
  void viewMoved();

  /// Moves the viewer there step by step, so that it is seen which way is which.
  void fly(CloudViewpoint viewpoint);
  /// Ends a flight where it goes to.
  void land();
  /// Where the viewer is, or will be once a flight has ended.
  [[nodiscard]] Viewer destination() const;

  [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }
  /// True once all points are in the picture and the viewer has arrived.
  [[nodiscard]] bool complete() const;
  /// Size in device pixels.
  [[nodiscard]] QSize deviceSize() const;

 Q_SIGNALS:
  /// A picture was begun: perhaps from another place.
  void begun();
  /// A click that was neither a drag nor on a handle of the box; logical coordinates.
  void clicked(const QPointF& place);
  void boxEdited(const lvcalib::CropBox& box);
  void completed();

 protected:
  void initializeGL() override;
  void resizeEvent(QResizeEvent* event) override;
  void resizeGL(int width, int height) override;
  void paintGL() override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  /// Time that one frame may take: 20 frames a second with room for everything else.
  static constexpr double kFrameBudget_ms = 32.0;

  void forward(CanvasMouse::Kind kind, CanvasMouse::Button button, const QPointF& place,
               Qt::KeyboardModifiers modifiers);
  void applyPalette();
  void recordFrame(double elapsed_ms, std::size_t points);
  [[nodiscard]] std::size_t pointBudget() const;

  std::unique_ptr<CloudPipeline> pipeline_;
  FrameStatistics statistics_;
  QTimer rest_;
  static constexpr int kFlight_ms = 400;
  void flyOn();
  Viewer from_, to_;
  QElapsedTimer flight_;
  QTimer flight_step_;
  QPointF pressed_;
  bool begin_ = true;
  bool moving_ = false;
  bool resizing_ = false;
  bool usable_ = false;
};

}  // namespace lvcalib::widgets
