// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/main_actions.h"

#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenuBar>
#include <QRegularExpression>
#include <QStyle>
#include <QTimer>
#include <QToolBar>
#include <QUndoStack>

#include "runner/decision_command.h"
#include "start/app_settings.h"
#include "style/marks.h"
#include "style/theme.h"
#include "workbench/language.h"

namespace lvcalib::widgets {

MainActions::MainActions(QMainWindow& window, QUndoStack& undo_stack)
    : QObject(&window), undo_stack_(&undo_stack) {
  QMenuBar* bar = window.menuBar();
  file_ = bar->addMenu(QString());
  edit_ = bar->addMenu(QString());
  run_menu_ = bar->addMenu(QString());
  tools_ = bar->addMenu(QString());
  view_ = bar->addMenu(QString());
  help_ = bar->addMenu(QString());
  make_file_menu(window);
  undo = add(edit_, "undo", QKeySequence::Undo);
  redo = add(edit_, "redo", QKeySequence::Redo);
  connect(undo, &QAction::triggered, &undo_stack, &QUndoStack::undo);
  connect(redo, &QAction::triggered, &undo_stack, &QUndoStack::redo);
  connect(&undo_stack, &QUndoStack::indexChanged, this, &MainActions::describe_undo);
  run = add(run_menu_, "run", Qt::Key_F5);
  cancel = add(run_menu_, "cancel", Qt::Key_Escape);
  run_menu_->addSeparator();
  use_crops = add(run_menu_, "use_crops", {});
  use_crops->setCheckable(true);
  target_camera = add(tools_, "target_camera", {});
  camera_alone = add(tools_, "camera_alone", {});
  print_board = add(tools_, "print_board", {});
  correct = add(tools_, "correct_clouds", {});
  compare = add(tools_, "compare_results", {});
  check = add(tools_, "check_fresh_data", {});
  plan = add(tools_, "plan_scenes", {});
  make_view_menu(window);
  guide = add(help_, "guide", QKeySequence::HelpContents);
  about = add(help_, "about", {});
  const QStyle* style = QApplication::style();
  save->setIcon(style->standardIcon(QStyle::SP_DialogSaveButton));
  open_dataset->setIcon(style->standardIcon(QStyle::SP_DirOpenIcon));
  tool_bar = window.addToolBar(QString());
  tool_bar->setObjectName(QStringLiteral("tool_bar"));
  tool_bar->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  tool_bar->addActions({open_dataset, save});
  tool_bar->addSeparator();
  tool_bar->addActions({undo, redo});
  tool_bar->addSeparator();
  tool_bar->addActions({run, cancel, results});
  repaint_icons(window.palette());
  retranslate();
}

void MainActions::repaint_icons(const QPalette& palette) {
  run->setIcon(tool_icon(ToolIcon::kRun, palette));
  cancel->setIcon(tool_icon(ToolIcon::kStop, palette));
  undo->setIcon(tool_icon(ToolIcon::kUndo, palette));
  redo->setIcon(tool_icon(ToolIcon::kRedo, palette));
  results->setIcon(tool_icon(ToolIcon::kTable, palette));
}

QAction* MainActions::add(QMenu* menu, const char* name, const QKeySequence& keys) {
  auto* action = new QAction(this);
  action->setObjectName(QString::fromLatin1(name));
  action->setShortcut(keys);
  menu->addAction(action);
  return action;
}

void MainActions::make_file_menu(QMainWindow& window) {
  import_recording = add(file_, "import_recording", QKeySequence::New);
  import_files = add(file_, "import_files", QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_N));
  open_dataset = add(file_, "open_dataset", QKeySequence::Open);
  open_project = add(file_, "open_project", QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_O));
  recent_ = file_->addMenu(QString());
  demo = add(file_, "demo", {});
  file_->addSeparator();
  watch_dataset = add(file_, "watch_dataset", {});
  watch_files = add(file_, "watch_files", {});
  for (QAction* action : {watch_dataset, watch_files}) action->setCheckable(true);
  file_->addSeparator();
  save = add(file_, "save", QKeySequence::Save);
  save_as = add(file_, "save_as", QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_S));
  file_->addSeparator();
  results = add(file_, "results", QKeySequence(Qt::CTRL | Qt::Key_E));
  report = add(file_, "report", QKeySequence(Qt::CTRL | Qt::Key_R));
  file_->addSeparator();
  quit = add(file_, "quit", QKeySequence::Quit);
  quit->setMenuRole(QAction::QuitRole);
  connect(quit, &QAction::triggered, &window, &QWidget::close);
}

