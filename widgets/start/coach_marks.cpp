// SPDX-License-Identifier: GPL-3.0-or-later
#include "start/coach_marks.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

namespace lvcalib::widgets {
namespace {

constexpr int kWidth = 320;
constexpr int kGap = 10;

// Where a bubble covers the least of what it must not: below, above, right or left of the first
// rectangle, at either end of its edge, and beside the others; what is as large as the window has
// it in a corner.
QPoint free_corner(const QSize& size, const QRect& room, const std::vector<QRect>& clear) {
  std::vector<QPoint> places;
  for (const QRect& at : clear) {
    const int below = at.bottom() + kGap;
    const int above = at.top() - kGap - size.height();
    const int right = at.right() + kGap;
    const int left = at.left() - kGap - size.width();
    const int last_x = at.right() + 1 - size.width();
    const int last_y = at.bottom() + 1 - size.height();
    for (const QPoint& place :
         {QPoint(at.left(), below), QPoint(at.left(), above), QPoint(right, at.top()),
          QPoint(left, at.top()), QPoint(last_x, below), QPoint(last_x, above),
          QPoint(right, last_y), QPoint(left, last_y)})
      places.push_back(place);
  }
  places.emplace_back(room.right() - size.width() - kGap, clear.front().top() + kGap);
  QPoint best;
  int least = -1;
  for (const QPoint& place : places) {
    const QPoint inside(std::clamp(place.x(), 0, std::max(0, room.width() - size.width())),
                        std::clamp(place.y(), 0, std::max(0, room.height() - size.height())));
    const QRect bubble(inside, size);
    int covered = 0;
    for (const QRect& rect : clear) {
      const QRect common = bubble.intersected(rect);
      if (!common.isEmpty()) covered += common.width() * common.height();
    }
    if (least >= 0 && covered >= least) continue;
    least = covered;
    best = inside;
    if (covered == 0) break;
  }
  return best;
}

}  // namespace

// A frame about the target that lets every event through.
class CoachMarks::Frame : public QWidget {
 public:
  explicit Frame(QWidget* window) : QWidget(window) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setObjectName(QStringLiteral("coach_frame"));
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette().color(QPalette::Highlight), 3.0));
    painter.drawRoundedRect(QRectF(rect()).adjusted(2, 2, -2, -2), 6, 6);
  }
};

CoachMarks::CoachMarks(QWidget* window)
    : QFrame(window),
      text_(new QLabel(this)),
      count_(new QLabel(this)),
      next_(new QPushButton(this)),
      close_(new QPushButton(this)),
      frame_(new Frame(window)) {
  setObjectName(QStringLiteral("coach_marks"));
  setFrameShape(QFrame::StyledPanel);
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::ToolTipBase);
  setForegroundRole(QPalette::ToolTipText);
  setFixedWidth(kWidth);
  text_->setWordWrap(true);
  text_->setForegroundRole(QPalette::ToolTipText);
  count_->setForegroundRole(QPalette::PlaceholderText);
  next_->setObjectName(QStringLiteral("coach_next"));
  close_->setObjectName(QStringLiteral("coach_close"));
  auto* row = new QHBoxLayout;
  row->addWidget(count_);
  row->addStretch();
  row->addWidget(close_);
  row->addWidget(next_);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(text_);
  layout->addLayout(row);
  connect(next_, &QPushButton::clicked, this, [this] { show_mark(current_ + 1); });
  connect(close_, &QPushButton::clicked, this, &CoachMarks::end);
  timer_.setInterval(kLookMs);
  connect(&timer_, &QTimer::timeout, this, &CoachMarks::look);
  window->installEventFilter(this);
  retranslate();
  hide();
  frame_->hide();
}

CoachMarks::~CoachMarks() {
  delete frame_;
}

void CoachMarks::start(std::vector<CoachMark> marks) {
  marks_ = std::move(marks);
  timer_.start();
  show_mark(0);
}

void CoachMarks::end() {
  if (current_ < 0) return;
  current_ = -1;
  timer_.stop();
  hide();
  if (frame_) frame_->hide();
  Q_EMIT ended();
}

void CoachMarks::show_mark(int index) {
  if (index >= static_cast<int>(marks_.size())) {
    end();
    return;
  }
  current_ = index;
  const CoachMark& mark = marks_[static_cast<std::size_t>(index)];
  const bool last = index + 1 == static_cast<int>(marks_.size());
  count_->setText(QStringLiteral("%1/%2").arg(index + 1).arg(marks_.size()));
  const bool done = mark.done && mark.done();
  say(mark, done);
  reader_goes_on_ = !mark.done || mark.reader_goes_on || done;
  next_->setVisible(reader_goes_on_);
  next_->setEnabled(!mark.done || done);
  next_->setText(last ? tr("Done") : tr("Next"));
  close_->setVisible(!last);
  place();
}

void CoachMarks::look() {
  if (current_ < 0) return;
  const CoachMark& mark = marks_[static_cast<std::size_t>(current_)];
  const bool done = mark.done && mark.done();
  if (done && !reader_goes_on_) {
    show_mark(current_ + 1);
    return;
  }
  next_->setEnabled(done || !mark.done);
  say(mark, done);
  place();
}

void CoachMarks::say(const CoachMark& mark, bool done) {
  text_->setText(done && !mark.text_when_done.isEmpty() ? mark.text_when_done : mark.text);
}

QRect CoachMarks::on_window(const QWidget& widget) const {
  return {widget.mapTo(parentWidget(), QPoint(0, 0)), widget.size()};
}

// Beside the target, where there is room in the window and nothing that the text speaks of.
void CoachMarks::place() {
  QWidget* window = parentWidget();
  const CoachMark* mark = current_ < 0 ? nullptr : &marks_[static_cast<std::size_t>(current_)];
  const QWidget* target = mark != nullptr ? mark->target() : nullptr;
  const bool there = target != nullptr && target->isVisible();
  setVisible(there);
  if (frame_) frame_->setVisible(there);
  if (!there) return;
  const QRect at = on_window(*target);
  std::vector<QRect> clear = {at};
  if (mark->also) {
    for (const QWidget* widget : mark->also()) {
      if (widget != nullptr && widget->isVisible()) clear.push_back(on_window(*widget));
    }
  }
  adjustSize();
  const QSize size(kWidth, std::max(sizeHint().height(), heightForWidth(kWidth)));
  resize(size);
  move(free_corner(size, window->rect(), clear));
  if (frame_) {
    frame_->setGeometry(at.adjusted(-3, -3, 3, 3));
    frame_->raise();
  }
  raise();
}

bool CoachMarks::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && current_ >= 0) place();
  return QFrame::eventFilter(watched, event);
}

void CoachMarks::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  QFrame::changeEvent(event);
}

void CoachMarks::retranslate() {
  close_->setText(tr("End the tour"));
}

}  // namespace lvcalib::widgets

#include "moc_coach_marks.cpp"
