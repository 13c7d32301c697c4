// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/plot_colors.h"

namespace lvcalib::widgets {

QColor PlotColors::series(int index) const {
  // Evenly spread hues, starting at blue; lighter on dark ground.
  static constexpr int kHues[] = {212, 24, 140, 350, 268, 48, 185, 310, 90, 0};
  const int hue = kHues[static_cast<unsigned>(index) % 10U];
  const bool gray = static_cast<unsigned>(index) % 10U == 9U;
  const bool second = static_cast<unsigned>(index) / 10U % 2U == 1U;
  const int usual = dark ? 155 : 105;
  const int other = dark ? 205 : 65;
  return QColor::fromHsl(hue, gray ? 0 : 170, second ? other : usual);
}

PlotColors PlotColors::of(const QPalette& palette) {
  PlotColors c;
  c.background = palette.color(QPalette::Base);
  c.text = palette.color(QPalette::Text);
  c.dark = c.background.lightness() < 128;
  const auto mixed = [&](double share) {
    const auto mix = [&](int a, int b) { return static_cast<int>(a + share * (b - a)); };
    return QColor(mix(c.background.red(), c.text.red()), mix(c.background.green(), c.text.green()),
                  mix(c.background.blue(), c.text.blue()));
  };
  c.axis = mixed(0.6);
  c.grid = mixed(0.14);
  c.zero = mixed(0.45);
  c.fit = c.dark ? QColor(255, 176, 64) : QColor(208, 88, 0);
  c.mark = mixed(0.92);
  c.refused = c.dark ? QColor(255, 110, 110) : QColor(196, 30, 58);
  c.left_out = c.dark ? QColor(196, 130, 255) : QColor(134, 58, 204);
  c.fill = c.dark ? QColor(84, 132, 196) : QColor(122, 168, 222);
  c.emphasis = c.dark ? QColor(120, 200, 255) : QColor(0, 90, 190);
  return c;
}

}  // namespace lvcalib::widgets
