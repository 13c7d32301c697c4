// SPDX-License-Identifier: BSD-3-Clause
#include "camera/camera_deviations.h"

#include <cstdio>
#include <string>
#include <utility>

#include "base/yaml_file.h"
#include "camera/camera_text.h"

namespace lvcalib {
namespace {

constexpr const char* kKey = "standard_deviations";
constexpr const char* kNames[] = {"fx", "fy", "cx", "cy"};
// Wider than any image; more is a slip.
constexpr double kLargest = 1e6;

Result<CameraDeviations> read_section(const YamlFile& section, const Camera& camera) {
  CameraDeviations out = CameraDeviations::Constant(-1.0);
  for (Eigen::Index k = 0; k < 4; ++k) {
    if (!section.has(kNames[k])) continue;
    const auto value = section.number(kNames[k], 0.0, kLargest);
    if (!value) return value.error();
    out(k) = *value;
  }
  if (!section.has("distortion")) return out;
  const auto values = section.numbers("distortion");
  if (!values) return values.error();
  const YamlValue& at = *section.root().find("distortion");
  if (values->size() > static_cast<std::size_t>(camera.distortion_count())) {
    return section.error_at(
        at, Message("'distortion' holds %1 standard deviations, but the model has %2 coefficients",
                    values->size(), camera.distortion_count()));
  }
  for (std::size_t k = 0; k < values->size(); ++k) {
    if (!((*values)[k] >= 0.0 && (*values)[k] <= kLargest))
      return section.error_at(at, Message("standard deviations must be 0 or more"));
    out(4 + static_cast<Eigen::Index>(k)) = (*values)[k];
  }
  return out;
}

Result<std::optional<CameraDeviations>> deviations_of(Result<YamlFile> file, const Camera& camera) {
  if (!file) return file.error();
  // A camchain has them with its first camera.
  const bool nested = !file->has(kKey) && file->has("cam0");
  auto camera_section = nested ? file->section("cam0") : std::move(file);
  if (!camera_section) return camera_section.error();
  if (!camera_section->has(kKey)) return std::optional<CameraDeviations>();
  const auto section = camera_section->section(kKey);
  if (!section) return section.error();
  auto read = read_section(*section, camera);
  if (!read) return read.error();
  return std::optional<CameraDeviations>(*read);
}

}  // namespace

Result<std::optional<CameraDeviations>> read_camera_deviations(const std::filesystem::path& path,
                                                               const Camera& camera) {
  return deviations_of(YamlFile::load(path), camera);
}

Result<std::optional<CameraDeviations>> camera_deviations_from_text(std::string text,
                                                                    const std::string& name,
                                                                    const Camera& camera) {
  return deviations_of(YamlFile::parse(std::move(text), name), camera);
}

std::string to_yaml(const Camera& camera, const CameraDeviations& deviations) {
  // Three digits of a standard deviation are more than is known of it.
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return std::string(text);
  };
  std::string entries;
  const auto add = [&](const std::string& entry) {
    entries += (entries.empty() ? "" : ", ") + entry;
  };
  for (Eigen::Index k = 0; k < 4; ++k) {
    if (deviations(k) >= 0.0) add(kNames[k] + (": " + number(deviations(k))));
  }
  std::string distortion;
  for (Eigen::Index k = 4; k < 4 + camera.distortion_count() && deviations(k) >= 0.0; ++k)
    distortion += (distortion.empty() ? "" : ", ") + number(deviations(k));
  if (!distortion.empty()) add("distortion: [" + distortion + "]");
  const std::string text = to_yaml(camera);
  return entries.empty() ? text : text + kKey + ": {" + entries + "}\n";
}

}  // namespace lvcalib
