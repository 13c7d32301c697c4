// SPDX-License-Identifier: GPL-3.0-or-later
#include "target/sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>
#include <stop_token>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file_io.h"
#include "core/target/sheet_raster.h"
#include "support/image_files.h"
#include "support/ordinary_boards.h"

namespace lvcalib {
namespace {
namespace fs = std::filesystem;
using test::compare_with_model;
using test::expect_circles;
using test::expect_scale_bar;
using test::expect_tags;
using test::has_program;
using test::Output;
using test::Raster;
using test::shell;
using ::testing::HasSubstr;

Target default_board() {
  return {};
}

Target odd_grid() {
  Target target;
  target.type = TargetType::kAprilGrid;
  target.tag_columns = 5;
  target.tag_rows = 3;
  target.tag_size_m = 0.0617;
  target.tag_spacing = 0.31;
  target.tag_border_bits = 2;
  target.first_tag_id = 100;
  target.margin_m = 0.0123;
  return target;
}

Target checkerboard() {
  Target target;
  target.type = TargetType::kCheckerboard;
  target.corner_columns = 5;
  target.corner_rows = 7;
  target.column_spacing_m = 0.0493;
  target.row_spacing_m = 0.0511;
  target.board_width_m = 0.41;
  target.board_height_m = 0.49;
  target.board_offset_m = {0.013, -0.007};
  return target;
}

bool reads_as_april_tags(const Target& target) {
  return target.tag_family == "tag36h11" && target.has_tags() && target.tag_border_bits == 1;
}

cv::Mat grey_pixels(const fs::path& path) {
  const cv::Mat pixels = test::read_pixels(path);
  if (pixels.channels() == 1) return pixels;
  // A sheet has no colours.
  cv::Mat grey;
  cv::extractChannel(pixels, grey, 0);
  return grey;
}

class SheetFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("lvcalib_sheet_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path draw(const Target& target, const std::string& name, const SheetOptions& options = {}) {
    const fs::path path = folder_ / name;
    const SheetFormat format = path.extension() == ".pdf"   ? SheetFormat::kPdf
                               : path.extension() == ".svg" ? SheetFormat::kSvg
                                                            : SheetFormat::kPng;
    const auto content = draw_sheet(target, format, options, {});
    EXPECT_TRUE(content.ok()) << content.error().text();
    if (content) {
      EXPECT_TRUE(write_file_atomically(path, *content).ok());
    }
    return path;
  }

  // All pages of a PDF, rasterised.
  std::vector<Raster> pages(const fs::path& pdf, int dpi) {
    const Output out = shell("pdftoppm -gray -png -r " + std::to_string(dpi) + " '" + pdf.string() +
                             "' '" + (folder_ / "page").string() + "'");
    EXPECT_EQ(out.status, 0) << out.text;
    std::map<std::string, Raster> sorted;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() != ".png") continue;
      sorted[entry.path().string()] = {grey_pixels(entry.path()), dpi / 25.4};
    }
    std::vector<Raster> out_pages;
    for (auto& [name, raster] : sorted) out_pages.push_back(raster);
    return out_pages;
  }
  fs::path folder_;
};

TEST_F(SheetFile, PngIsTheBoardToScale) {
  const SheetOptions options{.dpi = 76.2};
  for (const Target& target : {default_board(), odd_grid(), checkerboard(), test::charuco_target(),
                               test::legacy_charuco_target(), test::single_tag_target()}) {
    const SheetLayout layout = *lay_out_sheet(target, options);
    const Raster raster{grey_pixels(draw(target, "sheet.png", options)), 3.0};
    EXPECT_EQ(raster.image.cols, std::ceil(3.0 * layout.page_mm.x()));
    EXPECT_EQ(raster.image.rows, std::ceil(3.0 * layout.page_mm.y()));
    EXPECT_GT(compare_with_model(target, layout, raster, 0, 0, 1), 5000);
    expect_scale_bar(layout, raster);
    expect_circles(target, layout, raster);
    if (reads_as_april_tags(target)) expect_tags(target, layout, raster);
  }
}

TEST_F(SheetFile, PngSaysItsResolution) {
  const auto content = read_text_file(draw(odd_grid(), "sheet.png", {.dpi = 150.0}), 1U << 24U);
  ASSERT_TRUE(content.ok());
  const std::size_t chunk = content->find("pHYs");
  ASSERT_EQ(chunk, 37U);  // right after IHDR
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>((*content)[i]); };
  const int per_metre = byte(chunk + 6) << 8 | byte(chunk + 7);
  EXPECT_EQ(per_metre, 5906);  // 150 dpi
  EXPECT_EQ(byte(chunk + 12), 1);
}

