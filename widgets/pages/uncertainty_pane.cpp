// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_pane.h"

#include <QSplitter>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "pages/uncertainty_text.h"
#include "style/texts.h"
#include "views/uncertainty_plots.h"

namespace lvcalib::widgets {

UncertaintyPane::UncertaintyPane(QWidget* parent) : QWidget(parent) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 4, 0, 0);
  auto* across = new QSplitter(Qt::Horizontal, this);
  across->setChildrenCollapsible(false);
  text_ = new QTextBrowser(across);
  text_->setObjectName("uncertainty");
  auto* plots = new QSplitter(Qt::Vertical, across);
  plots->setChildrenCollapsible(false);
  map_ = new UncertaintyMapPlot(plots);
  range_ = new UncertaintyRangePlot(plots);
  connect(map_->figureActions(), &FigureActions::failed, this, &UncertaintyPane::failed);
  connect(range_->figureActions(), &FigureActions::failed, this, &UncertaintyPane::failed);
  across->setSizes({520, 480});
  layout->addWidget(across);
  follow_language(this, [this] { text_->setAccessibleName(tr("Uncertainty")); });
}

void UncertaintyPane::setText(const CalibrationResult* result) {
  text_->setHtml(result != nullptr ? uncertainty_html(*result, palette()) : QString());
}

void UncertaintyPane::setResult(const CalibrationResult* result) {
  setText(result);
  if (result == nullptr) {
    map_->setMap(std::nullopt, {});
    range_->setRanges({});
    return;
  }
  const UncertaintyReport& report = result->uncertainty;
  const QSize image(result->camera.width_px, result->camera.height_px);
  map_->setMap(report.maps.empty() ? std::optional<ProjectedUncertainty>() : report.maps.front(),
               image);
  range_->setRanges(report.by_range);
}

}  // namespace lvcalib::widgets
