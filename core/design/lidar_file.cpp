// SPDX-License-Identifier: BSD-3-Clause
#include "design/lidar_file.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/text.h"
#include "base/units.h"
#include "base/yaml_file.h"

namespace lvcalib {
namespace {

constexpr int kTraits = 64;

// Reads keys one by one and keeps the first error.
class Reader {
 public:
  explicit Reader(const YamlFile& file) : file_(file) {}

  double number(const char* key, double low, double high) {
    const auto value = file_.number(key, low, high);
    if (!value) keep(value.error());
    return value ? *value : low;
  }
  double number_or(const char* key, double low, double high, double otherwise) {
    return file_.has(key) ? number(key, low, high) : otherwise;
  }
  bool flag_or(const char* key, bool otherwise) {
    if (!file_.has(key)) return otherwise;
    const auto value = file_.string(key);
    if (!value) {
      keep(value.error());
    } else if (*value != "true" && *value != "false") {
      keep(file_.error_at(*file_.root().find(key),
                          Message("%1: expected true or false, found '%2'", key, *value)));
    }
    return value ? *value == "true" : otherwise;
  }
  Eigen::Vector2d interval(const char* key, double least, double most) {
    const auto value = file_.numbers(key, 2);
    if (!value) {
      keep(value.error());
      return {0.0, 1.0};
    }
    const Eigen::Vector2d out((*value)[0], (*value)[1]);
    if (!(out.y() > out.x()) || out.x() < least || out.y() > most) {
      keep(file_.error_at(
          *file_.root().find(key),
          Message("%1: expected [low, high] in %2 to %3 degrees", key, int(least), int(most))));
    }
    return kRadPerDeg * out;
  }
  std::string word(const char* key, const std::vector<std::string>& known) {
    const auto value = file_.string(key);
    if (!value) {
      keep(value.error());
      return {};
    }
    for (const std::string& k : known) {
      if (*value == k) return k;
    }
    keep(file_.error_at(*file_.root().find(key), Message("%1: expected %2, found '%3'", key,
                                                         joined(known, " or "), *value)));
    return {};
  }
  std::optional<Rigid3> transform(const char* key) {
    if (!file_.has(key)) return std::nullopt;
    const auto value = file_.numbers(key);
    if (!value) {
      keep(value.error());
      return std::nullopt;
    }
    if (value->size() != 12 && value->size() != 16) {
      keep(file_.error_at(
          *file_.root().find(key),
          Message("%1: expected 3 or 4 rows of 4 numbers, found %2 numbers", key, value->size())));
      return std::nullopt;
    }
    using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
    const Eigen::Map<const Rows> rows(value->data());
    const Eigen::Matrix3d rotation = rows.leftCols<3>();
    if ((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() > 1e-3 ||
        rotation.determinant() < 0.0) {
      keep(file_.error_at(*file_.root().find(key),
                          Message("%1: its left 3x3 part is not a rotation", key)));
      return std::nullopt;
    }
    return Rigid3::from_matrix(rotation, Eigen::Vector3d(rows.col(3)));
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  void keep(Error error) {
    if (!error_) error_ = std::move(error);
  }
  const YamlFile& file_;
  std::optional<Error> error_;
};

double solid_angle_sr(const SensorModel& sensors) {
  const double width = sensors.azimuth_rad.y() - sensors.azimuth_rad.x();
  const double height = std::sin(sensors.elevation_rad.y()) - std::sin(sensors.elevation_rad.x());
  return width * height * (sensors.round ? 0.25 * std::numbers::pi : 1.0);
}

// Shots at even times, whose directions of motion turn by the golden angle.
void spread_traits(int lines, double period_s, double speed_rad_s, SensorModel& out) {
  constexpr double kGolden = 2.399963;
  out.traits.clear();
  for (int k = 0; k < kTraits; ++k) {
    const Eigen::Vector2d along(std::cos(kGolden * k), std::sin(kGolden * k));
    // Times in an order of their own, so that they do not follow the lines.
    const double share = std::fmod(0.618034 * k, 1.0);
    out.traits.push_back({period_s * share, speed_rad_s * along, k % lines});
  }
}

}  // namespace

Rigid3 forward_looking_mount() {
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return Rigid3::from_matrix(rotation, Eigen::Vector3d::Zero().eval());
}

namespace {

Result<LidarFile> lidar_in(const Result<YamlFile>& file) {
  if (!file) return file.error();
  LidarFile out;
  SensorModel& s = out.lidar.sensors;
  Reader reader(*file);
  const bool spinning = reader.word("pattern", {"rosette", "spinning"}) == "spinning";
  s.round = !spinning;
  s.azimuth_rad = reader.interval("azimuth_fov_deg", -360.0, 360.0);
  s.elevation_rad = reader.interval("elevation_fov_deg", -90.0, 90.0);
  s.points_per_sr = reader.number("points_per_scene", 100.0, 1e9) / solid_angle_sr(s);
  s.range_sigma_m = 1e-3 * reader.number("range_noise_mm", 0.01, 1e3);
  s.footprint_rad = 1e-3 * reader.number("beam_mrad", 0.001, 100.0);
  const int lines = static_cast<int>(reader.number_or("lines", 1.0, 1024.0, 1.0));
  out.lidar.has_time = reader.flag_or("time", false);
  out.lidar.has_intensity = reader.flag_or("intensity", true);
  const double speed = reader.number_or("scan_speed_rad_s", 0.0, 1e4, 0.0);
  const double period = reader.number_or("scan_period_s", 1e-6, 1e4, 0.1);
  s.edge_noise = reader.number_or("edge_noise", 1e-3, 10.0, 0.1);
  out.lidar.camera_from_lidar = reader.transform("T_camera_lidar");
  if (file->has("name")) {
    if (const auto name = file->string("name")) out.lidar.name = *name;
  }
  if (reader.error()) return *reader.error();
  out.lidar.lines.resize(static_cast<std::size_t>(lines));
  std::iota(out.lidar.lines.begin(), out.lidar.lines.end(), 0);
  spread_traits(lines, period, speed, s);
  if (spinning) s.lines_by_elevation = lines;
  out.warnings = file->unknown_keys({"name", "pattern", "azimuth_fov_deg", "elevation_fov_deg",
                                     "points_per_scene", "range_noise_mm", "beam_mrad", "lines",
                                     "time", "intensity", "scan_speed_rad_s", "scan_period_s",
                                     "edge_noise", "T_camera_lidar"});
  return out;
}

}  // namespace

Result<LidarFile> read_lidar(const std::filesystem::path& path) {
  return lidar_in(YamlFile::load(path));
}

Result<LidarFile> parse_lidar(std::string text, std::string name) {
  return lidar_in(YamlFile::parse(std::move(text), std::move(name)));
}

LidarDescription lidar_of(const MeasurementTable& table, const Rigid3& camera_from_lidar) {
  LidarDescription out;
  out.sensors = sensors_of(table);
  out.lines = table.lines;
  out.has_time = table.has_time;
  out.has_intensity = table.has_intensity;
  out.camera_from_lidar = camera_from_lidar;
  return out;
}

}  // namespace lvcalib
