// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QWidget>

namespace lvcalib::widgets {

/// Text in the largest letters that fit, to be read from afar: wrapped between words, never cut
/// off. Passive.
class LargeText : public QWidget {
  Q_OBJECT

 public:
  /// `most_pt`: letters do not grow beyond.
  explicit LargeText(double most_pt, QWidget* parent = nullptr);

  void setText(const QString& text);
  [[nodiscard]] const QString& text() const { return text_; }
  /// Invalid: that of the palette.
  void setColor(const QColor& color);
  void setAlignment(Qt::Alignment alignment);
  /// Size of the letters as they are shown.
  [[nodiscard]] double points() const { return points_; }

  [[nodiscard]] QSize sizeHint() const override { return {400, 90}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {80, 30}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fit();
  [[nodiscard]] bool fits(double points) const;

  double most_pt_;
  double points_;
  QString text_;
  QColor color_;
  Qt::Alignment alignment_ = Qt::AlignLeft | Qt::AlignVCenter;
};

}  // namespace lvcalib::widgets
