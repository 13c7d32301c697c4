// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/missing_pane.h"

#include <QApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QStyledItemDelegate>
#include <QTabWidget>
#include <QTextBrowser>
#include <QTimer>
#include <QTreeWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "model/row_covariates.h"
#include "modelling/model_text.h"
#include "modelling/residual_plot.h"
#include "selection/advice_text.h"
#include "style/fitting.h"
#include "style/texts.h"
#include "style/theme.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

enum Column { kEffect, kVerdict, kFall, kColumns };
constexpr int kProposal = Qt::UserRole;     // Index of the proposal.
constexpr int kUnknown = Qt::UserRole + 1;  // Index of unexplained structure.
constexpr int kShare = Qt::UserRole + 2;    // 0…1 for the bar.

// A bar of the predicted fall with its number.
class FallDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    QStyleOptionViewItem ground = option;
    initStyleOption(&ground, index);
    ground.text.clear();
    ground.widget->style()->drawControl(QStyle::CE_ItemViewItem, &ground, painter, ground.widget);
    const QVariant share = index.data(kShare);
    if (!share.isValid()) return;
    const double width = std::clamp(share.toDouble(), 0.0, 1.0);
    QRectF bar = QRectF(option.rect).adjusted(2, 4, -2, -4);
    const QColor color = state_colors(option.palette).good;
    painter->save();
    painter->setPen(Qt::NoPen);
    QColor pale = color;
    pale.setAlpha(40);
    painter->fillRect(bar, pale);
    bar.setWidth(bar.width() * width);
    QColor full = color;
    full.setAlpha(150);
    painter->fillRect(bar, full);
    const bool chosen = (option.state & QStyle::State_Selected) != 0;
    painter->setPen(option.palette.color(chosen ? QPalette::HighlightedText : QPalette::Text));
    painter->drawText(option.rect.adjusted(4, 0, -4, 0), Qt::AlignVCenter | Qt::AlignRight,
                      index.data().toString());
    painter->restore();
  }
};

// Of the channel that its explanation names.
double best_fall(const EffectProposal& p) {
  return p.heldout_fall[static_cast<std::size_t>(p.channel)];
}

QColor verdict_color(const EffectProposal& p, const QPalette& palette) {
  const StateColors colors = state_colors(palette);
  if (p.suggested) return colors.bad;
  switch (p.finding.verdict) {
    case EffectVerdict::kPresent:
      return colors.bad;
    case EffectVerdict::kAliased:
      return colors.doubtful;
    case EffectVerdict::kAbsent:
      return colors.good;
    case EffectVerdict::kNotTestable:
      break;
  }
  return colors.idle;
}

QString covariates_text(const StructureScore& s) {
  return core_text(covariates_named(s.covariates()));
}

// A specification that a click adds to the model.
QString add_link(const std::string& spec, const QString& text) {
  return QStringLiteral("<a href=\"%1\">%2</a>")
      .arg(QString::fromLatin1(QUrl::toPercentEncoding(QString::fromStdString(spec))),
           text.toHtmlEscaped());
}

}  // namespace

