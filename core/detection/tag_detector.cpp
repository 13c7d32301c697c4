// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_detector.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include <apriltag/apriltag.h>
#include <apriltag/common/image_u8.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <opencv2/imgproc.hpp>

#include "base/memory.h"
#include "base/paired_moments.h"
#include "base/parallel.h"
#include "detection/marker_detector.h"

namespace lvcalib {
namespace {

struct Family {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr Family kFamilies[] = {
    {"tag36h11", tag36h11_create, tag36h11_destroy},
    {"tag36h10", tag36h10_create, tag36h10_destroy},
    {"tag25h9", tag25h9_create, tag25h9_destroy},
    {"tag16h5", tag16h5_create, tag16h5_destroy},
};

// Gives a family back to the library in the state in which it was created.
struct FamilyDeleter {
  void (*destroy)(apriltag_family_t*) = nullptr;
  std::uint64_t* codes = nullptr;
  void operator()(apriltag_family_t* family) const {
    family->codes = codes;
    destroy(family);
  }
};
using FamilyHandle = std::unique_ptr<apriltag_family_t, FamilyDeleter>;
using ImageHandle = std::unique_ptr<image_u8_t, void (*)(image_u8_t*)>;

// The library's family with `border_bits` rings of black and only the wanted ids: the decoder's
// table grows with the number of codes and takes longer to build than an image to search.
FamilyHandle make_family(const std::string& name, int border_bits,
                         const TagSearchOptions& options) {
  for (const Family& entry : kFamilies) {
    if (name != entry.name) continue;
    apriltag_family_t* created = entry.create();
    FamilyHandle family(created, {entry.destroy, created->codes});
    const int extra = border_bits - 1;
    family->width_at_border += 2 * extra;
    family->total_width += 2 * extra;
    for (std::uint32_t i = 0; i < family->nbits; ++i) {
      family->bit_x[i] += static_cast<std::uint32_t>(extra);
      family->bit_y[i] += static_cast<std::uint32_t>(extra);
    }
    if (options.id_count > 0) {
      // The table of codes is shared by all families of this name: point into it, never write.
      family->codes += options.first_id;
      family->ncodes = static_cast<std::uint32_t>(options.id_count);
    }
    return family;
  }
  return {};
}

// A quarter of a per mille of the pixels may lie beyond the range that is kept.
std::pair<float, float> gray_range(const std::vector<float>& pixels) {
  std::array<std::size_t, 1024> histogram{};
  for (const float value : pixels) {
    const float clamped = std::isfinite(value) ? std::clamp(value, 0.0F, 255.0F) : 0.0F;
    ++histogram[static_cast<std::size_t>(clamped * 4.0F)];
  }
  const std::size_t tail = pixels.size() / 4000;
  std::size_t low = 0;
  for (std::size_t sum = histogram[0]; sum <= tail && low < 1020; sum += histogram[++low]) {
  }
  std::size_t high = 1023;
  for (std::size_t sum = histogram[1023]; sum <= tail && high > low + 1; sum += histogram[--high]) {
  }
  return {static_cast<float>(low) / 4.0F, static_cast<float>(high) / 4.0F};
}

// Eight bits for the library, dark images stretched, since its thresholds are in grey levels.
ImageHandle to_u8(const GrayImage& image) {
  const auto [low, high] = gray_range(image.pixels);
  const float gain = 255.0F / std::max(high - low, 8.0F);
  ImageHandle out(image_u8_create(static_cast<unsigned>(image.width_px),
                                  static_cast<unsigned>(image.height_px)),
                  image_u8_destroy);
  for (int y = 0; y < image.height_px; ++y) {
    const float* in = image.pixels.data() +
                      static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width_px);
    std::uint8_t* row = out->buf + static_cast<std::ptrdiff_t>(y) * out->stride;
    for (int x = 0; x < image.width_px; ++x) {
      const float value = (in[x] - low) * gain + 0.5F;
      row[x] = value > 255.0F ? 255 : value > 0.0F ? static_cast<std::uint8_t>(value) : 0;
    }
  }
  return out;
}

// Twice as large, linear interpolation. New pixel (x, y) lies at x/2 − 1/4 of the old grid, so that
// the image keeps its place when pixel centres are at half-integers.
ImageHandle enlarge(const image_u8_t& image) {
  ImageHandle out(image_u8_create(static_cast<unsigned>(2 * image.width),
                                  static_cast<unsigned>(2 * image.height)),
                  image_u8_destroy);
  for (int y = 0; y < out->height; ++y) {
    const int near_y = y / 2;
    const int far_y = std::clamp(near_y + ((y & 1) != 0 ? 1 : -1), 0, image.height - 1);
    const std::uint8_t* near_row = image.buf + static_cast<std::ptrdiff_t>(near_y) * image.stride;
    const std::uint8_t* far_row = image.buf + static_cast<std::ptrdiff_t>(far_y) * image.stride;
    for (int x = 0; x < out->width; ++x) {
      const int near_x = x / 2;
      const int far_x = std::clamp(near_x + ((x & 1) != 0 ? 1 : -1), 0, image.width - 1);
      const int sum =
          9 * near_row[near_x] + 3 * near_row[far_x] + 3 * far_row[near_x] + far_row[far_x] + 8;
      out->buf[static_cast<std::ptrdiff_t>(y) * out->stride + x] =
          static_cast<std::uint8_t>(sum / 16);
    }
  }
  return out;
}

enum class Treatment { kNone, kSharpen, kShrinkBlack };

// A view of the library's image for OpenCV.
cv::Mat view(const image_u8_t& image) {
  return {image.height, image.width, CV_8U, image.buf, static_cast<std::size_t>(image.stride)};
}

// Each pixel takes the brightest value of its 3 × 3 neighbourhood. Kalibr prints black squares that
// touch the tags' corners; in a blurred image they flow together with the tags, which then have no
// closed outline of their own.
ImageHandle shrink_black(const image_u8_t& image) {
  ImageHandle out(image_u8_copy(&image), image_u8_destroy);
  cv::Mat target = view(*out);
  cv::dilate(view(image), target, cv::Mat());
  return out;
}

// Undoes part of the blur of far or defocused tags, whose bits run into each other: adds
// `gain` times what a Gaussian of `sigma` pixels takes away.
ImageHandle sharpen(const image_u8_t& image, double sigma, double gain) {
  ImageHandle out(image_u8_copy(&image), image_u8_destroy);
  cv::Mat target = view(*out);
  cv::Mat smooth;
  cv::GaussianBlur(view(image), smooth, {}, sigma);
  cv::addWeighted(view(image), 1.0 + gain, smooth, -gain, 0.0, target);
  return out;
}

ImageHandle treat(const image_u8_t& image, Treatment treatment) {
  // Strength found on photos with known tags: it doubles the number of small tags that are read.
  if (treatment == Treatment::kSharpen) return sharpen(image, 1.5, 4.0);
  if (treatment == Treatment::kShrinkBlack) return shrink_black(image);
  return {image_u8_copy(&image), image_u8_destroy};
}

// Moves the four sides outwards by `distance` pixels; a small tag's error is below that distance.
void grow(TagCorners& corners, double distance) {
  if (distance <= 0.0) return;
  const TagCorners old = corners;
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] += distance * ((old[k] - old[(k + 1) % 4]).normalized() +
                              (old[k] - old[(k + 3) % 4]).normalized());
  }
}

