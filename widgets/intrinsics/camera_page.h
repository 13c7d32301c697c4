// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <map>
#include <memory>
#include <optional>

#include "dialogs/choices.h"
#include "pipeline/calibration.h"
#include "pipeline/camera_figures.h"
#include "pipeline/dataset.h"
#include "runner/camera_work.h"
#include "runner/runner.h"

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTabWidget;
class QTextBrowser;
class QToolButton;
class QTreeWidget;

namespace lvcalib::widgets {

class ImageView;

/// Images of a board that no dataset holds.
struct BoardPhotos {
  std::filesystem::path folder;  ///< Where camera.yaml goes, if nothing else is said.
  std::vector<std::filesystem::path> images;
  Target target;
  CameraCalibrationOptions options;
};

class ResidualMapPlot;
class UncertaintyMapPlot;

/// The camera: its intrinsics with their standard deviations as given, as estimated with the
/// extrinsic and from images alone; what speaks against them; every image with its residuals; the
/// corners' residual field over the image, of which some can be brushed to leave out their tags,
/// and how well a direction is known there.
class CameraPage : public QWidget {
  Q_OBJECT

 public:
  /// Of a dataset, or of photos: these need none, and have nothing but the images.
  enum class Of { kDataset, kPhotos };
  explicit CameraPage(QWidget* parent = nullptr, Of of = Of::kDataset);
  ~CameraPage() override;

  /// Answers questions about files; must outlive this. Without it images are looked at only.
  void setChoices(Choices& choices);
  /// What is open; nothing: no dataset.
  void setDataset(std::optional<Dataset> dataset);
  /// Nothing: none are chosen, or they cannot be read. What was made of others goes.
  void setPhotos(std::optional<BoardPhotos> photos);
  void setResult(std::shared_ptr<const CalibrationResult> result);

  [[nodiscard]] bool busy() const { return work_.busy() || figures_worker_.running(); }
  [[nodiscard]] std::shared_ptr<const CameraCalibration> calibration() const { return alone_; }

 Q_SIGNALS:
  /// The dataset's images, or its camera.yaml, have changed on disk.
  void datasetChanged();
  /// Tags of which corners are selected are to be left out of these scenes.
  void excludeWanted(const std::map<QString, lvcalib::SceneEdits>& more);
  void failed(const QString& message);
  void saved(const QString& path);

 protected:
  void changeEvent(QEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* createKnowledge();
  QWidget* createFigures();
  void connectParts();
  void retranslate();
  void addImages();
  void calibrate();
  void save();
  void takeCalibration(const std::shared_ptr<const CameraCalibration>& calibration);
  void ask();
  void showFigures();
  void showText();
  void showImages();
  void showImage();
  void showOverlay(int index);
  void showState();
  void brush(const QRectF& area_px);
  void clearBrush();
  void showBrushed();
  [[nodiscard]] bool showsAlone() const;
  [[nodiscard]] std::filesystem::path pathOf(const CameraFigures::Image& image) const;
  [[nodiscard]] const Camera* shownCamera() const;

  const Of of_;
  Choices* choices_ = nullptr;
  std::optional<BoardPhotos> photos_;
  std::optional<Dataset> dataset_;
  std::shared_ptr<const CalibrationResult> result_;
  std::shared_ptr<const CameraCalibration> alone_;
  std::shared_ptr<const CameraFigures> figures_;  // Of what is shown.
  bool stale_ = true;                             // The figures are not of what is shown.
  std::optional<Error> error_;

  QLabel* shown_label_;
  QComboBox* shown_;
  QPushButton* add_;
  QPushButton* calibrate_;
  QPushButton* save_;
  QProgressBar* progress_;
  QPushButton* cancel_;
  QLabel* message_;
  QTextBrowser* text_ = nullptr;
  QTreeWidget* images_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  QToolButton* brush_ = nullptr;
  QToolButton* exclude_ = nullptr;
  std::map<QString, SceneEdits> brushed_;  // The tags of the corners selected, by scene.
  ResidualMapPlot* residuals_ = nullptr;
  UncertaintyMapPlot* uncertainty_ = nullptr;
  ImageView* image_ = nullptr;
  Runner figures_worker_;
  Runner image_loader_;
  CameraWork work_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
