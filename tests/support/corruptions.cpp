// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/corruptions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "base/random.h"
#include "report/result_file.h"
#include "simulation/dataset_writer.h"

namespace lvcalib::test {
namespace {
namespace fs = std::filesystem;
using simulation::SimulatedImage;
using simulation::SimulatedRig;

using Words = std::vector<std::string>;

Corruption camera(std::string name, Words words, std::function<void(Camera&)> change) {
  return {std::move(name), std::move(words), [change](CorruptedRig& c) { change(c.rig.camera); }};
}

Corruption focal(double percent) {
  char name[40];
  std::snprintf(name, sizeof name, "focal %+g %%", percent);
  return camera(name, {"focal length"}, [percent](Camera& c) {
    c.fx *= 1.0 + 0.01 * percent;
    c.fy *= 1.0 + 0.01 * percent;
  });
}

Corruption principal(double x, double y) {
  char name[60];
  std::snprintf(name, sizeof name, "principal point %+g %+g px", x, y);
  return camera(name, {"principal point"}, [x, y](Camera& c) {
    c.cx += x;
    c.cy += y;
  });
}

// Changes every point; a change that is rigid moves the truth along.
Corruption points(std::string name, Words words, const Eigen::Matrix3d& by) {
  return {std::move(name), std::move(words), [by](CorruptedRig& c) {
            for (auto& scene : c.rig.scenes) {
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
          }};
}

Corruption ranges(std::string name, Words words, std::function<double(double)> change,
                  bool has_truth = true) {
  return {std::move(name), std::move(words), [change, has_truth](CorruptedRig& c) {
            for (auto& scene : c.rig.scenes) {
              for (Eigen::Vector3f& p : scene.cloud.points_m) {
                const double r = static_cast<double>(p.norm());
                p *= static_cast<float>(change(r) / r);
              }
            }
            if (!has_truth) c.truth.reset();
          }};
}

Corruption intensities(std::string name, Words words, std::function<float(float)> change) {
  return {std::move(name), std::move(words), [change](CorruptedRig& c) {
            for (auto& scene : c.rig.scenes) {
              for (float& v : scene.cloud.intensity) v = change(v);
            }
          }};
}

Corruption images(std::string name, Words words,
                  std::function<SimulatedImage(const SimulatedImage&)> change, bool has_truth) {
  return {std::move(name), std::move(words), [change, has_truth](CorruptedRig& c) {
            for (auto& scene : c.rig.scenes) scene.image = change(scene.image);
            if (!has_truth) c.truth.reset();
          }};
}

// A pixel of the source for every pixel of an image of another size.
SimulatedImage mapped(const SimulatedImage& from, int width, int height,
                      const std::function<std::pair<int, int>(int, int)>& source) {
  SimulatedImage out{width, height, {}};
  out.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 128);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto [sx, sy] = source(x, y);
      if (sx < 0 || sy < 0 || sx >= from.width_px || sy >= from.height_px) continue;
      out.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)] =
          from.pixels[static_cast<std::size_t>(sy) * static_cast<std::size_t>(from.width_px) +
                      static_cast<std::size_t>(sx)];
    }
  }
  return out;
}

Corruption target(std::string name, Words words, std::function<void(Target&)> change) {
  return {std::move(name), std::move(words), [change](CorruptedRig& c) { change(c.rig.target); }};
}

void scale_board(Target& t, double s) {
  t.tag_size_m *= s;
  t.circle_radius_m *= s;
  t.margin_m *= s;
}

std::string rig_text(const Rigid3& pose, double unit) {
  std::string text = "T_camera_lidar: [";
  const Eigen::Matrix4d m = pose.matrix();
  for (int r = 0; r < 4; ++r) {
    text += r == 0 ? "[" : ", [";
    for (int k = 0; k < 4; ++k) {
      const double v = k == 3 && r < 3 ? unit * m(r, k) : m(r, k);
      text += (k == 0 ? "" : ", ") + std::to_string(v);
    }
    text += "]";
  }
  return text + "]\n";
}

Corruption guess(std::string name, Words words, std::function<std::string(const Rigid3&)> text) {
  return {std::move(name), std::move(words),
          [text](CorruptedRig& c) { c.rig_yaml = text(c.rig.camera_from_lidar); }};
}

