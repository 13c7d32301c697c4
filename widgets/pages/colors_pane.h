// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QWidget>
#include <memory>

#include "pages/cloud_brush.h"
#include "pipeline/calibration.h"

namespace lvcalib::widgets {

class CloudSceneBuilder;
class CloudView;

/// A scene's cloud in the camera's colours: the quickest check of an extrinsic by eye. Points about
/// the board can be left out here, too.
class ColorsPane : public QWidget {
  Q_OBJECT

 public:
  explicit ColorsPane(QWidget* parent = nullptr);

  /// Null: nothing is known yet.
  void setResult(std::shared_ptr<const CalibrationResult> result);
  /// Cloud and image of the scene that is shown: index into the result's scenes.
  void setSceneData(int scene, std::shared_ptr<const Cloud> full_cloud, QImage image);
  [[nodiscard]] CloudView* view() const { return view_; }
  [[nodiscard]] bool busy() const;

 Q_SIGNALS:
  /// Brushed points are to be left out, by scene.
  void excludeWanted(const lvcalib::widgets::PointsOfScenes& points);
  void failed(const QString& message);

 private:
  void rebuild();
  [[nodiscard]] PointsOfScenes byScene(const std::vector<std::uint32_t>& points) const;

  std::shared_ptr<const CalibrationResult> result_;
  std::shared_ptr<const Cloud> full_cloud_;
  QImage image_;
  int scene_ = -1;
  CloudView* view_;
  CloudSceneBuilder* builder_;
  CloudBrush* brush_ = nullptr;
};

}  // namespace lvcalib::widgets
