// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "recording/import.h"
#include "recording/pixels.h"
#include "recording/recording.h"
#include "recording/still_stretches.h"

namespace lvcalib {

/// What one pass over a recording shows: how the views of both sensors change, and the camera's
/// intrinsics. It answers for the topics, the sample rate and the time offset that it was made
/// with.
struct RecordingSurvey {
  explicit RecordingSurvey(const StillOptions& options)
      : images(make_image_track(options)), clouds(make_cloud_track(options)) {}
  TopicChoice topics;
  std::int64_t image_offset_ns = 0;  ///< Added to the times of images.
  ImageTrack images;
  CloudTrack clouds;
  std::optional<Camera> camera;  ///< From CameraInfo.
  Message camera_complaint;
  bool intensity = true;
  bool sizes_change = false;
  std::vector<Message> warnings;
};

/// Looks at both sensors, and for the camera's intrinsics. Errors: those of choose_topics(); no
/// image or no cloud can be read; a stop.
Result<RecordingSurvey> survey_recording(const Recording& recording, const ImportOptions& options,
                                         const RunContext& context);

/// The still stretches; with times of scenes given, only those that hold one are taken. Errors: a
/// time asked for at which something moves; edges moved by hand that overlap another stretch.
Result<std::vector<StillStretch>> choose_stretches(const Recording& recording,
                                                   const RecordingSurvey& survey,
                                                   const ImportOptions& options);

/// Stretch `index` in words, as it is before its scene is written.
ImportedStretch describe_stretch(const Recording& recording, const RecordingSurvey& survey,
                                 const std::vector<StillStretch>& stretches, std::size_t index,
                                 const ImportOptions& options);

/// What import_recording() would make scenes of, without writing anything. Errors as
/// choose_stretches().
Result<std::vector<ImportedStretch>> preview_stretches(const Recording& recording,
                                                       const RecordingSurvey& survey,
                                                       const ImportOptions& options);

/// What to know about an import with these options: messages left out, no intensity, intrinsics
/// that are missing or of other images.
std::vector<Message> warnings_of(const Recording& recording, const RecordingSurvey& survey,
                                 const ImportOptions& options);

/// How much a sensor's view differs from what it was half a shortest stretch before, or will be
/// after, whichever is less; in units of what is no motion yet: below 1 it stands still.
struct MotionSample {
  double time_s = 0.0;  ///< From the recording's first message.
  double motion = 0.0;
};
struct RecordedMotion {
  std::vector<MotionSample> image;
  std::vector<MotionSample> cloud;
};
RecordedMotion motion_over_time(const Recording& recording, const RecordingSurvey& survey,
                                const StillOptions& options);

/// A stretch's sharpest image: as the file that its scene gets, and small.
struct StretchPicture {
  ImageFile file;
  Thumbnail thumbnail;
};
/// The thumbnail is at most `longest_px` on a side. Errors: it cannot be read again; a stop.
Result<StretchPicture> picture_of(const Recording& recording, const RecordingSurvey& survey,
                                  const ImportedStretch& stretch, int longest_px,
                                  const RunContext& context);

/// The first image of a topic from a time on (recorder's clock), small: a glimpse of what a
/// recording shows before anything else of it is read. Errors: there is none, or it cannot be read;
/// a stop.
Result<Thumbnail> thumbnail_at(const Recording& recording, std::size_t image_topic,
                               std::int64_t time_ns, int longest_px, const RunContext& context);

}  // namespace lvcalib
