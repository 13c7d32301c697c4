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
  text_->setText(mark.text);
  count_->setText(QStringLiteral("%1/%2").arg(index + 1).arg(marks_.size()));
  next_->setVisible(!mark.done || mark.reader_goes_on);
  next_->setEnabled(!mark.done || mark.done());
  next_->setText(last ? tr("Done") : tr("Next"));
  close_->setVisible(!last);
  place();
}

void CoachMarks::look() {
  if (current_ < 0) return;
  const CoachMark& mark = marks_[static_cast<std::size_t>(current_)];
  const bool done = mark.done && mark.done();
  if (done && !mark.reader_goes_on) {
    show_mark(current_ + 1);
    return;
  }
  next_->setEnabled(done || !mark.done);
  place();
}

// Beside the target, where there is room in the window.
void CoachMarks::place() {
  QWidget* window = parentWidget();
  QWidget* target = current_ < 0 ? nullptr : marks_[static_cast<std::size_t>(current_)].target();
  const bool there = target != nullptr && target->isVisible();
  setVisible(there);
  if (frame_) frame_->setVisible(there);
  if (!there) return;
  const QRect at(target->mapTo(window, QPoint(0, 0)), target->size());
  adjustSize();
  const QSize size(kWidth, std::max(sizeHint().height(), heightForWidth(kWidth)));
  resize(size);
  // Below, above, right or left of it, wherever it fits; what is as large as the window has the
  // bubble in a corner of its own.
  const QPoint places[] = {{at.left(), at.bottom() + kGap},
                           {at.left(), at.top() - kGap - size.height()},
                           {at.right() + kGap, at.top()},
                           {at.left() - kGap - size.width(), at.top()}};
  QPoint corner(at.right() - size.width() - kGap, at.top() + kGap);
  const QRect room = window->rect();
  for (const QPoint& place : places) {
    const bool below_or_above = place.x() == at.left();
    const bool fits = below_or_above ? place.y() >= 0 && place.y() + size.height() <= room.height()
                                     : place.x() >= 0 && place.x() + size.width() <= room.width();
    if (!fits) continue;
    corner = place;
    break;
  }
  corner.setX(std::clamp(corner.x(), 0, std::max(0, window->width() - size.width())));
  corner.setY(std::clamp(corner.y(), 0, std::max(0, window->height() - size.height())));
  move(corner);
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
