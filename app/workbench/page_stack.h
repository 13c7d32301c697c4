// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QStackedWidget>
#include <QTimer>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "modelling/model_page.h"
#include "pages/world_pane.h"
#include "pipeline/calibration.h"
#include "runner/scene_data.h"
#include "words/quality_text.h"

class QTabWidget;

namespace lvcalib::widgets {

class CameraPage;
class Choices;
class ExtrinsicPage;
class ModelWork;
class RefinementPage;
class ResponsePage;
class ScenePage;
class ThresholdPane;
class WelcomePage;

/// The middle of the window: the welcome page, or the pages of what is open, one per tab.
/// Scenes are counted as in the dataset.
class PageStack : public QStackedWidget {
  Q_OBJECT

 public:
  explicit PageStack(QWidget* parent = nullptr);
  /// Adds the Model page and the Camera page; `work` and `choices` must outlive this.
  void add_pages(ModelWork& work, Choices& choices);
  [[nodiscard]] ModelPage* model_page() const { return model_; }
  [[nodiscard]] ThresholdPane* thresholds() const;
  [[nodiscard]] ExtrinsicPage* extrinsic_page() const { return extrinsic_; }
  [[nodiscard]] WelcomePage& welcome() const { return *welcome_; }
  void show_pages();
  void show_tab(int tab);
  [[nodiscard]] int tab_count() const;
  /// The tab in view; −1 on the welcome page.
  [[nodiscard]] int tab() const;

  /// Another dataset: nothing of the one before stays.
  void start(const Dataset& dataset);
  /// What is open, after a change on disk too: on the page of the camera.
  void set_dataset(const Dataset& dataset);
  void set_result(const std::shared_ptr<const CalibrationResult>& result);
  /// What the verdict on that result rests on.
  void set_standing(const Standing& standing);
  void set_scene(int scene, const std::optional<CropBox>& box);
  /// The box in force; a box that is being edited stays unless this one is another than before.
  void set_crop_box(const std::optional<CropBox>& box);
  void set_edits(const SceneEdits& edits);
  /// Of the scene last set.
  void set_scene_data(const SceneData& data);
  void show_board_points(int scene, const std::shared_ptr<const Cloud>& board_points);
  /// Shown a few times a second, and only while the page is seen.
  void show_iteration(int scene, const std::shared_ptr<const BoardRefinement>& partial);

 Q_SIGNALS:
  /// A scene that the program refused is to be used all the same.
  void insist_wanted(int scene);
  void edits_wanted(int scene, const lvcalib::SceneEdits& edits);
  /// A tag, or else a circle, that the program refused is to be used all the same.
  void keep_wanted(const QString& scene, bool tag, int id);
  /// The dataset's images, or its camera.yaml, have changed on disk.
  void dataset_changed();
  /// The same of a part of the board, by its number among those refused in the scene.
  void keep_patch_wanted(const QString& scene, int id);
  /// What the program refused of a scene is to be left out again.
  void kept_dropped(const QString& scene);
  /// What these edits leave out of a scene by hand is to be used again.
  void taken_back(const QString& scene, const lvcalib::SceneEdits& what);
  /// Points and tags are to be left out of several scenes.
  void measurements_excluded(const std::map<QString, lvcalib::SceneEdits>& more);
  /// A patch of the board is to be left out of one scene.
  void scene_patch_excluded(const QString& scene, const std::vector<Eigen::Vector2d>& patch_m);
  /// A patch of the board is to be left out of every scene.
  void patch_excluded(const std::vector<Eigen::Vector2d>& patch_m);
  void crop_wanted(int scene, const std::optional<lvcalib::CropBox>& box);
  void scene_wanted(int scene);
  void failed(const QString& message);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void retranslate();
  void show_latest();
  void show_samples();
  void exclude_points(const PointsOfScenes& points);
  void exclude_samples();

  int current_ = -1;
  std::optional<CropBox> crop_;
  std::shared_ptr<const BoardRefinement> latest_;  // Of the current scene, not shown yet.
  QTimer live_;
  WelcomePage* welcome_;
  QTabWidget* tabs_;
  ScenePage* scene_;
  RefinementPage* refinement_;
  ExtrinsicPage* extrinsic_;
  ResponsePage* response_;
  ModelPage* model_ = nullptr;
  CameraPage* camera_ = nullptr;
  SamplesOfScenes samples_;  // Selected on the Model page.
  std::shared_ptr<const CalibrationResult> result_;
};

}  // namespace lvcalib::widgets
