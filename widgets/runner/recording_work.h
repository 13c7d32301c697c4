// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QObject>
#include <QString>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "recording/import.h"
#include "recording/recording.h"
#include "recording/survey.h"
#include "runner/runner.h"
#include "target/target.h"

namespace lvcalib::widgets {

/// A recording that was opened, and what to know before it is imported.
struct OpenedRecording {
  std::shared_ptr<const Recording> recording;
  TopicCandidates candidates;
  /// The CameraInfo that belongs to each candidate of images, if any.
  std::vector<std::optional<std::size_t>> info_of_images;
  std::vector<Message> warnings;
};

/// What one pass over the recording showed.
struct RecordingLook {
  std::shared_ptr<const RecordingSurvey> survey;
  std::vector<ImportedStretch> stretches;
  RecordedMotion motion;
  std::vector<Message> warnings;
};

/// Opens a recording, looks through it and imports it, one at a time, in a worker thread; and shows
/// the stretches' images in another.
class RecordingWork : public QObject {
  Q_OBJECT

 public:
  static constexpr int kThumbnailPx = 128;
  static constexpr int kGlimpses = 12;

  explicit RecordingWork(QObject* parent = nullptr);

  /// opened() follows; takes the place of what runs.
  void open(const QString& path);
  /// glimpsed() follows for some images spread over the recording, in the background.
  void show_glimpses(const std::shared_ptr<const Recording>& recording, std::size_t image_topic);
  /// looked() follows. With the survey of an earlier look, nothing is read: only the stretches are
  /// found anew.
  void look(const std::shared_ptr<const Recording>& recording, const ImportOptions& options,
            const std::shared_ptr<const RecordingSurvey>& survey = nullptr);
  /// pictured() follows for each of the stretches `which`, in the background. Whether the board is
  /// seen is told where the camera is known.
  void show_pictures(const std::shared_ptr<const Recording>& recording, const RecordingLook& look,
                     const std::vector<int>& which, const Target& target,
                     const std::optional<Camera>& camera);
  /// imported() follows.
  void import(const std::shared_ptr<const Recording>& recording,
              const std::shared_ptr<const RecordingSurvey>& survey, const Target& target,
              ImportOptions options, const QString& dataset);
  void cancel();
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void progressed(const QString& stage, double fraction, const QString& text);
  void opened(const lvcalib::widgets::OpenedRecording& recording);
  /// `time_s`: from the recording's first message.
  void glimpsed(double time_s, const QImage& thumbnail);
  void looked(const lvcalib::widgets::RecordingLook& look);
  /// `complaint`: why the board is not seen; empty if it is. `checked`: whether it was looked for.
  void pictured(int stretch, const QImage& thumbnail, bool checked,
                const lvcalib::Message& complaint);
  void imported(const lvcalib::ImportSummary& summary, const QString& dataset);
  void failed(const lvcalib::Error& error);
  void cancelled();

 private:
  void start(Runner::Work work);

  bool cancelled_ = false;  // What was ready just before is not wanted any more.
  Runner glimpses_;
  Runner pictures_;
  Runner runner_;
};

}  // namespace lvcalib::widgets
