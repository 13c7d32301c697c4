// SPDX-License-Identifier: GPL-3.0-or-later
#include <QApplication>
#include <QSurfaceFormat>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <link.h>

namespace {

// Names of OpenGL drivers that are loaded.
int collect_drivers(dl_phdr_info* loaded, std::size_t /*size*/, void* names) {
  const std::string name = loaded->dlpi_name;
  if (name.find("_dri.so") != name.npos || name.find("libGLX_") != name.npos)
    static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

// Until the process ends: what a driver that is unloaded before still holds counts as leaked, and
// by whom is not known any more.
void keep_drivers() {
  std::vector<std::string> names;
  dl_iterate_phdr(collect_drivers, &names);
  for (const std::string& name : names)
    dlopen(name.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE);
}

}  // namespace

// GoogleTest's main with a QApplication; without a platform set, it runs without a screen.
int main(int argc, char** argv) {
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setVersion(3, 2);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setDepthBufferSize(24);
  QSurfaceFormat::setDefaultFormat(format);
  testing::InitGoogleMock(&argc, argv);
  QApplication application(argc, argv);
  const int status = RUN_ALL_TESTS();
  keep_drivers();
  return status;
}
