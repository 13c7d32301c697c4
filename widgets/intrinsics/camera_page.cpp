// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsics/camera_page.h"

#include <QComboBox>
#include <QEvent>
#include <QFileInfo>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <QTabWidget>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "base/file_io.h"
#include "intrinsics/intrinsics_text.h"
#include "modelling/residual_map_plot.h"
#include "runner/scene_data.h"
#include "style/edits_text.h"
#include "style/texts.h"
#include "views/image_view.h"
#include "views/uncertainty_plots.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

enum Shown { kCalibration, kAlone };
enum ImageColumn { kName, kCorners, kRms, kReason };

// The residuals as the plots of residuals take them.
std::shared_ptr<const ChannelView> view_of(const CameraFigures& figures) {
  auto view = std::make_shared<ChannelView>();
  view->columns = figures.corners;
  const ResidualColumns& c = view->columns;
  view->image =
      map_residuals(c.covariates[0].values, c.covariates[1].values, c.component, c.sample());
  return view;
}

}  // namespace

CameraPage::CameraPage(QWidget* parent, Of of)
    : QWidget(parent),
      of_(of),
      shown_label_(new QLabel(this)),
      shown_(new QComboBox(this)),
      add_(new QPushButton(this)),
      calibrate_(new QPushButton(this)),
      save_(new QPushButton(this)),
      progress_(new QProgressBar(this)),
      cancel_(new QPushButton(this)),
      message_(new QLabel(this)) {
  setObjectName(QStringLiteral("camera_page"));
  shown_->setObjectName(QStringLiteral("camera_shown"));
  add_->setObjectName(QStringLiteral("camera_add"));
  calibrate_->setObjectName(QStringLiteral("camera_calibrate"));
  save_->setObjectName(QStringLiteral("camera_save"));
  cancel_->setObjectName(QStringLiteral("camera_cancel"));
  message_->setObjectName(QStringLiteral("camera_message"));
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  shown_->addItems({QString(), QString()});
  shown_label_->setBuddy(shown_);
  progress_->setRange(0, 1000);
  progress_->setMaximumWidth(240);
  auto* head = new QHBoxLayout;
  head->addWidget(shown_label_);
  head->addWidget(shown_);
  head->addStretch();
  head->addWidget(progress_);
  head->addWidget(cancel_);
  head->addWidget(add_);
  head->addWidget(calibrate_);
  head->addWidget(save_);
  auto* split = new QSplitter(Qt::Horizontal, this);
  split->setChildrenCollapsible(false);
  split->addWidget(createKnowledge());
  split->addWidget(createFigures());
  split->setSizes({460, 560});
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 0);
  layout->addLayout(head);
  layout->addWidget(message_);
  layout->addWidget(split, 1);
  for (QWidget* part : {static_cast<QWidget*>(shown_label_), static_cast<QWidget*>(shown_),
                        static_cast<QWidget*>(add_)})
    part->setVisible(of_ == Of::kDataset);
  connectParts();
  follow_language(this, [this] { retranslate(); });
  showState();
}

CameraPage::~CameraPage() {
  work_.disconnect(this);
}

void CameraPage::setChoices(Choices& choices) {
  choices_ = &choices;
  showState();
}

QWidget* CameraPage::createKnowledge() {
  auto* halves = new QSplitter(Qt::Vertical, this);
  halves->setChildrenCollapsible(false);
  text_ = new QTextBrowser(halves);
  text_->setObjectName(QStringLiteral("camera_text"));
  text_->setWordWrapMode(QTextOption::WordWrap);
  images_ = new QTreeWidget(halves);
  images_->setObjectName(QStringLiteral("camera_images"));
  images_->setRootIsDecorated(false);
  images_->setUniformRowHeights(true);
  images_->setColumnCount(4);
  images_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  images_->header()->setMinimumSectionSize(30);
  halves->setSizes({380, 200});
  return halves;
}

