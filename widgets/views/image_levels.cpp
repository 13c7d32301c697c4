// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/image_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lvcalib::widgets {
namespace {

constexpr double kFull16 = 65535.0;

std::vector<uchar> level_table(const ImageLevels& levels, int size) {
  std::vector<uchar> table(static_cast<std::size_t>(size));
  const double width = std::max(levels.white - levels.black, 1e-6);
  for (int i = 0; i < size; ++i) {
    const double share = (static_cast<double>(i) / (size - 1) - levels.black) / width;
    table[static_cast<std::size_t>(i)] =
        static_cast<uchar>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
  }
  return table;
}

bool is_gray(const QImage& image) {
  return image.format() == QImage::Format_Grayscale8 ||
         image.format() == QImage::Format_Grayscale16;
}

}  // namespace

QImage apply_levels(const QImage& image, const ImageLevels& levels) {
  if (image.isNull()) return {};
  if (is_gray(image)) {
    const QImage deep = image.convertToFormat(QImage::Format_Grayscale16);
    const auto table = level_table(levels, 65536);
    QImage out(image.size(), QImage::Format_Grayscale8);
    for (int y = 0; y < image.height(); ++y) {
      const auto* from = reinterpret_cast<const quint16*>(deep.constScanLine(y));
      uchar* to = out.scanLine(y);
      for (int x = 0; x < image.width(); ++x) to[x] = table[from[x]];
    }
    return out;
  }
  QImage out = image.convertToFormat(QImage::Format_RGB32);
  if (levels.black == 0.0 && levels.white == 1.0) return out;  // Shares the image's memory.
  const auto table = level_table(levels, 256);
  for (int y = 0; y < out.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(out.scanLine(y));
    for (int x = 0; x < out.width(); ++x) {
      line[x] = qRgb(table[static_cast<std::size_t>(qRed(line[x]))],
                     table[static_cast<std::size_t>(qGreen(line[x]))],
                     table[static_cast<std::size_t>(qBlue(line[x]))]);
    }
  }
  return out;
}

ImageLevels automatic_levels(const QImage& image) {
  if (image.isNull()) return {};
  std::vector<quint16> values;
  const int step = std::max(1, image.width() * image.height() / 200'000);
  const QImage deep = image.convertToFormat(QImage::Format_Grayscale16);
  int skip = 0;
  for (int y = 0; y < deep.height(); ++y) {
    const auto* line = reinterpret_cast<const quint16*>(deep.constScanLine(y));
    for (int x = 0; x < deep.width(); ++x) {
      if (skip-- > 0) continue;
      skip = step - 1;
      values.push_back(line[x]);
    }
  }
  const auto at = [&](double share) {
    auto place = values.begin() +
                 static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place) / kFull16;
  };
  ImageLevels levels{at(0.005), at(0.995)};
  if (levels.white - levels.black < 1.0 / 255.0) levels = {};
  return levels;
}

}  // namespace lvcalib::widgets
