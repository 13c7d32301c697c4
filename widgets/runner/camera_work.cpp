// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/camera_work.h"

#include <utility>

namespace lvcalib::widgets {

CameraWork::CameraWork(QObject* parent) : QObject(parent) {
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString&, double fraction, const QString& text) {
            Q_EMIT progressed(fraction, text);
          });
  connect(&runner_, &Runner::finished, this, &CameraWork::ended);
  connect(&runner_, &Runner::cancelled, this, [this] {
    if (!replacing_) Q_EMIT ended();
  });
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Error::untrusted(
        Message("an unexpected error stopped the work: %1", message.toStdString())));
    Q_EMIT ended();
  });
}

void CameraWork::calibrate(std::vector<std::filesystem::path> images, const Target& target,
                           const CameraCalibrationOptions& options) {
  replacing_ = true;
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
  replacing_ = false;
}

void CameraWork::add(const Dataset& dataset, const QStringList& images) {
  std::vector<std::filesystem::path> paths;
  for (const QString& image : images) paths.emplace_back(image.toStdString());
  replacing_ = true;
  runner_.start([this, dataset = Dataset(dataset), paths = std::move(paths)](
                    const RunContext&, const Runner::Post&) mutable -> Runner::Deliver {
    if (Status s = add_camera_images(dataset, paths); !s)
      return [this, error = s.error()] { Q_EMIT failed(error); };
    return [this, count = static_cast<int>(paths.size())] { Q_EMIT added(count); };
  });
  replacing_ = false;
}

}  // namespace lvcalib::widgets
