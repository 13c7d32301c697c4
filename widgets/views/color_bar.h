// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>
#include <vector>

#include "views/cloud_scene.h"
#include "views/color_map.h"

namespace lvcalib::widgets {

/// Legend of a colour scale: an upright bar with round numbers beside it and the quantity's name
/// along it; or of categories, by name.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(QWidget* parent = nullptr);

  void setScale(const ColorScale& scale, const QString& quantity);
  /// The same over a wider range, with a histogram of the values in equal bins over it: the ends of
  /// the colours can be dragged there, a double click takes the wider range.
  void setScale(const ColorScale& scale, const QString& quantity, const ColorScale& whole,
                const std::vector<int>& histogram);
  /// Only the name, without a bar (camera colours).
  void setNameOnly(const QString& quantity);
  /// What is told apart, and in which colours.
  void setCategories(const std::vector<CloudCategory>& categories, const QString& quantity);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 Q_SIGNALS:
  /// An end of the colours was dragged.
  void rangeChosen(double low, double high);
  void rangeCleared();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  void paintCategories(QPainter& painter) const;

  enum class End { kNone, kLow, kHigh };
  [[nodiscard]] QRect bar() const;
  [[nodiscard]] double valueAt(int y) const;
  [[nodiscard]] int yOf(double value) const;

  ColorScale scale_;
  ColorScale whole_;
  std::vector<int> histogram_;
  std::vector<CloudCategory> categories_;
  End dragged_ = End::kNone;
  QString quantity_;
  bool has_scale_ = false;
};

}  // namespace lvcalib::widgets
