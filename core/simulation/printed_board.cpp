// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/printed_board.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "simulation/whole_below.h"

namespace lvcalib::simulation {
namespace {

// Bits of one tag with its border, from the lower left, row by row; 1 is white.
std::vector<std::uint8_t> bits_of_tag(const Target& target, int id, int side) {
  std::vector<std::uint8_t> bits(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const TagPattern* pattern = tag_pattern(target.tag_family, id);
  if (pattern == nullptr) return bits;
  const int border = target.tag_border_bits;
  for (int row = 0; row < pattern->width; ++row) {
    for (int column = 0; column < pattern->width; ++column) {
      const int from_below = side - 1 - border - row;
      bits[static_cast<std::size_t>(from_below * side + border + column)] =
          pattern->at(row, column) ? 1 : 0;
    }
  }
  return bits;
}

}  // namespace

PrintedBoard::PrintedBoard(const Target& target, const BoardDisturbance& disturbance)
    : target_(target), disturbance_(disturbance), outline_(target.outline()) {
  if (target_.has_tags()) {
    pitch_m_ = target_.tag_pitch_m();
    columns_ = target_.type == TargetType::kAprilTag ? 1 : target_.tag_columns;
    rows_ = target_.type == TargetType::kAprilTag ? 1 : target_.tag_rows;
    const TagPattern* pattern = tag_pattern(target_.tag_family, target_.first_tag_id);
    bits_ = (pattern != nullptr ? pattern->width : 6) + 2 * target_.tag_border_bits;
    bit_m_ = target_.tag_size_m / bits_;
    for (int k = 0; k < target_.tag_count(); ++k) {
      const auto bits = bits_of_tag(target_, target_.first_tag_id + k, bits_);
      tag_bits_.insert(tag_bits_.end(), bits.begin(), bits.end());
    }
  }
  if (target_.has_squares()) lay_squares();
  map_edges();
}

// Squares from the lower left, row by row. A checkerboard's lower left square is black unless
// it is said to be white. OpenCV
// draws a ChArUco board from the top left, which is black (in boards before its version 4.6 it is
// white if the number of rows is even), and numbers the white squares as it comes to them.
void PrintedBoard::lay_squares() {
  columns_ = target_.corner_columns + 1;
  rows_ = target_.corner_rows + 1;
  squares_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                  kBlackSquare);
  const bool charuco = target_.type == TargetType::kCharuco;
  const bool white_first =
      charuco ? target_.legacy_pattern && rows_ % 2 == 0 : (rows_ % 2 == 0) != target_.white_first;
  int next = 0;
  for (int from_top = 0; from_top < rows_; ++from_top) {
    for (int column = 0; column < columns_; ++column) {
      const bool white = (from_top + column + (white_first ? 1 : 0)) % 2 != 0;
      if (!white) continue;
      squares_[static_cast<std::size_t>((rows_ - 1 - from_top) * columns_ + column)] =
          charuco ? next++ : kWhiteSquare;
    }
  }
}

bool PrintedBoard::squares_are_white(double x_m, double y_m) const {
  const int column = whole_below(x_m / target_.column_spacing_m) + 1;
  const int row = whole_below(y_m / target_.row_spacing_m) + 1;
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return true;
  const int square = squares_[static_cast<std::size_t>(row * columns_ + column)];
  if (square < 0) return square == kWhiteSquare;
  const double gap = 0.5 * (target_.column_spacing_m - target_.tag_size_m);
  const double x = x_m - (column - 1) * target_.column_spacing_m - gap;
  const double y = y_m - (row - 1) * target_.row_spacing_m - gap;
  return x < 0.0 || y < 0.0 || x >= target_.tag_size_m || y >= target_.tag_size_m ||
         bit_is_white(square, x, y);
}

bool PrintedBoard::bit_is_white(int tag, double x_m, double y_m) const {
  const int i = std::min(static_cast<int>(x_m / bit_m_), bits_ - 1);
  const int j = std::min(static_cast<int>(y_m / bit_m_), bits_ - 1);
  return tag_bits_[static_cast<std::size_t>((tag * bits_ + j) * bits_ + i)] != 0;
}

bool PrintedBoard::is_white(double x_m, double y_m) const {
  const bool as_drawn = !disturbance_.moves_print() && disturbance_.ink_gain_m() == 0.0;
  return as_drawn ? drawn_white(x_m, y_m) : is_white_beyond(0.0, {x_m, y_m});
}

// Black grows by a disc: a point is black if anything black lies within the radius; circles grow
// exactly. All edges of tags and squares run along the axes and everything is wider than the disc:
// of a cell beside the point's own the four points of the rim on the axes tell, of one that only
// touches it with a corner that corner's distance.
bool PrintedBoard::is_white_beyond(double edge_shift_m, Eigen::Vector2d point_m) const {
  if (disturbance_.moves_print()) point_m = disturbance_.on_drawing(point_m);
  const double growth = edge_shift_m + disturbance_.ink_gain_m();
  const bool white = drawn_white(point_m.x(), point_m.y());
  // Growing black can only darken white, shrinking black only whiten black.
  if (growth == 0.0 || white != (growth > 0.0)) return white;
  const auto beyond = from_circle_m(point_m.x(), point_m.y());
  if (beyond && *beyond <= std::max(growth, 0.0)) return *beyond > growth;
  const double x = point_m.x();
  const double y = point_m.y();
  for (const double r : {growth, -growth}) {
    if (drawn_white(x + r, y) != white || drawn_white(x, y + r) != white) return !white;
  }
  for (const Eigen::Vector2d& corner : nearest_corners(point_m)) {
    const Eigen::Vector2d to = corner - point_m;
    if (to.norm() > std::abs(growth)) continue;
    constexpr double kBeyond = 1e-9;  // Any place in the cell across the corner tells its colour.
    if (drawn_white(corner.x() + std::copysign(kBeyond, to.x()),
                    corner.y() + std::copysign(kBeyond, to.y())) != white)
      return !white;
  }
  return white;
}

std::array<Eigen::Vector2d, 2> PrintedBoard::nearest_corners(const Eigen::Vector2d& p) const {
  // Of the bits of a tag whose lower left corner is the origin.
  const auto of_tag = [&](double x) {
    return bit_m_ * std::round(std::clamp(x, 0.0, target_.tag_size_m) / bit_m_);
  };
  if (target_.has_squares()) {
    const Eigen::Vector2d size(target_.column_spacing_m, target_.row_spacing_m);
    const Eigen::Vector2d square = p.cwiseQuotient(size).array().round().matrix();
    const Eigen::Vector2d corner = square.cwiseProduct(size);
    if (!target_.has_tags()) return {corner, corner};
    const double gap = 0.5 * (target_.column_spacing_m - target_.tag_size_m);
    const Eigen::Vector2d cell = p.cwiseQuotient(size).array().floor().matrix();
    const Eigen::Vector2d marker = cell.cwiseProduct(size) + Eigen::Vector2d(gap, gap);
    return {corner,
            marker + Eigen::Vector2d(of_tag(p.x() - marker.x()), of_tag(p.y() - marker.y()))};
  }
  const auto of_grid = [&](double x) {
    const double first = pitch_m_ * std::floor(x / pitch_m_);
    const bool next = x - first > 0.5 * (target_.tag_size_m + pitch_m_);
    return next ? first + pitch_m_ : first + of_tag(x - first);
  };
  const Eigen::Vector2d corner(of_grid(p.x()), of_grid(p.y()));
  return {corner, corner};
}

bool PrintedBoard::drawn_white(double x_m, double y_m) const {
  if (target_.has_squares()) return squares_are_white(x_m, y_m);
  const int column = whole_below(x_m / pitch_m_);
  const int row = whole_below(y_m / pitch_m_);
  if (column >= 0 && row >= 0 && column < columns_ && row < rows_) {
    const double x = x_m - column * pitch_m_;
    const double y = y_m - row * pitch_m_;
    if (x < target_.tag_size_m && y < target_.tag_size_m) {
      return bit_is_white(row * columns_ + column, x, y);
    }
  }
  const auto beyond = from_circle_m(x_m, y_m);
  return !beyond || *beyond > 0.0;
}

std::optional<double> PrintedBoard::from_circle_m(double x_m, double y_m) const {
  if (!target_.has_circles()) return std::nullopt;
  const double first = target_.tag_size_m * (1.0 + 0.5 * target_.tag_spacing);
  const int i = whole_below((x_m - first) / pitch_m_ + 0.5);
  const int j = whole_below((y_m - first) / pitch_m_ + 0.5);
  if (i < 0 || j < 0 || i > target_.tag_columns - 2 || j > target_.tag_rows - 2)
    return std::nullopt;
  return std::hypot(x_m - first - i * pitch_m_, y_m - first - j * pitch_m_) -
         target_.circle_radius_m;
}

void PrintedBoard::map_edges() {
  const Eigen::Vector2d size = outline_.size_m();
  // About a thousand cells along the longer side resolve every bit of a printable board.
  cell_m_ = size.maxCoeff() / 1000.0;
  cells_x_ = std::max(2, static_cast<int>(std::ceil(size.x() / cell_m_)));
  cells_y_ = std::max(2, static_cast<int>(std::ceil(size.y() / cell_m_)));
  cv::Mat white(cells_y_, cells_x_, CV_8U);
  for (int j = 0; j < cells_y_; ++j) {
    for (int i = 0; i < cells_x_; ++i) {
      white.at<std::uint8_t>(j, i) = is_white(outline_.lower_left_m.x() + (i + 0.5) * cell_m_,
                                              outline_.lower_left_m.y() + (j + 0.5) * cell_m_)
                                         ? 1
                                         : 0;
    }
  }
  cv::Mat lowest;
  cv::Mat highest;
  cv::erode(white, lowest, cv::Mat::ones(3, 3, CV_8U));
  cv::dilate(white, highest, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat plain = lowest == highest;
  plain.row(0) = 0;
  plain.row(cells_y_ - 1) = 0;
  plain.col(0) = 0;
  plain.col(cells_x_ - 1) = 0;
  cv::Mat distance;
  cv::distanceTransform(plain, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  clearance_cells_.assign(distance.begin<float>(), distance.end<float>());
}

double PrintedBoard::clearance_m(double x_m, double y_m) const {
  if (!inside(x_m, y_m)) return 0.0;
  const int i =
      std::min(static_cast<int>((x_m - outline_.lower_left_m.x()) / cell_m_), cells_x_ - 1);
  const int j =
      std::min(static_cast<int>((y_m - outline_.lower_left_m.y()) / cell_m_), cells_y_ - 1);
  // The point is up to 0.71 cells from its cell's centre, the edge up to one from a marked cell's.
  const double cells = clearance_cells_[static_cast<std::size_t>(j * cells_x_ + i)] - 1.75;
  return std::max(0.0, cells) * cell_m_;
}

}  // namespace lvcalib::simulation
