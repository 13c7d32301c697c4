// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/uncertainty_pane.h"

#include <QGuiApplication>
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
  auto* halves = new QSplitter(Qt::Vertical, this);
  halves->setChildrenCollapsible(false);
  text_ = new QTextBrowser(halves);
  text_->setObjectName("uncertainty");
  text_->setWordWrapMode(QTextOption::WordWrap);  // Never within a word of a narrow column.
  auto* plots = new QSplitter(Qt::Horizontal, halves);
  plots->setChildrenCollapsible(false);
  map_ = new UncertaintyMapPlot(UncertaintyMapPlot::Of::kExtrinsic, plots);
  range_ = new UncertaintyRangePlot(plots);
  connect(map_->figureActions(), &FigureActions::failed, this, &UncertaintyPane::failed);
  connect(range_->figureActions(), &FigureActions::failed, this, &UncertaintyPane::failed);
  plots->setSizes({560, 440});
  halves->setSizes({440, 400});
  layout->addWidget(halves);
  follow_language(this, [this] { text_->setAccessibleName(tr("Uncertainty")); });
}

void UncertaintyPane::setText(const CalibrationResult* result) {
  text_->setHtml(result != nullptr ? uncertainty_html(*result, QGuiApplication::palette())
                                   : QString());
}

void UncertaintyPane::setResult(const CalibrationResult* result) {
  setText(result);
  if (result == nullptr) {
    map_->setMap(std::nullopt, {});
    range_->setRanges({}, {});
    return;
  }
  const UncertaintyReport& report = result->uncertainty;
  const QSize image(result->camera.width_px, result->camera.height_px);
  map_->setMap(report.maps.empty() ? std::optional<ProjectedUncertainty>() : report.maps.front(),
               image);
  const std::optional<UncertaintyReport> total = total_report(*result);
  range_->setRanges(report.by_range, total ? total->by_range : std::vector<RangeUncertainty>());
}

}  // namespace lvcalib::widgets

#include "moc_uncertainty_pane.cpp"