MissingPane::MissingPane(QWidget* parent)
    : QWidget(parent),
      verdict_(new QLabel(this)),
      parts_(new QSplitter(Qt::Vertical, this)),
      tabs_(new QTabWidget(this)),
      list_(new QTreeWidget(this)),
      budget_(new QTreeWidget(this)),
      advice_(new QTextBrowser(this)),
      text_(new QTextBrowser(this)),
      pattern_(new ResidualPlot(this)),
      add_(new QPushButton(this)),
      all_(new QPushButton(this)),
      look_(new QPushButton(this)) {
  verdict_->setObjectName(QStringLiteral("missing_verdict"));
  verdict_->setWordWrap(true);
  list_->setObjectName(QStringLiteral("proposals"));
  list_->setColumnCount(kColumns);
  // Names in full, on two lines where one is not enough.
  list_->setWordWrap(true);
  list_->setTextElideMode(Qt::ElideNone);
  list_->setIndentation(14);
  connect(list_->header(), &QHeaderView::sectionResized, list_, [this] {
    // Not within the layout that has moved the section.
    QTimer::singleShot(0, list_, [this] { fitRows(); });
  });
  list_->setItemDelegateForColumn(kFall, new FallDelegate(list_));
  list_->header()->setStretchLastSection(false);
  list_->header()->setSectionResizeMode(kEffect, QHeaderView::Stretch);
  list_->header()->setSectionResizeMode(kVerdict, QHeaderView::ResizeToContents);
  list_->header()->setSectionResizeMode(kFall, QHeaderView::Fixed);
  list_->header()->resizeSection(kFall, 62);
  budget_->setObjectName(QStringLiteral("sensitivity"));
  budget_->setColumnCount(2);
  budget_->setRootIsDecorated(false);
  budget_->setWordWrap(true);
  budget_->setTextElideMode(Qt::ElideNone);
  connect(budget_->header(), &QHeaderView::sectionResized, budget_,
          [this] { QTimer::singleShot(0, budget_, [this] { fitRows(); }); });
  budget_->header()->setStretchLastSection(false);
  budget_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  budget_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  advice_->setObjectName(QStringLiteral("advice"));
  text_->setObjectName(QStringLiteral("proposal_text"));
  // A closed form is added from where it is told.
  for (QTextBrowser* told : {text_, advice_}) {
    told->setOpenLinks(false);
    connect(told, &QTextBrowser::anchorClicked, this, &MissingPane::addFrom);
  }
  text_->setMinimumHeight(70);
  pattern_->setObjectName(QStringLiteral("pattern_plot"));
  pattern_->setMeansOnly(true);
  add_->setObjectName(QStringLiteral("add_proposal"));
  all_->setObjectName(QStringLiteral("find_all"));
  look_->setObjectName(QStringLiteral("look_missing"));
  tabs_->setDocumentMode(true);
  tabs_->addTab(list_, {});
  tabs_->addTab(budget_, {});
  tabs_->addTab(advice_, {});
  parts_->setChildrenCollapsible(false);
  parts_->addWidget(tabs_);
  parts_->addWidget(text_);
  parts_->addWidget(pattern_);
  parts_->setStretchFactor(0, 3);
  parts_->setStretchFactor(1, 2);
  parts_->setStretchFactor(2, 2);
  connect(parts_, &QSplitter::splitterMoved, this, [this] { parts_moved_ = true; });
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(add_, 1);
  buttons->addWidget(all_, 1);
  buttons->addWidget(look_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  layout->addWidget(verdict_);
  layout->addWidget(parts_, 1);
  layout->addLayout(buttons);
  connect(list_, &QTreeWidget::currentItemChanged, this, [this] { describe(true); });
  connect(list_, &QTreeWidget::itemDoubleClicked, this, &MissingPane::add);
  connect(add_, &QPushButton::clicked, this, &MissingPane::add);
  connect(all_, &QPushButton::clicked, this, &MissingPane::findAllWanted);
  connect(look_, &QPushButton::clicked, this, [this] {
    if (busy_) {
      Q_EMIT cancelWanted();
    } else {
      Q_EMIT lookWanted();
    }
  });
  follow_language(this, [this] { retranslate(); });
}

MissingPane::~MissingPane() {
  list_->disconnect(this);  // It changes while it goes.
}

void MissingPane::setRanking(std::shared_ptr<const ModelRanking> ranking, bool has_model,
                             bool busy) {
  const bool same = ranking == ranking_ && has_model == has_model_;
  ranking_ = std::move(ranking);
  has_model_ = has_model;
  busy_ = busy;
  if (!same) {
    described_ = nullptr;
    fill();
    fillBudget();
    fillAdvice();
  }
  describe();
}

void MissingPane::addFrom(const QUrl& spec) {
  if (!busy_) Q_EMIT addWanted(QUrl::fromPercentEncoding(spec.toEncoded()));
}

void MissingPane::setCalibrated(bool calibrated) {
  if (calibrated == calibrated_) return;
  calibrated_ = calibrated;
  describe();
}

void MissingPane::setDoubt(const Message& doubt) {
  if (doubt == doubt_) return;
  doubt_ = doubt;
  updateVerdict();
}

void MissingPane::setReason(const QString& reason) {
  reason_ = reason;
  updateVerdict();
}

void MissingPane::setPattern(const std::shared_ptr<const ResidualFigure>& figure) {
  pattern_->setFigure(figure, tr("its pattern cannot be seen"));
}

void MissingPane::fitRows() {
  wrap_words(*list_, kEffect);
  wrap_words(*budget_, kEffect);
}

const EffectProposal* MissingPane::current() const {
  const QTreeWidgetItem* item = list_->currentItem();
  if (!ranking_ || item == nullptr || !item->data(kEffect, kProposal).isValid()) return nullptr;
  return &ranking_->proposals[item->data(kEffect, kProposal).toUInt()];
}

void MissingPane::add() {
  if (busy_) return;
  if (const EffectProposal* p = current(); p != nullptr && !p->finding.parameters.empty()) {
    Q_EMIT addWanted(QString::fromStdString(p->finding.id));
    return;
  }
  const QTreeWidgetItem* item = list_->currentItem();
  if (!ranking_ || item == nullptr || !item->data(kEffect, kUnknown).isValid()) return;
  const StructureScore& s = ranking_->unknown[item->data(kEffect, kUnknown).toUInt()];
  Q_EMIT curveWanted(s.channel, QString::fromStdString(s.covariate),
                     QString::fromStdString(s.second_covariate));
}

void MissingPane::fill() {
  const QSignalBlocker quiet(list_);
  list_->clear();
  if (!ranking_) return;
  for (std::size_t k = 0; k < ranking_->unknown.size() && k < 5; ++k)
    addUnknown(static_cast<int>(k));
  for (std::size_t k = 0; k < ranking_->proposals.size(); ++k)
    addProposal(ranking_->proposals[k], static_cast<int>(k));
  list_->expandAll();
  fitRows();
  if (list_->topLevelItemCount() > 0) list_->setCurrentItem(list_->topLevelItem(0));
}

void MissingPane::addProposal(const EffectProposal& p, int index) {
  QTreeWidgetItem* item = nullptr;
  // Aliases stand under the one that they cannot be told from.
  if (!p.alias_of.empty()) {
    for (int k = 0; k < list_->topLevelItemCount(); ++k) {
      const QVariant at = list_->topLevelItem(k)->data(kEffect, kProposal);
      if (at.isValid() && ranking_->proposals[at.toUInt()].finding.id == p.alias_of)
        item = new QTreeWidgetItem(list_->topLevelItem(k));
    }
  }
  if (item == nullptr) item = new QTreeWidgetItem(list_);
  item->setText(kEffect, p.alias_of.empty() ? effect_title(p.finding.id)
                                            : tr("or: %1").arg(effect_title(p.finding.id)));
  item->setData(kEffect, kProposal, index);
  item->setText(kVerdict, verdict_name(p.finding.verdict));
  item->setForeground(kVerdict, verdict_color(p, palette()));
  item->setToolTip(kEffect, QStringLiteral("%1 (%2)").arg(effect_title(p.finding.id),
                                                          QString::fromStdString(p.finding.id)));
  if (p.suggested) {
    QFont font = item->font(kEffect);
    font.setBold(true);
    item->setFont(kEffect, font);
  }
  const double fall = best_fall(p);
  if (p.finding.parameters.empty() || !(fall > 0.0005)) return;
  item->setData(kFall, kShare, fall);
  item->setText(kFall, QStringLiteral("−%1 %").arg(100.0 * fall, 0, 'f', fall < 0.1 ? 1 : 0));
  item->setToolTip(
      kFall, tr("Predicted fall of the squared error in scenes held out, where it helps most"));
}

void MissingPane::addUnknown(int index) {
  const StructureScore& s = ranking_->unknown[static_cast<std::size_t>(index)];
  auto* item = new QTreeWidgetItem(list_);
  item->setText(kEffect, tr("%1 against %2").arg(channel_name(s.channel), covariates_text(s)));
  item->setData(kEffect, kUnknown, index);
  item->setText(kVerdict, tr("unknown"));
  item->setForeground(kVerdict, state_colors(palette()).doubtful);
  item->setData(kFall, kShare, s.score);
  item->setText(kFall, QStringLiteral("%1 %").arg(100.0 * s.score, 0, 'f', 1));
}

void MissingPane::fillBudget() {
  budget_->clear();
  if (!ranking_) return;
  for (const BudgetItem& limit : ranking_->budget) {
    const auto p = std::find_if(ranking_->proposals.begin(), ranking_->proposals.end(),
                                [&](const EffectProposal& q) { return q.finding.id == limit.id; });
    // What is seen is said to be missing, not to be out of sight.
    if (p != ranking_->proposals.end() && p->suggested) continue;
    const QString size = QStringLiteral("%1 = %2%3")
                             .arg(parameter_name(limit.parameter))
                             .arg(plain_number(limit.size, 2))
                             .arg(unit_behind(limit.unit));
    auto* item = new QTreeWidgetItem(
        budget_, {effect_title(limit.id) + QLatin1Char('\n') + tr("if %1").arg(size),
                  move_text(limit.translation_mm, limit.rotation_mrad)});
    if (p == ranking_->proposals.end()) continue;
    for (int column = 0; column < 2; ++column)
      item->setToolTip(column, core_text(p->finding.explanation));
  }
  fitRows();
}

// Which scenes, or what else, would tell what these cannot.
void MissingPane::fillAdvice() {
  if (!ranking_) {
    advice_->clear();
    return;
  }
  QString html;
  for (const Message& one : ranking_->advice)
    html += QStringLiteral("<li>%1</li>").arg(core_text(one).toHtmlEscaped());
  for (const StructureScore& s : strongest_of_each_channel(ranking_->unknown)) {
    QStringList links{add_link(curve_spec(s), tr("add a curve"))};
    if (!s.formula.empty())
      links << add_link(s.formula, tr("add %1").arg(QString::fromStdString(s.formula)));
    html += QStringLiteral("<li>%1 %2</li>")
                .arg(core_text(unknown_text(s)).toHtmlEscaped(), links.join(QStringLiteral(", ")));
  }
  advice_->setHtml(html.isEmpty()
                       ? QStringLiteral("<p>%1</p>").arg(tr("No further scene is asked for."))
                       : QStringLiteral("<ul style=\"margin-left:-24px\">%1</ul>").arg(html));
}

void MissingPane::updateVerdict() {
  if (busy_) {
    verdict_->setText(tr("Looking for what is missing …"));
  } else if (!ranking_) {
    verdict_->setText(has_model_           ? tr("Nobody has looked yet.")
                      : !reason_.isEmpty() ? reason_
                      : calibrated_        ? tr("Nobody has looked yet.")
                                           : tr("Run the calibration first."));
  } else if (ranking_->nothing_missing()) {
    verdict_->setText(
        doubt_.empty()
            ? tr("<b>Nothing is missing</b> in the model, as far as these scenes can tell.")
            : tr("<b>No effect is found to be missing.</b> The result is doubtful all the same: %1")
                  .arg(core_text(doubt_).toHtmlEscaped()));
  } else if (!ranking_->unknown.empty()) {
    verdict_->setText(ranking_->unknown_matters()
                          ? tr("<b>Something is left</b> that no known effect explains.")
                          : tr("<b>Nothing that matters is missing.</b> Structure is left that no "
                               "known effect explains, too small to move the extrinsic."));
  } else {
    const auto& top = ranking_->proposals.front();
    QString text = tr("<b>%1 is missing.</b>").arg(effect_title(top.finding.id));
    // One cause makes several candidates fit better: nobody shall add them all.
    const auto suggested = std::count_if(ranking_->proposals.begin(), ranking_->proposals.end(),
                                         [](const EffectProposal& p) { return p.suggested; });
    if (suggested > 1)
      text += QLatin1Char(' ') + tr("Others may only stand in for it: they are judged again once "
                                    "it is added.");
    verdict_->setText(text);
  }
}

// The reasons are to be read without scrolling where the window has room for it. The text's share
// only grows: a list that changes its height with every choice cannot be walked through.
void MissingPane::shareHeight() {
  if (parts_moved_ || !isVisible()) return;
  // Three lines of text, five rows of the list under its tabs and head, a plot of which one sees
  // the course.
  constexpr int kLeastText = 70;
  constexpr int kLeastList = 150;
  constexpr int kLeastPattern = 90;
  constexpr int kMostPattern = 170;
  const int height = parts_->height() - 2 * parts_->handleWidth();
  const int pattern = std::clamp(height / 4, kLeastPattern, kMostPattern);
  const int list = std::max(kLeastList, 2 * (height - pattern) / 5);
  const int wanted =
      static_cast<int>(std::ceil(text_->document()->size().height())) + 2 * text_->frameWidth();
  longest_text_ = std::max(longest_text_, wanted);
  const int text =
      std::clamp(longest_text_, kLeastText, std::max(kLeastText, height - pattern - list));
  parts_->setSizes({height - pattern - text, text, pattern});
}

void MissingPane::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  longest_text_ = 0;
  QTimer::singleShot(0, this, [this] { shareHeight(); });  // The layout takes its turn first.
}

