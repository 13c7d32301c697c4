// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <array>
#include <functional>

#include "pipeline/crop_box.h"

class QDoubleSpinBox;
class QPushButton;

namespace lvcalib::widgets {

/// A crop box by numbers: middle and sides in metres, roll, pitch and yaw of its axes in degrees.
class CropForm : public QWidget {
  Q_OBJECT

 public:
  explicit CropForm(QWidget* parent = nullptr);

  /// Shows a box without announcing it.
  void setBox(const CropBox& box);
  [[nodiscard]] CropBox box() const;

 Q_SIGNALS:
  /// The numbers were changed by the user.
  void edited(const lvcalib::CropBox& box);
  /// "Use": run the scene again inside the box.
  void applied(const lvcalib::CropBox& box);
  void cleared();

 private:
  struct FieldTexts {
    QString name, tip;
  };
  QDoubleSpinBox* addField(int row, int column, double low, double high, const QString& suffix,
                           const std::function<FieldTexts()>& texts);

  std::array<QDoubleSpinBox*, 3> center_{};
  std::array<QDoubleSpinBox*, 3> size_{};
  std::array<QDoubleSpinBox*, 3> angle_{};
  QPushButton* use_ = nullptr;
  QPushButton* clear_ = nullptr;
  bool filling_ = false;
};

}  // namespace lvcalib::widgets
