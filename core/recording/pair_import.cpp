// SPDX-License-Identifier: BSD-3-Clause
#include "recording/pair_import.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/file_io.h"
#include "base/image_header.h"
#include "cloud/about_cloud.h"
#include "cloud/cloud.h"
#include "cloud/kitti_points.h"
#include "recording/guessed_board.h"
#include "recording/import.h"
#include "recording/messages.h"
#include "recording/recording.h"
#include "recording/unfinished_folder.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostImageBytes = 256U << 20U;
constexpr std::size_t kMostJson = 64U << 20U;
// As of a stretch: what a calibration takes in its stride, and 100 MB in memory.
constexpr std::size_t kMostPoints = 5'000'000;

std::string lower_extension(const fs::path& path) {
  std::string out = path.extension().string();
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool is_cloud_file(const fs::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".pcd" || extension == ".ply";
}

// All clouds of a recording as one: it was made at rest, of one board pose. Fields that one sweep
// lacks are dropped from all.
Result<Cloud> cloud_of_recording(const fs::path& path, const RunContext& context) {
  const RunContext silent = context.silent();
  const auto recording = Recording::open(path, silent);
  if (!recording) return recording.error();
  const auto candidates = list_candidates(*recording);
  if (candidates.clouds.empty())
    return Error::input(Message("holds no clouds"), path.string(),
                        Message("expected PointCloud2 or CustomMsg"));
  const std::size_t index = candidates.clouds.front();
  const Topic& topic = recording->topics()[index];
  Cloud out;
  Message complaint;
  std::int64_t first_ns = 0;
  const auto read = recording->read(
      {index}, {}, silent, "scene", [&](const RecordedMessage& message) -> Result<bool> {
        const auto sweep = decode_cloud(topic, message.data);
        if (!sweep) {
          if (complaint.empty()) complaint = sweep.error().message;
          return true;
        }
        if (out.warnings.empty()) out.warnings = sweep->cloud.warnings;
        const bool first = out.points_m.empty();
        if (first) first_ns = message.time_ns;
        const auto later_s =
            static_cast<float>(1e-9 * static_cast<double>(message.time_ns - first_ns));
        std::vector<float> times = sweep->cloud.time_s;
        for (float& time : times) time += later_s;
        const auto keep = [&](auto& column, const auto& more) {
          if (column.size() != out.points_m.size() || more.empty()) {
            column.clear();
          } else {
            column.insert(column.end(), more.begin(), more.end());
          }
        };
        keep(out.intensity, sweep->cloud.intensity);
        keep(out.time_s, times);
        keep(out.line, sweep->cloud.line);
        out.points_m.insert(out.points_m.end(), sweep->cloud.points_m.begin(),
                            sweep->cloud.points_m.end());
        return out.points_m.size() < kMostPoints;
      });
  if (!read) return read.error();
  if (out.points_m.empty()) {
    return Error::input(complaint.empty()
                            ? Message("none of its clouds can be read")
                            : Message("none of its clouds can be read: %1", complaint),
                        path.string());
  }
  return out;
}

Status copy_whole(const fs::path& from, const fs::path& to) {
  std::error_code code;
  fs::copy_file(from, to, code);
  if (code) return Error::output(Message("cannot be written: %1", code.message()), to.string());
  return Done{};
}

// A cloud as a file of the scene.
Status write_cloud(const fs::path& from, const fs::path& folder, const RunContext& context,
                   ImportedPair& out) {
  const auto cloud = read_pair_cloud(from, context);
  if (!cloud) return cloud.error();
  const Status written = is_cloud_file(from)
                             ? copy_whole(from, folder / ("cloud" + lower_extension(from)))
                             : write_pcd(folder / "cloud.pcd", *cloud);
  if (!written) return written.error();
  out.points = cloud->size();
  out.cloud_warnings = cloud->warnings;
  return Done{};
}

// Why the image cannot be used; empty: it can.
Message image_complaint(const fs::path& image, const std::optional<Camera>& camera) {
  const auto bytes = read_text_file(image, kMostImageBytes);
  if (!bytes) return bytes.error().message;
  const auto header = read_image_header(*bytes);
  if (!header) return header.error().message;
  if (!camera || (header->width_px == camera->width_px && header->height_px == camera->height_px))
    return {};
  return Message("its image has %1 × %2 px, the camera's have %3 × %4", header->width_px,
                 header->height_px, camera->width_px, camera->height_px);
}

// Writes the scene of a pair. A reason to leave it goes to `out`; an error ends the import.
Status write_scene(const PairImportOptions& options, const std::optional<Camera>& camera,
                   const fs::path& folder, const RunContext& context, ImportedPair& out) {
  out.reason = image_complaint(out.files.image, camera);
  if (!out.reason.empty()) return Done{};
  if (Status s = create_folder(folder); !s) return s;
  const fs::path image = folder / ("image" + lower_extension(out.files.image));
  if (Status s = copy_whole(out.files.image, image); !s) return s;
  if (camera && options.board_check) {
    const Message complaint = options.board_check(image, *camera);
    if (context.stopped()) return Error::cancelled();
    if (!complaint.empty())
      out.board_complaint = Message("the board is not found in its image: %1", complaint);
    if (!complaint.empty() && options.board_is_certain) {
      out.reason = out.board_complaint;
      return Done{};
    }
  }
  if (const Status s = write_cloud(out.files.cloud, folder, context, out); !s) {
    if (s.error().kind != ErrorKind::kInput) return s;
    out.reason = s.error().message;
    return Done{};
  }
  if (!out.files.board_points.empty()) {
    // Nothing of the calibration rests on it unless it is asked for.
    if (read_cloud(out.files.board_points, context.stop)) {
      if (Status s = copy_whole(out.files.board_points, folder / "board.pcd"); !s) return s;
    }
  }
  out.taken = true;
  return Done{};
}

void tell_of_clouds(PairImportSummary& out) {
  for (const ImportedPair& pair : out.pairs) {
    for (const Message& warning : pair.cloud_warnings) {
      if (pair.taken) out.warnings.push_back(about_cloud(pair.files.name, warning));
    }
  }
}

nlohmann::ordered_json pair_json(const ImportedPair& pair) {
  nlohmann::ordered_json entry;
  entry["scene"] = pair.files.name;
  entry["image"] = pair.files.image.string();
  entry["cloud"] = pair.files.cloud.string();
  entry["apart_s"] = nullptr;
  if (pair.files.apart_s) entry["apart_s"] = *pair.files.apart_s;
  entry["taken"] = pair.taken;
  entry["reason"] = pair.reason.text();
  entry["points"] = pair.points;
  return entry;
}

std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string import_json(const PairedFiles& files, const PairImportSummary& summary) {
  nlohmann::ordered_json out;
  out["layout"] = name_of(summary.layout);
  out["camera_from"] = nullptr;
  if (!files.camera_from.empty()) out["camera_from"] = files.camera_from;
  out["pairs"] = nlohmann::ordered_json::array();
  for (const ImportedPair& pair : summary.pairs) out["pairs"].push_back(pair_json(pair));
  out["unmatched"] = nlohmann::ordered_json::array();
  for (const UnmatchedFile& file : files.unmatched)
    out["unmatched"].push_back(file.sentence().text());
  out["warnings"] = nlohmann::ordered_json::array();
  for (const Message& warning : summary.warnings) out["warnings"].push_back(warning.text());
  return text_of(out);
}

// Without an import.json the dataset was made by hand, and must not look like an import, which may
// be replaced.
Status tell_import(const fs::path& dataset, PairImportSummary& summary) {
  const fs::path path = dataset / "import.json";
  std::error_code code;
  if (!fs::exists(path, code)) return Done{};
  const auto text = read_text_file(path, kMostJson);
  auto json = text ? nlohmann::ordered_json::parse(*text, nullptr, false)
                   : nlohmann::ordered_json(nlohmann::ordered_json::value_t::discarded);
  if (!json.is_object() || !json["pairs"].is_array()) {
    summary.warnings.push_back(Message("%1: cannot be read, and stays as it is", path.string()));
    return Done{};
  }
  for (const ImportedPair& pair : summary.pairs) json["pairs"].push_back(pair_json(pair));
  if (!json["warnings"].is_array()) json["warnings"] = nlohmann::ordered_json::array();
  for (const Message& warning : summary.warnings) json["warnings"].push_back(warning.text());
  return write_file_atomically(path, text_of(json));
}

// A folder of its own in `scenes` that no listing of scenes shows; removed unless it is moved.
class HiddenScene {
 public:
  explicit HiddenScene(const fs::path& scenes, const std::string& name)
      : path_(scenes / ("." + name + ".part" + std::to_string(::getpid()))) {
    remove();  // What a crash may have left.
  }
  HiddenScene(const HiddenScene&) = delete;
  HiddenScene& operator=(const HiddenScene&) = delete;
  ~HiddenScene() { remove(); }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code code;
    fs::remove_all(path_, code);
  }
  fs::path path_;
};

}  // namespace

