// SPDX-License-Identifier: GPL-3.0-or-later
// Usage: lvcalib-screenshots FOLDER [DATASET]. Opens a dataset (without one: the demo), runs it and
// writes a picture of every page and dialog to the folder, in light and dark.

#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QListWidget>
#include <QPushButton>
#include <QScreen>
#include <QSurfaceFormat>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <cstdio>

#include "modelling/residual_plot.h"
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

bool wait_for_model(widgets::MainWindow& window) {
  return test::wait_until([&] { return window.model_work().step() && !window.model_work().busy(); },
                          600'000);
}

// The Model page from the first look to the fallen error, and everything that it can show.
void photograph_model(widgets::MainWindow& window, Photographer& camera, const QString& theme) {
  const auto name = [&](const char* state) {
    return QStringLiteral("model-%1-%2").arg(QLatin1String(state), theme);
  };
  window.model_work().go_to(0);
  if (!wait_for_model(window)) return;
  auto* where = test::find<QTabWidget>(window, "where_tabs");
  camera.take(name("missing"));
  auto* missing_tabs = test::find<QTreeWidget>(window, "sensitivity");
  auto* right = qobject_cast<QTabWidget*>(missing_tabs->parentWidget()->parentWidget());
  if (right != nullptr) {
    right->setCurrentIndex(1);
    camera.take(name("unseen"));
    right->setCurrentIndex(0);
  }
  auto* effect = test::find<QComboBox>(window, "what_if_effect");
  effect->setCurrentIndex(effect->findData(QStringLiteral("range_cyclic")));
  camera.take(name("what-if"));
  effect->setCurrentIndex(0);
  test::find<QPushButton>(window, "add_effect")->click();
  if (auto* dialog = test::find<QDialog>(window, "add_effect_dialog")) {
    camera.take(name("add"), dialog);
    for (auto* tabs : dialog->findChildren<QTabWidget*>()) tabs->setCurrentIndex(1);
    camera.take(name("formula"), dialog);
    dialog->close();
  }
  if (window.model_work().steps().size() > 1) {
    window.model_work().go_to(1);
  } else {
    test::find<QPushButton>(window, "add_proposal")->click();
    test::wait_until([&] { return window.model_work().current() == 1; }, 600'000);
  }
  if (!wait_for_model(window)) return;
  camera.take(name("added"));
  auto* channel = test::find<QComboBox>(window, "channel");
  const char* const maps[] = {"residuals", "image", "board", "directions", "intensity"};
  for (int tab = 1; tab < where->count(); ++tab) {
    const Channel shown = tab == 1 ? Channel::kCorner : Channel::kRange;
    channel->setCurrentIndex(channel->findData(static_cast<int>(shown)));
    where->setCurrentIndex(tab);
    camera.take(name(maps[tab]));
  }
  where->setCurrentIndex(0);
  auto* plot = test::find<widgets::ResidualPlot>(window, "residual_plot");
  test::find<QToolButton>(window, "brush")->click();
  QTest::qWait(800);
  if (plot->figure()) {
    const auto& f = *plot->figure();
    Q_EMIT plot->brushed(QRectF(QPointF(f.x_low, 0.4 * f.y_high), QPointF(f.x_high, f.y_high)));
  }
  camera.take(name("brush"));
  test::find<QTabWidget>(window, "pages")->setCurrentIndex(0);
  QTest::qWait(1500);
  camera.take(name("brush-scene"));
  test::find<QTabWidget>(window, "pages")->setCurrentIndex(4);
  test::find<QToolButton>(window, "brush")->click();
}

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
  if (!test::wait_until([&] { return !window.workspace().busy(); })) return 1;
  camera.take(QStringLiteral("opened"));
  test::trigger(window, "run");
  if (!test::wait_until(
          [&] { return window.workspace().result() != nullptr && !window.workspace().busy(); }))
    return 1;
  auto* tabs = test::find<QTabWidget>(window, "pages");
  tabs->setCurrentIndex(4);
  camera.take(QStringLiteral("model-looking"));
  wait_for_model(window);
  camera.take(QStringLiteral("model-tour"));
  if (auto* close = test::find<QPushButton>(window, "coach_close")) close->click();
  for (const char* theme : {"light", "dark"}) {
    for (QAction* action : window.findChildren<QAction*>(QStringLiteral("theme"))) {
      if (action->data().toString() == QLatin1String(theme)) action->trigger();
    }
    for (int tab = 0; tab < tabs->count(); ++tab) {
      tabs->setCurrentIndex(tab);
      camera.take(QStringLiteral("%1-%2").arg(
          QStringList{QStringLiteral("scene"), QStringLiteral("refinement"),
                      QStringLiteral("extrinsic"), QStringLiteral("response"),
                      QStringLiteral("model")}
              .value(tab),
          QLatin1String(theme)));
    }
    photograph_model(window, camera, QLatin1String(theme));
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
