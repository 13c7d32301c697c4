// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Plain pages with the interface of the real ones, for a build without widgets/pages.

#include <QImage>
#include <QLabel>
#include <QVBoxLayout>
#include <QWidget>
#include <memory>
#include <optional>

#include "pipeline/calibration.h"

namespace lvcalib::widgets {

class PlainPage : public QWidget {
  Q_OBJECT

 public:
  explicit PlainPage(QWidget* parent = nullptr) : QWidget(parent), label_(new QLabel(this)) {
    (new QVBoxLayout(this))->addWidget(label_);
  }
  void setResult(const std::shared_ptr<const CalibrationResult>& result) {
    label_->setText(result ? QString::fromStdString(result->dataset) : QString());
  }
  void setScene(int /*index*/) {}

 private:
  QLabel* label_;
};

class ScenePage : public PlainPage {
  Q_OBJECT

 public:
  using PlainPage::PlainPage;
  void setSceneData(const std::shared_ptr<const Cloud>& /*cloud*/, const QImage& /*image*/) {}
  void setCropBox(const std::optional<CropBox>& /*box*/) {}

 Q_SIGNALS:
  void cropChanged(int scene, const lvcalib::CropBox& box);
  void cropCleared(int scene);
  void failed(const QString& message);
};

class RefinementPage : public PlainPage {
  Q_OBJECT

 public:
  using PlainPage::PlainPage;
  void showIteration(int /*scene*/, const std::shared_ptr<const BoardRefinement>& /*partial*/) {}
};

class ExtrinsicPage : public PlainPage {
  Q_OBJECT

 public:
  using PlainPage::PlainPage;

 Q_SIGNALS:
  void sceneActivated(int scene);
};

}  // namespace lvcalib::widgets
