// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/cloud_pipeline.h"

#include <algorithm>
#include <cmath>

#include <vtkActor.h>
#include <vtkBoxRepresentation.h>
#include <vtkBoxWidget2.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>
#include <vtk_glew.h>

#include "views/cloud_actors.h"
#include "views/cloud_geometry.h"

namespace lvcalib::widgets {
namespace {

vtkSmartPointer<vtkTransform> as_transform(const Eigen::Matrix4d& matrix) {
  vtkNew<vtkMatrix4x4> elements;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      elements->SetElement(row, column, matrix(row, column));
    }
  }
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->SetMatrix(elements);
  return transform;
}

Eigen::Matrix4d as_eigen(const vtkMatrix4x4* matrix) {
  Eigen::Matrix4d out;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) out(row, column) = matrix->GetElement(row, column);
  }
  return out;
}

// The event of VTK that a mouse event stands for.
unsigned long vtk_event(const CanvasMouse& mouse) {
  const bool press = mouse.kind == CanvasMouse::Kind::kPress;
  switch (mouse.kind) {
    case CanvasMouse::Kind::kMove:
      return vtkCommand::MouseMoveEvent;
    case CanvasMouse::Kind::kWheelUp:
      return vtkCommand::MouseWheelForwardEvent;
    case CanvasMouse::Kind::kWheelDown:
      return vtkCommand::MouseWheelBackwardEvent;
    default:
      break;
  }
  switch (mouse.button) {
    case CanvasMouse::Button::kLeft:
      return press ? vtkCommand::LeftButtonPressEvent : vtkCommand::LeftButtonReleaseEvent;
    case CanvasMouse::Button::kMiddle:
      return press ? vtkCommand::MiddleButtonPressEvent : vtkCommand::MiddleButtonReleaseEvent;
    case CanvasMouse::Button::kRight:
      return press ? vtkCommand::RightButtonPressEvent : vtkCommand::RightButtonReleaseEvent;
    case CanvasMouse::Button::kNone:
      break;
  }
  return vtkCommand::NoEvent;
}

}  // namespace

struct CloudPipeline::Vtk {
  Hooks hooks;
  vtkNew<vtkRenderer> renderer;
  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  vtkNew<vtkBoxWidget2> box_widget;
  vtkNew<vtkBoxRepresentation> box;
  std::array<vtkNew<vtkActor>, 3> line_actors;  // By CloudLineWidth.
  vtkNew<vtkActor> highlight_actor;
  vtkNew<vtkProperty> point_property;
  std::vector<vtkSmartPointer<vtkActor>> portions;
  std::shared_ptr<const CloudScene> scene;
  std::size_t drawn = 0;  // Portions.
  std::array<double, 6> bounds{-1, 1, -1, 1, -1, 1};
  std::array<double, 6> most_bounds{-1, 1, -1, 1, -1, 1};
  double point_size_px = 1.6;
  double device_pixel_ratio = 1.0;
  bool ready = false;
  bool editing = false;
  bool box_shown = false;
  bool box_editable = false;
  bool looked = false;

  void observe(vtkObject* object, unsigned long event,
               void (*function)(vtkObject*, unsigned long, void*, void*)) {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback(function);
    object->AddObserver(event, command);
  }

  void createWindow() {
    window = vtkSmartPointer<vtkGenericOpenGLRenderWindow>::New();
    window->SetOwnContext(false);
    window->SetMultiSamples(0);
    window->SetFrameBlitModeToNoBlit();
    window->AddRenderer(renderer);
    observe(window, vtkCommand::WindowMakeCurrentEvent,
            [](vtkObject*, unsigned long, void* self, void*) {
              static_cast<Vtk*>(self)->hooks.make_current();
            });
    // Without an answer VTK takes the context for lost and draws nothing.
    observe(
        window, vtkCommand::WindowIsCurrentEvent,
        [](vtkObject*, unsigned long, void*, void* answer) { *static_cast<bool*>(answer) = true; });
    window->SetReadyForRendering(true);
    window->InitializeFromCurrentContext();
    interactor->SetRenderWindow(window);
  }

