// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_canvas.h"

#include <QApplication>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QWheelEvent>
#include <algorithm>

namespace lvcalib::widgets {
namespace {

// How long after the last movement the view counts as resting.
constexpr int kRest_ms = 180;
// A first guess, for software rendering.
constexpr double kFirstPointsPerMs = 2500.0;

CanvasMouse::Button button_of(Qt::MouseButton button) {
  switch (button) {
    case Qt::LeftButton:
      return CanvasMouse::Button::kLeft;
    case Qt::MiddleButton:
      return CanvasMouse::Button::kMiddle;
    case Qt::RightButton:
      return CanvasMouse::Button::kRight;
    default:
      return CanvasMouse::Button::kNone;
  }
}

}  // namespace

CloudCanvas::CloudCanvas(QWidget* parent) : QOpenGLWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setUpdateBehavior(QOpenGLWidget::PartialUpdate);
  statistics_.points_per_ms = kFirstPointsPerMs;
  CloudPipeline::Hooks hooks;
  // makeCurrent() also binds the widget's framebuffer, behind the back of VTK's record of what is
  // bound: it must not be called in the middle of a frame.
  hooks.make_current = [this] {
    if (QOpenGLContext::currentContext() != context()) makeCurrent();
  };
  hooks.view_changed = [this] { viewMoved(); };
  hooks.box_edited = [this](const CropBox& box) { Q_EMIT boxEdited(box); };
  pipeline_ = std::make_unique<CloudPipeline>(std::move(hooks));
  rest_.setSingleShot(true);
  rest_.setInterval(kRest_ms);
  connect(&rest_, &QTimer::timeout, this, [this] {
    moving_ = false;
    update();
  });
  flight_step_.setInterval(15);
  connect(&flight_step_, &QTimer::timeout, this, &CloudCanvas::flyOn);
  applyPalette();
}

CloudCanvas::~CloudCanvas() {
  if (context() != nullptr) {
    makeCurrent();
    pipeline_->release();
    doneCurrent();
    disconnect(context(), nullptr, this, nullptr);
  }
}

void CloudCanvas::redraw() {
  begin_ = true;
  update();
}

void CloudCanvas::fly(CloudViewpoint viewpoint) {
  from_ = pipeline_->viewer();
  pipeline_->look(viewpoint);
  to_ = pipeline_->viewer();
  pipeline_->setViewer(from_);
  flight_.start();
  flight_step_.start();
}

void CloudCanvas::land() {
  if (!flight_step_.isActive()) return;
  flight_step_.stop();
  pipeline_->setViewer(to_);
  viewMoved();
}

Viewer CloudCanvas::destination() const {
  return flight_step_.isActive() ? to_ : pipeline_->viewer();
}

void CloudCanvas::flyOn() {
  const double share = static_cast<double>(flight_.elapsed()) / kFlight_ms;
  if (share >= 1.0) return land();
  pipeline_->setViewer(between(from_, to_, share));
  viewMoved();
}

void CloudCanvas::viewMoved() {
  moving_ = true;
  rest_.start();
  redraw();
}

bool CloudCanvas::complete() const {
  return !begin_ && !flight_step_.isActive() && pipeline_->complete();
}

QSize CloudCanvas::deviceSize() const {
  return {static_cast<int>(width() * devicePixelRatioF()),
          static_cast<int>(height() * devicePixelRatioF())};
}

void CloudCanvas::initializeGL() {
  usable_ = pipeline_->initialize();
  // A new context does not always bring a resize with it.
  resizeGL(width(), height());
  // A widget that gets another window gets another context.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] {
    makeCurrent();
    pipeline_->release();
    doneCurrent();
    usable_ = false;
  });
  begin_ = true;
}

// Qt has a picture drawn at once; the one that follows would be drawn a second time.
void CloudCanvas::resizeEvent(QResizeEvent* event) {
  resizing_ = true;
  QOpenGLWidget::resizeEvent(event);
  resizing_ = false;
  update();
}

void CloudCanvas::resizeGL(int /*width*/, int /*height*/) {
  const QSize size = deviceSize();
  pipeline_->resize(size.width(), size.height(), devicePixelRatioF());
  begin_ = true;
}

