// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/add_effect_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTabWidget>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <algorithm>

#include "model/row_covariates.h"
#include "model/user_effect.h"
#include "modelling/figure_source.h"
#include "modelling/model_text.h"
#include "modelling/residual_plot.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

QString searched_text(const EffectInfo& info) {
  // Found by its English words too: they stand in files and papers.
  return QString::fromStdString(info.id + ' ' + info.title + ' ' + info.group + ' ' + info.physics +
                                ' ' + info.formula + ' ') +
         core_text(Message::listed(info.title)) + core_text(Message::listed(info.physics));
}

// Each parameter at the size that planned scenes shall show.
EffectInUse at_size_of_interest(const EffectPtr& effect, const ModelStep& step) {
  EffectInUse use{effect, effect->shapes(step.table()).front(), {}};
  const auto parameters = effect->parameters(step.table());
  use.values.resize(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    use.values(static_cast<Eigen::Index>(k)) = parameters[k].size_of_interest;
  return use;
}

// The channels in the present language; the choice stays, at first the range.
void fill_channels(QComboBox& box, const ModelStep& step) {
  const QSignalBlocker quiet(box);
  const QVariant before = box.currentData();
  box.clear();
  for (const ChannelSummary& c : step.channels)
    box.addItem(channel_name(c.channel), static_cast<int>(c.channel));
  const QVariant wanted = before.isValid() ? before : QVariant(static_cast<int>(Channel::kRange));
  box.setCurrentIndex(std::max(0, box.findData(wanted)));
}

void add_row(QFormLayout& form, QWidget& field) {
  auto* label = new QLabel(field.parentWidget());
  label->setBuddy(&field);
  form.addRow(label, &field);
}

void set_row_label(QWidget& field, const QString& text) {
  const auto* form = qobject_cast<const QFormLayout*>(field.parentWidget()->layout());
  auto* label = form == nullptr ? nullptr : qobject_cast<QLabel*>(form->labelForField(&field));
  if (label != nullptr) label->setText(text);
}

Channel channel_of(const QComboBox& box) {
  return static_cast<Channel>(box.currentData().toInt());
}

}  // namespace