void MainActions::make_view_menu(QMainWindow& window) {
  theme_menu_ = view_->addMenu(QString());
  language_menu_ = view_->addMenu(QString());
  what_next = add(view_, "what_next", {});
  view_->addSeparator();
  themes = new QActionGroup(&window);
  for (const Theme theme : {Theme::kSystem, Theme::kLight, Theme::kDark}) {
    QAction* action = add(theme_menu_, "theme", {});
    action->setData(name_of(theme));
    action->setCheckable(true);
    themes->addAction(action);
  }
  languages = new QActionGroup(&window);
  for (const auto& [code, name] : widgets::languages()) {
    QAction* action = add(language_menu_, "language", {});
    action->setText(name);  // Each in its own language, whatever the present one.
    action->setData(code);
    action->setCheckable(true);
    languages->addAction(action);
  }
}

void MainActions::add_view_toggles(const QList<QAction*>& toggles) {
  view_->addActions(toggles);
}

void MainActions::set_recent(const QStringList& paths) {
  recent_->clear();
  for (const QString& path : paths) {
    QAction* action = recent_->addAction(QDir::toNativeSeparators(path));
    connect(action, &QAction::triggered, this, [this, path] { Q_EMIT recent_wanted(path); });
  }
  recent_->setEnabled(!paths.isEmpty());
}

void MainActions::follow(AppSettings& settings) {
  for (QAction* action : themes->actions())
    action->setChecked(action->data().toString() == name_of(settings.theme()));
  const QString code = settings.language().isEmpty() ? use_language({}) : settings.language();
  for (QAction* action : languages->actions())
    action->setChecked(action->data().toString() == code);
  connect(themes, &QActionGroup::triggered, this, [&settings](const QAction* action) {
    settings.set_theme(theme_named(action->data().toString()));
    apply_theme(*qApp, settings.theme());
  });
  connect(languages, &QActionGroup::triggered, this, [this, &settings](const QAction* action) {
    settings.set_language(action->data().toString());
    // Every word in sight is set and laid out in one turn of the event loop and drawn in the next:
    // both in one would keep the window from answering for more than a moment.
    QWidget* window = tool_bar->window();
    window->setUpdatesEnabled(false);
    use_language(settings.language());
    QTimer::singleShot(0, window, [window] { window->setUpdatesEnabled(true); });
  });
}

void MainActions::describe_undo() {
  if (undo_stack_ == nullptr) return;
  const auto words = [this](int index) {
    const auto* command = dynamic_cast<const DescribedCommand*>(undo_stack_->command(index));
    return command != nullptr ? command->description() : QString();
  };
  const int index = undo_stack_->index();
  undo->setEnabled(undo_stack_->canUndo());
  redo->setEnabled(undo_stack_->canRedo());
  undo->setText(undo->isEnabled() ? tr("&Undo: %1").arg(words(index - 1)) : tr("&Undo"));
  redo->setText(redo->isEnabled() ? tr("&Redo: %1").arg(words(index)) : tr("&Redo"));
  // The tool bar has no room for what is undone.
  undo->setIconText(tr("Undo"));
  redo->setIconText(tr("Redo"));
  for (QAction* action : {undo, redo}) {
    action->setToolTip(
        QStringLiteral("%1 (%2)").arg(action->text().remove(QLatin1Char('&')),
                                      action->shortcut().toString(QKeySequence::NativeText)));
  }
}

