// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/tool_row.h"

#include <QAction>
#include <QFrame>
#include <QLayout>
#include <QToolButton>
#include <algorithm>
#include <memory>
#include <vector>

namespace lvcalib::widgets {
namespace {

constexpr int kToolGap = 3;

// Items from left to right, then from top to bottom, as words in a text.
class LineLayout : public QLayout {
 public:
  using QLayout::QLayout;
  ~LineLayout() override {
    for (QLayoutItem* item : items_) delete item;
  }
  void addItem(QLayoutItem* item) override { items_.push_back(item); }
  [[nodiscard]] int count() const override { return static_cast<int>(items_.size()); }
  [[nodiscard]] QLayoutItem* itemAt(int index) const override {
    return index >= 0 && index < count() ? items_[static_cast<std::size_t>(index)] : nullptr;
  }
  QLayoutItem* takeAt(int index) override {
    QLayoutItem* item = itemAt(index);
    if (item != nullptr) items_.erase(items_.begin() + index);
    return item;
  }
  [[nodiscard]] Qt::Orientations expandingDirections() const override { return {}; }
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  [[nodiscard]] int heightForWidth(int width) const override {
    return arrange(QRect(0, 0, width, 0), false);
  }
  void setGeometry(const QRect& rect) override {
    QLayout::setGeometry(rect);
    arrange(rect, true);
  }
  [[nodiscard]] QSize sizeHint() const override {
    QSize size(0, 0);
    for (const QLayoutItem* item : items_) {
      size.rwidth() += item->sizeHint().width() + kToolGap;
      size.setHeight(std::max(size.height(), item->sizeHint().height()));
    }
    return size;
  }
  [[nodiscard]] QSize minimumSize() const override {
    QSize size(0, 0);
    for (const QLayoutItem* item : items_) size = size.expandedTo(item->minimumSize());
    return size;
  }

 private:
  // Returns the height that a width needs.
  int arrange(const QRect& rect, bool move) const {
    int x = rect.left();
    int y = rect.top();
    int line = 0;
    std::vector<std::pair<QLayoutItem*, QRect>> in_line;
    const auto finish = [&] {
      for (auto& [item, place] : in_line) {
        place.moveTop(y + (line - place.height()) / 2);
        if (move) item->setGeometry(place);
      }
      in_line.clear();
    };
    for (QLayoutItem* item : items_) {
      if (item->isEmpty()) continue;
      const QSize size = item->sizeHint().boundedTo(QSize(std::max(1, rect.width()), 10'000));
      if (x > rect.left() && x + size.width() > rect.left() + rect.width()) {
        finish();
        x = rect.left();
        y += line + kToolGap;
        line = 0;
      }
      in_line.emplace_back(item, QRect(QPoint(x, y), size));
      x += size.width() + kToolGap;
      line = std::max(line, size.height());
    }
    finish();
    return y + line - rect.top();
  }

  std::vector<QLayoutItem*> items_;
};

}  // namespace

ToolRow::ToolRow(QWidget* parent) : QWidget(parent) {
  auto* layout = new LineLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Minimum);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

void ToolRow::addTool(QAction* action) {
  auto* button = new QToolButton(this);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::TabFocus);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setDefaultAction(action);
  const auto follow = [button, action] { button->setHidden(!action->isVisible()); };
  connect(action, &QAction::changed, button, follow);
  follow();
  layout()->addWidget(button);
}

QAction* ToolRow::newTool() {
  auto* action = new QAction(this);
  addTool(action);
  return action;
}

void ToolRow::addWidget(QWidget* widget) {
  layout()->addWidget(widget);
}

void ToolRow::addSeparator() {
  auto* line = new QFrame(this);
  line->setFrameShape(QFrame::VLine);
  line->setFrameShadow(QFrame::Sunken);
  line->setFixedSize(3, 22);
  layout()->addWidget(line);
}

}  // namespace lvcalib::widgets

#include "moc_tool_row.cpp"
