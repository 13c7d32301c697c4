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

constexpr int kGap = 1;           // empty columns between channels
constexpr double kTop = 1.2;      // Held-out errors above it are drawn there.
constexpr double kFigures = 1.4;  // Where the figures stand, in heights of the largest bar.
// Of the scale: a bar that noise alone may leave fills no more than this of it.
constexpr double kChanceHeight = 0.5;

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
  // Every channel has its own scale, told by its figures.
  yAxis->setTicks(false);
  yAxis->setTickLabels(false);
  yAxis->grid()->setVisible(false);
  follow_language(this, [this] { rebuild(); });
  connect(this, &QCustomPlot::afterLayout, this, &BudgetPlot::keepInside);
  connect(this, &PlotView::clicked, this, [this](const QPointF& place) {
    const int step = stepAt(xAxis->pixelToCoord(place.x()));
    if (step >= 0) Q_EMIT stepClicked(step);
  });
  connect(this, &QCustomPlot::mouseMove, this,
          [this](const QMouseEvent* event) { showTip(event->pos()); });
}

// The mean square of n rows is uncertain by √(2/n) of the floor's, the floor, from as many pairs of
// neighbouring rows, by as much again.
BudgetPlot::BeyondNoise BudgetPlot::beyond_noise(const ChannelSummary& now) {
  constexpr double kUpper = 1.645;
  const double n = std::max<double>(1.0, static_cast<double>(now.n));
  const double floor2 = now.noise_floor * now.noise_floor;
  return {now.unexplained, now.noise_floor * std::sqrt(kUpper * 2.0 / std::sqrt(n)),
          std::sqrt(std::max(0.0, now.heldout_rms * now.heldout_rms - floor2))};
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

void BudgetPlot::setSomethingMissing(bool something) {
  if (something == something_missing_) return;
  something_missing_ = something;
  rebuild();
}

void BudgetPlot::setTruth(const std::optional<Rigid3>& camera_from_lidar) {
  truth_ = camera_from_lidar;
  rebuild();
}

BudgetPlot::Distance BudgetPlot::toTruth(const ModelStep& step) const {
  const Rigid3& found = step.state.camera_from_lidar;
  return {1e3 * translation_distance_m(found, *truth_),
          1e3 * rotation_distance_rad(found, *truth_)};
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

void BudgetPlot::keepInside() {
  const QRect area = axisRect()->rect();
  for (QCPItemText* label : figures_) {
    const double half = 0.5 * QFontMetrics(label->font()).size(0, label->text()).width() + 2.0;
    const double wanted = xAxis->coordToPixel(label->property("place").toDouble());
    // The room on the right of the axes is the widget's own margin.
    const double right = std::max<double>(area.left() + half, width() - half);
    label->position->setCoords(xAxis->pixelToCoord(std::min(wanted, right)), kFigures);
  }
}

void BudgetPlot::rebuild() {
  figures_.clear();
  clearFigure();
  xAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTickerText));
  if (steps_.empty() || !steps_.front()) {
    showMessage(tr("The history of the error appears here."));
    replot(rpQueuedReplot);
    return;
  }
  yAxis->setLabel(tr("error beyond noise"));
  QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
  const int block = static_cast<int>(steps_.size()) + kGap;
  std::vector<QStringList> rows;
  int channel = 0;
  for (const ChannelSummary& base : steps_.front()->channels) {
    const double middle = channel * block + 0.5 * (block - kGap - 1);
    const QString unit = base.channel == Channel::kIntensity
                             ? QString()
                             : QStringLiteral(" ") + unit_text(base.channel);
    ticker->addTick(middle,
                    tr("%1 (noise %2)")
                        .arg(channel_name(base.channel), plain_number(base.noise_floor, 2) + unit));
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const ChannelSummary* c = steps_[k] ? summary_of(*steps_[k], base.channel) : nullptr;
      if (c == nullptr) continue;
      rows.push_back({QString::number(k), QString::fromLatin1(name_of(base.channel)),
                      csv_number(c->rms), csv_number(c->noise_floor), csv_number(c->unexplained),
                      csv_number(c->heldout_rms)});
    }
    drawChannel(base, channel * block);
    writeFigures(base, middle);
    ++channel;
  }
  if (truth_) {
    ticker->addTick(channel * block + 0.5 * (block - kGap - 1), tr("distance to the truth"));
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      if (!steps_[k]) continue;
      const Distance d = toTruth(*steps_[k]);
      rows.push_back({QString::number(k), "truth_mm", csv_number(d.mm), {}, {}, {}});
      rows.push_back({QString::number(k), "truth_mrad", csv_number(d.mrad), {}, {}, {}});
    }
    drawTruth(channel * block);
    ++channel;
  }
  xAxis->setTicker(ticker);
  xAxis->setTickLength(0, 0);
  setTable({"step", "channel", "rms", "noise_floor", "unexplained", "heldout_rms"},
           std::move(rows));
  setHome({-0.8, channel * block - kGap - 0.2}, {0.0, kFigures + 0.25});
  replot(rpQueuedReplot);
}

