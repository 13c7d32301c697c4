// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text.h"
#include "base/yaml_file.h"
#include "camera/camera.h"
#include "command.h"
#include "pipeline/board_check.h"
#include "recording/file_pairs.h"
#include "recording/import.h"
#include "recording/messages.h"
#include "recording/pair_import.h"
#include "target/target.h"

namespace lvcalib::cli {
namespace {
namespace fs = std::filesystem;

struct ImportArguments {
  std::string recording;
  std::string output;
  bool list = false;
  std::string target;
  std::string camera;
  std::string scenes = "auto";
  std::string clouds;
  std::string match = "auto";
  double most_apart_s = 0.0;
  ImportOptions import;
};

void warn_all(const std::vector<Message>& warnings, const Session& session) {
  for (const Message& warning : warnings) session.warn(warning);
}

// All but the last line, which is the summary: what is printed at once is made one line of.
std::string print_all_but_last(std::vector<std::string> lines, Session& session) {
  std::string last = std::move(lines.back());
  lines.pop_back();
  for (const std::string& line : lines) session.print(line);
  return last;
}

// A table of topics.
Result<std::string> list(const Recording& recording, Session& session) {
  const auto complaints = check_recording(recording, session.context);
  if (!complaints) return complaints.error();
  warn_all(*complaints, session);
  const TimeSpan span = recording.span();
  const auto seconds = [&](std::int64_t t) {
    return 1e-9 * static_cast<double>(t - span.first_ns);
  };
  const bool empty = span.first_ns > span.last_ns;
  char line[160];
  std::snprintf(line, sizeof line, "%s, %.1f s, %zu topics", recording.kind().c_str(),
                empty ? 0.0 : seconds(span.last_ns), recording.topics().size());
  std::vector<std::string> out{line};
  std::snprintf(line, sizeof line, "%9s %9s %9s %9s  %-28s %s", "messages", "rate Hz", "first s",
                "last s", "type", "topic");
  out.emplace_back(line);
  for (const Topic& topic : recording.topics()) {
    if (topic.count == 0) {
      std::snprintf(line, sizeof line, "%9d %9s %9s %9s  ", 0, "-", "-", "-");
    } else {
      std::snprintf(line, sizeof line, "%9llu %9.2f %9.2f %9.2f  ",
                    static_cast<unsigned long long>(topic.count), topic.rate_hz(),
                    seconds(topic.first_ns), seconds(topic.last_ns));
    }
    std::string type = topic.type;
    type.resize(std::max<std::size_t>(type.size(), 28), ' ');
    out.push_back(line + type + " " + topic.name);
    if (!readable_encoding(topic.encoding)) out.back() += " (" + topic.encoding + ")";
    if (const std::string converter = converter_of(topic.type); !converter.empty()) {
      out.back() += " (raw: convert it with " + converter + ")";
    }
  }
  return print_all_but_last(std::move(out), session);
}

Result<std::vector<double>> scene_times(const std::string& text) {
  std::vector<double> out;
  if (text == "auto") return out;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    double value = 0.0;
    if (!parse_number(text.substr(begin, end - begin), value) || value < 0.0) {
      return Error::usage(Message("'%1' is no list of times; expected auto, or seconds from the "
                                  "first message: 4.5,12,20",
                                  text.substr(0, 100)),
                          "--scenes");
    }
    out.push_back(value);
    begin = end + 1;
  }
  return out;
}

// --target, or a target.yaml that lies with the recording.
fs::path target_path(const ImportArguments& options) {
  if (!options.target.empty()) return options.target;
  std::error_code code;
  const fs::path recording = options.recording;
  const fs::path beside =
      (fs::is_directory(recording, code) ? recording : recording.parent_path()) / "target.yaml";
  return fs::is_regular_file(beside, code) ? beside : fs::path{};
}

// The board that the dataset will name, the default one if none is given. Stretches without it are
// left out.
Status set_target(const ImportArguments& options, Session& session, ImportOptions& out) {
  const fs::path path = target_path(options);
  Target target;
  out.board_is_certain = !path.empty();
  if (out.board_is_certain) {
    const auto file = read_target(path);
    if (!file) return file.error();
    warn_all(file->warnings, session);
    target = file->target;
  }
  out.target_yaml = to_yaml(target);
  out.board_check = make_board_check(target, session.context);
  return Done{};
}

std::string summary_of(const ImportSummary& summary, const std::string& output) {
  const std::size_t scenes = summary.scene_count();
  return std::to_string(scenes) + (scenes == 1 ? " scene" : " scenes") + " of " +
         std::to_string(summary.stretches.size()) + " still stretches in " +
         [&] {
           char text[40];
           std::snprintf(text, sizeof text, "%.1f s", summary.length_s);
           return std::string(text);
         }() +
         " -> " + output;
}

void tell_stretches(const ImportSummary& summary, const Session& session) {
  for (const ImportedStretch& s : summary.stretches) {
    char text[160];
    std::snprintf(text, sizeof text, "%8.1f s to %8.1f s: ", s.first_s, s.last_s);
    Message line = Message::verbatim(text);
    if (s.taken) {
      line += Message("scene %1, %2 sweeps, %3 points, image at %4 s", s.scene, s.sweeps, s.points,
                      formatted("%.2f", s.image_s));
    } else {
      line += Message("left: %1", s.reason);
    }
    session.note(line);
  }
}

// Pairs of files in folders, instead of a recording.
Result<PairedFiles> pairs_of(const ImportArguments& options, const Session& session) {
  PairOptions pairs;
  pairs.images = options.recording;
  pairs.clouds = options.clouds;
  pairs.rule = options.match == "name"   ? PairRule::kName
               : options.match == "time" ? PairRule::kTime
                                         : PairRule::kAuto;
  pairs.most_apart_s = options.most_apart_s;
  pairs.image_time_offset_s = options.import.image_time_offset_s;
  auto found = find_pairs(pairs);
  if (!found) return found;
  for (const UnmatchedFile& file : found->unmatched) session.note(file.sentence());
  return found;
}

std::vector<std::string> list_pairs(const PairedFiles& files) {
  std::vector<std::string> out{
      std::to_string(files.pairs.size()) + " pairs, " + name_of(files.layout) +
      ", camera: " + (files.camera ? files.camera_from : std::string("none"))};
  for (const FilePair& pair : files.pairs) {
    char apart[40] = "";
    if (pair.apart_s) std::snprintf(apart, sizeof apart, "  %+.1f ms", 1e3 * *pair.apart_s);
    out.push_back(pair.name + "  " + pair.image.string() + "  " + pair.cloud.string() + apart);
  }
  return out;
}

Result<std::string> import_files(const ImportArguments& options, Session& session) {
  const auto files = pairs_of(options, session);
  if (!files) return files.error();
  if (options.list) {
    warn_all(files->warnings, session);
    return print_all_but_last(list_pairs(*files), session);
  }
  ImportOptions described = options.import;
  if (Status s = set_target(options, session, described); !s) return s.error();
  PairImportOptions import;
  import.target_yaml = described.target_yaml;
  import.board_check = described.board_check;
  import.board_is_certain = described.board_is_certain;
  import.force = options.import.force;
  if (!options.camera.empty()) {
    const auto camera = read_camera(options.camera);
    if (!camera) return camera.error();
    warn_all(camera->warnings, session);
    import.camera = camera->camera;
  }
  const auto summary = import_pairs(*files, import, options.output, session.context);
  if (!summary) return summary.error();
  for (const ImportedPair& pair : summary->pairs) {
    session.note(
        Message("%1: %2", pair.files.name,
                pair.taken ? Message("%1 points", pair.points) : Message("left: %1", pair.reason)));
  }
  warn_all(summary->warnings, session);
  return std::to_string(summary->scene_count()) + " scenes of " +
         std::to_string(summary->pairs.size()) + " pairs (" + name_of(summary->layout) + ") -> " +
         options.output;
}

Result<std::string> run(const ImportArguments& options, Session& session) {
  if (!options.list && options.output.empty()) {
    return Error::usage(Message("-o,--output is missing"), "import",
                        Message("give a folder for the dataset, or --list to look only"));
  }
  if (!options.clouds.empty() || looks_like_file_pairs(options.recording))
    return import_files(options, session);
  const auto recording = Recording::open(options.recording, session.context);
  if (!recording) return recording.error();
  warn_all(recording->warnings(), session);
  if (options.list) return list(*recording, session);

  ImportOptions import = options.import;
  auto times = scene_times(options.scenes);
  if (!times) return times.error();
  import.scene_times_s = std::move(*times);
  if (!options.camera.empty()) {
    const auto camera = read_camera(options.camera);
    if (!camera) return camera.error();
    warn_all(camera->warnings, session);
    import.camera = camera->camera;
  }
  if (Status s = set_target(options, session, import); !s) return s.error();
  const auto summary = import_recording(*recording, import, options.output, session.context);
  if (!summary) return summary.error();
  tell_stretches(*summary, session);
  warn_all(summary->warnings, session);
  return summary_of(*summary, options.output);
}

}  // namespace

