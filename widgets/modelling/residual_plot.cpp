// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/residual_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modelling/model_text.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

constexpr std::size_t kMostSelected = 3000;
constexpr double kSigmas = 2.0;
constexpr double kBeyond = 1e30;  // Of all residuals.

}  // namespace

QString axis_text(const std::string& name, const std::string& unit) {
  const QString text = covariate_name(name);
  return unit.empty() || unit == "1"
             ? text
             : QStringLiteral("%1 (%2)").arg(text, QString::fromStdString(unit));
}

ResidualPlot::ResidualPlot(QWidget* parent) : PlotView(parent) {
  setObjectName(QStringLiteral("residual_plot"));
  figureActions()->setName(QStringLiteral("residuals"));
  follow_language(this, [this] {
    setToolTip(
        tr("Each residual (measured − predicted) as a dot, denser where there are more. Marks: "
           "means of groups with two standard deviations, filled where they differ from zero "
           "beyond chance. Dashed lines: the noise of a single residual. Grey: the means of the "
           "base model."));
    rebuild();
  });
  connect(selectionRect(), &QCPSelectionRect::changed, this,
          [this](const QRect& rect) { emitBrush(rect); });
  connect(selectionRect(), &QCPSelectionRect::accepted, this,
          [this](const QRect& rect) { emitBrush(rect); });
}

void ResidualPlot::setFigure(std::shared_ptr<const ResidualFigure> figure, const QString& message) {
  const bool other = !figure || !figure_ || figure->view != figure_->view;
  figure_ = std::move(figure);
  message_ = message;
  if (other) selected_.clear();
  rebuild();
}

void ResidualPlot::setBeforeShown(bool shown) {
  before_ = shown;
  rebuild();
}

void ResidualPlot::setMeansOnly(bool on) {
  means_only_ = on;
  before_ = before_ && !on;
  rebuild();
}

double ResidualPlot::halfHeight() const {
  if (!means_only_) return figure_->y_high;
  double most = 0.0;
  for (const ResidualBin& bin : figure_->now)
    most = std::max(most, std::abs(bin.residual.mean) + kSigmas * bin.residual.sigma);
  for (const ResidualBin& bin : figure_->predicted)
    most = std::max(most, std::abs(scale_ * bin.residual.mean));
  return most > 0.0 ? 1.2 * most : figure_->y_high;
}

void ResidualPlot::setOverlayScale(double scale) {
  scale_ = scale;
  rebuild();
}

void ResidualPlot::setSelected(std::vector<std::size_t> rows) {
  selected_ = std::move(rows);
  rebuild();
}

void ResidualPlot::emitBrush(const QRect& rect) {
  const QRect r = rect.normalized();
  const double x0 = xAxis->pixelToCoord(r.left());
  const double x1 = xAxis->pixelToCoord(r.right());
  double y0 = yAxis->pixelToCoord(r.bottom());
  double y1 = yAxis->pixelToCoord(r.top());
  // A few residuals lie beyond what is drawn. Who brushes a stretch from edge to edge means them,
  // too: left alone there they would be all that speaks for the stretch.
  const QRect drawn = axisRect()->rect();
  const auto whole = yAxis->range();
  if (figure_ && r.bottom() >= drawn.bottom() && whole.lower <= figure_->y_low) y0 = -kBeyond;
  if (figure_ && r.top() <= drawn.top() && whole.upper >= figure_->y_high) y1 = kBeyond;
  Q_EMIT brushed(QRectF(QPointF(x0, y0), QPointF(x1, y1)));
}

