// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/cloud_pane.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QToolBar>
#include <QVBoxLayout>

#include "style/texts.h"
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
  follow_language(this, [this] { retranslate(); });
  connect(builder_, &CloudSceneBuilder::ready, this, &CloudPane::display);
}

void CloudPane::createToolBar() {
  bar_ = new QToolBar(this);
  color_ = new QComboBox(bar_);
  color_->setObjectName("cloud-color");
  for (const CloudColor color : {CloudColor::kIntensity, CloudColor::kHeight, CloudColor::kRange,
                                 CloudColor::kPlaneResidual, CloudColor::kCameraColor})
    color_->addItem({}, static_cast<int>(color));
  filter_ = new QComboBox(bar_);
  filter_->setObjectName("cloud-filter");
  for (const CloudFilter filter :
       {CloudFilter::kAll, CloudFilter::kCrop, CloudFilter::kBoard, CloudFilter::kBoundary})
    filter_->addItem({}, static_cast<int>(filter));
  bar_->addWidget(color_);
  bar_->addWidget(filter_);
  bar_->addSeparator();
  for (QAction* action : view_->viewActions()) bar_->addAction(action);
  crop_action_ = bar_->addAction(QString());
  crop_action_->setObjectName("crop-action");
  crop_action_->setCheckable(true);
  crop_action_->setShortcut(QKeySequence(Qt::Key_C));
  crop_action_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  addAction(crop_action_);
  count_ = new QLabel(bar_);
  count_->setObjectName("cloud-count");
  count_->setContentsMargins(8, 0, 0, 0);
  bar_->addWidget(count_);
  connect(color_, &QComboBox::currentIndexChanged, this, &CloudPane::rebuild);
  connect(filter_, &QComboBox::currentIndexChanged, this, &CloudPane::rebuild);
  connect(crop_action_, &QAction::toggled, this, &CloudPane::toggleCrop);
}

void CloudPane::retranslate() {
  bar_->setWindowTitle(tr("Cloud"));
  const QStringList colors = {tr("Intensity"), tr("Height"), tr("Range"), tr("Plane residual"),
                              tr("Camera colour")};
  for (int k = 0; k < colors.size(); ++k) color_->setItemText(k, colors[k]);
  color_->setToolTip(
      tr("What the colours tell: intensity as recorded, height z (m), range (m), "
         "range beyond the board's plane (mm), or the camera's own colours"));
  color_->setAccessibleName(tr("Colour of the points"));
  const QStringList filters = {tr("All points"), tr("Crop"), tr("Board"), tr("Boundary samples")};
  for (int k = 0; k < filters.size(); ++k) filter_->setItemText(k, filters[k]);
  filter_->setToolTip(
      tr("Which points are shown: all, those in the crop box, those about the "
         "board, or those beside the circles' edges"));
  filter_->setAccessibleName(tr("Points shown"));
  crop_action_->setText(tr("Crop…"));
  crop_action_->setToolTip(tr("Show a box with handles: the board is searched inside it only (C)"));
  count_->setToolTip(tr("Number of points shown"));
  updateCount();
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
