// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare_dialog.h"

#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "style/texts.h"

namespace lvcalib::widgets {
namespace {

// Differences that happen by chance less often contradict each other.
constexpr double kContradiction = 0.001;
constexpr double kDoubt = 0.05;

// Half of the last digit shown, and less, is zero without a sign.
QString number_text(double value, bool stated, int decimals = 3) {
  if (!stated) return QStringLiteral("–");
  const double least = 0.5 * std::pow(10.0, -decimals);
  return QString::number(std::abs(value) < least ? 0.0 : value, 'f', decimals);
}

}  // namespace

CompareDialog::CompareDialog(const std::shared_ptr<const CalibrationResult>& result,
                             Choices& choices, const QString& folder, QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      folder_(folder),
      file_(new QLabel(this)),
      choose_(new QPushButton(this)),
      verdict_(new QLabel(this)),
      table_(new QTreeWidget(this)),
      close_(new QPushButton(this)) {
  setObjectName(QStringLiteral("compare_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(680, 380);
  present_.camera_from_lidar = result->extrinsic.camera_from_lidar.transform;
  present_.covariance = result->extrinsic.camera_from_lidar.covariance;
  present_.covariance_total = result->covariance_total.isZero()
                                  ? result->extrinsic.camera_from_lidar.covariance
                                  : result->covariance_total;
  choose_->setObjectName(QStringLiteral("compare_choose"));
  verdict_->setObjectName(QStringLiteral("compare_verdict"));
  table_->setObjectName(QStringLiteral("compare_table"));
  verdict_->setWordWrap(true);
  verdict_->setTextFormat(Qt::PlainText);
  verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  file_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  table_->setRootIsDecorated(false);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->header()->setStretchLastSection(false);
  for (QPushButton* button : {choose_, close_}) button->setAutoDefault(false);
  auto* head = new QHBoxLayout;
  head->addWidget(file_, 1);
  head->addWidget(choose_);
  auto* foot = new QHBoxLayout;
  foot->addStretch();
  foot->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(head);
  layout->addWidget(verdict_);
  layout->addWidget(table_, 1);
  layout->addLayout(foot);
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(choose_, &QPushButton::clicked, this, [this] {
    const QString path = choices_.result_to_open(this, folder_);
    if (!path.isEmpty()) open(path);
  });
  follow_language(this, [this] { retranslate(); });
}

void CompareDialog::open(const QString& path) {
  path_ = path;
  folder_ = QFileInfo(path).absolutePath();
  error_.reset();
  other_.reset();
  difference_.reset();
  const auto read = read_stated_extrinsic(path.toStdString());
  if (read) {
    other_ = *read;
    difference_ = difference_of(present_, *read);
  } else {
    error_ = read.error();
  }
  retranslate();
}

QString CompareDialog::verdict() const {
  if (error_) return core_text(*error_);
  if (!difference_)
    return tr("Choose another result.json, or the truth of a simulation, to compare with.");
  const ExtrinsicDifference& d = *difference_;
  QString out =
      tr("They differ by %1 mm and %2 mrad.")
          .arg(QString::number(d.translation_mm, 'f', 3), QString::number(d.rotation_mrad, 'f', 3));
  if (!d.probability) return out + QLatin1Char(' ') + tr("The other file states no uncertainty.");
  const double percent = 100.0 * *d.probability;
  const QString chance =
      percent >= 10.0 ? QString::number(percent, 'f', 0) : QString::number(percent, 'g', 2);
  if (*d.probability < kContradiction) {
    out += QLatin1Char(' ') +
           tr("They contradict each other: the stated uncertainties explain such a difference in "
              "%1 % of all cases only.")
               .arg(chance);
  } else if (*d.probability < kDoubt) {
    out += QLatin1Char(' ') +
           tr("That is much: the stated uncertainties explain such a difference in %1 % of all "
              "cases.")
               .arg(chance);
  } else {
    out += QLatin1Char(' ') +
           tr("They agree: by their stated uncertainties differences are as large or larger in "
              "%1 % of all cases.")
               .arg(chance);
  }
  if (!other_->is_truth)
    out += QLatin1Char(' ') + tr("This holds for results from data of their own.");
  return out;
}

void CompareDialog::showTable() {
  table_->clear();
  table_->setHeaderLabels({tr("In the camera's axes"), tr("Difference"), tr("± this result"),
                           tr("± the other"), tr("± of the difference"), tr("In ±")});
  if (!difference_) return;
  const ExtrinsicDifference& d = *difference_;
  const QString names[] = {tr("translation x, mm"),      tr("translation y, mm"),
                           tr("translation z, mm"),      tr("rotation about x, mrad"),
                           tr("rotation about y, mrad"), tr("rotation about z, mrad")};
  const bool stated = d.probability.has_value();
  const bool other_stated = other_->states_errors() && !other_->is_truth;
  for (int k = 0; k < 6; ++k) {
    // Both mm and mrad are a thousandth.
    const QStringList texts = {
        names[k],
        number_text(1e3 * d.by_axis(k), true),
        number_text(1e3 * d.sigma_first(k), true),
        number_text(1e3 * d.sigma_second(k), other_stated),
        number_text(1e3 * d.sigma(k), stated),
        number_text(d.by_axis(k) / std::max(d.sigma(k), 1e-300), stated && d.sigma(k) > 0.0, 2)};
    auto* item = new QTreeWidgetItem(table_, texts);
    for (int c = 1; c < 6; ++c) item->setTextAlignment(c, Qt::AlignRight | Qt::AlignVCenter);
  }
}

void CompareDialog::retranslate() {
  setWindowTitle(tr("Compare results"));
  file_->setText(path_.isEmpty() ? tr("nothing chosen yet") : QDir::toNativeSeparators(path_));
  choose_->setText(tr("&Choose…"));
  close_->setText(tr("Close"));
  verdict_->setText(verdict());
  showTable();
}

}  // namespace lvcalib::widgets
