// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/refinement_page.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QItemSelection>
#include <QLabel>
#include <QShortcut>
#include <QSlider>
#include <QSplitter>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "pipeline/refusals.h"
#include "refinement/node_fit.h"
#include "style/texts.h"
#include "style/theme.h"
#include "style/unseen.h"
#include "views/angle_distance_plot.h"
#include "views/board_map_plot.h"
#include "views/convergence_plot.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr int kReplayStep_ms = 350;

}  // namespace

RefinementPage::RefinementPage(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  auto* splitter = new QSplitter(Qt::Horizontal, this);
  splitter->setChildrenCollapsible(false);
  grid_ = new QWidget(splitter);
  grid_layout_ = new QGridLayout(grid_);
  grid_layout_->setContentsMargins(0, 0, 0, 0);
  grid_layout_->setSpacing(3);
  notice_ = new QLabel(grid_);
  notice_->setObjectName("refinement-notice");
  notice_->setAlignment(Qt::AlignCenter);
  notice_->setWordWrap(true);
  grid_layout_->addWidget(notice_, 0, 0);
  splitter->addWidget(grid_);
  splitter->addWidget(createDetail());
  splitter->setStretchFactor(0, 5);
  splitter->setStretchFactor(1, 4);
  splitter->setSizes({1000, 800});
  layout->addWidget(splitter, 1);
  layout->addWidget(createReplay());
  player_.setInterval(kReplayStep_ms);
  connect(&player_, &QTimer::timeout, this, &RefinementPage::advance);
  setTarget(Target());
  follow_language(this, [this] { retranslate(); });
}

void RefinementPage::retranslate() {
  bins_->setHorizontalHeaderLabels(
      {tr("Angle (°)"), tr("Midpoint (mm)"), tr("σ (mm)"), tr("Samples"), tr("State")});
  bins_->setAccessibleName(tr("Angular bins of the chosen node"));
  brush_->setText(tr("Brush"));
  brush_->setToolTip(
      tr("Draw a rectangle over samples in the large figure to select their bins. With Shift they "
         "are added to those selected (L)"));
  exclude_bins_->setText(tr("Exclude these bins"));
  exclude_bins_->setToolTip(
      tr("Leave out the returns in the selected angular bins of this circle, and solve again"));
  exclude_circle_->setText(tr("Exclude this circle"));
  exclude_circle_->setToolTip(tr("Leave out this circle in this scene, and solve again"));
  take_back_->setText(tr("Take back"));
  take_back_->setToolTip(tr("Use again what was left out of this circle by hand"));
  bins_->setToolTip(
      tr("Every angular bin of the chosen node: where the intensity crosses its middle "
         "level (mm from the circle), its standard deviation, and why it was refused"));
  play_->setToolTip(tr("Replay the iterations from the first (P)"));
  play_->setAccessibleName(tr("Replay"));
  slider_->setToolTip(tr("Iteration shown"));
  slider_->setAccessibleName(tr("Iteration"));
  const int shown = iteration();
  showResultLater();
  if (!stale_) setIteration(shown);
}

RefinementPage::~RefinementPage() = default;

