// SPDX-License-Identifier: BSD-3-Clause
#include "recording/survey.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "recording/messages.h"

namespace lvcalib {
namespace {

double seconds_from_start(const Recording& recording, std::int64_t time_ns) {
  return 1e-9 * static_cast<double>(time_ns - recording.span().first_ns);
}

// A stretch that may become a scene if somebody wants it to.
bool is_usable(const StillStretch& stretch) {
  return stretch.verdict == StretchVerdict::kTaken || stretch.verdict == StretchVerdict::kRepeat ||
         stretch.verdict == StretchVerdict::kNotAsked;
}

// Edges that the user has moved take the place of those that were found.
Status move_edges(const Recording& recording, const RecordingSurvey& survey,
                  const ImportOptions& options, std::vector<StillStretch>& stretches) {
  const auto as_time = [&](double seconds) {
    return recording.span().first_ns + static_cast<std::int64_t>(std::llround(1e9 * seconds));
  };
  const std::vector<StillStretch> found = stretches;
  for (const MovedEdges& edges : options.moved_edges) {
    const std::int64_t inside = as_time(edges.found_s);
    const auto place = std::find_if(found.begin(), found.end(), [&](const StillStretch& s) {
      return s.first_ns <= inside && inside <= s.last_ns;
    });
    if (place == found.end()) continue;
    set_edges(stretches[static_cast<std::size_t>(place - found.begin())], as_time(edges.first_s),
              as_time(edges.last_s), survey.images, survey.clouds, options.still);
  }
  // Two scenes may not share messages. Edges are meant to the millisecond.
  constexpr std::int64_t tolerance_ns = 1'000'000;
  const auto seconds = [&](std::int64_t t) {
    return formatted("%.2f", seconds_from_start(recording, t));
  };
  for (const StillStretch& s : stretches) {
    if (!s.by_hand || !is_usable(s)) continue;
    for (const StillStretch& other : stretches) {
      if (&other == &s || !is_usable(other)) continue;
      if (other.last_ns < s.first_ns + tolerance_ns) continue;
      if (s.last_ns < other.first_ns + tolerance_ns) continue;
      return Error::usage(
          Message("the stretch moved to %1 s to %2 s overlaps that from %3 s to %4 s",
                  seconds(s.first_ns), seconds(s.last_ns), seconds(other.first_ns),
                  seconds(other.last_ns)),
          recording.path().string(), Message("move its edges so that both stay apart"));
    }
  }
  return Done{};
}

class Surveyor {
 public:
  Surveyor(const Recording& recording, TopicChoice topics, const RunContext& context)
      : recording_(recording), topics_(topics), context_(context) {}
  Result<RecordingSurvey> survey(const ImportOptions& options);

 private:
  [[nodiscard]] const Topic& image_topic() const { return recording_.topics()[topics_.image]; }
  [[nodiscard]] const Topic& cloud_topic() const { return recording_.topics()[topics_.cloud]; }
  void take_image(const RecordedMessage& message, RecordingSurvey& out);
  void take_cloud(const RecordedMessage& message, RecordingSurvey& out);