TEST_F(SheetFile, PdfIsTheBoardToScale) {
  if (!has_program("pdftoppm")) GTEST_SKIP() << "pdftoppm (poppler-utils) is not installed";
  for (const Target& target : {default_board(), odd_grid(), checkerboard(), test::charuco_target(),
                               test::legacy_charuco_target(), test::single_tag_target()}) {
    const SheetLayout layout = *lay_out_sheet(target, {});
    const auto rasters = pages(draw(target, "sheet.pdf"), 120);
    ASSERT_EQ(rasters.size(), 1U);
    EXPECT_GT(compare_with_model(target, layout, rasters[0], 0, 0, 2), 5000);
    expect_scale_bar(layout, rasters[0]);
    expect_circles(target, layout, rasters[0]);
    if (reads_as_april_tags(target)) expect_tags(target, layout, rasters[0]);
  }
}

TEST_F(SheetFile, PdfPageSizeAndText) {
  if (!has_program("pdfinfo")) GTEST_SKIP() << "pdfinfo (poppler-utils) is not installed";
  const Target target = default_board();
  const SheetLayout layout = *lay_out_sheet(target, {});
  const fs::path pdf = draw(target, "sheet.pdf");
  const std::string info = shell("pdfinfo '" + pdf.string() + "'").text;
  const std::size_t at = info.find("Page size:");
  ASSERT_NE(at, std::string::npos) << info;
  double width = 0;
  double height = 0;
  ASSERT_EQ(std::sscanf(info.c_str() + at, "Page size: %lf x %lf", &width, &height), 2);
  EXPECT_NEAR(width * 25.4 / 72, layout.page_mm.x(), 0.01);
  EXPECT_NEAR(height * 25.4 / 72, layout.page_mm.y(), 0.01);
  const std::string text = shell("pdftotext '" + pdf.string() + "' -").text;
  EXPECT_THAT(text, HasSubstr("measure this: 100 mm"));
  for (const char* parameter : {"target_type: aprilgrid_circles", "tagFamily: tag36h11",
                                "tagSize: 0.12", "tagSpacing: 0.8333", "circleRadius: 0.045"}) {
    EXPECT_THAT(text, HasSubstr(parameter));
  }
}

TEST_F(SheetFile, SvgHasSizeOutlinesAndParameters) {
  const Target target = default_board();
  const auto svg = read_text_file(draw(target, "sheet.svg"), 1U << 24U);
  ASSERT_TRUE(svg.ok());
  const SheetLayout layout = *lay_out_sheet(target, {});
  double width = 0;
  double height = 0;
  const std::size_t at = svg->find("width=");
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(std::sscanf(svg->c_str() + at, "width=\"%lfpt\" height=\"%lfpt\"", &width, &height), 2);
  EXPECT_NEAR(width * 25.4 / 72, layout.page_mm.x(), 0.01);
  EXPECT_NEAR(height * 25.4 / 72, layout.page_mm.y(), 0.01);
  EXPECT_THAT(*svg, HasSubstr("<desc>target_type: aprilgrid_circles, "));
  if (has_program("rsvg-convert")) {
    const fs::path png = folder_ / "svg.png";
    const Output out = shell("rsvg-convert -d 76.2 -p 76.2 -b white -o '" + png.string() + "' '" +
                             (folder_ / "sheet.svg").string() + "'");
    ASSERT_EQ(out.status, 0) << out.text;
    const Raster raster{grey_pixels(png), 3.0};
    EXPECT_GT(compare_with_model(target, layout, raster, 0, 0, 3), 5000);
    expect_tags(target, layout, raster);
    expect_circles(target, layout, raster);
  }
}

// Points on the curves of a path "M x y L x y C x y x y x y Z", in millimetres: ends of all pieces
// and middles of the curved ones.
std::vector<Eigen::Vector2d> points_of_path(const std::string& path) {
  std::vector<Eigen::Vector2d> out;
  std::istringstream words(path);
  const auto point = [&words] {
    Eigen::Vector2d p(0, 0);
    words >> p.x() >> p.y();
    return Eigen::Vector2d(25.4 / 72 * p);
  };
  for (char command = 0; words >> command;) {
    if (command == 'Z') continue;
    if (command == 'C') {
      const Eigen::Vector2d a = out.back();
      const Eigen::Vector2d b = point();
      const Eigen::Vector2d c = point();
      const Eigen::Vector2d d = point();
      out.push_back((a + 3 * b + 3 * c + d) / 8);
      out.push_back(d);
    } else {
      out.push_back(point());
    }
  }
  return out;
}

