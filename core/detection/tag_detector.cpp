// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_detector.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>

#include <apriltag/apriltag.h>
#include <apriltag/common/image_u8.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>
#include <opencv2/imgproc.hpp>

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

using FamilyHandle = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;
using ImageHandle = std::unique_ptr<image_u8_t, void (*)(image_u8_t*)>;

// The library's family with `border_bits` rings of black and only the wanted ids: the decoder's
// table grows with the number of codes and takes longer to build than an image to search.
FamilyHandle make_family(const std::string& name, int border_bits,
                         const TagSearchOptions& options) {
  for (const Family& entry : kFamilies) {
    if (name != entry.name) continue;
    FamilyHandle family(entry.create(), entry.destroy);
    const int extra = border_bits - 1;
    family->width_at_border += 2 * extra;
    family->total_width += 2 * extra;
    for (std::uint32_t i = 0; i < family->nbits; ++i) {
      family->bit_x[i] += static_cast<std::uint32_t>(extra);
      family->bit_y[i] += static_cast<std::uint32_t>(extra);
    }
    if (options.id_count > 0) {
      const auto first = static_cast<std::uint32_t>(options.first_id);
      const auto count = static_cast<std::uint32_t>(options.id_count);
      std::memmove(family->codes, family->codes + first, count * sizeof(family->codes[0]));
      family->ncodes = count;
    }
    return family;
  }
  return {nullptr, tag36h11_destroy};
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

std::vector<TagDetection> run_pass(image_u8_t& image, apriltag_family_t& family, const Pass& pass,
                                   const TagSearchOptions& options, int threads) {
  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector(
      apriltag_detector_create(), apriltag_detector_destroy);
  apriltag_detector_add_family_bits(detector.get(), &family, options.max_hamming);
  detector->quad_decimate = static_cast<float>(pass.decimate);
  detector->decode_sharpening = pass.sharpening;
  detector->nthreads = threads;
  zarray_t* found = apriltag_detector_detect(detector.get(), &image);
  std::vector<TagDetection> out;
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* item = nullptr;
    zarray_get(found, i, &item);
    if (item->decision_margin < pass.min_margin) continue;
    TagDetection tag{options.first_id + item->id, {}, item->hamming, item->decision_margin};
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

Status check(const std::string& family, int border_bits, const TagSearchOptions& options) {
  const int size = tag_family_size(family);
  if (size == 0) return Error::usage("tag family '" + family + "' is not known");
  if (border_bits < 1 || border_bits > 2) return Error::usage("tag border must be 1 or 2 bits");
  if (options.first_id < 0 || options.id_count < 0 || options.first_id >= size ||
      options.id_count > size - options.first_id) {
    return Error::usage("tag ids beyond the " + std::to_string(size) + " of " + family);
  }
  if (!(options.decimate >= 1.0)) return Error::usage("image reduction must be at least 1");
  if (options.max_hamming < 0 || options.max_hamming > 2) {
    return Error::usage("corrected bits must be 0, 1 or 2");
  }
  return Done{};
}

}  // namespace

Result<std::vector<TagDetection>> find_tags(const GrayImage& image, const std::string& family,
                                            int border_bits, const TagSearchOptions& options,
                                            const RunContext& context) {
  if (const Status status = check(family, border_bits, options); !status) return status.error();
  // The library divides by the number of 4-pixel tiles of the reduced image.
  if (std::min(image.width_px, image.height_px) < 16 * options.decimate) {
    return std::vector<TagDetection>{};
  }
  const FamilyHandle handle = make_family(family, border_bits, options);
  const ImageHandle small = to_u8(image);
  const int threads = context.thread_count();
  Pass first;
  first.decimate = options.decimate;
  std::vector<TagDetection> all = run_pass(*small, *handle, first, options, threads);
  if (!options.thorough) return all;

  std::vector<Pass> passes;
  if (options.decimate > 1.0) passes.push_back({1.0, 1.0});
  passes.push_back({1.0, 2.0, Treatment::kSharpen, 1.0});
  passes.push_back({1.0, 1.0, Treatment::kShrinkBlack});
  passes.push_back({1.0, 2.0, Treatment::kShrinkBlack, 1.0});
  const ImageHandle large = enlarge(*small);
  for (Pass& pass : passes) {
    if (context.stopped()) return Error::cancelled();
    pass.min_margin = options.min_margin;
    const ImageHandle treated = treat(pass.scale > 1.0 ? *large : *small, pass.treatment);
    merge(all, run_pass(*treated, *handle, pass, options, threads));
  }
  return all;
}

}  // namespace lvcalib
