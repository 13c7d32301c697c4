// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/scenes_dock.h"

#include <QAction>
#include <QEvent>
#include <QHeaderView>
#include <QSortFilterProxyModel>
#include <QToolBar>
#include <QTreeView>
#include <QVBoxLayout>

#include "models/scene_model.h"
#include "style/texts.h"

namespace lvcalib::widgets {

ScenesDock::ScenesDock(SceneModel& model, QWidget* parent)
    : QDockWidget(parent),
      model_(model),
      sorted_(new QSortFilterProxyModel(this)),
      view_(new QTreeView(this)),
      bar_(new QToolBar(this)) {
  setObjectName(QStringLiteral("scenes_dock"));
  follow_language_in_title(*this);
  auto* body = new QWidget(this);
  auto* layout = new QVBoxLayout(body);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  make_view(model);
  make_actions();
  layout->addWidget(view_);
  layout->addWidget(bar_);
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
  view_->sortByColumn(SceneModel::kName, Qt::AscendingOrder);
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
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &ScenesDock::update_actions);
  connect(&model, &QAbstractItemModel::modelReset, this, &ScenesDock::update_actions);
  connect(&model, &QAbstractItemModel::dataChanged, this, &ScenesDock::update_actions);
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
    bar_->addAction(action);
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
  bar_->removeAction(uncrop_);
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

void ScenesDock::update_actions() {
  const bool any = !selected().isEmpty();
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
  describe(add_, tr("Add scenes…"), tr("Add scene folders from elsewhere"));
}

}  // namespace lvcalib::widgets
