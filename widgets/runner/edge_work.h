// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/fresh_data.h"
#include "runner/runner.h"

namespace lvcalib::widgets {

/// Places whose edges are compared, made ready.
struct EdgePlaces {
  std::vector<FilePair> pairs;
  Camera camera;
  FreshViews read;
};

/// How a place looks under a pose.
struct EdgeLook {
  EdgeScore score;  ///< Of all places.
  std::vector<ProjectedEdge> edges;
  struct Point {
    Eigen::Vector2d pixel;
    double range_m = 0.0;
  };
  std::vector<Point> points;
};

/// Reads places and compares their edges under poses, in worker threads.
class EdgeWork : public QObject {
  Q_OBJECT

 public:
  explicit EdgeWork(QObject* parent = nullptr);

  /// loaded() follows, or failed().
  void load(const std::vector<FilePair>& pairs, const Camera& camera, const Rigid3& rough);
  /// The same for what find_fresh_data() finds in a folder.
  void load_folder(const QString& folder, const Camera& camera, const Rigid3& rough);
  /// looked() follows. While one look is taken, of further wishes the last one counts.
  void look(const std::shared_ptr<const EdgePlaces>& places, std::size_t place,
            const Rigid3& camera_from_lidar);
  /// checked() follows, or failed().
  void check(const std::shared_ptr<const EdgePlaces>& places, const Rigid3& camera_from_lidar,
             const EdgeCheckOptions& options);
  void cancel() { runner_.cancel(); }
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void progressed(double fraction, const QString& text);
  void loaded(const std::shared_ptr<const lvcalib::widgets::EdgePlaces>& places);
  void looked(const std::shared_ptr<const lvcalib::widgets::EdgeLook>& look);
  void checked(const std::shared_ptr<const lvcalib::EdgeCheck>& check);
  void failed(const lvcalib::Error& error);
  /// Reading or checking has ended, however.
  void ended();

 private:
  struct Wish {
    std::shared_ptr<const EdgePlaces> places;
    std::size_t place = 0;
    Rigid3 camera_from_lidar;
  };
  void start_look();

  std::optional<Wish> wish_;
  Runner looker_;
  Runner runner_;
};

}  // namespace lvcalib::widgets
