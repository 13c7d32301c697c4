// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A drawn sheet as pixels, compared with the board's model.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <string>

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "base/random.h"
#include "target/sheet.h"

namespace lvcalib::test {

struct Output {
  int status = -1;
  std::string text;
};

inline Output shell(const std::string& command) {
  Output out;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    out.text.append(buffer.data(), n);
  }
  out.status = ::pclose(pipe);
  return out;
}

inline bool has_program(const std::string& name) {
  return shell("command -v " + name).status == 0;
}

/// A drawn page: grey values by position in millimetres from its top-left corner.
struct Raster {
  cv::Mat image;
  double px_per_mm = 1.0;
  [[nodiscard]] double at(const Eigen::Vector2d& mm) const {
    const int column = static_cast<int>(std::floor(mm.x() * px_per_mm));
    const int row = static_cast<int>(std::floor(mm.y() * px_per_mm));
    if (row < 0 || column < 0 || row >= image.rows || column >= image.cols) return -1.0;
    return image.at<unsigned char>(row, column) / 255.0;
  }
};

/// Compares the print with the model at random points of the board that lie `clearance_mm` from any
/// edge of the pattern. Returns how many were compared.
inline int compare_with_model(const Target& target, const SheetLayout& layout, const Raster& raster,
                              int row, int column, std::uint64_t seed) {
  Random random(seed);
  const BoardOutline edge = target.outline();
  const double clearance_m = 1.6 / raster.px_per_mm / 1000.0;
  const Eigen::Vector2d board = layout.board_on_page_mm(row, column);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector2d p(random.uniform(edge.lower_left_m.x(), edge.upper_right_m.x()),
                            random.uniform(edge.lower_left_m.y(), edge.upper_right_m.y()));
    const Eigen::Vector2d on_page = board + sheet_point_mm(target, p);
    const Eigen::Array2d in_tile = on_page - layout.tile_origin_mm;
    if ((in_tile < 1000 * clearance_m).any() ||
        (in_tile > layout.tile_mm.array() - 1000 * clearance_m).any()) {
      continue;
    }
    const auto albedo = target.albedo(p);
    bool clear = albedo.has_value();
    for (int k = 0; k < 12 && clear; ++k) {
      const double angle = k * std::numbers::pi / 6;
      const auto near =
          target.albedo(p + clearance_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      clear = near == albedo;
    }
    if (!clear) continue;
    EXPECT_NEAR(raster.at(on_page), *albedo, 0.02)
        << "at " << on_page.transpose() << " mm of page " << row << "," << column;
    if (std::abs(raster.at(on_page) - *albedo) > 0.02) return compared;
    ++compared;
  }
  return compared;
}

/// Every tag of the model is detected, and its centre and corners lie where the model says.
inline void expect_tags(const Target& target, const SheetLayout& layout, const Raster& raster) {
  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, family);
  detector->quad_decimate = 1.0F;
  image_u8_t image{raster.image.cols, raster.image.rows, static_cast<int>(raster.image.step[0]),
                   raster.image.data};
  zarray_t* found = apriltag_detector_detect(detector, &image);
  std::map<int, Eigen::Vector2d> centers;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* detection = nullptr;
    zarray_get(found, i, &detection);
    centers[detection->id] = {detection->c[0], detection->c[1]};
  }
  apriltag_detections_destroy(found);
  apriltag_detector_destroy(detector);
  tag36h11_destroy(family);
  EXPECT_EQ(centers.size(), target.tags().size());
  for (const TargetTag& tag : target.tags()) {
    ASSERT_TRUE(centers.count(tag.id)) << "tag " << tag.id;
    const Eigen::Vector2d expected =
        raster.px_per_mm * (layout.board_on_page_mm(0, 0) + sheet_point_mm(target, tag.center_m));
    EXPECT_LT((centers[tag.id] - expected).norm(), std::max(0.3, 0.1 * raster.px_per_mm))
        << "tag " << tag.id;
  }
}

/// Every circle's centroid and area, from the darkness around the place where the model puts it.
inline void expect_circles(const Target& target, const SheetLayout& layout, const Raster& raster) {
  for (const TargetNode& node : target.nodes()) {
    const Eigen::Vector2d expected =
        layout.board_on_page_mm(0, 0) + sheet_point_mm(target, node.center_m);
    const double reach_mm = 1000 * target.circle_radius_m + 3.0;
    double mass = 0;
    Eigen::Vector2d moment(0, 0);
    const double s = raster.px_per_mm;
    for (int v = static_cast<int>((expected.y() - reach_mm) * s);
         v < static_cast<int>((expected.y() + reach_mm) * s); ++v) {
      for (int u = static_cast<int>((expected.x() - reach_mm) * s);
           u < static_cast<int>((expected.x() + reach_mm) * s); ++u) {
        const double dark = 1.0 - raster.image.at<unsigned char>(v, u) / 255.0;
        mass += dark;
        moment += dark * Eigen::Vector2d(u + 0.5, v + 0.5);
      }
    }
    EXPECT_LT((moment / mass / s - expected).norm(), 0.1) << "node " << node.id;
    const double radius_mm = std::sqrt(mass / std::numbers::pi) / s;
    EXPECT_NEAR(radius_mm, 1000 * target.circle_radius_m, 0.5 / s) << "node " << node.id;
  }
}

inline void expect_scale_bar(const SheetLayout& layout, const Raster& raster) {
  const double s = raster.px_per_mm;
  const int row = static_cast<int>(layout.scale_bar_mm.y() * s);
  double length = 0;
  // Label text begins 3 mm after the bar.
  for (int u = 0; u < (layout.scale_bar_mm.x() + layout.scale_bar_length_mm + 2.0) * s; ++u) {
    length += 1.0 - raster.image.at<unsigned char>(row, u) / 255.0;
  }
  // Renderers may snap an edge to the pixel grid.
  EXPECT_NEAR(length / s, layout.scale_bar_length_mm, 1.0 / s);
}

}  // namespace lvcalib::test