void BudgetPlot::drawChannel(const ChannelSummary& base, int first) {
  double scale = beyond_noise(base).by_chance / kChanceHeight;
  for (const ModelStepPtr& step : steps_) {
    const ChannelSummary* c = step ? summary_of(*step, base.channel) : nullptr;
    if (c != nullptr) scale = std::max(scale, c->unexplained);
  }
  if (!(scale > 0.0)) return;
  QVector<double> held_x, held_y;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (!steps_[k]) continue;
    const ChannelSummary* now = summary_of(*steps_[k], base.channel);
    if (now == nullptr) continue;
    const BeyondNoise error = beyond_noise(*now);
    const double x = first + static_cast<double>(k);
    const auto bar = [&](double from, double to, QColor color) {
      auto* rect = new QCPItemRect(this);
      rect->topLeft->setCoords(x - 0.42, to / scale);
      rect->bottomRight->setCoords(x + 0.42, from / scale);
      if (k > current_) color.setAlpha(70);
      rect->setBrush(color);
      rect->setPen(Qt::NoPen);
    };
    const bool by_chance = beyond_noise(base).is_chance();
    const double top =
        by_chance ? error.unexplained : std::max(base.unexplained, error.unexplained);
    bar(0.0, error.unexplained, is_wrong(*now, k) ? colors().refused : noiseColor(colors()));
    if (!by_chance) bar(error.unexplained, top, explainedColor(colors()));
    if (k == current_) frameStep(x, top / scale);
    held_x.push_back(x);
    held_y.push_back(std::min(error.heldout / scale, kTop));
  }
  QCPGraph* held = addGraph();
  held->setLineStyle(QCPGraph::lsNone);
  held->setData(held_x, held_y, true);
  held->setScatterStyle(
      {QCPScatterStyle::ssDiamond, QPen(colors().mark), QBrush(colors().background), 7.0});
}

// "2.9 → 0.4 mm", large: before any effect, and in the step that is shown.
void BudgetPlot::writeFigures(const ChannelSummary& base, double middle) {
  const ModelStepPtr shown = current_ < steps_.size() ? steps_[current_] : nullptr;
  const ChannelSummary* now = shown ? summary_of(*shown, base.channel) : nullptr;
  const auto figure = [](const ChannelSummary& c) {
    const BeyondNoise error = beyond_noise(c);
    return error.is_chance() ? tr("< %1").arg(plain_number(error.by_chance, 2))
                             : plain_number(error.unexplained, 2);
  };
  QString text = figure(base);
  const QString then = now != nullptr && current_ > 0 ? figure(*now) : text;
  // What noise may leave before and after is no change.
  const bool by_chance =
      now != nullptr && beyond_noise(base).is_chance() && beyond_noise(*now).is_chance();
  if (by_chance) {
    text = then;
  } else if (then != text) {
    text += QStringLiteral(" → ") + then;
  }
  if (base.channel != Channel::kIntensity) text += QStringLiteral(" ") + unit_text(base.channel);
  const bool wrong = is_wrong(now != nullptr ? *now : base, current_);
  writeFigure(middle, text, wrong ? colors().refused : colors().text);
}

void BudgetPlot::writeFigure(double middle, const QString& text, const QColor& color) {
  auto* label = new QCPItemText(this);
  label->position->setCoords(middle, kFigures);
  label->setProperty("place", middle);
  label->setClipToAxisRect(false);
  label->setText(text);
  figures_.push_back(label);
  QFont large = font();
  large.setPointSizeF(1.25 * large.pointSizeF());
  large.setBold(true);
  label->setFont(large);
  label->setColor(color);
}

