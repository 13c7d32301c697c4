// SPDX-License-Identifier: BSD-3-Clause
#include "report/colored_cloud.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/file_io.h"
#include "model/correction.h"
#include "model/scene_geometry.h"
#include "report/json_values.h"
#include "report/result_inputs.h"
#include "report/stored_model.h"

namespace lvcalib {
namespace {

// Side of the cells in which the nearest point is kept, px; the neighbours' cells are looked at
// too, so that a near surface covers what is behind it from one point in 80 pixels on.
constexpr int kCell_px = 3;
// A surface that is seen at a slant changes its distance within those cells by less: at 1000 px of
// focal length by a tenth at 85°. And ranges have noise and mixed returns.
constexpr double kNearer = 0.1;
constexpr double kNearer_m = 0.1;

static_assert(std::endian::native == std::endian::little, "PLY is written as it lies in memory");

struct Seen {
  std::size_t index;
  Eigen::Vector2d pixel;
  double distance_m;
};

class NearestGrid {
 public:
  explicit NearestGrid(const Camera& camera)
      : columns_(camera.width_px / kCell_px + 1),
        rows_(camera.height_px / kCell_px + 1),
        nearest_m_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_),
                   std::numeric_limits<double>::infinity()) {}

  void add(const Seen& point) {
    double& nearest = nearest_m_[index(column(point), row(point))];
    nearest = std::min(nearest, point.distance_m);
  }
  [[nodiscard]] bool hides(const Seen& point) const {
    double nearest = point.distance_m;
    for (int y = std::max(0, row(point) - 1); y <= std::min(rows_ - 1, row(point) + 1); ++y) {
      for (int x = std::max(0, column(point) - 1); x <= std::min(columns_ - 1, column(point) + 1);
           ++x)
        nearest = std::min(nearest, nearest_m_[index(x, y)]);
    }
    return point.distance_m - nearest > kNearer * point.distance_m + kNearer_m;
  }

 private:
  [[nodiscard]] int column(const Seen& p) const {
    return std::clamp(static_cast<int>((p.pixel.x() + 0.5) / kCell_px), 0, columns_ - 1);
  }
  [[nodiscard]] int row(const Seen& p) const {
    return std::clamp(static_cast<int>((p.pixel.y() + 0.5) / kCell_px), 0, rows_ - 1);
  }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }
  int columns_;
  int rows_;
  std::vector<double> nearest_m_;
};

void append_color(const ColorImage& image, const Eigen::Vector2d& pixel,
                  std::vector<std::uint8_t>& rgb) {
  const double x = std::clamp(pixel.x(), 0.0, image.width_px - 1.0);
  const double y = std::clamp(pixel.y(), 0.0, image.height_px - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(0, image.width_px - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, image.height_px - 2));
  const int x1 = std::min(x0 + 1, image.width_px - 1);
  const int y1 = std::min(y0 + 1, image.height_px - 1);
  const double fx = x - x0;
  const double fy = y - y0;
  const auto at = [&](int column, int row, int channel) -> double {
    return image.rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width_px) +
                          static_cast<std::size_t>(column)) +
                     static_cast<std::size_t>(channel)];
  };
  for (int c = 0; c < 3; ++c) {
    const double value = (1.0 - fy) * ((1.0 - fx) * at(x0, y0, c) + fx * at(x1, y0, c)) +
                         fy * ((1.0 - fx) * at(x0, y1, c) + fx * at(x1, y1, c));
    rgb.push_back(static_cast<std::uint8_t>(std::lround(value)));
  }
}

const ExportScene* find_scene(const ExportInput& input, const std::string& name) {
  for (const ExportScene& scene : input.scenes) {
    if (name.empty() ? scene.used && !scene.cloud.empty() && !scene.image.empty()
                     : scene.name == name)
      return &scene;
  }
  return nullptr;
}

// 0…1 over the scenes in use, in their order.
double clock_of(const ExportInput& input, const ExportScene& scene) {
  std::size_t before = 0;
  std::size_t used = 0;
  for (const ExportScene& other : input.scenes) {
    if (&other == &scene) before = used;
    used += other.used ? 1 : 0;
  }
  return std::min(1.0, scene_clock(before, used));
}

}  // namespace