void ResidualPlot::rebuild() {
  clearFigure();
  if (!figure_) {
    // Nothing of the figure before stays, in the words of a language before perhaps.
    xAxis->setLabel({});
    yAxis->setLabel({});
    xAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    showMessage(message_.isEmpty() ? tr("no data") : message_);
    replot(rpQueuedReplot);
    return;
  }
  setLabels();
  auto* cloud = new QCPItemPixmap(this);
  cloud->setPixmap(QPixmap::fromImage(figure_->density));
  cloud->setScaled(true, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  cloud->topLeft->setCoords(figure_->x_low, figure_->y_high);
  cloud->bottomRight->setCoords(figure_->x_high, figure_->y_low);
  drawNoise();
  if (before_) drawMeans(figure_->before, colors().axis, false, 1.0);
  if (!figure_->predicted.empty()) drawMeans(figure_->predicted, colors().fit, false, scale_);
  drawMeans(figure_->now, colors().mark, true, 1.0);
  drawSelected();
  explain();
  std::vector<QStringList> rows;
  for (const ResidualBin& bin : figure_->now) {
    rows.push_back({csv_number(bin.center), csv_number(bin.residual.mean),
                    csv_number(bin.residual.sigma), QString::number(bin.residual.n),
                    bin.residual.significant ? QStringLiteral("1") : QStringLiteral("0")});
  }
  setTable({QString::fromStdString(figure_->along().name), "mean", "sigma", "n", "significant"},
           std::move(rows));
  replot(rpQueuedReplot);
}

void ResidualPlot::explain() {
  using Sign = LegendEntry::Sign;
  std::vector<LegendEntry> entries = {{Sign::kDot, figure_->dotColor(), tr("residuals")},
                                      {Sign::kMark, colors().mark, tr("means ± 2σ")},
                                      {Sign::kDot, colors().refused, tr("differ from zero")}};
  if (figure_->noise < halfHeight())
    entries.insert(entries.begin() + 1, {Sign::kDashed, colors().zero, tr("noise of one")});
  if (before_) entries.push_back({Sign::kLine, colors().axis, tr("base model")});
  if (!figure_->predicted.empty())
    entries.push_back({Sign::kLine, colors().fit, tr("chosen effect")});
  if (!selected_.empty()) entries.push_back({Sign::kDot, colors().emphasis, tr("selected")});
  showLegend(std::move(entries));
}

void ResidualPlot::setLabels() {
  const Covariate& c = figure_->along();
  xAxis->setLabel(axis_text(c.name, c.unit));
  const Channel channel = figure_->view->columns.channel;
  yAxis->setLabel(tr("residual (%1)").arg(unit_text(channel)));
  if (figure_->labels.empty()) {
    xAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
  } else {
    QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
    const std::size_t stride = 1 + figure_->labels.size() / 24;
    for (std::size_t k = 0; k < figure_->labels.size(); k += stride)
      ticker->addTick(static_cast<double>(k + 1), category_name(c.name, figure_->labels[k]));
    xAxis->setTicker(ticker);
  }
  const double half = halfHeight();
  setHome({figure_->x_low, figure_->x_high}, {-half, half});
}

void ResidualPlot::drawNoise() {
  for (const double y : {-figure_->noise, 0.0, figure_->noise}) {
    auto* line = new QCPItemStraightLine(this);
    line->point1->setCoords(figure_->x_low, y);
    line->point2->setCoords(figure_->x_high, y);
    line->setPen(QPen(colors().zero, 1.0, y == 0.0 ? Qt::SolidLine : Qt::DashLine));
  }
}

void ResidualPlot::drawMeans(const std::vector<ResidualBin>& bins, const QColor& color, bool bars,
                             double scale) {
  QVector<double> x, y, sigma, marked_x, marked_y;
  for (const ResidualBin& bin : bins) {
    if (!std::isfinite(bin.residual.mean)) continue;
    x.push_back(figure_->place(bin.center));
    y.push_back(scale * bin.residual.mean);
    sigma.push_back(kSigmas * bin.residual.sigma);
    if (bars && bin.residual.significant) {
      marked_x.push_back(x.back());
      marked_y.push_back(y.back());
    }
  }
  QCPGraph* line = addGraph();
  line->setData(x, y, true);
  line->setPen(QPen(color, bars ? 1.6 : 2.0));
  if (!figure_->labels.empty()) line->setLineStyle(QCPGraph::lsNone);
  if (bars) {
    line->setScatterStyle(
        {QCPScatterStyle::ssCircle, QPen(color, 1.4), QBrush(colors().background), 6.0});
  } else if (!figure_->labels.empty()) {
    line->setScatterStyle({QCPScatterStyle::ssDiamond, QPen(color, 2.0), Qt::NoBrush, 13.0});
  }
  if (!bars) return;
  auto* errors = new QCPErrorBars(xAxis, yAxis);
  errors->setDataPlottable(line);
  errors->setData(sigma);
  errors->setPen(QPen(color, 1.2));
  QCPGraph* marked = addGraph();
  marked->setLineStyle(QCPGraph::lsNone);
  marked->setData(marked_x, marked_y, true);
  marked->setScatterStyle(
      {QCPScatterStyle::ssCircle, QPen(colors().refused), QBrush(colors().refused), 6.5});
}

void ResidualPlot::drawSelected() {
  if (selected_.empty()) return;
  QCPGraph* graph = addGraph();
  graph->setLineStyle(QCPGraph::lsNone);
  graph->setScatterStyle(
      {QCPScatterStyle::ssDisc, QPen(colors().emphasis), QBrush(colors().emphasis), 3.0});
  const ResidualColumns& c = figure_->view->columns;
  const std::size_t stride = 1 + selected_.size() / kMostSelected;
  for (std::size_t k = 0; k < selected_.size(); k += stride) {
    const std::size_t row = selected_[k];
    graph->addData(figure_->place(static_cast<double>(figure_->along().values[row])),
                   static_cast<double>(c.value[row]));
  }
}

}  // namespace lvcalib::widgets

#include "moc_residual_plot.cpp"
