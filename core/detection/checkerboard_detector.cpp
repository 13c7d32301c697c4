// SPDX-License-Identifier: BSD-3-Clause
#include "detection/checkerboard_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/LU>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace lvcalib {
namespace {

cv::Mat to_mat(const GrayImage& image) {
  const auto [low, high] = std::minmax_element(image.pixels.begin(), image.pixels.end());
  const float gain = 255.0F / std::max(*high - *low, 8.0F);
  cv::Mat out(image.height_px, image.width_px, CV_8U);
  for (int y = 0; y < image.height_px; ++y) {
    auto* row = out.ptr<unsigned char>(y);
    for (int x = 0; x < image.width_px; ++x) {
      row[x] = cv::saturate_cast<unsigned char>((image.at(x, y) - *low) * gain);
    }
  }
  return out;
}

// Corners as a grid; at(row, column) with `columns` along the first direction.
struct Grid {
  int columns = 0;
  int rows = 0;
  std::vector<Eigen::Vector2d> points;
  [[nodiscard]] const Eigen::Vector2d& at(int row, int column) const {
    return points[static_cast<std::size_t>(row * columns + column)];
  }
};

enum class Method { kSectors, kSquares };

// Searches a reduced image, which takes a fraction of the time and finds blurred boards better.
bool find_grid(const cv::Mat& image, double reduction, Method method, Grid& grid) {
  cv::Mat small = image;
  if (reduction > 1.0)
    cv::resize(image, small, {}, 1.0 / reduction, 1.0 / reduction, cv::INTER_AREA);
  const cv::Size size(grid.columns, grid.rows);
  std::vector<cv::Point2f> corners;
  const bool found =
      method == Method::kSectors
          ? cv::findChessboardCornersSB(small, size, corners, cv::CALIB_CB_NORMALIZE_IMAGE)
          : cv::findChessboardCorners(small, size, corners,
                                      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE |
                                          cv::CALIB_CB_FAST_CHECK);
  if (!found || corners.size() != static_cast<std::size_t>(size.area())) return false;
  const double sx = static_cast<double>(image.cols) / small.cols;
  const double sy = static_cast<double>(image.rows) / small.rows;
  grid.points.clear();
  for (const cv::Point2f& p : corners) {
    grid.points.emplace_back((p.x + 0.5) * sx - 0.5, (p.y + 0.5) * sy - 0.5);
  }
  return true;
}

// About 1000 pixels along the longer side show the squares of any usable board.
double usual_reduction(const cv::Mat& image) {
  return std::max(1.0, std::max(image.cols, image.rows) / 1000.0);
}

// The largest checkerboard of any size; its longer side along the target's. Nothing for what has
// far fewer corners than the target: tags and tiles look like small checkerboards.
std::optional<cv::Size> other_size(const cv::Mat& image, const Target& target) {
  constexpr int kFewest = 3;  // OpenCV finds nothing smaller.
  constexpr int kFewer = 2;   // The outer edges counted, too; squares for corners are one.
  cv::Mat small;
  const double reduction = usual_reduction(image);
  cv::resize(image, small, {}, 1.0 / reduction, 1.0 / reduction, cv::INTER_AREA);
  std::vector<cv::Point2f> corners;
  cv::Mat found;  // An element for each corner.
  if (!cv::findChessboardCornersSB(small, {kFewest, kFewest}, corners,
                                   cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_LARGER, found))
    return std::nullopt;
  cv::Size size = found.size();
  if ((size.width < size.height) != (target.corner_columns < target.corner_rows))
    std::swap(size.width, size.height);
  if (size.width + kFewer < target.corner_columns || size.height + kFewer < target.corner_rows)
    return std::nullopt;
  return size;
}

Error no_checkerboard(const cv::Mat& image, const Target& target) {
  const auto other = other_size(image, target);
  if (!other || *other == cv::Size(target.corner_columns, target.corner_rows)) {
    return Error::input(Message("no checkerboard with %1 × %2 inner corners in the image",
                                target.corner_columns, target.corner_rows),
                        {}, Message("all of it must be visible; check targetCols and targetRows"));
  }
  return Error::input(
      Message("no checkerboard with %1 × %2 inner corners in the image, but one with %3 × %4",
              target.corner_columns, target.corner_rows, other->width, other->height),
      {},
      Message("if all of it is visible, targetCols: %1 and targetRows: %2 would fit", other->width,
              other->height));
}

// Shortest distance between neighbouring corners.
double spacing(const Grid& grid) {
  double out = std::numeric_limits<double>::infinity();
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Eigen::Vector2d& p = grid.at(row, column);
      if (column > 0) out = std::min(out, (p - grid.at(row, column - 1)).norm());
      if (row > 0) out = std::min(out, (p - grid.at(row - 1, column)).norm());
    }
  }
  return out;
}

