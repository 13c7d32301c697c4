// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QGraphicsView>
#include <QImage>
#include <optional>

#include "views/figure_actions.h"
#include "views/image_levels.h"
#include "views/image_overlay.h"

namespace lvcalib::widgets {

class Lasso;

/// An image with what was found in it: the wheel zooms at the cursor, dragging pans, F fits, 1
/// shows one pixel per pixel, + and − zoom; a click names the pixel or the tag. Passive.
class ImageView : public QGraphicsView {
  Q_OBJECT

 public:
  explicit ImageView(QWidget* parent = nullptr);
  ~ImageView() override;

  /// 8 or 16 bits, grey or colour; a null image clears the view.
  void setImage(const QImage& image);
  [[nodiscard]] const QImage& image() const { return image_; }
  void setLevels(const ImageLevels& levels);
  /// Text in the middle while there is no image.
  void setMessage(const QString& message);
  [[nodiscard]] const QString& message() const { return message_; }

  [[nodiscard]] OverlayItem& overlay() { return *overlay_; }
  [[nodiscard]] FigureActions* figureActions() const { return actions_; }

  /// On: a drag draws a line about what is to be selected instead of moving the image.
  void setBrushing(bool on);
  /// On: a drag with the left button is told instead of moving the image.
  void setDragging(bool on) { dragging_ = on; }

  /// Screen pixels per image pixel.
  [[nodiscard]] double zoom() const;
  /// Zooms about a place of the viewport.
  void zoomAt(const QPoint& place, double factor);
  /// Scrolls, if needed, so that a pixel is in sight.
  void reveal(const QPointF& pixel);

 public Q_SLOTS:
  void fit();
  void oneToOne();

 Q_SIGNALS:
  void pixelClicked(const QPointF& pixel);
  void tagClicked(int id);
  void circleClicked(int id);
  /// A line was drawn, in image pixels; `add` to what is selected already.
  void brushed(const QPolygonF& line, bool add);
  /// A piece of a drag, in image pixels; only where dragging is on.
  void dragged(const QPointF& from, const QPointF& to, Qt::KeyboardModifiers modifiers);
  /// The cursor moved over the image; value is the grey value at the pixel (0…255 or 0…65535).
  void hovered(const QPointF& pixel, int value);
  void left();

 protected:
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void drawForeground(QPainter* painter, const QRectF& rect) override;

 private:
  void showImage();
  [[nodiscard]] QImage picture();
  [[nodiscard]] QByteArray cornersAsCsv() const;

  QImage image_;
  ImageLevels levels_;
  QGraphicsPixmapItem* pixmap_ = nullptr;
  OverlayItem* overlay_ = nullptr;
  FigureActions* actions_ = nullptr;
  Lasso* lasso_ = nullptr;
  QString message_;
  QPoint pressed_;
  std::optional<QPointF> drag_at_;  // Image pixels, while a drag is told.
  bool dragging_ = false;
  bool fitted_ = true;
};

}  // namespace lvcalib::widgets