void add_camera(std::vector<Corruption>& all) {
  for (const double p : {1.0, -1.0, 2.0, -2.0, 5.0, -5.0, 10.0, -10.0, 20.0, -20.0})
    all.push_back(focal(p));
  for (const auto& [x, y] : {std::pair(5.0, 0.0), std::pair(0.0, -5.0), std::pair(20.0, 0.0),
                             std::pair(0.0, 20.0), std::pair(-36.0, 0.0), std::pair(25.0, 25.0)})
    all.push_back(principal(x, y));
  all.push_back(
      camera("distortion dropped", {"distortion"}, [](Camera& c) { c.distortion.setZero(); }));
  all.push_back(
      camera("distortion reversed", {"distortion"}, [](Camera& c) { c.distortion *= -1.0; }));
  all.push_back(camera("k1 and k2 exchanged", {"distortion"},
                       [](Camera& c) { std::swap(c.distortion(0), c.distortion(1)); }));
  all.push_back(camera("only fx 2 % off", {"focal length"}, [](Camera& c) { c.fx *= 1.02; }));
  all.push_back(
      camera("cx and cy exchanged", {"principal point"}, [](Camera& c) { std::swap(c.cx, c.cy); }));
  all.push_back(
      camera("intrinsics of the image at half size", {"intrinsics", "size"}, [](Camera& c) {
        c.fx *= 0.5;
        c.fy *= 0.5;
        c.cx *= 0.5;
        c.cy *= 0.5;
      }));
}

void add_clouds(std::vector<Corruption>& all) {
  const auto diagonal = [](double x, double y, double z) -> Eigen::Matrix3d {
    return Eigen::Vector3d(x, y, z).asDiagonal();
  };
  all.push_back(points("cloud in millimetres", {"millimetres"}, diagonal(1e3, 1e3, 1e3)));
  all.push_back(points("cloud in feet", {"feet"}, diagonal(3.28084, 3.28084, 3.28084)));
  all.push_back(points("cloud in inches", {"inches"}, diagonal(39.37, 39.37, 39.37)));
  all.push_back(points("cloud mirrored in x", {"mirror"}, diagonal(-1, 1, 1)));
  all.push_back(points("cloud mirrored in y", {"mirror"}, diagonal(1, -1, 1)));
  all.push_back(points("cloud mirrored in z", {"mirror"}, diagonal(1, 1, -1)));
  Eigen::Matrix3d exchange;
  exchange << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  all.push_back(points("x and y exchanged", {"mirror"}, exchange));
  Eigen::Matrix3d cycle;
  cycle << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  all.push_back(points("axes renamed in a circle (rigid)", {}, cycle));
  all.push_back(points("cloud 2 % too large", {"larger", "size"}, diagonal(1.02, 1.02, 1.02)));
  all.push_back(points("z stretched by 3 %", {}, diagonal(1, 1, 1.03)));
  all.push_back(ranges("ranges 30 mm too long", {}, [](double r) { return r + 0.03; }));
  all.push_back(ranges("ranges 100 mm too long", {}, [](double r) { return r + 0.1; }));
  all.push_back(ranges("ranges 1 % too long", {}, [](double r) { return 1.01 * r; }));
  all.push_back(
      intensities("intensity of one bit", {}, [](float v) { return v > 60.0F ? 1.0F : 0.0F; }));
  all.push_back(
      intensities("intensity the same everywhere", {"intensity"}, [](float) { return 7.0F; }));
  all.push_back(intensities("intensity reversed", {}, [](float v) { return 200.0F - v; }));
  all.push_back({"clouds of two scenes exchanged",
                 {"belong", "contradict", "agree"},
                 [](CorruptedRig& c) { std::swap(c.rig.scenes[0].cloud, c.rig.scenes[1].cloud); }});
  all.push_back({"all clouds of the first scene",
                 {"same file", "belong", "agree", "contradict"},
                 [](CorruptedRig& c) {
                   for (auto& scene : c.rig.scenes) scene.cloud = c.rig.scenes[0].cloud;
                   c.truth.reset();
                 }});
  all.push_back({"rig bumped by 30 mm before the last scene",
                 {"contradict", "mov", "differ"},
                 [](CorruptedRig& c) {
                   for (Eigen::Vector3f& p : c.rig.scenes.back().cloud.points_m)
                     p += Eigen::Vector3f(0.0F, 0.03F, 0.0F);
                 }});
  all.push_back({"rig bumped by 10 mm before the last scene",
                 {"contradict", "mov", "differ"},
                 [](CorruptedRig& c) {
                   for (Eigen::Vector3f& p : c.rig.scenes.back().cloud.points_m)
                     p += Eigen::Vector3f(0.0F, 0.0F, 0.01F);
                 }});
  all.push_back({"half of the points lost", {}, [](CorruptedRig& c) {
                   for (auto& scene : c.rig.scenes) {
                     Cloud rest;
                     for (std::size_t k = 0; k < scene.cloud.size(); k += 2) {
                       rest.points_m.push_back(scene.cloud.points_m[k]);
                       rest.intensity.push_back(scene.cloud.intensity[k]);
                     }
                     scene.cloud = std::move(rest);
                   }
                 }});
  all.push_back({"range noise of 40 mm", {}, [](CorruptedRig& c) {
                   Random random(99);
                   for (auto& scene : c.rig.scenes) {
                     for (Eigen::Vector3f& p : scene.cloud.points_m)
                       p *= static_cast<float>(1.0 + 0.04 * random.normal() /
                                                         static_cast<double>(p.norm()));
                   }
                 }});
}

