// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/board_intensity_view.h"

#include <QContextMenuEvent>
#include <QMenu>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <utility>

#include "modelling/model_text.h"
#include "style/texts.h"
#include "views/color_map.h"

namespace lvcalib::widgets {
namespace {

QImage picture(const BoardIntensity& data, const std::vector<float>& values,
               const ColorScale& scale, bool gray) {
  QImage image(data.columns, data.rows, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  for (int row = 0; row < data.rows; ++row) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(data.rows - 1 - row));
    for (int column = 0; column < data.columns; ++column) {
      const auto value =
          static_cast<double>(values[static_cast<std::size_t>(row * data.columns + column)]);
      if (std::isnan(value)) continue;
      if (gray) {
        const double share = (value - scale.low) / std::max(scale.high - scale.low, 1e-12);
        const int level = static_cast<int>(255.0 * std::clamp(share, 0.0, 1.0));
        line[column] = qRgb(level, level, level);
      } else {
        line[column] = scale.color(value);
      }
    }
  }
  return image;
}

}  // namespace

BoardIntensityView::BoardIntensityView(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("board_intensity"));
  follow_language(this, [this] {
    setToolTip(tr(
        "Intensity over the board: measured, as the model predicts it, and the difference (blue: "
        "darker than predicted, red: brighter)."));
    update();
  });
  actions_ = new FigureActions(this, {QStringLiteral("board-intensity"),
                                      [this] {
                                        QImage image(2 * size(), QImage::Format_ARGB32);
                                        image.fill(palette().color(QPalette::Base));
                                        QPainter painter(&image);
                                        painter.scale(2.0, 2.0);
                                        paint(painter, rect());
                                        return image;
                                      },
                                      {},
                                      {}});
  timer_.setInterval(kFlickerMs);
  connect(&timer_, &QTimer::timeout, this, [this] {
    odd_ = !odd_;
    update();
  });
}

void BoardIntensityView::setImages(std::shared_ptr<const BoardIntensity> images,
                                   const QString& message) {
  data_ = std::move(images);
  message_ = message;
  if (data_ && !data_->measured.empty()) {
    const ColorScale gray = scale_for(data_->measured, ColorMap::kSequential);
    const ColorScale difference = scale_for(data_->difference, ColorMap::kDiverging);
    low_ = gray.low;
    high_ = gray.high;
    range_ = difference.high;
    pictures_[0] = picture(*data_, data_->measured, gray, true);
    pictures_[1] = picture(*data_, data_->predicted, gray, true);
    pictures_[2] = picture(*data_, data_->difference, difference, false);
  } else {
    for (QImage& image : pictures_) image = {};
  }
  update();
}

void BoardIntensityView::setFlicker(bool on) {
  flicker_ = on;
  odd_ = false;
  if (on && isVisible()) {
    timer_.start();
  } else {
    timer_.stop();
  }
  update();
}

void BoardIntensityView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (flicker_) timer_.start();
}

void BoardIntensityView::hideEvent(QHideEvent* event) {
  timer_.stop();
  QWidget::hideEvent(event);
}

void BoardIntensityView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  paint(painter, rect());
}

void BoardIntensityView::paint(QPainter& painter, const QRectF& area) {
  painter.setPen(palette().color(QPalette::Text));
  if (pictures_[0].isNull()) {
    painter.drawText(area, static_cast<int>(Qt::AlignCenter) | static_cast<int>(Qt::TextWordWrap),
                     message_.isEmpty() ? tr("no intensity in these clouds") : message_);
    return;
  }
  const QString titles[] = {tr("measured (%1 … %2)").arg(plain_number(low_), plain_number(high_)),
                            tr("predicted"), tr("difference (±%1)").arg(plain_number(range_, 2))};
  const int shown = flicker_ ? 2 : 3;
  const double title = 1.6 * painter.fontMetrics().height();
  const double width = area.width() / shown;
  const double aspect = static_cast<double>(data_->columns) / data_->rows;
  double below = area.top();
  for (int k = 0; k < shown; ++k) {
    // In turns: the left place shows both, the right one the difference.
    const int which = flicker_ ? (k == 1 ? 2 : (odd_ ? 1 : 0)) : k;
    const QRectF place(area.left() + k * width + 4, area.top() + title, width - 8,
                       area.height() - 2 * title - 8);
    const double w = std::min(place.width(), place.height() * aspect);
    const QRectF target(place.center().x() - 0.5 * w, place.top(), w, w / aspect);
    painter.drawText(QRectF(place.left(), area.top(), place.width(), title), Qt::AlignCenter,
                     painter.fontMetrics().elidedText(titles[which], Qt::ElideRight,
                                                      static_cast<int>(place.width())));
    painter.drawImage(target, pictures_[which]);
    painter.drawRect(target);
    below = std::max(below, target.bottom());
  }
  paintLegend(painter, QRectF(area.left() + 4, below + 4, area.width() - 8, title));
}

// What the colours of the difference say.
void BoardIntensityView::paintLegend(QPainter& painter, const QRectF& place) {
  const QFontMetrics metrics = painter.fontMetrics();
  const std::pair<double, QString> entries[] = {{0.0, tr("darker than predicted")},
                                                {1.0, tr("brighter")}};
  double x = place.left();
  double y = place.top();
  for (const auto& [share, text] : entries) {
    const double wide = metrics.horizontalAdvance(text) + 2.0;
    if (x > place.left() && x + 14.0 + wide > place.right()) {
      x = place.left();
      y += metrics.height();
    }
    const QRectF box(x, y + 0.5 * place.height() - 5.0, 10.0, 10.0);
    painter.fillRect(box, QColor::fromRgb(map_color(ColorMap::kDiverging, share)));
    painter.drawText(QRectF(box.right() + 4.0, y, wide, place.height()),
                     Qt::AlignLeft | Qt::AlignVCenter, text);
    x = box.right() + 4.0 + wide + 12.0;
  }
}

void BoardIntensityView::contextMenuEvent(QContextMenuEvent* event) {
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  actions_->addTo(menu);
  menu->popup(event->globalPos());
}

}  // namespace lvcalib::widgets

#include "moc_board_intensity_view.cpp"
