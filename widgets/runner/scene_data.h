// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <memory>
#include <stop_token>

#include "base/error.h"
#include "cloud/cloud.h"
#include "pipeline/dataset.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// What there is to look at in one scene.
struct SceneData {
  std::shared_ptr<const Cloud> cloud;  ///< All points, in the LiDAR frame.
  QImage image;                        ///< Colour, 8 bit.
  Message cloud_problem;               ///< Why there is no cloud; empty if there is one.
  Message image_problem;               ///< Why there is no image; empty if there is one.
};

/// Reads cloud and image of a scene; either may be missing, with its reason. Error: kCancelled.
Result<SceneData> read_scene_data(const SceneFiles& files, std::stop_token stop);

/// Reads an image (8 or 16 bit, grey or colour) with its colours.
Result<QImage> read_scene_image(const std::filesystem::path& path);

/// Reads scenes in a worker thread: the data of the one looked at, and thumbnails of all.
class SceneLoader : public QObject {
  Q_OBJECT

 public:
  /// Size that thumbnails fit into, px.
  static constexpr int kThumbnailWidth = 48;
  static constexpr int kThumbnailHeight = 30;

  explicit SceneLoader(QObject* parent = nullptr);

  /// Reads a scene's data; a request before it that is not done is dropped.
  void load(const SceneFiles& files);
  /// Reads small images of all scenes, one after the other.
  void load_thumbnails(const std::vector<SceneFiles>& scenes);
  /// Drops what is being read.
  void clear();

 Q_SIGNALS:
  void loaded(const QString& scene, const lvcalib::widgets::SceneData& data);
  /// A file of the scene is missing or cannot be read; said of every such scene once thumbnails
  /// are asked for, and again when its data are.
  void failed(const QString& scene, const lvcalib::Message& message);
  void thumbnail(const QString& scene, const QImage& image);

 private:
  Runner* data_;
  Runner* thumbnails_;
};

}  // namespace lvcalib::widgets
