// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/cloud_pane.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QToolBar>
#include <QVBoxLayout>

#include "views/cloud_scene_builder.h"
#include "views/cloud_view.h"
#include "views/crop_form.h"

namespace lvcalib::widgets {

CloudPane::CloudPane(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  view_ = new CloudView(this);
  builder_ = new CloudSceneBuilder(this);
  createToolBar();
  createCrop();
  layout->addWidget(bar_);
  layout->addWidget(view_, 1);
  layout->addWidget(crop_form_);
  connect(builder_, &CloudSceneBuilder::ready, this, &CloudPane::display);
}

void CloudPane::createToolBar() {
  bar_ = new QToolBar(tr("Cloud"), this);
  color_ = new QComboBox(bar_);
  color_->setObjectName("cloud-color");
  color_->addItem(tr("Intensity"), static_cast<int>(CloudColor::kIntensity));
  color_->addItem(tr("Height"), static_cast<int>(CloudColor::kHeight));
  color_->addItem(tr("Range"), static_cast<int>(CloudColor::kRange));
  color_->addItem(tr("Plane residual"), static_cast<int>(CloudColor::kPlaneResidual));
  color_->addItem(tr("Camera colour"), static_cast<int>(CloudColor::kCameraColor));
  color_->setToolTip(
      tr("What the colours tell: intensity as recorded, height z (m), range (m), "
         "range beyond the board's plane (mm), or the camera's own colours"));
  color_->setAccessibleName(tr("Colour of the points"));
  filter_ = new QComboBox(bar_);
  filter_->setObjectName("cloud-filter");
  filter_->addItem(tr("All points"), static_cast<int>(CloudFilter::kAll));
  filter_->addItem(tr("Crop"), static_cast<int>(CloudFilter::kCrop));
  filter_->addItem(tr("Board"), static_cast<int>(CloudFilter::kBoard));
  filter_->addItem(tr("Boundary samples"), static_cast<int>(CloudFilter::kBoundary));
  filter_->setToolTip(
      tr("Which points are shown: all, those in the crop box, those about the "
         "board, or those beside the circles' edges"));
  filter_->setAccessibleName(tr("Points shown"));
  bar_->addWidget(color_);
  bar_->addWidget(filter_);
  bar_->addSeparator();
  for (QAction* action : view_->viewActions()) bar_->addAction(action);
  crop_action_ = bar_->addAction(tr("Crop…"));
  crop_action_->setObjectName("crop-action");
  crop_action_->setCheckable(true);
  crop_action_->setShortcut(QKeySequence(Qt::Key_C));
  crop_action_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  addAction(crop_action_);
  crop_action_->setToolTip(tr("Show a box with handles: the board is searched inside it only (C)"));
  count_ = new QLabel(bar_);
  count_->setObjectName("cloud-count");
  count_->setContentsMargins(8, 0, 0, 0);
  count_->setToolTip(tr("Number of points shown"));
  bar_->addWidget(count_);
  connect(color_, &QComboBox::currentIndexChanged, this, &CloudPane::rebuild);
  connect(filter_, &QComboBox::currentIndexChanged, this, &CloudPane::rebuild);
  connect(crop_action_, &QAction::toggled, this, &CloudPane::toggleCrop);
}

void CloudPane::createCrop() {
  crop_form_ = new CropForm(this);
  crop_form_->hide();
  connect(crop_form_, &CropForm::edited, this, [this](const CropBox& box) {
    edited_ = box;
    view_->setBox(edited_, true);
    if (filter_->currentData().toInt() == static_cast<int>(CloudFilter::kCrop)) rebuild();
  });
  connect(view_, &CloudView::boxEdited, this, &CloudPane::editCrop);
  connect(crop_form_, &CropForm::applied, this, [this](const CropBox& box) {
    crop_ = box;
    Q_EMIT cropApplied(box);
  });
  connect(crop_form_, &CropForm::cleared, this, [this] {
    crop_.reset();
    crop_action_->setChecked(false);
    Q_EMIT cropCleared();
  });
}

void CloudPane::setInput(CloudSceneInput input, std::vector<CloudLine> lines) {
  input_ = std::move(input);
  lines_ = std::move(lines);
  rebuild();
}

void CloudPane::setCrop(const std::optional<CropBox>& box) {
  crop_ = box;
  if (box) {
    edited_ = box;
    crop_form_->setBox(*box);
  } else {
    edited_.reset();
    crop_action_->setChecked(false);
  }
  view_->setBox(edited_, crop_action_->isChecked());
  if (filter_->currentData().toInt() == static_cast<int>(CloudFilter::kCrop)) rebuild();
}

void CloudPane::setColor(CloudColor color) {
  color_->setCurrentIndex(color_->findData(static_cast<int>(color)));
}

void CloudPane::setFilter(CloudFilter filter) {
  filter_->setCurrentIndex(filter_->findData(static_cast<int>(filter)));
}

bool CloudPane::busy() const {
  return builder_->busy();
}

void CloudPane::rebuild() {
  CloudSceneInput input = input_;
  input.color = static_cast<CloudColor>(color_->currentData().toInt());
  input.filter = static_cast<CloudFilter>(filter_->currentData().toInt());
  input.crop = edited_ ? edited_ : crop_;
  builder_->request(std::move(input));
}

void CloudPane::display(const std::shared_ptr<const CloudScene>& scene) {
  view_->setScene(scene);
  view_->setLines(lines_);
  updateCount();
  Q_EMIT sceneShown();
}

void CloudPane::editCrop(const CropBox& box) {
  edited_ = box;
  crop_form_->setBox(box);
  if (filter_->currentData().toInt() == static_cast<int>(CloudFilter::kCrop)) rebuild();
}

void CloudPane::toggleCrop(bool shown) {
  crop_form_->setVisible(shown);
  if (shown && !edited_) {
    edited_ = crop_ ? *crop_ : suggested_;
    crop_form_->setBox(*edited_);
  }
  if (!shown) edited_ = crop_;
  view_->setBox(edited_, shown);
}

void CloudPane::updateCount() {
  const auto& scene = view_->scene();
  count_->setText(
      scene ? tr("%1 points").arg(locale().toString(static_cast<qulonglong>(scene->size())))
            : QString());
}

}  // namespace lvcalib::widgets
