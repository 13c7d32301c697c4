// SPDX-License-Identifier: GPL-3.0-or-later
#include "target/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>
#include <sstream>
#include <stop_token>

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "base/file_io.h"
#include "base/random.h"

namespace lvcalib {
namespace {
namespace fs = std::filesystem;
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

struct Output {
  int status = -1;
  std::string text;
};

Output shell(const std::string& command) {
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

bool has_program(const std::string& name) {
  return shell("command -v " + name).status == 0;
}

// A drawn page: grey values by position in millimetres from its top-left corner.
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
    const Output out = shell("pdftoppm -gray -r " + std::to_string(dpi) + " '" + pdf.string() +
                             "' '" + (folder_ / "page").string() + "'");
    EXPECT_EQ(out.status, 0) << out.text;
    std::map<std::string, Raster> sorted;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() != ".pgm") continue;
      sorted[entry.path().string()] = {cv::imread(entry.path().string(), cv::IMREAD_GRAYSCALE),
                                       dpi / 25.4};
    }
    std::vector<Raster> out_pages;
    for (auto& [name, raster] : sorted) out_pages.push_back(raster);
    return out_pages;
  }
  fs::path folder_;
};

// Compares the print with the model at random points of the board that lie `clearance_mm` from any
// edge of the pattern. Returns how many were compared.
int compare_with_model(const Target& target, const SheetLayout& layout, const Raster& raster,
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

// Every tag of the model is detected, and its centre and corners lie where the model says.
void expect_tags(const Target& target, const SheetLayout& layout, const Raster& raster) {
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

// Every circle's centroid and area, from the darkness around the place where the model puts it.
void expect_circles(const Target& target, const SheetLayout& layout, const Raster& raster) {
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

void expect_scale_bar(const SheetLayout& layout, const Raster& raster) {
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

TEST_F(SheetFile, PngIsTheBoardToScale) {
  const SheetOptions options{.dpi = 76.2};
  for (const Target& target : {default_board(), odd_grid(), checkerboard()}) {
    const SheetLayout layout = *lay_out_sheet(target, options);
    const Raster raster{
        cv::imread(draw(target, "sheet.png", options).string(), cv::IMREAD_GRAYSCALE), 3.0};
    EXPECT_EQ(raster.image.cols, std::ceil(3.0 * layout.page_mm.x()));
    EXPECT_EQ(raster.image.rows, std::ceil(3.0 * layout.page_mm.y()));
    EXPECT_GT(compare_with_model(target, layout, raster, 0, 0, 1), 5000);
    expect_scale_bar(layout, raster);
    expect_circles(target, layout, raster);
    if (target.has_tags() && target.tag_border_bits == 1) expect_tags(target, layout, raster);
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
  for (const Target& target : {default_board(), odd_grid(), checkerboard()}) {
    const SheetLayout layout = *lay_out_sheet(target, {});
    const auto rasters = pages(draw(target, "sheet.pdf"), 120);
    ASSERT_EQ(rasters.size(), 1U);
    EXPECT_GT(compare_with_model(target, layout, rasters[0], 0, 0, 2), 5000);
    expect_scale_bar(layout, rasters[0]);
    expect_circles(target, layout, rasters[0]);
    if (target.has_tags() && target.tag_border_bits == 1) expect_tags(target, layout, rasters[0]);
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
    const Raster raster{cv::imread(png.string(), cv::IMREAD_GRAYSCALE), 3.0};
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
