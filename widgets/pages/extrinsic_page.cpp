// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/extrinsic_page.h"

#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QTabWidget>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <set>

#include "pages/colors_pane.h"
#include "pages/methods_pane.h"
#include "pages/pose_text.h"
#include "pages/scene_overlay.h"
#include "pages/threshold_pane.h"
#include "pages/uncertainty_pane.h"
#include "pages/world_pane.h"
#include "style/texts.h"
#include "style/unseen.h"
#include "views/category_plots.h"
#include "views/figure_actions.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// Lengths of residuals as a box, with those that are refused beside it.
BoxPlot::Box corner_box(const QString& name, const SceneSolution* solution) {
  BoxPlot::Box out{name, {}};
  if (solution == nullptr) return out;
  for (const CornerResidual& r : solution->corners)
    (r.used ? out.values : out.refused).push_back(r.residual_px.norm());
  return out;
}

BoxPlot::Box node_box(const QString& name, const SceneSolution* solution) {
  BoxPlot::Box out{name, {}};
  if (solution == nullptr) return out;
  for (const NodeResidual& r : solution->nodes)
    (r.used ? out.values : out.refused).push_back(1e3 * r.residual_m.norm());
  return out;
}

}  // namespace

ExtrinsicPage::ExtrinsicPage(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  auto* splitter = new QSplitter(Qt::Horizontal, this);
  splitter->setChildrenCollapsible(false);
  pose_ = new QTextBrowser(splitter);
  pose_->setObjectName("pose");
  pose_->setMinimumWidth(280);
  tabs_ = new QTabWidget(splitter);
  tabs_->setDocumentMode(true);
  tabs_->addTab(createPlots(), {});
  thresholds_ = new ThresholdPane(tabs_);
  connect(thresholds_, &ThresholdPane::failed, this, &ExtrinsicPage::failed);
  methods_ = new MethodsPane(tabs_);
  connect(methods_, &MethodsPane::failed, this, &ExtrinsicPage::failed);
  tabs_->addTab(methods_, {});
  uncertainty_ = new UncertaintyPane(tabs_);
  connect(uncertainty_, &UncertaintyPane::failed, this, &ExtrinsicPage::failed);
  tabs_->addTab(uncertainty_, {});
  tabs_->addTab(thresholds_, {});
  world_ = new WorldPane(tabs_);
  connect(world_, &WorldPane::sceneActivated, this, &ExtrinsicPage::activate);
  connect(world_, &WorldPane::failed, this, &ExtrinsicPage::failed);
  tabs_->addTab(world_, {});
  colors_ = new ColorsPane(tabs_);
  connect(colors_, &ColorsPane::failed, this, &ExtrinsicPage::failed);
  tabs_->addTab(colors_, {});
  splitter->addWidget(pose_);
  splitter->addWidget(tabs_);
  splitter->setStretchFactor(0, 0);
  splitter->setStretchFactor(1, 1);
  splitter->setSizes({400, 1000});
  layout->addWidget(splitter);
  follow_language(this, [this] { retranslate(); });
}

ExtrinsicPage::~ExtrinsicPage() = default;

QWidget* ExtrinsicPage::createPlots() {
  auto* page = new QWidget(tabs_);
  auto* grid = new QGridLayout(page);
  grid->setContentsMargins(0, 4, 0, 0);
  grid->setSpacing(4);
  bars_px_ = new BarPlot(page);
  bars_mm_ = new BarPlot(page);
  boxes_px_ = new BoxPlot(page);
  boxes_mm_ = new BoxPlot(page);
  influence_mm_ = new BarPlot(page);
  influence_mrad_ = new BarPlot(page);
  CategoryPlot* plots[] = {bars_px_,  bars_mm_,      boxes_px_,
                           boxes_mm_, influence_mm_, influence_mrad_};
  for (int k = 0; k < 6; ++k) {
    grid->addWidget(plots[k], k / 2, k % 2);
    grid->setRowStretch(k / 2, 1);
    watch(plots[k]);
  }
  without_ = new QLabel(page);
  without_->setObjectName("without-scenes");
  without_->setWordWrap(true);
  without_->setTextFormat(Qt::PlainText);
  reject_ = new QPushButton(page);
  reject_->setObjectName("reject-beyond");
  back_ = new QPushButton(page);
  back_->setObjectName("drop-threshold");
  auto* row = new QHBoxLayout;
  row->addWidget(without_, 1);
  row->addWidget(back_);
  row->addWidget(reject_);
  grid->addLayout(row, 3, 0, 1, 2);
  for (BarPlot* bars : {bars_px_, bars_mm_}) {
    bars->setThresholdShown(true);
    connect(bars, &BarPlot::thresholdMoved, this, &ExtrinsicPage::takeThresholds);
  }
  connect(reject_, &QPushButton::clicked, this, [this] { Q_EMIT rejectWanted(scenesBeyond()); });
  connect(back_, &QPushButton::clicked, this, [this] {
    for (BarPlot* bars : {bars_px_, bars_mm_}) bars->setThreshold(std::nullopt);
    takeThresholds();
  });
  return page;
}

