// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>

namespace lvcalib::widgets {

/// The grey values shown as black and as white, as shares of the image's full scale.
struct ImageLevels {
  double black = 0.0;
  double white = 1.0;
};

/// The image with its levels spread to the whole range, eight bits a channel; grey images, also of
/// 16 bits, stay grey.
QImage apply_levels(const QImage& image, const ImageLevels& levels);

/// Levels that show the central 99 % of the pixels with the most contrast.
ImageLevels automatic_levels(const QImage& image);

}  // namespace lvcalib::widgets