  void createInteraction() {
    // The style asks for frames; when they are drawn is decided outside.
    interactor->EnableRenderOff();
    style->AutoAdjustCameraClippingRangeOff();
    interactor->SetInteractorStyle(style);
    observe(interactor, vtkCommand::RenderEvent, [](vtkObject*, unsigned long, void* self, void*) {
      static_cast<Vtk*>(self)->hooks.view_changed();
    });
    box->SetPlaceFactor(1.0);
    double cube[6] = {-1, 1, -1, 1, -1, 1};
    box->PlaceWidget(cube);
    box_widget->SetRepresentation(box);
    observe(box_widget, vtkCommand::StartInteractionEvent,
            [](vtkObject*, unsigned long, void* self, void*) {
              static_cast<Vtk*>(self)->editing = true;
            });
    observe(box_widget, vtkCommand::EndInteractionEvent,
            [](vtkObject*, unsigned long, void* self, void*) {
              auto* vtk = static_cast<Vtk*>(self);
              vtkNew<vtkTransform> transform;
              vtk->box->GetTransform(transform);
              vtk->hooks.box_edited(box_of_cube(as_eigen(transform->GetMatrix())));
            });
  }

  // The box can be put on the screen only once there is one.
  void applyBox() {
    if (!ready) return;
    if (box_widget->GetInteractor() == nullptr) box_widget->SetInteractor(interactor);
    box_widget->SetEnabled(box_shown ? 1 : 0);
    box_widget->SetProcessEvents(box_editable ? 1 : 0);
    box->SetVisibility(box_shown ? 1 : 0);
    if (box_editable) {
      box->HandlesOn();
    } else {
      box->HandlesOff();
    }
  }

  void render() {
    vtkOpenGLState* state = window->GetState();
    state->Reset();
    state->Push();
    window->Render();
    state->Pop();
  }

  void showPortions(std::size_t from, std::size_t to) {
    for (std::size_t k = 0; k < portions.size(); ++k) {
      portions[k]->SetVisibility(k >= from && k < to ? 1 : 0);
    }
  }

  // What lies behind the viewer is cut off; everything ahead is kept, also lines and the box.
  void setClipping() {
    const double reach =
        std::max({bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]});
    std::array<double, 6> wide = bounds;
    for (std::size_t k = 0; k < 6; ++k) wide[k] += (k % 2 == 0 ? -0.05 : 0.05) * reach;
    renderer->ResetCameraClippingRange(wide.data());
  }

  vtkActor* of_width(CloudLineWidth width) { return line_actors[static_cast<std::size_t>(width)]; }

  void showMarks(bool shown) {
    const auto show = [&](vtkActor& actor) {
      actor.SetVisibility(shown && actor.GetMapper() != nullptr ? 1 : 0);
    };
    for (const auto& actor : line_actors) show(*actor);
    show(*highlight_actor);
  }

  // Points scatter by centimetres about the surface on which lines lie: at their own depth lines
  // would be seen here and there only.
  void bringLinesForward() {
    const Eigen::Vector3d eye_m(renderer->GetActiveCamera()->GetPosition());
    const double distance_m = renderer->GetActiveCamera()->GetDistance();
    const auto forward = [&](vtkActor& actor, double by_m) {
      bring_forward(actor, eye_m, std::min(by_m / distance_m, 0.3));
    };
    forward(*of_width(CloudLineWidth::kHair), 0.03);
    forward(*of_width(CloudLineWidth::kBroad), 0.04);
    forward(*of_width(CloudLineWidth::kUsual), 0.06);
    forward(*highlight_actor, 0.07);
  }

  // VTK counts the screen's own pixels: on a fine screen lines would be hairs.
  void scaleLines() {
    const auto ratio = static_cast<float>(device_pixel_ratio);
    of_width(CloudLineWidth::kHair)->GetProperty()->SetLineWidth(1.0F * ratio);
    of_width(CloudLineWidth::kUsual)->GetProperty()->SetLineWidth(2.0F * ratio);
    of_width(CloudLineWidth::kBroad)->GetProperty()->SetLineWidth(5.0F * ratio);
    box->GetOutlineProperty()->SetLineWidth(1.5F * ratio);
    box->GetSelectedOutlineProperty()->SetLineWidth(2.5F * ratio);
  }
};

