// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/time_line.h"

#include <QApplication>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <utility>

#include "style/swatch.h"
#include "style/theme.h"

namespace lvcalib::widgets {
namespace {

constexpr int kMargin = 6;
// Height of the row of pictures.
constexpr int kPictures_px = 40;
// So near to an edge the mouse holds it.
constexpr int kHandle = 5;
// No stretch becomes narrower by dragging.
constexpr double kLeast_s = 0.1;
// Motion of the whole view; the curves' upper edge.
constexpr double kMostMotion = 300.0;

// Motion spans orders of magnitude, and what matters is near the threshold.
double height_of(double motion) {
  return std::min(1.0, std::log10(1.0 + motion) / std::log10(1.0 + kMostMotion));
}

// 1, 2 or 5 times a power of ten, so that a label of that width fits between two ticks.
double tick_step(double length_s, double width_px, double label_px) {
  const double least = length_s * label_px / std::max(1.0, width_px);
  double step = std::pow(10.0, std::floor(std::log10(std::max(1e-3, least))));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if (step >= least) break;
    step *= factor;
  }
  return step;
}

}  // namespace

TimeLine::TimeLine(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("time_line"));
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

void TimeLine::clear() {
  pictures_.clear();
  setRecording(0.0, {}, {});
}

void TimeLine::setRecording(double length_s, const RecordedMotion& motion,
                            const std::vector<ImportedStretch>& stretches) {
  length_s_ = length_s;
  motion_ = motion;
  stretches_ = stretches;
  taken_.assign(stretches.size(), false);
  texts_.clear();
  current_ = -1;
  drag_.reset();
  update();
}

void TimeLine::addPicture(double time_s, const QImage& picture) {
  const auto at =
      std::upper_bound(pictures_.begin(), pictures_.end(), time_s,
                       [](double time, const Picture& other) { return time < other.time_s; });
  pictures_.insert(at, {time_s, QPixmap::fromImage(picture)});
  update();
}

void TimeLine::setTaken(const std::vector<bool>& taken) {
  if (taken.size() != stretches_.size()) return;
  taken_ = taken;
  update();
}

void TimeLine::setTexts(const QStringList& texts) {
  texts_ = texts;
}

void TimeLine::setCurrent(int stretch) {
  current_ = stretch;
  update();
}

QRect TimeLine::plotRect() const {
  const QFontMetrics metrics(font());
  const int names =
      std::max(metrics.horizontalAdvance(tr("Images")), metrics.horizontalAdvance(tr("Clouds")));
  return rect().adjusted(names + 3 * kMargin, kMargin + kPictures_px, -2 * kMargin,
                         -metrics.height() - 2 * kMargin);
}

double TimeLine::xOf(double time_s) const {
  const QRect plot = plotRect();
  return plot.left() + plot.width() * std::clamp(time_s / std::max(1e-9, length_s_), 0.0, 1.0);
}

double TimeLine::timeOf(int x) const {
  const QRect plot = plotRect();
  return length_s_ * (x - plot.left()) / std::max(1, plot.width());
}

std::pair<double, double> TimeLine::rangeOf(int stretch, bool last) const {
  const ImportedStretch& s = stretches_[static_cast<std::size_t>(stretch)];
  double least = last ? s.first_s + kLeast_s : 0.0;
  double most = last ? length_s_ : s.last_s - kLeast_s;
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    const ImportedStretch& other = stretches_[i];
    if (static_cast<int>(i) == stretch || !other.usable) continue;
    if (!last && other.last_s <= s.last_s) least = std::max(least, other.last_s);
    if (last && other.first_s >= s.first_s) most = std::min(most, other.first_s);
  }
  return {std::min(least, most), most};
}

QRect TimeLine::stretchRect(int stretch) const {
  if (stretch < 0 || static_cast<std::size_t>(stretch) >= stretches_.size()) return {};
  const ImportedStretch& s = stretches_[static_cast<std::size_t>(stretch)];
  const QRect plot = plotRect();
  const int left = static_cast<int>(std::lround(xOf(s.first_s)));
  const int right = static_cast<int>(std::lround(xOf(s.last_s)));
  return {left, plot.top(), std::max(3, right - left), plot.height()};
}

int TimeLine::stretchAt(const QPoint& at) const {
  for (int i = 0; i < static_cast<int>(stretches_.size()); ++i) {
    if (stretchRect(i).contains(at)) return i;
  }
  return -1;
}

