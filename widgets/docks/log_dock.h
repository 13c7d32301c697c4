// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDockWidget>

class QPlainTextEdit;

namespace lvcalib::widgets {

/// What happened, a line each with its time; the oldest lines go first.
class LogDock : public QDockWidget {
  Q_OBJECT

 public:
  static constexpr int kMaxLines = 5000;

  explicit LogDock(QWidget* parent = nullptr);
  void append(const QString& line);
  [[nodiscard]] QString text() const;

 private:
  void retranslate();
  QPlainTextEdit* edit_;
};

}  // namespace lvcalib::widgets
