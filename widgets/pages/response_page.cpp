// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/response_page.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>
#include <QTableWidget>
#include <QTextBrowser>
#include <QToolButton>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "pages/response_table.h"
#include "pipeline/refusals.h"
#include "style/edits_text.h"
#include "style/texts.h"
#include "style/unseen.h"
#include "views/sample_map_plot.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

ResponsePage::ResponsePage(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  message_ = new QLabel(this);
  message_->setObjectName("response-message");
  message_->setWordWrap(true);
  auto* splitter = new QSplitter(Qt::Vertical, this);
  splitter->setChildrenCollapsible(false);
  splitter->addWidget(createPlots());
  splitter->addWidget(createTables());
  splitter->setStretchFactor(0, 1);
  splitter->setStretchFactor(1, 0);
  splitter->setSizes({500, 250});
  layout->addWidget(message_);
  layout->addWidget(splitter, 1);
  follow_language(this, [this] { retranslate(); });
}

void ResponsePage::retranslate() {
  title_response_table(*scenes_, tr("Scene"));
  title_response_table(*classes_, tr("Range, incidence"));
  scenes_->setAccessibleName(tr("Boundary response per scene"));
  tabs_->setTabText(0, tr("Scenes"));
  tabs_->setTabText(1, tr("By range and incidence"));
  tabs_->setTabText(2, tr("Left out"));
  brush_->setText(tr("Brush"));
  brush_->setToolTip(
      tr("Draw a rectangle over the samples on the board: returns there can be left out, of the "
         "scene chosen in the table or of all"));
  stale_ = unseen(*this);
  if (!stale_) refresh();
}

QWidget* ResponsePage::createPlots() {
  auto* page = new QWidget(this);
  auto* grid = new QGridLayout(page);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  transition_ = new TransitionPlot(page);
  map_ = new SampleMapPlot(page);
  angles_ = new AnglePlot(page);
  ranges_ = new RangePlot(page);
  PlotView* plots[] = {transition_, map_, angles_, ranges_};
  for (int k = 0; k < 4; ++k) {
    grid->addWidget(plots[k], k / 2, k % 2);
    connect(plots[k]->figureActions(), &FigureActions::failed, this, &ResponsePage::failed);
  }
  return page;
}

QWidget* ResponsePage::createTables() {
  tabs_ = new QTabWidget(this);
  tabs_->setDocumentMode(true);
  scenes_ = new_response_table(tabs_);
  scenes_->setObjectName("response-scenes");
  classes_ = new_response_table(tabs_);
  classes_->setObjectName("response-classes");
  hide_transition(*classes_);
  classes_->setSelectionMode(QAbstractItemView::NoSelection);
  reasons_ = new QTextBrowser(tabs_);
  reasons_->setObjectName("response-reasons");
  reasons_->setOpenLinks(false);
  connect(reasons_, &QTextBrowser::anchorClicked, this, [this](const QUrl& what) {
    // "scene:NAME", "back:NAME", "tag:ID/NAME", "circle:ID/NAME" or "patch:ID/NAME"; "handtag:",
    // "handcircle:" and "handpatch:" for what the user left out.
    const QString path = what.path(QUrl::FullyEncoded);
    const QString name = QUrl::fromPercentEncoding(path.section('/', -1).toUtf8());
    if (what.scheme() == QLatin1String("scene")) {
      Q_EMIT insistWanted(name);
    } else if (what.scheme() == QLatin1String("back")) {
      Q_EMIT keptDropped(name);
    } else if (what.scheme().startsWith(QLatin1String("hand"))) {
      takeBack(what.scheme(), name, path.section('/', 0, 0).toInt());
    } else if (what.scheme() == QLatin1String("patch")) {
      Q_EMIT keepPatchWanted(name, path.section('/', 0, 0).toInt());
    } else {
      Q_EMIT keepWanted(name, what.scheme() == QLatin1String("tag"),
                        path.section('/', 0, 0).toInt());
    }
  });
  for (QWidget* page : std::initializer_list<QWidget*>{scenes_, classes_, reasons_})
    tabs_->addTab(page, {});
  auto* tools = new QWidget(tabs_);
  auto* row = new QHBoxLayout(tools);
  row->setContentsMargins(0, 0, 0, 0);
  exclude_ = new QToolButton(tools);
  exclude_->setObjectName("response-exclude");
  brush_ = new QToolButton(tools);
  brush_->setObjectName("response-brush");
  brush_->setCheckable(true);
  row->addWidget(exclude_);
  row->addWidget(brush_);
  tabs_->setCornerWidget(tools);
  connect(brush_, &QToolButton::toggled, this, [this](bool on) {
    map_->setBrushing(on);
    if (!on) choosePart(std::nullopt);
  });
  connect(map_, &SampleMapPlot::brushed, this, &ResponsePage::choosePart);
  connect(exclude_, &QToolButton::clicked, this, &ResponsePage::excludePart);
  exclude_->hide();
  connect(scenes_, &QTableWidget::currentCellChanged, this, [this](int row) { activate(row); });
  return tabs_;
}

