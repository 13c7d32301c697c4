// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/dataset.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/file_io.h"
#include "base/yaml_file.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

// The first of the names that exists in a folder.
fs::path first_existing(const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::error_code code;
    if (fs::exists(folder / name, code)) return folder / name;
  }
  return {};
}

const std::vector<std::string>& image_names() {
  static const std::vector<std::string> names = {"image.png", "image.jpg",  "image.jpeg",
                                                 "image.bmp", "image.tiff", "image.tif"};
  return names;
}

const std::vector<std::string>& cloud_names() {
  static const std::vector<std::string> names = {"cloud.pcd", "cloud.ply"};
  return names;
}

fs::path scene_image(const fs::path& folder) {
  return first_existing(folder, image_names());
}

// A warning for every file of a scene that could be its image or its cloud as well as the one that
// is used.
void warn_of_others(const SceneFiles& scene, std::vector<Message>& warnings) {
  for (const auto& [used, names] :
       {std::pair(scene.image, image_names()), std::pair(scene.cloud, cloud_names())}) {
    for (const std::string& name : names) {
      std::error_code code;
      if (name == used.filename() || !fs::exists(used.parent_path() / name, code)) continue;
      warnings.push_back(Message("scene %1 has %2 and %3: %2 is used; delete the other", scene.name,
                                 used.filename().string(), name));
    }
  }
}

Result<std::vector<fs::path>> list_scene_folders(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code)) {
    return Error::input(Message("folder not found; expected one folder per scene in it"),
                        folder.string());
  }
  std::vector<fs::path> folders;
  for (auto it = fs::directory_iterator(folder, code); !code && it != fs::directory_iterator();
       it.increment(code)) {
    std::error_code inner;
    if (it->is_directory(inner) && !it->path().filename().string().starts_with('.'))
      folders.push_back(it->path());
  }
  if (code) return Error::input(Message("cannot be listed: %1", code.message()), folder.string());
  std::sort(folders.begin(), folders.end());
  return folders;
}

bool is_image_name(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array kExtensions = {".png", ".jpg", ".jpeg", ".bmp", ".tiff", ".tif"};
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

Result<std::vector<SceneFiles>> list_scenes(const fs::path& folder, UnusableScenes unusable) {
  const auto folders = list_scene_folders(folder);
  if (!folders) return folders.error();
  if (folders->empty()) {
    return Error::input(Message("no scenes; expected folders with image.png and cloud.pcd"),
                        folder.string());
  }
  std::vector<SceneFiles> scenes;
  for (const fs::path& path : *folders) {
    auto scene = open_scene(path);
    if (!scene && unusable == UnusableScenes::kRefuse) return scene.error();
    if (scene) {
      scenes.push_back(std::move(*scene));
    } else {
      SceneFiles broken;
      broken.name = path.filename().string();
      broken.problem = scene.error();
      scenes.push_back(std::move(broken));
    }
  }
  return scenes;
}

}  // namespace

Result<SceneFiles> open_scene(const fs::path& folder) {
  SceneFiles scene;
  scene.name = folder.filename().string();
  scene.image = scene_image(folder);
  if (scene.image.empty()) {
    return Error::input(Message("no image in this scene; expected image.png, .jpg, .bmp or .tiff"),
                        folder.string());
  }
  scene.cloud = first_existing(folder, cloud_names());
  if (scene.cloud.empty()) {
    return Error::input(Message("no cloud in this scene; expected cloud.pcd or cloud.ply"),
                        folder.string());
  }
  scene.crop = first_existing(folder, {"board.pcd", "board.ply"});
  return scene;
}

Result<std::vector<fs::path>> list_images(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code))
    return Error::input(Message("folder not found"), folder.string());
  std::vector<fs::path> images;
  for (auto it = fs::directory_iterator(folder, code); !code && it != fs::directory_iterator();
       it.increment(code)) {
    std::error_code inner;
    if (!it->is_directory(inner) && is_image_name(it->path()) &&
        !it->path().filename().string().starts_with('.'))
      images.push_back(it->path());
  }
  if (code) return Error::input(Message("cannot be listed: %1", code.message()), folder.string());
  std::sort(images.begin(), images.end());
  return images;
}