ColoredCloud color_cloud(const Cloud& cloud, const ColorImage& image, const Camera& camera,
                         const Rigid3& camera_from_lidar) {
  ColoredCloud out;
  NearestGrid grid(camera);
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d point = camera_from_lidar * cloud.points_m[i].cast<double>();
    const auto pixel = camera.project(point);
    if (!pixel || !camera.in_image(*pixel)) {
      ++out.outside;
      continue;
    }
    seen.push_back({i, *pixel, point.norm()});
    grid.add(seen.back());
  }
  for (const Seen& point : seen) {
    if (grid.hides(point)) {
      ++out.hidden;
      continue;
    }
    out.cloud.points_m.push_back(cloud.points_m[point.index]);
    if (cloud.has_intensity()) out.cloud.intensity.push_back(cloud.intensity[point.index]);
    append_color(image, point.pixel, out.rgb);
  }
  return out;
}

std::string colored_ply_header(const ExportInput& input, const Cloud& cloud) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& note : export_notes(input)) out += "comment " + note + "\n";
  out += "comment points in the LiDAR frame that the camera sees, with the image's colours\n";
  if (input.use && input.use->corrected)
    out += "comment the model's effects are taken out of the points\n";
  out += "element vertex " + std::to_string(cloud.size()) + "\n";
  for (const char* name : {"x", "y", "z"}) out += std::string("property float ") + name + "\n";
  for (const char* name : {"red", "green", "blue"})
    out += std::string("property uchar ") + name + "\n";
  if (cloud.has_intensity()) out += "property float intensity\n";
  return out + "end_header\n";
}

Result<ColoredCloud> write_colored_ply(const ExportInput& input, const std::string& scene,
                                       const std::filesystem::path& path,
                                       const RunContext& context) {
  const ExportScene* found = find_scene(input, scene);
  if (found == nullptr || found->cloud.empty() || found->image.empty()) {
    std::string known;
    for (const ExportScene& s : input.scenes) known += (known.empty() ? "" : ", ") + s.name;
    return Error::usage(
        scene.empty()
            ? Message("the result names no image and cloud of a scene in use")
            : Message("there is no scene '%1' with image and cloud, known are %2", scene, known),
        "--scene");
  }
  const std::filesystem::path dataset = input.dataset;
  const auto result = parse_json(input.result_json);
  if (result.is_object()) {
    if (Status s =
            check_result_inputs(result, "result.json", {found->image, found->cloud}, context);
        !s)
      return s.error();
  }
  const auto image = read_color_image(dataset / found->image);
  if (!image) return image.error();
  if (image->width_px != input.camera.width_px || image->height_px != input.camera.height_px)
    return Error::input(Message("is of another size than the camera's images"),
                        (dataset / found->image).string());
  auto cloud = read_cloud(dataset / found->cloud, context.stop);
  if (!cloud) return cloud.error();
  // The pose of a model with effects in the points is for clouds without them.
  if (input.use && input.use->corrected) {
    const auto model = model_in(input.result_json, dataset.string());
    if (!model) return model.error();
    CorrectionOptions how;
    how.clock = clock_of(input, *found);
    if (const auto done = correct_cloud(*cloud, model->effects, model->scales, how, context); !done)
      return done.error();
  }
  ColoredCloud out = color_cloud(*cloud, *image, input.camera, input.camera_from_lidar);
  std::string content = colored_ply_header(input, out.cloud);
  const bool has_intensity = out.cloud.has_intensity();
  content.reserve(content.size() + out.cloud.size() * (has_intensity ? 19 : 15));
  for (std::size_t i = 0; i < out.cloud.size(); ++i) {
    char row[19];
    std::memcpy(row, out.cloud.points_m[i].data(), 12);
    std::memcpy(row + 12, &out.rgb[3 * i], 3);
    if (has_intensity) std::memcpy(row + 15, &out.cloud.intensity[i], 4);
    content.append(row, has_intensity ? 19 : 15);
  }
  if (context.stopped()) return Error::cancelled();
  if (Status s = write_file_atomically(path, content); !s) return s.error();
  return out;
}

}  // namespace lvcalib
