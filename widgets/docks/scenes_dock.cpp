// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/scenes_dock.h"

#include <QAction>
#include <QEvent>
#include <QHeaderView>
#include <QScrollBar>
#include <QSortFilterProxyModel>
#include <QTreeView>
#include <QVBoxLayout>
#include <algorithm>

#include "models/scene_model.h"
#include "style/texts.h"
#include "views/tool_row.h"

namespace lvcalib::widgets {
namespace {

// Widths of thumbnails, the first of which is taken with which all columns are in sight.
constexpr int kThumbnailWidths[] = {48, 24, 0};
constexpr int kThumbnailMargin = 8;
constexpr int kRowMargin = 4;
constexpr int kSign = 16 + 14;  // The sign of a state, and the room about it and the words.

}  // namespace

ScenesDock::ScenesDock(SceneModel& model, QWidget* parent)
    : QDockWidget(parent),
      model_(model),
      sorted_(new QSortFilterProxyModel(this)),
      view_(new QTreeView(this)),
      tools_(new ToolRow(this)) {
  setObjectName(QStringLiteral("scenes_dock"));
  follow_language_in_title(*this);
  auto* body = new QWidget(this);
  auto* layout = new QVBoxLayout(body);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  make_view(model);
  make_actions();
  layout->addWidget(view_);
  layout->addWidget(tools_);
  setWidget(body);
  retranslate();
  update_actions();
}

void ScenesDock::make_view(SceneModel& model) {
  sorted_->setSourceModel(&model);
  sorted_->setSortRole(SceneModel::kSortRole);
  view_->setObjectName(QStringLiteral("scenes"));
  view_->setModel(sorted_);
  view_->setRootIsDecorated(false);
  view_->setUniformRowHeights(true);
  view_->setAllColumnsShowFocus(true);
  view_->setAlternatingRowColors(true);
  view_->setSortingEnabled(true);
  // At first in the user's order; a third click on a heading brings it back.
  view_->header()->setSortIndicatorClearable(true);
  view_->sortByColumn(-1, Qt::AscendingOrder);
  view_->setDragDropMode(QAbstractItemView::InternalMove);
  view_->setDropIndicatorShown(true);
  view_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::SelectedClicked);
  view_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  view_->setIconSize(QSize(48, 30));
  view_->setContextMenuPolicy(Qt::ActionsContextMenu);
  QHeaderView* header = view_->header();
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  // The state stands beside the name and takes what room is left: its sign is always in sight.
  header->setStretchLastSection(false);
  header->setMinimumSectionSize(28);
  header->setSectionResizeMode(SceneModel::kState, QHeaderView::Stretch);
  header->moveSection(SceneModel::kState, 1);
  view_->setColumnHidden(SceneModel::kNote, true);
  view_->viewport()->installEventFilter(this);
  connect(header, &QHeaderView::sortIndicatorChanged, this, &ScenesDock::update_actions);
  connect(&model, &SceneModel::note_wanted, this, &ScenesDock::note_wanted);
  connect(&model, &SceneModel::order_wanted, this, &ScenesDock::order_wanted);
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &ScenesDock::update_actions);
  connect(&model, &QAbstractItemModel::modelReset, this, &ScenesDock::update_actions);
  connect(&model, &QAbstractItemModel::dataChanged, this, &ScenesDock::update_actions);
  connect(&model, &QAbstractItemModel::modelReset, this, &ScenesDock::fit_columns);
  connect(&model, &QAbstractItemModel::dataChanged, this, &ScenesDock::fit_columns);
  connect(view_->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& current) {
            const int row = sorted_->mapToSource(current).row();
            if (row >= 0 && !model_.is_missing(row)) Q_EMIT scene_activated(model_.scene_at(row));
          });
}

