// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "base/yaml_file.h"
#include "target/target.h"
#include "target/target_text.h"

namespace lvcalib {
namespace {

constexpr double kLargestLength_m = 100.0;
constexpr int kLargestCount = 1000;
// A rule tells a board's sides to a millimetre.
constexpr double kSameOutline_m = 1e-3;

// Reads keys one after another and keeps the first error.
class Reader {
 public:
  explicit Reader(const YamlFile& file) : file_(file) {}

  void number(const char* key, double& out) { take(file_.number(key, 0.0, kLargestLength_m), out); }
  // In metres, which who wrote millimetres is told.
  void length(const char* key, double& out) {
    const bool fine = !error_;
    number(key, out);
    if (fine && error_ && error_->hint.empty()) error_->hint = Message("lengths are in metres");
  }
  void optional_length(const char* key, double& out) {
    if (file_.has(key)) length(key, out);
  }
  void integer(const char* key, int& out, int low, int high = kLargestCount) {
    take(file_.integer(key, low, high), out);
  }
  void optional_integer(const char* key, int& out, int low, int high = kLargestCount) {
    if (file_.has(key)) integer(key, out, low, high);
  }
  void optional_string(const char* key, std::string& out) {
    if (file_.has(key)) take(file_.string(key), out);
  }
  void optional_flag(const char* key, bool& out) {
    if (!file_.has(key)) return;
    const auto word = file_.string(key);
    if (word && (*word == "true" || *word == "True" || *word == "yes" || *word == "1")) {
      out = true;
    } else if (word && (*word == "false" || *word == "False" || *word == "no" || *word == "0")) {
      out = false;
    } else if (!error_) {
      error_ = word ? file_.error_at(*file_.root().find(key),
                                     Message("%1: expected true or false, found '%2'",
                                             std::string(key), *word))
                    : word.error();
    }
  }
  void string(const char* key, std::string& out) { take(file_.string(key), out); }
  void optional_pair(const char* key, Eigen::Vector2d& out) {
    if (!file_.has(key)) return;
    std::vector<double> pair;
    take(file_.numbers(key, 2), pair);
    if (pair.size() == 2) out = {pair[0], pair[1]};
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  template <class T>
  void take(const Result<T>& result, T& out) {
    if (result) {
      out = *result;
    } else if (!error_) {
      error_ = result.error();
    }
  }
  const YamlFile& file_;
  std::optional<Error> error_;
};

std::string text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

void read_grid(Reader& reader, Target& target) {
  reader.optional_string("tagFamily", target.tag_family);
  reader.integer("tagCols", target.tag_columns, 1);
  reader.integer("tagRows", target.tag_rows, 1);
  reader.length("tagSize", target.tag_size_m);
  reader.number("tagSpacing", target.tag_spacing);
  reader.optional_integer("tagBorder", target.tag_border_bits, 1, 2);
  reader.optional_integer("firstTagId", target.first_tag_id, 0, 1'000'000);
  reader.optional_length("margin", target.margin_m);
  if (target.has_circles()) reader.length("circleRadius", target.circle_radius_m);
}

// boardWidth, boardHeight and boardOffset; without them the board ends with its pattern.
void read_outline(Reader& reader, const YamlFile& file, Target& target) {
  if (file.has("boardWidth")) reader.length("boardWidth", target.board_width_m);
  if (file.has("boardHeight")) reader.length("boardHeight", target.board_height_m);
  reader.optional_pair("boardOffset", target.board_offset_m);
}

void read_checkerboard(Reader& reader, const YamlFile& file, Target& target) {
  reader.integer("targetCols", target.corner_columns, 3);
  reader.integer("targetRows", target.corner_rows, 3);
  reader.length("colSpacingMeters", target.column_spacing_m);
  reader.length("rowSpacingMeters", target.row_spacing_m);
  // Without an outline: the pattern with its outer squares.
  target.board_width_m = (target.corner_columns + 1) * target.column_spacing_m;
  target.board_height_m = (target.corner_rows + 1) * target.row_spacing_m;
  read_outline(reader, file, target);
}

void read_charuco(Reader& reader, const YamlFile& file, Target& target) {
  int columns = 0;
  int rows = 0;
  reader.integer("targetCols", columns, 3);
  reader.integer("targetRows", rows, 3);
  target.corner_columns = columns - 1;
  target.corner_rows = rows - 1;
  reader.length("squareSize", target.column_spacing_m);
  target.row_spacing_m = target.column_spacing_m;
  reader.length("markerSize", target.tag_size_m);
  reader.string("dictionary", target.tag_family);
  if (!target.tag_family.starts_with("DICT_")) target.tag_family.insert(0, "DICT_");
  reader.optional_integer("firstMarkerId", target.first_tag_id, 0, 1'000'000);
  reader.optional_flag("legacyPattern", target.legacy_pattern);
  target.board_width_m = columns * target.column_spacing_m;
  target.board_height_m = rows * target.column_spacing_m;
  read_outline(reader, file, target);
}

void read_single_tag(Reader& reader, const YamlFile& file, Target& target) {
  reader.optional_string("tagFamily", target.tag_family);
  reader.integer("tagId", target.first_tag_id, 0, 1'000'000);
  reader.length("tagSize", target.tag_size_m);
  reader.optional_integer("tagBorder", target.tag_border_bits, 1, 2);
  // A white border of one bit, which the tag needs to be seen.
  const double border_m = target.tag_size_m > 0.0 ? target.tag_bit_m() : 0.0;
  target.board_width_m = target.board_height_m = target.tag_size_m + 2.0 * border_m;
  read_outline(reader, file, target);
}

// A length on the print as a rule tells it, beside the one that was drawn: everything printed is
// that much larger. The board that it is glued to is not.
std::optional<Error> read_measured_length(Reader& reader, const YamlFile& file, Target& target) {
  double measured_m = 0.0;
  double drawn_m = 0.0;
  double sigma_m = 0.0;
  reader.optional_length("measuredLength", measured_m);
  reader.optional_length("drawnLength", drawn_m);
  reader.optional_length("measuredSigma", sigma_m);
  if (reader.error() || (measured_m == 0.0 && drawn_m == 0.0)) return std::nullopt;
  // No printer is off by a tenth; another unit is.
  constexpr double kMost = 0.1;
  if (!(measured_m > 0.0) || !(drawn_m > 0.0) || std::abs(measured_m / drawn_m - 1.0) > kMost) {
    return file.error_at(*file.root().find(measured_m > 0.0 ? "measuredLength" : "drawnLength"),
                         Message("measuredLength and drawnLength belong together, both in metres, "
                                 "and no print is off by more than a tenth; found %1 and %2",
                                 text(measured_m), text(drawn_m)));
  }
  // A steel rule is read to half a millimetre at best.
  constexpr double kRule_m = 0.0005;
  target.size_sigma = (sigma_m > 0.0 ? sigma_m : kRule_m) / measured_m;
  const double larger = measured_m / drawn_m;
  for (double* length : {&target.tag_size_m, &target.circle_radius_m, &target.margin_m,
                         &target.column_spacing_m, &target.row_spacing_m}) {
    *length *= larger;
  }
  if (!file.has("boardWidth")) target.board_width_m *= larger;
  if (!file.has("boardHeight")) target.board_height_m *= larger;
  return std::nullopt;
}

// By how much the outer squares of a checkerboard reach beyond its outline, along the worse side.
double beyond_outline_m(const Target& t) {
  const Eigen::Vector2d squares((t.corner_columns + 1) * t.column_spacing_m,
                                (t.corner_rows + 1) * t.row_spacing_m);
  const Eigen::Vector2d board(t.board_width_m, t.board_height_m);
  return (0.5 * (squares - board) + t.board_offset_m.cwiseAbs()).maxCoeff();
}

// A checkerboard is looked for in clouds by its outline, which Kalibr's files do not have.
void warn_of_outline(const YamlFile& file, const Target& t, std::vector<Message>& warnings) {
  if (t.type != TargetType::kCheckerboard) return;
  if (!file.has("boardWidth") || !file.has("boardHeight")) {
    warnings.push_back(
        Message("%1: without boardWidth and boardHeight the board is taken to end with its outer "
                "squares, and clouds are searched for one of that size; measure the board",
                file.name()));
    return;
  }
  // Columns and rows that are exchanged make the pattern a square too long or more; outlines are
  // measured far better, and who cuts squares off seldom takes so much of them.
  constexpr double kSquares = 0.25;
  const double beyond_m = beyond_outline_m(t);
  if (beyond_m < kSquares * std::min(t.column_spacing_m, t.row_spacing_m)) return;
  Target exchanged = t;
  std::swap(exchanged.corner_columns, exchanged.corner_rows);
  const std::string beyond_mm = std::to_string(std::lround(1e3 * beyond_m));
  warnings.push_back(
      beyond_outline_m(exchanged) < kSameOutline_m
          ? Message("%1: the outer squares reach %2 mm beyond the board's outline; with "
                    "targetCols: %3 and targetRows: %4 they would not",
                    file.name(), beyond_mm, exchanged.corner_columns, exchanged.corner_rows)
          : Message("%1: the outer squares reach %2 mm beyond the board's outline; measure "
                    "boardWidth, boardHeight and boardOffset",
                    file.name(), beyond_mm));
}

Result<TargetFile> target_of(const Result<YamlFile>& file) {
  if (!file) return file.error();
  auto type = file->string("target_type");
  if (!type) return type.error();

  Target target;
  Reader reader(*file);
  std::vector<std::string> known;
  if (*type == "aprilgrid_circles" || *type == "aprilgrid") {
    target.type = *type == "aprilgrid" ? TargetType::kAprilGrid : TargetType::kAprilGridCircles;
    read_grid(reader, target);
    known = {"target_type", "tagFamily", "tagCols",    "tagRows",      "tagSize",
             "tagSpacing",  "tagBorder", "firstTagId", "circleRadius", "margin"};
  } else if (*type == "checkerboard") {
    target.type = TargetType::kCheckerboard;
    read_checkerboard(reader, *file, target);
    known = {"target_type",      "targetCols", "targetRows",  "colSpacingMeters",
             "rowSpacingMeters", "boardWidth", "boardHeight", "boardOffset"};
  } else if (*type == "charuco") {
    target.type = TargetType::kCharuco;
    read_charuco(reader, *file, target);
    known = {"target_type", "targetCols",  "targetRows",    "squareSize",
             "markerSize",  "dictionary",  "firstMarkerId", "legacyPattern",
             "boardWidth",  "boardHeight", "boardOffset"};
  } else if (*type == "apriltag") {
    target.type = TargetType::kAprilTag;
    read_single_tag(reader, *file, target);
    known = {"target_type", "tagFamily",  "tagId",       "tagSize",
             "tagBorder",   "boardWidth", "boardHeight", "boardOffset"};
  } else {
    return file->error_at(*file->root().find("target_type"),
                          Message("target_type '%1' is not known; expected aprilgrid_circles, "
                                  "aprilgrid, checkerboard, charuco or apriltag",
                                  *type));
  }
  known.insert(known.end(), {"measuredLength", "drawnLength", "measuredSigma"});
  std::vector<Message> warnings = file->unknown_keys(known);
  if (const auto wrong = read_measured_length(reader, *file, target)) return *wrong;
  if (reader.error()) {
    // A key that is missing may be there under a misspelt name.
    Error error = *reader.error();
    if (error.hint.empty() && !warnings.empty()) error.hint = warnings.front();
    return error;
  }
  if (Status status = check(target); !status) {
    Error error = status.error();
    error.where = file->name();
    return error;
  }
  warn_of_outline(*file, target, warnings);
  return TargetFile{target, std::move(warnings)};
}

}  // namespace

Result<TargetFile> read_target(const std::filesystem::path& path) {
  return target_of(YamlFile::load(path));
}

Result<TargetFile> target_from_text(std::string text, const std::string& name) {
  return target_of(YamlFile::parse(std::move(text), name));
}

std::string to_yaml(const Target& t) {
  std::string out;
  const auto line = [&out](const char* key, const std::string& value) {
    out += std::string(key) + ": " + value + "\n";
  };
  // The sizes are those measured: what is left to say is how well they are known.
  const auto measured = [&] {
    if (!(t.size_sigma > 0.0)) return;
    line("measuredLength", "1");
    line("drawnLength", "1");
    line("measuredSigma", text(t.size_sigma));
  };
  const auto outline = [&] {
    line("boardWidth", text(t.board_width_m));
    line("boardHeight", text(t.board_height_m));
    line("boardOffset", "[" + text(t.board_offset_m.x()) + ", " + text(t.board_offset_m.y()) + "]");
  };
  if (t.type == TargetType::kCharuco) {
    line("target_type", "charuco");
    line("targetCols", std::to_string(t.corner_columns + 1));
    line("targetRows", std::to_string(t.corner_rows + 1));
    line("squareSize", text(t.column_spacing_m));
    line("markerSize", text(t.tag_size_m));
    line("dictionary", t.tag_family);
    line("firstMarkerId", std::to_string(t.first_tag_id));
    line("legacyPattern", t.legacy_pattern ? "true" : "false");
    outline();
    measured();
    return out;
  }
  if (t.type == TargetType::kAprilTag) {
    line("target_type", "apriltag");
    line("tagFamily", t.tag_family);
    line("tagId", std::to_string(t.first_tag_id));
    line("tagSize", text(t.tag_size_m));
    line("tagBorder", std::to_string(t.tag_border_bits));
    outline();
    measured();
    return out;
  }
  if (t.type == TargetType::kCheckerboard) {
    line("target_type", "checkerboard");
    line("targetCols", std::to_string(t.corner_columns));
    line("targetRows", std::to_string(t.corner_rows));
    line("colSpacingMeters", text(t.column_spacing_m));
    line("rowSpacingMeters", text(t.row_spacing_m));
    outline();
    measured();
    return out;
  }
  line("target_type", t.has_circles() ? "aprilgrid_circles" : "aprilgrid");
  line("tagFamily", t.tag_family);
  line("tagCols", std::to_string(t.tag_columns));
  line("tagRows", std::to_string(t.tag_rows));
  line("tagSize", text(t.tag_size_m));
  line("tagSpacing", text(t.tag_spacing));
  line("tagBorder", std::to_string(t.tag_border_bits));
  line("firstTagId", std::to_string(t.first_tag_id));
  if (t.has_circles()) line("circleRadius", text(t.circle_radius_m));
  line("margin", text(t.margin_m));
  measured();
  return out;
}

}  // namespace lvcalib