void MainActions::retranslate() {
  describe_undo();
  file_->setTitle(tr("&File"));
  edit_->setTitle(tr("&Edit"));
  run_menu_->setTitle(tr("&Run"));
  tools_->setTitle(tr("&Tools"));
  view_->setTitle(tr("&View"));
  help_->setTitle(tr("&Help"));
  recent_->setTitle(tr("Open &recent"));
  theme_menu_->setTitle(tr("&Colours"));
  language_menu_->setTitle(tr("&Language"));
  tool_bar->setWindowTitle(tr("Tool bar"));
  const auto describe = [](QAction* action, const QString& text, const QString& tip) {
    action->setText(text);
    // Tool buttons have no keys of their own; Chinese texts give theirs in brackets.
    static const QRegularExpression key(QStringLiteral("\\(&.\\)|&"));
    action->setIconText(QString(text).remove(key));
    const QString keys = action->shortcut().toString(QKeySequence::NativeText);
    action->setToolTip(keys.isEmpty() ? tip : QStringLiteral("%1 (%2)").arg(tip, keys));
    action->setStatusTip({});
  };
  describe(import_recording, tr("&New from recording…"),
           tr("Make a dataset of a ROS bag, rosbag2 or MCAP, and calibrate it"));
  describe(import_files, tr("New from &files…"),
           tr("Make a dataset of images and clouds that lie in folders, and calibrate it"));
  describe(open_dataset, tr("&Open dataset…"), tr("Open a dataset folder"));
  describe(open_project, tr("Open &project…"), tr("Open a .lvcalib file"));
  describe(demo, tr("Try the &demo"), tr("Simulate four scenes and open them, with a guided tour"));
  describe(watch_dataset, tr("&Watch this folder"),
           tr("New scene folders in this dataset become scenes and are solved at once"));
  describe(watch_files, tr("Watch a folder of &images and clouds…"),
           tr("What another program writes there becomes scenes of the dataset that is open, or of "
              "a new one"));
  describe(what_next, tr("What &next"),
           tr("The last scene and the next pose, large enough to be read from two metres away"));
  describe(save, tr("&Save"), tr("Save the decisions as a project"));
  describe(save_as, tr("Save &as…"), tr("Save the project under another name"));
  describe(results, tr("R&esults…"), tr("Show and export the result"));
  describe(report, tr("Repor&t…"), tr("Write the result as one HTML file with its figures"));
  describe(quit, tr("&Quit"), tr("Leave the program"));
  describe(run, tr("&Run all"), tr("Run everything that is not up to date"));
  describe(cancel, tr("&Cancel"), tr("Stop what is running"));
  describe(use_crops, tr("Use board.pcd &files"),
           tr("Take a scene's board.pcd instead of its whole cloud where there is one"));
  describe(target_camera, tr("&Target and camera…"),
           tr("Make or edit target.yaml and camera.yaml"));
  describe(camera_alone, tr("Calibrate a c&amera…"),
           tr("A camera alone, from a folder of images of the board; no dataset is needed"));
  describe(print_board, tr("&Print the board…"),
           tr("Draw the board for printing, exactly to scale"));
  describe(correct, tr("&Correct clouds…"),
           tr("Take the effects of the model in force out of clouds of this LiDAR"));
  describe(compare, tr("Compare &with…"),
           tr("The difference to another result, an earlier step, another project, or a truth"));
  describe(check, tr("C&heck on fresh data…"),
           tr("Lay the pose over images and clouds, with or without a board, and see whether their "
              "edges agree; find a rough pose by hand"));
  describe(plan, tr("Plan &scenes…"),
           tr("Where to hold the board, before it is taken out: for the board, camera and LiDAR "
              "that are open or chosen"));
  describe(guide, tr("&Guide"), tr("From the printed board to a result"));
  describe(about, tr("&About"), tr("Version and licence"));
  const QStringList names = {tr("As the &system"), tr("&Light"), tr("&Dark")};
  for (int i = 0; i < names.size(); ++i) themes->actions().at(i)->setText(names.at(i));
}

}  // namespace lvcalib::widgets

#include "moc_main_actions.cpp"
