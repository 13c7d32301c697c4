// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>

class QMainWindow;

namespace lvcalib::widgets {

class CoachMarks;
class ModelWork;
class Workspace;

/// Leads through the demo, from the first look to the fallen error.
class DemoTour : public QObject {
  Q_OBJECT

 public:
  /// All must outlive it; the window owns it.
  DemoTour(QMainWindow& window, Workspace& workspace, ModelWork& work);
  void start();
  void end();
  [[nodiscard]] CoachMarks& marks() { return *marks_; }

 private:
  QMainWindow& window_;
  Workspace& workspace_;
  ModelWork& work_;
  CoachMarks* marks_;
};

}  // namespace lvcalib::widgets