struct Pass {
  double decimate = 1.0;
  double scale = 1.0;  // pixels of the searched image per pixel of the original
  Treatment treatment = Treatment::kNone;
  double sharpening = 0.25;  // the library's own, of the bits only
  double min_margin = 0.0;
};

// More than the library takes for one pass, as its data structures have it: per pixel of the
// reduced image twelve bytes for regions and up to four edge points of 16 bytes in lists that
// double when they grow; per code and correctable error three entries of 16 bytes. The library
// writes to what it has asked for without looking whether it got it.
std::size_t memory_needed(const image_u8_t& image, const Pass& pass, std::size_t codes,
                          int max_hamming) {
  const double pixels = static_cast<double>(image.width) * image.height * pass.scale * pass.scale;
  constexpr std::size_t kBits = 36;
  const std::size_t errors = max_hamming == 0   ? 1
                             : max_hamming == 1 ? 1 + kBits
                                                : 1 + kBits + kBits * (kBits - 1) / 2;
  constexpr double kFull = 4.0;  // Copies of the image at full size, a byte a pixel.
  constexpr double kReduced = 12.0 + 4 * 16.0 * 2.0;  // Regions; edge points, their lists grown.
  constexpr std::size_t kOther = std::size_t{24} << 20U;
  return kOther + codes * errors * 3 * 16 +
         static_cast<std::size_t>(pixels * (kFull + kReduced / (pass.decimate * pass.decimate)));
}

