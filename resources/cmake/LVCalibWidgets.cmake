# SPDX-License-Identifier: GPL-3.0-or-later
# Qt 6, VTK and QCustomPlot, and the helper that declares a folder of widgets/.
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Gui Widgets OpenGL OpenGLWidgets PrintSupport Svg
             LinguistTools)
# Looks for Qt6::PrintSupport, so it comes after Qt 6.
find_package(QCustomPlotQt6 REQUIRED)
# Named modules only: Debian's VTK::GUISupportQt is built with Qt 5 and must not come in.
set(LVCALIB_VTK_MODULES CommonColor CommonCore CommonDataModel CommonExecutionModel CommonMath
    CommonTransforms FiltersCore FiltersGeneral FiltersSources InteractionStyle InteractionWidgets
    RenderingAnnotation RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(VTK 9.1 REQUIRED COMPONENTS ${LVCALIB_VTK_MODULES})
list(TRANSFORM LVCALIB_VTK_MODULES PREPEND "VTK::" OUTPUT_VARIABLE LVCALIB_VTK_LIBRARIES)

# Not <QtGui> as a whole: it takes OpenGL's headers along, which must come after VTK's.
set(LVCALIB_QT_HEADERS <QtCore> <QAction> <QApplication> <QCheckBox> <QColor> <QComboBox> <QDialog>
  <QDockWidget> <QDoubleSpinBox> <QFileDialog> <QFont> <QFormLayout> <QGridLayout> <QHBoxLayout>
  <QHeaderView> <QIcon> <QImage> <QLabel> <QLineEdit> <QListWidget> <QMainWindow> <QMenu>
  <QMessageBox> <QPainter> <QPixmap> <QPushButton> <QScrollArea> <QSpinBox> <QSplitter>
  <QStackedWidget> <QStyledItemDelegate> <QTabWidget> <QTableView> <QTextBrowser> <QToolBar>
  <QToolButton> <QTreeView> <QVBoxLayout> <QWidget>)
lvcalib_precompiled_headers(widgets LIBRARY
  HEADERS ${LVCALIB_QT_HEADERS}
  LIBRARIES Eigen3::Eigen Qt6::Core Qt6::Gui Qt6::Widgets
  DEFINITIONS QT_NO_FOREACH QT_NO_KEYWORDS QT_NO_CAST_TO_ASCII)

# lvcalib_widgets_room(NAME SOURCES a.cpp a.h … [ROOMS style …] [LIBRARIES Foo::foo …])
# One folder of widgets/ is one static library lvcalib_widgets_NAME; ROOMS are the folders it may
# include. List headers with Q_OBJECT among the sources if they have no .cpp of the same name.
function(lvcalib_widgets_room NAME)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  set(target lvcalib_widgets_${NAME})
  add_library(${target} STATIC ${ROOM_SOURCES})
  set_target_properties(${target} PROPERTIES AUTOMOC ON)
  target_compile_definitions(${target} PRIVATE QT_NO_FOREACH QT_NO_KEYWORDS
                             QT_NO_CAST_TO_ASCII)
  lvcalib_precompile(${target} widgets)
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/widgets")
  target_link_libraries(${target} PUBLIC LVCalib::core Qt6::Core Qt6::Gui Qt6::Widgets
                        PRIVATE lvcalib_warnings Threads::Threads)
  foreach(room IN LISTS ROOM_ROOMS)
    target_link_libraries(${target} PUBLIC lvcalib_widgets_${room})
  endforeach()
  target_link_libraries(${target} PRIVATE ${ROOM_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY LVCALIB_WIDGETS_ROOMS ${target})
endfunction()

# lvcalib_use_vtk(TARGET): links the named VTK modules and has their factories registered.
function(lvcalib_use_vtk TARGET)
  target_link_libraries(${TARGET} PRIVATE Qt6::OpenGL Qt6::OpenGLWidgets ${LVCALIB_VTK_LIBRARIES})
  vtk_module_autoinit(TARGETS ${TARGET} MODULES ${LVCALIB_VTK_LIBRARIES})
endfunction()
