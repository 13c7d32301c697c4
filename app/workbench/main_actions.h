// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QObject>
#include <QPointer>
#include <QUndoStack>
#include <vector>

class QMainWindow;
class QToolBar;

namespace lvcalib::widgets {

class AppSettings;

/// Menus, tool bar and actions of the main window; what they do is connected by the window.
class MainActions : public QObject {
  Q_OBJECT

 public:
  /// Fills the window's menu bar and adds a tool bar.
  MainActions(QMainWindow& window, QUndoStack& undo_stack);
  /// Texts in the present language.
  void retranslate();
  /// Icons in the colours of a palette.
  void repaint_icons(const QPalette& palette);
  /// Adds what shows and hides docks and tool bars to the View menu.
  void add_view_toggles(const QList<QAction*>& toggles);
  void set_recent(const QStringList& paths);
  /// Shows the settings' colours and language, and changes them as the user chooses. The settings
  /// must outlive this.
  void follow(AppSettings& settings);

  QAction *import_recording, *import_files, *open_dataset, *open_project, *demo, *save, *save_as,
      *results, *report, *quit;
  QAction *watch_dataset, *watch_files, *what_next;
  QAction *target_camera, *camera_alone, *print_board, *correct, *compare, *plan, *check;
  QAction *undo, *redo, *run, *cancel, *use_crops, *guide, *about;
  QActionGroup* themes;     ///< data(): name_of(Theme).
  QActionGroup* languages;  ///< data(): code of the language.
  QToolBar* tool_bar;

 Q_SIGNALS:
  void recent_wanted(const QString& path);

 private:
  QAction* add(QMenu* menu, const char* name, const QKeySequence& keys);
  void make_file_menu(QMainWindow& window);
  void make_view_menu(QMainWindow& window);
  void describe_undo();

  QPointer<QUndoStack> undo_stack_;
  QMenu *file_, *edit_, *run_menu_, *tools_, *view_, *help_, *recent_, *theme_menu_,
      *language_menu_;
};

}  // namespace lvcalib::widgets
