// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_actors.h"

#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "views/cloud_pipeline.h"

namespace lvcalib::widgets {
namespace {

vtkSmartPointer<vtkCellArray> one_cell_of(std::size_t points) {
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->InsertNextCell(static_cast<int>(points));
  for (std::size_t i = 0; i < points; ++i) cells->InsertCellPoint(static_cast<vtkIdType>(i));
  return cells;
}

}  // namespace

std::vector<vtkSmartPointer<vtkActor>> point_portions(const CloudScene& scene,
                                                      vtkProperty& property) {
  std::vector<vtkSmartPointer<vtkActor>> portions;
  const auto full = one_cell_of(std::min(kCloudPortion, scene.size()));
  for (std::size_t start = 0; start < scene.size(); start += kCloudPortion) {
    const std::size_t count = std::min(kCloudPortion, scene.size() - start);
    // The arrays lie in the scene, which lives as long as the actors; VTK only reads them.
    vtkNew<vtkFloatArray> xyz;
    xyz->SetNumberOfComponents(3);
    xyz->SetArray(const_cast<float*>(scene.xyz_m.data() + 3 * start),  // NOLINT: VTK knows no const
                  static_cast<vtkIdType>(3 * count), 1);
    vtkNew<vtkUnsignedCharArray> rgb;
    rgb->SetNumberOfComponents(3);
    rgb->SetArray(const_cast<std::uint8_t*>(scene.rgb.data() + 3 * start),  // NOLINT
                  static_cast<vtkIdType>(3 * count), 1);
    vtkNew<vtkPoints> points;
    points->SetData(xyz);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(count == std::min(kCloudPortion, scene.size()) ? full : one_cell_of(count));
    data->GetPointData()->SetScalars(rgb);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    mapper->SetStatic(1);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->SetProperty(&property);
    actor->SetPickable(0);
    portions.push_back(actor);
  }
  return portions;
}

void show_lines(vtkActor& actor, const std::vector<CloudLine>& lines, CloudLineWidth width) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const CloudLine& line : lines) {
    if (line.points_m.size() < 2 || line.width != width) continue;
    const vtkIdType first = points->GetNumberOfPoints();
    cells->InsertNextCell(static_cast<int>(line.points_m.size()) + (line.closed ? 1 : 0));
    for (const Eigen::Vector3d& p : line.points_m) {
      cells->InsertCellPoint(points->InsertNextPoint(p.data()));
    }
    if (line.closed) cells->InsertCellPoint(first);
    for (const double c : line.color) {
      colors->InsertNextValue(static_cast<unsigned char>(std::lround(255 * c)));
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  data->GetCellData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  actor.SetMapper(mapper);
  actor.SetVisibility(cells->GetNumberOfCells() > 0 ? 1 : 0);
}

void bring_forward(vtkProp3D& prop, const Eigen::Vector3d& eye_m, double share) {
  vtkNew<vtkMatrix4x4> matrix;
  for (int k = 0; k < 3; ++k) {
    matrix->SetElement(k, k, 1.0 - share);
    matrix->SetElement(k, 3, share * eye_m(k));
  }
  prop.SetUserMatrix(matrix);
}

void show_points(vtkActor& actor, const std::vector<Eigen::Vector3d>& points_m,
                 double device_pixel_ratio) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3d& p : points_m) points->InsertNextPoint(p.data());
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(one_cell_of(points_m.size()));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  actor.SetMapper(mapper);
  constexpr std::size_t kFew = 20;
  actor.GetProperty()->SetPointSize((points_m.size() <= kFew ? 11.0F : 4.0F) *
                                    static_cast<float>(device_pixel_ratio));
  actor.SetVisibility(points_m.empty() ? 0 : 1);
}

}  // namespace lvcalib::widgets
