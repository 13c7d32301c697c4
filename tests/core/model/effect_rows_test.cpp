// SPDX-License-Identifier: GPL-3.0-or-later
// What effects move against what measurements then become, by finite differences: a measured point,
// print or corner is displaced and measured anew.
#include "model/effect_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "model/residuals.h"
#include "model/scene_geometry.h"
#include "support/synthetic_table.h"

namespace lvcalib {
namespace {

constexpr double kStep = 1e-6;

// A table without noise, so that base residuals are zero.
test::SyntheticTable exact_table() {
  test::TableRecipe recipe;
  recipe.scenes = 2;
  recipe.range_rows = 60;
  recipe.range_sigma_m = recipe.edge_sigma_m = recipe.corner_sigma_px = 1e-12;
  auto made = test::synthetic_table(recipe);
  for (RangeRow& row : made.table.range) row.beam.edge = NearEdge{0.002, 0.4, 0.01};
  return made;
}

class EveryEffect : public ::testing::TestWithParam<std::string> {
 protected:
  EveryEffect() : made_(exact_table()), effect_(find_effect(GetParam())) {
    columns_.add(effect_, effect_->shapes(made_.table).back(), made_.table);
  }
  [[nodiscard]] const EffectColumns& columns() const { return columns_.list().front(); }
  [[nodiscard]] SceneGeometry geometry(int scene) const {
    return {made_.truth.camera_from_lidar,
            made_.truth.camera_from_board[static_cast<std::size_t>(scene)]};
  }

