// SPDX-License-Identifier: GPL-3.0-or-later
// Opens every page on a simulated dataset and saves what it shows: page_screenshots OUT [WIDTH
// HEIGHT]. Needs a screen (xvfb-run). Both palettes.
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QElapsedTimer>
#include <QSurfaceFormat>
#include <QTabWidget>
#include <QTableWidget>
#include <cstdio>
#include <functional>

#include "pages/cloud_pane.h"
#include "pages/colors_pane.h"
#include "pages/extrinsic_page.h"
#include "pages/image_pane.h"
#include "pages/refinement_page.h"
#include "pages/response_page.h"
#include "pages/scene_page.h"
#include "style/theme.h"
#include "views/cloud_view.h"
#include "views/image_view.h"
#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets {
namespace {

void settle(const std::function<bool()>& done, int at_most_ms) {
  QElapsedTimer clock;
  clock.start();
  int quiet = 0;
  while (clock.elapsed() < at_most_ms && quiet < 10) {
    QApplication::processEvents(QEventLoop::AllEvents, 30);
    quiet = done() ? quiet + 1 : 0;
  }
}

bool drawn(const CloudView& view) {
  return !view.hasOpenGl() || !view.canvas()->isVisible() || view.canvas()->complete();
}

class Photographer {
 public:
  Photographer(QString folder, QSize size) : folder_(std::move(folder)), size_(size) {}

  void take(QWidget& page, const QString& name, const std::function<bool()>& done) {
    page.resize(size_);
    page.show();
    settle(done, 20'000);
    const QString path = folder_ + "/" + theme_ + "-" + name + ".png";
    if (!page.grab().save(path)) std::fprintf(stderr, "cannot write %s\n", qPrintable(path));
    std::printf("%s\n", qPrintable(path));
  }
  void setTheme(const QString& theme) { theme_ = theme; }

 private:
  QString folder_;
  QSize size_;
  QString theme_;
};

void photograph_scene(Photographer& photographer, const test::CalibratedDemo& demo) {
  ScenePage page;
  page.setResult(demo.result);
  page.setScene(0);
  page.setSceneData(demo.clouds[0], demo.images[0]);
  const auto done = [&] { return !page.cloudPane()->busy() && drawn(*page.cloudPane()->view()); };
  photographer.take(page, "scene", done);
  auto* crop = page.findChild<QAction*>("crop-action");
  crop->setChecked(true);
  page.cloudPane()->setColor(CloudColor::kHeight);
  page.findChild<QAction*>("show-points")->setChecked(true);
  photographer.take(page, "scene-crop", done);
  crop->setChecked(false);
  page.cloudPane()->setFilter(CloudFilter::kBoard);
  page.cloudPane()->setColor(CloudColor::kResidual);
  settle(done, 5000);
  page.cloudPane()->view()->look(CloudViewpoint::kSensor);
  page.imagePane()->view()->zoomAt(page.imagePane()->view()->viewport()->rect().center(), 2.2);
  const auto& tags = page.imagePane()->view()->overlay().overlay().tags;
  if (!tags.empty()) Q_EMIT page.imagePane()->view()->tagClicked(tags[tags.size() / 2].id);
  photographer.take(page, "scene-board", done);
  page.cloudPane()->setFilter(CloudFilter::kBoundary);
  page.cloudPane()->setColor(CloudColor::kIntensity);
  photographer.take(page, "scene-boundary", done);
}

void photograph(Photographer& photographer, const test::CalibratedDemo& demo) {
  photograph_scene(photographer, demo);
  const auto at_once = [] { return true; };
  RefinementPage refinement;
  refinement.setResult(demo.result);
  refinement.setScene(0);
  refinement.chooseNode(4);
  photographer.take(refinement, "refinement", at_once);
  refinement.setIteration(0);
  photographer.take(refinement, "refinement-first", at_once);
  ExtrinsicPage extrinsic;
  extrinsic.setResult(demo.result);
  extrinsic.setSceneData(0, demo.clouds[0], demo.images[0]);
  photographer.take(extrinsic, "extrinsic", at_once);
  auto* tabs = extrinsic.findChild<QTabWidget*>();
  tabs->setCurrentIndex(1);
  photographer.take(extrinsic, "extrinsic-methods", at_once);
  tabs->setCurrentIndex(2);
  photographer.take(extrinsic, "extrinsic-uncertainty", at_once);
  tabs->setCurrentIndex(3);
  photographer.take(extrinsic, "extrinsic-cloud", [&] {
    return extrinsic.colors()->view()->scene() && drawn(*extrinsic.colors()->view());
  });
  ResponsePage response;
  response.setResult(demo.result);
  photographer.take(response, "response", at_once);
  response.findChild<QTableWidget*>("response-scenes")->setCurrentCell(1, 0);
  photographer.take(response, "response-scene", at_once);
  RefinementPage empty;
  photographer.take(empty, "refinement-empty", at_once);
  ExtrinsicPage none;
  photographer.take(none, "extrinsic-empty", at_once);
  ResponsePage bare;
  photographer.take(bare, "response-empty", at_once);
}

}  // namespace
}  // namespace lvcalib::widgets

int main(int argc, char** argv) {
  QSurfaceFormat format;
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication application(argc, argv);
  const QString folder = argc > 1 ? argv[1] : ".";
  const QSize size(argc > 3 ? QString(argv[2]).toInt() : 1280,
                   argc > 3 ? QString(argv[3]).toInt() : 760);
  if (!QDir().mkpath(folder)) {
    std::fprintf(stderr, "cannot create %s\n", qPrintable(folder));
    return 3;
  }
  using lvcalib::widgets::Theme;
  lvcalib::widgets::Photographer photographer(folder, size);
  const auto demo = lvcalib::test::make_calibrated_demo(4, 0);
  for (const Theme theme : {Theme::kLight, Theme::kDark}) {
    lvcalib::widgets::apply_theme(application, theme);
    photographer.setTheme(lvcalib::widgets::name_of(theme));
    lvcalib::widgets::photograph(photographer, demo);
  }
  return 0;
}
