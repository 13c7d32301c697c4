// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/correct_dialog.h"

#include <QCheckBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

#include "model/effect.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

QString mm_text(double metres) {
  return QString::number(1e3 * metres, 'f', 2);
}

// An effect's title in the present language; its id where the catalogue does not know it.
QString title_of(const std::string& id) {
  for (const EffectPtr& effect : effect_catalogue()) {
    if (effect->info().id == id) return core_text(Message::listed(effect->info().title));
  }
  return QString::fromStdString(id);
}

// "walk.pcd" becomes "walk-corrected.pcd", beside it.
QString suggested_output(const QString& input) {
  const QFileInfo info(input);
  if (info.isDir()) return QDir(input).absolutePath() + QStringLiteral("-corrected");
  return info.absoluteDir().filePath(info.completeBaseName() + QStringLiteral("-corrected.pcd"));
}

}  // namespace

CorrectDialog::CorrectDialog(std::shared_ptr<const CalibrationResult> result, Choices& choices,
                             const QString& folder, QWidget* parent)
    : QDialog(parent),
      result_(std::move(result)),
      choices_(choices),
      folder_(folder),
      model_(new QLabel(this)),
      labels_{new QLabel(this), new QLabel(this), new QLabel(this)},
      input_(new QLineEdit(this)),
      output_(new QLineEdit(this)),
      effects_(new QListWidget(this)),
      has_clock_(new QCheckBox(this)),
      clock_(new QDoubleSpinBox(this)),
      cloud_(new QPushButton(this)),
      clouds_(new QPushButton(this)),
      place_(new QPushButton(this)),
      summary_(new QLabel(this)),
      progress_(new QProgressBar(this)),
      stop_(new QPushButton(this)),
      correct_(new QPushButton(this)),
      close_(new QPushButton(this)) {
  setObjectName(QStringLiteral("correct_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  build();
  connect(cloud_, &QPushButton::clicked, this,
          [this] { choose(choices_.cloud_to_open(this, folder_)); });
  connect(clouds_, &QPushButton::clicked, this,
          [this] { choose(choices_.clouds_to_open(this, folder_)); });
  connect(place_, &QPushButton::clicked, this, [this] {
    const QString path = choices_.clouds_to_save(this, output_->text());
    if (!path.isEmpty()) output_->setText(QDir::toNativeSeparators(path));
  });
  connect(input_, &QLineEdit::textChanged, this, &CorrectDialog::refresh);
  connect(output_, &QLineEdit::textChanged, this, &CorrectDialog::refresh);
  connect(effects_, &QListWidget::itemChanged, this, &CorrectDialog::refresh);
  connect(has_clock_, &QCheckBox::toggled, this, &CorrectDialog::refresh);
  connect(correct_, &QPushButton::clicked, this, &CorrectDialog::start);
  connect(stop_, &QPushButton::clicked, this, [this] { work_.cancel(); });
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(this, &QDialog::finished, this, [this] { work_.cancel(); });
  connect(&work_, &CorrectionWork::progressed, this, [this](double fraction, const QString& cloud) {
    progress_->setValue(static_cast<int>(1000 * fraction));
    summary_->setText(cloud);
  });
  connect(&work_, &CorrectionWork::corrected, this, [this](const CorrectedClouds& clouds) {
    done_ = clouds;
    refresh();
  });
  connect(&work_, &CorrectionWork::failed, this, [this](const Error& error) {
    error_ = error;
    refresh();
  });
  connect(&work_, &CorrectionWork::cancelled, this, [this] {
    cancelled_ = true;
    refresh();
  });
  follow_language(this, [this] { retranslate(); });
}

CorrectDialog::~CorrectDialog() {
  work_.disconnect(this);
}

void CorrectDialog::build() {
  resize(680, 360);
  for (const ModelEffect& effect : result_->model) {
    auto* item = new QListWidgetItem(effects_);
    item->setData(Qt::UserRole, QString::fromStdString(effect.id));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(Qt::Checked);
  }
  effects_->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
  effects_->setVisible(effects_->count() > 0);
  // Of the way from the first scene of the calibration to the last.
  clock_->setRange(0.0, 100.0);
  clock_->setDecimals(0);
  clock_->setSingleStep(5.0);
  clock_->setSuffix(QStringLiteral(" %"));
  const std::pair<QWidget*, const char*> named[] = {
      {input_, "correct_input"},         {output_, "correct_output"}, {summary_, "correct_summary"},
      {correct_, "correct_start"},       {stop_, "correct_stop"},     {cloud_, "correct_cloud"},
      {clouds_, "correct_clouds"},       {model_, "correct_model"},   {effects_, "correct_effects"},
      {has_clock_, "correct_has_clock"}, {clock_, "correct_clock"},   {close_, "correct_close"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  for (QLabel* label : {model_, summary_}) {
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
  }
  summary_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  correct_->setDefault(true);
  auto* form = new QGridLayout;
  form->addWidget(labels_[0], 0, 0);
  form->addWidget(input_, 0, 1);
  form->addWidget(cloud_, 0, 2);
  form->addWidget(clouds_, 0, 3);
  form->addWidget(labels_[1], 1, 0);
  form->addWidget(output_, 1, 1);
  form->addWidget(place_, 1, 2);
  form->setColumnStretch(1, 1);
  labels_[0]->setBuddy(input_);
  labels_[1]->setBuddy(output_);
  auto* running = new QHBoxLayout;
  running->addWidget(progress_, 1);
  running->addWidget(stop_);
  auto* buttons = new QHBoxLayout;
  buttons->addStretch();
  buttons->addWidget(correct_);
  buttons->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(model_);
  layout->addWidget(effects_);
  auto* when = new QHBoxLayout;
  when->addWidget(has_clock_);
  when->addWidget(clock_);
  when->addWidget(labels_[2]);
  when->addStretch();
  layout->addLayout(when);
  layout->addLayout(form);
  layout->addWidget(summary_);
  layout->addLayout(running);
  layout->addStretch();
  layout->addLayout(buttons);
}

void CorrectDialog::choose(const QString& path) {
  if (path.isEmpty()) return;
  folder_ = QFileInfo(path).absolutePath();
  input_->setText(QDir::toNativeSeparators(path));
  output_->setText(QDir::toNativeSeparators(suggested_output(path)));
}

void CorrectDialog::start() {
  error_.reset();
  done_.reset();
  cancelled_ = false;
  progress_->setValue(0);
  work_.correct(result_, QDir::fromNativeSeparators(input_->text().trimmed()),
                QDir::fromNativeSeparators(output_->text().trimmed()), options());
  refresh();
}

CorrectionOptions CorrectDialog::options() const {
  CorrectionOptions out;
  for (int k = 0; k < effects_->count(); ++k) {
    const QListWidgetItem* item = effects_->item(k);
    if (item->checkState() != Qt::Checked)
      out.skip.push_back(item->data(Qt::UserRole).toString().toStdString());
  }
  if (has_clock_->isChecked()) out.clock = 0.01 * clock_->value();
  return out;
}

QString CorrectDialog::modelText() const {
  if (result_->model.empty()) {
    return tr(
        "The model in force holds no effects: clouds would stay as they are. Add effects on "
        "the Model page first.");
  }
  return tr("Taken out of clouds of this LiDAR:");
}

QString CorrectDialog::summaryText() const {
  if (error_) return core_text(*error_);
  if (cancelled_) return tr("Cancelled; clouds that were complete stay.");
  if (!done_) return {};
  const CorrectionSummary& all = done_->total;
  QStringList lines;
  lines << tr("%n clouds, %1 points, moved by %2 mm RMS, %3 mm at most.", nullptr,
              static_cast<int>(done_->clouds))
               .arg(all.points)
               .arg(mm_text(all.rms_m), mm_text(all.largest_m));
  for (const EffectCorrection& e : all.effects) {
    const QString title = title_of(e.id);
    switch (e.state) {
      case CorrectionState::kTakenOut:
        lines << tr("%1: %2 mm RMS").arg(title, mm_text(e.rms_m));
        break;
      case CorrectionState::kNoClock:
        lines << tr("%1: left, it drifts with time").arg(title);
        break;
      case CorrectionState::kBoardOnly:
        lines << tr("%1: left, it is known on the board only").arg(title);
        break;
      case CorrectionState::kNoPoints:
      case CorrectionState::kSkipped:
        lines << tr("%1: left, it does not move points").arg(title);
        break;
    }
  }
  if (all.held > 0) {
    lines << tr("%1 points are darker, brighter or more slanted than the board was; they get the "
                "correction at its limits.")
                 .arg(all.held);
  }
  for (const Message& warning : done_->warnings) lines << core_text(warning);
  for (const Message& problem : done_->problems) lines << core_text(problem);
  return lines.join(QLatin1Char('\n'));
}

void CorrectDialog::refresh() {
  const bool busy = work_.busy();
  progress_->setVisible(busy);
  stop_->setVisible(busy);
  if (!busy) summary_->setText(summaryText());
  clock_->setEnabled(has_clock_->isChecked());
  correct_->setEnabled(!busy && options().skip.size() < result_->model.size() &&
                       !input_->text().trimmed().isEmpty() && !output_->text().trimmed().isEmpty());
}

void CorrectDialog::retranslate() {
  setWindowTitle(tr("Correct clouds"));
  model_->setText(modelText());
  for (int k = 0; k < effects_->count(); ++k) {
    effects_->item(k)->setText(
        title_of(effects_->item(k)->data(Qt::UserRole).toString().toStdString()));
  }
  effects_->setToolTip(tr("Effects that are not ticked stay in the clouds"));
  has_clock_->setText(tr("&When the clouds were taken:"));
  has_clock_->setToolTip(tr(
      "0 % with the first scene of the calibration, 100 % with the last. Effects that drift from "
      "scene to scene are taken out only if this is known."));
  clock_->setToolTip(has_clock_->toolTip());
  labels_[0]->setText(tr("&From:"));
  labels_[1]->setText(tr("&To:"));
  labels_[2]->setText(tr("of the way from the first scene to the last"));
  cloud_->setText(tr("&Cloud…"));
  clouds_->setText(tr("F&older…"));
  place_->setText(tr("&Place…"));
  stop_->setText(tr("&Stop"));
  correct_->setText(tr("Co&rrect"));
  close_->setText(tr("Close"));
  refresh();
}

}  // namespace lvcalib::widgets

#include "moc_correct_dialog.cpp"