CloudPipeline::CloudPipeline(Hooks hooks) : vtk_(std::make_unique<Vtk>()) {
  vtk_->hooks = std::move(hooks);
  vtk_->createInteraction();
  vtk_->scaleLines();
  for (const auto& actor : vtk_->line_actors) {
    // Many drivers draw every line a pixel wide in this profile of OpenGL; VTK's tubes are as wide
    // as they are to be.
    actor->GetProperty()->RenderLinesAsTubesOn();
    actor->GetProperty()->LightingOff();
    vtk_->renderer->AddActor(actor);
  }
  vtk_->highlight_actor->GetProperty()->LightingOff();
  vtk_->renderer->AddActor(vtk_->highlight_actor);
  vtk_->showMarks(false);
  vtk_->point_property->LightingOff();
}

CloudPipeline::~CloudPipeline() {
  vtk_->box_widget->SetEnabled(0);
  vtk_->box_widget->SetInteractor(nullptr);
}

bool CloudPipeline::initialize() {
  vtk_->createWindow();
  vtk_->ready = vtk_->window->GetState() != nullptr;
  vtk_->applyBox();
  return vtk_->ready;
}

void CloudPipeline::release() {
  if (!vtk_->window) return;
  vtk_->ready = false;
  vtk_->box_widget->SetEnabled(0);
  vtk_->box_widget->SetInteractor(nullptr);
  vtk_->window->Finalize();
  vtk_->window->RemoveRenderer(vtk_->renderer);
  vtk_->interactor->SetRenderWindow(nullptr);
  vtk_->window = nullptr;
}

void CloudPipeline::setScene(std::shared_ptr<const CloudScene> scene) {
  for (auto& actor : vtk_->portions) vtk_->renderer->RemoveActor(actor);
  vtk_->portions.clear();
  vtk_->drawn = 0;
  vtk_->scene = std::move(scene);
  if (!vtk_->scene || vtk_->scene->size() == 0) return;
  const CloudScene& s = *vtk_->scene;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    vtk_->bounds[2 * k] = s.low_m(axis);
    vtk_->bounds[2 * k + 1] = s.high_m(axis);
    vtk_->most_bounds[2 * k] = s.most_low_m(axis);
    vtk_->most_bounds[2 * k + 1] = s.most_high_m(axis);
  }
  vtk_->portions = point_portions(s, *vtk_->point_property);
  for (auto& actor : vtk_->portions) vtk_->renderer->AddActor(actor);
}

void CloudPipeline::setLines(const std::vector<CloudLine>& lines) {
  for (const CloudLineWidth width :
       {CloudLineWidth::kHair, CloudLineWidth::kUsual, CloudLineWidth::kBroad})
    show_lines(*vtk_->of_width(width), lines, width);
}

void CloudPipeline::setHighlights(const std::vector<Eigen::Vector3d>& points_m) {
  show_points(*vtk_->highlight_actor, points_m, vtk_->device_pixel_ratio);
}

