// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

#include "views/image_overlay.h"

class QAction;
class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace lvcalib::widgets {

class ImageView;
class ToolRow;

/// An image view with its tool bar: what is drawn over the image, how much residuals are enlarged,
/// zoom and grey levels.
class ImagePane : public QWidget {
  Q_OBJECT

 public:
  explicit ImagePane(QWidget* parent = nullptr);

  void setOverlay(ImageOverlay overlay);
  [[nodiscard]] ImageView* view() const { return view_; }

 private:
  void createToolBar();
  void createLevels();
  QAction* addToggle(const char* name, bool on);
  void retranslate();
  void updateParts();
  void updateLevels();
  void automaticLevels();

  ImageView* view_ = nullptr;
  ToolRow* bar_ = nullptr;
  ToolRow* level_bar_ = nullptr;
  QAction* tags_ = nullptr;
  QAction* residuals_ = nullptr;
  QAction* circles_ = nullptr;
  QAction* points_ = nullptr;
  QAction* unused_ = nullptr;
  QAction* brush_ = nullptr;
  QAction* fit_ = nullptr;
  QAction* one_to_one_ = nullptr;
  QAction* automatic_ = nullptr;
  QDoubleSpinBox* factor_ = nullptr;
  QLabel* black_label_ = nullptr;
  QLabel* white_label_ = nullptr;
  QSlider* black_ = nullptr;
  QSlider* white_ = nullptr;
  QLabel* place_ = nullptr;
};

}  // namespace lvcalib::widgets
