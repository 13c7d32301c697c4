// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/plot_view.h"

#include <QContextMenuEvent>
#include <QFile>
#include <QMenu>
#include <QPainter>
#include <QTemporaryDir>
#include <algorithm>
#include <typeinfo>
#include <utility>

#include "style/unseen.h"

namespace lvcalib::widgets {

QString csv_number(double value) {
  return QString::number(value, 'g', QLocale::FloatingPointShortest);
}

PlotView::PlotView(QWidget* parent) : QCustomPlot(parent), colors_(PlotColors::of(palette())) {
  setFocusPolicy(Qt::StrongFocus);
  setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  // Else each figure of a page brings the whole window onto the screen for itself.
  setPlottingHint(QCP::phImmediateRefresh, false);
  setMinimumSize(90, 70);
  setBrushing(false);
  actions_ = new FigureActions(this, {"figure", [this] { return toPixmap(0, 0, 2.0).toImage(); },
                                      [this] { return pdf(); }, [this] { return csv(); }});
  applyColors();
  connect(this, &QCustomPlot::beforeReplot, this, &PlotView::fitLabels);
  connect(this, &QCustomPlot::afterReplot, this, [this] { old_colors_ = false; });
}

QByteArray PlotView::csv() const {
  const std::vector<QStringList> rows = rows_ ? rows_() : std::vector<QStringList>();
  if (rows.empty()) return {};
  QString text = header_.join(',') + '\n';
  for (const QStringList& row : rows) text += row.join(',') + '\n';
  return text.toUtf8();
}

// A picture of its own for the rectangle, as large as the figure, only while there may be one.
void PlotView::setBrushing(bool brushing) {
  setSelectionRectMode(brushing ? QCP::srmCustom : QCP::srmNone);
  layer(QStringLiteral("overlay"))->setMode(brushing ? QCPLayer::lmBuffered : QCPLayer::lmLogical);
}

void PlotView::resetView() {
  xAxis->setRange(home_x_);
  yAxis->setRange(home_y_);
  replot();
}

void PlotView::clearFigure() {
  clearPlottables();
  clearItems();
  showLegend({});
  setTable({}, nullptr);
}

std::vector<LegendEntry> PlotView::legendEntries() const {
  return legend_row_ != nullptr ? legend_row_->entries() : std::vector<LegendEntry>();
}

void PlotView::showLegend(std::vector<LegendEntry> entries) {
  if (legend_row_ == nullptr) {
    if (entries.empty()) return;
    legend_row_ = new PlotLegend(this);
  }
  legend_row_->setEntries(std::move(entries), font(), colors_.text);
}

namespace {

// Words in lines that are not longer than `width`; a word that is longer stays whole.
QString in_lines(const QString& text, const QFontMetrics& metrics, int width) {
  QString out;
  QString line;
  for (const QString& word : text.split(QLatin1Char(' '))) {
    const QString longer = line.isEmpty() ? word : line + QLatin1Char(' ') + word;
    if (!line.isEmpty() && metrics.horizontalAdvance(longer) > width) {
      out += line + QLatin1Char('\n');
      line = word;
    } else {
      line = longer;
    }
  }
  return out + line;
}

}  // namespace

void PlotView::showMessage(const QString& text) {
  auto* item = new QCPItemText(this);
  item->setProperty("words", text);
  item->setText(text);
  item->setColor(colors_.axis);
  item->setFont(font());
  item->position->setType(QCPItemPosition::ptAxisRectRatio);
  item->position->setCoords(0.5, 0.5);
}

void PlotView::showWholeNumbers(QCPAxis& axis) {
  const QSharedPointer<QCPAxisTickerFixed> whole(new QCPAxisTickerFixed);
  whole->setTickStep(1.0);
  whole->setScaleStrategy(QCPAxisTickerFixed::ssMultiples);
  axis.setTicker(whole);
  axis.setSubTicks(false);
}

void PlotView::setHome(const QCPRange& x, const QCPRange& y) {
  home_x_ = x;
  home_y_ = y;
  xAxis->setRange(x);
  yAxis->setRange(y);
}

void PlotView::setTable(const QStringList& header, std::function<std::vector<QStringList>()> rows) {
  header_ = header;
  rows_ = std::move(rows);
}

void PlotView::setTable(const QStringList& header, std::vector<QStringList> rows) {
  setTable(header, [rows = std::move(rows)] { return rows; });
}

void PlotView::changeEvent(QEvent* event) {
  QCustomPlot::changeEvent(event);
  const QEvent::Type what = event->type();
  if (what != QEvent::LanguageChange && what != QEvent::PaletteChange && what != QEvent::FontChange)
    return;
  if (what != QEvent::LanguageChange) {
    colors_ = PlotColors::of(palette());
    applyColors();
    old_colors_ = true;
  }
  stale_ = unseen(*this);
  if (!stale_) rebuild();
}

void PlotView::showEvent(QShowEvent* event) {
  QCustomPlot::showEvent(event);
  if (std::exchange(stale_, false)) rebuild();
}

// Axes and words for a light ground are not seen on a dark one: until they are drawn anew there is
// the ground alone.
void PlotView::paintEvent(QPaintEvent* event) {
  if (!old_colors_) return QCustomPlot::paintEvent(event);
  QPainter(this).fillRect(rect(), colors_.background);
}

void PlotView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Home) {
    resetView();
  } else if (event->key() == Qt::Key_Plus || event->key() == Qt::Key_Minus) {
    const double factor = event->key() == Qt::Key_Plus ? 0.8 : 1.25;
    xAxis->scaleRange(factor);
    yAxis->scaleRange(factor);
    replot();
  } else if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Space) {
    Q_EMIT clicked(QPointF(0.5 * width(), 0.5 * height()));
  } else {
    QCustomPlot::keyPressEvent(event);
  }
}