void MissingPane::describe(bool by_user) {
  updateVerdict();
  const EffectProposal* p = current();
  const QTreeWidgetItem* item = list_->currentItem();
  const StructureScore* unknown = nullptr;
  if (ranking_ && item != nullptr && item->data(kEffect, kUnknown).isValid())
    unknown = &ranking_->unknown[item->data(kEffect, kUnknown).toUInt()];
  add_->setEnabled(!busy_ && ((p != nullptr && !p->finding.parameters.empty()) || unknown));
  add_->setText(unknown != nullptr ? tr("Add &curve…") : tr("A&dd"));
  all_->setEnabled(!busy_ && has_model_);
  look_->setEnabled(busy_ || has_model_ || (calibrated_ && reason_.isEmpty()));
  look_->setText(busy_ ? tr("Cancel") : tr("&Look again"));
  const void* shown = p != nullptr ? static_cast<const void*>(p) : unknown;
  if (shown == described_ && shown != nullptr) return;
  described_ = shown;
  if (p != nullptr) {
    // The values first: what follows may need to be scrolled to.
    QString html;
    if (!p->finding.parameters.empty()) {
      html += QStringLiteral("<p><b>%1</b>: %2<br>%3</p>")
                  .arg(effect_title(p->finding.id).toHtmlEscaped(),
                       values_text(p->finding.parameters, false).toHtmlEscaped(),
                       tr("Adding it moves the extrinsic by %1.")
                           .arg(move_text(p->gained_mm, p->gained_mrad)));
    }
    html += QStringLiteral("<p>%1</p>").arg(core_text(p->finding.explanation).toHtmlEscaped());
    html += criteria_html(*p);
    text_->setHtml(html);
    pattern_->setFigure(nullptr, tr("its pattern is being drawn …"));
    Q_EMIT chosen(by_user);
  } else if (unknown != nullptr) {
    describeStructure(*unknown);
  } else {
    text_->clear();
    setPattern(nullptr);
  }
  shareHeight();
}

