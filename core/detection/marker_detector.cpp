// SPDX-License-Identifier: BSD-3-Clause
#include "detection/marker_detector.h"

#include <algorithm>
#include <cmath>

#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

namespace lvcalib {
namespace {

// Eight bits, stretched to the image's range.
cv::Mat to_bytes(const GrayImage& image) {
  float low = 255.0F;
  float high = 0.0F;
  for (const float v : image.pixels) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const float gain = 255.0F / std::max(high - low, 8.0F);
  cv::Mat out(image.height_px, image.width_px, CV_8U);
  for (int y = 0; y < image.height_px; ++y) {
    auto* row = out.ptr<unsigned char>(y);
    for (int x = 0; x < image.width_px; ++x) {
      const float v = image.at(x, y);
      row[x] = std::isfinite(v) ? cv::saturate_cast<unsigned char>((v - low) * gain) : 0;
    }
  }
  return out;
}

cv::Ptr<cv::aruco::Dictionary> dictionary_of(const std::string& name) {
  const auto& names = marker_dictionaries();
  const auto at = std::find(names.begin(), names.end(), name);
  // OpenCV numbers them in the order of the names.
  return cv::aruco::getPredefinedDictionary(static_cast<int>(at - names.begin()));
}

// Contours run through the outermost black pixels, whose outer edges are half a pixel further out.
void move_to_edges(TagCorners& corners) {
  const TagCorners old = corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d out =
        (old[k] - old[(k + 1) % 4]).normalized() + (old[k] - old[(k + 3) % 4]).normalized();
    if (out.allFinite()) corners[k] += 0.5 * out;
  }
}

struct MarkerPass {
  double scale = 1.0;                // Pixels of the searched image per pixel of the original.
  double smallest_perimeter = 0.03;  // As a share of the image's longer side.
};

std::vector<TagDetection> run_marker_pass(const cv::Mat& image, const std::string& dictionary,
                                          int border_bits, const MarkerPass& pass,
                                          const TagSearchOptions& options) {
  cv::Mat searched = image;
  if (pass.scale != 1.0) {
    cv::resize(image, searched, {}, pass.scale, pass.scale,
               pass.scale > 1.0 ? cv::INTER_LINEAR : cv::INTER_AREA);
  }
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->markerBorderBits = border_bits;
  parameters->minMarkerPerimeterRate = pass.smallest_perimeter;
  if (options.max_hamming == 0) parameters->errorCorrectionRate = 0.0;
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(searched, dictionary_of(dictionary), corners, ids, parameters);
  std::vector<TagDetection> out;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int last = options.first_id + options.id_count;
    if (options.id_count > 0 && (ids[i] < options.first_id || ids[i] >= last)) continue;
    TagDetection tag;
    tag.id = ids[i];
    // OpenCV begins at the upper left and goes clockwise.
    for (std::size_t k = 0; k < 4; ++k) {
      const cv::Point2f& p = corners[i][3 - k];
      tag.corners[k] = {(p.x + 0.5) / pass.scale - 0.5, (p.y + 0.5) / pass.scale - 0.5};
    }
    move_to_edges(tag.corners);
    out.push_back(tag);
  }
  return out;
}

Eigen::Vector2d middle(const TagDetection& tag) {
  return 0.25 * (tag.corners[0] + tag.corners[1] + tag.corners[2] + tag.corners[3]);
}

}  // namespace

Result<std::vector<TagDetection>> find_markers(const GrayImage& image,
                                               const std::string& dictionary, int border_bits,
                                               const TagSearchOptions& options,
                                               const RunContext& context) {
  if (!is_marker_dictionary(dictionary))
    return Error::usage(Message("marker dictionary '%1' is not known", dictionary));
  if (std::min(image.width_px, image.height_px) < 16) return std::vector<TagDetection>{};
  std::vector<MarkerPass> passes{{1.0, 0.02}};
  // What is printed small or seen from afar; what only its blurred outline shows.
  if (options.thorough) {
    passes.push_back({2.0, 0.01});
    passes.push_back({0.5, 0.03});
  }
  std::vector<TagDetection> all;
  try {
    const cv::Mat bytes = to_bytes(image);
    for (const MarkerPass& pass : passes) {
      if (context.stopped()) return Error::cancelled();
      for (const TagDetection& tag :
           run_marker_pass(bytes, dictionary, border_bits, pass, options)) {
        const bool known = std::any_of(all.begin(), all.end(), [&](const TagDetection& other) {
          return (middle(other) - middle(tag)).norm() <
                 0.5 * (other.corners[0] - other.corners[2]).norm();
        });
        if (!known) all.push_back(tag);
      }
    }
  } catch (const cv::Exception&) {
    return Error::input(Message("the image cannot be searched for markers"));
  }
  return all;
}

}  // namespace lvcalib
