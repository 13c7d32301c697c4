// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_view.h"

#include <QAction>
#include <QApplication>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QMouseEvent>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QTransform>
#include <algorithm>

#include "style/texts.h"
#include "views/color_bar.h"
#include "views/lasso.h"
#include "views/point_picking.h"

namespace lvcalib::widgets {
namespace {

constexpr double kPickRadius_px = 7.0;

}  // namespace

bool opengl_available() {
  static const bool available = [] {
    // These platforms create contexts, but cannot show them in a widget.
    const QStringList without_widgets{"offscreen", "minimal", "vnc", "linuxfb"};
    if (without_widgets.contains(QGuiApplication::platformName())) return false;
    QOpenGLContext context;
    if (!context.create()) return false;
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!surface.isValid() || !context.makeCurrent(&surface)) return false;
    const QSurfaceFormat format = context.format();
    context.doneCurrent();
    return format.version() >= qMakePair(3, 2);
  }();
  return available;
}

CloudView::CloudView(QWidget* parent) : QWidget(parent) {
  setMinimumSize(200, 160);
  follow_language(this, [this] { setAccessibleName(tr("Point cloud")); });
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  if (opengl_available()) {
    createCanvas();
    layout->addWidget(canvas_, 0, 0);
  } else {
    auto* message = new QLabel(this);
    follow_language(message, [message] {
      message->setText(
          tr("The cloud cannot be drawn: no OpenGL 3.2 on this screen.\n"
             "Install a graphics driver (or Mesa's software renderer)."));
    });
    message->setObjectName("no-opengl");
    message->setAlignment(Qt::AlignCenter);
    message->setWordWrap(true);
    message->setFocusPolicy(Qt::StrongFocus);
    setFocusProxy(message);
    layout->addWidget(message, 0, 0);
  }
  // The canvas keeps its size whatever is shown beside it: another size draws all points again.
  legend_ = new ColorBar(this);
  QSizePolicy always = legend_->sizePolicy();
  always.setRetainSizeWhenHidden(true);
  legend_->setSizePolicy(always);
  legend_->hide();
  layout->addWidget(legend_, 0, 1);
  notice_ = new QLabel(this);
  notice_->setObjectName("cloud-notice");
  notice_->setWordWrap(true);
  notice_->setAutoFillBackground(true);
  notice_->setMargin(3);
  notice_->setAttribute(Qt::WA_TransparentForMouseEvents);
  notice_->hide();
  layout->addWidget(notice_, 0, 0, Qt::AlignBottom);
  layout->setRowStretch(0, 1);
  layout->setColumnStretch(0, 1);
  createActions();
  if (canvas_ != nullptr) canvas_->pipeline().setPointSize(kPointSize_px);
  figure_actions_ = new FigureActions(this, {"cloud",
                                             [this] { return grab().toImage(); },
                                             [this] { return image_as_pdf(grab().toImage()); },
                                             {}});
}

CloudView::~CloudView() = default;

void CloudView::createCanvas() {
  canvas_ = new CloudCanvas(this);
  canvas_->setContextMenuPolicy(Qt::PreventContextMenu);
  canvas_->installEventFilter(this);
  follow_language(canvas_, [this] {
    canvas_->setToolTip(
        tr("Drag: turn. Shift+drag or middle button: move. Wheel or right button: "
           "zoom. Click: values of a point. Lengths in metres."));
    canvas_->setAccessibleName(tr("Point cloud"));
  });
  setFocusProxy(canvas_);
  side_ = new QLabel(canvas_);
  side_->setObjectName("cloud-side");
  side_->setAttribute(Qt::WA_TransparentForMouseEvents);
  side_->setAutoFillBackground(true);
  side_->setMargin(3);
  side_->move(6, 6);
  side_->hide();
  follow_language(side_, [this] {
    side_->setText(tr("The board from behind"));
    side_->adjustSize();
  });
  // Not while the picture is being drawn.
  connect(canvas_, &CloudCanvas::begun, this, &CloudView::updateSide, Qt::QueuedConnection);
  lasso_ = new Lasso(canvas_);
  connect(lasso_, &Lasso::drawn, this, &CloudView::brush);
  connect(canvas_, &CloudCanvas::clicked, this, &CloudView::pickAt);
  connect(canvas_, &CloudCanvas::boxEdited, this, &CloudView::boxEdited);
  connect(canvas_, &CloudCanvas::completed, this, &CloudView::completed);
}