void ResponsePage::setResult(std::shared_ptr<const CalibrationResult> result) {
  // The figures borrow from the result they show: the one before stays until they have let go.
  const std::shared_ptr<const CalibrationResult> before = std::exchange(result_, std::move(result));
  stale_ = true;
  if (isVisible() || !result_) {
    refresh();
  } else {
    showScope(ResponseScope());
  }
}

void ResponsePage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (stale_) refresh();
}

void ResponsePage::refresh() {
  stale_ = false;
  if (!result_) {
    message_->setText(tr("Run the calibration to see how returns scatter at the circles' edges."));
  } else {
    message_->setText(core_text(result_->response.reason));
  }
  message_->setVisible(!message_->text().isEmpty());
  map_->setTarget(result_ ? result_->target : Target());
  fillTables();
  fillReasons();
  showScope(scopeOf(scenes_->currentRow()));
}

// Row 0 is all scenes together, row k scene k − 1 of the response.
void ResponsePage::fillTables() {
  const QSignalBlocker quiet(scenes_);
  scenes_->clearSpans();
  scenes_->setRowCount(0);
  classes_->clearSpans();
  classes_->setRowCount(0);
  if (!result_) return;
  const BoundaryResponse& response = result_->response;
  add_response_row(*scenes_, tr("All scenes"), response.all, response.transition,
                   core_text(response.reason));
  int chosen = 0;
  for (const SceneResponse& scene : response.scenes) {
    if (scene.name == chosen_) chosen = scenes_->rowCount();
    add_response_row(*scenes_, QString::fromStdString(scene.name), scene.statistics,
                     scene.transition, core_text(scene.reason));
  }
  if (chosen == 0) chosen_.clear();
  scenes_->setCurrentCell(chosen, 0);
  for (const ResponseCell& cell : response.by_both) {
    const QString name = tr("%1–%2 m, %3–%4°")
                             .arg(cell.range_low_m)
                             .arg(cell.range_high_m)
                             .arg(cell.incidence_low_deg)
                             .arg(cell.incidence_high_deg);
    add_response_row(*classes_, name, cell.statistics, std::nullopt,
                     tr("not enough samples: %1").arg(cell.n));
  }
}

