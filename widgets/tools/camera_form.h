// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>
#include <string>

#include "camera/camera.h"
#include "camera/camera_deviations.h"

class QComboBox;
class QLabel;

namespace lvcalib::widgets {

class CameraPreview;
class KeyForm;

/// The keys of camera.yaml as a form, with what the lens does to straight lines.
class CameraForm : public QWidget {
  Q_OBJECT

 public:
  explicit CameraForm(QWidget* parent = nullptr);

  void setCamera(const Camera& camera, const std::optional<CameraDeviations>& deviations);
  /// The file's content.
  [[nodiscard]] std::string text() const;
  /// What the core's reader makes of it; nothing if it complains.
  [[nodiscard]] const std::optional<Camera>& camera() const { return camera_; }
  [[nodiscard]] const KeyForm& keys() const { return *form_; }

 Q_SIGNALS:
  /// After the text was checked.
  void edited();

 private:
  void retranslate();
  void chooseModel();
  void check();
  [[nodiscard]] QStringList coefficients() const;

  std::optional<Camera> camera_;
  QLabel* model_label_;
  QComboBox* model_;
  KeyForm* form_;
  QLabel* problem_;
  CameraPreview* preview_;
  QLabel* view_;
};

}  // namespace lvcalib::widgets
