// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_view.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QGraphicsPixmapItem>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QScrollBar>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "style/texts.h"
#include "views/lasso.h"
#include "views/plot_view.h"

namespace lvcalib::widgets {
namespace {

constexpr double kZoomStep = 1.2;
constexpr double kMostZoom = 64.0;
constexpr double kLeastZoom = 0.02;

int gray_value(const QImage& image, int x, int y) {
  if (image.format() == QImage::Format_Grayscale16) {
    return reinterpret_cast<const quint16*>(image.constScanLine(y))[x];
  }
  return qGray(image.pixel(x, y));
}

}  // namespace

ImageView::ImageView(QWidget* parent) : QGraphicsView(parent) {
  setScene(new QGraphicsScene(this));
  pixmap_ = scene()->addPixmap({});
  pixmap_->setOffset(-0.5, -0.5);  // So that pixel centres have whole coordinates.
  overlay_ = new OverlayItem;
  scene()->addItem(overlay_);
  setDragMode(QGraphicsView::ScrollHandDrag);
  setTransformationAnchor(QGraphicsView::NoAnchor);
  setResizeAnchor(QGraphicsView::AnchorViewCenter);
  setViewportUpdateMode(QGraphicsView::FullViewportUpdate);
  setMouseTracking(true);
  viewport()->setCursor(Qt::CrossCursor);
  lasso_ = new Lasso(viewport());
  connect(lasso_, &Lasso::drawn, this, [this](const QPolygonF& line, bool add) {
    if (!image_.isNull()) Q_EMIT brushed(viewportTransform().inverted().map(line), add);
  });
  setMinimumSize(160, 120);
  setFrameShape(QFrame::NoFrame);
  follow_language(this, [this] {
    setAccessibleName(tr("Image"));
    setToolTip(
        tr("Wheel: zoom. Drag: move. F: fit, 1: one to one. Click: nearest LiDAR points. "
           "Green: detected tags. Magenta arrows: corner residuals, enlarged (px). "
           "Orange: circles and outline from the LiDAR."));
  });
  actions_ = new FigureActions(
      this, {"image", [this] { return picture(); }, [this] { return image_as_pdf(picture()); },
             [this] { return cornersAsCsv(); }});
}

ImageView::~ImageView() = default;

void ImageView::setImage(const QImage& image) {
  const bool other_size = image.size() != image_.size();
  image_ = image;
  showImage();
  const QRectF frame(-0.5, -0.5, image.width(), image.height());
  overlay_->setBounds(frame);
  setSceneRect(frame);
  if (other_size) fit();
}

void ImageView::setLevels(const ImageLevels& levels) {
  levels_ = levels;
  showImage();
}

void ImageView::setMessage(const QString& message) {
  message_ = message;
  viewport()->update();
}

void ImageView::showImage() {
  pixmap_->setPixmap(QPixmap::fromImage(apply_levels(image_, levels_)));
  viewport()->update();
}

void ImageView::setBrushing(bool on) {
  lasso_->setOn(on);
}

double ImageView::zoom() const {
  return transform().m11();
}

void ImageView::zoomAt(const QPoint& place, double factor) {
  const double wanted = std::clamp(zoom() * factor, kLeastZoom, kMostZoom);
  const QPointF fixed = mapToScene(place);
  setTransform(QTransform::fromScale(wanted, wanted));
  // Smooth when shrunk; when enlarged, the pixels themselves are what one wants to see.
  pixmap_->setTransformationMode(wanted < 1.0 ? Qt::SmoothTransformation : Qt::FastTransformation);
  const QPointF moved = transform().map(fixed) - QPointF(place);
  horizontalScrollBar()->setValue(static_cast<int>(std::lround(moved.x())));
  verticalScrollBar()->setValue(static_cast<int>(std::lround(moved.y())));
  fitted_ = false;
}

void ImageView::reveal(const QPointF& pixel) {
  ensureVisible(QRectF(pixel - QPointF(1, 1), QSizeF(2, 2)), 40, 40);
}

void ImageView::fit() {
  if (image_.isNull()) return;
  const QSize room = viewport()->size() + QSize(0, 0);
  const double factor = std::min(static_cast<double>(room.width() - 2) / image_.width(),
                                 static_cast<double>(room.height() - 2) / image_.height());
  zoomAt(viewport()->rect().center(), factor / zoom());
  centerOn(sceneRect().center());
  fitted_ = true;
}

void ImageView::oneToOne() {
  zoomAt(viewport()->rect().center(), 1.0 / zoom());
}

void ImageView::wheelEvent(QWheelEvent* event) {
  const double steps = event->angleDelta().y() / 120.0;
  if (steps != 0.0) zoomAt(event->position().toPoint(), std::pow(kZoomStep, steps));
  event->accept();
}

void ImageView::keyPressEvent(QKeyEvent* event) {
  const QPoint center = viewport()->rect().center();
  switch (event->key()) {
    case Qt::Key_F:
    case Qt::Key_Home:
      return fit();
    case Qt::Key_1:
      return oneToOne();
    case Qt::Key_Plus:
      return zoomAt(center, kZoomStep);
    case Qt::Key_Minus:
      return zoomAt(center, 1.0 / kZoomStep);
    default:
      QGraphicsView::keyPressEvent(event);
  }
}

void ImageView::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->pos();
  if (dragging_ && event->button() == Qt::LeftButton) {
    drag_at_ = mapToScene(event->pos());
    event->accept();
    return;
  }
  QGraphicsView::mousePressEvent(event);
}

