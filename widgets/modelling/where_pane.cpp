// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/where_pane.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QTabWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "modelling/board_intensity_view.h"
#include "modelling/model_text.h"
#include "modelling/residual_map_plot.h"
#include "modelling/residual_plot.h"
#include "style/texts.h"
#include "views/tool_row.h"

namespace lvcalib::widgets {

WherePane::WherePane(FigureSource& source, QWidget* parent) : QWidget(parent), source_(source) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  createBar();
  createFigures();
  layout->addWidget(tabs_, 1);
  connect(&source_, &FigureSource::figureReady, this,
          [this](const std::shared_ptr<const ResidualFigure>& figure) { showFigure(figure, {}); });
  connect(&source_, &FigureSource::boardReady, this,
          [this](const std::shared_ptr<const BoardIntensity>& board) { board_->setImages(board); });
  follow_language(this, [this] { retranslate(); });
  setStep(nullptr, {});
}

WherePane::~WherePane() {
  for (QObject* part : std::initializer_list<QObject*>{tabs_, channels_, covariates_, scenes_})
    part->disconnect(this);  // They change while they go.
}

// In two lines where one is too short: what is chosen is read in full.
void WherePane::createBar() {
  auto* bar = new ToolRow(this);
  const auto named_box = [&](QLabel*& label, QComboBox*& box, const char* name) {
    auto* both = new QWidget(bar);
    auto* row = new QHBoxLayout(both);
    row->setContentsMargins(0, 0, 3, 0);
    label = new QLabel(both);
    box = new QComboBox(both);
    box->setObjectName(QString::fromLatin1(name));
    box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    label->setBuddy(box);
    row->addWidget(label);
    row->addWidget(box);
    bar->addWidget(both);
  };
  named_box(channel_label_, channels_, "channel");
  named_box(covariate_label_, covariates_, "covariate");
  brush_ = new QToolButton(bar);
  brush_->setObjectName(QStringLiteral("brush"));
  brush_->setCheckable(true);
  before_ = new QToolButton(bar);
  before_->setObjectName(QStringLiteral("before"));
  before_->setCheckable(true);
  before_->setChecked(true);
  bar->addWidget(before_);
  bar->addWidget(brush_);
  exclude_ = new QToolButton(bar);
  exclude_->setObjectName(QStringLiteral("where-exclude"));
  exclude_->hide();
  bar->addWidget(exclude_);
  connect(exclude_, &QToolButton::clicked, this, [this] {
    Q_EMIT excludeWanted();
    brush_->setChecked(false);
  });
  static_cast<QVBoxLayout*>(layout())->addWidget(bar);
  connect(channels_, &QComboBox::currentIndexChanged, this, [this] {
    fillCovariates();
    Q_EMIT turned();
    ask();
    showAwaited();
  });
  connect(covariates_, &QComboBox::currentIndexChanged, this, [this] {
    Q_EMIT turned();
    ask();
  });
}

void WherePane::createFigures() {
  tabs_ = new QTabWidget(this);
  tabs_->setObjectName(QStringLiteral("where_tabs"));
  tabs_->setDocumentMode(true);
  plot_ = new ResidualPlot(tabs_);
  tabs_->addTab(plot_, {});
  const ResidualMapPlot::Plane planes[] = {ResidualMapPlot::Plane::kImage,
                                           ResidualMapPlot::Plane::kBoard,
                                           ResidualMapPlot::Plane::kAngles};
  for (int k = 0; k < 3; ++k) {
    maps_[k] = new ResidualMapPlot(planes[k], tabs_);
    tabs_->addTab(maps_[k], {});
    connect(maps_[k], &ResidualMapPlot::brushed, this, [this, k](const QRectF& area) {
      brush(QString::fromLatin1(maps_[k]->xName()), QString::fromLatin1(maps_[k]->yName()), area);
    });
    connect(maps_[k]->figureActions(), &FigureActions::failed, this, &WherePane::failed);
  }
  board_page_ = new QWidget(tabs_);
  auto* column = new QVBoxLayout(board_page_);
  column->setContentsMargins(0, 4, 0, 0);
  auto* bar = new QHBoxLayout;
  scenes_ = new QComboBox(board_page_);
  scenes_->setObjectName(QStringLiteral("board_scene"));
  scenes_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  flicker_ = new QToolButton(board_page_);
  flicker_->setObjectName(QStringLiteral("flicker"));
  flicker_->setCheckable(true);
  bar->addWidget(scenes_);
  bar->addWidget(flicker_);
  bar->addStretch();
  column->addLayout(bar);
  board_ = new BoardIntensityView(board_page_);
  column->addWidget(board_, 1);
  tabs_->addTab(board_page_, {});
  connect(flicker_, &QToolButton::toggled, board_, &BoardIntensityView::setFlicker);
  connect(scenes_, &QComboBox::currentIndexChanged, this, &WherePane::askBoard);
  connect(tabs_, &QTabWidget::currentChanged, this, &WherePane::askBoard);
  connect(before_, &QToolButton::toggled, plot_, &ResidualPlot::setBeforeShown);
  connect(brush_, &QToolButton::toggled, this, [this](bool on) {
    plot_->setBrushing(on);
    for (ResidualMapPlot* map : maps_) map->setBrushing(on);
    if (!on) select({});
  });
  connect(plot_, &ResidualPlot::brushed, this,
          [this](const QRectF& area) { brush(covariate(), {}, area); });
  connect(plot_->figureActions(), &FigureActions::failed, this, &WherePane::failed);
  connect(board_->figureActions(), &FigureActions::failed, this, &WherePane::failed);
}