Status add_camera_images(Dataset& dataset, const std::vector<fs::path>& images) {
  // Beyond any camera's; a film of the board is not what is asked for.
  constexpr std::size_t kLargest_bytes = 512U << 20U;
  const fs::path folder = dataset.path / "intrinsics";
  std::vector<std::pair<std::string, std::string>> files;
  for (const fs::path& image : images) {
    if (!is_image_name(image))
      return Error::input(Message("not an image; expected a png, jpg, bmp or tiff file"),
                          image.string());
    auto content = read_text_file(image, kLargest_bytes);
    if (!content) return content.error();
    const std::string name = image.filename().string();
    std::error_code code;
    const auto given = std::find_if(files.begin(), files.end(),
                                    [&](const auto& file) { return file.first == name; });
    const bool on_disk = fs::exists(folder / name, code);
    std::optional<std::string> there;
    if (given != files.end()) there = given->second;
    if (on_disk) {
      auto text = read_text_file(folder / name, kLargest_bytes);
      if (!text) return text.error();
      there = std::move(*text);
    }
    if (there && *there != *content)
      return Error::input(Message("another image of this name is in %1 already", folder.string()),
                          image.string(), Message("give it another name"));
    if (!there) files.emplace_back(name, std::move(*content));
  }
  if (!files.empty()) {
    if (Status s = create_folder(folder); !s) return s;
    if (Status s = write_files_together(folder, files); !s) return s;
  }
  auto listed = list_images(folder);
  if (!listed) return listed.error();
  dataset.camera_images = std::move(*listed);
  return Done{};
}

Result<CameraImages> find_camera_images(const fs::path& path) {
  std::error_code code;
  if (!fs::is_directory(path, code)) {
    return Error::input(Message("folder not found; expected images of the board, or a dataset"),
                        path.string());
  }
  CameraImages out;
  out.target = path / "target.yaml";
  const bool dataset = fs::is_directory(path / "scenes", code);
  const bool extra = fs::is_directory(path / "intrinsics", code);
  if (dataset) {
    const auto folders = list_scene_folders(path / "scenes");
    if (!folders) return folders.error();
    for (const fs::path& folder : *folders) {
      if (fs::path image = scene_image(folder); !image.empty()) out.images.push_back(image);
    }
  }
  if (extra || !dataset) {
    const auto images = list_images(extra ? path / "intrinsics" : path);
    if (!images) return images.error();
    out.images.insert(out.images.end(), images->begin(), images->end());
  }
  if (out.images.empty()) {
    return Error::input(
        Message("no images; expected png, jpg, bmp or tiff files that show the board"),
        path.string());
  }
  return out;
}