AddEffectDialog::AddEffectDialog(const ModelStepPtr& step, QWidget* parent)
    : QDialog(parent),
      step_(step),
      source_(std::make_unique<FigureSource>()),
      tabs_(new QTabWidget(this)),
      problem_(new QLabel(this)),
      add_(new QPushButton(this)) {
  setObjectName(QStringLiteral("add_effect_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(760, 560);
  source_->setSteps(step, step);
  tabs_->addTab(createCatalogue(), {});
  tabs_->addTab(createFormula(), {});
  tabs_->addTab(createCurve(), {});
  problem_->setObjectName(QStringLiteral("add_problem"));
  problem_->setWordWrap(true);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  buttons->addButton(add_, QDialogButtonBox::AcceptRole);
  add_->setObjectName(QStringLiteral("add_chosen"));
  add_->setDefault(true);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(tabs_, 1);
  layout->addWidget(problem_);
  layout->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  connect(add_, &QPushButton::clicked, this, [this] {
    const QString chosen = spec();
    if (chosen.isEmpty()) return;
    Q_EMIT addWanted(chosen);
    close();
  });
  connect(tabs_, &QTabWidget::currentChanged, this, &AddEffectDialog::check);
  connect(source_.get(), &FigureSource::patternReady, this,
          [this](const std::shared_ptr<const ResidualFigure>& figure) {
            pattern_->setFigure(figure, tr("leaves no pattern in these scenes"));
          });
  follow_language(this, [this] { retranslate(); });
}

AddEffectDialog::~AddEffectDialog() {
  // They change while they go.
  for (QObject* part : std::initializer_list<QObject*>{tabs_, list_, search_, curve_first_,
                                                       curve_second_, curve_channel_})
    part->disconnect(this);
}

QWidget* AddEffectDialog::createCatalogue() {
  auto* page = new QWidget(tabs_);
  auto* layout = new QVBoxLayout(page);
  search_ = new QLineEdit(page);
  search_->setObjectName(QStringLiteral("effect_search"));
  search_->setClearButtonEnabled(true);
  auto* splitter = new QSplitter(Qt::Horizontal, page);
  splitter->setChildrenCollapsible(false);
  list_ = new QListWidget(splitter);
  list_->setObjectName(QStringLiteral("effects"));
  auto* right = new QSplitter(Qt::Vertical, splitter);
  right->setChildrenCollapsible(false);
  text_ = new QTextBrowser(right);
  pattern_ = new ResidualPlot(right);
  pattern_->setMeansOnly(true);
  right->setSizes({220, 240});
  splitter->setStretchFactor(1, 1);
  splitter->setSizes({260, 480});
  layout->addWidget(search_);
  layout->addWidget(splitter, 1);
  connect(search_, &QLineEdit::textChanged, this, &AddEffectDialog::filter);
  connect(list_, &QListWidget::currentItemChanged, this, &AddEffectDialog::describe);
  connect(list_, &QListWidget::itemDoubleClicked, add_, &QPushButton::click);
  return page;
}

QWidget* AddEffectDialog::createFormula() {
  auto* page = new QWidget(tabs_);
  auto* form = new QFormLayout(page);
  formula_channel_ = new QComboBox(page);
  formula_channel_->setObjectName(QStringLiteral("formula_channel"));
  formula_ = new QLineEdit(page);
  formula_->setObjectName(QStringLiteral("formula"));
  formula_->setPlaceholderText(QStringLiteral("a*darkness + b*range^2"));
  formula_words_ = new QLabel(page);
  formula_words_->setWordWrap(true);
  formula_words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  formula_help_ = new QLabel(page);
  formula_help_->setWordWrap(true);
  add_row(*form, *formula_channel_);
  add_row(*form, *formula_);
  add_row(*form, *formula_words_);
  form->addRow(formula_help_);
  connect(formula_channel_, &QComboBox::currentIndexChanged, this,
          &AddEffectDialog::fillCovariates);
  connect(formula_, &QLineEdit::textChanged, this, &AddEffectDialog::check);
  return page;
}

QWidget* AddEffectDialog::createCurve() {
  auto* page = new QWidget(tabs_);
  auto* form = new QFormLayout(page);
  curve_channel_ = new QComboBox(page);
  curve_channel_->setObjectName(QStringLiteral("curve_channel"));
  curve_first_ = new QComboBox(page);
  curve_first_->setObjectName(QStringLiteral("curve_first"));
  curve_second_ = new QComboBox(page);
  curve_help_ = new QLabel(page);
  curve_help_->setWordWrap(true);
  add_row(*form, *curve_channel_);
  add_row(*form, *curve_first_);
  add_row(*form, *curve_second_);
  form->addRow(curve_help_);
  connect(curve_channel_, &QComboBox::currentIndexChanged, this, &AddEffectDialog::fillCovariates);
  connect(curve_first_, &QComboBox::currentIndexChanged, this, &AddEffectDialog::check);
  connect(curve_second_, &QComboBox::currentIndexChanged, this, &AddEffectDialog::check);
  return page;
}

void AddEffectDialog::suggestCurve(Channel channel, const QString& covariate,
                                   const QString& second) {
  tabs_->setCurrentIndex(kCurve);
  curve_channel_->setCurrentIndex(std::max(0, curve_channel_->findData(static_cast<int>(channel))));
  curve_first_->setCurrentIndex(std::max(0, curve_first_->findData(covariate)));
  curve_second_->setCurrentIndex(std::max(0, curve_second_->findData(second)));
}

void AddEffectDialog::retranslate() {
  setWindowTitle(tr("Add an effect"));
  add_->setText(tr("A&dd"));
  tabs_->setTabText(kCatalogue, tr("Catalogue"));
  tabs_->setTabText(kFormula, tr("Formula"));
  tabs_->setTabText(kCurve, tr("Curve"));
  search_->setPlaceholderText(tr("Search by name, physics or formula"));
  formula_help_->setText(
      tr("What is added to the measurement, in m (range, boundary), px (corner) or the "
         "logarithm of the intensity. Covariates are in m, rad and px. Other names are "
         "coefficients, which are fitted; the formula must be linear in them."));
  curve_help_->setText(
      tr("A smooth curve stands in for a cause that nobody knows yet. Of two covariates it is a "
         "surface."));
  set_row_label(*formula_channel_, tr("Channel"));
  set_row_label(*formula_, tr("Formula"));
  set_row_label(*formula_words_, tr("Covariates"));
  set_row_label(*curve_channel_, tr("Channel"));
  set_row_label(*curve_first_, tr("Along"));
  set_row_label(*curve_second_, tr("and"));
  fill_channels(*formula_channel_, *step_);
  fill_channels(*curve_channel_, *step_);
  const QVariant second = curve_second_->currentData();
  const int row = list_->currentRow();
  filter(search_->text());
  if (row >= 0) list_->setCurrentRow(row);
  fillCovariates();
  curve_second_->setCurrentIndex(std::max(0, curve_second_->findData(second)));
}

void AddEffectDialog::filter(const QString& words) {
  const QStringList wanted = words.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  list_->clear();
  for (const EffectPtr& effect : effect_catalogue()) {
    const EffectInfo& info = effect->info();
    const auto there = step_->find(info.id);
    if (there && step_->terms[*there].on) continue;
    const QString text = searched_text(info);
    const bool matches = std::all_of(wanted.begin(), wanted.end(), [&](const QString& word) {
      return text.contains(word, Qt::CaseInsensitive);
    });
    if (!matches) continue;
    auto* item = new QListWidgetItem(effect_title(info.id), list_);
    item->setData(Qt::UserRole, QString::fromStdString(info.id));
    if (!why_not_testable(*effect, step_->table()).empty())
      item->setForeground(palette().color(QPalette::Disabled, QPalette::Text));
  }
  list_->setCurrentRow(0);
  describe();
}

void AddEffectDialog::describe() {
  const QListWidgetItem* item = list_->currentItem();
  const EffectPtr effect =
      item == nullptr ? nullptr : find_effect(item->data(Qt::UserRole).toString().toStdString());
  if (effect == nullptr) {
    text_->setHtml(tr("<p>No effect matches.</p>"));
    pattern_->setFigure(nullptr, {});
    check();
    return;
  }
  const EffectInfo& info = effect->info();
  const auto line = [](const QString& name, const std::string& text) {
    return text.empty() ? QString()
                        : QStringLiteral("<p><b>%1</b> %2</p>")
                              .arg(name, core_text(Message::listed(text)).toHtmlEscaped());
  };
  text_->setHtml(QStringLiteral("<h3>%1</h3>").arg(effect_title(info.id).toHtmlEscaped()) +
                 line({}, info.physics) + line(tr("Formula:"), info.formula) +
                 line(tr("To tell it from others:"), info.discriminating_pose) +
                 line(tr("Source:"), info.source));
  if (why_not_testable(*effect, step_->table()).empty()) {
    pattern_->setFigure(nullptr, tr("its pattern is being drawn …"));
    source_->requestPattern(at_size_of_interest(effect, *step_));
  } else {
    pattern_->setFigure(nullptr, tr("not with these measurements"));
  }
  check();
}

void AddEffectDialog::fillCovariates() {
  QStringList words;
  for (const RowCovariate& c : row_covariates(channel_of(*formula_channel_))) {
    if (!c.categories && has_covariate(step_->table(), c))
      words << QString::fromStdString(c.identifier());
  }
  formula_words_->setText(words.join(QStringLiteral(", ")));
  const QSignalBlocker first(curve_first_);
  const QSignalBlocker second(curve_second_);
  const QVariant before = curve_first_->currentData();
  curve_first_->clear();
  curve_second_->clear();
  curve_second_->addItem(tr("nothing else"), QString());
  for (const RowCovariate& c : row_covariates(channel_of(*curve_channel_))) {
    if (!has_covariate(step_->table(), c)) continue;
    curve_first_->addItem(covariate_name(c.name), QString::fromLatin1(c.name));
    if (!c.categories) curve_second_->addItem(covariate_name(c.name), QString::fromLatin1(c.name));
  }
  curve_first_->setCurrentIndex(std::max(0, curve_first_->findData(before)));
  check();
}

QString AddEffectDialog::spec() const {
  const auto name = [](const QComboBox& box) {
    return QString::fromLatin1(name_of(channel_of(box)));
  };
  switch (tabs_->currentIndex()) {
    case kCatalogue: {
      const QListWidgetItem* item = list_->currentItem();
      return item == nullptr ? QString() : item->data(Qt::UserRole).toString();
    }
    case kFormula:
      return formula_->text().trimmed().isEmpty()
                 ? QString()
                 : QStringLiteral("formula:%1:%2").arg(name(*formula_channel_), formula_->text());
    default: {
      QString text = QStringLiteral("curve:%1:%2")
                         .arg(name(*curve_channel_), curve_first_->currentData().toString());
      const QString other = curve_second_->currentData().toString();
      return other.isEmpty() ? text : text + QLatin1Char(',') + other;
    }
  }
}

// Says at once what is wrong with a choice; what needs all the data is checked when it is added.
void AddEffectDialog::check() {
  if (list_ == nullptr || curve_second_ == nullptr) return;
  const std::string text = spec().toStdString();
  QString problem;
  bool usable = !text.empty();
  if (usable && is_user_effect(text)) {
    if (const auto parsed = parse_user_effect(text); !parsed) {
      problem = core_text(parsed.error());
      usable = false;
    }
  } else if (usable) {
    const EffectPtr effect = find_effect(text);
    const Message why =
        effect ? why_not_testable(*effect, step_->table()) : Message::verbatim("unknown");
    if (!why.empty()) problem = tr("Cannot be used here: %1").arg(core_text(why));
    usable = why.empty();
  }
  problem_->setText(problem);
  problem_->setVisible(!problem.isEmpty());
  add_->setEnabled(usable);
}

}  // namespace lvcalib::widgets

#include "moc_add_effect_dialog.cpp"
