// SPDX-License-Identifier: BSD-3-Clause
#include "recording/import.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/file_io.h"
#include "base/text.h"
#include "cloud/cloud.h"
#include "recording/messages.h"
#include "recording/pixels.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

// Points of a scene: what a calibration takes in its stride, and 100 MB in memory.
constexpr std::size_t kMostScenePoints = 5'000'000;
// By so much a message's way to the recorder may vary; beyond it clocks were set.
constexpr double kMostLatency_s = 0.3;

// What the first pass found out.
struct Survey {
  Survey(const StillOptions& options)
      : images(make_image_track(options)), clouds(make_cloud_track(options)) {}
  ImageTrack images;
  CloudTrack clouds;
  std::optional<Camera> camera;
  std::string camera_complaint;
  std::size_t bad_images = 0;
  std::size_t bad_clouds = 0;
  std::string first_image_complaint;
  std::string first_cloud_complaint;
  bool intensity = true;
  bool sizes_change = false;
  std::vector<std::string> warnings;
};

class Importer {
 public:
  Importer(const Recording& recording, const ImportOptions& options, TopicChoice topics,
           const RunContext& context)
      : recording_(recording),
        options_(options),
        topics_(topics),
        context_(context),
        offset_ns_(static_cast<std::int64_t>(std::llround(1e9 * options.image_time_offset_s))),
        start_ns_(recording.span().first_ns) {}

  Result<Survey> survey() const;
  Result<std::vector<StillStretch>> choose(const Survey& survey) const;
  [[nodiscard]] ImportedStretch describe(const StillStretch& stretch, const Survey& survey,
                                         const std::vector<StillStretch>& all) const;
  /// Writes image and cloud of a stretch; its counts go to `out`, a reason to leave it is returned.
  Result<std::string> write_scene(const StillStretch& stretch, const Survey& survey,
                                  const std::optional<Camera>& camera, const fs::path& folder,
                                  ImportedStretch& out) const;

 private:
  [[nodiscard]] const Topic& image_topic() const { return recording_.topics()[topics_.image]; }
  [[nodiscard]] const Topic& cloud_topic() const { return recording_.topics()[topics_.cloud]; }
  [[nodiscard]] double seconds(std::int64_t time_ns) const {
    return 1e-9 * static_cast<double>(time_ns - start_ns_);
  }
  Status take(const RecordedMessage& message, Survey& out) const;
  void take_image(const RecordedMessage& message, Survey& out) const;
  void take_cloud(const RecordedMessage& message, Survey& out) const;
  Result<Cloud> accumulate(const StillStretch& stretch, const Survey& survey,
                           std::size_t& sweeps) const;

  const Recording& recording_;
  const ImportOptions& options_;
  TopicChoice topics_;
  const RunContext& context_;
  std::int64_t offset_ns_;
  std::int64_t start_ns_;
};

void Importer::take_image(const RecordedMessage& message, Survey& out) const {
  const std::int64_t time = message.time_ns + offset_ns_;
  if (!out.images.wants(time)) return;
  const auto image = decode_image(image_topic(), message.data);
  auto look = image ? look_at_image(*image, image_topic().name) : Result<ImageLook>(image.error());
  if (!look) {
    if (out.bad_images++ == 0) out.first_image_complaint = look.error().text();
    return;
  }
  if (out.images.size() > 0 && (out.images.look(0).width_px != look->width_px ||
                                out.images.look(0).height_px != look->height_px)) {
    out.sizes_change = true;
  }
  const std::size_t bytes = sizeof(ImageLook) + 2 * look->cells.size();
  out.images.add(time, std::move(*look), bytes);
}

void Importer::take_cloud(const RecordedMessage& message, Survey& out) const {
  if (!out.clouds.wants(message.time_ns)) return;
  const auto cloud = decode_cloud(cloud_topic(), message.data);
  if (!cloud) {
    if (out.bad_clouds++ == 0) out.first_cloud_complaint = cloud.error().text();
    return;
  }
  out.intensity = out.intensity && cloud->cloud.has_intensity();
  CloudLook look = look_at_cloud(cloud->cloud);
  const std::size_t bytes = sizeof(CloudLook) + sizeof(CloudLook::Cell) * look.cells.size();
  out.clouds.add(message.time_ns, std::move(look), bytes);
}

