// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QTreeWidget>
#include <memory>

#include "recording/recording.h"

namespace lvcalib::widgets {

/// Every topic of a recording: name, type, messages, rate, from when to when. What can be used
/// stands first.
class TopicList : public QTreeWidget {
  Q_OBJECT

 public:
  explicit TopicList(QWidget* parent = nullptr);
  /// Null: nothing is open.
  void setRecording(std::shared_ptr<const Recording> recording);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void retranslate();

  std::shared_ptr<const Recording> recording_;
};

}  // namespace lvcalib::widgets