// Of the nearest edge; a third of a narrow stretch is left for clicks.
std::optional<TimeLine::Handle> TimeLine::handleAt(const QPoint& at) const {
  std::optional<Handle> best;
  int nearest = kHandle + 1;
  for (int i = 0; i < static_cast<int>(stretches_.size()); ++i) {
    const QRect band = stretchRect(i);
    if (at.y() < band.top() || at.y() > band.bottom()) continue;
    const int inside = std::min(kHandle, band.width() / 3);
    for (const bool last : {false, true}) {
      const int beyond = last ? at.x() - band.right() : band.left() - at.x();
      if (beyond < -inside || std::abs(beyond) >= nearest) continue;
      nearest = std::abs(beyond);
      best = Handle{i, last};
    }
  }
  return best;
}

void TimeLine::drag(const QPoint& at, const QPoint& global) {
  if (!drag_->moved && std::abs(at.x() - drag_->from_x) < QApplication::startDragDistance() / 2)
    return;
  drag_->moved = true;
  const auto [stretch, last] = drag_->handle;
  const auto [least, most] = rangeOf(stretch, last);
  ImportedStretch& s = stretches_[static_cast<std::size_t>(stretch)];
  const double time_s = std::clamp(timeOf(at.x()), least, most);
  (last ? s.last_s : s.first_s) = time_s;
  QToolTip::showText(global, tr("%1 s").arg(QString::number(time_s, 'f', 2)), this);
  update();
}

// Each in the middle of its share of the time, as wide as its neighbours leave it.
void TimeLine::paintPictures(QPainter& painter) const {
  if (pictures_.empty()) return;
  const QRect plot = plotRect();
  const int share = plot.width() / static_cast<int>(pictures_.size()) - 2;
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  for (const Picture& picture : pictures_) {
    const QSize size =
        picture.pixmap.size().scaled(std::max(8, share), kPictures_px - 4, Qt::KeepAspectRatio);
    const int x = static_cast<int>(std::lround(xOf(picture.time_s))) - size.width() / 2;
    const int left = std::clamp(x, plot.left(), std::max(plot.left(), plot.right() - size.width()));
    painter.drawPixmap(QRect(QPoint(left, plot.top() - kPictures_px), size), picture.pixmap);
  }
}

void TimeLine::paintBands(QPainter& painter) const {
  const StateColors colors = state_colors(palette());
  for (int i = 0; i < static_cast<int>(stretches_.size()); ++i) {
    const QRect band = stretchRect(i);
    const bool taken = taken_[static_cast<std::size_t>(i)];
    QColor color = taken ? colors.good : colors.idle;
    color.setAlpha(taken ? 70 : 110);
    // Told apart by shape as well as colour: what is left is hatched, what is taken has a bar.
    painter.fillRect(band, taken ? QBrush(color) : hatched(color));
    if (taken) painter.fillRect(QRect(band.left(), band.top(), band.width(), 4), colors.good);
    const ImportedStretch& s = stretches_[static_cast<std::size_t>(i)];
    if (s.by_hand) {
      painter.setPen(QPen(palette().color(QPalette::Text), 1, Qt::DashLine));
      for (const double found_s : {s.found_first_s, s.found_last_s}) {
        const int x = static_cast<int>(std::lround(xOf(found_s)));
        painter.drawLine(x, band.top(), x, band.bottom());
      }
    }
    // Grips in the middle of the edges.
    painter.setPen(Qt::NoPen);
    painter.setBrush(i == current_ ? colors.accent : palette().color(QPalette::Mid));
    for (const int x : {band.left(), band.right()})
      painter.drawRoundedRect(QRect(x - 2, band.center().y() - 9, 5, 18), 2, 2);
    if (i == current_) {
      painter.setPen(QPen(colors.accent, 2));
      painter.setBrush(Qt::NoBrush);
      painter.drawRect(band);
    }
  }
}

void TimeLine::paintLane(QPainter& painter, const QRect& rect, const Lane& lane) const {
  QColor line = palette().color(QPalette::Text);
  painter.setPen(line);
  painter.drawText(QRect(kMargin, rect.top(), rect.left() - 2 * kMargin, rect.height()),
                   static_cast<int>(Qt::AlignRight) | Qt::AlignVCenter, lane.name);
  const auto y_of = [&](double motion) {
    return rect.bottom() - (rect.height() - 2) * height_of(motion);
  };
  // The largest of the samples of a pixel.
  std::vector<double> columns(static_cast<std::size_t>(rect.width()) + 1, -1.0);
  for (const MotionSample& s : *lane.samples) {
    const auto x = static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::lround(xOf(s.time_s))) - rect.left(), 0, rect.width()));
    columns[x] = std::max(columns[x], s.motion);
  }
  QPolygonF curve;
  for (std::size_t x = 0; x < columns.size(); ++x) {
    if (columns[x] >= 0.0) curve << QPointF(rect.left() + static_cast<double>(x), y_of(columns[x]));
  }
  if (curve.size() > 1) {
    QPainterPath area;
    area.addPolygon(curve);
    area.lineTo(curve.last().x(), rect.bottom());
    area.lineTo(curve.first().x(), rect.bottom());
    QColor fill = line;
    fill.setAlpha(60);
    painter.fillPath(area, fill);
    line.setAlpha(190);
    painter.setPen(QPen(line, 1.2));
    painter.drawPolyline(curve);
  }
  QColor limit = palette().color(QPalette::Text);
  limit.setAlpha(130);
  painter.setPen(QPen(limit, 1, Qt::DotLine));
  const int y = static_cast<int>(std::lround(y_of(1.0)));
  painter.drawLine(rect.left(), y, rect.right(), y);
}

