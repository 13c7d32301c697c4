// SPDX-License-Identifier: GPL-3.0-or-later
// Random clicks, keys, menus and drops on a window with a rig in it. LVCALIB_MONKEY_ACTIONS says
// how many on each rig (by night: 5000); LVCALIB_MONKEY_SEED, with which random numbers. Rigs
// besides the demo lie in the folder that LVCALIB_SHARED_DATA names.
#include <QContextMenuEvent>
#include <QDialog>
#include <QDropEvent>
#include <QFileDialog>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QTemporaryDir>
#include <QTimer>
#include <QWheelEvent>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "runner/demo.h"
#include "support/shared_data.h"
#include "widgets/support/driver.h"

namespace lvcalib::monkey_test {
namespace {

namespace fs = std::filesystem;
using widgets::MainWindow;

// Clicks, wheels, drags, types, drops and chooses at random in whatever window is on top.
class Monkey {
 public:
  Monkey(MainWindow& window, unsigned seed) : window_(window), random_(seed) {}

  // What may be dropped on the window.
  void set_files(QStringList files) { files_ = std::move(files); }

  // Returns what was done, for a report.
  QString act() {
    QWidget* top = target();
    const QPoint at(number(top->width()), number(top->height()));
    QWidget* child = top->childAt(at);
    QPointer<QWidget> widget = child != nullptr ? child : top;
    const QPoint local = widget->mapFrom(top, at);
    const QString where = QStringLiteral("%1 '%2'").arg(
        QLatin1String(widget->metaObject()->className()), widget->objectName());
    switch (number(20)) {
      case 0:
      case 1:
      case 2:
      case 3:
      case 4:
      case 5:
        QTest::mouseClick(widget, Qt::LeftButton, Qt::NoModifier, local);
        return QStringLiteral("click on ") + where;
      case 6:
      case 7:
        QTest::mouseDClick(widget, Qt::LeftButton, Qt::NoModifier, local);
        return QStringLiteral("double click on ") + where;
      case 8:
      case 9:
        drag(widget, local);
        return QStringLiteral("drag on ") + where;
      case 10:
        return turn(*widget, local, where);
      case 11: {
        QContextMenuEvent event(QContextMenuEvent::Mouse, local, widget->mapToGlobal(local));
        QApplication::sendEvent(widget, &event);
        return QStringLiteral("context menu of ") + where;
      }
      case 12:
        return choose();
      case 13:
        // Seldom: what it opens takes the place of the rig.
        if (number(12) == 0) return drop();
        [[fallthrough]];
      default:
        return type();
    }
  }

 private:
  int number(int below) {
    return std::uniform_int_distribution<int>(0, std::max(0, below - 1))(random_);
  }

  QWidget* target() {
    if (QWidget* popup = QApplication::activePopupWidget()) return popup;
    if (QWidget* modal = QApplication::activeModalWidget()) return modal;
    const auto dialogs = window_.findChildren<QDialog*>();
    for (QDialog* dialog : dialogs) {
      if (dialog->isVisible() && number(2) == 0) return dialog;
    }
    return &window_;
  }

  // What is pressed may be gone before it is released.
  void drag(const QPointer<QWidget>& widget, QPoint from) {
    const auto modifiers = number(4) == 0 ? Qt::ShiftModifier : Qt::NoModifier;
    const QPoint to = from + QPoint(number(160) - 80, number(160) - 80);
    QTest::mousePress(widget, Qt::LeftButton, modifiers, from);
    if (widget != nullptr) QTest::mouseMove(widget, from + (to - from) / 2);
    if (widget != nullptr) QTest::mouseMove(widget, to);
    if (widget != nullptr) QTest::mouseRelease(widget, Qt::LeftButton, modifiers, to);
  }

  QString turn(QWidget& widget, QPoint at, const QString& where) {
    QWheelEvent event(at, widget.mapToGlobal(at), {}, QPoint(0, number(2) == 0 ? 120 : -120),
                      Qt::NoButton, number(4) == 0 ? Qt::ControlModifier : Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&widget, &event);
    return QStringLiteral("wheel on ") + where;
  }