QWidget* RefinementPage::createDetail() {
  auto* split = new QSplitter(Qt::Vertical, this);
  split->setChildrenCollapsible(false);
  auto* top = new QWidget(split);
  auto* layout = new QVBoxLayout(top);
  layout->setContentsMargins(0, 0, 0, 0);
  large_ = new AngleDistancePlot(top);
  large_->setObjectName("large-plot");
  verdict_ = new QLabel(top);
  verdict_->setObjectName("node-verdict");
  verdict_->setWordWrap(true);
  verdict_->setTextFormat(Qt::RichText);
  connect(verdict_, &QLabel::linkActivated, this, [this] {
    if (!result_ || scene_ < 0 || scene_ >= static_cast<int>(result_->scenes.size())) return;
    const std::string& name = result_->scenes[static_cast<std::size_t>(scene_)].name;
    Q_EMIT keepWanted(QString::fromStdString(name), false, chosen_);
  });
  bins_ = new QTableWidget(0, 5, top);
  bins_->setObjectName("bins");
  bins_->horizontalHeader()->setStretchLastSection(true);
  bins_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  bins_->horizontalHeader()->setSectionResizeMode(4, QHeaderView::Stretch);
  bins_->verticalHeader()->hide();
  bins_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  bins_->setSelectionBehavior(QAbstractItemView::SelectRows);
  bins_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  connect(bins_, &QTableWidget::itemSelectionChanged, this, [this] {
    large_->setChosenBins(selectedBins());
    updateDecisions();
  });
  connect(large_, &AngleDistancePlot::binsBrushed, this, &RefinementPage::selectBins);
  layout->addWidget(large_, 3);
  layout->addWidget(verdict_);
  layout->addWidget(bins_, 2);
  layout->addWidget(createDecisions());
  auto* bottom = new QSplitter(Qt::Horizontal, split);
  bottom->setChildrenCollapsible(false);
  map_ = new BoardMapPlot(bottom);
  convergence_ = new ConvergencePlot(bottom);
  bottom->addWidget(map_);
  bottom->addWidget(convergence_);
  split->addWidget(top);
  split->addWidget(bottom);
  split->setStretchFactor(0, 3);
  split->setStretchFactor(1, 2);
  split->setSizes({600, 400});
  connect(map_, &BoardMapPlot::nodeClicked, this, &RefinementPage::chooseNode);
  connect(convergence_, &ConvergencePlot::iterationClicked, this, &RefinementPage::setIteration);
  for (PlotView* plot : std::initializer_list<PlotView*>{large_, map_, convergence_}) {
    connect(plot->figureActions(), &FigureActions::failed, this, &RefinementPage::failed);
  }
  return split;
}

QWidget* RefinementPage::createReplay() {
  auto* bar = new QWidget(this);
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(0, 0, 0, 0);
  play_ = new QToolButton(bar);
  play_->setObjectName("play");
  play_->setText(QString(QChar(0x25B6)));  // Takes the palette's colour, unlike the style's icon.
  // The key is the page's: in a list elsewhere the same letter chooses an entry.
  auto* key = new QShortcut(QKeySequence(Qt::Key_P), this);
  key->setContext(Qt::WidgetWithChildrenShortcut);
  connect(key, &QShortcut::activated, play_, &QToolButton::click);
  slider_ = new QSlider(Qt::Horizontal, bar);
  slider_->setObjectName("iteration");
  slider_->setPageStep(1);
  iteration_text_ = new QLabel(bar);
  iteration_text_->setMinimumWidth(330);
  layout->addWidget(play_);
  layout->addWidget(slider_, 1);
  layout->addWidget(iteration_text_);
  connect(play_, &QToolButton::clicked, this, &RefinementPage::play);
  connect(slider_, &QSlider::valueChanged, this, &RefinementPage::updatePlots);
  connect(slider_, &QSlider::sliderPressed, &player_, &QTimer::stop);
  return bar;
}

void RefinementPage::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  live_points_.reset();
  if (result_) setTarget(result_->target);
  showResultLater();
}

void RefinementPage::setScene(int index) {
  if (index == scene_) return;
  scene_ = index;
  showResultLater();
}

void RefinementPage::setTarget(const Target& target) {
  const bool same = target.type == target_.type && target.tag_columns == target_.tag_columns &&
                    target.tag_rows == target_.tag_rows;
  target_ = target;
  map_->setTarget(target);
  if (!same || plots_.empty()) {
    rebuildGrid();
    updatePlots();
  }
}

void RefinementPage::setLivePoints(int scene, std::shared_ptr<const Cloud> board_points) {
  live_points_scene_ = scene;
  live_points_ = std::move(board_points);
}

// Ten figures behind another page would cost every change of the scene a tenth of a second. What
// they showed is let go, so that an old result is not kept for them.
void RefinementPage::showResultLater() {
  stale_ = unseen(*this);
  if (!stale_) return showResult();
  player_.stop();
  refinement_.reset();
  points_.reset();
  sampler_ = NodeSampler();
  refused_.clear();
}

void RefinementPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (std::exchange(stale_, false)) showResult();
}

void RefinementPage::showResult() {
  refused_.clear();
  shown_edits_ = {};
  if (!result_ || scene_ < 0 || scene_ >= static_cast<int>(result_->scenes.size())) {
    display(nullptr, nullptr, tr("Choose a scene and run the calibration to see its refinement."));
    return;
  }
  const SceneResult& scene = result_->scenes[static_cast<std::size_t>(scene_)];
  if (!scene.refinement) {
    const QString reason = core_text(scene.reason);
    display(nullptr, nullptr,
            reason.isEmpty() ? tr("This scene was not refined.")
                             : tr("This scene was not refined: %1").arg(reason));
    return;
  }
  if (scene.refinement->nodes.empty()) {
    display(nullptr, nullptr, tr("This board has no circles: there is nothing to refine."));
    return;
  }
  refused_ = refusedCircles();
  shown_edits_ = scene.edits;
  display({result_, &*scene.refinement}, {result_, &scene.board_points}, {});
}

