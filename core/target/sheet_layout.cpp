// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/yaml_file.h"
#include "target/sheet.h"

namespace lvcalib {
namespace {

// Strip below the board: marks, then the scale bar, then a line of text.
constexpr double kFooter_mm = 16.0;
constexpr double kFooterInset_mm = 4.0;
// Width that the shortest scale bar with its label takes.
constexpr double kLabel_mm = 55.0;
constexpr double kNarrowestFooter_mm = 90.0;
// Acrobat shows pages up to 200 inches.
constexpr double kLongestPage_mm = 200.0 * 25.4;

std::optional<Eigen::Vector2d> paper_size(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  // ISO 216 and ANSI/ASME Y14.1.
  const std::pair<const char*, Eigen::Vector2d> known[] = {
      {"a0", {841, 1189}}, {"a1", {594, 841}}, {"a2", {420, 594}},
      {"a3", {297, 420}},  {"a4", {210, 297}}, {"letter", {215.9, 279.4}}};
  for (const auto& [paper, size] : known) {
    if (name == paper) return size;
  }
  const std::size_t cross = name.find('x');
  Eigen::Vector2d size(0, 0);
  if (cross == std::string::npos || !parse_number(name.substr(0, cross), size.x()) ||
      !parse_number(name.substr(cross + 1), size.y())) {
    return std::nullopt;
  }
  return size;
}

double longest_scale_bar(double room_mm) {
  for (const double length : {100.0, 50.0, 20.0}) {
    if (length + kLabel_mm <= room_mm) return length;
  }
  return 20.0;
}

void place_footer(SheetLayout& layout, double left, double top, double width) {
  layout.scale_bar_mm = {left + kFooterInset_mm, top + 8.5};
  layout.scale_bar_length_mm = longest_scale_bar(width - 2 * kFooterInset_mm);
}

int pages_along(double board_mm, double tile_mm, double overlap_mm) {
  // Rounding of a board that just fits must not cost a page.
  const double pages = std::ceil((board_mm - overlap_mm) / (tile_mm - overlap_mm) - 1e-9);
  return static_cast<int>(std::clamp(pages, 1.0, 1e6));
}

SheetLayout lay_out_one_page(const Eigen::Vector2d& board_mm) {
  SheetLayout out;
  out.board_mm = board_mm;
  out.tile_mm = board_mm;
  out.page_mm = {std::max(board_mm.x(), kNarrowestFooter_mm), board_mm.y() + kFooter_mm};
  place_footer(out, 0.0, board_mm.y(), out.page_mm.x());
  return out;
}

SheetLayout lay_out_tiles(const Eigen::Vector2d& board_mm, const Eigen::Vector2d& page_mm,
                          const SheetOptions& options) {
  const double border = options.page_border_mm;
  SheetLayout out;
  out.board_mm = board_mm;
  out.page_mm = page_mm;
  out.tile_origin_mm = {border, border};
  out.tile_mm = page_mm - Eigen::Vector2d(2 * border, 2 * border + kFooter_mm);
  out.step_mm = out.tile_mm.array() - options.overlap_mm;
  out.columns = pages_along(board_mm.x(), out.tile_mm.x(), options.overlap_mm);
  out.rows = pages_along(board_mm.y(), out.tile_mm.y(), options.overlap_mm);
  place_footer(out, border, page_mm.y() - border - kFooter_mm, page_mm.x() - 2 * border);
  return out;
}

Result<SheetLayout> lay_out_paper(const Eigen::Vector2d& board_mm, const SheetOptions& options) {
  const auto paper = paper_size(options.paper);
  if (!paper) {
    return Error::usage(
        Message("paper '%1' is not known; expected board, A0, A1, A2, A3, A4, Letter or WxH in mm",
                options.paper));
  }
  const double smallest = kNarrowestFooter_mm + 2 * options.page_border_mm;
  const double tile = paper->minCoeff() - 2 * options.page_border_mm - kFooter_mm;
  if (paper->minCoeff() >= smallest && tile > 0.0 && !(tile >= 2 * options.overlap_mm)) {
    return Error::usage(Message("paper '%1' has no room for pages that share %2 mm with each "
                                "neighbour; expected %3 mm at most",
                                options.paper, formatted("%g", options.overlap_mm),
                                static_cast<int>(std::floor(0.5 * tile))),
                        {}, Message("overlap less, or choose a larger paper"));
  }
  if (!(paper->minCoeff() >= smallest) || !(tile >= 2 * options.overlap_mm) ||
      !(paper->maxCoeff() <= kLongestPage_mm)) {
    return Error::usage(Message("paper '%1' has no room; expected sides of %2 to %3 mm",
                                options.paper, static_cast<int>(std::ceil(smallest)),
                                static_cast<int>(kLongestPage_mm)));
  }
  const SheetLayout upright = lay_out_tiles(board_mm, *paper, options);
  const SheetLayout turned = lay_out_tiles(board_mm, {paper->y(), paper->x()}, options);
  const auto pages = [](const SheetLayout& s) { return 1.0 * s.rows * s.columns; };
  const SheetLayout& best = pages(turned) < pages(upright) ? turned : upright;
  if (pages(best) > options.max_pages) {
    return Error::usage(
        Message("the board would take more than %1 pages of %2", options.max_pages, options.paper),
        {}, Message("choose a larger paper; is the board's size in metres?"));
  }
  return best;
}

}  // namespace

Result<SheetLayout> lay_out_sheet(const Target& target, const SheetOptions& options) {
  if (Status status = check(target); !status) return status.error();
  if (!(options.overlap_mm >= 0) || !(options.page_border_mm >= 0)) {
    return Error::usage(Message("overlap and page border must not be negative"));
  }
  const Eigen::Vector2d board_mm = 1000.0 * target.outline().size_m();
  if (options.paper != "board") return lay_out_paper(board_mm, options);
  const SheetLayout out = lay_out_one_page(board_mm);
  if (!(out.page_mm.maxCoeff() <= kLongestPage_mm)) {
    return Error::usage(Message("the board is larger than a PDF page can be (%1 mm)",
                                static_cast<int>(kLongestPage_mm)),
                        {}, Message("tile it over several pages with --paper A0"));
  }
  return out;
}

Eigen::Vector2d sheet_point_mm(const Target& target, const Eigen::Vector2d& board_point_m) {
  const BoardOutline edge = target.outline();
  return 1000.0 * Eigen::Vector2d(board_point_m.x() - edge.lower_left_m.x(),
                                  edge.upper_right_m.y() - board_point_m.y());
}

}  // namespace lvcalib