void CloudPipeline::setBackground(double red, double green, double blue, bool dark) {
  vtk_->renderer->SetBackground(red, green, blue);
  // Else the window's own background would be added to the picture.
  vtk_->renderer->SetBackgroundAlpha(1.0);
  const double edge = dark ? 0.95 : 0.1;
  vtk_->box->GetOutlineProperty()->SetColor(edge, edge, edge);
  vtk_->box->GetHandleProperty()->SetColor(0.95, 0.55, 0.1);
  vtk_->box->GetSelectedHandleProperty()->SetColor(1.0, 0.2, 0.2);
  vtk_->highlight_actor->GetProperty()->SetColor(1.0, dark ? 0.25 : 0.0, dark ? 0.9 : 0.7);
}

void CloudPipeline::setBox(const std::optional<CropBox>& box, bool editable) {
  vtk_->box_shown = box.has_value();
  vtk_->box_editable = editable && box.has_value();
  if (box) vtk_->box->SetTransform(as_transform(cube_to_box(*box)));
  vtk_->applyBox();
}

void CloudPipeline::look(CloudViewpoint viewpoint) {
  vtkCamera* camera = vtk_->renderer->GetActiveCamera();
  const bool board = viewpoint == CloudViewpoint::kBoard;
  if (board && (!vtk_->scene || !(vtk_->scene->board_radius_m > 0.0))) return;
  const Eigen::Vector3d focus = board         ? vtk_->scene->board_center_m
                                : vtk_->scene ? vtk_->scene->center_m
                                              : Eigen::Vector3d::UnitX();
  const ViewerPose pose = viewer_pose(viewpoint, focus);
  camera->SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera->SetPosition(pose.eye_m.x(), pose.eye_m.y(), pose.eye_m.z());
  camera->SetViewUp(pose.up.x(), pose.up.y(), pose.up.z());
  camera->SetViewAngle(pose.angle_deg);
  // ResetCamera() fits the sphere about the points into the height; the width may be smaller.
  const int* size = vtk_->interactor->GetSize();
  const double aspect = size[1] > 0 ? static_cast<double>(size[0]) / size[1] : 1.0;
  if (board) {
    const double r = 1.25 * vtk_->scene->board_radius_m;
    double around[6];
    for (int k = 0; k < 3; ++k) {
      around[2 * k] = focus(k) - r / std::sqrt(3.0);
      around[2 * k + 1] = focus(k) + r / std::sqrt(3.0);
    }
    vtk_->renderer->ResetCamera(around);
    camera->Dolly(std::clamp(aspect, 0.3, 1.0));
  } else if (pose.fits_bounds) {
    const bool most = viewpoint == CloudViewpoint::kMost;
    vtk_->renderer->ResetCamera(most ? vtk_->most_bounds.data() : vtk_->bounds.data());
    // The points fill less than that sphere.
    camera->Dolly(1.05 * std::clamp(aspect, 0.3, 1.0));
  }
  vtk_->looked = true;
}

Viewer CloudPipeline::viewer() const {
  vtkCamera* camera = vtk_->renderer->GetActiveCamera();
  return {Eigen::Vector3d(camera->GetPosition()), Eigen::Vector3d(camera->GetFocalPoint()),
          Eigen::Vector3d(camera->GetViewUp()), camera->GetViewAngle()};
}

void CloudPipeline::setViewer(const Viewer& viewer) {
  vtkCamera* camera = vtk_->renderer->GetActiveCamera();
  camera->SetFocalPoint(viewer.focus_m.data());
  camera->SetPosition(viewer.eye_m.data());
  camera->SetViewUp(viewer.up.data());
  camera->SetViewAngle(viewer.angle_deg);
}

void CloudPipeline::turn(double azimuth_deg, double elevation_deg) {
  vtkCamera* camera = vtk_->renderer->GetActiveCamera();
  camera->Azimuth(azimuth_deg);
  camera->Elevation(elevation_deg);
  camera->OrthogonalizeViewUp();
}

void CloudPipeline::zoom(double factor) {
  vtk_->renderer->GetActiveCamera()->Dolly(factor);
}