void add_images(std::vector<Corruption>& all) {
  all.push_back(images(
      "images mirrored", {"mirrored"},
      [](const SimulatedImage& i) {
        return mapped(i, i.width_px, i.height_px,
                      [&](int x, int y) { return std::pair(i.width_px - 1 - x, y); });
      },
      false));
  all.push_back(images(
      "images turned by 180°", {"turned", "principal point"},
      [](const SimulatedImage& i) {
        return mapped(i, i.width_px, i.height_px, [&](int x, int y) {
          return std::pair(i.width_px - 1 - x, i.height_px - 1 - y);
        });
      },
      false));
  all.push_back(images(
      "images turned by 90°", {"turned", "intrinsics"},
      [](const SimulatedImage& i) {
        return mapped(i, i.height_px, i.width_px,
                      [&](int x, int y) { return std::pair(y, i.height_px - 1 - x); });
      },
      false));
  all.push_back(images(
      "images at half size", {"intrinsics"},
      [](const SimulatedImage& i) {
        return mapped(i, i.width_px / 2, i.height_px / 2,
                      [](int x, int y) { return std::pair(2 * x, 2 * y); });
      },
      false));
  all.push_back(images(
      "images stretched to twice the width and cropped", {"focal", "intrinsics"},
      [](const SimulatedImage& i) {
        return mapped(i, i.width_px, i.height_px,
                      [&](int x, int y) { return std::pair((x + i.width_px / 2) / 2, y); });
      },
      false));
  all.push_back(images(
      "images shifted by 30 px", {"principal point"},
      [](const SimulatedImage& i) {
        return mapped(i, i.width_px, i.height_px,
                      [](int x, int y) { return std::pair(x - 30, y); });
      },
      true));
  all.push_back({"images of two scenes exchanged",
                 {"belong", "contradict", "agree"},
                 [](CorruptedRig& c) { std::swap(c.rig.scenes[0].image, c.rig.scenes[1].image); }});
  all.push_back({"images of all scenes passed on by one",
                 {"belong", "contradict", "agree"},
                 [](CorruptedRig& c) {
                   for (std::size_t k = 0; k + 1 < c.rig.scenes.size(); ++k)
                     std::swap(c.rig.scenes[k].image, c.rig.scenes[k + 1].image);
                   c.truth.reset();
                 }});
}

void add_boards(std::vector<Corruption>& all) {
  for (const double s : {1.01, 0.98, 1.05, 2.0, 0.5}) {
    char name[80];
    std::snprintf(name, sizeof name, "board %g times as large in target.yaml", s);
    all.push_back(target(name, {"size", "tagSize"}, [s](Target& t) { scale_board(t, s); }));
  }
  all.push_back(target("tag spacing 3 % off", {}, [](Target& t) { t.tag_spacing *= 1.03; }));
  all.push_back(target("circle radius 10 % off", {}, [](Target& t) { t.circle_radius_m *= 1.1; }));
  all.push_back(target("ids from 100", {"tags"}, [](Target& t) { t.first_tag_id = 100; }));
  all.push_back(
      target("ids from 4", {"firstTagId", "tags"}, [](Target& t) { t.first_tag_id = 4; }));
  all.push_back(
      target("another family", {"tag36h11"}, [](Target& t) { t.tag_family = "tag25h9"; }));
  all.push_back(target("five columns of tags", {"tagCols", "columns", "tags"},
                       [](Target& t) { t.tag_columns = 5; }));
}

