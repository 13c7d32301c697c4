// SPDX-License-Identifier: BSD-3-Clause
// Which topics of a recording an import uses, and what to know about them before.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/text.h"
#include "recording/import.h"
#include "recording/messages.h"

namespace lvcalib {
namespace {

using Indices = std::vector<std::size_t>;

// "/cam/image_raw" of "/cam/image_raw/compressed".
std::string base_name(const Topic& topic) {
  constexpr std::string_view suffix = "/compressed";
  std::string name = topic.name;
  if (topic.type == "sensor_msgs/CompressedImage" && name.ends_with(suffix)) {
    name.resize(name.size() - suffix.size());
  }
  return name;
}

// "/cam" of "/cam/image_raw".
std::string parent_of(const std::string& name) {
  const auto slash = name.rfind('/');
  return slash == std::string::npos ? std::string{} : name.substr(0, slash);
}

bool is_rectified(const Topic& topic) {
  const std::string base = base_name(topic);
  return base.substr(base.rfind('/') + 1).find("rect") != std::string::npos;
}

// Depth, masks and the like are images too, but none of a camera.
bool is_depth_name(const Topic& topic) {
  return topic.name.ends_with("/compressedDepth") ||
         topic.name.find("/depth/") != std::string::npos ||
         topic.name.find("aligned_depth") != std::string::npos;
}

Indices topics_of(const Recording& recording, MessageKind kind) {
  Indices out;
  for (std::size_t i = 0; i < recording.topics().size(); ++i) {
    const Topic& topic = recording.topics()[i];
    if (topic.count > 0 && message_kind(topic.type) == kind && readable_encoding(topic.encoding)) {
      out.push_back(i);
    }
  }
  return out;
}

std::string names_of(const Recording& recording, const Indices& indices) {
  std::vector<std::string> names;
  for (const std::size_t i : indices) names.push_back(recording.topics()[i].name);
  return joined(names, ", ");
}

bool holds_messages(const Recording& recording) {
  return std::any_of(recording.topics().begin(), recording.topics().end(),
                     [](const Topic& topic) { return topic.count > 0; });
}

Error not_recorded(const Recording& recording, MessageKind kind) {
  if (!holds_messages(recording)) {
    return Error::input(Message("holds no messages"), recording.path().string());
  }
  const bool images = kind == MessageKind::kImage;
  const MessageKind raw = images ? MessageKind::kRawVideo : MessageKind::kRawPackets;
  const std::string where = recording.path().string();
  for (const Topic& topic : recording.topics()) {
    if (topic.count > 0 && message_kind(topic.type) == raw) {
      return Error::input(
          Message("holds no %1 but raw packets: %2", images ? Message("images") : Message("clouds"),
                  topic.name + " (" + topic.type + ")"),
          where, Message("play it through %1 and record what comes out", converter_of(topic.type)));
    }
  }
  for (const Topic& topic : recording.topics()) {
    if (topic.count > 0 && message_kind(topic.type) == kind) {
      return Error::input(
          Message("the messages of %1 are serialized as '%2'; ROS 1 and CDR are read", topic.name,
                  topic.encoding.substr(0, 40)),
          where);
    }
  }
  return Error::input(images
                          ? Message("holds no images (sensor_msgs/Image or CompressedImage)")
                          : Message("holds no clouds (sensor_msgs/PointCloud2 or Livox CustomMsg)"),
                      where);
}

Result<std::size_t> by_name(const Recording& recording, const std::string& name, MessageKind kind,
                            const char* option) {
  bool recorded = false;
  for (std::size_t i = 0; i < recording.topics().size(); ++i) {
    const Topic& topic = recording.topics()[i];
    if (topic.name != name && topic.name != "/" + name) continue;
    recorded = true;
    if (message_kind(topic.type) != kind || !readable_encoding(topic.encoding)) continue;
    if (topic.count > 0) return i;
    return Error::input(Message("topic '%1' holds no messages", name), recording.path().string());
  }
  const Indices fitting = topics_of(recording, kind);
  const std::string shown = name.substr(0, 200);
  Message what = recorded ? Message("topic '%1' is of another type", shown)
                          : Message("topic '%1' was not recorded", shown);
  if (!fitting.empty()) what += Message("; there is %1", names_of(recording, fitting));
  return Error::usage(what, option, Message("lvcalib import --list shows all topics"));
}

// The only topic of a kind. A camera that was recorded twice, raw and compressed, is one: raw.
Result<std::size_t> the_only(const Recording& recording, MessageKind kind, const char* option) {
  Indices found = topics_of(recording, kind);
  if (found.empty()) return not_recorded(recording, kind);
  const auto topic = [&](std::size_t i) -> const Topic& { return recording.topics()[i]; };
  if (kind == MessageKind::kImage) {
    const Indices all = found;
    std::erase_if(found, [&](std::size_t i) {
      return is_depth_name(topic(i)) || std::any_of(all.begin(), all.end(), [&](std::size_t k) {
               return k != i && topic(k).name == base_name(topic(i)) &&
                      topic(i).type == "sensor_msgs/CompressedImage";
             });
    });
    if (found.empty()) found = all;
  }
  if (found.size() == 1) return found.front();
  return Error::usage(
      kind == MessageKind::kImage
          ? Message("%1 topics hold images: %2", found.size(), names_of(recording, found))
          : Message("%1 topics hold clouds: %2", found.size(), names_of(recording, found)),
      recording.path().string(), Message("choose one with %1", option));
}

// CameraInfo of the images' own name space; of a recording with one camera, its only one.
std::optional<std::size_t> matching_info(const Recording& recording, const Topic& image) {
  const Indices infos = topics_of(recording, MessageKind::kCameraInfo);
  for (const std::size_t i : infos) {
    if (parent_of(recording.topics()[i].name) == parent_of(base_name(image))) return i;
  }
  std::vector<std::string> cameras;
  for (const std::size_t i : topics_of(recording, MessageKind::kImage)) {
    cameras.push_back(parent_of(base_name(recording.topics()[i])));
  }
  std::sort(cameras.begin(), cameras.end());
  cameras.erase(std::unique(cameras.begin(), cameras.end()), cameras.end());
  if (infos.size() == 1 && cameras.size() == 1) return infos.front();
  return std::nullopt;
}

// Raw before compressed, anything before depth.
int unlikeliness(const Topic& topic) {
  return (is_depth_name(topic) ? 2 : 0) + (topic.type == "sensor_msgs/CompressedImage" ? 1 : 0);
}

std::string seconds_text(double seconds) {
  return formatted(std::abs(seconds) < 100.0 ? "%.2f s" : "%.0f s", seconds);
}

// What the first message of a topic tells: the sender's clock, and whether it can be read.
struct FirstMessage {
  std::optional<double> clock_ahead_s;  // Sender's stamp minus the recorder's time.
  Message complaint;
  bool intensity = true;
};

Result<FirstMessage> look_at_first(const Recording& recording, std::size_t index,
                                   const RunContext& context) {
  FirstMessage out;
  const Topic& topic = recording.topics()[index];
  const RunContext silent = context.silent();
  const auto read = recording.read(
      {index}, {}, silent, "open", [&](const RecordedMessage& message) -> Result<bool> {
        if (const std::int64_t stamp = decode_stamp(topic, message.data); stamp != 0) {
          out.clock_ahead_s = 1e-9 * static_cast<double>(stamp - message.time_ns);
        }
        switch (message_kind(topic.type)) {
          case MessageKind::kCloud: {
            const auto cloud = decode_cloud(topic, message.data);
            if (!cloud) out.complaint = cloud.error().sentence();
            out.intensity = !cloud || cloud->cloud.has_intensity();
            break;
          }
          case MessageKind::kImage:
            if (const auto image = decode_image(topic, message.data); !image) {
              out.complaint = image.error().sentence();
            }
            break;
          case MessageKind::kCameraInfo:
            if (const auto info = decode_camera_info(topic, message.data, false); !info) {
              out.complaint = info.error().sentence();
            }
            break;
          default:
            break;
        }
        return false;
      });
  if (!read) return read.error();
  return out;
}

}  // namespace

Result<TopicChoice> choose_topics(const Recording& recording, const TopicNames& names) {
  TopicChoice out;
  const auto image = names.image.empty()
                         ? the_only(recording, MessageKind::kImage, "--image-topic")
                         : by_name(recording, names.image, MessageKind::kImage, "--image-topic");
  if (!image) return image.error();
  const auto cloud = names.cloud.empty()
                         ? the_only(recording, MessageKind::kCloud, "--cloud-topic")
                         : by_name(recording, names.cloud, MessageKind::kCloud, "--cloud-topic");
  if (!cloud) return cloud.error();
  out.image = *image;
  out.cloud = *cloud;
  out.rectified = is_rectified(recording.topics()[*image]);
  if (names.info.empty()) {
    out.info = matching_info(recording, recording.topics()[*image]);
  } else {
    const auto info = by_name(recording, names.info, MessageKind::kCameraInfo, "--info-topic");
    if (!info) return info.error();
    out.info = *info;
  }
  return out;
}

TopicCandidates list_candidates(const Recording& recording) {
  TopicCandidates out{topics_of(recording, MessageKind::kImage),
                      topics_of(recording, MessageKind::kCloud),
                      topics_of(recording, MessageKind::kCameraInfo)};
  std::stable_sort(out.images.begin(), out.images.end(), [&](std::size_t a, std::size_t b) {
    return unlikeliness(recording.topics()[a]) < unlikeliness(recording.topics()[b]);
  });
  return out;
}

Result<std::vector<Message>> check_recording(const Recording& recording,
                                             const RunContext& context) {
  std::vector<Message> out;
  if (!holds_messages(recording)) {
    out.push_back(Message("%1: holds no messages", recording.path().string()));
    return out;
  }
  const Indices images = topics_of(recording, MessageKind::kImage);
  const Indices clouds = topics_of(recording, MessageKind::kCloud);
  const Indices infos = topics_of(recording, MessageKind::kCameraInfo);
  if (images.empty()) out.push_back(not_recorded(recording, MessageKind::kImage).sentence());
  if (clouds.empty()) out.push_back(not_recorded(recording, MessageKind::kCloud).sentence());
  if (infos.empty()) {
    out.push_back(
        Message("no CameraInfo was recorded; give a camera file (--camera) for the intrinsics"));
  }
  std::optional<double> image_clock;
  std::optional<double> cloud_clock;
  for (const Indices* group : {&images, &clouds, &infos}) {
    for (const std::size_t i : *group) {
      const Topic& topic = recording.topics()[i];
      const auto first = look_at_first(recording, i, context);
      if (!first) return first.error();
      if (!first->complaint.empty()) out.push_back(first->complaint);
      if (!first->intensity) {
        out.push_back(Message(
            "%1: clouds have no intensity; the calibration will rest on planes and corners alone",
            topic.name));
      }
      if (group != &infos && topic.count < 3) {
        out.push_back(topic.count == 1 ? Message("%1: %2 message only", topic.name, topic.count)
                                       : Message("%1: %2 messages only", topic.name, topic.count));
      } else if (group != &infos && topic.rate_hz() < 1.0) {
        out.push_back(Message("%1: %2 messages a second; motion between them cannot be seen",
                              topic.name, formatted("%.2f", topic.rate_hz())));
      }
      if (group == &images && !image_clock) image_clock = first->clock_ahead_s;
      if (group == &clouds && !cloud_clock) cloud_clock = first->clock_ahead_s;
    }
  }
  // Within half a second it is what messages take to arrive.
  if (image_clock && cloud_clock && std::abs(*image_clock - *cloud_clock) > 0.5) {
    out.push_back(
        Message("the clocks of camera and LiDAR differ by %1; the times at which messages were "
                "recorded are used instead",
                seconds_text(*image_clock - *cloud_clock)));
  }
  if (images.size() == 1 && clouds.size() == 1) {
    const Topic& a = recording.topics()[images.front()];
    const Topic& b = recording.topics()[clouds.front()];
    if (a.first_ns > b.last_ns || b.first_ns > a.last_ns) {
      out.push_back(Message("images and clouds were never recorded at the same time"));
    }
  }
  return out;
}

}  // namespace lvcalib
