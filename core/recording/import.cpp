// SPDX-License-Identifier: BSD-3-Clause
#include "recording/import.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/file_io.h"
#include "base/text.h"
#include "cloud/about_cloud.h"
#include "cloud/cloud.h"
#include "recording/guessed_board.h"
#include "recording/messages.h"
#include "recording/pixels.h"
#include "recording/survey.h"
#include "recording/unfinished_folder.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

// Points of a scene: what a calibration takes in its stride, and 100 MB in memory.
constexpr std::size_t kMostScenePoints = 5'000'000;
// By so much a message's way to the recorder may vary; beyond it clocks were set.
constexpr double kMostLatency_s = 0.3;

// Second pass: image and cloud of one stretch after the other.
class SceneWriter {
 public:
  SceneWriter(const Recording& recording, const RecordingSurvey& survey,
              const ImportOptions& options, const RunContext& context)
      : recording_(recording), survey_(survey), options_(options), context_(context) {}

  /// Writes image and cloud of a stretch; its counts go to `out`, a reason to leave it is returned.
  Result<Message> write_scene(const StillStretch& stretch, const std::optional<Camera>& camera,
                              const fs::path& folder, ImportedStretch& out) const;

 private:
  [[nodiscard]] const Topic& image_topic() const {
    return recording_.topics()[survey_.topics.image];
  }
  [[nodiscard]] const Topic& cloud_topic() const {
    return recording_.topics()[survey_.topics.cloud];
  }
  Result<Cloud> accumulate(const StillStretch& stretch, std::size_t& sweeps) const;

