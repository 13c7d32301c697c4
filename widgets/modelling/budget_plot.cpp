// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/budget_plot.h"

#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <utility>

#include "modelling/model_text.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

constexpr int kGap = 1;  // empty columns between channels

const ChannelSummary* summary_of(const ModelStep& step, Channel channel) {
  for (const ChannelSummary& c : step.channels) {
    if (c.channel == channel) return &c;
  }
  return nullptr;
}

}  // namespace

BudgetPlot::BudgetPlot(QWidget* parent) : PlotView(parent) {
  setObjectName(QStringLiteral("budget_plot"));
  figureActions()->setName(QStringLiteral("error-history"));
  setInteractions({});
  setMouseTracking(true);
  xAxis->grid()->setVisible(false);
  xAxis->setSubTicks(false);
  yAxis->setSubTicks(false);
  yAxis->ticker()->setTickCount(3);
  follow_language(this, [this] { rebuild(); });
  connect(this, &PlotView::clicked, this, [this](const QPointF& place) {
    const int step = stepAt(xAxis->pixelToCoord(place.x()));
    if (step >= 0) Q_EMIT stepClicked(step);
  });
  connect(this, &QCustomPlot::mouseMove, this,
          [this](const QMouseEvent* event) { showTip(event->pos()); });
}

BudgetPlot::Shares BudgetPlot::shares(const ChannelSummary& base, const ChannelSummary& now) {
  Shares out;
  const double whole = base.rms * base.rms;
  if (!(whole > 0.0)) return out;
  out.floor = std::min(1.0, now.noise_floor * now.noise_floor / whole);
  out.unexplained = now.unexplained * now.unexplained / whole;
  out.explained = std::max(0.0, 1.0 - out.floor - out.unexplained);
  out.heldout = now.heldout_rms * now.heldout_rms / whole;
  return out;
}

QColor BudgetPlot::noiseColor(const PlotColors& colors) {
  return colors.dark ? QColor(105, 110, 116) : QColor(190, 193, 197);
}

QColor BudgetPlot::explainedColor(const PlotColors& colors) {
  return QColor::fromHsl(140, 110, colors.dark ? 110 : 150);
}

void BudgetPlot::setSteps(std::vector<ModelStepPtr> steps, std::size_t current) {
  steps_ = std::move(steps);
  current_ = current;
  rebuild();
}

// Columns: the steps of the first channel, a gap, those of the next one, …
int BudgetPlot::stepAt(double x) const {
  const int block = static_cast<int>(steps_.size()) + kGap;
  const int column = static_cast<int>(std::lround(x));
  if (steps_.empty() || column < 0) return -1;
  const int step = column % block;
  return step < static_cast<int>(steps_.size()) && steps_[static_cast<std::size_t>(step)] ? step
                                                                                          : -1;
}

void BudgetPlot::rebuild() {
  clearFigure();
  xAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTickerText));
  if (steps_.empty() || !steps_.front()) {
    showMessage(tr("The history of the error appears here."));
    replot(rpQueuedReplot);
    return;
  }
  yAxis->setLabel(tr("squared error (%)"));
  QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
  const int block = static_cast<int>(steps_.size()) + kGap;
  std::vector<QStringList> rows;
  double top = 1.0;
  int channel = 0;
  for (const ChannelSummary& base : steps_.front()->channels) {
    const ModelStepPtr shown = current_ < steps_.size() ? steps_[current_] : nullptr;
    const ChannelSummary* now = shown ? summary_of(*shown, base.channel) : nullptr;
    QString label = channel_name(base.channel);
    if (now != nullptr) {
      label += QStringLiteral(" %1 → %2 %3")
                   .arg(base.rms, 0, 'g', 3)
                   .arg(now->rms, 0, 'g', 3)
                   .arg(base.channel == Channel::kIntensity ? QString() : unit_text(base.channel));
    }
    ticker->addTick(channel * block + 0.5 * (block - kGap - 1), label.trimmed());
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const ChannelSummary* c = steps_[k] ? summary_of(*steps_[k], base.channel) : nullptr;
      if (c == nullptr) continue;
      const Shares s = shares(base, *c);
      top = std::max({top, s.floor + s.explained + s.unexplained, std::min(s.heldout, 1.5)});
      rows.push_back({QString::number(k), QString::fromLatin1(name_of(base.channel)),
                      csv_number(c->rms), csv_number(c->noise_floor), csv_number(c->unexplained),
                      csv_number(c->heldout_rms)});
    }
    drawChannel(channel, channel * block);
    ++channel;
  }
  xAxis->setTicker(ticker);
  xAxis->setTickLength(0, 0);
  setTable({"step", "channel", "rms", "noise_floor", "unexplained", "heldout_rms"},
           std::move(rows));
  setHome({-0.8, channel * block - kGap - 0.2}, {0.0, 106.0 * top});
  replot(rpQueuedReplot);
}

