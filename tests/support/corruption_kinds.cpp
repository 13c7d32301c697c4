// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/corruption_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace lvcalib::test {
namespace {

using simulation::SimulatedImage;
using simulation::SimulatedScene;

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
  all.push_back(scenes("one scene alone", {"only one usable scene", "needs three or more"},
                       [](CorruptedRig& c) { c.rig.scenes.resize(1); }));
  all.push_back(scenes(
      "one scene alone, nine times", {"same files"},
      [](CorruptedRig& c) {
        c.rig.scenes.resize(1);
        for (int k = 1; k < 9; ++k)
          c.copies.emplace_back(c.rig.scenes[0].name, "Z" + std::to_string(k));
      },
      1));
  all.push_back(scenes("two scenes", {"two scenes", "needs three or more"},
                       [](CorruptedRig& c) { c.rig.scenes.resize(2); }));
}

void add_strays(Kinds& all) {
  const Words images_wrong{"seem to be exchanged", "contradicts the other",
                           "not agree with the other scenes", "the scenes do not agree"};
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
  const Words words{"did a sensor move",       "did the board or a sensor move",
                    "did something move",      "moves steadily from scene to scene",
                    "contradicts the other",   "not agree with the other scenes",
                    "the halves of the scenes"};
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
  add_camera_kinds(all);
  add_cloud_kinds(all);
  add_image_kinds(all);
  add_board_kinds(all);
  add_guesses(all);
  add_repeats(all);
  add_strays(all);
  add_bumps(all);
  add_covers(all);
  add_planted(all);
  return all;
}

}  // namespace lvcalib::test