void ScenesDock::make_actions() {
  const auto add_action = [this](const char* name, QKeySequence keys) {
    auto* action = new QAction(this);
    action->setObjectName(QString::fromLatin1(name));
    action->setShortcut(keys);
    action->setShortcutContext(Qt::WindowShortcut);
    view_->addAction(action);
    return action;
  };
  accept_ = add_action("accept", QKeySequence(Qt::CTRL | Qt::Key_U));
  reject_ = add_action("reject", QKeySequence(Qt::CTRL | Qt::Key_J));
  insist_ = add_action("use_all_the_same", {});
  insist_->setCheckable(true);
  run_again_ = add_action("run_again", QKeySequence(Qt::SHIFT | Qt::Key_F5));
  uncrop_ = add_action("uncrop", {});
  add_ = add_action("add_scenes", QKeySequence(Qt::CTRL | Qt::Key_I));
  note_ = add_action("note", {});
  up_ = add_action("scene_up", QKeySequence(Qt::ALT | Qt::Key_Up));
  down_ = add_action("scene_down", QKeySequence(Qt::ALT | Qt::Key_Down));
  for (QAction* action : {accept_, reject_, insist_, run_again_, add_}) tools_->addTool(action);
  connect(note_, &QAction::triggered, this, &ScenesDock::edit_note);
  connect(up_, &QAction::triggered, this, [this] { move(-1); });
  connect(down_, &QAction::triggered, this, [this] { move(1); });
  connect(accept_, &QAction::triggered, this, [this] { Q_EMIT use_wanted(selected(), true); });
  connect(reject_, &QAction::triggered, this, [this] { Q_EMIT use_wanted(selected(), false); });
  connect(insist_, &QAction::triggered, this,
          [this](bool on) { Q_EMIT insist_wanted(selected(), on); });
  connect(run_again_, &QAction::triggered, this, [this] { Q_EMIT run_again_wanted(selected()); });
  connect(uncrop_, &QAction::triggered, this, [this] { Q_EMIT uncrop_wanted(selected()); });
  connect(add_, &QAction::triggered, this, &ScenesDock::add_wanted);
  connect(&model_, &SceneModel::use_wanted, this, [this](const QString& scene, bool use) {
    // A tick on one of several selected scenes is meant for all of them.
    const QStringList all = selected();
    Q_EMIT use_wanted(all.contains(scene) ? all : QStringList{scene}, use);
  });
}

QStringList ScenesDock::selected() const {
  QStringList names;
  for (const QModelIndex& index : view_->selectionModel()->selectedRows()) {
    const int row = sorted_->mapToSource(index).row();
    if (!model_.is_missing(row)) names << model_.scene_at(row);
  }
  return names;
}

void ScenesDock::select(const QString& scene) {
  const int row = model_.row_of(scene);
  if (row >= 0) view_->setCurrentIndex(sorted_->mapFromSource(model_.index(row, 0)));
}

// Past the row before the first selected one, or after the last.
void ScenesDock::move(int by) {
  int first = model_.rowCount();
  int last = -1;
  for (const QString& scene : selected()) {
    first = std::min(first, model_.row_of(scene));
    last = std::max(last, model_.row_of(scene));
  }
  const int row = by < 0 ? first - 1 : last + 2;
  if (last >= 0 && row >= 0 && row <= model_.rowCount())
    Q_EMIT order_wanted(model_.moved(selected(), row));
}

void ScenesDock::edit_note() {
  const QModelIndex current = view_->currentIndex();
  if (!current.isValid()) return;
  view_->setColumnHidden(SceneModel::kNote, false);
  const QModelIndex cell = current.siblingAtColumn(SceneModel::kNote);
  view_->scrollTo(cell);
  view_->edit(cell);
}

void ScenesDock::update_actions() {
  const bool any = !selected().isEmpty();
  if (model_.has_notes()) view_->setColumnHidden(SceneModel::kNote, false);
  view_->setColumnHidden(SceneModel::kTags, !model_.has_tags());
  // In another order than the user's there are no places to drag to.
  const bool own_order = view_->header()->sortIndicatorSection() < 0;
  // Room for an arrow in each heading costs a column or two.
  if (view_->header()->isSortIndicatorShown() == own_order) {
    view_->header()->setSortIndicatorShown(!own_order);
    fit_columns();
  }
  view_->setDragEnabled(own_order);
  note_->setEnabled(any);
  for (QAction* action : {up_, down_}) action->setEnabled(any && own_order);
  for (QAction* action : {accept_, reject_, run_again_, uncrop_}) action->setEnabled(any);
  add_->setEnabled(model_.rowCount() > 0);
  // Only beside what the program refused is there something to overrule.
  bool refused = false;
  bool insisted = false;
  for (const QString& scene : selected()) {
    const int row = model_.row_of(scene);
    refused |= model_.can_be_insisted_on(row);
    insisted |= model_.is_insisted_on(row);
  }
  insist_->setVisible(refused || insisted);
  insist_->setChecked(insisted);
}