void MissingPane::describeStructure(const StructureScore& s) {
  text_->setHtml(
      tr("<p>In scenes held out, %1 % of the variance of the %2 residuals goes with %3 (%4 %5). No "
         "effect of the catalogue explains it: a smooth curve can stand in for it.</p>")
          .arg(100.0 * s.score, 0, 'f', 1)
          .arg(channel_name(s.channel), covariates_text(s))
          .arg(plain_number(s.amplitude, 2))
          .arg(unit_text(s.channel)) +
      (s.formula.empty()
           ? QString()
           : QStringLiteral("<p>%1 %2</p>")
                 .arg(tr("A closed form predicts as well:"),
                      add_link(s.formula, tr("add %1").arg(QString::fromStdString(s.formula))))));
  setPattern(nullptr);
  Q_EMIT structureChosen(s.channel, QString::fromStdString(s.covariate));
}

void MissingPane::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) fill();
  QWidget::changeEvent(event);
}

void MissingPane::retranslate() {
  tabs_->setTabText(0, tr("Missing"));
  tabs_->setTabToolTip(0, tr("What is missing"));
  tabs_->setTabText(1, tr("Cannot be seen"));
  tabs_->setTabText(2, tr("Next scenes"));
  tabs_->setTabToolTip(2, tr("Scenes that would tell what these cannot, and what else would"));
  advice_->setAccessibleName(tr("Next scenes"));
  tabs_->setTabToolTip(1,
                       tr("Effects that these scenes do not show, and by how much each could move "
                          "the extrinsic all the same"));
  list_->setHeaderLabels({tr("Effect"), tr("Verdict"), tr("Error")});
  list_->setAccessibleName(tr("What is missing"));
  budget_->setHeaderLabels({tr("Effect"), tr("Could move by")});
  budget_->headerItem()->setToolTip(
      0, tr("Upper 95 % limit of its largest parameter; beyond it these scenes would show it"));
  budget_->setAccessibleName(tr("What cannot be seen"));
  all_->setText(tr("&Find all"));
  all_->setToolTip(tr("Add what scenes held out speak for, one after the other"));
  add_->setToolTip(tr("Add the chosen effect to the model"));
  described_ = nullptr;
  fill();
  fillBudget();
  fillAdvice();
  describe();
}

}  // namespace lvcalib::widgets

#include "moc_missing_pane.cpp"