void TimeLine::paintAxis(QPainter& painter) const {
  const QRect plot = plotRect();
  const QFontMetrics metrics(font());
  const double step =
      tick_step(length_s_, plot.width(), 1.8 * metrics.horizontalAdvance(QStringLiteral("0000.0")));
  painter.setPen(palette().color(QPalette::Text));
  const auto ticks = static_cast<int>(std::floor(length_s_ / step));
  for (int i = 0; i <= ticks; ++i) {
    const int x = static_cast<int>(std::lround(xOf(i * step)));
    painter.drawLine(x, plot.bottom(), x, plot.bottom() + 4);
    const QString text = i == 0 ? QStringLiteral("0 s") : QString::number(i * step, 'g', 6);
    const int width = metrics.horizontalAdvance(text);
    const int left = std::min(x - width / 2, rect().right() - width);
    painter.drawText(left, plot.bottom() + 5 + metrics.ascent(), text);
  }
}

void TimeLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRect plot = plotRect();
  painter.fillRect(plot, palette().color(QPalette::Base));
  if (length_s_ <= 0.0) return;
  paintPictures(painter);
  paintBands(painter);
  const int half = plot.height() / 2;
  paintLane(painter, QRect(plot.left(), plot.top() + 5, plot.width(), half - 8),
            {tr("Images"), &motion_.image});
  paintLane(painter, QRect(plot.left(), plot.top() + half + 4, plot.width(), half - 4),
            {tr("Clouds"), &motion_.cloud});
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawLine(plot.left(), plot.bottom(), plot.right(), plot.bottom());
  paintAxis(painter);
}

void TimeLine::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const auto handle = handleAt(event->pos())) {
    drag_ = Drag{*handle, event->pos().x()};
    return;
  }
  const int stretch = stretchAt(event->pos());
  if (stretch >= 0) Q_EMIT clicked(stretch);
}

void TimeLine::mouseMoveEvent(QMouseEvent* event) {
  if (drag_) {
    drag(event->pos(), event->globalPosition().toPoint());
    return;
  }
  if (handleAt(event->pos())) {
    setCursor(Qt::SizeHorCursor);
    return;
  }
  const int stretch = stretchAt(event->pos());
  const bool usable = stretch >= 0 && stretches_[static_cast<std::size_t>(stretch)].usable;
  setCursor(usable ? Qt::PointingHandCursor : Qt::ArrowCursor);
}

void TimeLine::mouseReleaseEvent(QMouseEvent* event) {
  if (!drag_ || event->button() != Qt::LeftButton) return;
  const Drag drag = *std::exchange(drag_, std::nullopt);
  const ImportedStretch& s = stretches_[static_cast<std::size_t>(drag.handle.stretch)];
  if (drag.moved) {
    Q_EMIT edgesMoved(drag.handle.stretch, s.first_s, s.last_s);
  } else if (stretchRect(drag.handle.stretch).contains(event->pos())) {
    Q_EMIT clicked(drag.handle.stretch);  // Not a drag after all.
  }
}

bool TimeLine::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    const int stretch = stretchAt(help->pos());
    if (stretch >= 0 && stretch < texts_.size()) {
      QToolTip::showText(help->globalPos(), texts_.at(stretch), this, stretchRect(stretch));
    } else {
      QToolTip::showText(help->globalPos(),
                         tr("How much image and cloud change, above the dotted line: motion. "
                            "Bands are stretches in which both stand still; their edges can be "
                            "dragged."),
                         this);
    }
    return true;
  }
  if (event->type() == QEvent::LanguageChange || event->type() == QEvent::PaletteChange) update();
  return QWidget::event(event);
}

}  // namespace lvcalib::widgets

#include "moc_time_line.cpp"
