// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/dataset_writer.h"

#include <set>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/file_io.h"
#include "base/image_codec.h"
#include "cloud/cloud.h"

namespace lvcalib::simulation {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::size_t kMaxTruthBytes = 64U << 20U;

ordered_json rows(const Rigid3& transform) {
  const Eigen::Matrix4d matrix = transform.matrix();
  ordered_json out = ordered_json::array();
  for (int row = 0; row < 3; ++row) {
    out.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  }
  return out;
}

ordered_json details(const EffectDetails& effects) {
  ordered_json out = ordered_json::object();
  for (const auto& [id, parameters] : effects) {
    for (const auto& [name, values] : parameters) {
      ordered_json& entry = out[id][name];
      if (values.size() == 1) {
        entry = values.front();
      } else {
        entry = values;
      }
    }
  }
  return out;
}

// DATASET without a trailing slash, absolute, so that its name and neighbours are well defined.
fs::path clean(const fs::path& dataset) {
  std::error_code code;
  fs::path path = fs::absolute(dataset, code).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

bool is_simulated_dataset(const fs::path& dataset, const fs::path& truth) {
  const auto text = read_text_file(truth, kMaxTruthBytes);
  if (!text) return false;
  const auto json = nlohmann::json::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains("T_CL") || !json.contains("scenes")) return false;
  const std::set<std::string> known{"target.yaml", "camera.yaml", "scenes"};
  std::error_code code;
  for (fs::directory_iterator it(dataset, code), end; !code && it != end; it.increment(code)) {
    if (!known.contains(it->path().filename().string())) return false;
  }
  return !code && fs::is_regular_file(dataset / "target.yaml", code);
}

Status check_destination(const fs::path& dataset, const fs::path& truth, bool force) {
  std::error_code code;
  const bool exists = fs::exists(fs::symlink_status(dataset, code));
  const bool empty = fs::is_directory(dataset, code) && fs::is_empty(dataset, code) && !code;
  if (exists && !empty) {
    const bool simulated = is_simulated_dataset(dataset, truth);
    if (!simulated) {
      return Error::output(Message("exists already and is not a simulated dataset"),
                           dataset.string(), Message("choose another name"));
    }
    if (!force) {
      return Error::output(Message("exists already"), dataset.string(),
                           Message("choose another name, or replace it with --force"));
    }
  } else if (!force && fs::exists(fs::symlink_status(truth, code))) {
    return Error::output(Message("exists already"), truth.string(),
                         Message("choose another name, or replace it with --force"));
  }
  return Done{};
}

}  // namespace

Result<std::string> encode_png(const SimulatedImage& image) {
  const auto expected =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  if (image.pixels.empty() || image.pixels.size() != expected) {
    return Error::output(Message("the image has no pixels, so no PNG can be made of it"));
  }
  return lvcalib::encode_png(PixelView{image.width_px, image.height_px, 1, 8, image.pixels.data(),
                                       static_cast<std::size_t>(image.width_px)});
}

DatasetWriter::DatasetWriter(const SimulatedRig& rig, fs::path dataset, fs::path truth,
                             fs::path temporary)
    : options_(rig.options),
      camera_from_lidar_(rig.camera_from_lidar),
      effect_details_(rig.effect_details),
      dataset_(std::move(dataset)),
      truth_(std::move(truth)),
      temporary_(std::move(temporary)) {}

DatasetWriter::DatasetWriter(DatasetWriter&& other) noexcept
    : options_(std::move(other.options_)),
      camera_from_lidar_(other.camera_from_lidar_),
      effect_details_(std::move(other.effect_details_)),
      dataset_(std::move(other.dataset_)),
      truth_(std::move(other.truth_)),
      temporary_(std::exchange(other.temporary_, {})),
      scenes_(std::move(other.scenes_)) {}

DatasetWriter::~DatasetWriter() {
  std::error_code code;
  if (!temporary_.empty()) fs::remove_all(temporary_, code);
}