void ExtrinsicPage::retranslate() {
  pose_->setAccessibleName(tr("Pose and quality"));
  const QStringList titles = {tr("Residuals"),  tr("Methods"),    tr("Uncertainty"),
                              tr("Thresholds"), tr("All scenes"), tr("Colours")};
  for (int k = 0; k < titles.size(); ++k) tabs_->setTabText(k, titles[k]);
  tabs_->setTabToolTip(0, tr("Residuals and influence of every scene"));
  tabs_->setTabToolTip(5, tr("The cloud in the camera's colours"));
  reject_->setText(tr("Leave these scenes out"));
  back_->setText(tr("Back"));
  bars_px_->setValueLabel(tr("corner RMS (px)"), "rms_px");
  bars_mm_->setValueLabel(tr("LiDAR RMS (mm)"), "rms_mm");
  boxes_px_->setValueLabel(tr("corner residual (px)"), "residual_px");
  boxes_mm_->setValueLabel(tr("node residual (mm)"), "residual_mm");
  influence_mm_->setValueLabel(tr("moves without it (mm)"), "influence_mm");
  influence_mrad_->setValueLabel(tr("turns without it (mrad)"), "influence_mrad");
  bars_px_->setToolTip(
      tr("Root mean square of the tag corners' reprojection residuals, per scene "
         "(px). Pale: not used. Click: go to the scene."));
  bars_mm_->setToolTip(
      tr("Root mean square of the refined LiDAR nodes against the board's model, "
         "per scene (mm); without circles, of the plane's height"));
  boxes_px_->setToolTip(
      tr("Lengths of the corner residuals per scene (px): median, quartiles, "
         "whiskers to 1.5 box lengths, circles beyond; red crosses: left out (triangles: higher "
         "than drawn)"));
  boxes_mm_->setToolTip(
      tr("Lengths of the node residuals per scene (mm): median, quartiles, "
         "whiskers to 1.5 box lengths, circles beyond; red crosses: left out (triangles: higher "
         "than drawn)"));
  influence_mm_->setToolTip(tr("How far the LiDAR's origin moves when the scene is left out (mm)"));
  influence_mrad_->setToolTip(tr("How far the extrinsic turns when the scene is left out (mrad)"));
  stale_ = unseen(*this);
  if (!stale_) setResult(result_);
}

void ExtrinsicPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) setResult(result_);
}

// Names of the scenes in use that rise above either line.
QStringList ExtrinsicPage::scenesBeyond() const {
  std::set<int> beyond;
  for (const BarPlot* bars : {bars_px_, bars_mm_}) {
    for (const int k : bars->beyond()) beyond.insert(k);
  }
  QStringList names;
  for (const int k : beyond)
    names << QString::fromStdString(result_->scenes[static_cast<std::size_t>(k)].name);
  return names;
}

void ExtrinsicPage::takeThresholds() {
  const QStringList names = result_ ? scenesBeyond() : QStringList();
  const bool moved = bars_px_->threshold() || bars_mm_->threshold();
  const auto left =
      result_ ? std::count_if(result_->scenes.begin(), result_->scenes.end(),
                              [&](const SceneResult& scene) {
                                return scene.used &&
                                       !names.contains(QString::fromStdString(scene.name));
                              })
              : 0;
  reject_->setEnabled(!names.isEmpty() && left > 0);
  back_->setEnabled(moved);
  if (names.isEmpty()) {
    without_->setText(
        tr("Drag the dashed line down over the bars to see what the extrinsic would be without the "
           "scenes above it."));
    Q_EMIT scenesPreviewDropped();
    return;
  }
  if (left == 0) {
    without_->setText(
        tr("Too few: no scene would be left below the line. Drag it up to keep one or more."));
    Q_EMIT scenesPreviewDropped();
    return;
  }
  without_->setText(tr("Solving without %1 …").arg(names.join(QStringLiteral(", "))));
  Q_EMIT scenesPreviewWanted(names);
}

