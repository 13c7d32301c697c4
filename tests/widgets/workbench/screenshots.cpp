// SPDX-License-Identifier: GPL-3.0-or-later
// Usage: lvcalib-screenshots FOLDER [DATASET]. Opens a dataset (without one: the demo), runs it and
// writes a picture of every page and dialog to the folder, in light and dark.

#include <QApplication>
#include <QDialog>
#include <QDir>
#include <QListWidget>
#include <QScreen>
#include <QSurfaceFormat>
#include <QTabWidget>
#include <QTemporaryDir>
#include <cstdio>

#include "widgets/support/driver.h"

namespace {

using namespace lvcalib;

class Photographer {
 public:
  Photographer(widgets::MainWindow& window, QString folder)
      : window_(window), folder_(std::move(folder)) {}

  void take(const QString& name, QWidget* widget = nullptr) {
    QTest::qWait(800);  // Views build their scenes in the background.
    QWidget* shown = widget == nullptr ? &window_ : widget;
    const QString path = QDir(folder_).filePath(name + QStringLiteral(".png"));
    // From the screen: a grab of widgets would miss what OpenGL drew.
    const QRect r = shown->frameGeometry();
    const QPixmap picture =
        QGuiApplication::primaryScreen()->grabWindow(0, r.x(), r.y(), r.width(), r.height());
    if (!picture.save(path)) std::fprintf(stderr, "cannot write %s\n", qPrintable(path));
  }

 private:
  widgets::MainWindow& window_;
  QString folder_;
};

int photograph(widgets::MainWindow& window, const QString& folder, const QString& dataset) {
  Photographer camera(window, folder);
  window.move(0, 0);
  window.show();
  camera.take(QStringLiteral("welcome"));
  if (dataset.isEmpty()) {
    test::trigger(window, "demo");
  } else {
    window.open(dataset);
  }
  if (!test::wait_until([&] { return window.workspace().is_open(); })) return 1;
  camera.take(QStringLiteral("opened"));
  test::trigger(window, "run");
  if (!test::wait_until(
          [&] { return window.workspace().result() != nullptr && !window.workspace().busy(); }))
    return 1;
  auto* tabs = test::find<QTabWidget>(window, "pages");
  for (const char* theme : {"light", "dark"}) {
    for (QAction* action : window.findChildren<QAction*>(QStringLiteral("theme"))) {
      if (action->data().toString() == QLatin1String(theme)) action->trigger();
    }
    for (int tab = 0; tab < tabs->count(); ++tab) {
      tabs->setCurrentIndex(tab);
      camera.take(QStringLiteral("%1-%2").arg(
          QStringList{QStringLiteral("scene"), QStringLiteral("refinement"),
                      QStringLiteral("extrinsic"), QStringLiteral("response")}
              .value(tab),
          QLatin1String(theme)));
    }
    test::trigger(window, "results");
    if (auto* results = test::find<QDialog>(window, "results_dialog")) {
      camera.take(QStringLiteral("results-") + QLatin1String(theme), results);
      test::find<QTabWidget>(*results, "results_tabs")->setCurrentIndex(1);
      auto* formats = test::find<QListWidget>(*results, "formats");
      formats->setCurrentItem(
          formats->findItems(QStringLiteral("kalibr"), Qt::MatchExactly).value(0));
      camera.take(QStringLiteral("exports-") + QLatin1String(theme), results);
      results->close();
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication application(argc, argv);
  const QStringList arguments = QApplication::arguments();
  if (arguments.size() < 2) {
    std::fprintf(stderr, "usage: lvcalib-screenshots FOLDER [DATASET]\n");
    return 2;
  }
  QDir().mkpath(arguments.at(1));
  QTemporaryDir settings_folder;
  widgets::AppSettings settings(settings_folder.path());
  widgets::apply_theme(application, widgets::Theme::kLight);
  test::Answers answers;
  int status = 0;
  {
    widgets::MainWindow window(settings, answers);
    status = photograph(window, arguments.at(1), arguments.value(2));
  }
  widgets::Runner::wait_for_workers(10'000);
  return status;
}
