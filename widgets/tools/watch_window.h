// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>

#include "runner/plan_work.h"
#include "runner/watch_work.h"

class QLabel;
class QPushButton;

namespace lvcalib::widgets {

class BoardSketch;
class LargeText;
class Workspace;

/// For whoever holds the board, two metres away: how many scenes there are, whether the last one
/// was taken or why not, how sure the extrinsic is, and where to hold the board next. Follows the
/// workspace and the watch by itself.
class WatchWindow : public QWidget {
  Q_OBJECT

 public:
  /// Both must outlive it.
  WatchWindow(Workspace& workspace, WatchWork& watch, QWidget* parent = nullptr);
  ~WatchWindow() override;

  /// The next pose is being looked for.
  [[nodiscard]] bool busy() const { return plan_.busy(); }
  /// The pose that is shown; nothing while it is looked for, or if there is none.
  [[nodiscard]] const std::optional<GridPose>& nextPose() const { return next_; }

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void build();
  void connectParts();
  void retranslate();
  void askNext();
  void showAll();
  void showNext();
  void showFullScreenWanted(bool full);
  // One sentence about the last scene, and whether it is good news.
  struct News {
    QString text;
    std::optional<bool> good;
  };
  [[nodiscard]] News news() const;
  [[nodiscard]] QString pendingText() const;
  // In total: by noise alone four scenes are soon sure, whatever the intrinsics do to them.
  [[nodiscard]] QString sigmaText() const;
  [[nodiscard]] bool sureEnough() const;

  enum class Last { kNone, kSolving, kSolved, kRefused };
  Workspace& workspace_;
  WatchWork& watch_;
  Last last_ = Last::kNone;
  QString last_name_;
  Message last_reason_;             // Why a pair was left, as the core says it.
  std::optional<Error> no_result_;  // Of the last run.
  std::optional<Error> no_plan_;
  std::optional<GridPose> next_;

  LargeText* scenes_;
  LargeText* news_;
  LargeText* sigma_;
  LargeText* pose_;
  BoardSketch* sketch_;
  QLabel* pending_;
  QPushButton* full_;
  QPushButton* stop_;
  PlanWork plan_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
