// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/threshold_pane.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "pipeline/options.h"
#include "pipeline/refusals.h"
#include "report/result_comparison.h"
#include "style/texts.h"
#include "views/threshold_plot.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr double kLowestGate = 1.0;
constexpr double kHighestGate = 1000.0;
constexpr int kMostNamed = 6;

// Tags and circles that a result refuses.
std::vector<Refusal> refused_features(const CalibrationResult& result) {
  std::vector<Refusal> out = refusals(result);
  std::erase_if(out, [](const Refusal& r) {
    return r.what != Refusal::What::kTag && r.what != Refusal::What::kCircle;
  });
  return out;
}

bool is_among(const std::vector<Refusal>& all, const Refusal& one) {
  return std::any_of(all.begin(), all.end(), [&](const Refusal& r) {
    return r.scene == one.scene && r.what == one.what && r.id == one.id;
  });
}

}  // namespace

ThresholdPane::ThresholdPane(QWidget* parent)
    : QWidget(parent),
      intro_(new QLabel(this)),
      tags_(new ThresholdPlot(this)),
      circles_(new ThresholdPlot(this)),
      preview_(new QLabel(this)),
      use_(new QPushButton(this)),
      back_(new QPushButton(this)) {
  intro_->setWordWrap(true);
  tags_->setObjectName(QStringLiteral("gate_tags"));
  circles_->setObjectName(QStringLiteral("gate_circles"));
  preview_->setObjectName(QStringLiteral("gate_preview"));
  preview_->setWordWrap(true);
  preview_->setMinimumHeight(4 * preview_->fontMetrics().lineSpacing());
  preview_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  preview_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  use_->setObjectName(QStringLiteral("use_gate"));
  back_->setObjectName(QStringLiteral("drop_gate"));
  auto* buttons = new QHBoxLayout;
  buttons->addStretch(1);
  buttons->addWidget(back_);
  buttons->addWidget(use_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 4, 0, 0);
  layout->addWidget(intro_);
  layout->addWidget(tags_, 1);
  layout->addWidget(circles_, 1);
  layout->addWidget(preview_);
  layout->addLayout(buttons);
  for (ThresholdPlot* plot : {tags_, circles_}) {
    connect(plot, &ThresholdPlot::thresholdMoved, this, [this](double gate) {
      moveLines(gate);
      Q_EMIT previewWanted(gate);
    });
    connect(plot->figureActions(), &FigureActions::failed, this, &ThresholdPane::failed);
  }
  connect(use_, &QPushButton::clicked, this, [this] { Q_EMIT gateWanted(tags_->threshold()); });
  connect(back_, &QPushButton::clicked, this, [this] {
    back();
    Q_EMIT previewDropped();
  });
  follow_language(this, [this] { retranslate(); });
}

double ThresholdPane::presentGate() const {
  return result_ ? result_->options.extrinsic.rejection_gate
                 : CalibrationOptions{}.extrinsic.rejection_gate;
}

void ThresholdPane::retranslate() {
  intro_->setText(tr(
      "What tags and circles miss the board's final pose by, in standard deviations. Red ones are "
      "left out. Hatched ones lie beyond the line and are in use all the same: they were judged "
      "against the poses that tags and circles give alone, and every return has moved these since. "
      "Drag the line (or use the arrow keys) to see what another place would do."));
  tags_->setValueLabel(tr("a tag's worst corner (σ)"), QStringLiteral("worst_corner_sigmas"));
  circles_->setValueLabel(tr("a circle's centre (σ)"), QStringLiteral("circle_sigmas"));
  for (ThresholdPlot* plot : {tags_, circles_})
    plot->setToolTip(tr(
        "Red: left out at this place of the line. Before the solve has answered, what lies beyond "
        "the line; the solve may judge a few of them otherwise, since the board moves too."));
  use_->setText(tr("Use this threshold"));
  back_->setText(tr("Back"));
  setResult(result_);
}

void ThresholdPane::setResult(std::shared_ptr<const CalibrationResult> result) {
  result_ = std::move(result);
  back();
}