QString ResponsePage::describe(const Refusal& refusal) {
  using What = Refusal::What;
  const QString scene = QString::fromStdString(refusal.scene);
  switch (refusal.what) {
    case What::kScene:
      return tr("Scene %1:").arg(scene);
    case What::kCircle:
      return tr("Scene %1, circle %2:").arg(scene).arg(refusal.id);
    case What::kTag:
      return tr("Scene %1, corners of tag %2:").arg(scene).arg(refusal.id);
    case What::kPoints:
      return tr("Scene %1, %n points on the board:", nullptr, static_cast<int>(refusal.points))
          .arg(scene);
    case What::kPatch:
      return tr("Scene %1, %n points at x %2 to %3 m, y %4 to %5 m on the board:", nullptr,
                static_cast<int>(refusal.points))
          .arg(scene)
          .arg(refusal.board_m.min().x(), 0, 'f', 2)
          .arg(refusal.board_m.max().x(), 0, 'f', 2)
          .arg(refusal.board_m.min().y(), 0, 'f', 2)
          .arg(refusal.board_m.max().y(), 0, 'f', 2);
    case What::kResponse:
      break;
  }
  if (refusal.id < 0) return tr("Scene %1, for the boundary response alone:").arg(scene);
  return tr("Scene %1, circle %2, for the boundary response alone:").arg(scene).arg(refusal.id);
}

void ResponsePage::fillReasons() {
  QString html;
  if (result_) {
    for (const Refusal& refusal : refusals(*result_)) {
      html += "<li>" + describe(refusal).toHtmlEscaped() + " " +
              core_text(refusal.reason).toHtmlEscaped();
      if (refusal.can_be_used) {
        const QString what =
            refusal.what == Refusal::What::kScene   ? QStringLiteral("scene:")
            : refusal.what == Refusal::What::kTag   ? QStringLiteral("tag:%1/").arg(refusal.id)
            : refusal.what == Refusal::What::kPatch ? QStringLiteral("patch:%1/").arg(refusal.id)
                                                    : QStringLiteral("circle:%1/").arg(refusal.id);
        const QByteArray scene = QUrl::toPercentEncoding(QString::fromStdString(refusal.scene));
        html += QStringLiteral(" <a href=\"%1%2\">%3</a>")
                    .arg(what, QString::fromUtf8(scene), tr("Use it all the same"));
      }
      html += "</li>";
    }
    for (const SceneResult& scene : result_->scenes) html += byHand(scene);
    // What is used all the same stays in the list that it was taken back from.
    for (const SceneResult& scene : result_->scenes) {
      const QString kept = kept_text(scene.edits);
      if (kept.isEmpty()) continue;
      const QString name = QString::fromStdString(scene.name);
      html += QStringLiteral("<li>%1 %2 <a href=\"back:%3\">%4</a></li>")
                  .arg(tr("Scene %1:").arg(name).toHtmlEscaped(), kept.toHtmlEscaped(),
                       QString::fromUtf8(QUrl::toPercentEncoding(name)), tr("Leave it out again"));
    }
  }
  reasons_->setHtml(html.isEmpty() ? "<p>" + tr("Nothing: everything found is used.") + "</p>"
                                   : "<ul>" + html + "</ul>");
}

// List items of what the user left out of a scene, each with a link that takes it back.
QString ResponsePage::byHand(const SceneResult& scene) {
  QString html;
  const QString name = QString::fromStdString(scene.name);
  const auto add = [&](const QString& what, const char* scheme, int id) {
    html += QStringLiteral("<li>%1 %2 <a href=\"%3:%4/%5\">%6</a></li>")
                .arg(what.toHtmlEscaped(), tr("left out by hand"), QString::fromLatin1(scheme))
                .arg(id)
                .arg(QString::fromUtf8(QUrl::toPercentEncoding(name)), tr("Take back"));
  };
  for (const int id : scene.edits.tags)
    add(tr("Scene %1, corners of tag %2:").arg(name).arg(id), "handtag", id);
  for (const int id : scene.edits.circles)
    add(tr("Scene %1, circle %2:").arg(name).arg(id), "handcircle", id);
  for (std::size_t k = 0; k < scene.edits.patches_m.size(); ++k) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : scene.edits.patches_m[k]) box.extend(p);
    if (box.isEmpty()) continue;
    add(tr("Scene %1, part of the board at x %2 to %3 m, y %4 to %5 m:")
            .arg(name)
            .arg(box.min().x(), 0, 'f', 2)
            .arg(box.max().x(), 0, 'f', 2)
            .arg(box.min().y(), 0, 'f', 2)
            .arg(box.max().y(), 0, 'f', 2),
        "handpatch", static_cast<int>(k));
  }
  return html;
}

