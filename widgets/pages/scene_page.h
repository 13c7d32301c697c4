// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>

#include "pages/scene_overlay.h"
#include "pipeline/board_surface.h"
#include "pipeline/calibration.h"
#include "pipeline/crop_box.h"
#include "pipeline/refusals.h"
#include "selection/model_session.h"
#include "views/cloud_scene.h"
#include "views/image_overlay.h"

class QLabel;

namespace lvcalib::widgets {

class CloudPane;
class ImagePane;
class SelectionBar;
struct SceneSelection;

/// One scene: its cloud on the left, its image on the right, and what was found in both. What is
/// selected in one is highlighted in the other.
class ScenePage : public QWidget {
  Q_OBJECT

 public:
  explicit ScenePage(QWidget* parent = nullptr);
  ~ScenePage() override;

  /// Null: nothing is known yet.
  void setResult(std::shared_ptr<const CalibrationResult> result);
  /// What the clouds show: looked for in them as long as there is no result.
  void setTarget(const Target& target);
  /// The model in force, for what it leaves over the board; null: the calibration's own.
  void setModel(ModelStepPtr step);
  /// Which scene of the dataset; −1: none. Another scene's cloud and image are let go.
  void setScene(int index);
  [[nodiscard]] int scene() const { return scene_; }
  /// Cloud and image of the current scene, once they are loaded; either may be missing.
  void setSceneData(std::shared_ptr<const Cloud> full_cloud, QImage image);
  /// Why the cloud or the image of the current scene is missing: shown in its place.
  void setProblems(const Message& cloud, const Message& image);
  /// The crop box in force for the current scene, or none.
  void setCropBox(const std::optional<CropBox>& box);

  /// What is decided about the current scene's measurements.
  void setEdits(const SceneEdits& edits);

  /// Highlights measurements of the current scene: LiDAR points (by their directions) and pixels.
  void selectSamples(const std::vector<Eigen::Vector3d>& points_in_lidar_m,
                     const std::vector<Eigen::Vector2d>& pixels);

  [[nodiscard]] CloudPane* cloudPane() const { return cloud_; }
  [[nodiscard]] ImagePane* imagePane() const { return image_; }

 Q_SIGNALS:
  /// The user wants this scene cropped (box in the LiDAR frame), or no longer.
  void cropChanged(int scene, const lvcalib::CropBox& box);
  void cropCleared(int scene);
  /// What of this scene is left out by hand, or used all the same.
  void editsChanged(int scene, const lvcalib::SceneEdits& edits);
  /// A patch of the board is to be left out of every scene.
  void patchExcluded(const std::vector<Eigen::Vector2d>& patch_m);
  /// The program refused this scene; the user wants it used all the same.
  void insistWanted(int scene);
  /// A figure could not be saved, in words.
  void failed(const QString& message);

 private:
  void connectPanes();
  void refresh();
  void refreshOverlay();
  void selectPoint(std::uint32_t point);
  void selectPixel(const QPointF& pixel);
  void selectTag(int id);
  void selectCircle(int id);
  void brushPoints(const std::vector<std::uint32_t>& points, bool add);
  void brushImage(const QPolygonF& line, bool add);
  void selectPart(const BoardPart& part);
  [[nodiscard]] QString refusalOfPoint(const Eigen::Vector3f& point_m) const;
  /// Makes this the selection, or adds it; shows it in both views and says so.
  void select(SceneSelection selection, bool add);
  /// The points of the scene's cloud that are about the board: what can be decided about.
  [[nodiscard]] std::vector<Eigen::Vector3f> aboutBoard(
      const std::vector<std::uint32_t>& points) const;
  void showRefusal();
  [[nodiscard]] QString refusalOf(Refusal::What what, int id) const;
  void clearSelection();
  [[nodiscard]] std::function<std::optional<BoardSurface>()> surface() const;
  void showSamples();
  [[nodiscard]] const SceneResult* current() const;
  [[nodiscard]] QString describePoint(const Cloud& cloud, std::uint32_t point) const;

  std::shared_ptr<const CalibrationResult> result_;
  ModelStepPtr model_;
  std::optional<Target> target_;
  std::shared_ptr<const Cloud> full_cloud_;
  QImage picture_;
  Message cloud_problem_;
  Message image_problem_;
  std::vector<Eigen::Vector3d> sample_points_m_;  // Selected elsewhere; LiDAR frame.
  std::vector<Eigen::Vector2d> sample_pixels_;
  int scene_ = -1;
  CloudPane* cloud_ = nullptr;
  ImagePane* image_ = nullptr;
  std::optional<std::uint32_t> picked_;  // In the cloud shown; the one before is measured from.
  Eigen::Vector3f picked_m_ = Eigen::Vector3f::Zero();
  QLabel* refusal_ = nullptr;
  QLabel* edits_ = nullptr;
  SelectionBar* selection_ = nullptr;
};

}  // namespace lvcalib::widgets
