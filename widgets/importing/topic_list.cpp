// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/topic_list.h"

#include <QHeaderView>
#include <algorithm>
#include <utility>

#include "recording/messages.h"

namespace lvcalib::widgets {
namespace {

enum TopicColumn { kName, kType, kCount, kRate, kSpan, kTopicColumns };

// What an import reads first, then what would have to be converted, then the rest.
int order_of(const Topic& topic) {
  switch (message_kind(topic.type)) {
    case MessageKind::kImage:
      return 0;
    case MessageKind::kCloud:
      return 1;
    case MessageKind::kCameraInfo:
      return 2;
    case MessageKind::kRawPackets:
    case MessageKind::kRawVideo:
      return 3;
    case MessageKind::kOther:
      break;
  }
  return 4;
}

}  // namespace

TopicList::TopicList(QWidget* parent) : QTreeWidget(parent) {
  setObjectName(QStringLiteral("topics"));
  setColumnCount(kTopicColumns);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setTextElideMode(Qt::ElideMiddle);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setStretchLastSection(true);
  retranslate();
}

void TopicList::setRecording(std::shared_ptr<const Recording> recording) {
  recording_ = std::move(recording);
  retranslate();
}

void TopicList::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  QTreeWidget::changeEvent(event);
}

void TopicList::retranslate() {
  setHeaderLabels({tr("Topic"), tr("Type"), tr("Messages"), tr("Rate"), tr("From – to")});
  clear();
  if (!recording_) return;
  std::vector<const Topic*> topics;
  for (const Topic& topic : recording_->topics()) topics.push_back(&topic);
  std::stable_sort(topics.begin(), topics.end(),
                   [](const Topic* a, const Topic* b) { return order_of(*a) < order_of(*b); });
  const std::int64_t start = recording_->span().first_ns;
  const auto seconds = [&](std::int64_t t) {
    return QString::number(1e-9 * static_cast<double>(t - start), 'f', 1);
  };
  for (const Topic* topic : topics) {
    auto* item = new QTreeWidgetItem(this);
    item->setText(kName, QString::fromStdString(topic->name));
    item->setText(kType, QString::fromStdString(topic->type));
    item->setText(kCount, QString::number(topic->count));
    if (topic->count > 0) {
      item->setText(kRate, tr("%1 Hz").arg(topic->rate_hz(), 0, 'f', 1));
      item->setText(kSpan,
                    tr("%1 s – %2 s").arg(seconds(topic->first_ns), seconds(topic->last_ns)));
    }
    item->setTextAlignment(kCount, Qt::AlignRight | Qt::AlignVCenter);
    item->setTextAlignment(kRate, Qt::AlignRight | Qt::AlignVCenter);
    const std::string converter = converter_of(topic->type);
    if (!converter.empty()) {
      item->setToolTip(kType, tr("Raw: convert it with %1").arg(QString::fromStdString(converter)));
    }
    // What an import does not read is there to be seen, not to be read first.
    if (order_of(*topic) > 2 || topic->count == 0) {
      for (int c = 0; c < kTopicColumns; ++c)
        item->setForeground(c, palette().color(QPalette::Disabled, QPalette::Text));
    }
  }
}

}  // namespace lvcalib::widgets

#include "moc_topic_list.cpp"
