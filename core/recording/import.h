// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "recording/recording.h"
#include "recording/still_stretches.h"

namespace lvcalib {

struct RecordingSurvey;

/// Which topics to use; empty: the only one that fits.
struct TopicNames {
  std::string image;
  std::string cloud;
  std::string info;
};

/// The topics that an import uses; indices into Recording::topics().
struct TopicChoice {
  std::size_t image = 0;
  std::size_t cloud = 0;
  std::optional<std::size_t> info;  ///< Absent if no CameraInfo belongs to the images.
  bool rectified = false;           ///< The images are rectified: P holds their intrinsics.
};

/// Chooses topics. Errors (kUsage): a name that is not recorded, of another type, or several to
/// choose from; (kInput): no images or no clouds, naming what converts raw packets.
Result<TopicChoice> choose_topics(const Recording& recording, const TopicNames& names);

/// Topics that an import could use, the likeliest first; indices into Recording::topics(). Depth
/// images come last, and a camera's compressed images after its raw ones.
struct TopicCandidates {
  std::vector<std::size_t> images;
  std::vector<std::size_t> clouds;
  std::vector<std::size_t> infos;
};
TopicCandidates list_candidates(const Recording& recording);

/// What to know about a recording before it is imported: missing or unreadable topics, clouds
/// without intensity, clocks that differ, low rates, sensors that never ran together. Reads the
/// first message of the topics concerned.
Result<std::vector<Message>> check_recording(const Recording& recording, const RunContext& context);

/// Edges that a still stretch is given by hand. Times in s from the recording's first message.
struct MovedEdges {
  double found_s = 0.0;  ///< A time within the stretch as it was found.
  double first_s = 0.0;
  double last_s = 0.0;
};

struct ImportOptions {
  TopicNames topics;
  StillOptions still;
  /// Sweeps of a scene beyond this time are left out.
  double max_scene_s = 10.0;
  /// Added to the times of images, where the sensors' messages were recorded with different clocks.
  double image_time_offset_s = 0.0;
  /// Times of scenes, s from the recording's first message; empty: all still stretches.
  std::vector<double> scene_times_s;
  /// Stretches with other edges than found; scene_times_s are times within the moved edges. Edges
  /// of what is no stretch (with another least length there may be others) are left out.
  std::vector<MovedEdges> moved_edges;
  std::string target_yaml;       ///< Content of the dataset's target.yaml.
  std::optional<Camera> camera;  ///< Instead of CameraInfo.
  /// Says why the board cannot be seen in an image (a file of the dataset); empty: it can. Not
  /// asked without intrinsics.
  std::function<Message(const std::filesystem::path& image, const Camera& camera)> board_check;
  /// False if the board is a guess: stretches without it are left only if others show it.
  bool board_is_certain = true;
  bool force = false;  ///< Replace an earlier import.
};

/// One still stretch and what became of it. Times in s from the recording's first message.
struct ImportedStretch {
  double first_s = 0.0;
  double last_s = 0.0;
  bool taken = false;
  bool by_hand = false;  ///< first_s and last_s were moved by hand; the found ones are below.
  double found_first_s = 0.0;
  double found_last_s = 0.0;
  bool usable = false;  ///< Is a scene if its time is asked for, unless its files say otherwise.
  std::string scene;    ///< Name of the scene, if taken.
  Message reason;       ///< In words, why it was taken or left.
  double image_s = 0.0;
  std::int64_t image_ns = 0;  ///< The image's time in the recording.
  std::size_t images = 0;     ///< To choose from.
  std::size_t sweeps = 0;
  std::size_t points = 0;
  std::vector<Message> cloud_warnings;  ///< Why a sweep of it may not be whole; of the first such.
  Message board_complaint;  ///< Why a scene that was taken does not show the guessed board.
};

struct ImportSummary {
  std::string image_topic, cloud_topic, info_topic;
  double length_s = 0.0;
  bool has_camera = false;                 ///< The dataset has a camera.yaml.
  std::vector<ImportedStretch> stretches;  ///< In the order of time.
  std::vector<Message> warnings;
  [[nodiscard]] std::size_t scene_count() const;
};

/// Makes a dataset folder of a recording: finds the stretches in which nothing moves, and writes
/// for each its sharpest image and its sweeps as one cloud, target.yaml, camera.yaml (from
/// CameraInfo, if there is any) and import.json, which says for every stretch why it was taken or
/// left. Two passes over the recording; memory holds one scene. DATASET takes its name only when
/// all of it is written.
/// Errors: those of choose_topics(); DATASET exists; no stretch that can be used (naming why); a
/// time asked for at which something moves; edges that overlap; a stop.
Result<ImportSummary> import_recording(const Recording& recording, const ImportOptions& options,
                                       const std::filesystem::path& dataset,
                                       const RunContext& context);

/// The second pass alone, after survey_recording() with the same recording, topics and time offset.
Result<ImportSummary> import_recording(const Recording& recording, const RecordingSurvey& survey,
                                       const ImportOptions& options,
                                       const std::filesystem::path& dataset,
                                       const RunContext& context);

}  // namespace lvcalib
