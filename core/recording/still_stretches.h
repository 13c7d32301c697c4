// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cloud/cloud.h"
#include "recording/pixels.h"

namespace lvcalib {

/// A sweep reduced to what shows motion: the mean range in each direction, on a grid over the six
/// faces of a cube (so that no axis of the LiDAR is special), with its standard error.
struct CloudLook {
  struct Cell {
    std::uint16_t index = 0;
    std::uint16_t range_2mm = 0;
    std::uint16_t sigma_200um = 0;
  };
  std::vector<Cell> cells;  ///< Sorted by index.
};
CloudLook look_at_cloud(const Cloud& cloud);

/// What to compare, and how.
struct StillOptions {
  /// Shorter stretches give no scene: of rests of a second, what both sensors see in full.
  double min_still_s = 0.8;
  /// Samples of each sensor that are looked at, per second: motion of a hand-held board within a
  /// tenth of a second shows between two of them.
  double sample_rate_hz = 10.0;
  /// Image shifts below stay within a stretch: half of what a corner may be off before the
  /// calibration notices.
  double still_px = 0.5;
  /// Two stretches whose images differ by less, and whose clouds agree, show the same pose.
  double repeat_px = 3.0;
};

/// Looks of one sensor at their times. Long recordings are thinned out: memory stays below
/// some 100 MB whatever their length.
template <class Look>
class Track {
 public:
  Track(double sample_rate_hz, std::size_t most_bytes)
      : interval_ns_(static_cast<std::int64_t>(0.8e9 / sample_rate_hz)), most_bytes_(most_bytes) {}

  /// Whether a message of this time is to be looked at. Times that go back are not.
  [[nodiscard]] bool wants(std::int64_t time_ns) const {
    return times_.empty() || time_ns - times_.back() >= interval_ns_;
  }
  void add(std::int64_t time_ns, Look look, std::size_t bytes) {
    times_.push_back(time_ns);
    looks_.push_back(std::move(look));
    bytes_ += bytes;
    if (bytes_ > most_bytes_) thin_out();
  }
  [[nodiscard]] std::size_t size() const { return times_.size(); }
  [[nodiscard]] std::int64_t time_ns(std::size_t i) const { return times_[i]; }
  [[nodiscard]] const Look& look(std::size_t i) const { return looks_[i]; }
  /// Median time from sample to sample; 0 for fewer than two.
  [[nodiscard]] std::int64_t period_ns() const;

 private:
  void thin_out() {
    std::size_t to = 0;
    for (std::size_t i = 0; i < times_.size(); i += 2, ++to) {
      times_[to] = times_[i];
      if (to != i) looks_[to] = std::move(looks_[i]);
    }
    times_.resize(to);
    looks_.resize(to);
    interval_ns_ *= 2;
    bytes_ /= 2;
  }

  std::vector<std::int64_t> times_;
  std::vector<Look> looks_;
  std::int64_t interval_ns_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;
};

using ImageTrack = Track<ImageLook>;
using CloudTrack = Track<CloudLook>;
ImageTrack make_image_track(const StillOptions& options);
CloudTrack make_cloud_track(const StillOptions& options);

/// Whether two images differ by more than noise and a shift of `tolerance_px`. The noise of each
/// cell is measured on the track itself.
class ImageComparison {
 public:
  explicit ImageComparison(const ImageTrack& track);
  [[nodiscard]] bool moved(std::size_t a, std::size_t b, double tolerance_px) const {
    return motion(a, b, tolerance_px) >= 1.0;
  }
  /// How many cells differ by more, in units of what is no motion yet; 1 and more: moved().
  [[nodiscard]] double motion(std::size_t a, std::size_t b, double tolerance_px) const;

 private:
  const ImageTrack& track_;
  std::vector<float> sigma_;  ///< Of the difference of two looks, by cell, in 1/256 grey level.
};

/// Whether the ranges in two sweeps differ by more than their standard errors allow, in more
/// directions than people in the background take.
bool moved(const CloudLook& a, const CloudLook& b);
/// In how many directions they differ, in units of what is no motion yet; 1 and more: moved().
double motion(const CloudLook& a, const CloudLook& b);

/// Why a stretch is no scene; kTaken: it is one.
enum class StretchVerdict {
  kTaken,
  kTooShort,
  kNoCloud,     ///< The images stand still, and no sweep was recorded meanwhile.
  kNoImage,     ///< No image was taken between the edges that it was given.
  kCloudMoves,  ///< The images stand still, the clouds do not.
  kRepeat,      ///< The pose of another stretch that is longer.
  kNotAsked,    ///< Scenes were asked for by their times, and this is none of them.
};

/// A stretch in which nothing moves. Times are those of the tracks.
struct StillStretch {
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  StretchVerdict verdict = StretchVerdict::kTaken;
  std::size_t first_image = 0, last_image = 0;  ///< Samples of the image track.
  std::size_t first_cloud = 0, last_cloud = 0;  ///< Samples of the cloud track.
  std::size_t sharpest_image = 0;
  std::size_t repeat_of = 0;                           ///< Index of the other stretch.
  bool by_hand = false;                                ///< Its edges were given by set_edges().
  std::int64_t found_first_ns = 0, found_last_ns = 0;  ///< Edges as they were found.

  [[nodiscard]] double length_s() const { return 1e-9 * static_cast<double>(last_ns - first_ns); }
};

/// The stretches in which neither images nor clouds change, in the order of time, with the
/// verdict on each. A stretch reaches half a sample's period beyond its first and last sample.
std::vector<StillStretch> find_still_stretches(const ImageTrack& images, const CloudTrack& clouds,
                                               const StillOptions& options);

/// Gives a stretch other edges, within which its user says that everything stands still: motion is
/// not looked for, but it must be long enough and hold an image and a sweep. A repeat stays one.
void set_edges(StillStretch& stretch, std::int64_t first_ns, std::int64_t last_ns,
               const ImageTrack& images, const CloudTrack& clouds, const StillOptions& options);

}  // namespace lvcalib
