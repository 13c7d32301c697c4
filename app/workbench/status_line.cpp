// SPDX-License-Identifier: GPL-3.0-or-later
#include "workbench/status_line.h"

#include <QEvent>
#include <QLabel>
#include <QLayout>
#include <QProgressBar>
#include <QStringList>

#include "report/stored_model.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr int kSteps = 1000;

}  // namespace

StatusLine::StatusLine(QWidget* parent)
    : QStatusBar(parent),
      stage_(new QLabel(this)),
      bar_(new QProgressBar(this)),
      text_(new QLabel(this)),
      mark_(new QLabel(this)),
      quality_(new QLabel(this)) {
  stage_->setObjectName(QStringLiteral("stage"));
  bar_->setObjectName(QStringLiteral("progress"));
  text_->setObjectName(QStringLiteral("status"));
  quality_->setObjectName(QStringLiteral("quality"));
  mark_->setObjectName(QStringLiteral("quality_mark"));
  bar_->setRange(0, kSteps);
  bar_->setFormat(QStringLiteral("%p %"));
  bar_->setFixedWidth(220);
  text_->setTextFormat(Qt::PlainText);
  // A long message must not widen the window.
  text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  addWidget(stage_);
  addWidget(bar_);
  addWidget(text_, 1);
  addPermanentWidget(mark_);
  addPermanentWidget(quality_);
  show_idle({});
}

void StatusLine::show_progress(const QString& stage, double fraction, const QString& text) {
  // Stages have names of their own in the core; these are for people.
  const std::pair<const char*, QString> names[] = {{"load", tr("Reading")},
                                                   {"detect", tr("Looking at images")},
                                                   {"localize", tr("Searching")},
                                                   {"refine", tr("Refining")},
                                                   {"optimize", tr("Solving")},
                                                   {"simulate", tr("Simulating")},
                                                   {"table", tr("Fitting the model")},
                                                   {"normals", tr("Correcting")},
                                                   {"model", tr("Fitting the model")},
                                                   {"structure", tr("Looking for structure")},
                                                   {"rank", tr("Trying effects")},
                                                   {"verdicts", tr("Trying effects")},
                                                   {"advice", tr("Looking for advice")},
                                                   {"plan", tr("Planning")},
                                                   {"check", tr("Checking")},
                                                   {"correct", tr("Correcting")},
                                                   {"open", tr("Opening")},
                                                   {"write", tr("Writing")},
                                                   {"draw", tr("Drawing")},
                                                   {"report", tr("Writing the report")}};
  QString name = stage;
  for (const auto& [key, words] : names) {
    if (stage == QLatin1String(key)) name = words;
  }
  stage_->setText(name);
  stage_->show();
  // A bar draws itself at once, and with it the whole window: here with all else that changed.
  bar_->setUpdatesEnabled(false);
  bar_->setValue(static_cast<int>(kSteps * fraction));
  bar_->setUpdatesEnabled(true);
  bar_->show();
  text_->setText(text);
}

void StatusLine::show_idle(const QString& message) {
  stage_->hide();
  stage_->clear();
  bar_->hide();
  text_->setText(message);
  text_->setToolTip(message);
}

void StatusLine::show_quality(const std::shared_ptr<const CalibrationResult>& result,
                              const Standing& standing) {
  mark_->setVisible(result != nullptr);
  quality_->setVisible(result != nullptr);
  if (!result) return;
  const ToldQuality told = told_quality(*result, standing);
  shown_ = told.open                          ? Mark::kIdle
           : told.quality == Quality::kGood   ? Mark::kGood
           : told.quality == Quality::kFailed ? Mark::kBad
                                              : Mark::kDoubtful;
  draw_mark();
  QStringList more;
  if (!result->quality_reason.empty()) more << core_text(result->quality_reason);
  // Whose verdict it is.
  const PoseUse use = pose_use(*result);
  more << core_text(use.clouds);
  quality_->setText(tr("%1: %2").arg(core_text(use.model), told.words));
  quality_->setToolTip(more.join(QLatin1Char('\n')));
  // A longer verdict would be cut until the next layout.
  layout()->activate();
}

void StatusLine::draw_mark() {
  if (shown_) mark_->setPixmap(mark_icon(*shown_, palette()).pixmap(16, 16));
}

// A mark of the light theme is hardly seen in the dark one.
void StatusLine::changeEvent(QEvent* event) {
  QStatusBar::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) draw_mark();
}

QString StatusLine::text() const {
  return text_->text();
}

}  // namespace lvcalib::widgets

#include "moc_status_line.cpp"
