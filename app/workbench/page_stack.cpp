// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/page_stack.h"

#include <QEvent>
#include <QTabWidget>
#include <algorithm>

#include "intrinsics/camera_page.h"
#include "pages/colors_pane.h"
#include "pages/extrinsic_page.h"
#include "pages/refinement_page.h"
#include "pages/response_page.h"
#include "pages/scene_page.h"
#include "runner/model_work.h"
#include "start/welcome_page.h"

namespace lvcalib::widgets {
namespace {

constexpr int kLiveIntervalMs = 150;

}  // namespace

PageStack::PageStack(QWidget* parent)
    : QStackedWidget(parent),
      welcome_(new WelcomePage(this)),
      tabs_(new QTabWidget(this)),
      scene_(new ScenePage(tabs_)),
      refinement_(new RefinementPage(tabs_)),
      extrinsic_(new ExtrinsicPage(tabs_)),
      response_(new ResponsePage(tabs_)) {
  tabs_->setObjectName(QStringLiteral("pages"));
  tabs_->setDocumentMode(true);
  tabs_->addTab(scene_, {});
  tabs_->addTab(refinement_, {});
  tabs_->addTab(extrinsic_, {});
  tabs_->addTab(response_, {});
  addWidget(welcome_);
  addWidget(tabs_);
  connect(scene_, &ScenePage::cropChanged, this,
          [this](int scene, const CropBox& box) { Q_EMIT crop_wanted(scene, box); });
  connect(scene_, &ScenePage::cropCleared, this,
          [this](int scene) { Q_EMIT crop_wanted(scene, std::nullopt); });
  connect(scene_, &ScenePage::editsChanged, this, &PageStack::edits_wanted);
  connect(refinement_, &RefinementPage::editsWanted, this, &PageStack::edits_wanted);
  connect(scene_, &ScenePage::patchExcluded, this, &PageStack::patch_excluded);
  connect(scene_, &ScenePage::insistWanted, this, &PageStack::insist_wanted);
  connect(response_, &ResponsePage::keepWanted, this, &PageStack::keep_wanted);
  connect(response_, &ResponsePage::partExcluded, this,
          [this](const QString& scene, const std::vector<Eigen::Vector2d>& patch_m) {
            if (scene.isEmpty()) {
              Q_EMIT patch_excluded(patch_m);
            } else {
              Q_EMIT scene_patch_excluded(scene, patch_m);
            }
          });
  connect(response_, &ResponsePage::keepPatchWanted, this, &PageStack::keep_patch_wanted);
  connect(response_, &ResponsePage::takenBack, this, &PageStack::taken_back);
  connect(response_, &ResponsePage::keptDropped, this, &PageStack::kept_dropped);
  connect(refinement_, &RefinementPage::keepWanted, this, &PageStack::keep_wanted);
  connect(response_, &ResponsePage::insistWanted, this, [this](const QString& name) {
    for (std::size_t s = 0; result_ && s < result_->scenes.size(); ++s) {
      if (result_->scenes[s].name == name.toStdString()) Q_EMIT insist_wanted(static_cast<int>(s));
    }
  });
  connect(scene_, &ScenePage::failed, this, &PageStack::failed);
  connect(refinement_, &RefinementPage::failed, this, &PageStack::failed);
  connect(extrinsic_, &ExtrinsicPage::failed, this, &PageStack::failed);
  connect(extrinsic_->world(), &WorldPane::excludeWanted, this, &PageStack::exclude_points);
  connect(extrinsic_->colors(), &ColorsPane::excludeWanted, this, &PageStack::exclude_points);
  connect(extrinsic_, &ExtrinsicPage::sceneActivated, this, &PageStack::scene_wanted);
  connect(response_, &ResponsePage::failed, this, &PageStack::failed);
  connect(response_, &ResponsePage::sceneActivated, this, &PageStack::scene_wanted);
  live_.setSingleShot(true);
  live_.setInterval(kLiveIntervalMs);
  connect(&live_, &QTimer::timeout, this, &PageStack::show_latest);
  retranslate();
}

void PageStack::add_pages(ModelWork& work, Choices& choices) {
  model_ = new ModelPage(work, tabs_);
  tabs_->addTab(model_, {});
  camera_ = new CameraPage(tabs_);
  camera_->setChoices(choices);
  tabs_->addTab(camera_, {});
  connect(camera_, &CameraPage::failed, this, &PageStack::failed);
  connect(camera_, &CameraPage::excludeWanted, this, &PageStack::measurements_excluded);
  connect(camera_, &CameraPage::datasetChanged, this, &PageStack::dataset_changed);
  connect(model_, &ModelPage::failed, this, &PageStack::failed);
  connect(&work, &ModelWork::changed, scene_, [this, &work] { scene_->setModel(work.step()); });
  connect(model_, &ModelPage::samplesSelected, this,
          [this](const SamplesOfScenes& samples) { samples_ = samples; });
  connect(model_, &ModelPage::excludeWanted, this, &PageStack::exclude_samples);
  // Not while they are being selected: only once the scene is looked at.
  connect(tabs_, &QTabWidget::currentChanged, this, &PageStack::show_samples);
  retranslate();
}

void PageStack::show_samples() {
  if (tabs_->currentWidget() != scene_ || !result_ || current_ < 0) return;
  if (current_ >= static_cast<int>(result_->scenes.size())) return;
  const auto& name = result_->scenes[static_cast<std::size_t>(current_)].name;
  const auto at = samples_.find(QString::fromStdString(name));
  if (at == samples_.end()) return;
  if (!at->second.points_in_lidar_m.empty() || !at->second.pixels.empty())
    scene_->selectSamples(at->second.points_in_lidar_m, at->second.pixels);
}

void PageStack::exclude_points(const PointsOfScenes& points) {
  std::map<QString, SceneEdits> more;
  for (const auto& [scene, of_scene] : points) more[scene].points_m = of_scene;
  Q_EMIT measurements_excluded(more);
}

// What was selected on the Model page: returns by their directions, corners by their tags.
void PageStack::exclude_samples() {
  if (!result_) return;
  std::map<QString, SceneEdits> more;
  for (const SceneResult& scene : result_->scenes) {
    const auto at = samples_.find(QString::fromStdString(scene.name));
    if (at == samples_.end()) continue;
    SceneEdits out;
    for (const std::uint32_t i : same_directions(scene.board_points, at->second.points_in_lidar_m))
      out.points_m.push_back(scene.board_points.points_m[i]);
    const auto& pixels = at->second.pixels;
    const auto picked = [&](const CornerObservation& c) {
      return !contains_id(out.tags, c.feature_id) &&
             std::find(pixels.begin(), pixels.end(), c.pixel) != pixels.end();
    };
    if (scene.view) {
      for (const CornerObservation& c : scene.view->corners) {
        if (picked(c)) out.tags.push_back(c.feature_id);
      }
    }
    if (!out.empty()) more[at->first] = std::move(out);
  }
  Q_EMIT measurements_excluded(more);
}

ThresholdPane* PageStack::thresholds() const {
  return extrinsic_->thresholds();
}

void PageStack::show_pages() {
  setCurrentWidget(tabs_);
}

void PageStack::show_tab(int tab) {
  tabs_->setCurrentIndex(tab);
}

int PageStack::tab() const {
  return currentWidget() == tabs_ ? tabs_->currentIndex() : -1;
}

int PageStack::tab_count() const {
  return tabs_->count();
}

void PageStack::start(const Dataset& dataset) {
  samples_.clear();
  set_result(nullptr);
  scene_->setTarget(dataset.target);
  refinement_->setTarget(dataset.target);
  set_scene(-1, std::nullopt);
  set_dataset(dataset);
}

void PageStack::set_dataset(const Dataset& dataset) {
  if (camera_ != nullptr) camera_->setDataset(dataset);
}

void PageStack::set_result(const std::shared_ptr<const CalibrationResult>& result) {
  latest_.reset();  // A finished run has more to show.
  result_ = result;
  scene_->setResult(result);
  refinement_->setResult(result);
  extrinsic_->setResult(result);
  response_->setResult(result);
  if (camera_ != nullptr) camera_->setResult(result);
  show_samples();  // Beams are the same in another result.
}

void PageStack::set_standing(const Standing& standing) {
  extrinsic_->setStanding(standing);
}

void PageStack::set_scene(int scene, const std::optional<CropBox>& box) {
  current_ = scene;
  latest_.reset();
  scene_->setScene(scene);
  refinement_->setScene(scene);
  crop_ = box;
  scene_->setCropBox(box);
}

void PageStack::set_crop_box(const std::optional<CropBox>& box) {
  if (box == crop_) return;
  crop_ = box;
  scene_->setCropBox(box);
}

void PageStack::set_edits(const SceneEdits& edits) {
  scene_->setEdits(edits);
  refinement_->setEdits(edits);
}

void PageStack::set_scene_data(const SceneData& data) {
  scene_->setSceneData(data.cloud, data.image);
  scene_->setProblems(data.cloud_problem, data.image_problem);
  extrinsic_->setSceneData(current_, data.cloud, data.image);
  show_samples();
}

void PageStack::show_board_points(int scene, const std::shared_ptr<const Cloud>& board_points) {
  if (scene == current_) refinement_->setLivePoints(scene, board_points);
}

void PageStack::show_iteration(int scene, const std::shared_ptr<const BoardRefinement>& partial) {
  if (scene != current_) return;
  latest_ = partial;
  if (!live_.isActive()) live_.start();
}

void PageStack::show_latest() {
  if (latest_ && refinement_->isVisible()) refinement_->showIteration(current_, latest_);
  latest_.reset();
}

void PageStack::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) retranslate();
  QStackedWidget::changeEvent(event);
}

void PageStack::retranslate() {
  tabs_->setTabText(0, tr("Scene"));
  tabs_->setTabText(1, tr("Refinement"));
  tabs_->setTabText(2, tr("Extrinsic"));
  tabs_->setTabText(3, tr("Boundary response"));
  if (model_ != nullptr) tabs_->setTabText(4, tr("Model"));
  if (camera_ != nullptr) tabs_->setTabText(5, tr("Camera"));
}

}  // namespace lvcalib::widgets

#include "moc_page_stack.cpp"
