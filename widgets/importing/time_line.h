// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "recording/survey.h"

namespace lvcalib::widgets {

/// A recording from its first to its last message: how much image and cloud move, and the still
/// stretches as bands, which a click takes or leaves. The list beside it offers the same to the
/// keyboard.
class TimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit TimeLine(QWidget* parent = nullptr);

  void clear();
  void setRecording(double length_s, const RecordedMotion& motion,
                    const std::vector<ImportedStretch>& stretches);
  /// Which stretches become scenes.
  void setTaken(const std::vector<bool>& taken);
  /// What the mouse over a stretch says.
  void setTexts(const QStringList& texts);
  /// The one that is looked at; −1: none.
  void setCurrent(int stretch);

  /// Where a stretch is drawn.
  [[nodiscard]] QRect stretchRect(int stretch) const;
  [[nodiscard]] QSize sizeHint() const override { return {600, 150}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {260, 120}; }

 Q_SIGNALS:
  /// A click on a stretch.
  void clicked(int stretch);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  struct Lane {
    QString name;
    const std::vector<MotionSample>* samples;
  };
  [[nodiscard]] QRect plotRect() const;
  [[nodiscard]] double xOf(double time_s) const;
  [[nodiscard]] int stretchAt(const QPoint& at) const;
  void paintBands(QPainter& painter) const;
  void paintLane(QPainter& painter, const QRect& rect, const Lane& lane) const;
  void paintAxis(QPainter& painter) const;

  double length_s_ = 0.0;
  RecordedMotion motion_;
  std::vector<ImportedStretch> stretches_;
  std::vector<bool> taken_;
  QStringList texts_;
  int current_ = -1;
};

}  // namespace lvcalib::widgets
