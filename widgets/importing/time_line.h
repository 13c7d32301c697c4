// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QPixmap>
#include <QString>
#include <QWidget>
#include <optional>
#include <vector>

#include "recording/survey.h"

namespace lvcalib::widgets {

/// A recording from its first to its last message: how much image and cloud move, and the still
/// stretches as bands, which a click takes or leaves, and whose edges can be dragged. The list and
/// the fields beside it offer the same to the keyboard.
class TimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit TimeLine(QWidget* parent = nullptr);

  void clear();
  /// A picture taken at a time, for the row above the curves.
  void addPicture(double time_s, const QImage& picture);
  /// How many pictures there are.
  [[nodiscard]] std::size_t pictureCount() const { return pictures_.size(); }
  /// Pictures stay.
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
  /// Between which times an edge may lie, so that no two stretches share a moment.
  [[nodiscard]] std::pair<double, double> rangeOf(int stretch, bool last) const;
  [[nodiscard]] QSize sizeHint() const override { return {600, 190}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {260, 150}; }

 Q_SIGNALS:
  /// A click on a stretch.
  void clicked(int stretch);
  /// An edge was dragged and let go.
  void edgesMoved(int stretch, double first_s, double last_s);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  // An edge under the mouse, or held by it.
  struct Handle {
    int stretch = 0;
    bool last = false;
  };
  struct Drag {
    Handle handle;
    int from_x = 0;
    bool moved = false;  // Further than a hand shakes.
  };
  struct Lane {
    QString name;
    const std::vector<MotionSample>* samples;
  };
  [[nodiscard]] QRect plotRect() const;
  [[nodiscard]] double xOf(double time_s) const;
  [[nodiscard]] double timeOf(int x) const;
  [[nodiscard]] int stretchAt(const QPoint& at) const;
  [[nodiscard]] std::optional<Handle> handleAt(const QPoint& at) const;
  void drag(const QPoint& at, const QPoint& global);
  void paintPictures(QPainter& painter) const;
  void paintBands(QPainter& painter) const;
  void paintLane(QPainter& painter, const QRect& rect, const Lane& lane) const;
  void paintAxis(QPainter& painter) const;

  struct Picture {
    double time_s;
    QPixmap pixmap;
  };
  double length_s_ = 0.0;
  std::vector<Picture> pictures_;  // Sorted by time.
  RecordedMotion motion_;
  std::vector<ImportedStretch> stretches_;
  std::vector<bool> taken_;
  QStringList texts_;
  int current_ = -1;
  std::optional<Drag> drag_;
};

}  // namespace lvcalib::widgets