std::vector<TagDetection> run_pass(image_u8_t& image, apriltag_family_t& family, const Pass& pass,
                                   const TagSearchOptions& options) {
  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), &family, options.max_hamming);
  detector->quad_decimate = static_cast<float>(pass.decimate);
  detector->decode_sharpening = pass.sharpening;
  // The library's worker threads lose work and crash now and then: its task list is not guarded
  // (fixed after 3.3). The passes run in parallel instead.
  detector->nthreads = 1;
  zarray_t* found = apriltag_detector_detect(detector.get(), &image);
  std::vector<TagDetection> out;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* item = nullptr;
    zarray_get(found, i, &item);
    if (item->decision_margin < pass.min_margin) continue;
    TagDetection tag{options.first_id + item->id, {}};
    for (std::size_t k = 0; k < 4; ++k) {
      // The library puts pixel centres at half-integers.
      tag.corners[k] = Eigen::Vector2d(item->p[k][0], item->p[k][1]) / pass.scale -
                       Eigen::Vector2d::Constant(0.5);
    }
    if (pass.treatment == Treatment::kShrinkBlack) grow(tag.corners, 1.0 / pass.scale);
    out.push_back(tag);
  }
  apriltag_detections_destroy(found);
  return out;
}

Eigen::Vector2d center(const TagDetection& tag) {
  return 0.25 * (tag.corners[0] + tag.corners[1] + tag.corners[2] + tag.corners[3]);
}

// Adds what is not there yet; earlier passes are the more careful ones and win. Tags do not
// overlap, so that anything whose centre lies within half a tag of a known one is the same tag.
void merge(std::vector<TagDetection>& all, const std::vector<TagDetection>& more) {
  for (const TagDetection& tag : more) {
    const bool known = std::any_of(all.begin(), all.end(), [&](const TagDetection& other) {
      const double reach = 0.5 * std::max((other.corners[0] - other.corners[2]).norm(),
                                          (tag.corners[0] - tag.corners[2]).norm());
      return (center(other) - center(tag)).norm() < reach;
    });
    if (!known) all.push_back(tag);
  }
}

double sample(const GrayImage& image, const Eigen::Vector2d& p) {
  const double x = std::clamp(p.x(), 0.0, image.width_px - 1.001);
  const double y = std::clamp(p.y(), 0.0, image.height_px - 1.001);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const double s = x - x0;
  const double t = y - y0;
  return (1 - t) * ((1 - s) * image.at(x0, y0) + s * image.at(x0 + 1, y0)) +
         t * ((1 - s) * image.at(x0, y0 + 1) + s * image.at(x0 + 1, y0 + 1));
}

// Correlation of the grey values at the cells' centres with the printed cells.
double cell_correlation(const GrayImage& image, const TagPattern& pattern, int border_bits,
                        const TagCorners& corners) {
  const int side = pattern.width + 2 * border_bits;
  PairedMoments moments;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const int r = row - border_bits;
      const int c = column - border_bits;
      const bool data = r >= 0 && c >= 0 && r < pattern.width && c < pattern.width;
      const double cell = data && pattern.at(r, c) ? 1.0 : 0.0;
      // Bilinear between the corners: perspective within a tag is far below a cell.
      const double s = (column + 0.5) / side;
      const double t = (row + 0.5) / side;
      const double gray = sample(image, (1 - t) * ((1 - s) * corners[3] + s * corners[2]) +
                                            t * ((1 - s) * corners[0] + s * corners[1]));
      moments.add(cell, gray);
    }
  }
  return moments.correlation();
}