void BudgetPlot::drawChannel(int channel, int first) {
  const ChannelSummary& base = steps_.front()->channels[static_cast<std::size_t>(channel)];
  const QColor parts[] = {noiseColor(colors()), colors().refused, explainedColor(colors())};
  QVector<double> held_x, held_y;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (!steps_[k]) continue;
    const ChannelSummary* now = summary_of(*steps_[k], base.channel);
    if (now == nullptr) continue;
    const Shares s = shares(base, *now);
    const double x = first + static_cast<double>(k);
    const double values[] = {s.floor, s.unexplained, s.explained};
    double y = 0.0;
    for (int part = 0; part < 3; ++part) {
      auto* rect = new QCPItemRect(this);
      rect->topLeft->setCoords(x - 0.42, 100.0 * (y + values[part]));
      rect->bottomRight->setCoords(x + 0.42, 100.0 * y);
      QColor color = parts[part];
      if (k > current_) color.setAlpha(70);
      rect->setBrush(color);
      rect->setPen(Qt::NoPen);
      y += values[part];
    }
    if (k == current_) {
      auto* frame = new QCPItemRect(this);
      frame->topLeft->setCoords(x - 0.46, 100.0 * y);
      frame->bottomRight->setCoords(x + 0.46, 0.0);
      frame->setPen(QPen(colors().mark, 1.6));
    }
    if (s.heldout > 0.0) {
      held_x.push_back(x);
      held_y.push_back(100.0 * std::min(s.heldout, 1.5));
    }
  }
  QCPGraph* held = addGraph();
  held->setLineStyle(QCPGraph::lsNone);
  held->setData(held_x, held_y, true);
  held->setScatterStyle(
      {QCPScatterStyle::ssDiamond, QPen(colors().mark), QBrush(colors().background), 7.0});
}

void BudgetPlot::showTip(const QPoint& place) {
  const double x = xAxis->pixelToCoord(place.x());
  const int step = stepAt(x);
  if (step < 0) {
    setToolTip(
        tr("Squared error by the base model's: grey noise, red unexplained, green explained "
           "by effects; diamonds: scenes held out. Click to go to a step."));
    return;
  }
  const int block = static_cast<int>(steps_.size()) + kGap;
  const auto channel = static_cast<std::size_t>(std::lround(x)) / static_cast<std::size_t>(block);
  const ModelStep& shown = *steps_[static_cast<std::size_t>(step)];
  if (channel >= steps_.front()->channels.size()) return;
  const ChannelSummary* c = summary_of(shown, steps_.front()->channels[channel].channel);
  if (c == nullptr) return;
  setToolTip(tr("Step %1, %2: %3\nRMS %4, noise %5, unexplained %6, held out %7 (%8)")
                 .arg(step)
                 .arg(step_text(shown), channel_name(c->channel))
                 .arg(c->rms, 0, 'g', 3)
                 .arg(c->noise_floor, 0, 'g', 3)
                 .arg(c->unexplained, 0, 'g', 3)
                 .arg(c->heldout_rms, 0, 'g', 3)
                 .arg(unit_text(c->channel)));
}

}  // namespace lvcalib::widgets