QWidget* CameraPage::createFigures() {
  tabs_ = new QTabWidget(this);
  tabs_->setObjectName(QStringLiteral("camera_figures"));
  residuals_ = new ResidualMapPlot(ResidualMapPlot::Plane::kImage, tabs_);
  uncertainty_ = new UncertaintyMapPlot(UncertaintyMapPlot::Of::kIntrinsics, tabs_);
  image_ = new ImageView(tabs_);
  image_->setObjectName(QStringLiteral("camera_image"));
  tabs_->addTab(residuals_, {});
  tabs_->addTab(uncertainty_, {});
  tabs_->addTab(image_, {});
  auto* tools = new QWidget(tabs_);
  auto* row = new QHBoxLayout(tools);
  row->setContentsMargins(0, 0, 0, 0);
  exclude_ = new QToolButton(tools);
  exclude_->setObjectName(QStringLiteral("camera_exclude"));
  exclude_->hide();
  brush_ = new QToolButton(tools);
  brush_->setObjectName(QStringLiteral("camera_brush"));
  brush_->setCheckable(true);
  row->addWidget(exclude_);
  row->addWidget(brush_);
  tabs_->setCornerWidget(tools);
  tools->setVisible(of_ == Of::kDataset);
  return tabs_;
}

void CameraPage::connectParts() {
  connect(shown_, &QComboBox::currentIndexChanged, this, [this] {
    stale_ = true;
    ask();
  });
  connect(add_, &QPushButton::clicked, this, &CameraPage::addImages);
  connect(calibrate_, &QPushButton::clicked, this, &CameraPage::calibrate);
  connect(save_, &QPushButton::clicked, this, &CameraPage::save);
  connect(cancel_, &QPushButton::clicked, this, [this] { work_.cancel(); });
  connect(images_, &QTreeWidget::currentItemChanged, this, &CameraPage::showImage);
  connect(brush_, &QToolButton::toggled, this, [this](bool on) {
    residuals_->setBrushing(on);
    if (on) tabs_->setCurrentWidget(residuals_);
    clearBrush();
  });
  connect(residuals_, &ResidualMapPlot::brushed, this, &CameraPage::brush);
  connect(exclude_, &QToolButton::clicked, this, [this] {
    const std::map<QString, SceneEdits> more = brushed_;
    clearBrush();
    Q_EMIT excludeWanted(more);
  });
  for (FigureActions* actions :
       {residuals_->figureActions(), uncertainty_->figureActions(), image_->figureActions()})
    connect(actions, &FigureActions::failed, this, &CameraPage::failed);
  connect(&work_, &CameraWork::progressed, this, [this](double fraction, const QString& text) {
    progress_->setValue(static_cast<int>(1000.0 * fraction));
    progress_->setFormat(text);
  });
  connect(&work_, &CameraWork::calibrated, this, &CameraPage::takeCalibration);
  connect(&work_, &CameraWork::added, this, &CameraPage::datasetChanged);
  connect(&work_, &CameraWork::failed, this, [this](const Error& error) {
    error_ = error;
    showState();
  });
  connect(&work_, &CameraWork::ended, this, &CameraPage::showState);
}

void CameraPage::setDataset(std::optional<Dataset> dataset) {
  const bool other = !dataset || !dataset_ || dataset->path != dataset_->path;
  dataset_ = std::move(dataset);
  error_.reset();
  if (other) {
    work_.cancel();
    alone_.reset();
    shown_->setCurrentIndex(kCalibration);
    setResult(nullptr);
  }
  showText();
  showState();
}

void CameraPage::setPhotos(std::optional<BoardPhotos> photos) {
  work_.cancel();
  photos_ = std::move(photos);
  error_.reset();
  alone_.reset();
  stale_ = true;
  ask();
  showText();
  showState();
}

void CameraPage::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  if (!showsAlone()) {
    stale_ = true;
    ask();
  }
  showState();
}

