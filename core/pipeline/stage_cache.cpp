// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stage_cache.h"

#include <charconv>
#include <filesystem>
#include <system_error>

#include "pipeline/calibration.h"

namespace lvcalib {
namespace {

namespace fs = std::filesystem;

void append(std::string& key, double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;  // Shortest that reads back.
  key.append(text, end);
  key += ' ';
}

void append(std::string& key, const Eigen::Ref<const Eigen::VectorXd>& values) {
  for (const double value : values) append(key, value);
}

// A file as far as a change can be seen without reading it.
void append_file(std::string& key, const fs::path& path) {
  std::error_code code;
  key += path.string() + ' ' + std::to_string(fs::file_size(path, code)) + ' ';
  const auto time = fs::last_write_time(path, code);
  key += std::to_string(time.time_since_epoch().count()) + '\n';
}

void append_options(std::string& key, const CalibrationOptions& options, const char* stage) {
  for (const OptionDeclaration& d : option_declarations()) {
    if (d.stage == stage) append(key, d.get(options));
  }
  key += '\n';
}

}  // namespace

void StageCache::prepare(const Dataset& dataset) {
  std::map<std::string, SceneStages> scenes;
  for (const SceneFiles& files : dataset.scenes) {
    const auto kept = scenes_.find(files.name);
    scenes[files.name] = kept == scenes_.end() ? SceneStages{} : std::move(kept->second);
  }
  for (const fs::path& image : dataset.camera_images) {
    const std::string name = extra_image_name(image);
    const auto kept = scenes_.find(name);
    scenes[name] = kept == scenes_.end() ? SceneStages{} : std::move(kept->second);
  }
  scenes_ = std::move(scenes);
}

std::string extra_image_name(const fs::path& image) {
  return "intrinsics/" + image.filename().string();
}

std::string detection_key(const Dataset& dataset, const SceneFiles& files,
                          const CalibrationOptions& options) {
  std::string key = to_yaml(dataset.target) + to_yaml(dataset.camera);
  append_file(key, files.image);
  append_options(key, options, "detect");
  return key;
}

std::string search_key(const Dataset& dataset, const SceneFiles& files,
                       const CalibrationRequest& request) {
  std::string key = detection_key(dataset, files, request.options);
  append_file(key, request.use_crops && !files.crop.empty() ? files.crop : files.cloud);
  if (const auto box = request.crop_boxes.find(files.name); box != request.crop_boxes.end()) {
    key += "crop ";
    append(key, box->second.center_m);
    append(key, box->second.half_size_m);
    append(key, box->second.rotation.coeffs());
  }
  if (request.guess) {
    key += "guess ";
    append(key, request.guess->translation);
    append(key, request.guess->rotation.coeffs());
  }
  append_options(key, request.options, "localize");
  return key;
}

std::string second_look_key(const std::string& search_key, const BoardSearchRegion& region) {
  std::string key = search_key + "region ";
  append(key, region.center_m);
  append(key, region.radius_m);
  if (region.width) append(key, *region.width);
  return key;
}

std::string refinement_key(const std::string& search_key, std::size_t candidate,
                           const CalibrationOptions& options) {
  std::string key = search_key + "candidate " + std::to_string(candidate) + '\n';
  append_options(key, options, "refine");
  return key;
}

}  // namespace lvcalib