  const Recording& recording_;
  const RecordingSurvey& survey_;
  const ImportOptions& options_;
  const RunContext& context_;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

// All sweeps of a stretch as one cloud. Fields that one sweep lacks are dropped from all.
Result<Cloud> SceneWriter::accumulate(const StillStretch& stretch, std::size_t& sweeps) const {
  Cloud out;
  // A sweep takes a period, before or after its stamp: at the ends it may have seen motion.
  const std::int64_t period = survey_.clouds.period_ns();
  TimeSpan span{stretch.first_ns, stretch.last_ns};
  if (stretch.last_ns - stretch.first_ns > 5 * period) {
    span = {stretch.first_ns + period, stretch.last_ns - period};
  }
  span.last_ns =
      std::min(span.last_ns, span.first_ns + static_cast<std::int64_t>(1e9 * options_.max_scene_s));
  const RunContext silent = context_.silent();
  std::int64_t first_ns = 0;
  std::int64_t first_stamp_ns = 0;
  auto read = recording_.read(
      {survey_.topics.cloud}, span, silent, "scene", [&](const RecordedMessage& m) -> Result<bool> {
        auto sweep = decode_cloud(cloud_topic(), m.data);
        if (!sweep) return true;  // Counted in the first pass.
        if (out.warnings.empty()) out.warnings = sweep->cloud.warnings;
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

Result<Message> SceneWriter::write_scene(const StillStretch& stretch,
                                         const std::optional<Camera>& camera,
                                         const fs::path& folder, ImportedStretch& out) const {
  if (Status s = create_folder(folder); !s) return s.error();
  const RunContext silent = context_.silent();
  Message reason = Message("its image cannot be read again");
  fs::path image_path;
  auto read = recording_.read({survey_.topics.image}, {out.image_ns, out.image_ns}, silent, "scene",
                              [&](const RecordedMessage& message) -> Result<bool> {
                                const auto image = decode_image(image_topic(), message.data);
                                if (!image) return true;
                                const auto file = make_image_file(*image, image_topic().name);
                                if (!file) return true;
                                image_path = folder / ("image" + file->extension);
                                if (Status s = write_file_atomically(image_path, file->bytes); !s)
                                  return s.error();
                                reason = {};
                                return false;
                              });
  if (!read) return read.error();
  if (!reason.empty()) return reason;
  if (camera && options_.board_check) {
    reason = options_.board_check(image_path, *camera);
    if (!reason.empty()) reason = Message("the board is not found in its image: %1", reason);
    if (!reason.empty() && options_.board_is_certain) return reason;
    out.board_complaint = reason;
  }
  const auto cloud = accumulate(stretch, out.sweeps);
  if (!cloud) return cloud.error();
  if (cloud->size() == 0) return Message("none of its sweeps can be read");
  out.points = cloud->size();
  out.cloud_warnings = cloud->warnings;
  if (Status s = write_pcd(folder / "cloud.pcd", *cloud); !s) return s.error();
  return Message();
}

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
    entry["by_hand"] = s.by_hand;
    if (s.by_hand) entry["found_s"] = {s.found_first_s, s.found_last_s};
    entry["taken"] = s.taken;
    entry["scene"] = nullptr;
    if (s.taken) entry["scene"] = s.scene;
    entry["reason"] = s.reason.text();
    entry["images"] = s.images;
    entry["image_s"] = s.image_s;
    entry["sweeps"] = s.sweeps;
    entry["points"] = s.points;
    out["stretches"].push_back(entry);
  }
  out["warnings"] = nlohmann::ordered_json::array();
  for (const Message& warning : summary.warnings) out["warnings"].push_back(warning.text());
  return out.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Error nothing_usable(const Recording& recording, const ImportSummary& summary) {
  const std::string where = recording.path().string();
  if (summary.stretches.empty()) {
    return Error::input(
        Message(
            "rig and board never stand still: something moves in images or clouds all the time"),
        where, Message("let everything rest for two seconds or more at each board pose"));
  }
  const ImportedStretch& first = summary.stretches.front();
  return Error::input(
      Message("none of its %1 still stretches can be used; that from %2 s to %3 s: %4",
              summary.stretches.size(), formatted("%.1f", first.first_s),
              formatted("%.1f", first.last_s), first.reason),
      where);
}

std::string scene_name(std::size_t number) {
  return formatted("%03.0f", static_cast<double>(number));
}

std::optional<Camera> camera_of(const RecordingSurvey& survey, const ImportOptions& options) {
  return options.camera ? options.camera : survey.camera;
}

// Writes the scenes of the stretches that are taken; those that turn out to be unusable are left.
Status write_scenes(const Recording& recording, const RecordingSurvey& survey,
                    const ImportOptions& options, const fs::path& folder, const RunContext& context,
                    ImportSummary& out) {
  const std::optional<Camera> camera = camera_of(survey, options);
  const auto stretches = choose_stretches(recording, survey, options);
  if (!stretches) return stretches.error();
  const SceneWriter writer(recording, survey, options, context);
  std::size_t scenes = 0;
  for (std::size_t i = 0; i < stretches->size(); ++i) {
    ImportedStretch entry = describe_stretch(recording, survey, *stretches, i, options);
    if (entry.taken) {
      if (context.stopped()) return Error::cancelled();
      entry.scene = scene_name(scenes + 1);
      context.report("write", static_cast<double>(i) / static_cast<double>(stretches->size()),
                     Message("scene %1", entry.scene));
      const fs::path place = folder / "scenes" / entry.scene;
      const auto reason = writer.write_scene((*stretches)[i], camera, place, entry);
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
  return Done{};
}

Result<ImportSummary> import_into(UnfinishedFolder& folder, const Recording& recording,
                                  const RecordingSurvey& survey, const ImportOptions& options,
                                  const RunContext& context) {
  const auto name = [&](std::size_t topic) { return recording.topics()[topic].name; };
  ImportSummary out;
  out.image_topic = name(survey.topics.image);
  out.cloud_topic = name(survey.topics.cloud);
  if (survey.topics.info) out.info_topic = name(*survey.topics.info);
  out.length_s = 1e-9 * static_cast<double>(recording.span().last_ns - recording.span().first_ns);
  const std::optional<Camera> camera = camera_of(survey, options);
  out.has_camera = camera.has_value();
  if (Status s = write_scenes(recording, survey, options, folder.path(), context, out); !s)
    return s.error();
  judge_guessed_board<ImportedStretch>(
      folder.path(), out.stretches, [](auto& s) { return std::exchange(s.scene, {}); },
      out.warnings);
  for (const ImportedStretch& stretch : out.stretches) {
    for (const Message& warning : stretch.cloud_warnings) {
      if (stretch.taken) out.warnings.push_back(about_cloud(stretch.scene, warning));
    }
  }
  const auto warnings = warnings_of(recording, survey, options);
  out.warnings.insert(out.warnings.end(), warnings.begin(), warnings.end());
  std::vector<std::pair<std::string, std::string>> files = {
      {"target.yaml", options.target_yaml}, {"import.json", import_json(recording, out)}};
  if (camera) files.emplace_back("camera.yaml", to_yaml(*camera));
  for (const auto& [file, text] : files) {
    if (Status s = write_file_atomically(folder.path() / file, text); !s) return s.error();
  }
  if (context.stopped()) return Error::cancelled();
  if (Status s = folder.finish(); !s) return s.error();
  return out;
}

}  // namespace

std::size_t ImportSummary::scene_count() const {
  return static_cast<std::size_t>(
      std::count_if(stretches.begin(), stretches.end(), [](const auto& s) { return s.taken; }));
}

Result<ImportSummary> import_recording(const Recording& recording, const ImportOptions& options,
                                       const fs::path& dataset, const RunContext& context) {
  // What cannot work is told before the long pass.
  const auto topics = choose_topics(recording, options.topics);
  if (!topics) return topics.error();
  auto folder = UnfinishedFolder::create(dataset, options.force);
  if (!folder) return folder.error();
  const auto survey = survey_recording(recording, options, context.part(0.0, 0.7));
  if (!survey) return survey.error();
  return import_into(*folder, recording, *survey, options, context.part(0.7, 1.0));
}

Result<ImportSummary> import_recording(const Recording& recording, const RecordingSurvey& survey,
                                       const ImportOptions& options, const fs::path& dataset,
                                       const RunContext& context) {
  auto folder = UnfinishedFolder::create(dataset, options.force);
  if (!folder) return folder.error();
  return import_into(*folder, recording, survey, options, context);
}

}  // namespace lvcalib