bool CameraPage::showsAlone() const {
  return of_ == Of::kPhotos || shown_->currentIndex() == kAlone;
}

const Camera* CameraPage::shownCamera() const {
  if (showsAlone()) return alone_ ? &alone_->camera : nullptr;
  return result_ ? &result_->camera : nullptr;
}

void CameraPage::addImages() {
  if (!dataset_ || choices_ == nullptr) return;
  const QStringList images =
      choices_->images_to_add(this, QString::fromStdString(dataset_->path.string()));
  if (images.isEmpty()) return;
  error_.reset();
  work_.add(*dataset_, images);
  showState();
}

// Everything is found from the images: the given camera is what the result is compared with.
void CameraPage::calibrate() {
  error_.reset();
  if (photos_) work_.calibrate(photos_->images, photos_->target, photos_->options);
  if (!dataset_) {
    showState();
    return;
  }
  std::vector<std::filesystem::path> images;
  for (const SceneFiles& scene : dataset_->scenes) {
    if (!scene.image.empty()) images.push_back(scene.image);
  }
  images.insert(images.end(), dataset_->camera_images.begin(), dataset_->camera_images.end());
  work_.calibrate(std::move(images), dataset_->target, {});
  showState();
}

void CameraPage::takeCalibration(const std::shared_ptr<const CameraCalibration>& calibration) {
  alone_ = calibration;
  stale_ = true;
  if (showsAlone()) {
    ask();
  } else {
    shown_->setCurrentIndex(kAlone);
  }
  showState();
}

void CameraPage::save() {
  const Camera* camera = shownCamera();
  if (camera == nullptr || choices_ == nullptr || (!dataset_ && !photos_)) return;
  const std::filesystem::path own = (dataset_ ? dataset_->path : photos_->folder) / "camera.yaml";
  const std::filesystem::path suggestion =
      dataset_ ? dataset_->path / "camera-calibrated.yaml" : own;
  const QString path = choices_->file_to_export(this, QString::fromStdString(suggestion.string()),
                                                tr("YAML (*.yaml *.yml)"));
  if (path.isEmpty()) return;
  const IntrinsicsVector sigma = showsAlone() ? alone_->sigma : result_->intrinsics.sigma;
  const Status written =
      write_file_atomically(path.toStdString(), to_yaml(*camera, CameraDeviations(sigma)));
  if (!written) {
    Q_EMIT failed(core_text(written.error()));
    return;
  }
  Q_EMIT saved(path);
  std::error_code code;
  if (dataset_ && std::filesystem::equivalent(path.toStdString(), own, code))
    Q_EMIT datasetChanged();
}

// The figures are made in a thread of their own, and only while somebody looks.
void CameraPage::ask() {
  if (!stale_ || !isVisible()) return;
  stale_ = false;
  figures_worker_.start(
      [this, alone = showsAlone() ? alone_ : nullptr, result = showsAlone() ? nullptr : result_](
          const RunContext&, const Runner::Post&) -> Runner::Deliver {
        std::shared_ptr<const CameraFigures> made;
        if (alone) made = std::make_shared<const CameraFigures>(camera_figures(*alone));
        if (result) made = std::make_shared<const CameraFigures>(camera_figures(*result));
        const auto view = made && made->corners.size() > 0 ? view_of(*made) : nullptr;
        return [this, made, view] {
          figures_ = made;
          residuals_->setView(view);
          clearBrush();
          showFigures();
        };
      });
}

void CameraPage::showFigures() {
  const Camera* camera = shownCamera();
  const QSize size = camera != nullptr ? QSize(camera->width_px, camera->height_px) : QSize();
  const bool known = figures_ && !figures_->projection.pixel.empty();
  uncertainty_->setMap(known ? std::optional(figures_->projection) : std::nullopt, size);
  showText();
  showImages();
  showState();
}

