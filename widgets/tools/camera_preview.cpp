// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/camera_preview.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "style/theme.h"

namespace lvcalib::widgets {
namespace {

// Lines of the grid to either side of the optical axis, and pieces of each.
constexpr int kLines = 8;
constexpr int kPieces = 96;

}  // namespace

std::optional<Eigen::Vector2d> field_of_view(const Camera& camera) {
  const auto angle = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const auto first = camera.unproject(a);
    const auto second = camera.unproject(b);
    if (!first || !second) return -1.0;
    return std::atan2(first->cross(*second).norm(), first->dot(*second));
  };
  const double right = camera.width_px - 1.0;
  const double bottom = camera.height_px - 1.0;
  const Eigen::Vector2d out(angle({0.0, camera.cy}, {right, camera.cy}),
                            angle({camera.cx, 0.0}, {camera.cx, bottom}));
  return out.minCoeff() < 0.0 ? std::nullopt : std::optional(out);
}

CameraPreview::CameraPreview(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("camera_preview"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void CameraPreview::setCamera(const std::optional<Camera>& camera) {
  camera_ = camera;
  update();
}

void CameraPreview::paintEvent(QPaintEvent*) {
  if (!camera_) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Camera& c = *camera_;
  const double scale = 0.94 * std::min(width() / static_cast<double>(c.width_px),
                                       height() / static_cast<double>(c.height_px));
  painter.translate(0.5 * (width() - scale * c.width_px), 0.5 * (height() - scale * c.height_px));
  const QRectF image(0.0, 0.0, scale * c.width_px, scale * c.height_px);
  painter.fillRect(image, palette().color(QPalette::Base));
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(image);
  painter.setClipRect(image);
  // A plane in front of the camera, as wide as the image would be without distortion and half as
  // much again: a lens that draws its edges inwards sees more.
  const double x_most = 1.5 * std::max(c.cx, c.width_px - c.cx) / c.fx;
  const double y_most = 1.5 * std::max(c.cy, c.height_px - c.cy) / c.fy;
  const double step = std::max(x_most, y_most) / kLines;
  painter.setPen(QPen(state_colors(palette()).accent, 1.2));
  const auto draw = [&](const auto& point_of) {
    QPolygonF line;
    const auto flush = [&] {
      if (line.size() > 1) painter.drawPolyline(line);
      line.clear();
    };
    for (int i = -kPieces; i <= kPieces; ++i) {
      const auto pixel = c.project(point_of(static_cast<double>(i) / kPieces));
      if (pixel) {
        line << scale * QPointF(pixel->x() + 0.5, pixel->y() + 0.5);
      } else {
        flush();
      }
    }
    flush();
  };
  for (int k = -kLines; k <= kLines; ++k) {
    draw([&](double t) { return Eigen::Vector3d(t * x_most, k * step, 1.0); });
    draw([&](double t) { return Eigen::Vector3d(k * step, t * y_most, 1.0); });
  }
  painter.setPen(palette().color(QPalette::Text));
  const QPointF centre = scale * QPointF(c.cx + 0.5, c.cy + 0.5);
  painter.drawLine(centre - QPointF(6, 0), centre + QPointF(6, 0));
  painter.drawLine(centre - QPointF(0, 6), centre + QPointF(0, 6));
}

}  // namespace lvcalib::widgets

#include "moc_camera_preview.cpp"
