// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/term_list.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "modelling/model_text.h"
#include "style/fitting.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

enum Column { kName, kValue, kHeld, kColumns };
constexpr int kTerm = Qt::UserRole;           // Index of the term.
constexpr int kParameter = Qt::UserRole + 1;  // Index of its parameter; −1: the term itself.
constexpr int kLeastSection = 28;

}  // namespace

TermList::TermList(QWidget* parent)
    : QWidget(parent),
      title_(new QLabel(this)),
      tree_(new QTreeWidget(this)),
      pose_(new QLabel(this)),
      add_(new QPushButton(this)),
      remove_(new QPushButton(this)) {
  tree_->setObjectName(QStringLiteral("terms"));
  tree_->setColumnCount(kColumns);
  tree_->setRootIsDecorated(true);
  // Names take more lines where they have little room; values are read in one.
  tree_->setWordWrap(true);
  tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setMinimumSectionSize(kLeastSection);
  tree_->header()->setSectionResizeMode(kName, QHeaderView::Stretch);
  tree_->header()->setSectionResizeMode(kValue, QHeaderView::ResizeToContents);
  tree_->header()->setSectionResizeMode(kHeld, QHeaderView::ResizeToContents);
  tree_->setIndentation(14);
  tree_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  pose_->setObjectName(QStringLiteral("model_pose"));
  pose_->setWordWrap(true);
  add_->setObjectName(QStringLiteral("add_effect"));
  remove_->setObjectName(QStringLiteral("remove_effect"));
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(add_);
  buttons->addWidget(remove_);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  layout->addWidget(title_);
  layout->addWidget(tree_, 1);
  layout->addWidget(pose_);
  layout->addLayout(buttons);
  connect(add_, &QPushButton::clicked, this, &TermList::addWanted);
  connect(remove_, &QPushButton::clicked, this, [this] {
    if (current() >= 0) Q_EMIT removeWanted(current());
  });
  connect(tree_, &QTreeWidget::itemChanged, this, &TermList::take);
  // Not within the layout that has moved the section.
  connect(tree_->header(), &QHeaderView::sectionResized, this, [this](int column) {
    if (column == kName) QMetaObject::invokeMethod(this, &TermList::fitRows, Qt::QueuedConnection);
  });
  connect(tree_, &QTreeWidget::currentItemChanged, this, [this] {
    updateButtons();
    if (current() >= 0) Q_EMIT chosen(current());
  });
  follow_language(this, [this] { retranslate(); });
}

TermList::~TermList() {
  tree_->disconnect(this);  // It changes while it goes.
}

int TermList::current() const {
  const QTreeWidgetItem* item = tree_->currentItem();
  if (item == nullptr || !item->data(kName, kTerm).isValid()) return -1;
  return item->data(kName, kTerm).toInt();
}

void TermList::setStep(const ModelStepPtr& step, const ModelStepPtr& base) {
  step_ = step;
  base_ = base;
  fill();
}

void TermList::setChangeable(bool changeable) {
  if (changeable_ == changeable) return;
  changeable_ = changeable;
  updateButtons();
  // A tick that starts work comes from the row itself, which must not go before it is done.
  QMetaObject::invokeMethod(this, &TermList::fill, Qt::QueuedConnection);
}

void TermList::updateButtons() {
  add_->setEnabled(step_ && changeable_);
  remove_->setEnabled(step_ && changeable_ && current() >= 0);
}

void TermList::fill() {
  const QSignalBlocker quiet(tree_);
  const int before = current();
  tree_->clear();
  auto* base = new QTreeWidgetItem(tree_, {tr("base model")});
  base->setFlags(Qt::ItemIsEnabled);
  base->setToolTip(kName, tr("Pinhole camera, rigid board poses and one extrinsic"));
  if (step_) {
    for (int k = 0; k < static_cast<int>(step_->terms.size()); ++k) addTerm(k);
  }
  if (before >= 0 && before + 1 < tree_->topLevelItemCount())
    tree_->setCurrentItem(tree_->topLevelItem(before + 1));
  // Columns get their widths once the rows are laid out.
  QMetaObject::invokeMethod(this, &TermList::fitWidth, Qt::QueuedConnection);
  updateButtons();
  pose_->clear();
  if (!step_ || !base_) return;
  const Rigid3& now = step_->state.camera_from_lidar;
  const Rigid3& was = base_->state.camera_from_lidar;
  const double mm = 1e3 * (now.translation - was.translation).norm();
  const double mrad = 1e3 * now.rotation.angularDistance(was.rotation);
  const Vector6d sigma = step_->covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  pose_->setText(tr("Extrinsic moved by %1; by noise alone it is known to %2.")
                     .arg(move_text(mm, mrad),
                          move_text(1e3 * sigma.head<3>().norm(), 1e3 * sigma.tail<3>().norm())));
}