void CameraPage::showText() {
  const QPalette palette = QGuiApplication::palette();
  CameraKnowledge known;
  if (dataset_) {
    known.given = &dataset_->camera;
    if (dataset_->camera_deviations) known.stated = &*dataset_->camera_deviations;
  }
  known.result = result_.get();
  known.alone = alone_.get();
  QString html = intrinsics_table(known);
  if (figures_ && !stale_) {
    if (showsAlone() && alone_) {
      html += camera_verdict(*alone_, *figures_, palette);
    } else if (!showsAlone() && result_) {
      html += camera_verdict(*result_, *figures_, palette);
    }
  }
  text_->setHtml(html);
}

void CameraPage::showImages() {
  const int before = images_->indexOfTopLevelItem(images_->currentItem());
  images_->clear();
  showImage();  // Nothing is chosen; an empty list does not say so by itself.
  if (!figures_) return;
  for (const CameraFigures::Image& image : figures_->images) {
    const bool used = image.corners > 0;
    auto* item = new QTreeWidgetItem(
        images_, {QString::fromStdString(image.name),
                  used ? QString::number(image.corners) : QStringLiteral("–"),
                  used ? QString::number(image.rms_px, 'f', 3) : QStringLiteral("–"),
                  core_text(image.reason)});
    item->setTextAlignment(kCorners, Qt::AlignRight | Qt::AlignVCenter);
    item->setTextAlignment(kRms, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(kReason, core_text(image.reason));
  }
  const int count = images_->topLevelItemCount();
  if (count > 0) images_->setCurrentItem(images_->topLevelItem(std::clamp(before, 0, count - 1)));
}

std::filesystem::path CameraPage::pathOf(const CameraFigures::Image& image) const {
  if (!image.path.empty() || !dataset_) return image.path;
  for (const SceneFiles& scene : dataset_->scenes) {
    if (scene.name == image.name) return scene.image;
  }
  return {};
}

void CameraPage::showImage() {
  const int index = images_->indexOfTopLevelItem(images_->currentItem());
  image_loader_.abandon();  // What it loads is not what is chosen now.
  image_->setImage({});
  image_->setMessage({});
  image_->overlay().setOverlay({});
  if (!figures_ || index < 0) return;
  const std::filesystem::path path = pathOf(figures_->images[static_cast<std::size_t>(index)]);
  if (path.empty()) return;
  image_->setMessage(tr("The image is being loaded …"));
  image_loader_.start(
      [this, path, index](const RunContext&, const Runner::Post&) -> Runner::Deliver {
        auto image = read_scene_image(path);
        return [this, image, index] {
          image_->setMessage(image ? QString()
                                   : tr("There is no image: %1").arg(core_text(image.error())));
          image_->setImage(image ? *image : QImage());
          image_->fit();
          showOverlay(index);
        };
      });
}

void CameraPage::showOverlay(int index) {
  if (!figures_) return;
  ImageOverlay overlay;
  const ResidualColumns& c = figures_->corners;
  for (std::size_t k = 0; k + 1 < c.size(); k += 2) {
    if (c.scene[k] != index) continue;
    ImageOverlay::Corner corner;
    corner.detected = {static_cast<double>(c.covariates[0].values[k]),
                       static_cast<double>(c.covariates[1].values[k])};
    corner.predicted = corner.detected - QPointF(static_cast<double>(c.value[k]),
                                                 static_cast<double>(c.value[k + 1]));
    corner.has_prediction = true;
    overlay.corners.push_back(corner);
  }
  image_->overlay().setOverlay(std::move(overlay));
  image_->viewport()->update();
}

void CameraPage::showState() {
  const bool busy = work_.busy();
  progress_->setVisible(busy);
  cancel_->setVisible(busy);
  add_->setEnabled(dataset_ && choices_ != nullptr && !busy);
  calibrate_->setEnabled((dataset_ || photos_) && !busy);
  const bool estimated = showsAlone()
                             ? alone_ != nullptr
                             : result_ && result_->intrinsics.mode != IntrinsicsMode::kFixed;
  save_->setEnabled(estimated && choices_ != nullptr && !busy);
  shown_->setEnabled(alone_ != nullptr);
  // The camera alone takes every image: nothing is left out of these.
  brush_->setEnabled(!showsAlone() && result_ != nullptr);
  if (!brush_->isEnabled()) brush_->setChecked(false);
  message_->setVisible(error_.has_value());
  message_->setText(error_ ? core_text(*error_) : QString());
}

// Images of scenes come first, in the result's order; others have no tags that could be left out.
void CameraPage::brush(const QRectF& area_px) {
  brushed_.clear();
  std::vector<std::size_t> rows;
  if (!figures_ || stale_ || showsAlone() || !result_) return;
  const ResidualColumns& c = figures_->corners;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Eigen::Vector2f at(c.covariates[0].values[k], c.covariates[1].values[k]);
    const auto scene = static_cast<std::size_t>(c.scene[k]);
    if (scene >= result_->scenes.size() || !result_->scenes[scene].view ||
        !area_px.contains(QPointF(static_cast<double>(at.x()), static_cast<double>(at.y()))))
      continue;
    rows.push_back(k);
    const SceneResult& from = result_->scenes[scene];
    std::vector<int>& tags = brushed_[QString::fromStdString(from.name)].tags;
    for (const CornerObservation& corner : from.view->corners) {
      if (corner.pixel.cast<float>() == at && !contains_id(tags, corner.feature_id))
        tags.push_back(corner.feature_id);
    }
  }
  residuals_->setSelected(std::move(rows));
  showBrushed();
}