void ExtrinsicPage::setScenesPreview(const CalibrationResult& present,
                                     const CalibrationResult& preview) {
  without_->setText(tr("Without %1:").arg(scenesBeyond().join(QStringLiteral(", "))) +
                    QLatin1Char(' ') + ThresholdPane::moveText(present, preview));
}

void ExtrinsicPage::setScenesError(const Error& error) {
  // What the other scenes cannot be solved for cannot be left out either.
  reject_->setEnabled(false);
  without_->setText(tr("Without %1 there is no result: %2")
                        .arg(scenesBeyond().join(QStringLiteral(", ")), core_text(error.message)));
}

void ExtrinsicPage::watch(CategoryPlot* plot) {
  connect(plot, &CategoryPlot::categoryClicked, this, &ExtrinsicPage::activate);
  connect(plot->figureActions(), &FigureActions::failed, this, &ExtrinsicPage::failed);
}

void ExtrinsicPage::activate(int index) {
  if (result_ && index < static_cast<int>(result_->scenes.size())) Q_EMIT sceneActivated(index);
}

void ExtrinsicPage::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  stale_ = unseen(*this);
  if (stale_) return;
  fillTexts();
  methods_->setResult(result_.get());
  uncertainty_->setResult(result_.get());
  thresholds_->setResult(result_);
  world_->setResult(result_);
  fillPlots();
  fillInfluence();
  takeThresholds();
  colors_->setResult(result_);
}

void ExtrinsicPage::setStanding(const Standing& standing) {
  if (standing == standing_) return;
  standing_ = standing;
  if (!stale_) fillTexts();
}

void ExtrinsicPage::setSceneData(int scene, std::shared_ptr<const Cloud> full_cloud, QImage image) {
  world_->setScan(full_cloud);
  colors_->setSceneData(scene, std::move(full_cloud), std::move(image));
}

void ExtrinsicPage::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) fillTexts();
}

void ExtrinsicPage::fillTexts() {
  pose_->setHtml(result_ ? pose_html(*result_, standing_, palette())
                         : "<p>" + tr("Run the calibration to see its result.") + "</p>");
  uncertainty_->setText(result_.get());
}

// One column per scene of the result in every plot, so that a column names its scene.
void ExtrinsicPage::fillPlots() {
  std::vector<BarPlot::Bar> px;
  std::vector<BarPlot::Bar> mm;
  std::vector<BoxPlot::Box> px_boxes;
  std::vector<BoxPlot::Box> mm_boxes;
  if (result_) {
    for (const SceneResult& scene : result_->scenes) {
      const QString name = QString::fromStdString(scene.name);
      const SceneSolution* solution = solution_of(*result_, scene.name);
      const double nothing = std::numeric_limits<double>::quiet_NaN();
      px.push_back({name, solution != nullptr ? solution->rms_px : nothing, scene.used});
      mm.push_back({name, solution != nullptr ? solution->rms_mm : nothing, scene.used});
      px_boxes.push_back(corner_box(name, solution));
      mm_boxes.push_back(node_box(name, solution));
    }
  }
  bars_px_->setBars(std::move(px));
  bars_mm_->setBars(std::move(mm));
  boxes_px_->setBoxes(std::move(px_boxes));
  const bool no_nodes = result_ && !result_->target.has_circles();
  boxes_mm_->setBoxes(std::move(mm_boxes), no_nodes ? tr("this board has no circles") : QString());
}

void ExtrinsicPage::fillInfluence() {
  std::vector<BarPlot::Bar> mm;
  std::vector<BarPlot::Bar> mrad;
  QString message;
  if (result_) {
    for (const SceneResult& scene : result_->scenes) {
      const auto& all = result_->extrinsic.leave_one_out;
      const auto found = std::find_if(
          all.begin(), all.end(), [&](const LeaveOneOut& l) { return l.without == scene.name; });
      const bool known = found != all.end();
      const double nothing = std::numeric_limits<double>::quiet_NaN();
      const QString name = QString::fromStdString(scene.name);
      mm.push_back({name, known ? found->translation_mm : nothing, scene.used});
      mrad.push_back({name, known ? found->rotation_mrad : nothing, scene.used});
    }
    if (result_->extrinsic.leave_one_out.empty()) message = tr("needs three used scenes or more");
  }
  influence_mm_->setBars(std::move(mm), message);
  influence_mrad_->setBars(std::move(mrad), message);
}

}  // namespace lvcalib::widgets

#include "moc_extrinsic_page.cpp"
