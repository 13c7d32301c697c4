// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/main_actions.h"

#include <QMainWindow>
#include <QMap>
#include <QMenuBar>
#include <QSignalSpy>
#include <QUndoStack>

#include <gtest/gtest.h>

namespace lvcalib::widgets {
namespace {

TEST(MainActions, EveryActionHasTextAndNoShortcutIsTakenTwice) {
  QMainWindow window;
  QUndoStack undo;
  const MainActions actions(window, undo);
  QMap<QString, QString> taken;
  for (const QAction* action : actions.findChildren<QAction*>()) {
    if (action->isSeparator() || action->menu() != nullptr) continue;
    EXPECT_FALSE(action->text().isEmpty()) << action->objectName().toStdString();
    EXPECT_FALSE(action->iconText().contains('&')) << action->objectName().toStdString();
    const QString keys = action->shortcut().toString();
    if (keys.isEmpty()) continue;
    EXPECT_FALSE(taken.contains(keys)) << keys.toStdString();
    taken[keys] = action->text();
  }
  EXPECT_TRUE(taken.contains("F5"));
  EXPECT_TRUE(taken.contains("Esc"));
  for (const QAction* menu : window.menuBar()->actions())
    EXPECT_TRUE(menu->text().contains('&')) << "no key for " << menu->text().toStdString();
}

TEST(MainActions, RecentPathsAskToBeOpened) {
  QMainWindow window;
  QUndoStack undo;
  MainActions actions(window, undo);
  QSignalSpy wanted(&actions, &MainActions::recent_wanted);
  actions.set_recent({"/a", "/b"});
  for (QMenu* menu : window.findChildren<QMenu*>()) {
    for (QAction* action : menu->actions()) {
      if (action->text() == "/b") action->trigger();
    }
  }
  ASSERT_EQ(wanted.count(), 1);
  EXPECT_EQ(wanted.first().first().toString(), "/b");
}

}  // namespace
}  // namespace lvcalib::widgets