// As narrow as the longest word of a name and the values allow: what this list takes is missing to
// the figures beside it and to the list of scenes.
void TermList::fitWidth() {
  const QAbstractItemView& rows = *tree_;  // There its hints are public.
  const QHeaderView& header = *tree_->header();
  int width = std::max(width_of_longest_word(*tree_, kName), header.sectionSizeHint(kName));
  for (const int column : {kValue, kHeld})
    width += std::max({rows.sizeHintForColumn(column), header.sectionSizeHint(column),
                       header.minimumSectionSize()});
  const int bar = style()->pixelMetric(QStyle::PM_ScrollBarExtent, nullptr, tree_);
  tree_->setMinimumWidth(width + bar + 2 * tree_->frameWidth());
  fitRows();
}

void TermList::fitRows() {
  const QSignalBlocker quiet(tree_);  // Taller rows are no wish of the user's.
  wrap_words(*tree_, kName);
}

void TermList::addTerm(int k) {
  const ModelTerm& term = step_->terms[static_cast<std::size_t>(k)];
  const auto estimates = term.estimates();
  auto* item = new QTreeWidgetItem(tree_);
  item->setText(kName, effect_title(term.spec));
  item->setData(kName, kTerm, k);
  item->setData(kName, kParameter, estimates.size() == 1 ? 0 : -1);
  const EffectInfo& info = term.use.effect->info();
  item->setToolTip(kName, core_text(Message::listed(info.physics)) + QLatin1Char('\n') +
                              core_text(Message::listed(info.formula)));
  auto flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  if (changeable_) flags |= Qt::ItemIsUserCheckable;
  item->setCheckState(kName, term.on ? Qt::Checked : Qt::Unchecked);
  item->setCheckState(kHeld, term.use.held ? Qt::Checked : Qt::Unchecked);
  item->setToolTip(kHeld, tr("Held: the value is yours and is not fitted"));
  const auto show = [&](QTreeWidgetItem* row, std::size_t p) {
    row->setText(kValue, value_text(estimates[p], term.use.held));
    row->setToolTip(kValue, tr("Value and standard deviation; believable: ±%1%2. Double-click to "
                               "hold it at a value of yours.")
                                .arg(term.parameters[p].prior_sigma / estimates[p].unit_in_si)
                                .arg(unit_behind(estimates[p].unit)));
  };
  if (changeable_) flags |= Qt::ItemIsEditable;
  if (estimates.size() == 1) {
    show(item, 0);
    item->setFlags(flags);
    return;
  }
  item->setFlags(flags & ~Qt::ItemIsEditable);
  for (std::size_t p = 0; p < estimates.size(); ++p) {
    auto* row = new QTreeWidgetItem(item, {parameter_name(estimates[p].name)});
    row->setData(kName, kTerm, k);
    row->setData(kName, kParameter, static_cast<int>(p));
    row->setFlags(flags & ~Qt::ItemIsUserCheckable);
    show(row, p);
  }
  item->setExpanded(estimates.size() <= 6);
}

void TermList::take(QTreeWidgetItem* item, int column) {
  const int k = item->data(kName, kTerm).toInt();
  if (!step_ || k < 0 || k >= static_cast<int>(step_->terms.size())) return;
  const ModelTerm& term = step_->terms[static_cast<std::size_t>(k)];
  if (column == kName && item->parent() == nullptr) {
    const bool on = item->checkState(kName) == Qt::Checked;
    if (on != term.on) Q_EMIT onWanted(k, on);
  } else if (column == kHeld && item->parent() == nullptr) {
    const bool held = item->checkState(kHeld) == Qt::Checked;
    if (held != term.use.held)
      Q_EMIT holdWanted(k, held ? std::optional(term.use.values) : std::nullopt);
  } else if (column == kValue) {
    // The number that begins the text; what cannot be read is undone.
    const int p = item->data(kName, kParameter).toInt();
    const QString word =
        item->text(kValue).trimmed().section(QLatin1Char(' '), 0, 0).replace(u'−', u'-');
    bool ok = false;
    double value = QLocale::c().toDouble(word, &ok);
    if (!ok) value = QLocale().toDouble(word, &ok);
    if (ok && std::isfinite(value) && p >= 0) {
      Eigen::VectorXd values = term.use.values;
      values(p) = value * term.parameters[static_cast<std::size_t>(p)].unit_in_si;
      Q_EMIT holdWanted(k, values);
    }
  }
  // What is asked for shows once it is done.
  QMetaObject::invokeMethod(this, &TermList::fill, Qt::QueuedConnection);
}

void TermList::retranslate() {
  title_->setText(tr("<b>Model</b>"));
  tree_->setHeaderLabels({tr("Effect"), tr("Value"), tr("Held")});
  tree_->setAccessibleName(tr("Effects in the model"));
  add_->setText(tr("&Add…"));
  add_->setToolTip(tr("Add an effect of the catalogue, a formula or a curve"));
  remove_->setText(tr("Re&move"));
  remove_->setToolTip(tr("Take the chosen effect out of the model"));
  fill();
}

}  // namespace lvcalib::widgets

#include "moc_term_list.cpp"
