// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QFrame>
#include <QPointer>
#include <QString>
#include <QTimer>
#include <functional>
#include <vector>

class QLabel;
class QPushButton;

namespace lvcalib::widgets {

/// One thing that a tour points at.
struct CoachMark {
  QString text;
  /// What it points at; null as long as that is not there. Called again and again.
  std::function<QWidget*()> target;
  /// True once the user has done what the text says; empty: "Next" is what goes on.
  std::function<bool()> done;
  /// `done` is not the user's doing (something is computed): then "Next" becomes possible, and the
  /// reader goes on when they have read.
  bool reader_goes_on = false;
  /// What else the text speaks of: the bubble lies over none of it.
  std::function<std::vector<QWidget*>()> also = {};
  /// What it says in place of `text` once `done` is true; empty: the same.
  QString text_when_done = {};
};

/// A small speech bubble that leads through a window: it frames a widget, says what to do there,
/// and goes on when that is done, or with "Next". What is done before it could be read waits for
/// "Next", too. The bubble stands beside what it explains and takes no input from the rest of the
/// window and can be closed at any time.
class CoachMarks : public QFrame {
  Q_OBJECT

 public:
  /// How often it looks whether a mark is done.
  static constexpr int kLookMs = 200;

  explicit CoachMarks(QWidget* window);
  ~CoachMarks() override;
  void start(std::vector<CoachMark> marks);
  void end();
  /// Index of the mark shown; −1 if none is.
  [[nodiscard]] int current() const { return current_; }

 Q_SIGNALS:
  void ended();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void show_mark(int index);
  void look();
  void say(const CoachMark& mark, bool done);
  void place();
  [[nodiscard]] QRect on_window(const QWidget& widget) const;
  void retranslate();

  class Frame;
  std::vector<CoachMark> marks_;
  int current_ = -1;
  bool reader_goes_on_ = false;
  QTimer timer_;
  QLabel* text_;
  QLabel* count_;
  QPushButton* next_;
  QPushButton* close_;
  QPointer<Frame> frame_;
};

}  // namespace lvcalib::widgets