TEST_F(SheetFile, SvgPathsLieWhereTheModelSays) {
  const Target target = default_board();
  const auto svg = read_text_file(draw(target, "sheet.svg"), 1U << 24U);
  ASSERT_TRUE(svg.ok());
  std::vector<std::vector<Eigen::Vector2d>> paths;
  for (std::size_t at = svg->find(" d=\"M "); at != std::string::npos;
       at = svg->find(" d=\"M ", at + 1)) {
    paths.push_back(points_of_path(svg->substr(at + 4, svg->find('"', at + 4) - at - 4)));
  }
  const auto any_path = [&](const auto& fits) {
    return std::any_of(paths.begin(), paths.end(), fits);
  };
  for (const TargetTag& tag : target.tags()) {
    const Eigen::Vector2d center = sheet_point_mm(target, tag.center_m);
    const double half = 500 * target.tag_size_m;
    EXPECT_TRUE(any_path([&](const auto& path) {
      Eigen::Vector2d low = path[0];
      Eigen::Vector2d high = path[0];
      for (const auto& p : path) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      return (low - center).isConstant(-half, 0.005 / half) &&
             (high - center).isConstant(half, 0.005 / half);
    })) << tag.id;
  }
  for (const TargetNode& node : target.nodes()) {
    const Eigen::Vector2d center = sheet_point_mm(target, node.center_m);
    const double radius = 1000 * target.circle_radius_m;
    EXPECT_TRUE(any_path([&](const auto& path) {
      return path.size() >= 9 && std::all_of(path.begin(), path.end(), [&](const auto& p) {
               return std::abs((p - center).norm() - radius) < 0.005;
             });
    })) << node.id;
  }
}

TEST_F(SheetFile, TilesShowTheWholeBoard) {
  if (!has_program("pdftoppm")) GTEST_SKIP() << "pdftoppm (poppler-utils) is not installed";
  const SheetOptions options{.paper = "A3"};
  for (const Target& target : {default_board(), checkerboard()}) {
    const SheetLayout layout = *lay_out_sheet(target, options);
    ASSERT_GT(layout.page_count(), 1);
    const auto rasters = pages(draw(target, "sheet.pdf", options), 40);
    ASSERT_EQ(static_cast<int>(rasters.size()), layout.page_count());
    int compared = 0;
    for (int page = 0; page < layout.page_count(); ++page) {
      const Raster& raster = rasters[static_cast<std::size_t>(page)];
      compared += compare_with_model(target, layout, raster, page / layout.columns,
                                     page % layout.columns, static_cast<std::uint64_t>(page));
      expect_scale_bar(layout, raster);
    }
    EXPECT_GT(compared, 15000);
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
}

TEST(Sheet, RefusesImagesOfSeveralPagesOrTooManyPixels) {
  const Target target = default_board();
  for (const auto format : {SheetFormat::kSvg, SheetFormat::kPng}) {
    const auto content = draw_sheet(target, format, {.paper = "A4"}, {});
    ASSERT_FALSE(content.ok());
    EXPECT_THAT(content.error().text(), HasSubstr("only a PDF has several pages"));
  }
  for (const double dpi : {0.0, -5.0, std::nan(""), 1200.0, 1e9}) {
    const auto content = draw_sheet(target, SheetFormat::kPng, {.dpi = dpi}, {});
    ASSERT_FALSE(content.ok()) << dpi;
    EXPECT_EQ(content.error().kind, ErrorKind::kUsage);
  }
}

TEST(Sheet, StopsWhenAsked) {
  std::stop_source stop;
  stop.request_stop();
  for (const auto format : {SheetFormat::kPdf, SheetFormat::kSvg, SheetFormat::kPng}) {
    const auto content = draw_sheet(default_board(), format, {}, {{}, stop.get_token(), 1});
    ASSERT_FALSE(content.ok());
    EXPECT_EQ(content.error().kind, ErrorKind::kCancelled);
  }
  // Asked in the middle, by the progress report of a page.
  std::stop_source later;
  int reports = 0;
  RunContext context;
  context.stop = later.get_token();
  context.progress = [&](const Progress&) {
    if (++reports == 3) later.request_stop();
  };
  const auto content = draw_sheet(default_board(), SheetFormat::kPdf, {.paper = "A4"}, context);
  ASSERT_FALSE(content.ok());
  EXPECT_EQ(content.error().kind, ErrorKind::kCancelled);
  EXPECT_EQ(reports, 3);
}

}  // namespace
}  // namespace lvcalib