std::map<int, RefinementPage::Refused> RefinementPage::refusedCircles() const {
  std::map<int, Refused> out;
  const SceneResult& scene = result_->scenes[static_cast<std::size_t>(scene_)];
  for (const Refusal& refusal : refusals(*result_)) {
    if (refusal.scene == scene.name && refusal.what == Refusal::What::kCircle)
      out[refusal.id] = {core_text(refusal.reason), refusal.can_be_used};
  }
  for (const int id : scene.edits.circles) out[id] = {tr("left out by hand"), false, true};
  return out;
}

QWidget* RefinementPage::createDecisions() {
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](QToolButton*& button, const char* name) {
    button = new QToolButton(row);
    button->setObjectName(QString::fromLatin1(name));
    layout->addWidget(button);
  };
  add(brush_, "refinement-brush");
  brush_->setCheckable(true);
  auto* key = new QShortcut(QKeySequence(Qt::Key_L), this);
  key->setContext(Qt::WidgetWithChildrenShortcut);
  connect(key, &QShortcut::activated, brush_, &QToolButton::click);
  connect(brush_, &QToolButton::toggled, this, [this](bool on) { large_->setBrushing(on); });
  add(exclude_bins_, "exclude-bins");
  add(exclude_circle_, "exclude-circle");
  add(take_back_, "take-back-circle");
  layout->addStretch(1);
  connect(exclude_bins_, &QToolButton::clicked, this, &RefinementPage::excludeBins);
  connect(exclude_circle_, &QToolButton::clicked, this, [this] {
    SceneEdits edits = edits_;
    edits.circles.push_back(chosen_);
    std::sort(edits.circles.begin(), edits.circles.end());
    std::erase(edits.kept_circles, chosen_);
    Q_EMIT editsWanted(scene_, edits);
  });
  connect(take_back_, &QToolButton::clicked, this, &RefinementPage::takeBack);
  return row;
}

void RefinementPage::setEdits(const SceneEdits& edits) {
  edits_ = edits;
  updateDecisions();
}

std::vector<int> RefinementPage::selectedBins() const {
  std::vector<int> rows;
  for (const QModelIndex& index : bins_->selectionModel()->selectedRows())
    rows.push_back(index.row());
  std::sort(rows.begin(), rows.end());
  return rows;
}

void RefinementPage::selectBins(const std::vector<int>& bins, bool add) {
  QItemSelection selection;
  const QAbstractItemModel* model = bins_->model();
  for (const int bin : bins)
    selection.select(model->index(bin, 0), model->index(bin, model->columnCount() - 1));
  bins_->selectionModel()->select(
      selection, add ? QItemSelectionModel::Select : QItemSelectionModel::ClearAndSelect);
  if (!bins.empty()) bins_->scrollToItem(bins_->item(bins.front(), 0));
}

bool RefinementPage::isOfChosen(const std::vector<Eigen::Vector2d>& patch_m) const {
  const NodeWindow window = node_window(target_);
  for (const TargetNode& node : target_.nodes()) {
    if (node.id != chosen_) continue;
    const double reach_m = window.radius_m + window.outside_m + 1e-6;
    return !patch_m.empty() && std::all_of(patch_m.begin(), patch_m.end(), [&](const auto& p) {
      return (p - node.center_m).norm() <= reach_m;
    });
  }
  return false;
}

// Decided about is what the result shows, not what a run is still finding.
void RefinementPage::updateDecisions() {
  const NodeRecord* node = record(chosen_);
  const bool known = node != nullptr && result_ != nullptr && scene_ >= 0;
  const bool circle_out = contains_id(edits_.circles, chosen_);
  const bool bins_out =
      target_.has_circles() && std::any_of(edits_.patches_m.begin(), edits_.patches_m.end(),
                                           [this](const auto& patch) { return isOfChosen(patch); });
  exclude_bins_->setEnabled(known && !circle_out && !selectedBins().empty());
  exclude_circle_->setEnabled(known && !circle_out);
  take_back_->setEnabled(known && (circle_out || bins_out));
}

