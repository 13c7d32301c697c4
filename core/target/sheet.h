// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Eigen/Core>

#include "base/error.h"
#include "base/progress.h"
#include "target/target.h"

namespace lvcalib {

enum class SheetFormat { kPdf, kSvg, kPng };

/// How to print the board.
struct SheetOptions {
  /// "board": one page of the board's own size with a strip below it for scale bar and
  /// parameters. Else a paper: A0 … A4, Letter, or WxH in mm ("600x900"), either way up.
  std::string paper = "board";
  double dpi = 300.0;          ///< Of a PNG.
  double overlap_mm = 10.0;    ///< By which neighbouring pages share the print.
  double page_border_mm = 10;  ///< Edge of the paper that a printer leaves white; not on "board".
  int max_pages = 1000;        ///< More pages than this are refused.
};

/// Where everything falls on the pages. All lengths in millimetres of the print; x to the right,
/// y down, from a page's top-left corner. Page (row, column) shows the board's rectangle of the
/// size of `tile_mm` whose top-left corner lies (column, row)·step from the board's.
struct SheetLayout {
  Eigen::Vector2d page_mm = Eigen::Vector2d::Zero();         ///< Size of every page.
  Eigen::Vector2d board_mm = Eigen::Vector2d::Zero();        ///< Size of the board.
  Eigen::Vector2d tile_mm = Eigen::Vector2d::Zero();         ///< Size of the window on a page.
  Eigen::Vector2d tile_origin_mm = Eigen::Vector2d::Zero();  ///< Its top-left corner on the page.
  Eigen::Vector2d step_mm = Eigen::Vector2d::Zero();         ///< From one page to the next.
  int rows = 1;
  int columns = 1;
  Eigen::Vector2d scale_bar_mm = Eigen::Vector2d::Zero();  ///< Left end of the bar's middle line.
  double scale_bar_length_mm = 0.0;

  [[nodiscard]] int page_count() const { return rows * columns; }
  /// Where the board's top-left corner falls on a page; outside it on all pages but the first.
  [[nodiscard]] Eigen::Vector2d board_on_page_mm(int row, int column) const {
    return tile_origin_mm - Eigen::Vector2d(column * step_mm.x(), row * step_mm.y());
  }
};

/// Lays the board out on pages. Errors (usage): unknown paper, paper too small, too many pages.
Result<SheetLayout> lay_out_sheet(const Target& target, const SheetOptions& options);

/// A board point (m, board frame: y up) in millimetres right and down from the board's top-left
/// corner on the print.
Eigen::Vector2d sheet_point_mm(const Target& target, const Eigen::Vector2d& board_point_m);

/// Draws the sheet and returns the file's content: a vector PDF with one page per tile, or an SVG
/// or grey PNG with a single page (an SVG or PNG that would need several pages is a usage error).
/// Lengths are exact: 1 mm of the board is 1 mm of the file, to the resolution of its coordinates
/// (0.002 mm for PDF and SVG) and of `dpi`. Each tag is one filled outline, so no seams appear
/// between its cells. Errors: usage; cancelled; too large for the format.
Result<std::string> draw_sheet(const Target& target, SheetFormat format,
                               const SheetOptions& options, const RunContext& context);

}  // namespace lvcalib