Result<Cloud> read_pair_cloud(const fs::path& path, const RunContext& context) {
  if (is_cloud_file(path)) return read_cloud(path, context.stop);
  if (lower_extension(path) == ".bin") return read_kitti_points(path, context.stop);
  return cloud_of_recording(path, context);
}

std::size_t PairImportSummary::scene_count() const {
  return static_cast<std::size_t>(
      std::count_if(pairs.begin(), pairs.end(), [](const auto& p) { return p.taken; }));
}

Result<PairImportSummary> import_pairs(const PairedFiles& files, const PairImportOptions& options,
                                       const fs::path& dataset, const RunContext& context) {
  auto folder = UnfinishedFolder::create(dataset, options.force);
  if (!folder) return folder.error();
  const std::optional<Camera> camera = options.camera ? options.camera : files.camera;
  PairImportSummary out;
  out.layout = files.layout;
  out.has_camera = camera.has_value();
  out.warnings = files.warnings;
  if (!camera)
    out.warnings.push_back(
        Message("no intrinsics lie with the files; put a camera.yaml into the dataset before it is "
                "calibrated"));
  for (std::size_t i = 0; i < files.pairs.size(); ++i) {
    if (context.stopped()) return Error::cancelled();
    context.report("write", static_cast<double>(i) / static_cast<double>(files.pairs.size()),
                   Message("scene %1", files.pairs[i].name));
    ImportedPair pair;
    pair.files = files.pairs[i];
    const fs::path place = folder->path() / "scenes" / pair.files.name;
    if (Status s = write_scene(options, camera, place, context, pair); !s) return s.error();
    if (!pair.taken) {
      std::error_code code;
      fs::remove_all(place, code);
    }
    out.pairs.push_back(std::move(pair));
  }
  if (out.scene_count() == 0) {
    if (out.pairs.empty())
      return Error::input(Message("none of its %1 pairs can be used", out.pairs.size()));
    const ImportedPair& first = out.pairs.front();
    return Error::input(Message("none of its %1 pairs can be used; %2: %3", out.pairs.size(),
                                first.files.name, first.reason),
                        first.files.image.parent_path().string());
  }
  if (camera && options.board_check && !options.board_is_certain)
    judge_guessed_board<ImportedPair>(
        folder->path(), out.pairs, [](const auto& p) { return p.files.name; }, out.warnings);
  tell_of_clouds(out);
  std::vector<std::pair<std::string, std::string>> texts = {
      {"target.yaml", options.target_yaml}, {"import.json", import_json(files, out)}};
  if (camera) texts.emplace_back("camera.yaml", to_yaml(*camera));
  for (const auto& [name, text] : texts) {
    if (Status s = write_file_atomically(folder->path() / name, text); !s) return s.error();
  }
  if (context.stopped()) return Error::cancelled();
  if (Status s = folder->finish(); !s) return s.error();
  return out;
}