void RefinementPage::excludeBins() {
  const NodeRecord* node = record(chosen_);
  if (node == nullptr || node->bins.empty()) return;
  SceneEdits edits = edits_;
  const double width_rad = 2.0 * std::numbers::pi / static_cast<double>(node->bins.size());
  for (const int row : selectedBins()) {
    const double from_rad = -std::numbers::pi + row * width_rad;
    edits.patches_m.push_back(ring_patch(target_, chosen_, from_rad, from_rad + width_rad));
  }
  Q_EMIT editsWanted(scene_, edits);
}

void RefinementPage::takeBack() {
  SceneEdits edits = edits_;
  std::erase(edits.circles, chosen_);
  std::erase_if(edits.patches_m, [this](const auto& patch) { return isOfChosen(patch); });
  Q_EMIT editsWanted(scene_, edits);
}

void RefinementPage::showIteration(int scene, std::shared_ptr<const BoardRefinement> partial) {
  if (scene != scene_ || !partial) return;
  std::shared_ptr<const Cloud> points = points_;
  if (live_points_ && live_points_scene_ == scene) points = live_points_;
  player_.stop();
  refused_.clear();
  shown_edits_ = edits_;
  display(std::move(partial), std::move(points), {});
}

void RefinementPage::display(std::shared_ptr<const BoardRefinement> refinement,
                             std::shared_ptr<const Cloud> points, const QString& message) {
  refinement_ = std::move(refinement);
  points_ = std::move(points);
  message_ = message;
  sampler_ = NodeSampler();
  if (refinement_ && points_) {
    sampler_ = NodeSampler(*points_, refinement_->plane, target_);
    if (points_->has_intensity()) intensity_ = scale_for(points_->intensity, ColorMap::kSequential);
  }
  if (target_.has_circles()) {
    const NodeWindow window = node_window(target_);
    // The edge's neighbourhood: what lies deeper inside is all alike.
    reach_m_ = std::min(window.inside_m, window.outside_m);
  }
  std::set<int> refused;
  std::set<int> by_hand;
  for (const auto& [id, entry] : refused_) {
    refused.insert(id);
    if (entry.by_hand) by_hand.insert(id);
  }
  map_->setRefused(std::move(refused), std::move(by_hand));
  map_->setPaths(refinement_ ? center_paths(*refinement_) : std::vector<CenterPath>());
  convergence_->setHistory(refinement_ ? refinement_->history : std::vector<IterationRecord>());
  updateReplay();
  updatePlots();
}

void RefinementPage::updateReplay() {
  const int count = refinement_ ? static_cast<int>(refinement_->history.size()) : 0;
  const QSignalBlocker blocker(slider_);
  slider_->setRange(0, std::max(0, count - 1));
  slider_->setValue(std::max(0, count - 1));
  slider_->setEnabled(count > 1);
  play_->setEnabled(count > 1);
}

void RefinementPage::rebuildGrid() {
  // One of them may be in a loop of its own, as while its figure is saved.
  for (AngleDistancePlot* plot : plots_) {
    plot->hide();
    grid_layout_->removeWidget(plot);
    plot->setObjectName({});
    plot->deleteLater();
  }
  plots_.clear();
  const int columns = target_.tag_columns - 1;
  const int rows = target_.tag_rows - 1;
  for (const TargetNode& node : target_.nodes()) {
    auto* plot = new AngleDistancePlot(grid_);
    plot->setObjectName(QString("node-%1").arg(node.id));
    plot->setCompact(true);
    // As on the board: the first row is the lowest.
    grid_layout_->addWidget(plot, rows - 1 - node.id / columns, node.id % columns);
    connect(plot, &PlotView::clicked, this, [this, id = node.id] { chooseNode(id); });
    connect(plot->figureActions(), &FigureActions::failed, this, &RefinementPage::failed);
    plots_.push_back(plot);
  }
  notice_->setVisible(plots_.empty());  // Else half of the page would be bare.
}

int RefinementPage::iteration() const {
  return slider_->value();
}

void RefinementPage::setIteration(int iteration) {
  player_.stop();
  slider_->setValue(iteration);
}

void RefinementPage::chooseNode(int id) {
  chosen_ = id;
  map_->setChosenNode(id);
  convergence_->setChosenNode(id);
  updateDetail();
}

void RefinementPage::play() {
  slider_->setValue(0);
  player_.start();
}

void RefinementPage::advance() {
  if (slider_->value() >= slider_->maximum()) {
    player_.stop();
  } else {
    slider_->setValue(slider_->value() + 1);
  }
}