// About the bars of the step that is shown.
void BudgetPlot::frameStep(double x, double top) {
  auto* frame = new QCPItemRect(this);
  frame->topLeft->setCoords(x - 0.46, std::max(top, 0.04));
  frame->bottomRight->setCoords(x + 0.46, 0.0);
  frame->setPen(QPen(colors().mark, 1.6));
}

void BudgetPlot::drawTruth(int first) {
  Distance scale;
  for (const ModelStepPtr& step : steps_) {
    if (!step) continue;
    const Distance d = toTruth(*step);
    scale = {std::max(scale.mm, d.mm), std::max(scale.mrad, d.mrad)};
  }
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (!steps_[k]) continue;
    const Distance d = toTruth(*steps_[k]);
    const double x = first + static_cast<double>(k);
    const auto bar = [&](double from, double to, double height, QColor color) {
      auto* rect = new QCPItemRect(this);
      rect->topLeft->setCoords(x + from, height);
      rect->bottomRight->setCoords(x + to, 0.0);
      if (k > current_) color.setAlpha(70);
      rect->setBrush(color);
      rect->setPen(Qt::NoPen);
    };
    const double mm = d.mm / std::max(scale.mm, 1e-12);
    const double mrad = d.mrad / std::max(scale.mrad, 1e-12);
    bar(-0.42, -0.02, mm, colors().series(0));
    bar(0.02, 0.42, mrad, colors().series(1));
    if (k == current_) frameStep(x, std::max(mm, mrad));
  }
  const ModelStepPtr shown = current_ < steps_.size() ? steps_[current_] : nullptr;
  const Distance before = toTruth(*steps_.front());
  const Distance now = shown ? toTruth(*shown) : before;
  const auto change = [&](double from, double to, const char* unit) {
    QString text = plain_number(from, 2);
    const QString then = plain_number(to, 2);
    if (current_ > 0 && then != text) text += QStringLiteral(" → ") + then;
    return text + QLatin1Char(' ') + QLatin1String(unit);
  };
  // One below the other: side by side they run into the neighbour's.
  writeFigure(
      first + 0.5 * (static_cast<double>(steps_.size()) - 1.0),
      change(before.mm, now.mm, "mm") + QLatin1Char('\n') + change(before.mrad, now.mrad, "mrad"),
      colors().text);
  figures_.back()->setFont(font());
}

void BudgetPlot::showTip(const QPoint& place) {
  const double x = xAxis->pixelToCoord(place.x());
  const int step = stepAt(x);
  if (step < 0) {
    setToolTip(
        tr("Error beyond the noise, every channel on its own scale: red unexplained, green "
           "explained by effects, grey what noise alone may leave; diamonds: scenes held out. "
           "Click to go to a step."));
    return;
  }
  const int block = static_cast<int>(steps_.size()) + kGap;
  const auto channel = static_cast<std::size_t>(std::lround(x)) / static_cast<std::size_t>(block);
  const ModelStep& shown = *steps_[static_cast<std::size_t>(step)];
  if (channel == steps_.front()->channels.size() && truth_) {
    const Distance d = toTruth(shown);
    setToolTip(tr("Step %1, %2: %3 mm (left bar) and %4 mrad (right bar) from the truth")
                   .arg(step)
                   .arg(step_text(shown))
                   .arg(plain_number(d.mm))
                   .arg(plain_number(d.mrad)));
  }
  if (channel >= steps_.front()->channels.size()) return;
  const ChannelSummary* c = summary_of(shown, steps_.front()->channels[channel].channel);
  if (c == nullptr) return;
  setToolTip(tr("Step %1, %2: %3\nRMS %4, noise %5, unexplained %6, held out %7 (%8)")
                 .arg(step)
                 .arg(step_text(shown), channel_name(c->channel))
                 .arg(plain_number(c->rms))
                 .arg(plain_number(c->noise_floor))
                 .arg(plain_number(c->unexplained))
                 .arg(plain_number(c->heldout_rms))
                 .arg(unit_text(c->channel)));
}

}  // namespace lvcalib::widgets

#include "moc_budget_plot.cpp"
