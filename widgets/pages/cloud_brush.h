// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <QWidget>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "pipeline/calibration.h"

class QAction;
class QLabel;
class QToolButton;

namespace lvcalib::widgets {

class CloudSceneBuilder;
class CloudView;
class ToolRow;

/// Points of several scenes (LiDAR frame), by the scenes' names.
using PointsOfScenes = std::map<QString, std::vector<Eigen::Vector3f>>;

/// Those of some points of a cloud that lie about a scene's board, exactly as the scene has them:
/// all others play no part.
std::vector<Eigen::Vector3f> points_about_board(const SceneResult& scene, const Cloud& cloud,
                                                const std::vector<std::uint32_t>& points);

/// Indices of a cloud's points that lie in these directions, as seen from the origin.
std::vector<std::uint32_t> same_directions(const Cloud& cloud,
                                           const std::vector<Eigen::Vector3d>& wanted);

/// The brush of a cloud view: its tool in a row, what is selected with it, and the button that
/// leaves it out.
class CloudBrush : public QObject {
  Q_OBJECT

 public:
  /// Which points, by places in the cloud that is shown, can be left out of which scenes.
  using ByScene = std::function<PointsOfScenes(const std::vector<std::uint32_t>&)>;

  /// `name` begins the names of the tool and its button.
  CloudBrush(CloudView* view, ToolRow* row, const QString& name, ByScene by_scene);
  /// Nothing is selected: the points are those of another cloud.
  void clear();

 Q_SIGNALS:
  /// What is selected is to be left out.
  void excludeWanted(const lvcalib::widgets::PointsOfScenes& points);

 private:
  void retranslate();
  void select(const std::vector<std::uint32_t>& points, bool add);

  CloudView* view_;
  ByScene by_scene_;
  std::vector<std::uint32_t> selected_;
  QAction* brush_;
  QLabel* text_;
  QToolButton* exclude_;
};

/// A cloud of scenes with the view's tools and a brush above it.
class BrushedCloudPane : public QWidget {
  Q_OBJECT

 public:
  [[nodiscard]] CloudView* view() const { return view_; }
  [[nodiscard]] bool busy() const;

 Q_SIGNALS:
  /// Brushed points are to be left out, by scene.
  void excludeWanted(const lvcalib::widgets::PointsOfScenes& points);
  void failed(const QString& message);

 protected:
  explicit BrushedCloudPane(QWidget* parent);
  /// Behind the tools of a kind of pane; `name` as of CloudBrush.
  void addTools(const QString& name);
  [[nodiscard]] ToolRow* row() const { return row_; }
  [[nodiscard]] CloudBrush* brush() const { return brush_; }
  [[nodiscard]] CloudSceneBuilder* builder() const { return builder_; }
  [[nodiscard]] virtual PointsOfScenes byScene(const std::vector<std::uint32_t>& points) const = 0;

 private:
  ToolRow* row_;
  CloudView* view_;
  CloudSceneBuilder* builder_;
  CloudBrush* brush_ = nullptr;
};

}  // namespace lvcalib::widgets