void ImageView::mouseMoveEvent(QMouseEvent* event) {
  if (drag_at_) {
    const QPointF to = mapToScene(event->pos());
    Q_EMIT dragged(*drag_at_, to, event->modifiers());
    drag_at_ = to;
    return;
  }
  QGraphicsView::mouseMoveEvent(event);
  if (event->buttons() == Qt::NoButton) viewport()->setCursor(Qt::CrossCursor);
  const QPointF pixel = mapToScene(event->pos());
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  if (image_.valid(x, y)) {
    Q_EMIT hovered(pixel, gray_value(image_, x, y));
  } else {
    Q_EMIT left();
  }
}

void ImageView::mouseReleaseEvent(QMouseEvent* event) {
  drag_at_.reset();
  QGraphicsView::mouseReleaseEvent(event);
  viewport()->setCursor(Qt::CrossCursor);
  if (event->button() != Qt::LeftButton || image_.isNull() ||
      (event->pos() - pressed_).manhattanLength() >= QApplication::startDragDistance()) {
    return;
  }
  const QPointF pixel = mapToScene(event->pos());
  for (const ImageOverlay::Tag& tag : overlay_->overlay().tags) {
    if (overlay_->parts().tags && tag.corners.containsPoint(pixel, Qt::OddEvenFill)) {
      Q_EMIT tagClicked(tag.id);
      return;
    }
  }
  for (const ImageOverlay::Circle& circle : overlay_->overlay().circles) {
    if (overlay_->parts().circles && circle.edge.containsPoint(pixel, Qt::OddEvenFill)) {
      Q_EMIT circleClicked(circle.id);
      return;
    }
  }
  if (sceneRect().contains(pixel)) Q_EMIT pixelClicked(pixel);
}

void ImageView::contextMenuEvent(QContextMenuEvent* event) {
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(tr("Fit"), QKeySequence(Qt::Key_F), this, &ImageView::fit);
  menu->addAction(tr("One to one"), QKeySequence(Qt::Key_1), this, &ImageView::oneToOne);
  menu->addSeparator();
  actions_->addTo(menu);
  menu->popup(event->globalPos());
}

void ImageView::resizeEvent(QResizeEvent* event) {
  QGraphicsView::resizeEvent(event);
  if (fitted_) fit();
}

void ImageView::leaveEvent(QEvent* event) {
  QGraphicsView::leaveEvent(event);
  Q_EMIT left();
}

void ImageView::drawForeground(QPainter* painter, const QRectF& /*rect*/) {
  if (!image_.isNull() || message_.isEmpty()) return;
  painter->resetTransform();
  painter->setPen(palette().color(QPalette::Text));
  painter->drawText(viewport()->rect().adjusted(12, 12, -12, -12),
                    Qt::AlignCenter | Qt::TextWordWrap, message_);
}

QImage ImageView::picture() {
  return image_.isNull() ? QImage() : viewport()->grab().toImage();
}

QByteArray ImageView::cornersAsCsv() const {
  const auto& corners = overlay_->overlay().corners;
  if (corners.empty()) return {};
  QString text = "feature,corner,detected_x_px,detected_y_px,predicted_x_px,predicted_y_px,used\n";
  for (const ImageOverlay::Corner& c : corners) {
    const QStringList row{QString::number(c.feature_id),
                          QString::number(c.corner),
                          csv_number(c.detected.x()),
                          csv_number(c.detected.y()),
                          c.has_prediction ? csv_number(c.predicted.x()) : QString(),
                          c.has_prediction ? csv_number(c.predicted.y()) : QString(),
                          c.used ? "1" : "0"};
    text += row.join(',') + '\n';
  }
  return text.toUtf8();
}

}  // namespace lvcalib::widgets

#include "moc_image_view.cpp"
