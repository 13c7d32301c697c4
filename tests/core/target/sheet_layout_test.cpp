// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "target/sheet.h"

namespace lvcalib {
namespace {
using ::testing::HasSubstr;

Target laid_out_board() {
  return {};
}

TEST(SheetLayout, TilesOverlapAndCoverTheBoard) {
  const Target target = laid_out_board();
  for (const char* paper : {"A4", "A3", "A2", "A1", "A0", "Letter", "300x250", "a4"}) {
    for (const double overlap : {0.0, 10.0, 25.0}) {
      const SheetOptions options{.paper = paper, .overlap_mm = overlap};
      const auto layout = lay_out_sheet(target, options);
      ASSERT_TRUE(layout.ok()) << layout.error().text();
      const Eigen::Vector2d reach =
          layout->tile_mm +
          Eigen::Vector2d(layout->columns - 1, layout->rows - 1).cwiseProduct(layout->step_mm);
      EXPECT_TRUE((reach.array() >= layout->board_mm.array() - 1e-6).all()) << paper;
      // One page fewer would not do.
      if (layout->columns > 1) {
        EXPECT_LT(reach.x() - layout->step_mm.x(), layout->board_mm.x());
      }
      EXPECT_TRUE(((layout->tile_mm - layout->step_mm).array() - overlap).abs().maxCoeff() < 1e-9);
      // The window, the footer and the borders fit the paper.
      EXPECT_LE(layout->tile_origin_mm.x() + layout->tile_mm.x(), layout->page_mm.x() - 9.9);
      EXPECT_LT(layout->tile_origin_mm.y() + layout->tile_mm.y(), layout->scale_bar_mm.y());
      EXPECT_LT(layout->scale_bar_mm.y() + 6.0, layout->page_mm.y() - 9.9);
    }
  }
  EXPECT_EQ(lay_out_sheet(target, {.paper = "A0"})->page_count(), 2);
  EXPECT_EQ(lay_out_sheet(target, {.paper = "1000x1000"})->page_count(), 1);
}

TEST(SheetLayout, SmallBoardsStillHaveAScaleBar) {
  Target target;
  target.tag_size_m = 0.008;
  target.circle_radius_m = 0.003;
  target.margin_m = 0.002;
  const auto layout = lay_out_sheet(target, {});
  ASSERT_TRUE(layout.ok());
  EXPECT_GE(layout->scale_bar_length_mm, 20.0);
  EXPECT_GT(layout->page_mm.x(), layout->board_mm.x());
  EXPECT_TRUE(draw_sheet(target, SheetFormat::kPdf, {}, {}).ok());
}

TEST(SheetLayout, RefusesWhatCannotBePrinted) {
  const Target target = laid_out_board();
  const auto refused = [&](const Target& t, const SheetOptions& options, const char* why) {
    const auto layout = lay_out_sheet(t, options);
    ASSERT_FALSE(layout.ok()) << why;
    EXPECT_EQ(layout.error().kind, ErrorKind::kUsage);
    EXPECT_THAT(layout.error().text(), HasSubstr(why));
  };
  refused(target, {.paper = "B4"}, "paper 'B4' is not known");
  refused(target, {.paper = ""}, "is not known");
  refused(target, {.paper = "100xnan"}, "is not known");
  refused(target, {.paper = "50x50"}, "has no room");
  refused(target, {.paper = "-210x297"}, "has no room");
  refused(target, {.paper = "1e9x1e9"}, "has no room");
  refused(target, {.paper = "A4", .overlap_mm = 150}, "has no room");
  // (210 − 2·5 − 16) / 2: half of the narrower side is a page's own.
  refused(target, {.paper = "A4", .overlap_mm = 300, .page_border_mm = 5},
          "share 300 mm with each neighbour; expected 92 mm at most");
  refused(target, {.paper = "A4", .overlap_mm = -1}, "must not be negative");
  Target huge = target;
  huge.tag_size_m = 40;
  huge.circle_radius_m = 10;
  refused(huge, {}, "larger than a PDF page");
  refused(huge, {.paper = "A4"}, "more than 1000 pages");
  Target bad = target;
  bad.tag_columns = 0;
  EXPECT_EQ(lay_out_sheet(bad, {}).error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace lvcalib
