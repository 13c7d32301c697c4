// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "base/random.h"
#include "support/corruption_kinds.h"

namespace lvcalib::test {
namespace {

using simulation::SimulatedImage;
using simulation::SimulatedScene;

Corruption images(std::string name, Words words,
                  std::function<SimulatedImage(const SimulatedImage&)> change,
                  bool has_truth = true) {
  return {std::move(name), std::move(words),
          [change, has_truth](CorruptedRig& c) {
            for (SimulatedScene& scene : c.rig.scenes) scene.image = change(scene.image);
            if (!has_truth) c.truth.reset();
          },
          Family::kImage};
}

void add_image_shapes(Kinds& all) {
  using I = const SimulatedImage&;
  all.push_back(images(
      "images mirrored", {"mirror"},
      [](I i) {
        return mapped(i, i.width_px, i.height_px,
                      [&](int x, int y) { return std::pair(i.width_px - 1 - x, y); });
      },
      false));
  all.push_back(images(
      "images upside down by mirroring", {"mirror"},
      [](I i) {
        return mapped(i, i.width_px, i.height_px,
                      [&](int x, int y) { return std::pair(x, i.height_px - 1 - y); });
      },
      false));
  all.push_back(images(
      "images turned by 180°", {"turned", "principal point"},
      [](I i) {
        return mapped(i, i.width_px, i.height_px, [&](int x, int y) {
          return std::pair(i.width_px - 1 - x, i.height_px - 1 - y);
        });
      },
      false));
  for (const bool left : {true, false}) {
    all.push_back(images(
        left ? "images turned by 90° to the left" : "images turned by 90° to the right",
        {"turned", "intrinsics"},
        [=](I i) {
          return mapped(i, i.height_px, i.width_px, [&](int x, int y) {
            return left ? std::pair(i.width_px - 1 - y, x) : std::pair(y, i.height_px - 1 - x);
          });
        },
        false));
  }
  all.push_back(images(
      "images at half size", {"intrinsics"},
      [](I i) {
        return mapped(i, i.width_px / 2, i.height_px / 2,
                      [](int x, int y) { return std::pair(2 * x, 2 * y); });
      },
      false));
  all.push_back(images(
      "images at twice the size", {"intrinsics"},
      [](I i) {
        return mapped(i, 2 * i.width_px, 2 * i.height_px,
                      [](int x, int y) { return std::pair(x / 2, y / 2); });
      },
      false));
  all.push_back(images(
      "images stretched to twice the width and cropped", {"focal", "intrinsics"},
      [](I i) {
        return mapped(i, i.width_px, i.height_px,
                      [&](int x, int y) { return std::pair((x + i.width_px / 2) / 2, y); });
      },
      false));
  const std::vector<std::pair<int, int>> shifts{{2, 0}, {5, 0}, {0, 10}, {30, 0}, {0, -40}};
  for (const auto& [dx, dy] : shifts) {
    all.push_back(
        images(named("images shifted by %+d %+d px", dx, dy), kPrincipal, [dx = dx, dy = dy](I i) {
          return mapped(i, i.width_px, i.height_px,
                        [&](int x, int y) { return std::pair(x - dx, y - dy); });
        }));
  }
  all.push_back(images("images cropped by 40 px on the left", {"intrinsics", "px"}, [](I i) {
    return mapped(i, i.width_px - 40, i.height_px,
                  [](int x, int y) { return std::pair(x + 40, y); });
  }));
  for (const double s : {0.97, 0.99, 1.01, 1.03, 1.1}) {
    all.push_back(
        images(named("images zoomed by %g", s), kFocal, [=](I i) { return zoomed(i, s); }));
  }
}

void add_image_values(Kinds& all) {
  using I = const SimulatedImage&;
  for (const double sigma : {1.5, 3.0, 6.0})
    all.push_back(images(named("images blurred by %g px", sigma), {},
                         [=](I i) { return blurred(i, sigma); }));
  for (const double gain : {0.1, 0.4, 1.4, 2.5, 8.0}) {
    all.push_back(images(named("images %g times as bright", gain), {},
                         [=](I i) { return revalued(i, [=](double v) { return gain * v; }); }));
  }
  for (const double sigma : {10.0, 30.0, 60.0}) {
    all.push_back(images(named("image noise of %g", sigma), {}, [=](I i) {
      Random random(17, static_cast<std::uint64_t>(sigma));
      return revalued(i, [&](double v) { return v + sigma * random.normal(); });
    }));
  }
  for (const double step : {10.0, 30.0, 80.0})
    all.push_back(images(named("images compressed, steps of %g", step), {},
                         [=](I i) { return blocky(i, step); }));
  all.push_back(images("images in four levels", {}, [](I i) {
    return revalued(i, [](double v) { return 80.0 * std::floor(v / 64.0); });
  }));
  all.push_back(images("images as negatives", {"image"},
                       [](I i) { return revalued(i, [](double v) { return 255.0 - v; }); }));
  all.push_back(images("images with gamma 2.2", {}, [](I i) {
    return revalued(i, [](double v) { return 255.0 * std::pow(v / 255.0, 1.0 / 2.2); });
  }));
  all.push_back(images("images black", {"image"},
                       [](I i) { return revalued(i, [](double) { return 0.0; }); }));
}

}  // namespace

void add_image_kinds(Kinds& all) {
  add_image_shapes(all);
  add_image_values(all);
}

}  // namespace lvcalib::test
