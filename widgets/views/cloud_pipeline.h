// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "pipeline/crop_box.h"
#include "views/cloud_geometry.h"
#include "views/cloud_scene.h"

namespace lvcalib::widgets {

/// Where lines coincide, the narrower is drawn over the broader, so that both are seen; hairs are
/// drawn under both.
enum class CloudLineWidth { kHair, kUsual, kBroad };

/// A line of the cloud picture, such as a circle or the board's edge.
struct CloudLine {
  std::vector<Eigen::Vector3d> points_m;
  std::array<double, 3> color{1, 1, 1};
  bool closed = true;
  CloudLineWidth width = CloudLineWidth::kUsual;
};

/// A mouse event in device pixels, from the top left.
struct CanvasMouse {
  enum class Kind { kMove, kPress, kRelease, kWheelUp, kWheelDown };
  enum class Button { kNone, kLeft, kMiddle, kRight };
  Kind kind = Kind::kMove;
  Button button = Button::kNone;
  int x = 0;
  int y = 0;
  bool shift = false;
  bool control = false;
};

/// The rendering of a cloud with VTK into an OpenGL context that belongs to someone else. Points
/// are drawn in portions, so that one frame never takes long: drawFirst() starts a picture,
/// drawMore() adds to it until complete() is true.
class CloudPipeline {
 public:
  struct Hooks {
    std::function<void()> make_current;
    std::function<void()> view_changed;              ///< The picture must start anew.
    std::function<void(const CropBox&)> box_edited;  ///< By its handles; on release.
  };

  explicit CloudPipeline(Hooks hooks);
  ~CloudPipeline();
  CloudPipeline(const CloudPipeline&) = delete;
  CloudPipeline& operator=(const CloudPipeline&) = delete;

  /// With the context current. False if the context cannot draw.
  bool initialize();
  /// Frees what lives in the context, which must be current.
  void release();

  void setScene(std::shared_ptr<const CloudScene> scene);
  void setLines(const std::vector<CloudLine>& lines);
  void setHighlights(const std::vector<Eigen::Vector3d>& points_m);
  void setBackground(double red, double green, double blue, bool dark);
  /// Shows a box, with handles if `editable`.
  void setBox(const std::optional<CropBox>& box, bool editable);
  void look(CloudViewpoint viewpoint);
  /// Turns the viewer about the focus, in degrees.
  void turn(double azimuth_deg, double elevation_deg);
  void zoom(double factor);
  /// Of the cloud's points, in logical pixels.
  void setPointSize(double size_px);

  void resize(int width_px, int height_px, double device_pixel_ratio);
  void handle(const CanvasMouse& mouse);
  /// True while a handle of the box is held.
  [[nodiscard]] bool editingBox() const;

  void drawFirst(std::size_t points);
  void drawMore(std::size_t points);
  [[nodiscard]] bool complete() const;
  [[nodiscard]] std::size_t drawnPoints() const;
  /// Copies the picture to the framebuffer of the given name.
  void copyTo(unsigned framebuffer, int width_px, int height_px);

  [[nodiscard]] Viewer viewer() const;
  void setViewer(const Viewer& viewer);
  /// OpenGL's viewing and projection matrix.
  [[nodiscard]] Eigen::Matrix4d clipFromWorld() const;

 private:
  struct Vtk;
  std::unique_ptr<Vtk> vtk_;
};

}  // namespace lvcalib::widgets