Result<DatasetWriter> DatasetWriter::create(const SimulatedRig& rig, const fs::path& dataset,
                                            bool force) {
  const fs::path path = clean(dataset);
  if (dataset.empty() || !path.has_filename()) {
    return Error::output(Message("is no name for a dataset folder"), dataset.string());
  }
  fs::path truth = path;
  truth += "-truth.json";
  if (Status status = check_destination(path, truth, force); !status) return status.error();
  const fs::path temporary =
      path.parent_path() / ("." + path.filename().string() + ".part" + std::to_string(::getpid()));
  if (Status status = create_folder(path.parent_path()); !status) return status.error();
  std::error_code code;
  fs::remove_all(temporary, code);
  DatasetWriter writer(rig, path, truth, temporary);
  if (Status status = create_folder(temporary / "scenes"); !status) return status.error();
  for (const auto& [name, text] : {std::pair{"target.yaml", to_yaml(rig.target)},
                                   std::pair{"camera.yaml", to_yaml(rig.camera)}}) {
    if (Status status = write_file_atomically(temporary / name, text); !status) {
      return status.error();
    }
  }
  return writer;
}

Status DatasetWriter::add(const SimulatedScene& scene) {
  const fs::path folder = temporary_ / "scenes" / scene.name;
  const auto png = encode_png(scene.image);
  if (!png) return png.error();
  if (Status status = create_folder(folder); !status) return status;
  if (Status status = write_file_atomically(folder / "image.png", *png); !status) return status;
  if (Status status = write_pcd(folder / "cloud.pcd", scene.cloud); !status) return status;
  scenes_[scene.name] = {scene.has_board, scene.camera_from_board, scene.lidar_from_board,
                         scene.cloud.size()};
  return Done{};
}

std::string DatasetWriter::truth_text() const {
  ordered_json truth;
  truth["T_CL"] = rows(camera_from_lidar_);
  truth["case"] = dataset_.filename().string();
  truth["effects"] = ordered_json::object();
  for (const auto& [id, value] : options_.effects) truth["effects"][id] = value;
  if (!effect_details_.empty()) truth["effect_details"] = details(effect_details_);
  truth["scenes"] = ordered_json::object();
  for (const auto& [name, scene] : scenes_) {
    ordered_json entry = ordered_json::object();
    if (scene.has_board) {
      entry["T_CB"] = rows(scene.camera_from_board);
      entry["T_LB"] = rows(scene.lidar_from_board);
    }
    entry["points"] = scene.points;
    truth["scenes"][name] = entry;
  }
  truth["seed"] = options_.seed;
  return truth.dump(1) + "\n";
}

Status DatasetWriter::finish() {
  const auto fail = [&](const std::error_code& code) -> Status {
    return Error::output(Message("cannot be put in place: %1", code.message()), dataset_.string());
  };
  fs::path new_truth = temporary_;
  new_truth += "-truth.json";
  if (Status status = write_file_atomically(new_truth, truth_text()); !status) return status;
  std::error_code code;
  fs::path old = temporary_;
  old += "-old";
  const bool replaced = fs::exists(dataset_, code);
  if (replaced) fs::rename(dataset_, old, code);
  if (!code) fs::rename(temporary_, dataset_, code);
  if (code) {
    const std::error_code reason = code;
    if (replaced && !fs::exists(dataset_, code)) fs::rename(old, dataset_, code);
    fs::remove(new_truth, code);
    return fail(reason);
  }
  temporary_.clear();
  fs::rename(new_truth, truth_, code);
  if (code) return fail(code);
  if (replaced) fs::remove_all(old, code);
  return Done{};
}

Status write_dataset(const SimulatedRig& rig, const fs::path& dataset, bool force) {
  auto writer = DatasetWriter::create(rig, dataset, force);
  if (!writer) return writer.error();
  for (const SimulatedScene& scene : rig.scenes) {
    if (Status status = writer->add(scene); !status) return status;
  }
  return writer->finish();
}

}  // namespace lvcalib::simulation
