// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/scene_data.h"

#include <utility>

#include "detection/color_image.h"

namespace lvcalib::widgets {

Result<QImage> read_scene_image(const std::filesystem::path& path) {
  auto color = read_color_image(path);
  if (!color) return color.error();
  // Copied, since QImage would only point into the buffer.
  return QImage(color->rgb.data(), color->width_px, color->height_px,
                static_cast<qsizetype>(3) * color->width_px, QImage::Format_RGB888)
      .convertToFormat(QImage::Format_RGB32);
}

Result<SceneData> read_scene_data(const SceneFiles& files, std::stop_token stop) {
  SceneData data;
  if (files.problem) {
    data.cloud_problem = data.image_problem = files.problem->sentence();
    return data;
  }
  // One without the other still shows what the scene is.
  auto image = read_scene_image(files.image);
  if (image) {
    data.image = std::move(*image);
  } else {
    data.image_problem = image.error().sentence();
  }
  auto cloud = read_cloud(files.cloud, std::move(stop));
  if (cloud) {
    data.cloud = std::make_shared<const Cloud>(std::move(*cloud));
  } else if (cloud.error().kind == ErrorKind::kCancelled) {
    return cloud.error();
  } else {
    data.cloud_problem = cloud.error().sentence();
  }
  return data;
}

SceneLoader::SceneLoader(QObject* parent)
    : QObject(parent), data_(new Runner(this)), thumbnails_(new Runner(this)) {}

void SceneLoader::load(const SceneFiles& files) {
  data_->start([this, files](const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto data = read_scene_data(files, context.stop);
    const QString name = QString::fromStdString(files.name);
    if (!data) return {};  // Cancelled.
    return [this, name, data = std::move(*data)] {
      Q_EMIT loaded(name, data);
      for (const Message& problem : {data.image_problem, data.cloud_problem}) {
        if (problem.empty()) continue;
        Q_EMIT failed(name, problem);
        break;
      }
    };
  });
}

void SceneLoader::load_thumbnails(const std::vector<SceneFiles>& scenes) {
  thumbnails_->start(
      [this, scenes](const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
        for (const SceneFiles& files : scenes) {
          if (context.stopped()) break;
          const auto image =
              files.problem ? Result<QImage>(*files.problem) : read_scene_image(files.image);
          if (!image) {
            const QString name = QString::fromStdString(files.name);
            const Message message = image.error().sentence();
            post([this, name, message] { Q_EMIT failed(name, message); });
            continue;
          }
          const QImage small = image->scaled(kThumbnailWidth, kThumbnailHeight, Qt::KeepAspectRatio,
                                             Qt::SmoothTransformation);
          const QString name = QString::fromStdString(files.name);
          post([this, name, small] { Q_EMIT thumbnail(name, small); });
        }
        return {};
      });
}

void SceneLoader::clear() {
  data_->cancel();
  thumbnails_->cancel();
}

}  // namespace lvcalib::widgets

#include "moc_scene_data.cpp"
