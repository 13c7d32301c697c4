// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/stretch_list.h"

#include <QHeaderView>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

#include "style/marks.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

enum Column { kTime, kLength, kCounts, kBoard, kFate, kColumns };

QString seconds_text(double seconds) {
  return QString::number(seconds, 'f', 1);
}

}  // namespace

StretchList::StretchList(QWidget* parent) : QTreeWidget(parent) {
  setObjectName(QStringLiteral("stretches"));
  setColumnCount(kColumns);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setAllColumnsShowFocus(true);
  setIconSize(QSize(84, 56));
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setStretchLastSection(true);
  connect(this, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (column != kTime) return;
    showRow(indexOfTopLevelItem(item));
    Q_EMIT takenChanged();
  });
  retranslate();
}

void StretchList::setStretches(const std::vector<ImportedStretch>& stretches) {
  {
    const QSignalBlocker quiet(this);
    const int current = indexOfTopLevelItem(currentItem());
    const std::vector<bool> ticks = taken();
    const std::vector<ImportedStretch> before = std::exchange(stretches_, stretches);
    const std::vector<Board> boards = std::exchange(boards_, std::vector<Board>(stretches.size()));
    std::vector<QIcon> icons;
    for (int i = 0; i < topLevelItemCount(); ++i) icons.push_back(topLevelItem(i)->icon(kTime));
    clear();
    for (const ImportedStretch& s : stretches) {
      auto* item = new QTreeWidgetItem(this);
      Qt::ItemFlags flags = Qt::ItemIsSelectable;
      if (s.usable) flags |= Qt::ItemIsEnabled | Qt::ItemIsUserCheckable;
      item->setFlags(flags);
      bool tick = s.taken;
      const auto same = std::find_if(before.begin(), before.end(), [&](const ImportedStretch& b) {
        return b.found_first_s == s.found_first_s && b.found_last_s == s.found_last_s;
      });
      if (same != before.end()) {
        const auto old = static_cast<std::size_t>(same - before.begin());
        if (ticks[old] != same->taken) tick = ticks[old] && s.usable;
        if (same->image_ns == s.image_ns && s.usable) {
          boards_[static_cast<std::size_t>(topLevelItemCount() - 1)] = boards[old];
          item->setIcon(kTime, icons[old]);
        }
        if (static_cast<int>(old) == current) setCurrentItem(item);
      }
      item->setCheckState(kTime, tick ? Qt::Checked : Qt::Unchecked);
      showRow(topLevelItemCount() - 1);
    }
  }
  Q_EMIT takenChanged();
}

void StretchList::setPicture(int stretch, const QImage& thumbnail, bool checked,
                             const Message& complaint) {
  if (stretch < 0 || stretch >= topLevelItemCount()) return;
  {
    const QSignalBlocker quiet(this);
    topLevelItem(stretch)->setIcon(kTime, QIcon(QPixmap::fromImage(thumbnail)));
    boards_[static_cast<std::size_t>(stretch)] = {true, checked, complaint};
    showRow(stretch);
  }
  Q_EMIT takenChanged();
}

std::vector<int> StretchList::withoutPicture() const {
  std::vector<int> out;
  for (int i = 0; i < topLevelItemCount(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (stretches_[at].usable && !boards_[at].pictured) out.push_back(i);
  }
  return out;
}

void StretchList::forgetBoards() {
  const QSignalBlocker quiet(this);
  for (int i = 0; i < topLevelItemCount(); ++i) {
    boards_[static_cast<std::size_t>(i)] = {};
    showRow(i);
  }
}

std::vector<bool> StretchList::taken() const {
  std::vector<bool> out;
  for (int i = 0; i < topLevelItemCount(); ++i)
    out.push_back(topLevelItem(i)->checkState(kTime) == Qt::Checked);
  return out;
}

void StretchList::toggle(int stretch) {
  if (stretch < 0 || stretch >= topLevelItemCount()) return;
  QTreeWidgetItem* item = topLevelItem(stretch);
  setCurrentItem(item);
  if (!stretches_[static_cast<std::size_t>(stretch)].usable) return;
  item->setCheckState(kTime, item->checkState(kTime) == Qt::Checked ? Qt::Unchecked : Qt::Checked);
}

std::vector<double> StretchList::sceneTimes() const {
  const std::vector<bool> wanted = taken();
  std::vector<double> out;
  bool as_proposed = true;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const ImportedStretch& s = stretches_[i];
    as_proposed = as_proposed && wanted[i] == s.taken;
    if (wanted[i]) out.push_back(0.5 * (s.first_s + s.last_s));
  }
  return as_proposed ? std::vector<double>{} : out;
}

int StretchList::expectedScenes() const {
  const std::vector<bool> wanted = taken();
  int out = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] && boards_[i].complaint.empty()) ++out;
  }
  return out;
}

QString StretchList::fate(int stretch) const {
  const ImportedStretch& s = stretches_[static_cast<std::size_t>(stretch)];
  const bool wanted = topLevelItem(stretch)->checkState(kTime) == Qt::Checked;
  const QString reason = core_text(s.reason);
  if (!wanted) return s.taken ? tr("left out by you") : tr("left: %1").arg(reason);
  return s.taken ? tr("a scene: %1").arg(reason) : tr("a scene, as you decided: %1").arg(reason);
}

QString StretchList::describe(int stretch) const {
  const ImportedStretch& s = stretches_[static_cast<std::size_t>(stretch)];
  return tr("%1 s to %2 s: %3").arg(seconds_text(s.first_s), seconds_text(s.last_s), fate(stretch));
}

void StretchList::showRow(int stretch) {
  const QSignalBlocker quiet(this);
  QTreeWidgetItem* item = topLevelItem(stretch);
  const ImportedStretch& s = stretches_[static_cast<std::size_t>(stretch)];
  const Board& board = boards_[static_cast<std::size_t>(stretch)];
  item->setText(kTime, tr("%1 s – %2 s").arg(seconds_text(s.first_s), seconds_text(s.last_s)));
  item->setText(kLength, tr("%1 s").arg(seconds_text(s.last_s - s.first_s)));
  item->setText(kCounts, QStringLiteral("%1 / %2").arg(s.images).arg(s.usable ? s.sweeps : 0));
  item->setText(kFate, fate(stretch));
  if (!board.checked) {
    item->setText(kBoard, QString());
    item->setData(kBoard, Qt::DecorationRole, {});
    item->setToolTip(kBoard, QString());
  } else {
    const bool seen = board.complaint.empty();
    const QString complaint = core_text(board.complaint);
    item->setText(kBoard, seen ? tr("seen") : tr("not seen"));
    // A pixmap: an icon would grow to the thumbnails' size.
    const QIcon mark = mark_icon(seen ? Mark::kGood : Mark::kDoubtful, palette());
    item->setData(kBoard, Qt::DecorationRole, mark.pixmap(QSize(16, 16), devicePixelRatioF()));
    item->setToolTip(kBoard, complaint);
    if (!seen) item->setText(kFate, tr("no board in the image: %1").arg(complaint));
  }
  item->setToolTip(kFate, item->text(kFate));
}

void StretchList::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange || event->type() == QEvent::PaletteChange)
    retranslate();
  QTreeWidget::changeEvent(event);
}

void StretchList::retranslate() {
  setHeaderLabels({tr("Still stretch"), tr("Length"), tr("Images / sweeps"), tr("Board"),
                   tr("What becomes of it")});
  for (int i = 0; i < topLevelItemCount(); ++i) showRow(i);
}

}  // namespace lvcalib::widgets

#include "moc_stretch_list.cpp"
