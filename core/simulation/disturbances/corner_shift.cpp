// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/disturbances/corner_shift.h"

#include <cmath>

#include "simulation/whole_below.h"

namespace lvcalib::simulation {
namespace {

// Part of a gap around the tag that moves with it; circles in the crossings begin beyond.
constexpr double kGapShare = 0.15;

}  // namespace

CornerShift::CornerShift(const Target& target, double shift_px, const Project& project) {
  if (shift_px == 0.0 || !target.has_tags()) return;
  pitch_m_ = target.tag_pitch_m();
  size_m_ = target.tag_size_m;
  reach_m_ = 0.5 * size_m_ + kGapShare * target.tag_gap_m();
  if (target.type == TargetType::kCharuco) {
    columns_ = target.corner_columns + 1;
    rows_ = target.corner_rows + 1;
  } else {
    columns_ = target.type == TargetType::kAprilTag ? 1 : target.tag_columns;
    rows_ = target.type == TargetType::kAprilTag ? 1 : target.tag_rows;
  }
  place_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
  // Each tag has a cell; the gap is shared out between the tags on both sides of it.
  const double half = 0.5 * pitch_m_;
  first_m_ = target.type == TargetType::kCharuco ? Eigen::Vector2d(-pitch_m_, -pitch_m_)
                                                 : Eigen::Vector2d::Constant(0.5 * size_m_ - half);
  if (target.type == TargetType::kAprilTag) {
    pitch_m_ = size_m_ + 2.0 * target.tag_gap_m();
    first_m_ = Eigen::Vector2d::Constant(-target.tag_gap_m());
  }
  for (const TargetTag& tag : target.tags()) {
    const auto corners = target.tag_corners_m(tag);  // Around the tag, so 0 and 2 are opposite.
    Eigen::Matrix2d shrink = Eigen::Matrix2d::Identity();
    for (std::size_t i = 0; i < 2; ++i) {
      const auto one = project(corners[i]);
      const auto other = project(corners[i + 2]);
      if (!one || !other) continue;
      const double radius_px = 0.5 * (*one - *other).norm();
      const Eigen::Vector2d diagonal = (corners[i] - tag.center_m).normalized();
      shrink -= shift_px / (radius_px + shift_px) * diagonal * diagonal.transpose();
    }
    const Eigen::Vector2d cell = (tag.center_m - first_m_) / pitch_m_;
    place_[static_cast<std::size_t>(whole_below(cell.y()) * columns_ + whole_below(cell.x()))] =
        static_cast<int>(tags_.size());
    tags_.push_back({tag.center_m, shrink});
  }
}

Eigen::Vector2d CornerShift::shown_at(const Eigen::Vector2d& place_m) const {
  const int column = whole_below((place_m.x() - first_m_.x()) / pitch_m_);
  const int row = whole_below((place_m.y() - first_m_.y()) / pitch_m_);
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return place_m;
  const int place = place_[static_cast<std::size_t>(row * columns_ + column)];
  if (place < 0) return place_m;
  const Tag& tag = tags_[static_cast<std::size_t>(place)];
  const Eigen::Vector2d from_center = place_m - tag.center_m;
  if (from_center.cwiseAbs().maxCoeff() > reach_m_) return place_m;
  return tag.center_m + tag.shown_from_place * from_center;
}

}  // namespace lvcalib::simulation