Result<Rigid3> read_transform(const fs::path& path, const std::string& key) {
  auto file = YamlFile::load(path);
  if (!file) return file.error();
  const YamlValue* value = file->root().find(key);
  if (value == nullptr) return Error::input(Message("key '%1' is missing", key), path.string());
  if (value->kind == YamlValue::Kind::kMap && value->find("matrix") != nullptr)
    value = value->find("matrix");
  if (value->kind == YamlValue::Kind::kMap) {
    const YamlValue* t = value->find("translation_m");
    const YamlValue* q = value->find("quaternion_xyzw");
    if (t == nullptr || q == nullptr) {
      return file->error_at(
          *value, Message("'%1' must be a matrix, or have translation_m and quaternion_xyzw", key));
    }
    auto translation = file->flatten(*t, "translation_m");
    if (!translation) return translation.error();
    auto rotation = file->flatten(*q, "quaternion_xyzw");
    if (!rotation) return rotation.error();
    if (translation->size() != 3 || rotation->size() != 4) {
      return file->error_at(
          *value, Message("expected 3 numbers in translation_m and 4 in quaternion_xyzw"));
    }
    const auto& r = *rotation;
    const Eigen::Quaterniond quaternion(r[3], r[0], r[1], r[2]);
    if (std::abs(quaternion.norm() - 1.0) > 0.01)
      return file->error_at(*q, Message("quaternion_xyzw must have length 1"));
    return Rigid3{quaternion.normalized(),
                  {(*translation)[0], (*translation)[1], (*translation)[2]}};
  }
  auto numbers = file->flatten(*value, key);
  if (!numbers) return numbers.error();
  if (numbers->size() != 12 && numbers->size() != 16) {
    return file->error_at(
        *value, Message("'%1' must hold 12 or 16 numbers, found %2", key, numbers->size()));
  }
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 12; ++i) m(i / 4, i % 4) = (*numbers)[static_cast<std::size_t>(i)];
  const Eigen::Matrix3d R = m.topLeftCorner<3, 3>();
  // Rough matrices are typed by hand; but they must be rotations, not scales or mirrors.
  if ((R.transpose() * R - Eigen::Matrix3d::Identity()).norm() > 0.05 || R.determinant() < 0) {
    return file->error_at(*value, Message("the left 3×3 part of '%1' is not a rotation", key));
  }
  return Rigid3::from_matrix(m);
}

Result<Rigid3> read_rough_extrinsic(const fs::path& path) {
  return read_transform(path, "T_camera_lidar");
}

std::string place_of(const Dataset& dataset) {
  std::error_code code;
  const fs::path whole = fs::absolute(dataset.path, code);
  return (code ? dataset.path : whole.lexically_normal()).string();
}

Result<Dataset> open_dataset(const fs::path& path, UnusableScenes unusable) {
  std::error_code code;
  if (!fs::is_directory(path, code)) {
    return Error::input(
        Message("dataset folder not found; expected target.yaml, camera.yaml and scenes/ in it"),
        path.string(),
        Message("open it where it is now, or make a dataset from a recording or from files"));
  }
  // Who opens some other folder learns what a dataset is, not which of its files came first.
  if (!fs::exists(path / "target.yaml", code) && !fs::exists(path / "camera.yaml", code) &&
      !fs::exists(path / "scenes", code)) {
    return Error::input(
        Message("this folder is no dataset; a dataset holds target.yaml (the board), camera.yaml "
                "(the intrinsics) and scenes/NAME/ with image.png and cloud.pcd for every scene"),
        path.string(),
        Message("choose the folder that holds these, or make a dataset from a recording or from "
                "files"));
  }
  Dataset dataset;
  dataset.path = path;
  auto target = read_target(path / "target.yaml");
  if (!target) return target.error();
  dataset.target = target->target;
  dataset.warnings = target->warnings;
  auto camera = read_camera(path / "camera.yaml");
  if (!camera) return camera.error();
  dataset.camera = camera->camera;
  auto deviations = read_camera_deviations(path / "camera.yaml", dataset.camera);
  if (!deviations) return deviations.error();
  dataset.camera_deviations = *deviations;
  dataset.warnings.insert(dataset.warnings.end(), camera->warnings.begin(), camera->warnings.end());
  if (fs::exists(path / "rig.yaml", code)) {
    auto rough = read_rough_extrinsic(path / "rig.yaml");
    if (!rough) return rough.error();
    dataset.rough_camera_from_lidar = *rough;
  }
  auto scenes = list_scenes(path / "scenes", unusable);
  if (!scenes) return scenes.error();
  dataset.scenes = std::move(*scenes);
  for (const SceneFiles& scene : dataset.scenes) {
    if (!scene.problem) warn_of_others(scene, dataset.warnings);
  }
  if (fs::is_directory(path / "intrinsics", code)) {
    auto images = list_images(path / "intrinsics");
    if (!images) return images.error();
    dataset.camera_images = std::move(*images);
  }
  return dataset;
}

}  // namespace lvcalib