// The frame, and the bar of a list that is longer than its place. Told by the largest pictures
// whatever is shown: else they bring a bar, beside which there is room for small ones only, which
// need no bar, and so on without end.
int ScenesDock::beside_rows() const {
  const int picture = model_.has_thumbnails() ? view_->iconSize().height() : 0;
  const int row = std::max(picture, view_->fontMetrics().height()) + kRowMargin;
  const int frame = 2 * view_->frameWidth();
  const int room = view_->height() - frame - view_->header()->height();
  const bool bar = model_.rowCount() * row > room;
  return frame + (bar ? view_->verticalScrollBar()->sizeHint().width() : 0);
}

void ScenesDock::fit_columns() {
  const QHeaderView* header = view_->header();
  const QAbstractItemView& rows = *view_;  // There its hints are public.
  int needed = 0;
  int least = 0;
  int state = 0;
  for (int column = 0; column < header->count(); ++column) {
    if (view_->isColumnHidden(column)) continue;
    int width = std::max(header->sectionSizeHint(column), header->minimumSectionSize());
    if (column == SceneModel::kState) state = width;
    if (column != SceneModel::kState) width = std::max(width, rows.sizeHintForColumn(column));
    needed += width;
    // Notes may be as long as their writer likes: they can be scrolled to.
    if (column != SceneModel::kNote) least += width;
  }
  const int shown = model_.thumbnail_width();
  const auto picture_of = [this](int width) {
    return width > 0 && model_.has_thumbnails() ? width + kThumbnailMargin : 0;
  };
  const int picture = picture_of(shown);
  // The pages beside it ask for room, too, and must not push columns out of sight.
  view_->setMinimumWidth(least - picture + beside_rows());
  int words = 0;
  for (const QString& name : model_.state_names())
    words = std::max(words, view_->fontMetrics().horizontalAdvance(name));
  const int said = std::max(0, kSign + words - state);
  needed -= picture;
  const int room = view_->width() - beside_rows();
  const auto with = [&](int width) { return needed + picture_of(width); };
  const auto take = [&](int width) {
    model_.set_state_room(view_->fontMetrics(), room - with(width) + state - kSign);
    model_.set_thumbnail_width(width);
  };
  // Every state by a word that is read whole, or by its sign alone: "us…" says nothing. Small
  // pictures go before words.
  for (const int width : kThumbnailWidths) {
    if (width > 0 && with(width) + said <= room) return take(width);
  }
  for (const int width : kThumbnailWidths) {
    if (width == 0 || with(width) <= room) return take(width);
  }
}

bool ScenesDock::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) fit_columns();
  return QDockWidget::eventFilter(watched, event);
}

void ScenesDock::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  QDockWidget::changeEvent(event);
}

void ScenesDock::retranslate() {
  model_.retranslate();
  setWindowTitle(tr("Scenes"));
  view_->setAccessibleName(tr("Scenes"));
  const auto describe = [](QAction* action, const QString& text, const QString& tip) {
    action->setText(text);
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    action->setToolTip(keys.isEmpty() ? tip : QStringLiteral("%1 (%2)").arg(tip, keys));
  };
  describe(accept_, tr("Accept"), tr("Use the selected scenes"));
  describe(reject_, tr("Reject"), tr("Leave the selected scenes out"));
  describe(insist_, tr("Use it all the same"),
           tr("Use the selected scenes although the program refused them"));
  describe(run_again_, tr("Run again"), tr("Run all stages of the selected scenes again"));
  describe(uncrop_, tr("Remove crop box"), tr("Search the whole clouds of the selected scenes"));
  describe(note_, tr("Note…"), tr("Write a note on the scene"));
  describe(up_, tr("Move up"), tr("Move the selected scenes up in the list"));
  describe(down_, tr("Move down"), tr("Move the selected scenes down in the list"));
  describe(add_, tr("Add scenes…"), tr("Add scene folders from elsewhere, several at once"));
}

}  // namespace lvcalib::widgets

#include "moc_scenes_dock.cpp"