  const Recording& recording_;
  TopicChoice topics_;
  const RunContext& context_;
  std::size_t bad_images_ = 0;
  std::size_t bad_clouds_ = 0;
  Message first_image_complaint_;
  Message first_cloud_complaint_;
};

void Surveyor::take_image(const RecordedMessage& message, RecordingSurvey& out) {
  const std::int64_t time = message.time_ns + out.image_offset_ns;
  if (!out.images.wants(time)) return;
  const auto image = decode_image(image_topic(), message.data);
  auto look = image ? look_at_image(*image, image_topic().name) : Result<ImageLook>(image.error());
  if (!look) {
    if (bad_images_++ == 0) first_image_complaint_ = look.error().sentence();
    return;
  }
  if (out.images.size() > 0 && (out.images.look(0).width_px != look->width_px ||
                                out.images.look(0).height_px != look->height_px)) {
    out.sizes_change = true;
  }
  const std::size_t bytes = sizeof(ImageLook) + 2 * look->cells.size();
  out.images.add(time, std::move(*look), bytes);
}

void Surveyor::take_cloud(const RecordedMessage& message, RecordingSurvey& out) {
  if (!out.clouds.wants(message.time_ns)) return;
  const auto cloud = decode_cloud(cloud_topic(), message.data);
  if (!cloud) {
    if (bad_clouds_++ == 0) first_cloud_complaint_ = cloud.error().sentence();
    return;
  }
  out.intensity = out.intensity && cloud->cloud.has_intensity();
  CloudLook look = look_at_cloud(cloud->cloud);
  const std::size_t bytes = sizeof(CloudLook) + sizeof(CloudLook::Cell) * look.cells.size();
  out.clouds.add(message.time_ns, std::move(look), bytes);
}

Result<RecordingSurvey> Surveyor::survey(const ImportOptions& options) {
  RecordingSurvey out(options.still);
  out.topics = topics_;
  out.image_offset_ns = static_cast<std::int64_t>(std::llround(1e9 * options.image_time_offset_s));
  std::vector<std::size_t> topics = {topics_.image, topics_.cloud};
  if (topics_.info) topics.push_back(*topics_.info);
  auto warnings = recording_.read(
      topics, {}, context_, "look", [&](const RecordedMessage& message) -> Result<bool> {
        if (message.topic == topics_.image) take_image(message, out);
        if (message.topic == topics_.cloud) take_cloud(message, out);
        if (topics_.info && message.topic == *topics_.info && !out.camera) {
          auto info = decode_camera_info(recording_.topics()[message.topic], message.data,
                                         topics_.rectified);
          if (info) {
            out.camera = info->camera;
          } else if (out.camera_complaint.empty()) {
            out.camera_complaint = info.error().sentence();
          }
        }
        return true;
      });
  if (!warnings) return warnings.error();
  out.warnings = std::move(*warnings);
  if (out.images.size() == 0) {
    return Error::input(Message("none of its images can be read: %1", first_image_complaint_),
                        recording_.path().string());
  }
  if (out.clouds.size() == 0) {
    return Error::input(Message("none of its clouds can be read: %1", first_cloud_complaint_),
                        recording_.path().string());
  }
  const auto warn_of_bad = [&](std::size_t bad, const Topic& topic, const Message& first) {
    if (bad == 0) return;
    out.warnings.push_back(
        Message("%1: %2 messages cannot be read and are left out, the first because: %3",
                topic.name, bad, first));
  };
  warn_of_bad(bad_images_, image_topic(), first_image_complaint_);
  warn_of_bad(bad_clouds_, cloud_topic(), first_cloud_complaint_);
  return out;
}

}  // namespace

Result<RecordingSurvey> survey_recording(const Recording& recording, const ImportOptions& options,
                                         const RunContext& context) {
  const auto topics = choose_topics(recording, options.topics);
  if (!topics) return topics.error();
  return Surveyor(recording, *topics, context).survey(options);
}

Result<std::vector<StillStretch>> choose_stretches(const Recording& recording,
                                                   const RecordingSurvey& survey,
                                                   const ImportOptions& options) {
  auto stretches = find_still_stretches(survey.images, survey.clouds, options.still);
  if (Status s = move_edges(recording, survey, options, stretches); !s) return s.error();
  if (options.scene_times_s.empty()) return stretches;
  std::vector<char> asked(stretches.size(), 0);
  for (const double time_s : options.scene_times_s) {
    const auto holds = [&](const StillStretch& s) {
      return is_usable(s) && seconds_from_start(recording, s.first_ns) <= time_s &&
             time_s <= seconds_from_start(recording, s.last_ns);
    };
    const auto found = std::find_if(stretches.begin(), stretches.end(), holds);
    if (found == stretches.end()) {
      return Error::input(Message("nothing stands still at %1 s", formatted("%.2f", time_s)),
                          recording.path().string(),
                          Message("times count from the first message; without --scenes all still "
                                  "stretches are found"));
    }
    asked[static_cast<std::size_t>(found - stretches.begin())] = 1;
  }
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    StretchVerdict& verdict = stretches[i].verdict;
    if (asked[i] != 0) {
      verdict = StretchVerdict::kTaken;
    } else if (is_usable(stretches[i])) {
      verdict = StretchVerdict::kNotAsked;
    }
  }
  return stretches;
}