void PlotView::mousePressEvent(QMouseEvent* event) {
  pressed_ = event->position();
  QCustomPlot::mousePressEvent(event);
}

void PlotView::mouseReleaseEvent(QMouseEvent* event) {
  QCustomPlot::mouseReleaseEvent(event);
  if (event->button() == Qt::LeftButton &&
      (event->position() - pressed_).manhattanLength() < QApplication::startDragDistance()) {
    Q_EMIT clicked(event->position());
  }
}

void PlotView::mouseDoubleClickEvent(QMouseEvent* event) {
  QCustomPlot::mouseDoubleClickEvent(event);
  if (event->button() == Qt::LeftButton) resetView();
}

void PlotView::contextMenuEvent(QContextMenuEvent* event) {
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  menu->addAction(tr("Show everything"), QKeySequence(Qt::Key_Home), this, &PlotView::resetView);
  menu->addSeparator();
  actions_->addTo(menu);
  menu->popup(event->globalPos());
}

void PlotView::applyColors() {
  setBackground(QBrush(colors_.background));
  for (QCPAxis* axis : {xAxis, yAxis, xAxis2, yAxis2}) {
    axis->setBasePen(QPen(colors_.axis));
    axis->setTickPen(QPen(colors_.axis));
    axis->setSubTickPen(QPen(colors_.axis));
    axis->setTickLabelColor(colors_.text);
    axis->setLabelColor(colors_.text);
    axis->setTickLabelFont(font());
    axis->setLabelFont(font());
    axis->grid()->setPen(QPen(colors_.grid));
    axis->grid()->setZeroLinePen(Qt::NoPen);
    axis->grid()->setSubGridVisible(false);
  }
  legend->setBrush(QBrush(colors_.background));
  legend->setTextColor(colors_.text);
  legend->setBorderPen(QPen(colors_.grid));
  legend->setFont(font());
}

// As many numbers as there is room for.
void PlotView::fitTicks() {
  constexpr int kUsual = 5;
  constexpr int kOtherParts_px = 70;  // Margins, labels and numbers of the other axis.
  const QFontMetrics metrics(font());
  for (QCPAxis* axis : {xAxis, xAxis2, yAxis, yAxis2}) {
    QCPAxisTicker& ticker = *axis->ticker();
    // Others place their own.
    if (typeid(ticker) != typeid(QCPAxisTicker) && typeid(ticker) != typeid(QCPAxisTickerFixed))
      continue;
    const bool across = axis->orientation() == Qt::Horizontal;
    const QSize laid_out = axis->axisRect()->size();
    const int known_px = across ? laid_out.width() : laid_out.height();
    const int room_px = known_px > 10 ? known_px : (across ? width() : height()) - kOtherParts_px;
    const int wanted_px =
        across ? metrics.horizontalAdvance(QStringLiteral("0.0000")) : 2 * metrics.height();
    ticker.setTickCount(std::clamp(room_px / std::max(1, wanted_px), 2, kUsual));
  }
}

// A sentence is not cut off at the edges of a small figure.
void PlotView::fitMessage() {
  const int laid_out_px = axisRect()->width();
  for (int k = 0; k < itemCount(); ++k) {
    auto* text = qobject_cast<QCPItemText*>(item(k));
    if (text == nullptr || !text->property("words").isValid()) continue;
    text->setText(in_lines(text->property("words").toString(), QFontMetrics(text->font()),
                           (laid_out_px > 10 ? laid_out_px : width()) - 12));
  }
}

void PlotView::fitLabels() {
  fitTicks();
  fitMessage();
  constexpr double kOtherParts_px = 36.0;  // Margins, and the numbers below the figure.
  constexpr double kSmallest = 0.6;
  const double legend_px =
      legend_row_ != nullptr ? legend_row_->minimumOuterSizeHint().height() : 0.0;
  for (QCPAxis* axis : {yAxis, yAxis2}) {
    if (axis->label().isEmpty()) continue;
    QFont fitting = font();
    const QFontMetricsF metrics(fitting);
    const double room = height() - kOtherParts_px - legend_px;
    QString words = axis->label().replace(QLatin1Char('\n'), QLatin1Char(' '));
    double wanted = metrics.horizontalAdvance(words);
    // In two lines, where it would be cut off even so.
    const auto gap = words.indexOf(QLatin1Char(' '));
    if (kSmallest * wanted > room && gap > 0) {
      words[gap] = QLatin1Char('\n');
      wanted = metrics.size(0, words).width();
    }
    if (axis->label() != words) axis->setLabel(words);
    const double share = std::clamp(room / wanted, kSmallest, 1.0);
    fitting.setPointSizeF(share * fitting.pointSizeF());
    if (axis->labelFont() != fitting) axis->setLabelFont(fitting);
  }
}

QByteArray PlotView::pdf() {
  // QCustomPlot writes PDF to a file name only.
  const QTemporaryDir folder;
  const QString path = folder.filePath("figure.pdf");
  if (!savePdf(path, width(), height())) return {};
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace lvcalib::widgets

#include "moc_plot_view.cpp"
