// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/recording_work.h"

#include <utility>

#include "pipeline/board_check.h"

namespace lvcalib::widgets {
namespace {

Result<OpenedRecording> opened_recording(const std::filesystem::path& path,
                                         const RunContext& context) {
  auto recording = Recording::open(path, context);
  if (!recording) return recording.error();
  OpenedRecording out;
  out.recording = std::make_shared<const Recording>(std::move(*recording));
  out.candidates = list_candidates(*out.recording);
  const auto name = [&](std::size_t i) { return out.recording->topics()[i].name; };
  for (const std::size_t image : out.candidates.images) {
    std::optional<std::size_t> info;
    if (!out.candidates.clouds.empty()) {
      const auto choice =
          choose_topics(*out.recording, {name(image), name(out.candidates.clouds.front()), {}});
      if (choice) info = choice->info;
    }
    out.info_of_images.push_back(info);
  }
  out.warnings = out.recording->warnings();
  auto complaints = check_recording(*out.recording, context);
  if (!complaints) return complaints.error();
  out.warnings.insert(out.warnings.end(), complaints->begin(), complaints->end());
  return out;
}

Result<RecordingLook> look_through(const Recording& recording, const ImportOptions& options,
                                   std::shared_ptr<const RecordingSurvey> survey,
                                   const RunContext& context) {
  if (!survey) {
    auto made = survey_recording(recording, options, context);
    if (!made) return made.error();
    survey = std::make_shared<const RecordingSurvey>(std::move(*made));
  }
  auto stretches = preview_stretches(recording, *survey, options);
  if (!stretches) return stretches.error();
  RecordingLook out{std::move(survey), std::move(*stretches), {}, {}};
  out.warnings = warnings_of(recording, *out.survey, options);
  out.motion = motion_over_time(recording, *out.survey, options.still);
  return out;
}

QImage as_image(const Thumbnail& thumbnail) {
  return QImage(thumbnail.rgb.data(), thumbnail.width_px, thumbnail.height_px,
                3 * thumbnail.width_px, QImage::Format_RGB888)
      .copy();
}

}  // namespace

RecordingWork::RecordingWork(QObject* parent) : QObject(parent) {
  connect(&runner_, &Runner::progressed, this,
          [this](quint64, const QString& stage, double fraction, const QString& text) {
            Q_EMIT progressed(stage, fraction, text);
          });
  connect(&runner_, &Runner::cancelled, this, &RecordingWork::cancelled);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Error::input(Message::verbatim(message.toStdString())));
  });
}

// A job that only makes room for the next one was not cancelled by anybody.
void RecordingWork::start(Runner::Work work) {
  pictures_.cancel();
  cancelled_ = false;
  runner_.abandon();
  runner_.start(std::move(work));
}

void RecordingWork::open(const QString& path) {
  start([this, path](const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    auto opened_one = opened_recording(path.toStdString(), context);
    if (context.stopped()) return {};
    if (!opened_one) return [this, error = opened_one.error()] { Q_EMIT failed(error); };
    return [this, out = std::move(*opened_one)] {
      if (!cancelled_) Q_EMIT opened(out);
    };
  });
}

void RecordingWork::show_glimpses(const std::shared_ptr<const Recording>& recording,
                                  std::size_t image_topic) {
  glimpses_.start([this, recording, image_topic](const RunContext& context,
                                                 const Runner::Post& post) -> Runner::Deliver {
    const TimeSpan span = recording->span();
    const auto length_ns = static_cast<double>(span.last_ns - span.first_ns);
    for (int k = 0; k < kGlimpses && !context.stopped(); ++k) {
      const double from_start_ns = length_ns * (k + 0.5) / kGlimpses;
      const auto picture = thumbnail_at(*recording, image_topic,
                                        span.first_ns + static_cast<std::int64_t>(from_start_ns),
                                        kThumbnailPx, context);
      if (!picture) continue;  // The look says what is wrong with the images.
      post([this, time_s = 1e-9 * from_start_ns, image = as_image(*picture)] {
        Q_EMIT glimpsed(time_s, image);
      });
    }
    return {};
  });
}

void RecordingWork::look(const std::shared_ptr<const Recording>& recording,
                         const ImportOptions& options,
                         const std::shared_ptr<const RecordingSurvey>& survey) {
  start([this, recording, options, survey](const RunContext& context,
                                           const Runner::Post&) -> Runner::Deliver {
    auto look = look_through(*recording, options, survey, context);
    if (context.stopped()) return {};
    if (!look) return [this, error = look.error()] { Q_EMIT failed(error); };
    return [this, out = std::move(*look)] {
      if (!cancelled_) Q_EMIT looked(out);
    };
  });
}

void RecordingWork::show_pictures(const std::shared_ptr<const Recording>& recording,
                                  const RecordingLook& look, const std::vector<int>& which,
                                  const Target& target, const std::optional<Camera>& camera) {
  pictures_.start([this, recording, survey = look.survey, stretches = look.stretches, which, target,
                   camera](const RunContext& context, const Runner::Post& post) -> Runner::Deliver {
    for (const int index : which) {
      if (context.stopped()) break;
      const auto picture = picture_of(
          *recording, *survey, stretches[static_cast<std::size_t>(index)], kThumbnailPx, context);
      if (!picture) continue;  // The import says why.
      const QImage image = as_image(picture->thumbnail);
      if (!camera) {
        post([this, index, image] { Q_EMIT pictured(index, image, false, {}); });
        continue;
      }
      const Message complaint = board_complaint(picture->file.bytes, target, *camera, context);
      if (context.stopped()) break;
      post([this, index, image, complaint] { Q_EMIT pictured(index, image, true, complaint); });
    }
    return {};
  });
}

void RecordingWork::import(const std::shared_ptr<const Recording>& recording,
                           const std::shared_ptr<const RecordingSurvey>& survey,
                           const Target& target, ImportOptions options, const QString& dataset) {
  options.target_yaml = to_yaml(target);
  start([this, recording, survey, target, options, dataset](
            const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    ImportOptions checked = options;
    checked.board_check = make_board_check(target, context);
    const auto summary =
        import_recording(*recording, *survey, checked, dataset.toStdString(), context);
    if (!summary) {
      if (summary.error().kind == ErrorKind::kCancelled) return {};
      return [this, error = summary.error()] { Q_EMIT failed(error); };
    }
    return [this, dataset, out = *summary] { Q_EMIT imported(out, dataset); };
  });
}

void RecordingWork::cancel() {
  glimpses_.cancel();
  cancelled_ = true;
  pictures_.cancel();
  runner_.cancel();
}

}  // namespace lvcalib::widgets

#include "moc_recording_work.cpp"
