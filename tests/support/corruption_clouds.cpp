// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "support/corruption_kinds.h"

namespace lvcalib::test {
namespace {

using simulation::SimulatedScene;

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
  all.push_back(clouds(
      "intensities late by 300 returns",
      {"each intensity belongs to the point", "intensities do not follow"}, [](Cloud& c, Random&) {
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

}  // namespace

void add_cloud_kinds(Kinds& all) {
  add_frames(all);
  add_ranges(all);
  add_returns(all);
  add_intensities(all);
}

}  // namespace lvcalib::test
