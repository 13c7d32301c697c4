// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QPointer>

#include "start/coach_marks.h"

class QMainWindow;

namespace lvcalib::widgets {

class ModelWork;
class Workspace;

/// Leads through the demo, from the first look to the fallen error.
class DemoTour : public QObject {
  Q_OBJECT

 public:
  /// All must outlive it; the window owns it.
  DemoTour(QMainWindow& window, Workspace& workspace, ModelWork& work);
  /// Takes its marks away: they ask it where they stand.
  ~DemoTour() override;
  void start();
  void end();

 private:
  QMainWindow& window_;
  Workspace& workspace_;
  ModelWork& work_;
  QPointer<CoachMarks> marks_;  // The window's, which may go first.
};

}  // namespace lvcalib::widgets