// First pass: looks at both sensors, and the camera's intrinsics.
Result<Survey> Importer::survey() const {
  Survey out(options_.still);
  std::vector<std::size_t> topics = {topics_.image, topics_.cloud};
  if (topics_.info) topics.push_back(*topics_.info);
  RunContext half = context_;
  if (context_.progress) {
    half.progress = [this](const Progress& p) {
      context_.progress({p.stage, 0.7 * p.fraction, p.text});
    };
  }
  auto warnings = recording_.read(
      topics, {}, half, "look", [&](const RecordedMessage& message) -> Result<bool> {
        if (message.topic == topics_.image) take_image(message, out);
        if (message.topic == topics_.cloud) take_cloud(message, out);
        if (topics_.info && message.topic == *topics_.info && !out.camera) {
          auto info = decode_camera_info(recording_.topics()[message.topic], message.data,
                                         topics_.rectified);
          if (info) {
            out.camera = info->camera;
          } else if (out.camera_complaint.empty()) {
            out.camera_complaint = info.error().text();
          }
        }
        return true;
      });
  if (!warnings) return warnings.error();
  out.warnings = std::move(*warnings);
  if (out.images.size() == 0) {
    return Error::input("none of its images can be read: " + out.first_image_complaint,
                        recording_.path().string());
  }
  if (out.clouds.size() == 0) {
    return Error::input("none of its clouds can be read: " + out.first_cloud_complaint,
                        recording_.path().string());
  }
  const auto warn_of_bad = [&](std::size_t bad, const Topic& topic, const std::string& first) {
    if (bad == 0) return;
    out.warnings.push_back(
        topic.name + ": " + std::to_string(bad) +
        " messages cannot be read and are left out, the first because: " + first);
  };
  warn_of_bad(out.bad_images, image_topic(), out.first_image_complaint);
  warn_of_bad(out.bad_clouds, cloud_topic(), out.first_cloud_complaint);
  return out;
}

// The stretches, and with times given only those that hold one.
Result<std::vector<StillStretch>> Importer::choose(const Survey& survey) const {
  auto stretches = find_still_stretches(survey.images, survey.clouds, options_.still);
  if (options_.scene_times_s.empty()) return stretches;
  std::vector<char> asked(stretches.size(), 0);
  for (const double time_s : options_.scene_times_s) {
    const auto holds = [&](const StillStretch& s) {
      const bool usable =
          s.verdict == StretchVerdict::kTaken || s.verdict == StretchVerdict::kRepeat;
      return usable && seconds(s.first_ns) <= time_s && time_s <= seconds(s.last_ns);
    };
    const auto found = std::find_if(stretches.begin(), stretches.end(), holds);
    if (found == stretches.end()) {
      return Error::input("nothing stands still at " + formatted("%.2f s", time_s),
                          recording_.path().string(),
                          "times count from the first message; without --scenes all still "
                          "stretches are found");
    }
    asked[static_cast<std::size_t>(found - stretches.begin())] = 1;
  }
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    StretchVerdict& verdict = stretches[i].verdict;
    if (asked[i] != 0) {
      verdict = StretchVerdict::kTaken;
    } else if (verdict == StretchVerdict::kTaken || verdict == StretchVerdict::kRepeat) {
      verdict = StretchVerdict::kNotAsked;
    }
  }
  return stretches;
}

