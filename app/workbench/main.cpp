// SPDX-License-Identifier: GPL-3.0-or-later
#include <QApplication>
#include <QMainWindow>
#include <QSurfaceFormat>

#include "style/theme.h"

int main(int argc, char** argv) {
  // VTK needs this context; it must be asked for before the application exists.
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);

  QApplication application(argc, argv);
  lvcalib::widgets::apply_theme(application, lvcalib::widgets::Theme::kSystem);
  QMainWindow window;
  window.show();
  return QApplication::exec();
}
