// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_actors.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>

#include "views/cloud_pipeline.h"

namespace lvcalib::widgets::cloud_actors_test {
namespace {

TEST(CloudActors, PortionsHoldAllPointsInTheirOrder) {
  CloudScene scene;
  const std::size_t count = 2 * kCloudPortion + 7;
  for (std::size_t i = 0; i < count; ++i) {
    scene.order.push_back(static_cast<std::uint32_t>(i));
    for (int k = 0; k < 3; ++k) {
      scene.xyz_m.push_back(static_cast<float>(i));
      scene.rgb.push_back(static_cast<std::uint8_t>(i % 251));
    }
  }
  ASSERT_EQ(scene.size(), count);
  vtkNew<vtkProperty> property;
  const auto portions = point_portions(scene, *property);
  ASSERT_EQ(portions.size(), 3U);
  vtkIdType points = 0;
  for (const auto& actor : portions) {
    auto* data = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
    EXPECT_EQ(data->GetPoint(0)[0], static_cast<double>(points));
    EXPECT_EQ(data->GetNumberOfVerts(), 1);
    EXPECT_EQ(actor->GetProperty(), property.Get());
    points += data->GetNumberOfPoints();
  }
  EXPECT_EQ(points, static_cast<vtkIdType>(count));
  EXPECT_TRUE(point_portions(CloudScene(), *property).empty());
}

TEST(CloudActors, LinesAreClosedWhenAskedAndHiddenWhenNone) {
  vtkNew<vtkActor> actor;
  const std::vector<Eigen::Vector3d> corner{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  show_lines(*actor, {{corner, {1, 0, 0}, true}, {corner, {0, 1, 0}, false}, {{}, {}, true}},
             CloudLineWidth::kUsual);
  auto* data = vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput());
  EXPECT_EQ(data->GetNumberOfLines(), 2);
  EXPECT_EQ(data->GetNumberOfPoints(), 6);
  EXPECT_EQ(actor->GetVisibility(), 1);
  show_lines(*actor, {{corner, {1, 0, 0}, true}}, CloudLineWidth::kHair);
  EXPECT_EQ(actor->GetVisibility(), 0);
}

TEST(CloudActors, FewPointsAreDrawnLarge) {
  vtkNew<vtkActor> actor;
  show_points(*actor, std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Zero()));
  const float few = actor->GetProperty()->GetPointSize();
  EXPECT_EQ(actor->GetVisibility(), 1);
  show_points(*actor, std::vector<Eigen::Vector3d>(300, Eigen::Vector3d::Zero()));
  EXPECT_LT(actor->GetProperty()->GetPointSize(), few);
  // As large on a fine screen.
  show_points(*actor, std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Zero()), 2.0);
  EXPECT_EQ(actor->GetProperty()->GetPointSize(), 2.0F * few);
  show_points(*actor, {});
  EXPECT_EQ(actor->GetVisibility(), 0);
}

}  // namespace
}  // namespace lvcalib::widgets::cloud_actors_test
