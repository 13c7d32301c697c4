// SPDX-License-Identifier: GPL-3.0-or-later
#include <QApplication>
#include <QCommandLineParser>
#include <QIcon>
#include <QSurfaceFormat>
#include <QTimer>

#include "runner/memory.h"
#include "start/app_settings.h"
#include "workbench/language.h"
#include "workbench/main_window.h"

namespace {

// VTK needs this context; it must be asked for before the application exists.
void ask_for_opengl() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
}

int run(QApplication& application) {
  using namespace lvcalib::widgets;
  use_language({});  // For the help; the settings may say otherwise below.
  QCommandLineParser parser;
  parser.setApplicationDescription(
      QCoreApplication::translate("main", "LiDAR-camera calibration with a printed board"));
  parser.addHelpOption();
  parser.addVersionOption();
  const QCommandLineOption settings_option(
      QStringLiteral("settings"),
      QCoreApplication::translate("main", "Folder for settings and data, instead of the user's."),
      QStringLiteral("folder"));
  parser.addOption(settings_option);
  const QCommandLineOption truth_option(
      QStringLiteral("truth"),
      QCoreApplication::translate("main",
                                  "Truth of a simulated dataset, to show the distance to it."),
      QStringLiteral("file"));
  parser.addOption(truth_option);
  parser.addPositionalArgument(QStringLiteral("path"),
                               QCoreApplication::translate("main", "Dataset folder or project."),
                               QStringLiteral("[DATASET|PROJECT]"));
  parser.process(application);
  const auto settings = parser.isSet(settings_option)
                            ? std::make_unique<AppSettings>(parser.value(settings_option))
                            : std::make_unique<AppSettings>();
  apply_theme(application, settings->theme());
  use_language(settings->language());
  Choices choices;
  MainWindow window(*settings, choices);
  if (parser.isSet(truth_option)) window.set_truth(parser.value(truth_option));
  window.show();
  QTimer::singleShot(0, &window, [&] {
    if (!parser.positionalArguments().isEmpty()) {
      window.open(parser.positionalArguments().constFirst());
    } else {
      window.offer_recovery();
    }
  });
  return QApplication::exec();
}

}  // namespace

int main(int argc, char** argv) {
  lvcalib::widgets::give_memory_back();
  ask_for_opengl();
  QApplication application(argc, argv);
  QApplication::setApplicationName(QStringLiteral("lvcalib-workbench"));
  QApplication::setOrganizationName(QStringLiteral("LV-Calib"));
  QApplication::setApplicationVersion(QStringLiteral(LVCALIB_VERSION));
  QGuiApplication::setDesktopFileName(QStringLiteral("lvcalib-workbench"));
  QApplication::setWindowIcon(QIcon::fromTheme(
      QStringLiteral("lvcalib-workbench"), QIcon(QStringLiteral(":/icons/lvcalib-workbench.svg"))));
  const int status = run(application);
  // A stage that could not stop at once must not run while the program is torn down. All have been
  // asked to stop, and look for that many times a second.
  lvcalib::widgets::Runner::wait_for_workers(-1);
  return status;
}