  // Anything that a menu or a key could start, whether it lies within sight or not.
  QString choose() {
    std::vector<QAction*> actions;
    for (QAction* action : window_.findChildren<QAction*>()) {
      if (action->isEnabled() && !action->isSeparator() && action->menu() == nullptr &&
          !action->objectName().isEmpty())
        actions.push_back(action);
    }
    if (actions.empty()) return {};
    QAction* action = actions[static_cast<std::size_t>(number(static_cast<int>(actions.size())))];
    const QString name = action->objectName();
    action->trigger();
    return QStringLiteral("action ") + name;
  }

  QString drop() {
    if (files_.isEmpty()) return {};
    QMimeData data;
    QList<QUrl> urls;
    for (int n = 1 + number(2); n > 0; --n)
      urls << QUrl::fromLocalFile(files_[number(static_cast<int>(files_.size()))]);
    data.setUrls(urls);
    QDropEvent event(QPointF(40, 40), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    // Without a platform's drag there is no drop target for sendEvent() to find.
    static_cast<QObject&>(window_).event(&event);
    return QStringLiteral("drop of ") + urls.first().toString();
  }

  QString type() {
    static const std::vector<std::pair<Qt::Key, Qt::KeyboardModifiers>> keys = {
        {Qt::Key_F5, {}},
        {Qt::Key_F1, {}},
        {Qt::Key_Escape, {}},
        {Qt::Key_Space, {}},
        {Qt::Key_Up, {}},
        {Qt::Key_Down, {}},
        {Qt::Key_Left, {}},
        {Qt::Key_Right, {}},
        {Qt::Key_Plus, {}},
        {Qt::Key_C, {}},
        {Qt::Key_L, {}},
        {Qt::Key_R, {}},
        {Qt::Key_B, {}},
        {Qt::Key_Tab, {}},
        {Qt::Key_5, {}},
        {Qt::Key_Delete, {}},
        {Qt::Key_Return, {}},
        {Qt::Key_Home, {}},
        {Qt::Key_Z, Qt::ControlModifier},
        {Qt::Key_Y, Qt::ControlModifier},
        {Qt::Key_J, Qt::ControlModifier},
        {Qt::Key_U, Qt::ControlModifier},
        {Qt::Key_1, Qt::ControlModifier},
        {Qt::Key_2, Qt::ControlModifier},
        {Qt::Key_3, Qt::ControlModifier},
        {Qt::Key_4, Qt::ControlModifier},
        {Qt::Key_5, Qt::ControlModifier},
        {Qt::Key_E, Qt::ControlModifier},
        {Qt::Key_A, Qt::ControlModifier},
        {Qt::Key_S, Qt::ControlModifier},
        {Qt::Key_F5, Qt::ShiftModifier}};
    const auto& [key, modifiers] =
        keys[static_cast<std::size_t>(number(static_cast<int>(keys.size())))];
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus != nullptr ? focus : target(), key, modifiers);
    return QStringLiteral("key ") + QKeySequence(static_cast<int>(modifiers) | key).toString();
  }

  MainWindow& window_;
  std::mt19937 random_;
  QStringList files_;
};

// The slowest answers of the window and what they were answers to.
class Slowest {
 public:
  void add(qint64 gap_ms, const QString& what) {
    ++all_;
    if (gap_ms > kAnswer_ms) ++late_;
    found_.emplace_back(gap_ms, what);
    std::sort(found_.begin(), found_.end(),
              [](const auto& a, const auto& b) { return a.first > b.first; });
    if (found_.size() > 8) found_.pop_back();
  }
  void print(const std::string& rig) const {
    std::cout << rig << ": " << late_ << " of " << all_ << " actions answered later than "
              << kAnswer_ms << " ms\n";
    for (const auto& [gap, what] : found_)
      std::cout << "  " << gap << " ms: " << what.toStdString() << '\n';
  }

 private:
  static constexpr qint64 kAnswer_ms = 100;
  std::vector<std::pair<qint64, QString>> found_;
  int all_ = 0, late_ = 0;
};

int number_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::max(1, std::atoi(text)) : otherwise;
}

class MonkeyTest : public ::testing::TestWithParam<const char*> {
 protected:
  // A copy of a rig that this project did not make: what the monkey breaks is its own.
  std::optional<fs::path> copy_of(const std::string& rig) const {
    std::error_code code;
    const fs::path copy = folder() / fs::path(rig).filename();
    fs::copy(test::shared_rig(rig), copy, fs::copy_options::recursive, code);
    return code ? std::nullopt : std::optional(copy);
  }
  [[nodiscard]] fs::path folder() const { return folder_.path().toStdString(); }