Channel WherePane::channel() const {
  return static_cast<Channel>(channels_->currentData().toInt());
}

QString WherePane::covariate() const {
  return covariates_->currentData().toString();
}

void WherePane::setStep(const ModelStepPtr& step, const QString& reason) {
  // Figures of another step are on their way: what is shown has rows of another table.
  if (step != step_ && !exclude_->isHidden()) select({});
  outdated_ = outdated_ || step != step_;
  step_ = step;
  fillChannels();
  fillCovariates();
  fillScenes();
  if (step_) {
    ask();
    showAwaited();
    askBoard();
  } else {
    showFigure(nullptr, reason);
    board_->setImages(nullptr, reason);
  }
}

// Keeps the channel looked at; at first the one with the strongest structure.
void WherePane::fillChannels() {
  const QSignalBlocker quiet(channels_);
  const QVariant before = channels_->currentData();
  channels_->clear();
  channels_->setEnabled(step_ != nullptr);
  if (!step_) return;
  for (const ChannelSummary& c : step_->channels)
    channels_->addItem(channel_name(c.channel), static_cast<int>(c.channel));
  int index = before.isValid() ? channels_->findData(before) : -1;
  if (index < 0 && !step_->structure.empty())
    index = channels_->findData(static_cast<int>(step_->structure.front().channel));
  channels_->setCurrentIndex(std::max(0, index));
}

void WherePane::fillCovariates() {
  const QSignalBlocker quiet(covariates_);
  const bool same = covariates_->property("channel") == channels_->currentData();
  const QVariant before = same ? covariates_->currentData() : QVariant();
  covariates_->clear();
  covariates_->setEnabled(step_ != nullptr);
  covariates_->setProperty("channel", channels_->currentData());
  if (!step_) return;
  for (const StructureScore& s : step_->structure) {
    if (s.channel != channel()) continue;
    QString text = covariate_name(s.covariate);
    if (s.score > 0.0005) text += QStringLiteral("  %1 %").arg(100.0 * s.score, 0, 'f', 1);
    covariates_->addItem(text, QString::fromStdString(s.covariate));
  }
  const int index = before.isValid() ? covariates_->findData(before) : -1;
  covariates_->setCurrentIndex(std::max(0, index));
}

void WherePane::fillScenes() {
  const QSignalBlocker quiet(scenes_);
  const int before = scenes_->currentIndex();
  scenes_->clear();
  if (!step_) return;
  scenes_->addItem(tr("all scenes"), -1);
  for (std::size_t s = 0; s < step_->table().scenes.size(); ++s)
    scenes_->addItem(QString::fromStdString(step_->table().scenes[s].name), static_cast<int>(s));
  scenes_->setCurrentIndex(std::clamp(before, 0, scenes_->count() - 1));
}

void WherePane::look(Channel channel, const QString& covariate) {
  if (!step_) return;
  {
    const QSignalBlocker quiet(channels_);
    channels_->setCurrentIndex(std::max(0, channels_->findData(static_cast<int>(channel))));
  }
  fillCovariates();
  {
    const QSignalBlocker quiet(covariates_);
    covariates_->setCurrentIndex(std::max(0, covariates_->findData(covariate)));
  }
  tabs_->setCurrentWidget(plot_);
  ask();
  showAwaited();
}

void WherePane::setOverlay(const std::optional<EffectInUse>& effect, double scale) {
  effect_ = effect;
  scale_ = scale;
  ask();
}

void WherePane::setOverlayScale(double scale) {
  scale_ = scale;
  plot_->setOverlayScale(scale);
}

void WherePane::ask() {
  if (step_ && covariates_->currentIndex() >= 0) source_.request(channel(), covariate(), effect_);
}