ImportedStretch describe_stretch(const Recording& recording, const RecordingSurvey& survey,
                                 const std::vector<StillStretch>& stretches, std::size_t index,
                                 const ImportOptions& options) {
  const StillStretch& stretch = stretches[index];
  // A stretch reaches half a sample beyond its first and last one; the recording does not.
  const auto seconds = [&](std::int64_t t) {
    return std::clamp(seconds_from_start(recording, t), 0.0,
                      seconds_from_start(recording, recording.span().last_ns));
  };
  ImportedStretch out;
  out.first_s = seconds(stretch.first_ns);
  out.last_s = seconds(stretch.last_ns);
  out.by_hand = stretch.by_hand;
  out.found_first_s = seconds(stretch.found_first_ns);
  out.found_last_s = seconds(stretch.found_last_ns);
  out.images = stretch.last_image - stretch.first_image + 1;
  out.image_s = seconds(survey.images.time_ns(stretch.sharpest_image));
  out.image_ns = survey.images.time_ns(stretch.sharpest_image) - survey.image_offset_ns;
  out.taken = stretch.verdict == StretchVerdict::kTaken;
  out.usable = is_usable(stretch);
  const std::string length = formatted("%.1f", stretch.length_s());
  switch (stretch.verdict) {
    case StretchVerdict::kTaken:
      out.reason = stretch.by_hand ? Message("its edges were set by hand: %1 s", length)
                                   : Message("rig and board stand still for %1 s", length);
      break;
    case StretchVerdict::kTooShort:
      out.reason = Message("stands still for %1 s only; %2 s are needed", length,
                           formatted("%.1f", options.still.min_still_s));
      break;
    case StretchVerdict::kNoImage:
      out.reason = Message("no image was taken in this time");
      break;
    case StretchVerdict::kNoCloud:
      out.reason = Message("no sweep was recorded in this time");
      break;
    case StretchVerdict::kCloudMoves:
      out.reason = Message("the images stand still, but the clouds change meanwhile");
      break;
    case StretchVerdict::kRepeat: {
      const StillStretch& other = stretches[stretch.repeat_of];
      out.reason = Message("the same pose as from %1 s to %2 s, which is kept",
                           formatted("%.1f", seconds(other.first_ns)),
                           formatted("%.1f", seconds(other.last_ns)));
      break;
    }
    case StretchVerdict::kNotAsked:
      out.reason = Message("stands still, but was left out by its time");
      break;
  }
  return out;
}

Result<std::vector<ImportedStretch>> preview_stretches(const Recording& recording,
                                                       const RecordingSurvey& survey,
                                                       const ImportOptions& options) {
  const auto stretches = choose_stretches(recording, survey, options);
  if (!stretches) return stretches.error();
  std::vector<ImportedStretch> out;
  for (std::size_t i = 0; i < stretches->size(); ++i) {
    out.push_back(describe_stretch(recording, survey, *stretches, i, options));
    out.back().sweeps = (*stretches)[i].last_cloud - (*stretches)[i].first_cloud + 1;
  }
  return out;
}

namespace {

// Half a shortest stretch to either side: a view that stands still agrees with one of both, however
// slowly it was carried there.
template <class Look, class Motion>
std::vector<MotionSample> motion_of(const Track<Look>& track, const Recording& recording,
                                    const StillOptions& options, const Motion& motion) {
  std::vector<MotionSample> out;
  if (track.size() < 2) return out;
  const double period_s = std::max(1e-3, 1e-9 * static_cast<double>(track.period_ns()));
  const double reach = std::max(1.0, std::round(0.5 * options.min_still_s / period_s));
  const std::size_t step = std::min(track.size() - 1, static_cast<std::size_t>(reach));
  std::vector<double> over(track.size() - step);
  for (std::size_t i = 0; i < over.size(); ++i) over[i] = motion(i, i + step);
  for (std::size_t i = 0; i < track.size(); ++i) {
    const bool has_before = i >= step;
    const bool has_after = i < over.size();
    const double before = has_before ? over[i - step] : over[std::min(i, over.size() - 1)];
    const double after = has_after ? over[i] : before;
    out.push_back({seconds_from_start(recording, track.time_ns(i)), std::min(before, after)});
  }
  return out;
}

}  // namespace