void CloudPipeline::setPointSize(double size_px) {
  vtk_->point_size_px = size_px;
  vtk_->point_property->SetPointSize(static_cast<float>(size_px * vtk_->device_pixel_ratio));
}

void CloudPipeline::resize(int width_px, int height_px, double device_pixel_ratio) {
  vtk_->interactor->SetSize(width_px, height_px);
  vtk_->interactor->UpdateSize(width_px, height_px);
  if (vtk_->window) {
    vtk_->window->SetSize(width_px, height_px);
    vtk_->window->SetDPI(static_cast<int>(std::lround(72 * device_pixel_ratio)));
  }
  vtk_->device_pixel_ratio = device_pixel_ratio;
  setPointSize(vtk_->point_size_px);
  vtk_->scaleLines();
}

void CloudPipeline::handle(const CanvasMouse& mouse) {
  if (!vtk_->ready) return;
  if (mouse.kind == CanvasMouse::Kind::kPress) vtk_->editing = false;
  vtk_->interactor->SetEventInformationFlipY(mouse.x, mouse.y, mouse.control ? 1 : 0,
                                             mouse.shift ? 1 : 0);
  const unsigned long event = vtk_event(mouse);
  if (event != vtkCommand::NoEvent) vtk_->interactor->InvokeEvent(event, nullptr);
}

bool CloudPipeline::editingBox() const {
  return vtk_->editing;
}

void CloudPipeline::drawFirst(std::size_t points) {
  if (!vtk_->ready) return;
  if (!vtk_->looked && vtk_->scene) look(CloudViewpoint::kMost);
  vtk_->renderer->PreserveColorBufferOff();
  vtk_->renderer->PreserveDepthBufferOff();
  const std::size_t wanted = std::max<std::size_t>(1, points / kCloudPortion);
  vtk_->drawn = std::min(vtk_->portions.size(), wanted);
  vtk_->showPortions(0, vtk_->drawn);
  vtk_->showMarks(true);
  vtk_->bringLinesForward();
  vtk_->box->SetVisibility(vtk_->box_shown ? 1 : 0);
  vtk_->setClipping();
  vtk_->render();
}

void CloudPipeline::drawMore(std::size_t points) {
  if (!vtk_->ready || complete()) return;
  // Adds to the picture: colours and depths of what is there already are kept.
  vtk_->renderer->PreserveColorBufferOn();
  vtk_->renderer->PreserveDepthBufferOn();
  const std::size_t wanted = std::max<std::size_t>(1, points / kCloudPortion);
  const std::size_t end = std::min(vtk_->portions.size(), vtk_->drawn + wanted);
  vtk_->showPortions(vtk_->drawn, end);
  vtk_->showMarks(false);
  vtk_->box->SetVisibility(0);
  vtk_->drawn = end;
  vtk_->render();
}

bool CloudPipeline::complete() const {
  return vtk_->drawn >= vtk_->portions.size();
}

std::size_t CloudPipeline::drawnPoints() const {
  return vtk_->scene ? std::min(vtk_->drawn * kCloudPortion, vtk_->scene->size()) : 0;
}

void CloudPipeline::copyTo(unsigned framebuffer, int width_px, int height_px) {
  if (!vtk_->ready) return;
  vtkOpenGLFramebufferObject* source = vtk_->window->GetDisplayFramebuffer();
  vtkOpenGLState* state = vtk_->window->GetState();
  state->Reset();
  state->Push();
  source->Bind(GL_READ_FRAMEBUFFER);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, width_px, height_px, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  // Not waiting here would put the time of this frame into the next one's bill.
  glFinish();
  state->Pop();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

Eigen::Matrix4d CloudPipeline::clipFromWorld() const {
  const double aspect = vtk_->renderer->GetTiledAspectRatio();
  const vtkMatrix4x4* matrix =
      vtk_->renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(aspect, -1, 1);
  return as_eigen(matrix);
}

}  // namespace lvcalib::widgets
