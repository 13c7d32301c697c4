// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/board_choice.h"

#include <QDir>
#include <QFileInfo>
#include <QSignalBlocker>
#include <algorithm>

#include "style/texts.h"
#include "tools/target_camera_dialog.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// Items that are no file.
const QString kChooseBoard = QStringLiteral("choose");
const QString kMakeBoard = QStringLiteral("make");

}  // namespace

BoardChoice::BoardChoice(Choices& choices, const QStringList& recent, QWidget* parent)
    : QComboBox(parent), choices_(choices), recent_(recent), place_(QDir::homePath()) {
  setObjectName(QStringLiteral("board"));
  // Names of files are long; the list shows them in full.
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(18);
  connect(this, &QComboBox::currentIndexChanged, this, &BoardChoice::choose);
  follow_language(this, [this] {
    setToolTip(tr("The printed board; stretches whose image does not show it are left out"));
    fill();
  });
}

void BoardChoice::setPlace(const QString& folder) {
  place_ = folder;
  chosen_ = false;
  fill();
}

bool BoardChoice::certain() const {
  return chosen_ || !currentData().toString().isEmpty();
}

void BoardChoice::fill() {
  const QSignalBlocker quiet(this);
  const QVariant before = currentData();
  clear();
  const QString beside = QDir(place_).filePath(QStringLiteral("target.yaml"));
  if (QFileInfo(beside).isFile()) addItem(tr("target.yaml beside the recording"), beside);
  addItem(tr("Standard board: 4 × 4 tags with circles"), QString());
  for (const QString& path : recent_) {
    const QString file = QDir(path).filePath(QStringLiteral("target.yaml"));
    if (!QFileInfo(file).isFile()) continue;
    addItem(tr("Board of %1").arg(QFileInfo(path).fileName()), file);
  }
  const QString chosen = before.toString();
  if (chosen_ && !chosen.isEmpty() && findData(chosen) < 0)
    addItem(QDir::toNativeSeparators(chosen), chosen);
  addItem(tr("Choose a target.yaml…"), kChooseBoard);
  addItem(tr("Make a target.yaml…"), kMakeBoard);
  setCurrentIndex(chosen_ ? std::max(0, findData(before)) : 0);
  last_ = currentIndex();
  read();
}

void BoardChoice::choose(int index) {
  const QVariant wanted = itemData(index);
  if (wanted == kChooseBoard || wanted == kMakeBoard) {
    {
      const QSignalBlocker quiet(this);
      setCurrentIndex(last_);
    }
    if (wanted == kMakeBoard) {
      auto* dialog = new TargetCameraDialog(choices_, place_, this);
      connect(dialog, &TargetCameraDialog::targetSaved, this, &BoardChoice::use);
      dialog->showPage(TargetCameraDialog::Page::kTarget);
      dialog->show();
      return;
    }
    const QString path = choices_.target_to_open(this, place_);
    if (!path.isEmpty()) use(path);
    return;
  }
  chosen_ = true;
  last_ = index;
  read();
  Q_EMIT boardChanged();
}

void BoardChoice::use(const QString& path) {
  {
    const QSignalBlocker quiet(this);
    int index = findData(path);
    if (index < 0) {
      index = findData(kChooseBoard);
      insertItem(index, QDir::toNativeSeparators(path), path);
    }
    setCurrentIndex(index);
  }
  choose(currentIndex());
}

void BoardChoice::read() {
  const QString path = currentData().toString();
  problem_.clear();
  target_ = Target{};
  if (path.isEmpty()) return;
  const auto file = read_target(path.toStdString());
  if (file) {
    target_ = file->target;
  } else {
    target_.reset();
    problem_ = core_text(file.error());
  }
}

}  // namespace lvcalib::widgets

#include "moc_board_choice.cpp"
