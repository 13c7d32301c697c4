// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTreeWidget>
#include <vector>

#include "recording/import.h"

namespace lvcalib::widgets {

/// The still stretches of a recording: picture, time, whether it becomes a scene, and why.
class StretchList : public QTreeWidget {
  Q_OBJECT

 public:
  explicit StretchList(QWidget* parent = nullptr);

  /// Of stretches that were there before, with other edges or not, ticks of the user and pictures
  /// stay.
  void setStretches(const std::vector<ImportedStretch>& stretches);
  [[nodiscard]] const std::vector<ImportedStretch>& stretches() const { return stretches_; }
  void setPicture(int stretch, const QImage& thumbnail, bool checked, const Message& complaint);
  /// Those that can be used and of whose image nothing is known yet.
  [[nodiscard]] std::vector<int> withoutPicture() const;
  /// The board or the camera is another one: whether it is seen is open again.
  void forgetBoards();

  [[nodiscard]] std::vector<bool> taken() const;
  void toggle(int stretch);
  /// Times that ask for exactly what is ticked; none if that is what would be taken anyway.
  [[nodiscard]] std::vector<double> sceneTimes() const;
  /// Ticked ones whose image is not known to lack the board.
  [[nodiscard]] int expectedScenes() const;
  /// What to say about a stretch, in one text.
  [[nodiscard]] QString describe(int stretch) const;

 Q_SIGNALS:
  void takenChanged();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Board {
    bool pictured = false;
    bool checked = false;
    Message complaint;
  };
  [[nodiscard]] QString fate(int stretch) const;
  void retranslate();
  void showRow(int stretch);

  std::vector<ImportedStretch> stretches_;
  std::vector<Board> boards_;
};

}  // namespace lvcalib::widgets