  QTemporaryDir folder_;
};

TEST_P(MonkeyTest, RandomActionsDoNoHarm) {
  const std::string rig = GetParam();
  const bool is_demo = rig == "demo";
  const int actions = number_from("LVCALIB_MONKEY_ACTIONS", is_demo ? 1000 : 300);
  std::optional<fs::path> dataset;
  if (!is_demo) {
    dataset = copy_of(rig);
    if (!dataset) GTEST_SKIP() << rig << " not found; set LVCALIB_SHARED_DATA to the data folder";
  }
  // What is saved by a relative name lands among what goes with the test.
  const fs::path before = fs::current_path();
  fs::current_path(folder());
  widgets::AppSettings settings(folder_.filePath("settings"));
  test::Answers answers;
  answers.save_as = folder_.filePath("monkey.lvcalib");
  answers.export_to = folder_.filePath("monkey.yaml");
  answers.clouds_to = folder_.filePath("corrected");
  answers.new_dataset = folder_.filePath("made");
  simulation::SimulationOptions demo;
  demo.seed = 5;
  demo.lidar.points = 40'000;
  demo.image.width_px = 640;
  demo.image.height_px = 400;
  {
    MainWindow window(settings, answers);
    window.set_demo(demo);
    window.show();
    if (is_demo) {
      test::trigger(window, "demo");
    } else {
      window.open(QString::fromStdString(dataset->string()));
    }
    ASSERT_TRUE(test::wait_until(
        [&] { return window.workspace().is_open() && !window.workspace().busy(); }));
    answers.dataset = QString::fromStdString(window.workspace().dataset().path.string());
    const fs::path scene = window.workspace().dataset().scenes.front().cloud.parent_path();
    Monkey monkey(window, static_cast<unsigned>(number_from("LVCALIB_MONKEY_SEED", 20)));
    QStringList files = {answers.dataset, QString::fromStdString(scene.string()),
                         folder_.filePath("monkey.yaml"), QStringLiteral("/nowhere")};
    for (const auto& entry : fs::directory_iterator(scene))
      files << QString::fromStdString(entry.path().string());
    monkey.set_files(files);
    test::Watchdog watchdog;
    Slowest slowest;
    // A tool button shows its menu, and a figure its file dialog, in a loop of its own, which keeps
    // the press from returning: they are closed from within that loop.
    bool acting = false;
    QTimer closer;
    QObject::connect(&closer, &QTimer::timeout, &closer, [&] {
      if (!acting) return;
      if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
      if (auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget()))
        dialog->reject();
    });
    closer.start(50);
    for (int i = 0; i < actions; ++i) {
      watchdog.take_largest_ms();
      acting = true;
      const QString what = monkey.act();
      QCoreApplication::processEvents();
      acting = false;
      slowest.add(watchdog.take_largest_ms(), what);
      if (i % 20 == 0) QTest::qWait(30);
      // Now and then work that was begun is let go on, so that pages show what it found.
      if (i % 250 == 249) test::wait_until([&] { return !window.workspace().busy(); }, 5'000);
      window.show();  // It may have closed the window.
    }
    slowest.print(rig);
    while (QWidget* popup = QApplication::activePopupWidget()) popup->close();
    // The window still works.
    for (QDialog* dialog : window.findChildren<QDialog*>()) dialog->close();
    test::trigger(window, "cancel");
    window.open(answers.dataset);
    ASSERT_TRUE(test::wait_until([&] { return !window.workspace().busy(); }, 300'000));
    ASSERT_TRUE(test::trigger(window, "run"));
    EXPECT_TRUE(test::wait_until([&] { return !window.workspace().busy(); }, 600'000));
  }
  EXPECT_TRUE(widgets::Runner::wait_for_workers(120'000));
  fs::current_path(before);
}

std::string short_name(const ::testing::TestParamInfo<const char*>& info) {
  std::string name = fs::path(info.param).filename();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Rigs, MonkeyTest,
                         ::testing::Values("demo", "simulated/walk-rosette",
                                           "simulated/mystery-rosette", "simulated/clean-avia",
                                           "real/vlp16-checkerboard"),
                         short_name);

}  // namespace
}  // namespace lvcalib::monkey_test
