// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/crop_box.h"
#include "views/cloud_canvas.h"
#include "views/cloud_geometry.h"
#include "views/cloud_scene.h"
#include "views/figure_actions.h"

class QAction;
class QLabel;

namespace lvcalib::widgets {

class ColorBar;
class Lasso;

/// A LiDAR cloud in space: drag turns, Shift-drag or the middle button moves, wheel or the right
/// button zooms, a click picks a point; R, T, S and B reset, look from the top, from the sensor, at
/// the board; arrow keys turn, + and − zoom. Passive: shows the scene it is given. Without OpenGL
/// it shows a message instead and keeps working otherwise.
class CloudView : public QWidget {
  Q_OBJECT

 public:
  static constexpr double kPointSize_px = 1.5;

  explicit CloudView(QWidget* parent = nullptr);
  ~CloudView() override;

  void setScene(std::shared_ptr<const CloudScene> scene);
  [[nodiscard]] const std::shared_ptr<const CloudScene>& scene() const { return scene_; }
  void setLines(const std::vector<CloudLine>& lines);
  /// Emphasises points, by index into the scene's cloud, until others are: also in scenes that
  /// follow.
  void setHighlights(const std::vector<std::uint32_t>& points);
  /// Shows a crop box, with handles if `editable`.
  void setBox(const std::optional<CropBox>& box, bool editable);
  /// Of the points, in logical pixels.
  void setPointSize(double size_px);
  /// On: a drag draws a line about points and selects them instead of turning.
  void setBrushing(bool on);
  /// The legend, at which the range of the colours is chosen.
  [[nodiscard]] ColorBar* legend() const { return legend_; }
  /// Points the viewer there.
  void look(CloudViewpoint viewpoint);

  [[nodiscard]] bool hasOpenGl() const { return canvas_ != nullptr; }
  /// Null without OpenGL.
  [[nodiscard]] CloudCanvas* canvas() const { return canvas_; }
  [[nodiscard]] FigureActions* figureActions() const { return figure_actions_; }
  /// Reset, top, sensor, board: for tool bars and menus.
  [[nodiscard]] const std::vector<QAction*>& viewActions() const { return view_actions_; }

 Q_SIGNALS:
  /// A click on a point; index into the scene's cloud.
  void pointPicked(std::uint32_t point);
  /// A click beside all points.
  void nothingPicked();
  /// Points inside a line that was drawn about them; `add` to those selected already.
  void pointsBrushed(const std::vector<std::uint32_t>& points, bool add);
  void boxEdited(const lvcalib::CropBox& box);
  /// All points are in the picture.
  void completed();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void triggerByKey(QKeyEvent* event);
  void createCanvas();
  void createActions();
  void pickAt(const QPointF& place);
  void brush(const QPolygonF& line, bool add);
  void updateLegend();
  /// Says so while the board is looked at from behind.
  void updateSide();
  void showMenu(const QPoint& place);
  /// Away from where the last cloud was framed.
  [[nodiscard]] bool viewerHasMoved() const;

  std::shared_ptr<const CloudScene> scene_;
  CloudCanvas* canvas_ = nullptr;
  Lasso* lasso_ = nullptr;
  ColorBar* legend_ = nullptr;
  QLabel* notice_ = nullptr;
  QLabel* side_ = nullptr;
  FigureActions* figure_actions_ = nullptr;
  std::vector<QAction*> view_actions_;
  QPoint right_pressed_;
  std::optional<Viewer> framed_;
};

/// Whether an OpenGL 3.2 context can be had on this screen; looked up once.
bool opengl_available();

}  // namespace lvcalib::widgets