void CloudCanvas::paintGL() {
  if (!usable_ || resizing_) return;
  QElapsedTimer clock;
  clock.start();
  const std::size_t before = begin_ ? 0 : pipeline_->drawnPoints();
  const bool more = !begin_ && !moving_ && !pipeline_->complete();
  if (begin_) {
    pipeline_->drawFirst(pointBudget());
    ++statistics_.frames;
  } else if (more) {
    pipeline_->drawMore(pointBudget());
    ++statistics_.portions;
  }
  const bool drew = begin_ || more;
  if (begin_) Q_EMIT begun();
  begin_ = false;
  const QSize size = deviceSize();
  pipeline_->copyTo(defaultFramebufferObject(), size.width(), size.height());
  if (drew) {
    recordFrame(1e-6 * static_cast<double>(clock.nsecsElapsed()),
                pipeline_->drawnPoints() - before);
  }
  if (!moving_ && !pipeline_->complete()) {
    // Waiting events go first, so that the view can be turned before it is complete.
    QTimer::singleShot(0, this, [this] { update(); });
  } else if (drew && pipeline_->complete()) {
    Q_EMIT completed();
  }
}

void CloudCanvas::recordFrame(double elapsed_ms, std::size_t points) {
  if (points < 10'000 || elapsed_ms <= 0.0) return;
  const double rate = static_cast<double>(points) / elapsed_ms;
  statistics_.points_per_ms += 0.3 * (rate - statistics_.points_per_ms);
}

std::size_t CloudCanvas::pointBudget() const {
  return static_cast<std::size_t>(std::max(1.0, kFrameBudget_ms * statistics_.points_per_ms));
}

void CloudCanvas::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->position();
  forward(CanvasMouse::Kind::kPress, button_of(event->button()), event->position(),
          event->modifiers());
}

void CloudCanvas::mouseReleaseEvent(QMouseEvent* event) {
  forward(CanvasMouse::Kind::kRelease, button_of(event->button()), event->position(),
          event->modifiers());
  const bool still =
      (event->position() - pressed_).manhattanLength() < QApplication::startDragDistance();
  if (event->button() == Qt::LeftButton && still && !pipeline_->editingBox()) {
    Q_EMIT clicked(event->position());
  }
}

void CloudCanvas::mouseMoveEvent(QMouseEvent* event) {
  forward(CanvasMouse::Kind::kMove, CanvasMouse::Button::kNone, event->position(),
          event->modifiers());
}

void CloudCanvas::wheelEvent(QWheelEvent* event) {
  if (event->angleDelta().y() == 0) return;
  forward(event->angleDelta().y() > 0 ? CanvasMouse::Kind::kWheelUp : CanvasMouse::Kind::kWheelDown,
          CanvasMouse::Button::kNone, event->position(), event->modifiers());
  event->accept();
}

void CloudCanvas::changeEvent(QEvent* event) {
  QOpenGLWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) {
    applyPalette();
    redraw();
  }
}

void CloudCanvas::forward(CanvasMouse::Kind kind, CanvasMouse::Button button, const QPointF& place,
                          Qt::KeyboardModifiers modifiers) {
  if (!usable_) return;
  CanvasMouse mouse;
  mouse.kind = kind;
  mouse.button = button;
  mouse.x = static_cast<int>(place.x() * devicePixelRatioF());
  mouse.y = static_cast<int>(place.y() * devicePixelRatioF());
  mouse.shift = modifiers.testFlag(Qt::ShiftModifier);
  mouse.control = modifiers.testFlag(Qt::ControlModifier);
  // Who takes the view by hand has seen enough of the flight.
  if (kind != CanvasMouse::Kind::kMove) land();
  makeCurrent();
  pipeline_->handle(mouse);
}

void CloudCanvas::applyPalette() {
  QColor ground = palette().color(QPalette::Base);
  const bool dark = ground.lightness() < 128;
  // Bright points do not stand out from white.
  if (!dark) ground = ground.darker(118);
  pipeline_->setBackground(ground.redF(), ground.greenF(), ground.blueF(), dark);
}

}  // namespace lvcalib::widgets

#include "moc_cloud_canvas.cpp"