void add_guesses(std::vector<Corruption>& all) {
  all.push_back(guess("rig.yaml right", {}, [](const Rigid3& t) { return rig_text(t, 1.0); }));
  all.push_back(guess("rig.yaml inverse", {"inverse"},
                      [](const Rigid3& t) { return rig_text(t.inverse(), 1.0); }));
  all.push_back(guess("rig.yaml identity", {"rig.yaml", "rough extrinsic"},
                      [](const Rigid3&) { return rig_text(Rigid3(), 1.0); }));
  all.push_back(guess("rig.yaml in millimetres", {"millimetres"},
                      [](const Rigid3& t) { return rig_text(t, 1e3); }));
}

void add_copies(std::vector<Corruption>& all) {
  all.push_back({"a scene twice", {"same files"}, [](CorruptedRig& c) {
                   c.copies.emplace_back(c.rig.scenes[0].name, "Z1");
                 }});
  all.push_back({"a scene five times", {"same files"}, [](CorruptedRig& c) {
                   for (const char* name : {"Z1", "Z2", "Z3", "Z4"})
                     c.copies.emplace_back(c.rig.scenes[0].name, name);
                 }});
}

std::string all_said(const CalibrationResult& result) {
  std::string text;
  for (const std::string& reason : result.quality_reasons) text += reason + " | ";
  for (const std::string& warning : result.warnings) text += warning + " | ";
  return text;
}

bool mentions(const std::string& text, const Words& words) {
  return words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& word) {
           return text.find(word) != std::string::npos;
         });
}

// What matters at all: three of the smallest tolerances.
constexpr double kMatters_mm = 1.5;
constexpr double kMatters_mrad = 0.6;

void compare(const CorruptedRig& corrupted, const CalibrationResult& result,
             CorruptionOutcome& out) {
  out.quality = name_of(result.quality);
  const bool trusted = result.quality == Quality::kGood && result.extrinsic.used_scenes > 1;
  if (!corrupted.truth) {
    out.outcome = trusted ? Outcome::kSilentlyWrong : Outcome::kDoubted;
    return;
  }
  const ExtrinsicError error = compare_extrinsics(
      {result.extrinsic.camera_from_lidar.transform, result.covariance_total}, *corrupted.truth);
  out.error_mm = error.translation_mm;
  out.error_mrad = error.rotation_mrad;
  out.sigmas = error.normalized.cwiseAbs().maxCoeff();
  const bool wrong =
      out.sigmas > 3.0 && (out.error_mm > kMatters_mm || out.error_mrad > kMatters_mrad);
  out.outcome = !trusted ? Outcome::kDoubted : wrong ? Outcome::kSilentlyWrong : Outcome::kRight;
}

}  // namespace

std::vector<Corruption> corruptions() {
  std::vector<Corruption> all{{"clean", {}, [](CorruptedRig&) {}}};
  add_camera(all);
  add_clouds(all);
  add_images(all);
  add_boards(all);
  add_guesses(all);
  add_copies(all);
  return all;
}

CorruptionOutcome run_corruption(const SimulatedRig& rig, const Corruption& corruption,
                                 const fs::path& folder) {
  CorruptedRig corrupted{rig, {}, {}, rig.camera_from_lidar};
  corruption.apply(corrupted);
  CorruptionOutcome out;
  out.quality = "error";
  const fs::path dataset = folder / "dataset";
  const auto clean_up = [&] {
    std::error_code ignored;
    fs::remove_all(dataset, ignored);
    fs::remove(folder / "dataset-truth.json", ignored);
  };
  clean_up();
  if (auto written = simulation::write_dataset(corrupted.rig, dataset); !written) {
    out.said = "not written: " + written.error().text();
    out.diagnosed = false;
    return out;
  }
  if (!corrupted.rig_yaml.empty()) std::ofstream(dataset / "rig.yaml") << corrupted.rig_yaml;
  for (const auto& [from, to] : corrupted.copies)
    fs::copy(dataset / "scenes" / from, dataset / "scenes" / to, fs::copy_options::recursive);
  const auto opened = open_dataset(dataset);
  CalibrationRequest request;
  if (opened) request.guess = opened->rough_camera_from_lidar;
  auto result =
      opened ? calibrate(*opened, request, {}) : Result<CalibrationResult>(opened.error());
  clean_up();
  if (!result) {
    out.said = result.error().text();
  } else {
    out.said = all_said(*result);
    compare(corrupted, *result, out);
  }
  out.diagnosed = mentions(out.said, corruption.diagnosis);
  return out;
}

}  // namespace lvcalib::test