void CloudView::createActions() {
  const auto add = [this](Qt::Key key, CloudViewpoint viewpoint) {
    auto* action = new QAction(this);
    action->setShortcut(QKeySequence(key));
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    action->setEnabled(hasOpenGl());
    connect(action, &QAction::triggered, this, [this, viewpoint] { canvas_->fly(viewpoint); });
    addAction(action);
    view_actions_.push_back(action);
  };
  add(Qt::Key_R, CloudViewpoint::kWhole);
  add(Qt::Key_T, CloudViewpoint::kTop);
  add(Qt::Key_S, CloudViewpoint::kSensor);
  add(Qt::Key_B, CloudViewpoint::kBoard);
  follow_language(this, [this] {
    const auto describe = [this](std::size_t k, const QString& text, const QString& tip) {
      QAction* action = view_actions_[k];
      action->setText(text);
      action->setToolTip(QStringLiteral("%1 (%2)").arg(
          tip, action->shortcut().toString(QKeySequence::NativeText)));
    };
    describe(0, tr("Reset"), tr("Show all points obliquely"));
    describe(1, tr("Top"), tr("Look from above"));
    describe(2, tr("Sensor"), tr("Look from the LiDAR's origin"));
    describe(3, tr("Board"), tr("Look at the board, once it is found"));
  });
}

void CloudView::setScene(std::shared_ptr<const CloudScene> scene) {
  // A recoloured cloud is looked at from the same place.
  const bool other = !scene_ || !scene || scene_->cloud != scene->cloud;
  const bool has_board = scene && scene->board_radius_m > 0.0;
  // What everything is about comes into sight when a cloud is opened, or once it is found; but who
  // has chosen a view of his own by then keeps it.
  const auto knowledge = [](const CloudScene& s) {
    return s.board_radius_m > 0.0 ? (s.board_is_likely ? 1 : 2) : 0;
  };
  const bool found = scene && scene_ && knowledge(*scene) > knowledge(*scene_) && !viewerHasMoved();
  scene_ = std::move(scene);
  if (canvas_ != nullptr) {
    canvas_->pipeline().setScene(scene_);
    // Marks are places in space: they stay however the points about them are shown.
    if (!scene_ || !scene_->cloud) canvas_->pipeline().setHighlights({});
    const auto viewpoint = has_board ? CloudViewpoint::kBoard : CloudViewpoint::kMost;
    if (other) {
      canvas_->land();
      canvas_->pipeline().look(viewpoint);
    } else if (found) {
      canvas_->fly(viewpoint);
    }
    if (other || found) framed_ = canvas_->destination();
    canvas_->redraw();
  }
  updateLegend();
}

bool CloudView::viewerHasMoved() const {
  if (canvas_ == nullptr || !framed_) return false;
  const Viewer now = canvas_->destination();
  return now.eye_m != framed_->eye_m || now.focus_m != framed_->focus_m || now.up != framed_->up;
}

void CloudView::setLines(const std::vector<CloudLine>& lines) {
  if (canvas_ == nullptr) return;
  canvas_->pipeline().setLines(lines);
  canvas_->redraw();
}

void CloudView::setHighlights(const std::vector<std::uint32_t>& points) {
  if (canvas_ == nullptr) return;
  std::vector<Eigen::Vector3d> places;
  for (const std::uint32_t i : points) {
    if (scene_ && scene_->cloud && i < scene_->cloud->size())
      places.push_back(scene_->cloud->points_m[i].cast<double>());
  }
  canvas_->pipeline().setHighlights(places);
  canvas_->redraw();
}

void CloudView::setBox(const std::optional<CropBox>& box, bool editable) {
  if (canvas_ == nullptr) return;
  canvas_->pipeline().setBox(box, editable);
  canvas_->redraw();
}

void CloudView::setPointSize(double size_px) {
  if (canvas_ == nullptr) return;
  canvas_->pipeline().setPointSize(size_px);
  canvas_->redraw();
}

void CloudView::setBrushing(bool on) {
  if (lasso_ != nullptr) lasso_->setOn(on);
}

void CloudView::look(CloudViewpoint viewpoint) {
  if (canvas_ == nullptr) return;
  canvas_->land();
  canvas_->pipeline().look(viewpoint);
  canvas_->redraw();
}

