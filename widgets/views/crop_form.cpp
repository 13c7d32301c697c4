// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/crop_form.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>

#include "base/roll_pitch_yaw.h"
#include "base/units.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

constexpr double kSmallestSide_m = 0.01;

}  // namespace

CropForm::CropForm(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(4);
  grid->setVerticalSpacing(2);
  const std::array<QString, 3> axes{"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    center_[i] = addField(0, k, -1e4, 1e4, " m", [axis = axes[i]] {
      return FieldTexts{tr("Middle %1").arg(axis),
                        tr("Middle of the box along the LiDAR's %1 axis, in metres").arg(axis)};
    });
    size_[i] = addField(1, k, kSmallestSide_m, 1e4, " m", [axis = axes[i]] {
      return FieldTexts{tr("Side %1").arg(axis),
                        tr("Length of the box along its own %1 axis, in metres").arg(axis)};
    });
    angle_[i] = addField(2, k, -180.0, 180.0, "°", [k] {
      const QString turn = k == 0 ? tr("roll") : k == 1 ? tr("pitch") : tr("yaw");
      return FieldTexts{turn,
                        tr("Turn of the box (%1), in degrees: roll about x, then pitch about y, "
                           "then yaw about z of the LiDAR")
                            .arg(turn)};
    });
  }
  use_ = new QPushButton(this);
  use_->setObjectName("crop-use");
  clear_ = new QPushButton(this);
  clear_->setObjectName("crop-clear");
  follow_language(this, [this] {
    use_->setText(tr("Use this crop"));
    use_->setToolTip(tr("Search the board only inside the box; runs this scene again from there"));
    clear_->setText(tr("No crop"));
    clear_->setToolTip(tr("Search the board in the whole cloud again"));
  });
  grid->addWidget(use_, 0, 6);
  grid->addWidget(clear_, 1, 6);
  connect(use_, &QPushButton::clicked, this, [this] { Q_EMIT applied(box()); });
  connect(clear_, &QPushButton::clicked, this, &CropForm::cleared);
}

QDoubleSpinBox* CropForm::addField(int row, int column, double low, double high,
                                   const QString& suffix,
                                   const std::function<FieldTexts()>& texts) {
  auto* box = new QDoubleSpinBox(this);
  box->setRange(low, high);
  box->setDecimals(row == 2 ? 2 : 3);
  box->setSingleStep(row == 2 ? 1.0 : 0.05);
  box->setSuffix(suffix);
  box->setKeyboardTracking(false);
  auto* label = new QLabel(this);
  follow_language(this, [box, label, texts] {
    const auto [name, tip] = texts();
    label->setText(name);
    box->setAccessibleName(name);
    box->setToolTip(tip);
  });
  label->setBuddy(box);
  auto* grid = qobject_cast<QGridLayout*>(layout());
  grid->addWidget(label, row, 2 * column, Qt::AlignRight);
  grid->addWidget(box, row, 2 * column + 1);
  connect(box, &QDoubleSpinBox::valueChanged, this, [this] {
    if (!filling_) Q_EMIT edited(this->box());
  });
  return box;
}

void CropForm::setBox(const CropBox& box) {
  filling_ = true;
  UncertainRigid3 turn;
  turn.transform.rotation = box.rotation;
  const Eigen::Vector3d angles = roll_pitch_yaw(turn).angles_rad;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    center_[i]->setValue(box.center_m(k));
    size_[i]->setValue(2.0 * box.half_size_m(k));
    angle_[i]->setValue(kDegPerRad * angles(k));
  }
  filling_ = false;
}

CropBox CropForm::box() const {
  CropBox box;
  Eigen::Vector3d angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    box.center_m(k) = center_[i]->value();
    box.half_size_m(k) = 0.5 * size_[i]->value();
    angles(k) = angle_[i]->value() / kDegPerRad;
  }
  box.rotation = Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                 Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                 Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX());
  return box;
}

}  // namespace lvcalib::widgets

#include "moc_crop_form.cpp"