// The bits of a tag with the other border width lie at most half a bit from where this one's are
// sampled, so that they can often be read, at wrong places.
void drop_other_border(std::vector<TagDetection>& tags, const GrayImage& image,
                       const std::string& family, int border_bits) {
  std::erase_if(tags, [&](const TagDetection& tag) {
    const TagPattern& pattern = *tag_pattern(family, tag.id);
    return cell_correlation(image, pattern, border_bits, tag.corners) <
           cell_correlation(image, pattern, 3 - border_bits, tag.corners);
  });
}

Status check(const std::string& family, int border_bits, const TagSearchOptions& options) {
  const int size = tag_family_size(family);
  if (size == 0) return Error::usage(Message("tag family '%1' is not known", family));
  if (border_bits < 1 || border_bits > 2)
    return Error::usage(Message("tag border must be 1 or 2 bits"));
  if (options.first_id < 0 || options.id_count < 0 || options.first_id >= size ||
      options.id_count > size - options.first_id) {
    return Error::usage(Message("tag ids beyond the %1 of %2", size, family));
  }
  if (!(options.decimate >= 1.0))
    return Error::usage(Message("image reduction must be at least 1"));
  if (options.max_hamming < 0 || options.max_hamming > 2) {
    return Error::usage(Message("corrected bits must be 0, 1 or 2"));
  }
  return Done{};
}

}  // namespace

Result<std::vector<TagDetection>> find_tags(const GrayImage& image, const std::string& family,
                                            int border_bits, const TagSearchOptions& options,
                                            const RunContext& context) {
  if (const Status status = check(family, border_bits, options); !status) return status.error();
  if (is_marker_dictionary(family))
    return find_markers(image, family, border_bits, options, context);
  // The library divides by the number of 4-pixel tiles of the reduced image.
  if (std::min(image.width_px, image.height_px) < 16 * options.decimate) {
    return std::vector<TagDetection>{};
  }
  // The image in eight bits, and enlarged.
  require_memory(8 * static_cast<std::size_t>(image.width_px) *
                     static_cast<std::size_t>(image.height_px) +
                 (std::size_t{1} << 20U));
  const ImageHandle small = to_u8(image);
  // What each pass after the first adds: small and crowded tags; tags whose corners touch other
  // black areas.
  std::vector<Pass> passes{{options.decimate, 1.0}};
  ImageHandle large(nullptr, image_u8_destroy);
  if (options.thorough) {
    if (options.decimate > 1.0) passes.push_back({1.0, 1.0});
    passes.push_back({1.0, 2.0, Treatment::kSharpen, 1.0});
    passes.push_back({1.0, 1.0, Treatment::kShrinkBlack});
    passes.push_back({1.0, 2.0, Treatment::kShrinkBlack, 1.0});
    for (std::size_t i = 1; i < passes.size(); ++i) passes[i].min_margin = options.min_margin;
    large = enlarge(*small);
  }
  std::vector<std::vector<TagDetection>> found(passes.size());
  parallel_for(passes.size(), context.thread_count(), [&](std::size_t i) {
    if (context.stopped()) return;
    const int codes = options.id_count > 0 ? options.id_count : tag_family_size(family);
    require_memory(
        memory_needed(*small, passes[i], static_cast<std::size_t>(codes), options.max_hamming));
    const FamilyHandle handle = make_family(family, border_bits, options);
    const ImageHandle treated = treat(passes[i].scale > 1.0 ? *large : *small, passes[i].treatment);
    found[i] = run_pass(*treated, *handle, passes[i], options);
    drop_other_border(found[i], image, family, border_bits);
  });
  if (context.stopped()) return Error::cancelled();
  std::vector<TagDetection> all = std::move(found.front());
  for (std::size_t i = 1; i < found.size(); ++i) merge(all, found[i]);
  return all;
}

}  // namespace lvcalib
