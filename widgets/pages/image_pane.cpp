// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/image_pane.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "views/image_view.h"

namespace lvcalib::widgets {
namespace {

constexpr int kLevelSteps = 255;

}  // namespace

ImagePane::ImagePane(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  view_ = new ImageView(this);
  createToolBar();
  createLevels();
  layout->addWidget(bar_);
  layout->addWidget(view_, 1);
  layout->addWidget(level_bar_);
  updateParts();
}

QAction* ImagePane::addToggle(const QString& text, const QString& tip, const char* name, bool on) {
  QAction* action = bar_->addAction(text);
  action->setObjectName(name);
  action->setCheckable(true);
  action->setChecked(on);
  action->setToolTip(tip);
  connect(action, &QAction::toggled, this, &ImagePane::updateParts);
  return action;
}

void ImagePane::createToolBar() {
  bar_ = new QToolBar(tr("Image"), this);
  tags_ =
      addToggle(tr("Tags"), tr("Outlines and ids of the detected tags (green)"), "show-tags", true);
  residuals_ = addToggle(tr("Residuals"),
                         tr("Detected minus predicted corner (px), enlarged (magenta arrows)"),
                         "show-residuals", true);
  factor_ = new QDoubleSpinBox(bar_);
  factor_->setObjectName("residual-factor");
  factor_->setRange(1.0, 1000.0);
  factor_->setDecimals(0);
  factor_->setPrefix("×");
  factor_->setValue(50.0);
  factor_->setToolTip(tr("How much longer than life residual arrows are drawn"));
  factor_->setAccessibleName(tr("Enlargement of residuals"));
  bar_->addWidget(factor_);
  circles_ = addToggle(tr("Circles"),
                       tr("Board outline, circles and their centres as the LiDAR sees them, "
                          "projected with the extrinsic (orange)"),
                       "show-circles", true);
  points_ =
      addToggle(tr("Points"), tr("The points of the cloud view, projected with the extrinsic"),
                "show-points", false);
  bar_->addSeparator();
  QAction* fit = bar_->addAction(tr("Fit"), view_, &ImageView::fit);
  fit->setToolTip(tr("Show the whole image (F)"));
  QAction* one = bar_->addAction(tr("1:1"), view_, &ImageView::oneToOne);
  one->setToolTip(tr("One image pixel per screen pixel (1)"));
  connect(factor_, &QDoubleSpinBox::valueChanged, this,
          [this](double factor) { view_->overlay().setResidualFactor(factor); });
}

void ImagePane::createLevels() {
  level_bar_ = new QToolBar(tr("Levels"), this);
  const auto slider = [this](const QString& name, const QString& tip, int value) {
    auto* label = new QLabel(name, level_bar_);
    label->setContentsMargins(4, 0, 4, 0);
    auto* s = new QSlider(Qt::Horizontal, level_bar_);
    s->setRange(0, kLevelSteps);
    s->setValue(value);
    s->setMinimumWidth(60);
    s->setMaximumWidth(140);
    s->setToolTip(tip);
    s->setAccessibleName(name);
    label->setBuddy(s);
    level_bar_->addWidget(label);
    level_bar_->addWidget(s);
    connect(s, &QSlider::valueChanged, this, &ImagePane::updateLevels);
    return s;
  };
  black_ = slider(tr("Black"), tr("Grey value shown as black (0 … 255 of full scale)"), 0);
  black_->setObjectName("level-black");
  white_ =
      slider(tr("White"), tr("Grey value shown as white (0 … 255 of full scale)"), kLevelSteps);
  white_->setObjectName("level-white");
  QAction* automatic = level_bar_->addAction(tr("Auto"), this, &ImagePane::automaticLevels);
  automatic->setToolTip(tr("Levels that show the central 99 % of the pixels with most contrast"));
  place_ = new QLabel(level_bar_);
  place_->setContentsMargins(10, 0, 0, 0);
  place_->setToolTip(tr("Pixel under the cursor (x, y) and its grey value"));
  level_bar_->addWidget(place_);
  connect(view_, &ImageView::hovered, this, [this](const QPointF& pixel, int value) {
    place_->setText(
        tr("(%1, %2): %3").arg(pixel.x(), 0, 'f', 1).arg(pixel.y(), 0, 'f', 1).arg(value));
  });
  connect(view_, &ImageView::left, place_, &QLabel::clear);
}

void ImagePane::setOverlay(ImageOverlay overlay) {
  view_->overlay().setOverlay(std::move(overlay));
}

void ImagePane::updateParts() {
  view_->overlay().setParts(
      {tags_->isChecked(), residuals_->isChecked(), circles_->isChecked(), points_->isChecked()});
}

void ImagePane::updateLevels() {
  view_->setLevels(
      {static_cast<double>(black_->value()) / kLevelSteps,
       static_cast<double>(std::max(white_->value(), black_->value() + 1)) / kLevelSteps});
}

void ImagePane::automaticLevels() {
  const ImageLevels levels = automatic_levels(view_->image());
  black_->setValue(static_cast<int>(std::floor(levels.black * kLevelSteps)));
  white_->setValue(static_cast<int>(std::ceil(levels.white * kLevelSteps)));
}

}  // namespace lvcalib::widgets
