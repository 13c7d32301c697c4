// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

class QAction;

namespace lvcalib::widgets {

/// Tools side by side, on as many lines as the width needs, so that none hides behind an arrow as
/// in a QToolBar. A tool's shortcut belongs to its button: keys pressed in a list beside it are the
/// list's.
class ToolRow : public QWidget {
  Q_OBJECT

 public:
  explicit ToolRow(QWidget* parent = nullptr);

  /// A button for an action of someone else, seen as long as the action is visible.
  void addTool(QAction* action);
  /// A new action, owned by the row, with its button.
  QAction* newTool();
  void addWidget(QWidget* widget);
  void addSeparator();
};

}  // namespace lvcalib::widgets