void CameraPage::clearBrush() {
  brushed_.clear();
  residuals_->setSelected({});
  showBrushed();
}

void CameraPage::showBrushed() {
  std::size_t count = 0;
  QStringList lines;
  for (const auto& [scene, edits] : brushed_) {
    count += edits.tags.size();
    lines << tr("Scene %1: %2").arg(scene, ids_text(edits.tags));
  }
  exclude_->setVisible(count > 0);
  exclude_->setText(tr("Exclude their tags (%1)").arg(count));
  exclude_->setToolTip(tr("Leave out the tags of the corners selected, and solve again") +
                       QLatin1Char('\n') + lines.join(QLatin1Char('\n')));
}

void CameraPage::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) showText();
  QWidget::changeEvent(event);
}

void CameraPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  ask();
}

void CameraPage::retranslate() {
  shown_label_->setText(tr("&Shown"));
  shown_->setItemText(kCalibration, tr("camera of this calibration"));
  shown_->setItemText(kAlone, tr("camera from images alone"));
  add_->setText(tr("&Add images…"));
  add_->setToolTip(
      tr("Images of the board without a cloud: they are copied into the dataset's folder "
         "intrinsics/ and count for the camera alone"));
  calibrate_->setText(tr("&Calibrate the camera"));
  calibrate_->setToolTip(
      tr("From all images of the board, without the LiDAR and without the given intrinsics"));
  save_->setText(tr("Sa&ve camera.yaml…"));
  save_->setToolTip(tr("The camera shown, with its standard deviations"));
  cancel_->setText(tr("Cancel"));
  images_->setHeaderLabels({tr("Image"), tr("corners"), tr("RMS, px"), tr("not used because")});
  brush_->setText(tr("Brush"));
  brush_->setToolTip(
      tr("Draw a rectangle over corners in the residuals: their tags can be left out of their "
         "scenes"));
  showBrushed();
  tabs_->setTabText(0, tr("Residuals"));
  tabs_->setTabText(1, tr("Uncertainty"));
  tabs_->setTabText(2, tr("Image"));
  text_->setAccessibleName(tr("Intrinsics"));
  images_->setAccessibleName(tr("Images of the board"));
  showText();
  showImages();
  showState();
}

}  // namespace lvcalib::widgets

#include "moc_camera_page.cpp"
