// SPDX-License-Identifier: BSD-3-Clause
#include "recording/still_stretches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace lvcalib {
namespace {

// 2.8° on a side: a board of 0.9 m at 5 m covers a dozen cells, and a sweep of a Livox (24 000
// points in 70°) puts 35 points into each.
constexpr int kFaceCells = 32;
constexpr std::size_t kLookCells = std::size_t{6} * kFaceCells * kFaceCells;
constexpr std::uint32_t kLeastPoints = 4;

// A cell has changed beyond five standard deviations: of ten thousand cells none does by chance.
constexpr double kGate = 5.0;
// Images: the smallest board that is of use (a tenth of the image's width, one part in a hundred
// of its cells) changes a third of its cells when it moves; flicker on a display or a leaf does not
// reach that.
constexpr double kImageShare = 0.003;
// Clouds: a person behind the rig takes up one direction in a hundred of a LiDAR that sees all
// round.
constexpr double kCloudShare = 0.02;
constexpr std::size_t kLeastCloudCells = 4;
// Ranges of two sweeps differ by as much with temperature and scan phase.
constexpr double kRangeTolerance_m = 0.02;
// The least noise of a cell's mean that is believed, in 1/256 grey level: images that are repeated
// bit by bit, as by a simulator or a video codec, have none.
constexpr float kLeastSigma = 0.05F * 256.0F;
// What part of a recording must be at rest for its noise to be measured: a tenth, or a quarter
// where there are too few samples to tell a tenth. |x| of a normal distribution lies below `sigmas`
// in this part of all cases.
struct NoiseQuantile {
  double part = 0.0;
  double sigmas = 0.0;
};
constexpr NoiseQuantile kOfManyPairs{0.10, 0.12566};
constexpr NoiseQuantile kOfFewPairs{0.25, 0.31864};
constexpr std::size_t kManyPairs = 100;  // Of which a tenth are ten: enough for their largest.

// Memory for the looks at a recording; longer ones are thinned out.
constexpr std::size_t kImageBytes = std::size_t{60} << 20U;
constexpr std::size_t kCloudBytes = std::size_t{60} << 20U;

std::size_t cube_cell(const Eigen::Vector3f& p) {
  int axis = 0;
  p.cwiseAbs().maxCoeff(&axis);
  const float major = p[axis];
  const auto along = [&](float v) {
    const auto cell = static_cast<int>(0.5F * (v / std::abs(major) + 1.0F) * kFaceCells);
    return std::clamp(cell, 0, kFaceCells - 1);
  };
  const int face = 2 * axis + (major < 0.0F ? 1 : 0);
  return static_cast<std::size_t>((face * kFaceCells + along(p[(axis + 1) % 3])) * kFaceCells +
                                  along(p[(axis + 2) % 3]));
}

// Brightness of one image over another's: exposure and mains flicker are no motion.
float gain_between(const ImageLook& a, const ImageLook& b) {
  constexpr std::uint16_t dark = 20 * 256;
  std::vector<float> ratios;
  ratios.reserve(a.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    if (a.cells[i] > dark && b.cells[i] > dark) {
      ratios.push_back(static_cast<float>(a.cells[i]) / static_cast<float>(b.cells[i]));
    }
  }
  if (ratios.size() < a.cells.size() / 8 + 1) return 1.0F;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

bool same_size(const ImageLook& a, const ImageLook& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px;
}

// Largest difference of a cell to its neighbours: what a shift by a whole cell changes at most.
float contrast(const ImageLook& look, int x, int y) {
  const auto at = [&](int column, int row) {
    return static_cast<float>(look.cells[static_cast<std::size_t>(row * look.columns + column)]);
  };
  const float here = at(x, y);
  float out = 0.0F;
  if (x > 0) out = std::max(out, std::abs(at(x - 1, y) - here));
  if (y > 0) out = std::max(out, std::abs(at(x, y - 1) - here));
  if (x + 1 < look.columns) out = std::max(out, std::abs(at(x + 1, y) - here));
  if (y + 1 < look.rows) out = std::max(out, std::abs(at(x, y + 1) - here));
  return out;
}

struct SampleRun {
  std::size_t first = 0;
  std::size_t last = 0;
  [[nodiscard]] std::size_t middle() const { return (first + last) / 2; }
};

// Runs of samples none of which has moved away from the run's first. Comparing with the first, and
// not with the one before, finds slow drift as well.
template <class Moved>
std::vector<SampleRun> find_runs(std::size_t samples, const Moved& has_moved) {
  std::vector<SampleRun> runs;
  for (std::size_t i = 0; i < samples; ++i) {
    if (runs.empty() || has_moved(runs.back().first, i)) {
      runs.push_back({i, i});
    } else {
      runs.back().last = i;
    }
  }
  // A run that began while things were coming to rest ends when noise adds to what it was off.
  std::vector<SampleRun> joined;
  for (const SampleRun& run : runs) {
    const bool long_enough = run.last > run.first + 1;
    if (long_enough && !joined.empty() && joined.back().last > joined.back().first + 1 &&
        !has_moved(joined.back().middle(), run.middle())) {
      joined.back().last = run.last;
    } else {
      joined.push_back(run);
    }
  }
  return joined;
}

// What a sample stands for on either side: half of the time to the next one. A single sample stands
// for a stretch that is just long enough.
template <class Look>
std::int64_t reach_of(const Track<Look>& track, const StillOptions& options) {
  return track.size() < 2 ? static_cast<std::int64_t>(1e9 * options.min_still_s)
                          : track.period_ns() / 2;
}

std::size_t sharpest(const ImageTrack& images, std::size_t first, std::size_t last) {
  std::size_t best = first;
  for (std::size_t i = first; i <= last; ++i) {
    if (images.look(i).sharpness > images.look(best).sharpness) best = i;
  }
  return best;
}

// Samples of a run within [first_ns, last_ns]; the run overlaps it.
template <class Look>
SampleRun samples_within(const Track<Look>& track, SampleRun run, std::int64_t first_ns,
                         std::int64_t last_ns) {
  while (run.first < run.last && track.time_ns(run.first) < first_ns) ++run.first;
  while (run.last > run.first && track.time_ns(run.last) > last_ns) --run.last;
  return run;
}

// All samples between two times; none if nothing was recorded there.
template <class Look>
std::optional<SampleRun> samples_between(const Track<Look>& track, std::int64_t first_ns,
                                         std::int64_t last_ns) {
  std::optional<SampleRun> run;
  for (std::size_t i = 0; i < track.size(); ++i) {
    if (track.time_ns(i) < first_ns || track.time_ns(i) > last_ns) continue;
    if (!run) run = {i, i};
    run->last = i;
  }
  return run;
}

// The stretches of one run of images: its overlaps with runs of clouds, or itself with the reason
// why there is none.
void add_stretches(const ImageTrack& images, const SampleRun& run, const CloudTrack& clouds,
                   const std::vector<SampleRun>& cloud_runs, const StillOptions& options,
                   std::vector<StillStretch>& out) {
  const std::int64_t reach = reach_of(images, options);
  const std::int64_t cloud_reach = reach_of(clouds, options);
  const std::int64_t first = images.time_ns(run.first) - reach;
  const std::int64_t last = images.time_ns(run.last) + reach;
  const double length_s = 1e-9 * static_cast<double>(last - first);
  // Of what is shorter than half of the least nobody expects a scene.
  if (length_s < 0.5 * options.min_still_s) return;
  StillStretch whole;
  whole.first_ns = first;
  whole.last_ns = last;
  whole.first_image = run.first;
  whole.last_image = run.last;
  whole.sharpest_image = sharpest(images, run.first, run.last);
  bool any = false;
  bool any_cloud = false;
  for (const SampleRun& cloud_run : cloud_runs) {
    StillStretch stretch = whole;
    stretch.first_ns = std::max(first, clouds.time_ns(cloud_run.first) - cloud_reach);
    stretch.last_ns = std::min(last, clouds.time_ns(cloud_run.last) + cloud_reach);
    if (stretch.last_ns <= stretch.first_ns) continue;
    any_cloud = true;
    if (stretch.length_s() < options.min_still_s) continue;
    const SampleRun i = samples_within(images, run, stretch.first_ns, stretch.last_ns);
    const SampleRun c = samples_within(clouds, cloud_run, stretch.first_ns, stretch.last_ns);
    stretch.first_image = i.first;
    stretch.last_image = i.last;
    stretch.first_cloud = c.first;
    stretch.last_cloud = c.last;
    stretch.sharpest_image = sharpest(images, i.first, i.last);
    out.push_back(stretch);
    any = true;
  }
  if (any) return;
  whole.verdict = length_s < options.min_still_s ? StretchVerdict::kTooShort
                  : any_cloud                    ? StretchVerdict::kCloudMoves
                                                 : StretchVerdict::kNoCloud;
  out.push_back(whole);
}

// Of several stretches with one pose the longest stays.
void drop_repeats(const ImageTrack& images, const ImageComparison& comparison,
                  const CloudTrack& clouds, const StillOptions& options,
                  std::vector<StillStretch>& stretches) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    if (stretches[i].verdict == StretchVerdict::kTaken) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return stretches[a].length_s() > stretches[b].length_s();
  });
  std::vector<std::size_t> kept;
  for (const std::size_t i : order) {
    StillStretch& stretch = stretches[i];
    const auto middle_cloud = [](const StillStretch& s) {
      return (s.first_cloud + s.last_cloud) / 2;
    };
    const auto same = std::find_if(kept.begin(), kept.end(), [&](std::size_t k) {
      const StillStretch& other = stretches[k];
      return same_size(images.look(stretch.sharpest_image), images.look(other.sharpest_image)) &&
             !comparison.moved(other.sharpest_image, stretch.sharpest_image, options.repeat_px) &&
             !moved(clouds.look(middle_cloud(other)), clouds.look(middle_cloud(stretch)));
    });
    if (same == kept.end()) {
      kept.push_back(i);
    } else {
      stretch.verdict = StretchVerdict::kRepeat;
      stretch.repeat_of = *same;
    }
  }
}

}  // namespace