Command add_import_command(CLI::App& app) {
  auto options = std::make_shared<ImportArguments>();
  ImportOptions& import = options->import;
  CLI::App* command = app.add_subcommand(
      "import",
      "Make a dataset of a recording (ROS 1 bag, rosbag2, MCAP) or of folders of "
      "images and clouds");
  command
      ->add_option("RECORDING", options->recording,
                   "a .bag, .db3 or .mcap file, or a rosbag2 folder; or a folder of images and "
                   "clouds, also of KITTI raw, cam_lidar_calibration, "
                   "direct_visual_lidar_calibration and FAST-Calib")
      ->required();
  command->add_option("--clouds", options->clouds,
                      "folder of the clouds, where it is another one than that of the images");
  command
      ->add_option("--match", options->match,
                   "images and clouds belong together by their name, or by the time that is their "
                   "name; auto: by name where names agree")
      ->check(CLI::IsMember({"auto", "name", "time"}))
      ->capture_default_str();
  command
      ->add_option("--most-apart", options->most_apart_s,
                   "matched by time, no further apart than this, s (0: half of the usual time "
                   "between two files)")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command->add_option("-o,--output", options->output,
                      "folder of the dataset; import.json in it says what became of each stretch");
  command->add_flag("--list", options->list,
                    "only show the topics, and what could stand in the way");
  command->add_option("--image-topic", import.topics.image,
                      "images (default: the only topic of images)");
  command->add_option("--cloud-topic", import.topics.cloud,
                      "clouds (default: the only topic of clouds)");
  command->add_option("--info-topic", import.topics.info,
                      "CameraInfo (default: that of the images' camera)");
  command
      ->add_option("--scenes", options->scenes,
                   "auto: every stretch in which rig and board stand still; or times of scenes, "
                   "s from the first message: 4.5,12,20")
      ->capture_default_str();
  command->add_option("--target", options->target,
                      "target.yaml of the board; stretches without it in their image are left out");
  command->add_option("--camera", options->camera, "camera.yaml to use instead of CameraInfo");
  command
      ->add_option("--min-still", import.still.min_still_s,
                   "shortest stretch that gives a scene, s")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--max-scene", import.max_scene_s,
                   "sweeps of a scene beyond this time are left out, s")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--time-offset", import.image_time_offset_s,
                   "s to add to the images' times, where they were recorded with another clock")
      ->check(CLI::Range(-1e9, 1e9));
  command->add_flag("--force", import.force, "replace an earlier import");
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