// What a result misses the boards by, and which of it the result refuses.
void ThresholdPane::showDistances(const CalibrationResult* result) {
  std::vector<double> tags;
  std::vector<double> circles;
  std::vector<bool> refused_tags;
  std::vector<bool> refused_circles;
  if (result != nullptr) {
    for (const GateDistance& d : gate_distances(*result)) {
      const bool tag = d.what == Refusal::What::kTag;
      (tag ? tags : circles).push_back(d.sigmas);
      (tag ? refused_tags : refused_circles).push_back(!d.used);
    }
  }
  const QString none = result != nullptr ? QString() : tr("Run the calibration first.");
  tags_->setValues(std::move(tags), none, std::move(refused_tags));
  circles_->setValues(std::move(circles), result != nullptr ? tr("No circles are in use.") : none,
                      std::move(refused_circles));
}

void ThresholdPane::back() {
  moveLines(presentGate());
  showDistances(result_.get());
  preview_->clear();
}

void ThresholdPane::moveLines(double gate) {
  for (ThresholdPlot* plot : {tags_, circles_}) plot->setThreshold(gate, kLowestGate, kHighestGate);
  use_->setEnabled(result_ && gate != presentGate());
  back_->setEnabled(use_->isEnabled());
}

void ThresholdPane::setBusy() {
  preview_->setText(tr("Solving with %1 σ …").arg(tags_->threshold(), 0, 'f', 1));
}

void ThresholdPane::setError(const Error& error) {
  preview_->setText(core_text(error));
}

QString ThresholdPane::moveText(const CalibrationResult& present,
                                const CalibrationResult& preview) {
  const ExtrinsicDifference d =
      difference_of(stated_result(present).extrinsic, stated_result(preview).extrinsic);
  // What the page beside it states, where that is known.
  const Matrix6d& covariance = preview.covariance_total.trace() > 0.0
                                   ? preview.covariance_total
                                   : preview.extrinsic.camera_from_lidar.covariance;
  return tr("The extrinsic would move by %1 mm and %2 mrad; it would be known to %3 mm and %4 "
            "mrad.")
      .arg(d.translation_mm, 0, 'f', 3)
      .arg(d.rotation_mrad, 0, 'f', 3)
      .arg(1e3 * std::sqrt(covariance.diagonal().head<3>().sum()), 0, 'f', 3)
      .arg(1e3 * std::sqrt(covariance.diagonal().tail<3>().sum()), 0, 'f', 3);
}

void ThresholdPane::setPreview(const CalibrationResult& present, const CalibrationResult& preview) {
  const auto now = refused_features(present);
  const auto then = refused_features(preview);
  const auto named = [](const std::vector<Refusal>& all, const std::vector<Refusal>& but) {
    QStringList names;
    int more = 0;
    for (const Refusal& r : all) {
      if (is_among(but, r)) continue;
      if (names.size() >= kMostNamed) {
        ++more;
        continue;
      }
      const QString scene = QString::fromStdString(r.scene);
      names << (r.what == Refusal::What::kTag ? tr("%1: tag %2") : tr("%1: circle %2"))
                   .arg(scene)
                   .arg(r.id);
    }
    if (more > 0) names << tr("%n more", nullptr, more);
    return names.join(tr(", "));
  };
  QString text = tr("With %1 σ, %2 tags and circles are left out (now %3).")
                     .arg(preview.options.extrinsic.rejection_gate, 0, 'f', 1)
                     .arg(then.size())
                     .arg(now.size());
  const QString out = named(then, now);
  const QString in = named(now, then);
  if (!out.isEmpty()) text += QLatin1Char(' ') + tr("Newly left out: %1.").arg(out);
  if (!in.isEmpty()) text += QLatin1Char(' ') + tr("Used again: %1.").arg(in);
  text += QLatin1Char('\n') + moveText(present, preview);
  preview_->setText(text);
  if (preview.options.extrinsic.rejection_gate == tags_->threshold()) showDistances(&preview);
}

}  // namespace lvcalib::widgets

#include "moc_threshold_pane.cpp"
