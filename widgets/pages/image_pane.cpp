// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/image_pane.h"

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "style/texts.h"
#include "views/image_view.h"
#include "views/tool_row.h"

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
  follow_language(this, [this] { retranslate(); });
}

QAction* ImagePane::addToggle(const char* name, bool on) {
  QAction* action = bar_->newTool();
  action->setObjectName(name);
  action->setCheckable(true);
  action->setChecked(on);
  connect(action, &QAction::toggled, this, &ImagePane::updateParts);
  return action;
}

void ImagePane::createToolBar() {
  bar_ = new ToolRow(this);
  tags_ = addToggle("show-tags", true);
  residuals_ = addToggle("show-residuals", true);
  factor_ = new QDoubleSpinBox(bar_);
  factor_->setObjectName("residual-factor");
  factor_->setRange(1.0, 1000.0);
  factor_->setDecimals(0);
  factor_->setPrefix("×");
  factor_->setValue(50.0);
  bar_->addWidget(factor_);
  circles_ = addToggle("show-circles", true);
  points_ = addToggle("show-points", false);
  unused_ = addToggle("show-unused", true);
  bar_->addSeparator();
  brush_ = bar_->newTool();
  brush_->setObjectName("image-brush");
  brush_->setCheckable(true);
  brush_->setShortcut(QKeySequence(Qt::Key_L));
  brush_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  view_->addAction(brush_);
  connect(brush_, &QAction::toggled, view_, &ImageView::setBrushing);
  fit_ = bar_->newTool();
  connect(fit_, &QAction::triggered, view_, &ImageView::fit);
  one_to_one_ = bar_->newTool();
  one_to_one_->setText(QStringLiteral("1:1"));
  connect(one_to_one_, &QAction::triggered, view_, &ImageView::oneToOne);
  connect(factor_, &QDoubleSpinBox::valueChanged, this,
          [this](double factor) { view_->overlay().setResidualFactor(factor); });
}

void ImagePane::createLevels() {
  level_bar_ = new ToolRow(this);
  const auto slider = [this](QLabel*& label, int value) {
    label = new QLabel(level_bar_);
    label->setContentsMargins(4, 0, 4, 0);
    auto* s = new QSlider(Qt::Horizontal, level_bar_);
    s->setRange(0, kLevelSteps);
    s->setValue(value);
    s->setMinimumWidth(60);
    s->setFixedWidth(110);
    label->setBuddy(s);
    level_bar_->addWidget(label);
    level_bar_->addWidget(s);
    connect(s, &QSlider::valueChanged, this, &ImagePane::updateLevels);
    return s;
  };
  black_ = slider(black_label_, 0);
  black_->setObjectName("level-black");
  white_ = slider(white_label_, kLevelSteps);
  white_->setObjectName("level-white");
  automatic_ = level_bar_->newTool();
  connect(automatic_, &QAction::triggered, this, &ImagePane::automaticLevels);
  place_ = new QLabel(level_bar_);
  // Room for the numbers, so that tools do not jump while the cursor moves.
  place_->setMinimumWidth(place_->fontMetrics().horizontalAdvance("(8888.8, 8888.8): 88888") + 12);
  place_->setContentsMargins(10, 0, 0, 0);
  level_bar_->addWidget(place_);
  connect(view_, &ImageView::hovered, this, [this](const QPointF& pixel, int value) {
    place_->setText(QStringLiteral("(%1, %2): %3")
                        .arg(pixel.x(), 0, 'f', 1)
                        .arg(pixel.y(), 0, 'f', 1)
                        .arg(value));
  });
  connect(view_, &ImageView::left, place_, &QLabel::clear);
}

void ImagePane::retranslate() {
  const auto describe = [](QAction* action, const QString& text, const QString& tip) {
    action->setText(text);
    action->setToolTip(tip);
  };
  bar_->setAccessibleName(tr("Image"));
  describe(tags_, tr("Tags"), tr("Outlines and ids of the detected tags (green)"));
  describe(residuals_, tr("Residuals"),
           tr("Detected minus predicted corner (px), enlarged (magenta arrows)"));
  factor_->setToolTip(tr("How much longer than life residual arrows are drawn"));
  factor_->setAccessibleName(tr("Enlargement of residuals"));
  describe(circles_, tr("Circles"),
           tr("Board outline, circles and their centres as the LiDAR sees them, "
              "projected with the extrinsic (orange). Crossed out: not used"));
  describe(points_, tr("Points"), tr("The points of the cloud view, projected with the extrinsic"));
  describe(unused_, tr("Left out"),
           tr("LiDAR points on the board that are not used: refused by the program (red crosses), "
              "left out by hand (violet crosses)"));
  describe(brush_, tr("Brush"),
           tr("Draw a line about what is to be selected: the tags, circles and points that are "
              "shown. With Shift it is added to what is selected (L)"));
  describe(fit_, tr("Fit"), tr("Show the whole image (F)"));
  one_to_one_->setToolTip(tr("One image pixel per screen pixel (1)"));
  level_bar_->setAccessibleName(tr("Levels"));
  black_label_->setText(tr("Black"));
  black_->setAccessibleName(tr("Black"));
  black_->setToolTip(tr("Grey value shown as black (0 … 255 of full scale)"));
  white_label_->setText(tr("White"));
  white_->setAccessibleName(tr("White"));
  white_->setToolTip(tr("Grey value shown as white (0 … 255 of full scale)"));
  describe(automatic_, tr("Auto"),
           tr("Levels that show the central 99 % of the pixels with most contrast"));
  place_->setToolTip(tr("Pixel under the cursor (x, y) and its grey value"));
}

void ImagePane::setOverlay(ImageOverlay overlay) {
  view_->overlay().setOverlay(std::move(overlay));
}

void ImagePane::updateParts() {
  view_->overlay().setParts({tags_->isChecked(), residuals_->isChecked(), circles_->isChecked(),
                             points_->isChecked(), unused_->isChecked()});
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

#include "moc_image_pane.cpp"