// Another channel's residuals are on their way: those of the one before say nothing of it.
void WherePane::showAwaited() {
  if (!step_ || covariates_->currentIndex() < 0) return;
  if (figure_ && figure_->view->columns.channel == channel()) return;
  showFigure(nullptr, tr("the residuals are being collected …"));
}

void WherePane::askBoard() {
  if (!step_ || tabs_->currentWidget() != board_page_) return;
  if (!step_->table().has_intensity) {
    board_->setImages(nullptr, tr("no intensity in these clouds"));
    return;
  }
  source_.requestBoard(scenes_->currentData().toInt());
}

// Without one the message stands in its place.
void WherePane::showFigure(const std::shared_ptr<const ResidualFigure>& figure,
                           const QString& message) {
  // What is selected is forgotten with the residuals that it was selected of.
  const bool others = !figure || !figure_ || figure->view != figure_->view;
  if (others && !exclude_->isHidden()) select({});
  outdated_ = false;
  figure_ = figure;
  plot_->setOverlayScale(scale_);
  plot_->setFigure(figure, message);
  for (ResidualMapPlot* map : maps_) map->setView(figure ? figure->view : nullptr, message);
}

// Rows whose covariates lie in the area; without `y` it is the residual itself.
void WherePane::brush(const QString& x, const QString& y, const QRectF& area) {
  if (!figure_ || outdated_) return;
  const ResidualColumns& c = figure_->view->columns;
  const Covariate* cx = c.find(x.toStdString());
  const Covariate* cy = y.isEmpty() ? nullptr : c.find(y.toStdString());
  if (cx == nullptr) return;
  const bool on_plot = y.isEmpty();
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const double px = on_plot ? figure_->place(static_cast<double>(cx->values[k]))
                              : static_cast<double>(cx->values[k]);
    const double py =
        cy != nullptr ? static_cast<double>(cy->values[k]) : static_cast<double>(c.value[k]);
    if (px >= area.left() && px <= area.right() && py >= area.top() && py <= area.bottom())
      rows.push_back(k);
  }
  select(std::move(rows));
}

void WherePane::select(std::vector<std::size_t> rows) {
  exclude_->setVisible(!rows.empty());
  plot_->setSelected(rows);
  for (ResidualMapPlot* map : maps_) map->setSelected(rows);
  std::vector<SelectedSample> samples;
  if (figure_ && step_) {
    const ResidualColumns& c = figure_->view->columns;
    const MeasurementTable& table = step_->table();
    samples.reserve(rows.size());
    for (const std::size_t k : rows) {
      SelectedSample sample{c.scene[k], {}, {}};
      const auto at = [&](const BeamPoint& beam, double range) {
        sample.point_in_lidar_m = range * beam.direction;
      };
      switch (c.channel) {
        case Channel::kCorner:
          sample.pixel = table.corner[c.row[k]].pixel;
          break;
        case Channel::kRange:
          at(table.range[c.row[k]].beam, table.range[c.row[k]].measured_m);
          break;
        case Channel::kBoundary:
          at(table.boundary[c.row[k]].beam, table.boundary[c.row[k]].beam.range_m);
          break;
        case Channel::kIntensity:
          at(table.intensity[c.row[k]].beam, table.intensity[c.row[k]].beam.range_m);
          break;
      }
      samples.push_back(sample);
    }
  }
  Q_EMIT selected(samples);
}

void WherePane::retranslate() {
  channel_label_->setText(tr("&Channel"));
  covariate_label_->setText(tr("a&gainst"));
  covariates_->setToolTip(tr(
      "What the residuals may depend on, best first. The percentage is the share of the variance "
      "in scenes held out that a smooth curve of it explains."));
  brush_->setText(tr("Brush"));
  brush_->setToolTip(
      tr("Dragging selects measurements, in all figures and in cloud and image of their scene"));
  exclude_->setText(tr("Exclude these"));
  exclude_->setToolTip(
      tr("Leave out what is selected, in every scene, and solve again; of corners their tags"));
  before_->setText(tr("Before"));
  before_->setToolTip(tr("Show the means of the base model in grey"));
  flicker_->setText(tr("Flicker"));
  flicker_->setToolTip(tr("Show measured and predicted in turns at the same place"));
  const QString names[] = {tr("Residuals"), tr("Image"), tr("Board"), tr("Directions"),
                           tr("Board intensity")};
  for (int k = 0; k < tabs_->count(); ++k) tabs_->setTabText(k, names[k]);
  fillChannels();
  fillCovariates();
  fillScenes();
}

}  // namespace lvcalib::widgets

#include "moc_where_pane.cpp"