// A checkerboard's corner is point-symmetric, so that OpenCV's refinement has no bias here.
void refine(const cv::Mat& image, Grid& grid) {
  const int half = std::clamp(static_cast<int>(0.35 * spacing(grid)), 2, 15);
  std::vector<cv::Point2f> corners;
  for (const Eigen::Vector2d& p : grid.points) {
    corners.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  const std::vector<cv::Point2f> start = corners;
  cv::cornerSubPix(image, corners, {half, half}, {-1, -1},
                   {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 40, 1e-3});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double moved = std::hypot(corners[i].x - start[i].x, corners[i].y - start[i].y);
    if (moved < half) grid.points[i] = {corners[i].x, corners[i].y};
  }
}

Grid transposed(const Grid& grid) {
  Grid out{grid.rows, grid.columns, {}};
  for (int row = 0; row < out.rows; ++row) {
    for (int column = 0; column < out.columns; ++column) out.points.push_back(grid.at(column, row));
  }
  return out;
}

Grid flipped(const Grid& grid, bool columns, bool rows) {
  Grid out{grid.columns, grid.rows, {}};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      out.points.push_back(
          grid.at(rows ? grid.rows - 1 - row : row, columns ? grid.columns - 1 - column : column));
    }
  }
  return out;
}

Eigen::Vector2d x_axis(const Grid& g) {
  return g.at(0, g.columns - 1) + g.at(g.rows - 1, g.columns - 1) - g.at(0, 0) -
         g.at(g.rows - 1, 0);
}
Eigen::Vector2d y_axis(const Grid& g) {
  return g.at(g.rows - 1, 0) + g.at(g.rows - 1, g.columns - 1) - g.at(0, 0) -
         g.at(0, g.columns - 1);
}

// Seen from the front, x to y is a turn to the left; in an image, whose y points down, a negative
// determinant.
bool right_handed(const Grid& grid) {
  Eigen::Matrix2d axes;
  axes << x_axis(grid), y_axis(grid);
  return axes.determinant() < 0.0;
}

// Mean grey of the squares that are white in the target's frame minus that of the black ones.
double color_match(const Grid& grid, const cv::Mat& image, const Target& target) {
  double sum = 0.0;
  for (int row = 0; row + 1 < grid.rows; ++row) {
    for (int column = 0; column + 1 < grid.columns; ++column) {
      const Eigen::Vector2d center =
          0.25 * (grid.at(row, column) + grid.at(row, column + 1) + grid.at(row + 1, column) +
                  grid.at(row + 1, column + 1));
      const int x = std::clamp(static_cast<int>(std::lround(center.x())), 0, image.cols - 1);
      const int y = std::clamp(static_cast<int>(std::lround(center.y())), 0, image.rows - 1);
      const double gray = image.at<unsigned char>(y, x);
      sum += target.square_is_black(column, row) ? -gray : gray;
    }
  }
  return sum;
}

