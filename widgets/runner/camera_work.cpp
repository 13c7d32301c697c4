// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/camera_work.h"

#include <utility>

namespace lvcalib::widgets {

CameraWork::CameraWork(QObject* parent) : QObject(parent) {
  relay(runner_, this);
  connect(&runner_, &Runner::cancelled, this, &CameraWork::ended);
}

void CameraWork::calibrate(std::vector<std::filesystem::path> images, const Target& target,
                           const CameraCalibrationOptions& options) {
  runner_.abandon();
  runner_.start([this, images = std::move(images), target, options](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto out = calibrate_camera(images, target, options, context);
    if (!out) {
      if (out.error().kind == ErrorKind::kCancelled) return {};
      return [this, error = out.error()] { Q_EMIT failed(error); };
    }
    return [this, made = std::make_shared<const CameraCalibration>(std::move(*out))] {
      Q_EMIT calibrated(made);
    };
  });
}

void CameraWork::add(const Dataset& dataset, const QStringList& images) {
  std::vector<std::filesystem::path> paths;
  for (const QString& image : images) paths.emplace_back(image.toStdString());
  runner_.abandon();
  runner_.start([this, dataset = Dataset(dataset), paths = std::move(paths)](
                    const RunContext&, const Runner::Post&) mutable -> Runner::Deliver {
    if (Status s = add_camera_images(dataset, paths); !s)
      return [this, error = s.error()] { Q_EMIT failed(error); };
    return [this, count = static_cast<int>(paths.size())] { Q_EMIT added(count); };
  });
}

}  // namespace lvcalib::widgets

#include "moc_camera_work.cpp"