void CloudView::keyPressEvent(QKeyEvent* event) {
  if (canvas_ == nullptr) return QWidget::keyPressEvent(event);
  constexpr double kStep_deg = 5.0;
  constexpr double kZoom = 1.15;
  canvas_->land();
  switch (event->key()) {
    case Qt::Key_Left:
      canvas_->pipeline().turn(kStep_deg, 0.0);
      break;
    case Qt::Key_Right:
      canvas_->pipeline().turn(-kStep_deg, 0.0);
      break;
    case Qt::Key_Up:
      canvas_->pipeline().turn(0.0, -kStep_deg);
      break;
    case Qt::Key_Down:
      canvas_->pipeline().turn(0.0, kStep_deg);
      break;
    case Qt::Key_Plus:
      canvas_->pipeline().zoom(kZoom);
      break;
    case Qt::Key_Minus:
      canvas_->pipeline().zoom(1.0 / kZoom);
      break;
    default:
      return triggerByKey(event);
  }
  canvas_->viewMoved();
}

// A window that is not active gets keys but no shortcuts.
void CloudView::triggerByKey(QKeyEvent* event) {
  for (QAction* action : view_actions_) {
    if (action->shortcut() == QKeySequence(event->keyCombination())) return action->trigger();
  }
  QWidget::keyPressEvent(event);
}

// A right click without a drag asks for the menu; with one it zooms.
bool CloudView::eventFilter(QObject* watched, QEvent* event) {
  if (watched == canvas_ && event->type() == QEvent::MouseButtonPress) {
    right_pressed_ = static_cast<QMouseEvent*>(event)->position().toPoint();
  } else if (watched == canvas_ && event->type() == QEvent::MouseButtonRelease) {
    const auto* mouse = static_cast<QMouseEvent*>(event);
    const QPoint moved = mouse->position().toPoint() - right_pressed_;
    if (mouse->button() == Qt::RightButton &&
        moved.manhattanLength() < QApplication::startDragDistance()) {
      showMenu(mouse->globalPosition().toPoint());
    }
  }
  return QWidget::eventFilter(watched, event);
}

void CloudView::showMenu(const QPoint& place) {
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  for (QAction* action : view_actions_) menu->addAction(action);
  menu->addSeparator();
  figure_actions_->addTo(menu);
  menu->popup(place);
}

void CloudView::pickAt(const QPointF& place) {
  if (!scene_ || scene_->size() == 0) return;
  const double ratio = canvas_->devicePixelRatioF();
  const QSize size = canvas_->deviceSize();
  const auto picked =
      pick_point(scene_->xyz_m, canvas_->pipeline().clipFromWorld(),
                 Eigen::Vector2d(size.width(), size.height()),
                 ratio * Eigen::Vector2d(place.x(), place.y()), ratio * kPickRadius_px);
  if (picked) {
    Q_EMIT pointPicked(scene_->order[*picked]);
  } else {
    Q_EMIT nothingPicked();
  }
}

void CloudView::brush(const QPolygonF& line, bool add) {
  if (!scene_) return;
  const double ratio = canvas_->devicePixelRatioF();
  const QSize size = canvas_->deviceSize();
  const LassoMask mask(QTransform::fromScale(ratio, ratio).map(line));
  std::vector<std::uint32_t> points;
  for (const std::size_t k : points_inside(scene_->xyz_m, canvas_->pipeline().clipFromWorld(),
                                           Eigen::Vector2d(size.width(), size.height()), mask))
    points.push_back(scene_->order[k]);
  Q_EMIT pointsBrushed(points, add);
}

void CloudView::updateSide() {
  const bool behind =
      scene_ && scene_->board_radius_m > 0.0 &&
      (canvas_->pipeline().viewer().eye_m - scene_->board_center_m).dot(scene_->board_normal) < 0.0;
  side_->setVisible(behind);
}

void CloudView::updateLegend() {
  const bool shown = scene_ && scene_->size() > 0;
  if (shown && scene_->has_scale)
    legend_->setScale(scene_->scale, scene_->quantity, scene_->whole, scene_->histogram);
  if (shown && !scene_->has_scale) {
    if (scene_->categories.empty()) {
      legend_->setNameOnly(scene_->quantity);
    } else {
      legend_->setCategories(scene_->categories, scene_->quantity);
    }
  }
  legend_->setMinimumWidth(std::max(legend_->minimumWidth(), legend_->sizeHint().width()));
  legend_->setVisible(shown);
  notice_->setText(scene_ ? scene_->notice : QString());
  notice_->setVisible(!notice_->text().isEmpty());
}

}  // namespace lvcalib::widgets

#include "moc_cloud_view.cpp"
