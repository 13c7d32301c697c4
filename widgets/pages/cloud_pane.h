// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "views/cloud_pipeline.h"
#include "views/cloud_scene.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;
class QLabel;

namespace lvcalib::widgets {

class CloudSceneBuilder;
class CloudView;
class CropForm;
class ToolRow;

/// A cloud view with its tool bar (colour, points shown, viewpoint, crop) and the crop box's
/// numbers. Pictures are built in the background.
class CloudPane : public QWidget {
  Q_OBJECT

 public:
  explicit CloudPane(QWidget* parent = nullptr);

  /// What to show; colour, filter and crop box are the pane's own and are filled in.
  void setInput(CloudSceneInput input, std::vector<CloudLine> lines);
  /// What the model leaves over the board, if that is another than the input's.
  void setSurface(std::function<std::optional<BoardSurface>()> surface);
  /// The crop box in force; none: not cropped.
  void setCrop(const std::optional<CropBox>& box);
  /// The box to begin with when there is none.
  void setSuggestedBox(const CropBox& box) { suggested_ = box; }
  void setColor(CloudColor color);
  void setFilter(CloudFilter filter);

  [[nodiscard]] CloudView* view() const { return view_; }
  /// True while a picture is being built.
  [[nodiscard]] bool busy() const;

 Q_SIGNALS:
  /// Another picture is in the view.
  void sceneShown();
  void cropApplied(const lvcalib::CropBox& box);
  void cropCleared();

 private:
  void createToolBar();
  void createCrop();
  void retranslate();
  void rebuild();
  void display(const std::shared_ptr<const CloudScene>& scene);
  void editCrop(const CropBox& box);
  void toggleCrop(bool shown);
  void updateCount();
  void showLines();

  CloudSceneInput input_;
  std::vector<CloudLine> lines_;
  std::optional<CropBox> crop_;    ///< In force.
  std::optional<CropBox> edited_;  ///< Shown with handles.
  CropBox suggested_;
  std::optional<std::pair<double, double>> range_;  ///< Of the colours, if the user chose one.
  CloudView* view_ = nullptr;
  CloudSceneBuilder* builder_ = nullptr;
  CropForm* crop_form_ = nullptr;
  ToolRow* bar_ = nullptr;
  QComboBox* color_ = nullptr;
  QComboBox* filter_ = nullptr;
  QAction* crop_action_ = nullptr;
  QAction* axes_action_ = nullptr;
  QAction* brush_action_ = nullptr;
  QAction* unused_action_ = nullptr;
  QDoubleSpinBox* size_ = nullptr;
  QLabel* count_ = nullptr;
};

}  // namespace lvcalib::widgets