const NodeRecord* RefinementPage::record(int id) const {
  if (!refinement_ || refinement_->history.empty()) return nullptr;
  const auto last = static_cast<int>(refinement_->history.size()) - 1;
  const auto k = static_cast<std::size_t>(std::clamp(iteration(), 0, last));
  for (const NodeRecord& node : refinement_->history[k].nodes) {
    if (node.id == id) return &node;
  }
  return nullptr;
}

QString RefinementPage::nodeTitle(int id, bool narrow) const {
  const NodeRecord* node = record(id);
  if (node == nullptr) return tr("node %1").arg(id);
  // Nine plots side by side have no room for more.
  if (narrow) {
    if (isByHand(id) || (refused_.contains(id) && node->valid)) return tr("%1: left out").arg(id);
    return node->valid
               ? tr("%1: %2 mm").arg(id).arg(kMmPerM * node->wave_m.head<2>().norm(), 0, 'f', 2)
               : tr("%1: not usable").arg(id);
  }
  if (isByHand(id)) return tr("node %1: left out by hand").arg(id);
  if (!node->valid) return tr("node %1: not usable").arg(id);
  return tr("node %1: |Δc| %2 mm").arg(id).arg(kMmPerM * node->wave_m.head<2>().norm(), 0, 'f', 2);
}

void RefinementPage::updatePlots() {
  const std::vector<TargetNode> nodes = target_.nodes();
  for (std::size_t k = 0; k < plots_.size() && k < nodes.size(); ++k) {
    plots_[k]->setTitle(nodeTitle(nodes[k].id, true));
    plots_[k]->setRefused(refused_.contains(nodes[k].id), isByHand(nodes[k].id));
    if (const NodeRecord* node = record(nodes[k].id)) {
      showRecord(*plots_[k], *node);
    } else {
      plots_[k]->clear(refinement_ ? tr("no data") : QString());
    }
  }
  map_->setIteration(iteration());
  convergence_->setIteration(refinement_ ? iteration() : -1);
  if (refinement_ && !refinement_->history.empty()) {
    const auto k = static_cast<std::size_t>(slider_->value());
    iteration_text_->setText(tr("iteration %1 of %2, largest move %3 mm")
                                 .arg(slider_->value() + 1)
                                 .arg(refinement_->history.size())
                                 .arg(kMmPerM * refinement_->history[k].max_update_m, 0, 'f', 3));
  } else {
    iteration_text_->clear();
  }
  updateDetail();
}

void RefinementPage::showRecord(AngleDistancePlot& plot, const NodeRecord& record) const {
  plot.setData(
      {record, sampler_.around(record.center_uv_m), intensity_, reach_m_, binsByHand(record)});
}

bool RefinementPage::isByHand(int circle) const {
  const auto found = refused_.find(circle);
  return found != refused_.end() && found->second.by_hand;
}

// Without their returns the refinement finds such bins as empty as those that the LiDAR missed.
// With fewer returns it divides the circle into fewer bins: one that reaches into what was left out
// may keep too few of its own.
std::vector<bool> RefinementPage::binsByHand(const NodeRecord& record) const {
  std::vector<bool> out(record.bins.size(), false);
  constexpr std::array kWithin{0.1, 0.5, 0.9};  // Where along a bin is asked.
  SceneEdits edits = shown_edits_;
  edits.points_m.clear();
  if (edits.empty() || !target_.has_circles()) return out;
  const double radius_m = node_window(target_).radius_m;
  // Before any board: only where on it the edge lies is asked.
  Rigid3 front;
  front.translation = Eigen::Vector3d::UnitZ();
  Cloud edge;
  for (const TargetNode& node : target_.nodes()) {
    if (node.id != record.id) continue;
    for (std::size_t k = 0; k < out.size() * kWithin.size(); ++k) {
      const double bin = static_cast<double>(k / kWithin.size()) + kWithin[k % kWithin.size()];
      const double angle = (2.0 * bin / static_cast<double>(out.size()) - 1.0) * std::numbers::pi;
      const Eigen::Vector2d p =
          node.center_m + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      edge.points_m.emplace_back(Eigen::Vector3d(p.x(), p.y(), 1.0).cast<float>());
    }
  }
  for (const std::uint32_t k : left_out_points(edge, edits, target_, front)) {
    const std::size_t bin = k / kWithin.size();
    out[bin] = record.bins[bin].state != BinState::kUsed;
  }
  return out;
}

