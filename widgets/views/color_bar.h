// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QWidget>

#include "views/color_map.h"

namespace lvcalib::widgets {

/// Legend of a colour scale: an upright bar with round numbers beside it and the quantity's name
/// along it.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(QWidget* parent = nullptr);

  void setScale(const ColorScale& scale, const QString& quantity);
  /// Only the name, without a bar (camera colours).
  void setNameOnly(const QString& quantity);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  ColorScale scale_;
  QString quantity_;
  bool has_scale_ = false;
};

}  // namespace lvcalib::widgets