Result<PairImportSummary> add_pairs(const std::vector<FilePair>& pairs,
                                    const PairImportOptions& options, const fs::path& dataset,
                                    const RunContext& context) {
  const fs::path scenes = dataset / "scenes";
  std::error_code code;
  if (!fs::is_directory(dataset, code))
    return Error::input(Message("folder not found"), dataset.string());
  if (Status s = create_folder(scenes); !s) return s.error();
  PairImportSummary out;
  out.has_camera = options.camera.has_value();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (context.stopped()) return Error::cancelled();
    context.report("write", static_cast<double>(i) / static_cast<double>(pairs.size()),
                   Message("scene %1", pairs[i].name));
    ImportedPair pair;
    pair.files = pairs[i];
    const fs::path place = scenes / pair.files.name;
    if (fs::exists(fs::symlink_status(place, code))) {
      pair.reason = Message("there is already a scene of this name");
      out.pairs.push_back(std::move(pair));
      continue;
    }
    const HiddenScene hidden(scenes, pair.files.name);
    if (Status s = write_scene(options, options.camera, hidden.path(), context, pair); !s)
      return s.error();
    if (pair.taken) {
      fs::rename(hidden.path(), place, code);
      if (code)
        return Error::output(Message("cannot be put in place: %1", code.message()), place.string());
    }
    out.pairs.push_back(std::move(pair));
  }
  tell_of_clouds(out);
  if (Status s = tell_import(dataset, out); !s) return s.error();
  return out;
}

Message pair_complaint(const FilePair& pair, const RunContext& context) {
  Message out = image_complaint(pair.image, std::nullopt);
  if (!out.empty()) return out;
  const auto cloud = read_pair_cloud(pair.cloud, context);
  return cloud ? Message() : cloud.error().message;
}

}  // namespace lvcalib