void RefinementPage::updateDetail() {
  const NodeRecord* node = record(chosen_);
  large_->setChosenBins({});
  large_->setTitle(node != nullptr ? nodeTitle(chosen_) : QString());
  large_->setRefused(node != nullptr && refused_.contains(chosen_), isByHand(chosen_));
  if (node != nullptr) {
    showRecord(*large_, *node);
  } else {
    large_->clear(message_.isEmpty() ? tr("no data") : QString());
  }
  fillBins(node);
  updateDecisions();
  notice_->setText(message_);
  if (node == nullptr) {
    verdict_->setText(plots_.empty() ? QString() : message_.toHtmlEscaped());
    return;
  }
  const auto used = std::count_if(node->bins.begin(), node->bins.end(),
                                  [](const BinRecord& b) { return b.state == BinState::kUsed; });
  QString text = tr("%1 of %2 bins used").arg(used).arg(node->bins.size());
  const std::vector<bool> by_hand = binsByHand(*node);
  if (const auto out = std::count(by_hand.begin(), by_hand.end(), true); out > 0)
    text += tr("; left out by hand: %1").arg(out);
  if (node->valid) {
    const Eigen::Vector3d wave = kMmPerM * node->wave_m;
    text += tr("; Δcu %1, Δcv %2, Δr %3 mm")
                .arg(wave.x(), 0, 'f', 2)
                .arg(wave.y(), 0, 'f', 2)
                .arg(wave.z(), 0, 'f', 2);
    text += tr("; levels %1 and %2")
                .arg(node->inner_level, 0, 'f', 0)
                .arg(node->outer_level, 0, 'f', 0);
  } else if (!isByHand(chosen_)) {
    text += tr("; not usable: %1").arg(core_text(node->reason));
  }
  text = text.toHtmlEscaped();
  const auto refused = refused_.find(chosen_);
  if (refused != refused_.end() && (node->valid || refused->second.by_hand)) {
    text = QStringLiteral("<b>%1</b> %2")
               .arg(tr("Left out: %1.").arg(refused->second.reason).toHtmlEscaped(), text);
    if (refused->second.can_be_used)
      text += QStringLiteral(" <a href=\"keep\">%1</a>").arg(tr("Use it all the same"));
  }
  verdict_->setText(text);
}

void RefinementPage::fillBins(const NodeRecord* record) {
  const QSignalBlocker blocker(bins_);
  bins_->setCurrentCell(-1, -1);
  bins_->clearSelection();
  bins_->setRowCount(record != nullptr ? static_cast<int>(record->bins.size()) : 0);
  if (record == nullptr) return;
  // Columns that fit their contents are measured again at every cell that changes.
  QHeaderView* header = bins_->horizontalHeader();
  for (int column = 0; column < 4; ++column)
    header->setSectionResizeMode(column, QHeaderView::Fixed);
  const QColor refused = state_colors(palette()).bad;
  const QColor left_out = PlotColors::of(palette()).left_out;
  const std::vector<bool> by_hand = binsByHand(*record);
  for (int row = 0; row < bins_->rowCount(); ++row) {
    const BinRecord& bin = record->bins[static_cast<std::size_t>(row)];
    const bool has_midpoint = bin.sigma_m > 0.0;
    const bool out = by_hand[static_cast<std::size_t>(row)];
    const QStringList cells{
        QString::number(kDegPerRad * bin.angle_rad, 'f', 1),
        has_midpoint ? QString::number(kMmPerM * bin.midpoint_m, 'f', 3) : QString("–"),
        has_midpoint ? QString::number(kMmPerM * bin.sigma_m, 'f', 3) : QString("–"),
        QString::number(bin.samples),
        out ? tr("left out by hand") : core_text(describe(bin.state))};
    for (int column = 0; column < cells.size(); ++column) {
      auto* item = new QTableWidgetItem(cells[column]);
      if (column < 4) item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
      if (bin.state != BinState::kUsed) item->setForeground(out ? left_out : refused);
      bins_->setItem(row, column, item);
    }
  }
  for (int column = 0; column < 4; ++column)
    header->setSectionResizeMode(column, QHeaderView::ResizeToContents);
  bins_->verticalHeader()->setDefaultSectionSize(bins_->fontMetrics().height() + 6);
}

}  // namespace lvcalib::widgets

#include "moc_refinement_page.cpp"
