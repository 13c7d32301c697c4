// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "support/corruption_kinds.h"

namespace lvcalib::test {
namespace {

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

}  // namespace

void add_camera_kinds(Kinds& all) {
  add_focal_lengths(all);
  add_principal_points(all);
  add_lenses(all);
  add_other_cameras(all);
}

}  // namespace lvcalib::test
