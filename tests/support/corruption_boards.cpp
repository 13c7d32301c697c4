// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/random.h"
#include "support/corruption_kinds.h"

namespace lvcalib::test {
namespace {

using simulation::SimulatedScene;

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

}  // namespace

void add_board_kinds(Kinds& all) {
  add_descriptions(all);
  add_prints(all);
}

}  // namespace lvcalib::test