// All right-handed frames; those of the right colours if there are any; of these the most upright.
Grid oriented(const Grid& found, const cv::Mat& image, const Target& target) {
  std::vector<Grid> frames;
  for (const Grid& base : {found, transposed(found)}) {
    if (base.columns != target.corner_columns || base.rows != target.corner_rows) continue;
    for (const bool columns : {false, true}) {
      for (const bool rows : {false, true}) {
        Grid frame = flipped(base, columns, rows);
        if (right_handed(frame)) frames.push_back(std::move(frame));
      }
    }
  }
  const auto matches = [&](const Grid& grid) { return color_match(grid, image, target) > 0.0; };
  if (std::any_of(frames.begin(), frames.end(), matches)) {
    std::erase_if(frames, [&](const Grid& grid) { return !matches(grid); });
  }
  // A small part of x decides where y is level.
  const auto uprightness = [](const Grid& grid) {
    return -y_axis(grid).normalized().y() + 1e-3 * x_axis(grid).normalized().x();
  };
  return *std::max_element(frames.begin(), frames.end(), [&](const Grid& a, const Grid& b) {
    return uprightness(a) < uprightness(b);
  });
}

bool search(const cv::Mat& image, Grid& grid, const RunContext& context) {
  const double first = usual_reduction(image);
  struct Attempt {
    double reduction;
    Method method;
  };
  std::vector<Attempt> attempts{{first, Method::kSectors}, {first, Method::kSquares}};
  // The search for squares takes up to 20 s on a full image without this board.
  if (first > 1.2) attempts.push_back({1.0, Method::kSectors});
  attempts.push_back({2.0 * first, Method::kSectors});
  attempts.push_back({2.0 * first, Method::kSquares});
  for (const Attempt& attempt : attempts) {
    if (context.stopped()) return false;
    if (std::min(image.cols, image.rows) / attempt.reduction < 20.0) continue;
    if (find_grid(image, attempt.reduction, attempt.method, grid)) return true;
  }
  return false;
}

// Looks for a second board once the first is painted over, in a small image: it would be about as
// large as the first.
bool shows_another(cv::Mat& image, const Grid& first) {
  const Eigen::Vector2d along = x_axis(first) / (2.0 * (first.columns - 1));
  const Eigen::Vector2d up = y_axis(first) / (2.0 * (first.rows - 1));
  // Over the outer squares, whose inner corners are the grid's.
  const Eigen::Vector2d corners[] = {first.at(0, 0) - along - up,
                                     first.at(0, first.columns - 1) + along - up,
                                     first.at(first.rows - 1, first.columns - 1) + along + up,
                                     first.at(first.rows - 1, 0) - along + up};
  std::vector<cv::Point> polygon;
  for (const Eigen::Vector2d& p : corners)
    polygon.emplace_back(static_cast<int>(p.x()), static_cast<int>(p.y()));
  cv::fillConvexPoly(image, polygon, cv::Scalar(128));
  const double reduction = std::max(1.0, std::max(image.cols, image.rows) / 700.0);
  Grid second{first.columns, first.rows, {}};
  return find_grid(image, reduction, Method::kSectors, second);
}

}  // namespace

Result<CheckerboardCorners> find_checkerboard(const GrayImage& image, const Target& target,
                                              const RunContext& context) {
  Grid grid{target.corner_columns, target.corner_rows, {}};
  bool other_colors = false;
  try {
    cv::Mat mat = to_mat(image);
    if (!search(mat, grid, context)) {
      if (context.stopped()) return Error::cancelled();
      return no_checkerboard(mat, target);
    }
    refine(mat, grid);
    grid = oriented(grid, mat, target);
    other_colors = color_match(grid, mat, target) < 0.0;
    if (shows_another(mat, grid)) {
      return Error::input(Message("two checkerboards of this size are in the image"), {},
                          Message("cover one of them, or leave this scene out"));
    }
  } catch (const cv::Exception&) {
    return Error::input(Message("the image cannot be searched for a checkerboard"));
  }
  const std::vector<Eigen::Vector2d> board = target.checkerboard_corners_m();
  CheckerboardCorners out;
  out.other_colors = other_colors;
  for (std::size_t i = 0; i < board.size(); ++i) {
    out.corners.push_back({static_cast<int>(i), 0, board[i], grid.points[i], 0.0});
  }
  return out;
}

}  // namespace lvcalib