  test::SyntheticTable made_;
  EffectPtr effect_;
  EffectColumnsList columns_;
};

// Measured minus predicted range of a beam whose point and board have moved.
double range_residual(const SceneGeometry& g, const BeamPoint& beam, const Eigen::Vector3d& point,
                      double board_lift_m) {
  // The board's face there is lifted along its normal: the true point lies farther up the ray.
  const Eigen::Vector3d board_normal = g.lidar_from_board().rotation * Eigen::Vector3d::UnitZ();
  const double lifted =
      board_normal.dot(g.lidar_from_board().translation + board_lift_m * board_normal) /
      board_normal.dot(beam.direction);
  const Eigen::Vector3d measured = beam.direction * lifted + point;
  return measured.norm() - *g.range_m(measured.normalized());
}

TEST_P(EveryEffect, RangeRowsAreTheMovementOfTheMeasuredRange) {
  const MeasurementTable& table = made_.table;
  EffectRows rows(table, columns_.list());
  std::size_t told = 0;
  ASSERT_FALSE(table.range.empty());
  for (const RangeRow& row : table.range) {
    const SceneGeometry g = geometry(row.beam.scene);
    const auto n = columns().parameters.size();
    std::vector<Eigen::Vector3d> point(n, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> board(n, Eigen::Vector3d::Zero());
    effect_->lidar(row.beam, table, columns().shape, point);
    effect_->board({row.beam.board_m, Eigen::Vector2d::Zero()}, table.target, columns().shape,
                   board);
    const Eigen::Matrix3d rotation = g.lidar_from_board().rotation.toRotationMatrix();
    const PrintSensitivity::Moves moves(g, rotation, row.beam.direction);
    rows.range(row, g.range_row(row.beam.direction), moves, nullptr,
               [&](const EffectColumns&, const EffectRows::RangeChange& by) {
                 ++told;
                 for (std::size_t k = 0; k < n; ++k) {
                   // Steps of a micrometre at most, whatever the parameter's unit.
                   const double size = std::max(1.0, point[k].norm() + board[k].norm());
                   const double step = kStep / size;
                   const double numeric =
                       (range_residual(g, row.beam, step * point[k], step * board[k].z()) -
                        range_residual(g, row.beam, -step * point[k], -step * board[k].z())) /
                       (2.0 * step);
                   EXPECT_NEAR(by.range_m[k], numeric, 1e-5 * (size + std::abs(numeric)));
                 }
               });
  }
  EXPECT_EQ(told, table.range.size());
}

// In the blur of an edge: how far the print moves under the beam, and how the beam and its power
// change; a range sees the same print move.
TEST_P(EveryEffect, ReadingsSeeThePrintMoveUnderTheBeam) {
  const MeasurementTable& table = made_.table;
  EffectRows rows(table, columns_.list());
  std::size_t asked = 0;
  std::size_t told = 0;
  for (std::size_t r = 0; r < table.boundary.size(); r += 7) {
    ++asked;
    const BoundaryRow& row = table.boundary[r];
    const SceneGeometry g = geometry(row.beam.scene);
    const Eigen::Matrix3d rotation = g.lidar_from_board().rotation.toRotationMatrix();
    const auto n = columns().parameters.size();
    std::vector<Eigen::Vector3d> point(n, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> light(n, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> board(n, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector3d> blur(n, Eigen::Vector3d::Zero());
    std::vector<double> outward(n, 0.0);
    std::vector<double> log_intensity(n, 0.0);
    effect_->lidar(row.beam, table, columns().shape, point);
    effect_->spot(row.beam, table, columns().shape, light);
    effect_->board({row.beam.board_m, Eigen::Vector2d::Zero()}, table.target, columns().shape,
                   board);
    effect_->blur(row.beam, table, columns().shape, blur);
    effect_->edge(row, table, columns().shape, outward);
    const IntensityRow reading{row.beam, Print::kWhite, 0.0, 1.0, row.reading};
    effect_->intensity(reading, table, columns().shape, log_intensity);
    // Where the ray of a displaced point meets the plane.
    const auto seen = [&](const Eigen::Vector3d& displacement) {
      const Eigen::Vector3d p = row.beam.range_m * row.beam.direction + displacement;
      const Eigen::Vector3d direction = p.normalized();
      return g.board_m(*g.range_m(direction) * direction);
    };
    const PrintSensitivity::Moves moves(g, rotation, row.beam.direction);
    rows.reading(
        reading, &row, moves, [&](const EffectColumns&, const PrintSensitivity::Change& by) {
          ++told;
          for (std::size_t k = 0; k < n; ++k) {
            const Eigen::Vector3d move = point[k] + light[k] + rotation * board[k];
            const double size = std::max(1.0, move.norm());
            const double step = kStep / size;
            const Eigen::Vector2d numeric = (seen(step * move) - seen(-step * move)) / (2.0 * step);
            EXPECT_LT((by.shift_m[k] - numeric).norm(), 1e-4 * (size + numeric.norm()));
            EXPECT_EQ(by.growth_m[k], outward[k]);
            EXPECT_EQ(by.blur_rad2[k], blur[k]);
            EXPECT_EQ(by.log_intensity[k], log_intensity[k]);
          }
        });
    // What is ranged is displaced by all but what moves the light alone.
    RangeRow ranged;
    ranged.beam = row.beam;
    rows.range(ranged, g.range_row(row.beam.direction), moves, &row,
               [&](const EffectColumns& c, const EffectRows::RangeChange& by) {
                 EXPECT_FALSE(c.print_contrast);
                 ++told;
                 for (std::size_t k = 0; k < n; ++k) {
                   const Eigen::Vector3d move = point[k] + rotation * board[k];
                   const double size = std::max(1.0, move.norm());
                   const double step = kStep / size;
                   const Eigen::Vector2d numeric =
                       (seen(step * move) - seen(-step * move)) / (2.0 * step);
                   EXPECT_LT((by.shift_m[k] - numeric).norm(), 1e-4 * (size + numeric.norm()));
                   EXPECT_EQ(by.growth_m[k], outward[k]);
                 }
               });
  }
  EXPECT_GT(asked, 0U);
  EXPECT_EQ(told, 2 * asked);
}

TEST_P(EveryEffect, CornerRowsAreTheMovementOfTheImage) {
  const MeasurementTable& table = made_.table;
  EffectRows rows(table, columns_.list());
  std::size_t asked = 0;
  std::size_t told = 0;
  for (std::size_t r = 0; r < table.corner.size(); r += 5) {
    ++asked;
    const CornerRow& row = table.corner[r];
    const Rigid3& pose = made_.truth.camera_from_board[static_cast<std::size_t>(row.scene)];
    const auto predicted = predict(row, table.camera, pose);
    ASSERT_TRUE(predicted.has_value());
    const auto n = columns().parameters.size();
    std::vector<Eigen::Vector3d> board(n, Eigen::Vector3d::Zero());
    std::vector<Eigen::Vector2d> pixels(n, Eigen::Vector2d::Zero());
    effect_->board({row.board_m, row.from_tag_m}, table.target, columns().shape, board);
    effect_->camera(row, predicted->normalized, table.camera, columns().shape, pixels);
    const auto image = [&](const Eigen::Vector3d& moved) {
      return *table.camera.project(
          pose * (Eigen::Vector3d(row.board_m.x(), row.board_m.y(), 0.0) + moved));
    };
    rows.corner(row, predicted->normalized, predicted->by_board_move,
                [&](const EffectColumns&, std::span<const Eigen::Vector2d> by) {
                  ++told;
                  for (std::size_t k = 0; k < n; ++k) {
                    const Eigen::Vector2d numeric =
                        (image(kStep * board[k]) - image(-kStep * board[k])) / (2.0 * kStep) +
                        pixels[k];
                    EXPECT_LT((by[k] - numeric).norm(), 1e-4 * (1.0 + numeric.norm()));
                  }
                });
  }
  EXPECT_GT(asked, 0U);
  EXPECT_EQ(told, asked);
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids;
  for (const EffectPtr& effect : effect_catalogue()) ids.push_back(effect->info().id);
  return ids;
}
INSTANTIATE_TEST_SUITE_P(Rows, EveryEffect, ::testing::ValuesIn(all_ids()),
                         [](const auto& info) { return info.param; });

TEST(Predict, CornersBehindTheCameraGiveNothing) {
  CornerRow row;
  Rigid3 behind;
  behind.translation = {0.0, 0.0, -2.0};
  EXPECT_FALSE(predict(row, test::test_camera(), behind).has_value());
}

TEST(ColumnsInUse, KeepOrderAndShape) {
  const auto made = exact_table();
  const std::vector<EffectInUse> in_use = {
      {find_effect("range_near"), 1.2, Eigen::VectorXd::Zero(1)},
      {find_effect("print_scale"), 0.0, Eigen::VectorXd::Zero(3)}};
  const auto list = columns_in_use(in_use, made.table);
  ASSERT_EQ(list.list().size(), 2U);
  EXPECT_EQ(list.list()[0].shape, 1.2);
  EXPECT_EQ(list.list()[1].first, 1);
  EXPECT_EQ(list.columns(), 4);
}

}  // namespace
}  // namespace lvcalib