RecordedMotion motion_over_time(const Recording& recording, const RecordingSurvey& survey,
                                const StillOptions& options) {
  const ImageComparison comparison(survey.images);
  return {motion_of(survey.images, recording, options,
                    [&](std::size_t a, std::size_t b) {
                      return comparison.motion(a, b, options.still_px);
                    }),
          motion_of(survey.clouds, recording, options, [&](std::size_t a, std::size_t b) {
            return motion(survey.clouds.look(a), survey.clouds.look(b));
          })};
}

std::vector<Message> warnings_of(const Recording& recording, const RecordingSurvey& survey,
                                 const ImportOptions& options) {
  const auto name = [&](std::size_t topic) { return recording.topics()[topic].name; };
  const std::string image_topic = name(survey.topics.image);
  const std::string cloud_topic = name(survey.topics.cloud);
  const std::string info_topic = survey.topics.info ? name(*survey.topics.info) : std::string{};
  std::vector<Message> out = survey.warnings;
  if (!survey.intensity) {
    out.push_back(Message(
        "%1: clouds have no intensity; the calibration will rest on planes and corners alone",
        cloud_topic));
  }
  if (survey.sizes_change) {
    out.push_back(
        Message("%1: its images change their size; calibrate takes those of the camera's size",
                image_topic));
  }
  if (options.camera) return out;
  if (!survey.camera) {
    if (!survey.topics.info) {
      out.push_back(
          Message("no CameraInfo was recorded for %1; put a camera.yaml into the dataset before it "
                  "is calibrated",
                  image_topic));
      return out;
    }
    out.push_back(Message("%1; put a camera.yaml into the dataset before it is calibrated",
                          survey.camera_complaint.empty()
                              ? Message("%1: holds no intrinsics", info_topic)
                              : Message("%1: %2", info_topic, survey.camera_complaint)));
    return out;
  }
  const ImageLook& image = survey.images.look(0);
  if (image.width_px != survey.camera->width_px || image.height_px != survey.camera->height_px) {
    out.push_back(Message("%1: is of images of %2 × %3 px, but they have %4 × %5", info_topic,
                          survey.camera->width_px, survey.camera->height_px, image.width_px,
                          image.height_px));
  }
  if (survey.topics.rectified) {
    out.push_back(
        Message("%1: is taken for rectified; camera.yaml holds the intrinsics of rectified images, "
                "without distortion",
                image_topic));
  }
  return out;
}

Result<Thumbnail> thumbnail_at(const Recording& recording, std::size_t image_topic,
                               std::int64_t time_ns, int longest_px, const RunContext& context) {
  const Topic& topic = recording.topics()[image_topic];
  const RunContext silent = context.silent();
  Result<Thumbnail> out = Error::input(Message("there is no image at this time"), topic.name);
  TimeSpan span;
  span.first_ns = time_ns;
  const auto read =
      recording.read({image_topic}, span, silent, "scene", [&](const RecordedMessage& message) {
        const auto image = decode_image(topic, message.data);
        out = image ? make_thumbnail(*image, longest_px, topic.name)
                    : Result<Thumbnail>(image.error());
        return Result<bool>(false);
      });
  if (!read) return read.error();
  return out;
}

Result<StretchPicture> picture_of(const Recording& recording, const RecordingSurvey& survey,
                                  const ImportedStretch& stretch, int longest_px,
                                  const RunContext& context) {
  const Topic& topic = recording.topics()[survey.topics.image];
  const RunContext silent = context.silent();
  StretchPicture out;
  Status taken = Error::input(Message("its image cannot be read again"), topic.name);
  const auto take = [&](const RecordedMessage& message) -> Status {
    const auto image = decode_image(topic, message.data);
    if (!image) return image.error();
    auto small = make_thumbnail(*image, longest_px, topic.name);
    if (!small) return small.error();
    auto file = make_image_file(*image, topic.name);
    if (!file) return file.error();
    out = {std::move(*file), std::move(*small)};
    return Done{};
  };
  const auto read = recording.read({survey.topics.image}, {stretch.image_ns, stretch.image_ns},
                                   silent, "scene", [&](const RecordedMessage& message) {
                                     taken = take(message);
                                     return Result<bool>(!taken.ok());
                                   });
  if (!read) return read.error();
  if (!taken) return taken.error();
  return out;
}

}  // namespace lvcalib