void ResponsePage::takeBack(const QString& kind, const QString& name, int id) {
  if (!result_) return;
  for (const SceneResult& scene : result_->scenes) {
    if (scene.name != name.toStdString()) continue;
    SceneEdits what;
    if (kind == QLatin1String("handtag")) what.tags = {id};
    if (kind == QLatin1String("handcircle")) what.circles = {id};
    const auto place = static_cast<std::size_t>(id);
    if (kind == QLatin1String("handpatch") && place < scene.edits.patches_m.size())
      what.patches_m = {scene.edits.patches_m[place]};
    if (!what.empty()) Q_EMIT takenBack(name, what);
  }
}

ResponseScope ResponsePage::scopeOf(int row) const {
  ResponseScope scope;
  if (!result_ || row < 0) return scope;
  const BoundaryResponse& response = result_->response;
  const bool all = row == 0;
  for (std::size_t s = 0; s < response.scenes.size(); ++s) {
    if (!all && static_cast<int>(s) + 1 != row) continue;
    scope.scenes.push_back(&response.scenes[s]);
    scope.colors.push_back(static_cast<int>(s));
    for (const Refusal& refusal : refusals(*result_)) {
      if (refusal.scene == response.scenes[s].name && refusal.what == Refusal::What::kPatch)
        scope.covered.push_back({refusal.board_m.min(), refusal.board_m.max()});
    }
    for (const SceneResult& scene : result_->scenes) {
      if (scene.name != response.scenes[s].name) continue;
      const SceneEdits& edits = scene.edits;
      scope.left_out_m.insert(scope.left_out_m.end(), edits.patches_m.begin(),
                              edits.patches_m.end());
      scope.left_out_circles.insert(scope.left_out_circles.end(), edits.circles.begin(),
                                    edits.circles.end());
    }
  }
  const auto address = [](const auto& found) { return found ? &*found : nullptr; };
  if (all) {
    scope.transition = address(response.transition);
    scope.statistics = address(response.all);
    scope.reason = response.reason;
  } else if (!scope.scenes.empty()) {
    scope.transition = address(scope.scenes.front()->transition);
    scope.statistics = address(scope.scenes.front()->statistics);
    scope.reason = scope.scenes.front()->reason;
  }
  return scope;
}

void ResponsePage::choosePart(const std::optional<BoardOutline>& part) {
  part_ = part;
  map_->setPart(part);
  exclude_->setVisible(part.has_value());
  exclude_->setText(
      chosen_.empty()
          ? tr("Exclude this part of the board in every scene")
          : tr("Exclude this part of the board in scene %1").arg(QString::fromStdString(chosen_)));
}

void ResponsePage::excludePart() {
  if (!part_) return;
  const std::vector<Eigen::Vector2d> patch = part_->corners_m();
  const QString scene = QString::fromStdString(chosen_);
  choosePart(std::nullopt);
  Q_EMIT partExcluded(scene, patch);
}

void ResponsePage::showScope(const ResponseScope& scope) {
  transition_->setScope(scope);
  map_->setScope(scope);
  angles_->setScope(scope);
  ranges_->setScope(scope);
}

void ResponsePage::activate(int row) {
  if (!result_ || row < 0) return;
  chosen_.clear();
  if (row > 0) chosen_ = result_->response.scenes[static_cast<std::size_t>(row) - 1].name;
  showScope(scopeOf(row));
  choosePart(part_);  // Of this scene, or of all.
  const auto found = std::find_if(result_->scenes.begin(), result_->scenes.end(),
                                  [&](const SceneResult& s) { return s.name == chosen_; });
  if (found != result_->scenes.end())
    Q_EMIT sceneActivated(static_cast<int>(found - result_->scenes.begin()));
}

}  // namespace lvcalib::widgets

#include "moc_response_page.cpp"
