// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_images.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "base/image_codec.h"
#include "detection/board_view.h"

namespace lvcalib {

std::string base64(const unsigned char* bytes, std::size_t count) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((count + 2) / 3 * 4);
  for (std::size_t i = 0; i < count; i += 3) {
    const std::size_t have = std::min<std::size_t>(3, count - i);
    unsigned int word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8U) | (k < have ? static_cast<unsigned int>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= have ? kDigits[(word >> (18U - 6U * k)) & 63U] : '=';
  }
  return out;
}

std::optional<PageImage> page_image(const std::filesystem::path& path, const Eigen::Vector2d& low,
                                    const Eigen::Vector2d& high, int most_px) {
  try {
    const auto decoded = read_image(path);
    if (!decoded || !low.allFinite() || !high.allFinite()) return std::nullopt;
    cv::Mat image;
    cv::Mat(decoded->height_px, decoded->width_px, CV_32F,
            const_cast<float*>(decoded->pixels.data()))
        .convertTo(image, CV_8U);
    const auto clamp = [](double v, int most) {
      return static_cast<int>(std::lround(std::clamp(v, 0.0, static_cast<double>(most))));
    };
    const int x0 = clamp(low.x(), image.cols);
    const int y0 = clamp(low.y(), image.rows);
    const int x1 = clamp(high.x(), image.cols);
    const int y1 = clamp(high.y(), image.rows);
    if (x1 - x0 < 2 || y1 - y0 < 2) return std::nullopt;
    cv::Mat part = image(cv::Rect(x0, y0, x1 - x0, y1 - y0));
    if (part.cols > most_px) {
      const double scale = static_cast<double>(most_px) / part.cols;
      cv::Mat smaller;
      cv::resize(part, smaller, {}, scale, scale, cv::INTER_AREA);
      part = smaller;
    }
    constexpr int kQuality = 85;  // No block shows beside the marks drawn on it.
    const auto jpeg =
        encode_grey_jpeg({part.cols, part.rows, 1, 8, part.data, part.step[0]}, kQuality);
    if (!jpeg) return std::nullopt;
    PageImage out;
    out.data_uri = "data:image/jpeg;base64," +
                   base64(reinterpret_cast<const unsigned char*>(jpeg->data()), jpeg->size());
    out.from_px = Eigen::Vector2d(x0 - 0.5, y0 - 0.5);
    out.size_px = Eigen::Vector2d(x1 - x0, y1 - y0);
    return out;
  } catch (const cv::Exception&) {
    return std::nullopt;
  }
}

}  // namespace lvcalib