CloudLook look_at_cloud(const Cloud& cloud) {
  struct Sums {
    std::uint32_t count = 0;
    double sum = 0.0;
    double squares = 0.0;
  };
  std::vector<Sums> sums(kLookCells);
  for (const Eigen::Vector3f& p : cloud.points_m) {
    Sums& cell = sums[cube_cell(p)];
    const double range = p.cast<double>().norm();
    ++cell.count;
    cell.sum += range;
    cell.squares += range * range;
  }
  CloudLook look;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Sums& cell = sums[i];
    if (cell.count < kLeastPoints) continue;
    const double n = cell.count;
    const double mean = cell.sum / n;
    const double variance = std::max(0.0, cell.squares / n - mean * mean) * n / (n - 1.0);
    // A centimetre is what the best of LiDARs scatter.
    const double sigma = std::max(0.01, std::sqrt(variance)) / std::sqrt(n);
    if (!(mean < 131.0)) continue;  // Beyond what the number holds.
    look.cells.push_back({static_cast<std::uint16_t>(i),
                          static_cast<std::uint16_t>(std::lround(500.0 * mean)),
                          static_cast<std::uint16_t>(std::min(65535.0, 5000.0 * sigma))});
  }
  return look;
}

template <class Look>
std::int64_t Track<Look>::period_ns() const {
  if (times_.size() < 2) return 0;
  std::vector<std::int64_t> steps(times_.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = times_[i + 1] - times_[i];
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}
template class Track<ImageLook>;
template class Track<CloudLook>;

ImageTrack make_image_track(const StillOptions& options) {
  return {options.sample_rate_hz, kImageBytes};
}
CloudTrack make_cloud_track(const StillOptions& options) {
  return {options.sample_rate_hz, kCloudBytes};
}

ImageComparison::ImageComparison(const ImageTrack& track) : track_(track) {
  // At most so many pairs of neighbours, spread over the whole recording.
  constexpr std::size_t most_pairs = 400;
  std::vector<std::vector<float>> differences;
  const std::size_t step = std::max<std::size_t>(1, track.size() / most_pairs);
  for (std::size_t i = 0; i + 1 < track.size(); i += step) {
    const ImageLook& a = track.look(i);
    const ImageLook& b = track.look(i + 1);
    if (!same_size(a, b) || !same_size(a, track.look(0))) continue;
    const float gain = gain_between(a, b);
    std::vector<float>& row = differences.emplace_back(a.cells.size());
    for (std::size_t c = 0; c < row.size(); ++c) {
      row[c] = std::abs(static_cast<float>(a.cells[c]) - gain * static_cast<float>(b.cells[c]));
    }
  }
  if (track.size() == 0) return;
  sigma_.assign(track.look(0).cells.size(), kLeastSigma);
  if (differences.empty()) return;
  // What changes least over time is noise as long as things stand still for some of it.
  std::vector<float> column(differences.size());
  const NoiseQuantile quantile = column.size() < kManyPairs ? kOfFewPairs : kOfManyPairs;
  const auto rank = static_cast<std::size_t>(quantile.part * static_cast<double>(column.size()));
  for (std::size_t c = 0; c < sigma_.size(); ++c) {
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = differences[i][c];
    std::nth_element(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(rank),
                     column.end());
    sigma_[c] = std::max(kLeastSigma, static_cast<float>(column[rank] / quantile.sigmas));
  }
  // Where they do not, cells with much contrast seem to be noisy: none is much more than most are.
  std::vector<float> sorted = sigma_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (float& sigma : sigma_) sigma = std::min(sigma, 4.0F * *middle);
}

double ImageComparison::motion(std::size_t a, std::size_t b, double tolerance_px) const {
  const ImageLook& first = track_.look(a);
  const ImageLook& second = track_.look(b);
  if (!same_size(first, second) || first.cells.size() != sigma_.size()) {
    return a == b ? 0.0 : 1.0 / kImageShare;
  }
  const float gain = gain_between(first, second);
  const auto shift = static_cast<float>(tolerance_px / first.cell_px);
  const auto allowed = static_cast<std::size_t>(kImageShare * static_cast<double>(sigma_.size()));
  std::size_t changed = 0;
  for (int y = 0; y < first.rows; ++y) {
    for (int x = 0; x < first.columns; ++x) {
      const auto c = static_cast<std::size_t>(y * first.columns + x);
      const float difference =
          std::abs(static_cast<float>(first.cells[c]) - gain * static_cast<float>(second.cells[c]));
      const auto gate = static_cast<float>(kGate) * sigma_[c];
      if (difference > gate && difference > gate + shift * contrast(first, x, y)) ++changed;
    }
  }
  return static_cast<double>(changed) / static_cast<double>(allowed + 1);
}

bool moved(const CloudLook& a, const CloudLook& b) {
  return motion(a, b) >= 1.0;
}

double motion(const CloudLook& a, const CloudLook& b) {
  std::size_t common = 0;
  std::size_t changed = 0;
  for (auto i = a.cells.begin(), k = b.cells.begin(); i != a.cells.end() && k != b.cells.end();) {
    if (i->index != k->index) {
      (i->index < k->index ? i : k)++;
      continue;
    }
    ++common;
    const double difference = 2e-3 * std::abs(int{i->range_2mm} - int{k->range_2mm});
    const double sigma = 2e-4 * std::hypot(1.0 * i->sigma_200um, 1.0 * k->sigma_200um);
    if (difference > kRangeTolerance_m + kGate * sigma) ++changed;
    ++i;
    ++k;
  }
  const std::size_t allowed = std::max(
      kLeastCloudCells, static_cast<std::size_t>(kCloudShare * static_cast<double>(common)));
  if (common == 0) return 1.0 / kCloudShare;
  return static_cast<double>(changed) / static_cast<double>(allowed + 1);
}

std::vector<StillStretch> find_still_stretches(const ImageTrack& images, const CloudTrack& clouds,
                                               const StillOptions& options) {
  const ImageComparison comparison(images);
  const auto image_runs = find_runs(images.size(), [&](std::size_t a, std::size_t b) {
    return comparison.moved(a, b, options.still_px);
  });
  const auto cloud_runs = find_runs(clouds.size(), [&](std::size_t a, std::size_t b) {
    return moved(clouds.look(a), clouds.look(b));
  });
  std::vector<StillStretch> out;
  for (const SampleRun& run : image_runs) {
    add_stretches(images, run, clouds, cloud_runs, options, out);
  }
  drop_repeats(images, comparison, clouds, options, out);
  for (StillStretch& stretch : out) {
    stretch.found_first_ns = stretch.first_ns;
    stretch.found_last_ns = stretch.last_ns;
  }
  return out;
}

void set_edges(StillStretch& stretch, std::int64_t first_ns, std::int64_t last_ns,
               const ImageTrack& images, const CloudTrack& clouds, const StillOptions& options) {
  stretch.by_hand = true;
  stretch.first_ns = first_ns;
  stretch.last_ns = last_ns;
  const auto image_run = samples_between(images, first_ns, last_ns);
  const auto cloud_run = samples_between(clouds, first_ns, last_ns);
  if (image_run) {
    stretch.first_image = image_run->first;
    stretch.last_image = image_run->last;
    stretch.sharpest_image = sharpest(images, image_run->first, image_run->last);
  }
  if (cloud_run) {
    stretch.first_cloud = cloud_run->first;
    stretch.last_cloud = cloud_run->last;
  }
  if (stretch.length_s() < options.min_still_s) {
    stretch.verdict = StretchVerdict::kTooShort;
  } else if (!image_run) {
    stretch.verdict = StretchVerdict::kNoImage;
  } else if (!cloud_run) {
    stretch.verdict = StretchVerdict::kNoCloud;
  } else if (stretch.verdict != StretchVerdict::kRepeat) {
    stretch.verdict = StretchVerdict::kTaken;
  }
}

}  // namespace lvcalib
