// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/time_line.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "style/theme.h"

namespace lvcalib::widgets {
namespace {

constexpr int kMargin = 6;
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
  return rect().adjusted(names + 3 * kMargin, kMargin, -2 * kMargin,
                         -metrics.height() - 2 * kMargin);
}

double TimeLine::xOf(double time_s) const {
  const QRect plot = plotRect();
  return plot.left() + plot.width() * std::clamp(time_s / std::max(1e-9, length_s_), 0.0, 1.0);
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

void TimeLine::paintBands(QPainter& painter) const {
  const StateColors colors = state_colors(palette());
  for (int i = 0; i < static_cast<int>(stretches_.size()); ++i) {
    const QRect band = stretchRect(i);
    const bool taken = taken_[static_cast<std::size_t>(i)];
    QColor color = taken ? colors.good : colors.idle;
    color.setAlpha(taken ? 70 : 110);
    // Told apart by shape as well as colour: what is left is hatched, what is taken has a bar.
    painter.fillRect(band, QBrush(color, taken ? Qt::SolidPattern : Qt::BDiagPattern));
    if (taken) painter.fillRect(QRect(band.left(), band.top(), band.width(), 4), colors.good);
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
  const int stretch = stretchAt(event->pos());
  if (stretch >= 0 && event->button() == Qt::LeftButton) Q_EMIT clicked(stretch);
}

void TimeLine::mouseMoveEvent(QMouseEvent* event) {
  const int stretch = stretchAt(event->pos());
  const bool usable = stretch >= 0 && stretches_[static_cast<std::size_t>(stretch)].usable;
  setCursor(usable ? Qt::PointingHandCursor : Qt::ArrowCursor);
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
                            "Bands are stretches in which both stand still."),
                         this);
    }
    return true;
  }
  if (event->type() == QEvent::LanguageChange || event->type() == QEvent::PaletteChange) update();
  return QWidget::event(event);
}

}  // namespace lvcalib::widgets
