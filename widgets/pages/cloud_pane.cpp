// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/cloud_pane.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QVBoxLayout>

#include "pages/scene_overlay.h"
#include "style/texts.h"
#include "views/cloud_scene_builder.h"
#include "views/cloud_view.h"
#include "views/color_bar.h"
#include "views/crop_form.h"
#include "views/tool_row.h"

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
  bar_ = new ToolRow(this);
  color_ = new QComboBox(bar_);
  color_->setObjectName("cloud-color");
  for (const CloudColor color :
       {CloudColor::kIntensity, CloudColor::kHeight, CloudColor::kRange, CloudColor::kResidual,
        CloudColor::kCameraColor, CloudColor::kLine, CloudColor::kTime})
    color_->addItem({}, static_cast<int>(color));
  filter_ = new QComboBox(bar_);
  filter_->setObjectName("cloud-filter");
  for (const CloudFilter filter :
       {CloudFilter::kAll, CloudFilter::kCrop, CloudFilter::kBoard, CloudFilter::kBoundary})
    filter_->addItem({}, static_cast<int>(filter));
  bar_->addWidget(color_);
  bar_->addWidget(filter_);
  bar_->addSeparator();
  for (QAction* action : view_->viewActions()) bar_->addTool(action);
  crop_action_ = bar_->newTool();
  crop_action_->setObjectName("crop-action");
  crop_action_->setCheckable(true);
  crop_action_->setShortcut(QKeySequence(Qt::Key_C));
  crop_action_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  // The key is the view's: in a list beside it the same letter chooses an entry.
  view_->addAction(crop_action_);
  axes_action_ = bar_->newTool();
  axes_action_->setObjectName("cloud-axes");
  axes_action_->setCheckable(true);
  unused_action_ = bar_->newTool();
  unused_action_->setObjectName("cloud-unused");
  unused_action_->setCheckable(true);
  unused_action_->setChecked(true);
  brush_action_ = bar_->newTool();
  brush_action_->setObjectName("cloud-brush");
  brush_action_->setCheckable(true);
  brush_action_->setShortcut(QKeySequence(Qt::Key_L));
  brush_action_->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  brush_action_->setEnabled(view_->hasOpenGl());
  view_->addAction(brush_action_);
  size_ = new QDoubleSpinBox(bar_);
  size_->setObjectName("cloud-point-size");
  size_->setRange(0.5, 12.0);
  size_->setSingleStep(0.5);
  size_->setDecimals(1);
  size_->setValue(CloudView::kPointSize_px);
  size_->setSuffix(QStringLiteral(" px"));
  bar_->addWidget(size_);
  count_ = new QLabel(bar_);
  count_->setObjectName("cloud-count");
  count_->setContentsMargins(8, 0, 0, 0);
  bar_->addWidget(count_);
  connect(size_, &QDoubleSpinBox::valueChanged, view_, &CloudView::setPointSize);
  connect(axes_action_, &QAction::toggled, this, &CloudPane::showLines);
  connect(unused_action_, &QAction::toggled, this, &CloudPane::showLines);
  connect(brush_action_, &QAction::toggled, view_, &CloudView::setBrushing);
  // Another quantity has another range.
  connect(color_, &QComboBox::currentIndexChanged, this, [this] {
    range_.reset();
    rebuild();
  });
  connect(view_->legend(), &ColorBar::rangeChosen, this, [this](double low, double high) {
    range_ = {low, high};
    rebuild();
  });
  connect(view_->legend(), &ColorBar::rangeCleared, this, [this] {
    range_.reset();
    rebuild();
  });
  connect(filter_, &QComboBox::currentIndexChanged, this, &CloudPane::rebuild);
  connect(crop_action_, &QAction::toggled, this, &CloudPane::toggleCrop);
}

void CloudPane::retranslate() {
  bar_->setAccessibleName(tr("Cloud"));
  const QStringList colors = {tr("Intensity"),     tr("Height"), tr("Range"), tr("Residual"),
                              tr("Camera colour"), tr("Line"),   tr("Time")};
  for (int k = 0; k < colors.size(); ++k) color_->setItemText(k, colors[k]);
  color_->setToolTip(
      tr("What the colours tell: intensity as recorded, height z (m), range (m), "
         "what the model in force leaves of the range, averaged over the board (mm), the camera's "
         "own colours, the scan line's number, or the time since the scan began (ms)"));
  color_->setAccessibleName(tr("Colour of the points"));
  const QStringList filters = {tr("All points"), tr("Crop"), tr("Board"), tr("Boundary samples")};
  for (int k = 0; k < filters.size(); ++k) filter_->setItemText(k, filters[k]);
  filter_->setToolTip(
      tr("Which points are shown: all, those in the crop box, those about the "
         "board, or those beside the circles' edges"));
  filter_->setAccessibleName(tr("Points shown"));
  crop_action_->setText(tr("Crop…"));
  crop_action_->setToolTip(tr("Show a box with handles: the board is searched inside it only (C)"));
  axes_action_->setText(tr("Axes"));
  axes_action_->setToolTip(
      tr("Show the LiDAR's axes (x red, y green, z blue) and a grid under the points"));
  unused_action_->setText(tr("Left out"));
  unused_action_->setToolTip(
      tr("Mark the points on the board that are not used: refused by the program (red crosses), "
         "left out by hand (violet crosses)"));
  brush_action_->setText(tr("Brush"));
  brush_action_->setToolTip(
      tr("Draw a line about points to select them, at whatever depth. With Shift they are added to "
         "those selected (L)"));
  size_->setToolTip(tr("Size of the points on the screen, px"));
  size_->setAccessibleName(tr("Size of the points"));
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
  // A range chosen for one cloud says nothing of another.
  if (input.full != input_.full) range_.reset();
  input_ = std::move(input);
  lines_ = std::move(lines);
  rebuild();
}

void CloudPane::setSurface(std::function<std::optional<BoardSurface>()> surface) {
  input_.surface = std::move(surface);
  if (color_->currentData().toInt() == static_cast<int>(CloudColor::kResidual)) rebuild();
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
  input.range = range_;
  builder_->request(std::move(input));
}

void CloudPane::display(const std::shared_ptr<const CloudScene>& scene) {
  view_->setScene(scene);
  showLines();
  updateCount();
  Q_EMIT sceneShown();
}

void CloudPane::showLines() {
  std::vector<CloudLine> lines = lines_;
  const auto& scene = view_->scene();
  if (unused_action_->isChecked() && scene) {
    for (CloudLine& mark : unused_marks(scene->unused)) lines.push_back(std::move(mark));
  }
  if (axes_action_->isChecked() && scene && scene->size() > 0) {
    for (CloudLine& line : axes_and_grid(scene->low_m, scene->high_m))
      lines.push_back(std::move(line));
  }
  view_->setLines(lines);
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

#include "moc_cloud_pane.cpp"