ImportedStretch Importer::describe(const StillStretch& stretch, const Survey& survey,
                                   const std::vector<StillStretch>& all) const {
  ImportedStretch out;
  out.first_s = std::max(0.0, seconds(stretch.first_ns));
  out.last_s = std::min(seconds(recording_.span().last_ns), seconds(stretch.last_ns));
  out.images = stretch.last_image - stretch.first_image + 1;
  out.image_s = seconds(survey.images.time_ns(stretch.sharpest_image));
  out.taken = stretch.verdict == StretchVerdict::kTaken;
  switch (stretch.verdict) {
    case StretchVerdict::kTaken:
      out.reason = formatted("rig and board stand still for %.1f s", stretch.length_s());
      break;
    case StretchVerdict::kTooShort:
      out.reason = formatted("stands still for %.1f s only; %.1f s are needed", stretch.length_s(),
                             options_.still.min_still_s);
      break;
    case StretchVerdict::kNoCloud:
      out.reason = "no sweep was recorded in this time";
      break;
    case StretchVerdict::kCloudMoves:
      out.reason = "the images stand still, but the clouds change meanwhile";
      break;
    case StretchVerdict::kRepeat: {
      const StillStretch& other = all[stretch.repeat_of];
      out.reason = formatted("the same pose as from %.1f s to %.1f s, which is longer",
                             seconds(other.first_ns), seconds(other.last_ns));
      break;
    }
    case StretchVerdict::kNotAsked:
      out.reason = "stands still, but --scenes does not name it";
      break;
  }
  return out;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// All sweeps of a stretch as one cloud. Fields that one sweep lacks are dropped from all.
Result<Cloud> Importer::accumulate(const StillStretch& stretch, const Survey& survey,
                                   std::size_t& sweeps) const {
  Cloud out;
  // A sweep takes a period, before or after its stamp: at the ends it may have seen motion.
  const std::int64_t period = survey.clouds.period_ns();
  TimeSpan span{stretch.first_ns, stretch.last_ns};
  if (stretch.last_ns - stretch.first_ns > 5 * period) {
    span = {stretch.first_ns + period, stretch.last_ns - period};
  }
  span.last_ns =
      std::min(span.last_ns, span.first_ns + static_cast<std::int64_t>(1e9 * options_.max_scene_s));
  RunContext silent = context_;
  silent.progress = nullptr;
  std::int64_t first_ns = 0;
  std::int64_t first_stamp_ns = 0;
  auto read = recording_.read(
      {topics_.cloud}, span, silent, "scene", [&](const RecordedMessage& m) -> Result<bool> {
        auto sweep = decode_cloud(cloud_topic(), m.data);
        if (!sweep) return true;  // Counted in the first pass.
        if (sweeps == 0) {
          first_ns = m.time_ns;
          first_stamp_ns = sweep->stamp_ns;
        }
        // The sender's clock is the finer one, if it runs at all.
        const double recorded_s = 1e-9 * static_cast<double>(m.time_ns - first_ns);
        const double stamped_s = 1e-9 * static_cast<double>(sweep->stamp_ns - first_stamp_ns);
        const bool agree = stamped_s >= 0.0 && std::abs(stamped_s - recorded_s) < kMostLatency_s;
        const auto later_s = static_cast<float>(agree ? stamped_s : recorded_s);
        for (float& time : sweep->cloud.time_s) time += later_s;
        const auto keeps = [&](auto& column, const auto& more) {
          if (column.size() != out.points_m.size() || more.empty()) {
            column.clear();
          } else {
            append(column, more);
          }
        };
        keeps(out.intensity, sweep->cloud.intensity);
        keeps(out.time_s, sweep->cloud.time_s);
        keeps(out.line, sweep->cloud.line);
        append(out.points_m, sweep->cloud.points_m);
        ++sweeps;
        return out.points_m.size() < kMostScenePoints;
      });
  if (!read) return read.error();
  return out;
}

Result<std::string> Importer::write_scene(const StillStretch& stretch, const Survey& survey,
                                          const std::optional<Camera>& camera,
                                          const fs::path& folder, ImportedStretch& out) const {
  if (Status s = create_folder(folder); !s) return s.error();
  const std::int64_t image_ns = survey.images.time_ns(stretch.sharpest_image) - offset_ns_;
  RunContext silent = context_;
  silent.progress = nullptr;
  std::string reason = "its image cannot be read again";
  fs::path image_path;
  auto read = recording_.read({topics_.image}, {image_ns, image_ns}, silent, "scene",
                              [&](const RecordedMessage& message) -> Result<bool> {
                                const auto image = decode_image(image_topic(), message.data);
                                if (!image) return true;
                                const auto file = make_image_file(*image, image_topic().name);
                                if (!file) return true;
                                image_path = folder / ("image" + file->extension);
                                if (Status s = write_file_atomically(image_path, file->bytes); !s)
                                  return s.error();
                                reason.clear();
                                return false;
                              });
  if (!read) return read.error();
  if (!reason.empty()) return reason;
  if (camera && options_.board_check) {
    reason = options_.board_check(image_path, *camera);
    if (!reason.empty()) reason = "the board is not found in its image: " + reason;
    if (!reason.empty() && options_.board_is_certain) return reason;
    out.board_complaint = reason;
  }
  const auto cloud = accumulate(stretch, survey, out.sweeps);
  if (!cloud) return cloud.error();
  if (cloud->size() == 0) return std::string("none of its sweeps can be read");
  out.points = cloud->size();
  if (Status s = write_pcd(folder / "cloud.pcd", *cloud); !s) return s.error();
  return std::string{};
}

// A folder under another name beside its place, which it takes when it is complete.
class UnfinishedFolder {
 public:
  static Result<UnfinishedFolder> create(const fs::path& destination, bool force) {
    std::error_code code;
    fs::path path = fs::absolute(destination, code).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    if (destination.empty() || !path.has_filename()) {
      return Error::output("is no name for a dataset folder", destination.string());
    }
    const bool exists = fs::exists(fs::symlink_status(path, code));
    const bool empty = fs::is_directory(path, code) && fs::is_empty(path, code);
    if (exists && !empty) {
      const bool imported = fs::is_regular_file(path / "import.json", code);
      if (!force || !imported) {
        return Error::output(
            imported ? "exists already" : "exists already and is no import", destination.string(),
            imported ? "choose another name, or replace it with --force" : "choose another name");
      }
    }
    if (Status s = check_folder_usable(path.parent_path()); !s) return s.error();
    if (Status s = create_folder(path.parent_path()); !s) return s.error();
    UnfinishedFolder out(path);
    fs::remove_all(out.temporary_, code);
    if (Status s = create_folder(out.temporary_ / "scenes"); !s) return s.error();
    return out;
  }
  UnfinishedFolder(UnfinishedFolder&& other) noexcept
      : path_(std::move(other.path_)), temporary_(std::move(other.temporary_)) {
    other.temporary_.clear();
  }
  UnfinishedFolder& operator=(UnfinishedFolder&&) = delete;
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
  ~UnfinishedFolder() {
    std::error_code code;
    if (!temporary_.empty()) fs::remove_all(temporary_, code);
  }

  [[nodiscard]] const fs::path& path() const { return temporary_; }

  Status finish() {
    std::error_code code;
    fs::path old = temporary_;
    old += "-old";
    const bool replaces = fs::exists(path_, code);
    if (replaces) fs::rename(path_, old, code);
    if (!code) fs::rename(temporary_, path_, code);
    if (code) {
      const std::string why = code.message();
      if (replaces && !fs::exists(path_, code)) fs::rename(old, path_, code);
      return Error::output("cannot be put in place: " + why, path_.string());
    }
    temporary_.clear();
    if (replaces) fs::remove_all(old, code);
    return Done{};
  }

 private:
  explicit UnfinishedFolder(fs::path path) : path_(std::move(path)) {
    temporary_ = path_.parent_path() /
                 ("." + path_.filename().string() + ".part" + std::to_string(::getpid()));
  }
  fs::path path_;
  fs::path temporary_;
};

std::string import_json(const Recording& recording, const ImportSummary& summary) {
  nlohmann::ordered_json out;
  out["recording"] = recording.path().string();
  out["container"] = recording.kind();
  out["image_topic"] = summary.image_topic;
  out["cloud_topic"] = summary.cloud_topic;
  out["info_topic"] = nullptr;
  if (!summary.info_topic.empty()) out["info_topic"] = summary.info_topic;
  out["length_s"] = summary.length_s;
  out["stretches"] = nlohmann::ordered_json::array();
  for (const ImportedStretch& s : summary.stretches) {
    nlohmann::ordered_json entry;
    entry["first_s"] = s.first_s;
    entry["last_s"] = s.last_s;
    entry["taken"] = s.taken;
    entry["scene"] = nullptr;
    if (s.taken) entry["scene"] = s.scene;
    entry["reason"] = s.reason;
    entry["images"] = s.images;
    entry["image_s"] = s.image_s;
    entry["sweeps"] = s.sweeps;
    entry["points"] = s.points;
    out["stretches"].push_back(entry);
  }
  out["warnings"] = summary.warnings;
  return out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Error nothing_usable(const Recording& recording, const ImportSummary& summary) {
  const std::string where = recording.path().string();
  if (summary.stretches.empty()) {
    return Error::input(
        "rig and board never stand still: something moves in images or clouds all "
        "the time",
        where, "let everything rest for two seconds or more at each board pose");
  }
  std::string why = formatted("none of its %.0f still stretches can be used",
                              static_cast<double>(summary.stretches.size()));
  const ImportedStretch& first = summary.stretches.front();
  why += formatted("; that from %.1f s to %.1f s: ", first.first_s, first.last_s) + first.reason;
  return Error::input(why, where);
}

void add_warnings(const Survey& survey, const TopicChoice& topics, const ImportOptions& options,
                  ImportSummary& out) {
  for (const std::string& warning : survey.warnings) out.warnings.push_back(warning);
  if (!survey.intensity) {
    out.warnings.push_back(out.cloud_topic +
                           ": clouds have no intensity; the calibration will rest on planes and "
                           "corners alone");
  }
  if (survey.sizes_change) {
    out.warnings.push_back(out.image_topic +
                           ": its images change their size; calibrate takes those "
                           "of the camera's size");
  }
  if (options.camera) return;
  if (!survey.camera) {
    out.warnings.push_back((topics.info
                                ? out.info_topic + ": " +
                                      (survey.camera_complaint.empty() ? "holds no intrinsics"
                                                                       : survey.camera_complaint)
                                : "no CameraInfo was recorded for " + out.image_topic) +
                           "; put a camera.yaml into the dataset before it is calibrated");
    return;
  }
  const ImageLook& image = survey.images.look(0);
  if (image.width_px != survey.camera->width_px || image.height_px != survey.camera->height_px) {
    out.warnings.push_back(
        out.info_topic + ": is of images of " + std::to_string(survey.camera->width_px) + " × " +
        std::to_string(survey.camera->height_px) + " px, but they have " +
        std::to_string(image.width_px) + " × " + std::to_string(image.height_px));
  }
  if (topics.rectified) {
    out.warnings.push_back(out.image_topic +
                           ": is taken for rectified; camera.yaml holds the intrinsics of "
                           "rectified images, without distortion");
  }
}

// Where some scenes show the guessed board it was guessed well, and the others do not show it.
void judge_guessed_board(const fs::path& folder, ImportSummary& out) {
  const auto shows = [](const ImportedStretch& s) { return s.taken && s.board_complaint.empty(); };
  if (std::none_of(out.stretches.begin(), out.stretches.end(), shows)) {
    out.warnings.push_back(
        "no scene shows the default board, which target.yaml describes; put the description of "
        "yours in its place, or import with --target");
    return;
  }
  for (ImportedStretch& s : out.stretches) {
    if (!s.taken || s.board_complaint.empty()) continue;
    std::error_code code;
    fs::remove_all(folder / "scenes" / s.scene, code);
    s.taken = false;
    s.scene.clear();
    s.reason = s.board_complaint;
  }
}

std::string scene_name(std::size_t number) {
  return formatted("%03.0f", static_cast<double>(number));
}

}  // namespace

std::size_t ImportSummary::scene_count() const {
  return static_cast<std::size_t>(
      std::count_if(stretches.begin(), stretches.end(), [](const auto& s) { return s.taken; }));
}

Result<ImportSummary> import_recording(const Recording& recording, const ImportOptions& options,
                                       const fs::path& dataset, const RunContext& context) {
  const auto topics = choose_topics(recording, options.topics);
  if (!topics) return topics.error();
  auto folder = UnfinishedFolder::create(dataset, options.force);
  if (!folder) return folder.error();
  ImportSummary out;
  out.image_topic = recording.topics()[topics->image].name;
  out.cloud_topic = recording.topics()[topics->cloud].name;
  if (topics->info) out.info_topic = recording.topics()[*topics->info].name;
  out.length_s = 1e-9 * static_cast<double>(recording.span().last_ns - recording.span().first_ns);

  const Importer importer(recording, options, *topics, context);
  const auto survey = importer.survey();
  if (!survey) return survey.error();
  const auto stretches = importer.choose(*survey);
  if (!stretches) return stretches.error();
  const std::optional<Camera> camera = options.camera ? options.camera : survey->camera;
  std::size_t scenes = 0;
  for (std::size_t i = 0; i < stretches->size(); ++i) {
    const StillStretch& stretch = (*stretches)[i];
    ImportedStretch entry = importer.describe(stretch, *survey, *stretches);
    if (entry.taken) {
      if (context.stopped()) return Error::cancelled();
      entry.scene = scene_name(scenes + 1);
      context.report("write",
                     0.7 + 0.3 * static_cast<double>(i) / static_cast<double>(stretches->size()),
                     "scene " + entry.scene);
      const fs::path place = folder->path() / "scenes" / entry.scene;
      const auto reason = importer.write_scene(stretch, *survey, camera, place, entry);
      if (!reason) return reason.error();
      if (!reason->empty()) {
        std::error_code code;
        fs::remove_all(place, code);
        entry.taken = false;
        entry.scene.clear();
        entry.reason = *reason;
      } else {
        ++scenes;
      }
    }
    out.stretches.push_back(std::move(entry));
  }
  if (scenes == 0) return nothing_usable(recording, out);
  judge_guessed_board(folder->path(), out);
  add_warnings(*survey, *topics, options, out);
  std::vector<std::pair<std::string, std::string>> files = {
      {"target.yaml", options.target_yaml}, {"import.json", import_json(recording, out)}};
  if (camera) files.emplace_back("camera.yaml", to_yaml(*camera));
  for (const auto& [name, text] : files) {
    if (Status s = write_file_atomically(folder->path() / name, text); !s) return s.error();
  }
  if (context.stopped()) return Error::cancelled();
  if (Status s = folder->finish(); !s) return s.error();
  return out;
}

}  // namespace lvcalib
