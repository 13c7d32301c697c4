// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/main_actions.h"

#include <QApplication>
#include <QMainWindow>
#include <QMap>
#include <QMenuBar>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QUndoStack>

#include <gtest/gtest.h>

#include "start/app_settings.h"
#include "workbench/language.h"

namespace lvcalib::widgets::main_actions_test {
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

TEST(MainActions, ColoursAndLanguageAreKeptInTheSettings) {
  const QTemporaryDir folder;
  AppSettings settings(folder.path());
  settings.set_theme(Theme::kDark);
  settings.set_language("en");
  QMainWindow window;
  QUndoStack undo;
  MainActions actions(window, undo);
  actions.follow(settings);
  ASSERT_NE(actions.themes->checkedAction(), nullptr);
  EXPECT_EQ(actions.themes->checkedAction()->data().toString(), name_of(Theme::kDark));
  EXPECT_EQ(actions.languages->checkedAction()->data().toString(), "en");
  for (QAction* action : actions.themes->actions()) {
    if (action->data().toString() == name_of(Theme::kLight)) action->trigger();
  }
  for (QAction* action : actions.languages->actions()) {
    if (action->data().toString() == "zh_CN") action->trigger();
  }
  EXPECT_EQ(settings.theme(), Theme::kLight);
  EXPECT_FALSE(is_dark(qApp->palette()));
  EXPECT_EQ(settings.language(), "zh_CN");
  EXPECT_EQ(QCoreApplication::translate("lvcalib::widgets::MainActions", "&Quit"),
            QString::fromUtf8("退出(&Q)"));
  use_language("en");
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
}  // namespace lvcalib::widgets::main_actions_test
