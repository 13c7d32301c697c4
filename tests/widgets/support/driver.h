// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Helps tests to drive the window as its user does, and to watch that it never freezes.

#include <QAction>
#include <QApplication>
#include <QElapsedTimer>
#include <QLabel>
#include <QMainWindow>
#include <QTest>
#include <QTimer>
#include <QTreeView>
#include <algorithm>
#include <ctime>
#include <functional>
#include <utility>

#include "dialogs/choices.h"
#include "workbench/main_window.h"

namespace lvcalib::test {

/// Measures the largest gap between two turns of the event loop.
class Watchdog : public QObject {
 public:
  Watchdog() {
    timer_.setInterval(5);
    connect(&timer_, &QTimer::timeout, this, [this] {
      largest_ms_ = std::max(largest_ms_, clock_.restart());
      turn();
    });
    clock_.start();
    timer_.start();
  }
  /// The most that this thread itself has worked between two turns since the last call: what the
  /// gap would be on a machine that does nothing else.
  double take_busiest_ms() {
    turn();
    return std::exchange(busiest_ms_, 0.0);
  }
  /// Since the last call; at least the time since the loop last turned.
  qint64 take_largest_ms() {
    const qint64 out = std::max(largest_ms_, clock_.restart());
    largest_ms_ = 0;
    return out;
  }

 private:
  void turn() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    const double now_ms =
        1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
    busiest_ms_ = std::max(busiest_ms_, now_ms - worked_ms_);
    worked_ms_ = now_ms;
  }

  QTimer timer_;
  QElapsedTimer clock_;
  qint64 largest_ms_ = 0;
  double worked_ms_ = 0.0;
  double busiest_ms_ = 0.0;
};

/// Answers in the user's place.
class Answers : public widgets::Choices {
 public:
  QString dataset, project, save_as, export_to, transform, moved_to;
  QString recording, target, camera, camera_images, new_dataset, cloud, clouds, clouds_to,
      other_result;
  QString files, lidar;
  QStringList scenes;
  widgets::UnsavedAnswer unsaved_answer = widgets::UnsavedAnswer::kDiscard;
  bool recover_answer = false;
  int asked_unsaved = 0, asked_moved = 0, asked_recover = 0;

  QString dataset_to_open(QWidget*, const QString&) override { return dataset; }
  QString project_to_open(QWidget*, const QString&) override { return project; }
  QString project_to_save(QWidget*, const QString&) override { return save_as; }
  QStringList images;
  QStringList images_to_add(QWidget*, const QString&) override { return images; }
  QStringList scenes_to_add(QWidget*, const QString&) override { return scenes; }
  QString file_to_export(QWidget*, const QString&, const QString&) override { return export_to; }
  QString transform_to_open(QWidget*, const QString&) override { return transform; }
  QString recording_to_open(QWidget*, const QString&) override { return recording; }
  QString files_to_import(QWidget*, const QString&) override { return files; }
  QString camera_images_to_open(QWidget*, const QString&) override { return camera_images; }
  QString target_to_open(QWidget*, const QString&) override { return target; }
  QString camera_to_open(QWidget*, const QString&) override { return camera; }
  QString lidar_to_open(QWidget*, const QString&) override { return lidar; }
  QString dataset_to_make(QWidget*, const QString&) override { return new_dataset; }
  QString cloud_to_open(QWidget*, const QString&) override { return cloud; }
  QString clouds_to_open(QWidget*, const QString&) override { return clouds; }
  QString clouds_to_save(QWidget*, const QString&) override { return clouds_to; }
  QString result_to_open(QWidget*, const QString&) override { return other_result; }
  widgets::UnsavedAnswer unsaved(QWidget*, const QString&) override {
    ++asked_unsaved;
    return unsaved_answer;
  }
  QString moved_dataset(QWidget*, const QString&) override {
    ++asked_moved;
    return moved_to;
  }
  bool recover(QWidget*, const QString&) override {
    ++asked_recover;
    return recover_answer;
  }
};

/// Turns the event loop until something holds; false after the time.
inline bool wait_until(const std::function<bool()>& holds, int milliseconds = 120'000) {
  return QTest::qWaitFor(holds, milliseconds);
}

template <class T>
T* find(const QObject& parent, const char* name) {
  return parent.findChild<T*>(QString::fromLatin1(name));
}

/// Triggers an action of the window's menus as a click would; false if it is not enabled.
inline bool trigger(const QMainWindow& window, const char* name) {
  auto* action = find<QAction>(window, name);
  if (action == nullptr || !action->isEnabled()) return false;
  action->trigger();
  return true;
}

/// Clicks into a cell of the scene list: its check box or its middle.
inline void click_scene(const QMainWindow& window, const QString& name, bool check_box) {
  auto* view = find<QTreeView>(window, "scenes");
  const auto found =
      view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, name, 1, Qt::MatchExactly);
  if (found.isEmpty()) return;
  view->scrollTo(found.first());
  const QRect rect = view->visualRect(found.first());
  const QPoint at = check_box ? QPoint(rect.left() + 10, rect.center().y())
                              : QPoint(rect.right() - 4, rect.center().y());
  QTest::mouseClick(view->viewport(), Qt::LeftButton, Qt::NoModifier, at);
}

/// Text of a cell of the scene list; of a state that a narrow list shows by its sign, the words.
inline QString cell(const QMainWindow& window, const QString& scene, int column) {
  const auto* view = find<QTreeView>(window, "scenes");
  const auto found =
      view->model()->match(view->model()->index(0, 0), Qt::DisplayRole, scene, 1, Qt::MatchExactly);
  if (found.isEmpty()) return {};
  const QModelIndex at = view->model()->index(found.first().row(), column);
  const QString said = at.data(Qt::AccessibleTextRole).toString();
  return said.isEmpty() ? at.data().toString() : said;
}

/// Waits until a window is idle and its result answers its decisions.
inline bool wait_for_result(widgets::MainWindow& window) {
  return wait_until([&] {
    return !window.workspace().busy() && window.workspace().result() &&
           window.workspace().up_to_date();
  });
}

}  // namespace lvcalib::test
