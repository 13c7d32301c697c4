// SPDX-License-Identifier: BSD-3-Clause
#include "target/sheet_drawing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <cairo.h>

namespace lvcalib {
namespace {

constexpr double kTextHeight_mm = 3.0;
constexpr double kScaleBarHeight_mm = 1.5;
constexpr double kMarkGap_mm = 1.0;
constexpr double kMarkLength_mm = 5.0;
constexpr double kMarkWidth_mm = 0.2;

// A rectangle in millimetres from the board's top-left corner, y down.
struct Window {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
  [[nodiscard]] bool meets(const Eigen::Vector2d& center, double half_size) const {
    return ((center.array() + half_size) > low.array()).all() &&
           ((center.array() - half_size) < high.array()).all();
  }
};

using Corner = std::pair<int, int>;  // column, row of a cell corner
using Outline = std::vector<Corner>;

// One step along the outline of a tag's white cells, with white on the right-hand side.
std::multimap<Corner, Corner> white_edges(const TagPattern& pattern) {
  const auto white = [&pattern](int row, int column) {
    return row >= 0 && column >= 0 && row < pattern.width && column < pattern.width &&
           pattern.at(row, column);
  };
  std::multimap<Corner, Corner> edges;
  for (int row = 0; row < pattern.width; ++row) {
    for (int column = 0; column < pattern.width; ++column) {
      if (!white(row, column)) continue;
      const Corner corners[] = {
          {column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}};
      if (!white(row - 1, column)) edges.emplace(corners[0], corners[1]);
      if (!white(row, column + 1)) edges.emplace(corners[1], corners[2]);
      if (!white(row + 1, column)) edges.emplace(corners[2], corners[3]);
      if (!white(row, column - 1)) edges.emplace(corners[3], corners[0]);
    }
  }
  return edges;
}

// The closed outlines of a tag's white cells. Where two cells touch at a corner only, either way
// on encloses the same area.
std::vector<Outline> white_outlines(const TagPattern& pattern) {
  std::multimap<Corner, Corner> edges = white_edges(pattern);
  std::vector<Outline> outlines;
  while (!edges.empty()) {
    Outline outline{edges.begin()->first};
    for (auto edge = edges.begin(); edge != edges.end(); edge = edges.find(outline.back())) {
      const Corner next = edge->second;
      edges.erase(edge);
      const std::size_t n = outline.size();
      const bool straight =
          n >= 2 &&
          ((outline[n - 2].first == next.first && outline[n - 1].first == next.first) ||
           (outline[n - 2].second == next.second && outline[n - 1].second == next.second));
      if (straight) outline.pop_back();
      outline.push_back(next);
    }
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

// The black part of a tag as one even-odd shape: its square with the outlines of the white areas
// cut out. No two edges coincide anywhere, so no renderer shows seams between cells.
void fill_tag(cairo_t* cairo, const Target& target, const TargetTag& tag,
              const Eigen::Vector2d& center_mm) {
  const double size = 1000.0 * target.tag_size_m;
  const Eigen::Vector2d corner = center_mm.array() - 0.5 * size;
  cairo_rectangle(cairo, corner.x(), corner.y(), size, size);
  if (const TagPattern* pattern = tag_pattern(target.tag_family, tag.id); pattern != nullptr) {
    const double bit = size / (pattern->width + 2 * target.tag_border_bits);
    for (const Outline& outline : white_outlines(*pattern)) {
      cairo_new_sub_path(cairo);
      for (const auto& [column, row] : outline) {
        cairo_line_to(cairo, corner.x() + bit * (column + target.tag_border_bits),
                      corner.y() + bit * (row + target.tag_border_bits));
      }
      cairo_close_path(cairo);
    }
  }
  cairo_fill(cairo);
}

// Tags or markers, and circles.
bool draw_tags(cairo_t* cairo, const Target& target, const Window& window,
               const RunContext& context) {
  for (const TargetTag& tag : target.tags()) {
    if (context.stopped()) return false;
    const Eigen::Vector2d center = sheet_point_mm(target, tag.center_m);
    if (window.meets(center, 500.0 * target.tag_size_m)) fill_tag(cairo, target, tag, center);
  }
  const double radius = 1000.0 * target.circle_radius_m;
  for (const TargetNode& node : target.nodes()) {
    if (context.stopped()) return false;
    const Eigen::Vector2d center = sheet_point_mm(target, node.center_m);
    if (!window.meets(center, radius)) continue;
    cairo_new_path(cairo);
    cairo_arc(cairo, center.x(), center.y(), radius, 0.0, 2.0 * std::numbers::pi);
    cairo_close_path(cairo);
    cairo_fill(cairo);
  }
  return true;
}

bool draw_squares(cairo_t* cairo, const Target& target, const Window& window,
                  const RunContext& context) {
  const Eigen::Vector2d square(target.column_spacing_m, target.row_spacing_m);
  const double half_mm = 500.0 * square.maxCoeff();
  for (int row = -1; row < target.corner_rows; ++row) {
    if (context.stopped()) return false;
    for (int column = -1; column < target.corner_columns; ++column) {
      const Eigen::Vector2d center_m((column + 0.5) * square.x(), (row + 0.5) * square.y());
      const Eigen::Vector2d center = sheet_point_mm(target, center_m);
      if (!target.square_is_black(column, row) || !window.meets(center, half_mm)) continue;
      cairo_rectangle(cairo, center.x() - 500.0 * square.x(), center.y() - 500.0 * square.y(),
                      1000.0 * square.x(), 1000.0 * square.y());
    }
    cairo_fill(cairo);
  }
  return true;
}

void mark(cairo_t* cairo, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  cairo_set_line_width(cairo, kMarkWidth_mm);
  cairo_move_to(cairo, from.x(), from.y());
  cairo_line_to(cairo, to.x(), to.y());
  cairo_stroke(cairo);
}

// Two short lines that point at a corner from outside; `out` holds the signs of "outside".
void corner_mark(cairo_t* cairo, const Eigen::Vector2d& corner, const Eigen::Vector2d& out) {
  for (const Eigen::Vector2d& axis :
       {Eigen::Vector2d(out.x(), 0.0), Eigen::Vector2d(0.0, out.y())}) {
    mark(cairo, corner + kMarkGap_mm * axis, corner + (kMarkGap_mm + kMarkLength_mm) * axis);
  }
}

// Registration mark: a cross in the page's white border, where the neighbour's cut edge goes.
void join_mark(cairo_t* cairo, const Eigen::Vector2d& at) {
  const double half = 0.4 * kMarkLength_mm;
  mark(cairo, at - Eigen::Vector2d(half, 0), at + Eigen::Vector2d(half, 0));
  mark(cairo, at - Eigen::Vector2d(0, half), at + Eigen::Vector2d(0, half));
}

// Marks lie outside the windows of the board, so nothing of them remains on the joined print.
void draw_marks(cairo_t* cairo, const SheetLayout& layout, int row, int column) {
  const Eigen::Vector2d low = layout.tile_origin_mm;
  const Eigen::Vector2d high = low + layout.tile_mm;
  const Eigen::Vector2d board = layout.board_on_page_mm(row, column);
  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const Eigen::Vector2d out(2 * x - 1, 2 * y - 1);
      const Eigen::Vector2d corner = board + layout.board_mm.cwiseProduct(Eigen::Vector2d(x, y));
      const bool shown = (corner.array() >= low.array() - 1e-6).all() &&
                         (corner.array() <= high.array() + 1e-6).all();
      if (shown) corner_mark(cairo, corner, out);
      if (layout.page_count() > 1) {
        corner_mark(cairo, low + layout.tile_mm.cwiseProduct(Eigen::Vector2d(x, y)), out);
      }
    }
  }
  const double away = kMarkGap_mm + 0.5 * kMarkLength_mm;
  if (column + 1 < layout.columns) {
    join_mark(cairo, {low.x() + layout.step_mm.x(), low.y() - away});
    join_mark(cairo, {low.x() + layout.step_mm.x(), high.y() + away});
  }
  if (row + 1 < layout.rows) {
    join_mark(cairo, {low.x() - away, low.y() + layout.step_mm.y()});
    join_mark(cairo, {high.x() + away, low.y() + layout.step_mm.y()});
  }
}

// Text with its baseline at a point, shrunk to fit a width.
void draw_text(cairo_t* cairo, const Eigen::Vector2d& at, const std::string& text, double room_mm) {
  cairo_set_font_size(cairo, kTextHeight_mm);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  if (extents.x_advance > room_mm) {
    cairo_set_font_size(cairo, kTextHeight_mm * room_mm / extents.x_advance);
  }
  cairo_move_to(cairo, at.x(), at.y());
  cairo_show_text(cairo, text.c_str());
}

void draw_footer(cairo_t* cairo, const Target& target, const SheetLayout& layout, int row,
                 int column) {
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  const Eigen::Vector2d bar = layout.scale_bar_mm;
  const double length = layout.scale_bar_length_mm;
  cairo_rectangle(cairo, bar.x(), bar.y() - 0.5 * kScaleBarHeight_mm, length, kScaleBarHeight_mm);
  cairo_fill(cairo);
  const double room = layout.page_mm.x() - 2.0 * bar.x();
  std::string label = "measure this: " + std::to_string(std::lround(length)) + " mm";
  if (layout.page_count() > 1) {
    label += "   row " + std::to_string(row + 1) + " of " + std::to_string(layout.rows) +
             ", column " + std::to_string(column + 1) + " of " + std::to_string(layout.columns);
  }
  draw_text(cairo, bar + Eigen::Vector2d(length + 3.0, 0.35 * kTextHeight_mm), label,
            room - length - 3.0);
  draw_text(cairo, bar + Eigen::Vector2d(0.0, 6.0), sheet_parameters(target), room);
}

}  // namespace

std::string sheet_parameters(const Target& target) {
  std::string line = to_yaml(target);
  if (!line.empty() && line.back() == '\n') line.pop_back();
  for (std::size_t at = line.find('\n'); at != std::string::npos; at = line.find('\n', at)) {
    line.replace(at, 1, ", ");
  }
  return line;
}

bool draw_sheet_page(cairo_t* cairo, const Target& target, const SheetLayout& layout, int row,
                     int column, const RunContext& context) {
  const Eigen::Vector2d board = layout.board_on_page_mm(row, column);
  const Window window{layout.tile_origin_mm - board,
                      layout.tile_origin_mm - board + layout.tile_mm};
  cairo_save(cairo);
  cairo_rectangle(cairo, layout.tile_origin_mm.x(), layout.tile_origin_mm.y(), layout.tile_mm.x(),
                  layout.tile_mm.y());
  cairo_clip(cairo);
  // A checkerboard's outer squares may reach beyond its board.
  cairo_rectangle(cairo, board.x(), board.y(), layout.board_mm.x(), layout.board_mm.y());
  cairo_clip(cairo);
  cairo_translate(cairo, board.x(), board.y());
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  const bool done = (!target.has_squares() || draw_squares(cairo, target, window, context)) &&
                    draw_tags(cairo, target, window, context);
  cairo_restore(cairo);
  if (!done) return false;
  draw_marks(cairo, layout, row, column);
  draw_footer(cairo, target, layout, row, column);
  return true;
}

}  // namespace lvcalib
