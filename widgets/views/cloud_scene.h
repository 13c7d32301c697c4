// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QString>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "base/rigid3.h"
#include "camera/camera.h"
#include "cloud/cloud.h"
#include "pipeline/board_surface.h"
#include "pipeline/crop_box.h"
#include "refinement/board_refinement.h"
#include "target/target.h"
#include "views/color_map.h"

namespace lvcalib::widgets {

/// What the colour of a point tells.
enum class CloudColor {
  kIntensity,
  kHeight,
  kRange,
  kResidual,  ///< What the model in force leaves of the range, averaged over the board.
  kCameraColor,
  kLine,
  kTime,
  kScene
};

/// Which points are shown.
enum class CloudFilter {
  kAll,
  kCrop,      ///< Inside the crop box.
  kBoard,     ///< Kept as the board's surroundings by localization.
  kBoundary,  ///< In the ring about a circle's edge: what the refinement measures with.
};

/// One of several things that have no order, and its colour.
struct CloudCategory {
  QString name;
  QRgb color = 0;
  bool operator==(const CloudCategory&) const = default;
};

/// Points on the board that are not used: refused by the solve, and left out by the user.
struct UnusedPoints {
  std::vector<Eigen::Vector3f> refused_m;
  std::vector<Eigen::Vector3f> left_out_m;
};

/// Everything a picture of a cloud is made of. Shared read-only with the thread that builds it.
struct CloudSceneInput {
  std::shared_ptr<const Cloud> full;   ///< May be null: then only board points can be shown.
  std::shared_ptr<const Cloud> board;  ///< Board points of the scene; may be null.
  CloudFilter filter = CloudFilter::kAll;
  CloudColor color = CloudColor::kIntensity;
  std::optional<CropBox> crop;
  std::optional<BoardRefinement> refinement;  ///< For the board's place and boundary samples.
  /// Looks for the board where there is no refinement, so that it comes into sight.
  bool seek_board = false;
  /// What the model leaves over the board; called only if a picture needs it, by the thread that
  /// builds the picture. May be empty.
  std::function<std::optional<BoardSurface>()> surface = {};
  std::function<UnusedPoints()> unused = {};  ///< Called by that thread, too. May be empty.
  Target target;
  Camera camera;
  std::optional<Rigid3> camera_from_lidar;  ///< For pixels and camera colours.
  QImage image;
  std::optional<std::pair<double, double>> range;  ///< Of the colours; none: by the values.
  /// Places that are to be in sight with the points, such as the sensors.
  std::vector<Eigen::Vector3d> landmarks_m = {};
  /// For `kScene`: the scenes, of which a point's line is the place, counted from 1.
  std::vector<CloudCategory> scenes = {};
  QString problem;  ///< Why there is no full cloud and will be none; empty: it may still come.
};

/// A cloud made ready to be drawn: points in an order of which every beginning is a fair thinning,
/// their colours, and what the colours mean.
struct CloudScene {
  std::shared_ptr<const Cloud> cloud;   ///< The cloud that the indices refer to.
  std::vector<std::uint32_t> order;     ///< Index into the cloud of every drawn point.
  std::vector<float> xyz_m;             ///< Three per drawn point.
  std::vector<std::uint8_t> rgb;        ///< Three per drawn point.
  std::vector<Eigen::Vector2f> pixels;  ///< Per point of the cloud; empty without an extrinsic.
  ColorScale scale;
  ColorScale whole;            ///< The scale by the values, whatever range was asked for.
  std::vector<int> histogram;  ///< Of the values, in equal bins over `whole`; beyond: the ends.
  bool has_scale = true;       ///< False if colours are the camera's or those of categories.
  std::vector<CloudCategory> categories;  ///< What colours stand for; empty if they are a scale.
  UnusedPoints unused;
  QString quantity;  ///< "intensity", "height (m)", …
  QString notice;    ///< Why the picture is not what was asked for; empty if it is.
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();  ///< Bounding box of the drawn points.
  Eigen::Vector3d high_m = Eigen::Vector3d::Zero();
  /// The same without the points that lie farther than the upper whisker of a box plot of the
  /// ranges: a few returns from the end of the street must not make the rest a speck.
  Eigen::Vector3d most_low_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d most_high_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< Median of the drawn points.

  /// Where the board is, and half its diagonal; radius 0 if it is not known.
  Eigen::Vector3d board_center_m = Eigen::Vector3d::Zero();
  double board_radius_m = 0.0;
  /// Out of the board's printed side.
  Eigen::Vector3d board_normal = Eigen::Vector3d::Zero();
  bool board_is_likely = false;  ///< By the cloud alone, before a calibration has found it.

  /// Tells where the board is, in the cloud's frame.
  void place_board(const Rigid3& lidar_from_board, const BoardOutline& outline);

  [[nodiscard]] std::size_t size() const { return order.size(); }
};

/// Builds the picture; runs on any thread. A stopped build gives null.
std::shared_ptr<const CloudScene> build_cloud_scene(const CloudSceneInput& input,
                                                    std::stop_token stop);

/// Colour of the image at a pixel (nearest); grey outside.
QRgb image_color(const QImage& image, const Eigen::Vector2f& pixel);

}  // namespace lvcalib::widgets
