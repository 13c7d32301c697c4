// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/compare_steps_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <algorithm>

#include "modelling/model_text.h"
#include "report/result_comparison.h"
#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

StatedExtrinsic stated_extrinsic(const CalibrationResult& result) {
  StatedExtrinsic out;
  out.camera_from_lidar = result.extrinsic.camera_from_lidar.transform;
  out.covariance = result.extrinsic.camera_from_lidar.covariance;
  out.covariance_total =
      result.covariance_total.isZero() ? out.covariance : result.covariance_total;
  return out;
}

QTreeWidget* make_table(QWidget* parent, const char* name) {
  auto* table = new QTreeWidget(parent);
  table->setObjectName(QString::fromLatin1(name));
  table->setRootIsDecorated(false);
  table->setSelectionMode(QAbstractItemView::NoSelection);
  table->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table->header()->setStretchLastSection(false);
  return table;
}

void add_row(QTreeWidget* table, const QStringList& texts) {
  auto* item = new QTreeWidgetItem(table, texts);
  for (int c = 1; c < texts.size(); ++c) item->setTextAlignment(c, Qt::AlignRight);
}

const SceneSolution* find_scene(const CalibrationResult& result, const std::string& name) {
  for (const SceneSolution& scene : result.extrinsic.scenes) {
    if (scene.name == name) return &scene;
  }
  return nullptr;
}

}  // namespace

CompareStepsDialog::CompareStepsDialog(std::shared_ptr<const CalibrationResult> source,
                                       std::vector<ModelStepPtr> steps, std::size_t current,
                                       QWidget* parent)
    : QDialog(parent),
      source_(std::move(source)),
      steps_(std::move(steps)),
      verdict_(new QLabel(this)),
      pose_(make_table(this, "steps_pose")),
      scenes_(make_table(this, "steps_scenes")) {
  setObjectName(QStringLiteral("compare_steps_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(640, 560);
  auto* layout = new QGridLayout(this);
  for (int k = 0; k < 2; ++k) {
    labels_[k] = new QLabel(this);
    choices_[k] = new QComboBox(this);
    choices_[k]->setObjectName(k == 0 ? QStringLiteral("first_step")
                                      : QStringLiteral("second_step"));
    labels_[k]->setBuddy(choices_[k]);
    for (std::size_t s = 0; s < steps_.size(); ++s) {
      if (steps_[s]) choices_[k]->addItem(QString(), static_cast<int>(s));
    }
    const int chosen = choices_[k]->findData(k == 0 && current > 0 ? 0 : static_cast<int>(current));
    choices_[k]->setCurrentIndex(std::max(0, chosen));
    layout->addWidget(labels_[k], k, 0);
    layout->addWidget(choices_[k], k, 1);
    connect(choices_[k], &QComboBox::currentIndexChanged, this, &CompareStepsDialog::ask);
  }
  layout->setColumnStretch(1, 1);
  verdict_->setObjectName(QStringLiteral("steps_verdict"));
  verdict_->setWordWrap(true);
  verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(verdict_, 2, 0, 1, 2);
  layout->addWidget(pose_, 3, 0, 1, 2);
  layout->addWidget(scenes_, 4, 0, 1, 2);
  layout->addWidget(buttons, 5, 0, 1, 2);
  layout->setRowStretch(3, 2);
  layout->setRowStretch(4, 3);
  connect(&work_, &StepComparison::ready, this, [this](const auto& first, const auto& second) {
    results_[0] = first;
    results_[1] = second;
    showTables();
  });
  follow_language(this, [this] { retranslate(); });
  ask();
}

void CompareStepsDialog::retranslate() {
  setWindowTitle(tr("Compare steps"));
  labels_[0]->setText(tr("&From"));
  labels_[1]->setText(tr("&To"));
  for (QComboBox* box : choices_) {
    for (int i = 0; i < box->count(); ++i) {
      const auto step = static_cast<std::size_t>(box->itemData(i).toInt());
      box->setItemText(i, tr("%1: %2").arg(step).arg(step_text(*steps_[step])));
    }
  }
  showTables();
}

void CompareStepsDialog::ask() {
  results_[0] = results_[1] = nullptr;
  showTables();
  work_.request(source_, steps_, static_cast<std::size_t>(choices_[0]->currentData().toInt()),
                static_cast<std::size_t>(choices_[1]->currentData().toInt()));
}

void CompareStepsDialog::showTables() {
  pose_->clear();
  scenes_->clear();
  pose_->setHeaderLabels({tr("In the camera's axes"), tr("Difference"), tr("± from"), tr("± to")});
  scenes_->setHeaderLabels({tr("Scene"), tr("px from"), tr("px to"), tr("mm from"), tr("mm to")});
  if (!results_[0] || !results_[1]) {
    verdict_->setText(tr("Being compared …"));
    return;
  }
  const ExtrinsicDifference d =
      difference_of(stated_extrinsic(*results_[0]), stated_extrinsic(*results_[1]));
  verdict_->setText(
      tr("The pose moves by %1 mm and %2 mrad. Both steps rest on the same measurements: what "
         "differs is the model.")
          .arg(d.translation_mm, 0, 'f', 3)
          .arg(d.rotation_mrad, 0, 'f', 3));
  const QString names[] = {tr("translation x, mm"),      tr("translation y, mm"),
                           tr("translation z, mm"),      tr("rotation about x, mrad"),
                           tr("rotation about y, mrad"), tr("rotation about z, mrad")};
  // Both mm and mrad are a thousandth.
  const auto text = [](double value) { return QString::number(1e3 * value, 'f', 3); };
  for (int k = 0; k < 6; ++k) {
    add_row(pose_, {names[k], text(d.by_axis(k)), text(d.sigma_first(k)), text(d.sigma_second(k))});
  }
  for (const SceneSolution& first : results_[0]->extrinsic.scenes) {
    const SceneSolution* second = find_scene(*results_[1], first.name);
    if (second == nullptr || !first.used) continue;
    add_row(scenes_,
            {QString::fromStdString(first.name), QString::number(first.rms_px, 'f', 4),
             QString::number(second->rms_px, 'f', 4), QString::number(first.rms_mm, 'f', 3),
             QString::number(second->rms_mm, 'f', 3)});
  }
}

}  // namespace lvcalib::widgets
