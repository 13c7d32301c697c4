// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <Eigen/Geometry>

#include "base/random.h"
#include "support/corruption_tools.h"

namespace lvcalib::test {
namespace {
using simulation::SimulatedImage;
using simulation::SimulatedRig;
using simulation::SimulatedScene;

using Words = std::vector<std::string>;
using Kinds = std::vector<Corruption>;
using Family = CorruptionFamily;

template <typename... T>
std::string named(const char* format, T... values) {
  char text[120];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// --- The camera's file -------------------------------------------------------------------------

const Words kFocal{"focal length"};
const Words kPrincipal{"principal point"};
const Words kLens{"distortion"};

Corruption camera(std::string name, Words words, std::function<void(Camera&)> change) {
  return {std::move(name), std::move(words), [change](CorruptedRig& c) { change(c.rig.camera); },
          Family::kCamera};
}

void add_focal_lengths(Kinds& all) {
  for (const double p : {0.3, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0}) {
    for (const double sign : {1.0, -1.0}) {
      all.push_back(camera(named("focal %+g %%", sign * p), kFocal, [=](Camera& c) {
        c.fx *= 1.0 + 0.01 * sign * p;
        c.fy *= 1.0 + 0.01 * sign * p;
      }));
    }
  }
  for (const double p : {-2.0, -1.0, 1.0, 2.0, 5.0}) {
    all.push_back(camera(named("only fx %+g %%", p), {"focal length", "fx"},
                         [=](Camera& c) { c.fx *= 1.0 + 0.01 * p; }));
    all.push_back(camera(named("only fy %+g %%", p), {"focal length", "fy"},
                         [=](Camera& c) { c.fy *= 1.0 + 0.01 * p; }));
  }
}

void add_principal_points(Kinds& all) {
  const std::vector<std::pair<double, double>> shifts{
      {2, 0},  {5, 0},  {-5, 0},  {0, 5},   {0, -5}, {10, 0},  {0, 10},   {-10, 10},
      {20, 0}, {0, 20}, {-36, 0}, {25, 25}, {60, 0}, {0, -60}, {-100, 40}};
  for (const auto& [x, y] : shifts) {
    all.push_back(
        camera(named("principal point %+g %+g px", x, y), kPrincipal, [x = x, y = y](Camera& c) {
          c.cx += x;
          c.cy += y;
        }));
  }
  all.push_back(camera("principal point in the image's corner", {"principal point", "camera.yaml"},
                       [](Camera& c) { c.cx = c.cy = 1.0; }));
  all.push_back(
      camera("cx and cy exchanged", kPrincipal, [](Camera& c) { std::swap(c.cx, c.cy); }));
}

void add_lenses(Kinds& all) {
  all.push_back(camera("distortion dropped", kLens, [](Camera& c) { c.distortion.setZero(); }));
  for (const double s : {-1.0, 0.5, 0.8, 1.2, 1.5, 2.0}) {
    all.push_back(
        camera(named("distortion times %g", s), kLens, [=](Camera& c) { c.distortion *= s; }));
  }
  all.push_back(camera("k1 and k2 exchanged", kLens,
                       [](Camera& c) { std::swap(c.distortion(0), c.distortion(1)); }));
  all.push_back(camera("k2 dropped", kLens, [](Camera& c) { c.distortion(1) = 0.0; }));
  all.push_back(
      camera("k2 with the other sign", kLens, [](Camera& c) { c.distortion(1) *= -1.0; }));
  all.push_back(camera("tangential distortion dropped", kLens,
                       [](Camera& c) { c.distortion(2) = c.distortion(3) = 0.0; }));
  all.push_back(camera("k3 where p1 should be", kLens, [](Camera& c) {
    const double k3 = c.distortion(4);
    c.distortion(4) = c.distortion(3);
    c.distortion(3) = c.distortion(2);
    c.distortion(2) = k3;
  }));
  all.push_back(camera("p1 p2 before k1 k2", {"distortion", "focal length", "principal point"},
                       [](Camera& c) {
                         std::swap(c.distortion(0), c.distortion(2));
                         std::swap(c.distortion(1), c.distortion(3));
                       }));
  all.push_back(camera("coefficients under the fisheye model's name", {"distortion", "intrinsics"},
                       [](Camera& c) {
                         c.model = DistortionModel::kEquidistant;
                         c.distortion.tail<4>().setZero();
                       }));
}

void add_other_cameras(Kinds& all) {
  for (const double s : {0.5, 2.0}) {
    all.push_back(camera(named("intrinsics of the image at %g times the size", s),
                         {"focal length", "intrinsics", "size", "camera.yaml"}, [=](Camera& c) {
                           c.fx *= s;
                           c.fy *= s;
                           c.cx = s * (c.cx + 0.5) - 0.5;
                           c.cy = s * (c.cy + 0.5) - 0.5;
                         }));
  }
  all.push_back(camera("camera of another rig", {"intrinsics"}, [](Camera& c) {
    c.fx *= 1.043;
    c.fy *= 1.041;
    c.cx -= 11.0;
    c.cy += 8.0;
    c.distortion(0) -= 0.04;
    c.distortion(1) += 0.03;
  }));
  all.push_back(
      camera("camera.yaml says another size of the image", {"pixels", "size"}, [](Camera& c) {
        c.width_px += 160;
        c.height_px += 100;
      }));
}

// --- Clouds ------------------------------------------------------------------------------------

const Words kMirror{"mirror"};

// Changes every point; a change that is rigid moves the truth along.
Corruption points(std::string name, Words words, const Eigen::Matrix3d& by) {
  return {std::move(name), std::move(words),
          [by](CorruptedRig& c) {
            for (SimulatedScene& scene : c.rig.scenes) {
              for (Eigen::Vector3f& p : scene.cloud.points_m)
                p = (by * p.cast<double>()).cast<float>();
            }
            const bool rigid = (by.transpose() * by - Eigen::Matrix3d::Identity()).norm() < 1e-9 &&
                               by.determinant() > 0.0;
            c.truth.reset();
            if (rigid) {
              c.truth =
                  c.rig.camera_from_lidar *
                  Rigid3::from_matrix(Eigen::Matrix3d(by.transpose()), Eigen::Vector3d::Zero());
            }
          },
          Family::kCloud};
}

Eigen::Matrix3d diagonal(double x, double y, double z) {
  return Eigen::Vector3d(x, y, z).asDiagonal();
}

// Every cloud by a function of its own.
Corruption clouds(std::string name, Words words, std::function<void(Cloud&, Random&)> change) {
  return {std::move(name), std::move(words),
          [change](CorruptedRig& c) {
            Random random(c.rig.options.seed, 991);
            for (SimulatedScene& scene : c.rig.scenes) change(scene.cloud, random);
          },
          Family::kCloud};
}

Corruption ranges(std::string name, Words words, std::function<double(double, Random&)> change) {
  return clouds(std::move(name), std::move(words), [change](Cloud& cloud, Random& random) {
    for (Eigen::Vector3f& p : cloud.points_m) {
      const double r = static_cast<double>(p.norm());
      p *= static_cast<float>(change(r, random) / r);
    }
  });
}

Corruption intensities(std::string name, Words words,
                       std::function<double(double, Random&)> change) {
  return clouds(std::move(name), std::move(words), [change](Cloud& cloud, Random& random) {
    for (float& v : cloud.intensity) v = static_cast<float>(change(static_cast<double>(v), random));
  });
}

void add_frames(Kinds& all) {
  const std::vector<std::pair<const char*, double>> units{
      {"millimetres", 1e3}, {"centimetres", 1e2}, {"feet", 1 / 0.3048}, {"inches", 1 / 0.0254}};
  for (const auto& [unit, s] : units)
    all.push_back(points(named("cloud in %s", unit), {unit}, diagonal(s, s, s)));
  all.push_back(points("cloud mirrored in x", kMirror, diagonal(-1, 1, 1)));
  all.push_back(points("cloud mirrored in y", kMirror, diagonal(1, -1, 1)));
  all.push_back(points("cloud mirrored in z", kMirror, diagonal(1, 1, -1)));
  const std::vector<std::array<int, 3>> orders{{1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
  const char* names[] = {"x and y exchanged", "y and z exchanged", "x and z exchanged"};
  for (std::size_t k = 0; k < orders.size(); ++k) {
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    for (int r = 0; r < 3; ++r) m(r, orders[k][static_cast<std::size_t>(r)]) = 1.0;
    all.push_back(points(names[k], kMirror, m));
  }
  Eigen::Matrix3d cycle;
  cycle << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  all.push_back(points("axes renamed in a circle (rigid)", {}, cycle));
  all.push_back(points("turned by half a turn (rigid)", {}, diagonal(-1, -1, 1)));
  for (const double p : {0.5, 1.0, 2.0, 5.0}) {
    for (const double sign : {1.0, -1.0}) {
      const double s = 1.0 + 0.01 * sign * p;
      all.push_back(points(named("cloud scaled by %+g %%", sign * p), {"larger", "smaller", "size"},
                           diagonal(s, s, s)));
    }
  }
  for (const double p : {1.0, 3.0}) {
    const double s = 1.0 + 0.01 * p;
    all.push_back(points(named("x stretched by %g %%", p), {}, diagonal(s, 1, 1)));
    all.push_back(points(named("y stretched by %g %%", p), {}, diagonal(1, s, 1)));
    all.push_back(points(named("z stretched by %g %%", p), {}, diagonal(1, 1, s)));
  }
}

void add_ranges(Kinds& all) {
  for (const double mm : {5.0, 10.0, 30.0, -30.0, 100.0}) {
    all.push_back(
        ranges(named("ranges %+g mm", mm), {}, [=](double r, Random&) { return r + 1e-3 * mm; }));
  }
  for (const double mm : {20.0, 40.0, 80.0}) {
    all.push_back(ranges(named("range noise of %g mm", mm), {}, [=](double r, Random& random) {
      return r + 1e-3 * mm * random.normal();
    }));
  }
  for (const double mm : {5.0, 20.0, 50.0}) {
    all.push_back(ranges(named("ranges in steps of %g mm", mm), {}, [=](double r, Random&) {
      return 1e-3 * mm * std::max(1.0, std::round(1e3 * r / mm));
    }));
    all.push_back(
        clouds(named("coordinates in steps of %g mm", mm), {"rounded"}, [=](Cloud& c, Random&) {
          for (Eigen::Vector3f& p : c.points_m)
            p = (1e3F / static_cast<float>(mm) * p).array().round() * static_cast<float>(mm) / 1e3F;
        }));
  }
  all.push_back(clouds("directions in steps of 0.2°", {}, [](Cloud& c, Random&) {
    constexpr double kStep = 0.2 * M_PI / 180.0;
    for (Eigen::Vector3f& p : c.points_m) {
      const Eigen::Vector3d q = p.cast<double>();
      const double r = q.norm();
      const double azimuth = kStep * std::round(std::atan2(q.y(), q.x()) / kStep);
      const double elevation = kStep * std::round(std::asin(q.z() / r) / kStep);
      p = (r * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                               std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
              .cast<float>();
    }
  }));
}

void add_returns(Kinds& all) {
  for (const double share : {0.5, 0.8, 0.95, 0.99}) {
    all.push_back(
        clouds(named("%g %% of the returns lost", 100 * share), {}, [=](Cloud& c, Random& random) {
          c = selected(c, [&](std::size_t) { return random.uniform() > share; });
        }));
  }
  all.push_back(clouds("only every fourth stretch of a hundred returns", {}, [](Cloud& c, Random&) {
    c = selected(c, [](std::size_t k) { return k / 100 % 4 == 0; });
  }));
  all.push_back(clouds("dark returns lost", {}, [](Cloud& c, Random&) {
    c = selected(c, [&](std::size_t k) { return c.intensity[k] > 40.0F; });
  }));
  all.push_back(clouds("cloud cut off beyond 2.5 m", {}, [](Cloud& c, Random&) {
    c = selected(c, [&](std::size_t k) { return c.points_m[k].norm() < 2.5F; });
  }));
  all.push_back(clouds("no points but five", {"points"}, [](Cloud& c, Random&) {
    c = selected(c, [](std::size_t k) { return k < 5; });
  }));
  for (const int times : {2, 5}) {
    all.push_back(clouds(named("every return %d times", times), {}, [=](Cloud& c, Random&) {
      const Cloud once = c;
      for (int k = 1; k < times; ++k) {
        c.points_m.insert(c.points_m.end(), once.points_m.begin(), once.points_m.end());
        c.intensity.insert(c.intensity.end(), once.intensity.begin(), once.intensity.end());
        c.time_s.insert(c.time_s.end(), once.time_s.begin(), once.time_s.end());
        c.line.insert(c.line.end(), once.line.begin(), once.line.end());
      }
    }));
  }
  all.push_back(clouds("lines shuffled", {}, [](Cloud& c, Random& random) {
    for (std::size_t k = c.line.size(); k > 1; --k)
      std::swap(c.line[k - 1], c.line[random.below(static_cast<std::uint32_t>(k))]);
  }));
  all.push_back(clouds("times shuffled", {}, [](Cloud& c, Random& random) {
    for (std::size_t k = c.time_s.size(); k > 1; --k)
      std::swap(c.time_s[k - 1], c.time_s[random.below(static_cast<std::uint32_t>(k))]);
  }));
  all.push_back(clouds("points shuffled", {}, [](Cloud& c, Random& random) {
    for (std::size_t k = c.size(); k > 1; --k) {
      const std::size_t j = random.below(static_cast<std::uint32_t>(k));
      std::swap(c.points_m[k - 1], c.points_m[j]);
      if (c.has_intensity()) std::swap(c.intensity[k - 1], c.intensity[j]);
      if (c.has_time()) std::swap(c.time_s[k - 1], c.time_s[j]);
      if (c.has_line()) std::swap(c.line[k - 1], c.line[j]);
    }
  }));
  all.push_back(clouds("no times and no lines", {}, [](Cloud& c, Random&) {
    c.time_s.clear();
    c.line.clear();
  }));
}

void add_intensities(Kinds& all) {
  const Words none{"intensity", "intensities", "print"};
  all.push_back(clouds("no intensity", none, [](Cloud& c, Random&) { c.intensity.clear(); }));
  for (const double v : {0.0, 7.0, -3.0}) {
    all.push_back(
        intensities(named("intensity %g everywhere", v), none, [=](double, Random&) { return v; }));
  }
  all.push_back(intensities("intensity of noise alone", none,
                            [](double, Random& random) { return 100.0 + 10.0 * random.normal(); }));
  all.push_back(clouds("intensities shuffled", none, [](Cloud& c, Random& random) {
    for (std::size_t k = c.intensity.size(); k > 1; --k)
      std::swap(c.intensity[k - 1], c.intensity[random.below(static_cast<std::uint32_t>(k))]);
  }));
  all.push_back(clouds("intensities late by 300 returns", none, [](Cloud& c, Random&) {
    std::rotate(c.intensity.begin(), c.intensity.end() - 300, c.intensity.end());
  }));
  for (const int levels : {2, 3, 4, 8, 16}) {
    all.push_back(intensities(named("intensity in %d levels", levels), {}, [=](double v, Random&) {
      return std::floor(std::clamp(v, 0.0, 159.9) * levels / 160.0);
    }));
  }
  for (const double ceiling : {20.0, 60.0, 100.0}) {
    all.push_back(intensities(named("intensity saturated at %g", ceiling), {"saturated", "print"},
                              [=](double v, Random&) { return std::min(v, ceiling); }));
  }
  all.push_back(intensities("intensity inverted", {}, [](double v, Random&) { return 200.0 - v; }));
  all.push_back(intensities("intensity negative", {}, [](double v, Random&) { return v - 400.0; }));
  all.push_back(intensities("intensity squared", {}, [](double v, Random&) { return v * v; }));
  all.push_back(intensities("logarithm of the intensity", {},
                            [](double v, Random&) { return std::log(1.0 + std::max(0.0, v)); }));
  all.push_back(intensities("intensity noise of 60", {},
                            [](double v, Random& random) { return v + 60.0 * random.normal(); }));
  all.push_back(intensities("a tenth of the intensities wild", {}, [](double v, Random& random) {
    return random.uniform() < 0.1 ? 1e6 * random.uniform() : v;
  }));
  all.push_back(intensities(
      "a tenth of the intensities not a number", {},
      [](double v, Random& random) { return random.uniform() < 0.1 ? std::nan("") : v; }));
  all.push_back(clouds("gain changes by half during the scan", {}, [](Cloud& c, Random&) {
    for (std::size_t k = 0; k < c.intensity.size(); ++k) {
      c.intensity[k] *=
          1.0F + 0.5F * static_cast<float>(k) / static_cast<float>(c.intensity.size());
    }
  }));
}

// --- Images ------------------------------------------------------------------------------------

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

// --- The board and its description -------------------------------------------------------------

Corruption target(std::string name, Words words, std::function<void(Target&)> change) {
  return {std::move(name), std::move(words), [change](CorruptedRig& c) { change(c.rig.target); },
          Family::kTarget};
}

Corruption print(std::string name, Words words, std::function<PrintSource(const Target&)> source,
                 bool has_truth = true) {
  return {std::move(name), std::move(words),
          [source, has_truth](CorruptedRig& c) {
            reprint(c, source(c.rig.target));
            if (!has_truth) c.truth.reset();
          },
          Family::kTarget};
}

void add_descriptions(Kinds& all) {
  for (const double s :
       {0.5, 0.8, 0.95, 0.98, 0.99, 0.995, 0.997, 1.003, 1.005, 1.01, 1.02, 1.05, 1.1, 1.2, 2.0}) {
    all.push_back(target(named("board %g times as large in target.yaml", s), {"size", "tagSize"},
                         [s](Target& t) {
                           t.tag_size_m *= s;
                           t.circle_radius_m *= s;
                           t.margin_m *= s;
                         }));
  }
  // Refused when it is read, or found by looking for the board in other sizes.
  const std::vector<std::pair<const char*, double>> units{
      {"millimetres", 1e3}, {"centimetres", 1e2}, {"inches", 1 / 0.0254}, {"feet", 1 / 0.3048}};
  for (const auto& [unit, s] : units) {
    const Words words = s > 500.0 ? Words{"lengths are in metres"} : Words{unit};
    all.push_back(target(named("target.yaml in %s", unit), words, [s = s](Target& t) {
      t.tag_size_m *= s;
      t.circle_radius_m *= s;
      t.margin_m *= s;
    }));
  }
  // The tags' pitch kept: squares of 118.8 mm where the file says 120.
  for (const double s : {0.95, 0.99, 1.01, 1.05}) {
    all.push_back(target(named("tags %g times as large, pitch kept", s), {"tagSize", "tagSpacing"},
                         [s](Target& t) {
                           const double pitch = t.tag_pitch_m();
                           t.tag_size_m *= s;
                           t.tag_spacing = pitch / t.tag_size_m - 1.0;
                         }));
  }
  for (const double p : {-10.0, -3.0, -1.0, 1.0, 3.0}) {
    all.push_back(target(named("tag spacing %+g %%", p), {"tagSpacing"},
                         [p](Target& t) { t.tag_spacing *= 1.0 + 0.01 * p; }));
  }
  for (const double p : {-30.0, -10.0, -5.0, 5.0}) {
    all.push_back(target(named("circle radius %+g %%", p), {"circleRadius"},
                         [p](Target& t) { t.circle_radius_m *= 1.0 + 0.01 * p; }));
  }
  for (const double mm : {-30.0, 30.0, 100.0}) {
    all.push_back(target(named("margin %+g mm", mm), {"margin"},
                         [mm](Target& t) { t.margin_m += 1e-3 * mm; }));
  }
  all.push_back(
      target("no circles in target.yaml", {}, [](Target& t) { t.type = TargetType::kAprilGrid; }));
  for (const int first : {1, 4, 100}) {
    all.push_back(target(named("ids from %d", first), {"firstTagId"},
                         [first](Target& t) { t.first_tag_id = first; }));
  }
  for (const char* family : {"tag25h9", "tag36h10", "tag16h5"}) {
    all.push_back(target(named("family %s", family), {"tag36h11"},
                         [family](Target& t) { t.tag_family = family; }));
  }
  all.push_back(
      target("five columns of tags", {"tagCols", "columns"}, [](Target& t) { t.tag_columns = 5; }));
  all.push_back(target("three columns of tags", {"tagCols", "columns"},
                       [](Target& t) { t.tag_columns = 3; }));
  all.push_back(
      target("five rows of tags", {"tagRows", "rows"}, [](Target& t) { t.tag_rows = 5; }));
  all.push_back(
      target("three rows of tags", {"tagRows", "rows"}, [](Target& t) { t.tag_rows = 3; }));
  all.push_back(
      target("border of two bits", {"tagBorder"}, [](Target& t) { t.tag_border_bits = 2; }));
}

void add_prints(Kinds& all) {
  all.push_back(print(
      "print mirrored", {"mirror"},
      [](const Target& t) -> PrintSource {
        const double middle = t.outline().center_m().x();
        return [=](const Eigen::Vector2d& p) { return Eigen::Vector2d(2 * middle - p.x(), p.y()); };
      },
      false));
  all.push_back(print(
      "ids from the other end", {"ids", "turned"},
      [](const Target& t) {
        return other_tags(
            t, [=](int c, int r) { return std::pair(t.tag_columns - 1 - c, t.tag_rows - 1 - r); },
            false);
      },
      false));
  all.push_back(print(
      "every tag turned by 180°", {"turned", "upside down"},
      [](const Target& t) {
        return other_tags(
            t, [](int c, int r) { return std::pair(c, r); }, true);
      },
      false));
  all.push_back(print(
      "ids from the top row", {"ids", "rows"},
      [](const Target& t) {
        return other_tags(
            t, [=](int c, int r) { return std::pair(c, t.tag_rows - 1 - r); }, false);
      },
      false));
  all.push_back(print(
      "ids along the columns", {"ids", "columns"},
      [](const Target& t) {
        return other_tags(
            t, [](int c, int r) { return std::pair(r, c); }, false);
      },
      false));
  all.push_back(print("two tags exchanged", {}, [](const Target& t) {
    return other_tags(
        t,
        [](int c, int r) {
          return c == 0 && r == 0   ? std::pair(1, 0)
                 : c == 1 && r == 0 ? std::pair(0, 0)
                                    : std::pair(c, r);
        },
        false);
  }));
  all.push_back(
      print("print 4 mm off its place on the board", {}, [](const Target&) -> PrintSource {
        return [](const Eigen::Vector2d& p) { return Eigen::Vector2d(p.x() - 0.004, p.y()); };
      }));
  all.push_back(print("white boards", {"image"}, [](const Target&) -> PrintSource {
    return [](const Eigen::Vector2d&) { return std::optional<Eigen::Vector2d>(); };
  }));
  all.push_back({"print invisible to the LiDAR",
                 {"contrast"},
                 [](CorruptedRig& c) {
                   Random random(c.rig.options.seed, 992);
                   for (SimulatedScene& scene : c.rig.scenes) {
                     for (std::size_t k = 0; k < scene.cloud.size(); ++k) {
                       if (on_board(scene, c.rig.target, scene.cloud.points_m[k]))
                         scene.cloud.intensity[k] = static_cast<float>(random.normal(120.0, 4.0));
                     }
                   }
                 },
                 Family::kTarget});
}

// --- rig.yaml ----------------------------------------------------------------------------------

Corruption guess(std::string name, Words words, std::function<std::string(const Rigid3&)> text) {
  return {std::move(name), std::move(words),
          [text](CorruptedRig& c) { c.rig_yaml = text(c.rig.camera_from_lidar); }, Family::kRough,
          MustSay::kAlways};
}

Rigid3 moved(double x_m, double turn_deg) {
  const double angle = turn_deg * M_PI / 180.0;
  Vector6d xi = Vector6d::Zero();
  xi(0) = x_m;
  xi(4) = angle;
  return se3_exp(xi);
}

void add_guesses(Kinds& all) {
  all.push_back(guess("rig.yaml right", {}, [](const Rigid3& t) { return rig_text(t, 1.0); }));
  all.push_back(guess("rig.yaml off by 0.1 m and 5°", {},
                      [](const Rigid3& t) { return rig_text(moved(0.1, 5.0) * t, 1.0); }));
  all.push_back(guess("rig.yaml inverse", {"inverse"},
                      [](const Rigid3& t) { return rig_text(t.inverse(), 1.0); }));
  all.push_back(guess("rig.yaml identity", {"identity"},
                      [](const Rigid3&) { return rig_text(Rigid3(), 1.0); }));
  all.push_back(guess("rig.yaml in millimetres", {"millimetres"},
                      [](const Rigid3& t) { return rig_text(t, 1e3); }));
  all.push_back(guess("rig.yaml inverse in millimetres", {"millimetres"},
                      [](const Rigid3& t) { return rig_text(t.inverse(), 1e3); }));
  const Words off{"rough extrinsic"};
  all.push_back(guess("rig.yaml off by 2 m", off,
                      [](const Rigid3& t) { return rig_text(moved(2.0, 0.0) * t, 1.0); }));
  all.push_back(guess("rig.yaml turned by 60°", off,
                      [](const Rigid3& t) { return rig_text(moved(0.0, 60.0) * t, 1.0); }));
  all.push_back(guess("rig.yaml turned by 180°", off,
                      [](const Rigid3& t) { return rig_text(moved(0.0, 180.0) * t, 1.0); }));
  all.push_back(guess("rig.yaml with the axes of the LiDAR's body", off, [](const Rigid3& t) {
    Eigen::Matrix3d axes;
    axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    return rig_text(t * Rigid3::from_matrix(axes, Eigen::Vector3d::Zero()), 1.0);
  }));
}

// --- Scenes against each other -----------------------------------------------------------------

Corruption scenes(std::string name, Words words, std::function<void(CorruptedRig&)> change,
                  std::size_t fewest = 3) {
  return {std::move(name), std::move(words),      std::move(change),
          Family::kScenes, MustSay::kUnlessRight, {},
          fewest};
}

void add_repeats(Kinds& all) {
  const auto copies = [](int times) {
    return [times](CorruptedRig& c) {
      for (int k = 1; k < times; ++k)
        c.copies.emplace_back(c.rig.scenes[0].name, "Z" + std::to_string(k));
    };
  };
  for (const int times : {2, 3, 5, 9}) {
    all.push_back(scenes(named("a scene %d times", times), {"same files"}, copies(times), 1));
    all.back().must_say = MustSay::kAlways;
  }
  const Words few{"only one usable scene", "same files", "one scene"};
  all.push_back(scenes("one scene alone", {"only one usable scene"},
                       [](CorruptedRig& c) { c.rig.scenes.resize(1); }));
  all.push_back(scenes(
      "one scene alone, nine times", {"same files"},
      [](CorruptedRig& c) {
        c.rig.scenes.resize(1);
        for (int k = 1; k < 9; ++k)
          c.copies.emplace_back(c.rig.scenes[0].name, "Z" + std::to_string(k));
      },
      1));
  all.push_back(
      scenes("two scenes", {"two scenes"}, [](CorruptedRig& c) { c.rig.scenes.resize(2); }));
}

void add_strays(Kinds& all) {
  const Words images_wrong{"exchanged", "belong", "agree", "contradict"};
  all.push_back(scenes("clouds of two scenes exchanged", images_wrong, [](CorruptedRig& c) {
    std::swap(c.rig.scenes[0].cloud, c.rig.scenes[1].cloud);
  }));
  all.push_back(scenes("images of two scenes exchanged", images_wrong, [](CorruptedRig& c) {
    std::swap(c.rig.scenes[0].image, c.rig.scenes[1].image);
  }));
  all.push_back(scenes("images of all scenes passed on by one", images_wrong, [](CorruptedRig& c) {
    for (std::size_t k = 0; k + 1 < c.rig.scenes.size(); ++k)
      std::swap(c.rig.scenes[k].image, c.rig.scenes[k + 1].image);
    c.truth.reset();
  }));
  all.push_back(scenes("all clouds of the first scene", {"same cloud"}, [](CorruptedRig& c) {
    for (SimulatedScene& scene : c.rig.scenes) scene.cloud = c.rig.scenes[0].cloud;
    c.truth.reset();
  }));
  all.push_back(scenes("all images of the first scene", {"same image"}, [](CorruptedRig& c) {
    for (SimulatedScene& scene : c.rig.scenes) scene.image = c.rig.scenes[0].image;
    c.truth.reset();
  }));
  all.push_back(
      scenes("last scene's cloud is that of the one before", {"same cloud"}, [](CorruptedRig& c) {
        const std::size_t n = c.rig.scenes.size();
        c.rig.scenes[n - 1].cloud = c.rig.scenes[n - 2].cloud;
      }));
  all.push_back(
      scenes("last scene's image is that of the one before", {"same image"}, [](CorruptedRig& c) {
        const std::size_t n = c.rig.scenes.size();
        c.rig.scenes[n - 1].image = c.rig.scenes[n - 2].image;
      }));
  all.push_back(scenes("last scene's image black", {"not found in the image", "no tag", "image"},
                       [](CorruptedRig& c) {
                         for (std::uint8_t& p : c.rig.scenes.back().image.pixels) p = 0;
                       }));
  all.back().must_say = MustSay::kAlways;
  all.push_back(scenes("last scene's cloud without the board", {"not found in the cloud"},
                       [](CorruptedRig& c) {
                         SimulatedScene& s = c.rig.scenes.back();
                         s.cloud = selected(s.cloud, [&](std::size_t k) {
                           return !on_board(s, c.rig.target, s.cloud.points_m[k]);
                         });
                       }));
  all.back().must_say = MustSay::kAlways;
}

void add_bumps(Kinds& all) {
  const Words words{"mov", "contradict", "bump"};
  for (const double mm : {2.0, 5.0, 10.0, 20.0, 50.0}) {
    Vector6d xi = Vector6d::Zero();
    xi.head<3>() = 1e-3 * mm * Eigen::Vector3d(0.48, 0.6, 0.64);
    const Rigid3 motion = se3_exp(xi);
    all.push_back(scenes(named("rig bumped by %g mm before the last scene", mm), words,
                         [motion](CorruptedRig& c) { bump(c, c.rig.scenes.size() - 1, motion); }));
    all.push_back(scenes(
        named("rig bumped by %g mm halfway", mm), words,
        [motion](CorruptedRig& c) { bump(c, (c.rig.scenes.size() + 1) / 2, motion); }, 4));
  }
  for (const double mrad : {2.0, 5.0, 10.0, 20.0}) {
    Vector6d xi = Vector6d::Zero();
    xi.tail<3>() = 1e-3 * mrad * Eigen::Vector3d(0.48, 0.6, 0.64);
    const Rigid3 motion = se3_exp(xi);
    all.push_back(scenes(named("rig turned by %g mrad before the last scene", mrad), words,
                         [motion](CorruptedRig& c) { bump(c, c.rig.scenes.size() - 1, motion); }));
    all.push_back(scenes(
        named("rig turned by %g mrad halfway", mrad), words,
        [motion](CorruptedRig& c) { bump(c, (c.rig.scenes.size() + 1) / 2, motion); }, 4));
  }
  for (const double mm : {3.0, 10.0, 25.0, 50.0}) {
    for (const bool along : {true, false}) {
      all.push_back(scenes(named(along ? "first board pushed along itself by %g mm after the image"
                                       : "first board pushed back by %g mm after the image",
                                 mm),
                           words, [=](CorruptedRig& c) {
                             SimulatedScene& s = c.rig.scenes.front();
                             const Eigen::Vector3d axis =
                                 s.lidar_from_board.rotation *
                                 Eigen::Vector3d(along ? 1 : 0, 0, along ? 0 : 1);
                             for (Eigen::Vector3f& p : s.cloud.points_m) {
                               if (on_board(s, c.rig.target, p))
                                 p += (1e-3 * mm * axis).cast<float>();
                             }
                           }));
    }
  }
  for (const double mm : {2.0, 5.0}) {
    Vector6d xi = Vector6d::Zero();
    xi(1) = 1e-3 * mm;
    const Rigid3 motion = se3_exp(xi);
    all.push_back(scenes(named("rig drifts by %g mm from scene to scene", mm), words,
                         [motion](CorruptedRig& c) {
                           for (std::size_t k = 1; k < c.rig.scenes.size(); ++k) bump(c, k, motion);
                         }));
  }
}

void add_covers(Kinds& all) {
  for (const double share : {0.2, 0.4, 0.6, 0.8}) {
    all.push_back(scenes(named("%g %% of one board covered", 100 * share), {},
                         [=](CorruptedRig& c) { cover(c, 0, share, true, true); }));
    all.push_back(scenes(named("%g %% of every board covered for the LiDAR", 100 * share),
                         share > 0.5 ? Words{"covers", "% of the board", "not found"} : Words{},
                         [=](CorruptedRig& c) {
                           for (std::size_t s = 0; s < c.rig.scenes.size(); ++s)
                             cover(c, s, share, true, false);
                         }));
  }
  all.push_back(scenes("60 % of every board covered in the images", {}, [](CorruptedRig& c) {
    for (std::size_t s = 0; s < c.rig.scenes.size(); ++s) cover(c, s, 0.6, false, true);
  }));
  all.push_back(scenes("a second board in every cloud", {"second board"}, [](CorruptedRig& c) {
    for (SimulatedScene& s : c.rig.scenes) {
      const Eigen::AngleAxisf aside(0.6F, Eigen::Vector3f::UnitZ());
      const std::size_t n = s.cloud.size();
      std::vector<std::size_t> board;
      for (std::size_t k = 0; k < n; ++k) {
        if (on_board(s, c.rig.target, s.cloud.points_m[k])) board.push_back(k);
      }
      for (const std::size_t k : board) {
        s.cloud.points_m.push_back(aside * s.cloud.points_m[k]);
        if (s.cloud.has_intensity()) s.cloud.intensity.push_back(s.cloud.intensity[k]);
        if (s.cloud.has_time()) s.cloud.time_s.push_back(s.cloud.time_s[k]);
        if (s.cloud.has_line()) s.cloud.line.push_back(s.cloud.line[k]);
      }
    }
  }));
  all.push_back(scenes("a second board in every image", {"more than once", "two boards", "twice"},
                       [](CorruptedRig& c) {
                         for (SimulatedScene& s : c.rig.scenes) {
                           const SimulatedImage before = s.image;
                           const int half = before.width_px / 2;
                           // The side with the board, shown on the other side too.
                           const double x = c.rig.camera.project(s.camera_from_board.translation)
                                                .value_or(Eigen::Vector2d::Zero())
                                                .x();
                           const bool left = x < half;
                           s.image = mapped(
                               before, before.width_px, before.height_px, [&](int px, int py) {
                                 const bool copy = (px < half) != left;
                                 return std::pair(copy ? px + (left ? -half : half) : px, py);
                               });
                         }
                       }));
}

// --- Planted by the simulator ------------------------------------------------------------------

// A steadily turning scanner whose encoder is late by the same time throughout gives clouds of a
// frame that is turned about its axis. The truth for those clouds is the pose of that frame.
void turn_frame_by_lag(CorruptedRig& c) {
  if (c.rig.options.lidar.kind != simulation::LidarKind::kSpinning) return;
  constexpr double kTurnsPerSecond = 10.0;
  const double angle_rad =
      2.0 * std::numbers::pi * kTurnsPerSecond * 1e-6 * c.rig.options.effects.at("encoder_lag");
  const Rigid3 turned{Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ())),
                      Eigen::Vector3d::Zero()};
  c.truth = *c.truth * turned;
}

void add_planted(Kinds& all) {
  const std::vector<std::pair<const char*, std::vector<double>>> effects{
      {"scan_motion", {5, 20, 100}},
      {"encoder_lag", {5, 30}},
      {"detector_lag", {5, 20}},
      {"range_offset", {10, 20, 50}},
      {"range_scale", {500, 2000}},
      {"range_walk", {3, 10, 30}},
      {"range_incidence", {5, 20}},
      {"range_cyclic", {3, 10}},
      {"range_near", {30}},
      {"range_warmup", {10, 30}},
      {"range_drift", {20}},
      {"channel_range_offset", {10}},
      {"boundary_range_pull", {3}},
      {"angle_scale", {500, 2000}},
      {"encoder_eccentricity", {0.5, 2}},
      {"axis_wobble", {0.5, 2}},
      {"channel_angle_offset", {1}},
      {"beam_origin_offset", {3, 10}},
      {"boundary_bias", {2}},
      {"beam_divergence", {3}},
      {"footprint_anisotropy", {1}},
      {"footprint_offset", {0.3, 1}},
      {"blooming", {0.1}},
      {"intensity_geometry", {0.6}},
      {"intensity_nonlinearity", {0.7}},
      {"specular_lobe", {0.3, 1}},
      {"receiver_saturation", {10}},
      {"board_bow", {2, 5}},
      {"print_scale", {2000, 5000}},
      {"ink_gain", {0.4, 1}},
      {"intrinsics_error", {1000, 5000}},
      {"distortion_residual", {1, 5}},
      {"corner_bias", {0.2, 0.5}},
      {"rolling_shutter", {2, 10}},
      {"x_board_bump", {3}},
      {"x_azimuth_ripple", {3}},
      {"x_lens_flaw", {1}},
      {"x_window_smudge", {0.3}},
  };
  for (const auto& [id, values] : effects) {
    for (const double value : values) {
      Corruption planted{named("%s=%g", id, value)};
      planted.family = Family::kPlanted;
      planted.effects = {{id, value}};
      if (std::string(id) == "encoder_lag") planted.apply = turn_frame_by_lag;
      all.push_back(std::move(planted));
    }
  }
}

}  // namespace

std::vector<Corruption> corruptions() {
  Kinds all{{"clean"}};
  add_focal_lengths(all);
  add_principal_points(all);
  add_lenses(all);
  add_other_cameras(all);
  add_frames(all);
  add_ranges(all);
  add_returns(all);
  add_intensities(all);
  add_image_shapes(all);
  add_image_values(all);
  add_descriptions(all);
  add_prints(all);
  add_guesses(all);
  add_repeats(all);
  add_strays(all);
  add_bumps(all);
  add_covers(all);
  add_planted(all);
  return all;
}

}  // namespace lvcalib::test
