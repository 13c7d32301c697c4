// SPDX-License-Identifier: GPL-3.0-or-later
#include <QDialog>
#include <QMenu>
#include <QTemporaryDir>
#include <QTimer>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "runner/demo.h"
#include "widgets/support/driver.h"

namespace lvcalib::monkey_test {
namespace {

using widgets::MainWindow;

// Clicks, wheels and types at random places of whatever window is on top.
class Monkey {
 public:
  Monkey(MainWindow& window, unsigned seed) : window_(window), random_(seed) {}

  void act() {
    QWidget* top = target();
    const QPoint at(number(top->width()), number(top->height()));
    QWidget* child = top->childAt(at);
    QWidget* widget = child != nullptr ? child : top;
    const QPoint local = widget->mapFrom(top, at);
    switch (number(8)) {
      case 0:
      case 1:
      case 2:
        QTest::mouseClick(widget, Qt::LeftButton, Qt::NoModifier, local);
        break;
      case 3:
        QTest::mouseDClick(widget, Qt::LeftButton, Qt::NoModifier, local);
        break;
      case 4:
        drag(*widget, local);
        break;
      default:
        type();
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

  void drag(QWidget& widget, QPoint from) {
    QTest::mousePress(&widget, Qt::LeftButton, Qt::NoModifier, from);
    QTest::mouseMove(&widget, from + QPoint(number(60) - 30, number(60) - 30));
    QTest::mouseRelease(&widget, Qt::LeftButton, Qt::NoModifier,
                        from + QPoint(number(60) - 30, number(60) - 30));
  }

  void type() {
    static const std::vector<std::pair<Qt::Key, Qt::KeyboardModifiers>> keys = {
        {Qt::Key_F5, {}},
        {Qt::Key_Escape, {}},
        {Qt::Key_Space, {}},
        {Qt::Key_Up, {}},
        {Qt::Key_Down, {}},
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
        {Qt::Key_E, Qt::ControlModifier},
        {Qt::Key_A, Qt::ControlModifier},
        {Qt::Key_S, Qt::ControlModifier},
        {Qt::Key_F5, Qt::ShiftModifier}};
    const auto& [key, modifiers] =
        keys[static_cast<std::size_t>(number(static_cast<int>(keys.size())))];
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus != nullptr ? focus : target(), key, modifiers);
  }

  MainWindow& window_;
  std::mt19937 random_;
};

TEST(MonkeyTest, AThousandRandomActionsDoNoHarm) {
  QTemporaryDir folder;
  widgets::AppSettings settings(folder.path());
  test::Answers answers;
  answers.save_as = folder.filePath("monkey.lvcalib");
  answers.export_to = folder.filePath("monkey.yaml");
  simulation::SimulationOptions demo;
  demo.seed = 5;
  demo.lidar.points = 40'000;
  demo.image.width_px = 640;
  demo.image.height_px = 400;
  {
    MainWindow window(settings, answers);
    window.set_demo(demo);
    window.show();
    test::trigger(window, "demo");
    ASSERT_TRUE(test::wait_until(
        [&] { return window.workspace().is_open() && !window.workspace().busy(); }));
    answers.dataset = QString::fromStdString(window.workspace().dataset().path.string());
    Monkey monkey(window, 20);
    test::Watchdog watchdog;
    qint64 largest_ms = 0;
    // A tool button shows its menu in a loop of its own, which keeps the press from returning:
    // the menu is closed from within that loop.
    bool acting = false;
    QTimer closer;
    QObject::connect(&closer, &QTimer::timeout, &closer, [&] {
      QWidget* popup = QApplication::activePopupWidget();
      if (acting && popup != nullptr) popup->close();
    });
    closer.start(50);
    for (int i = 0; i < 1000; ++i) {
      acting = true;
      monkey.act();
      acting = false;
      QCoreApplication::processEvents();
      if (i % 20 == 0) QTest::qWait(30);
      window.show();  // It may have closed the window.
      largest_ms = std::max(largest_ms, watchdog.take_largest_ms());
    }
    std::cout << "largest gap: " << largest_ms << " ms\n";
    while (QWidget* popup = QApplication::activePopupWidget()) popup->close();
    // The window still works.
    for (QDialog* dialog : window.findChildren<QDialog*>()) dialog->close();
    window.open(answers.dataset);
    ASSERT_TRUE(test::wait_until([&] { return !window.workspace().busy(); }));
    ASSERT_TRUE(test::trigger(window, "run"));
    EXPECT_TRUE(test::wait_until([&] { return !window.workspace().busy(); }));
  }
  EXPECT_TRUE(widgets::Runner::wait_for_workers(60'000));
}

}  // namespace
}  // namespace lvcalib::monkey_test
