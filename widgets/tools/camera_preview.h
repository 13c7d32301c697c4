// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>

#include "camera/camera.h"

namespace lvcalib::widgets {

/// What a camera makes of a grid of straight lines, within its image.
class CameraPreview : public QWidget {
  Q_OBJECT

 public:
  explicit CameraPreview(QWidget* parent = nullptr);
  void setCamera(const std::optional<Camera>& camera);
  [[nodiscard]] QSize sizeHint() const override { return {360, 260}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {200, 150}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::optional<Camera> camera_;
};

/// Angles that the image spans through its middle, horizontally and vertically, rad; nothing where
/// the model has no ray.
std::optional<Eigen::Vector2d> field_of_view(const Camera& camera);

}  // namespace lvcalib::widgets
