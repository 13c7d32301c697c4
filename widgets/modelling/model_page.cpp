// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/model_page.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>

#include "modelling/add_effect_dialog.h"
#include "modelling/budget_plot.h"
#include "modelling/missing_pane.h"
#include "modelling/model_text.h"
#include "modelling/term_list.h"
#include "modelling/what_if_pane.h"
#include "runner/model_work.h"
#include "style/swatch.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

ModelPage::ModelPage(ModelWork& work, QWidget* parent)
    : QWidget(parent),
      work_(work),
      title_(new QLabel(this)),
      legend_(new QLabel(this)),
      compare_(new QPushButton(this)),
      budget_(new BudgetPlot(this)),
      terms_(new TermList(this)),
      what_if_(new WhatIfPane(this)),
      where_(new WherePane(source_, this)),
      missing_(new MissingPane(this)) {
  setObjectName(QStringLiteral("model_page"));
  createLayout();
  connectParts();
  connectWork();
  follow_language(this, [this] { retranslate(); });
  takeSteps();
}

ModelPage::~ModelPage() = default;

void ModelPage::createLayout() {
  auto* left = new QWidget(this);
  what_if_->setMinimumWidth(215);  // The list above asks for what its names and values need.
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(terms_, 1);
  column->addWidget(what_if_);
  auto* columns = new QSplitter(Qt::Horizontal, this);
  columns->setChildrenCollapsible(false);
  columns->addWidget(left);
  columns->addWidget(where_);
  columns->addWidget(missing_);
  where_->setMinimumWidth(410);    // The names of its figures side by side.
  missing_->setMinimumWidth(285);  // Names of effects, verdicts and falls side by side.
  columns->setStretchFactor(0, 0);
  columns->setStretchFactor(1, 1);
  columns->setStretchFactor(2, 0);
  columns->setSizes({265, 400, 420});
  auto* rows = new QSplitter(Qt::Vertical, this);
  rows->setChildrenCollapsible(false);
  budget_->setMinimumHeight(90);
  legend_->setObjectName(QStringLiteral("model_legend"));
  // Many steps take more lines, not more width from the docks.
  legend_->setWordWrap(true);
  legend_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
  auto* top = new QWidget(this);
  auto* history = new QVBoxLayout(top);
  history->setContentsMargins(0, 0, 0, 0);
  history->setSpacing(0);
  compare_->setObjectName(QStringLiteral("compare_steps"));
  auto* head = new QHBoxLayout;
  head->addWidget(legend_, 1);
  head->addWidget(compare_, 0, Qt::AlignTop);
  history->addLayout(head);
  history->addWidget(budget_, 1);
  rows->addWidget(top);
  rows->addWidget(columns);
  rows->setStretchFactor(0, 0);
  rows->setStretchFactor(1, 1);
  rows->setSizes({150, 650});
  title_->setObjectName(QStringLiteral("model_message"));
  title_->setWordWrap(true);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->setSpacing(3);
  layout->addWidget(title_);
  layout->addWidget(rows, 1);
}

void ModelPage::connectParts() {
  connect(compare_, &QPushButton::clicked, this, &ModelPage::compareWanted);
  connect(budget_, &BudgetPlot::stepClicked, this, [this](int step) {
    if (!work_.busy() || work_.looking()) work_.go_to(static_cast<std::size_t>(step));
  });
  connect(terms_, &TermList::onWanted, this,
          [this](int k, bool on) { work_.set_on(static_cast<std::size_t>(k), on); });
  connect(terms_, &TermList::holdWanted, this,
          [this](int k, const std::optional<Eigen::VectorXd>& values) {
            work_.hold(static_cast<std::size_t>(k), values);
          });
  connect(terms_, &TermList::removeWanted, this,
          [this](int k) { work_.remove(static_cast<std::size_t>(k)); });
  connect(terms_, &TermList::addWanted, this, [this] { openDialog({}, std::nullopt); });
  connect(what_if_, &WhatIfPane::effectChosen, this,
          [this](const std::optional<EffectInUse>& effect, double scale) {
            where_->setOverlay(effect, scale);
            if (!effect) return;
            pattern_is_proposal_ = false;
            follow_pattern_ = true;
            source_.requestPattern(*effect);
          });
  connect(what_if_, &WhatIfPane::scaleChanged, where_, &WherePane::setOverlayScale);
  connect(missing_, &MissingPane::addWanted, &work_,
          [this](const QString& spec) { work_.add(spec); });
  connect(missing_, &MissingPane::findAllWanted, &work_, &ModelWork::find_all);
  connect(missing_, &MissingPane::lookWanted, &work_, &ModelWork::start);
  connect(missing_, &MissingPane::cancelWanted, &work_, &ModelWork::cancel);
  connect(missing_, &MissingPane::chosen, this, &ModelPage::takeChosen);
  connect(missing_, &MissingPane::structureChosen, where_, &WherePane::look);
  connect(missing_, &MissingPane::curveWanted, this,
          [this](Channel channel, const QString& covariate, const QString& second) {
            openDialog(covariate, channel, second);
          });
  connect(&source_, &FigureSource::patternReady, this,
          [this](const std::shared_ptr<const ResidualFigure>& figure) {
            if (pattern_is_proposal_) missing_->setPattern(figure);
            if (figure && follow_pattern_)
              where_->look(figure->view->columns.channel,
                           QString::fromStdString(figure->along().name));
          });
  connect(where_, &WherePane::turned, this, [this] { follow_pattern_ = false; });
  connect(where_, &WherePane::selected, this, &ModelPage::forward);
  connect(where_, &WherePane::excludeWanted, this, &ModelPage::excludeWanted);
  connect(where_, &WherePane::failed, this, &ModelPage::failed);
  connect(budget_->figureActions(), &FigureActions::failed, this, &ModelPage::failed);
}

void ModelPage::connectWork() {
  connect(&work_, &ModelWork::changed, this, &ModelPage::takeSteps);
  connect(&work_, &ModelWork::ranking_changed, this, &ModelPage::takeRanking);
  connect(&work_, &ModelWork::result_changed, this, &ModelPage::takeRanking);
  const auto busy = [this] {
    terms_->setChangeable(!work_.busy());
    takeSteps();
  };
  connect(&work_, &ModelWork::started, this, busy);
  connect(&work_, &ModelWork::ended, this, busy);
}

void ModelPage::setReason(const Message& reason) {
  reason_ = reason;
  takeSteps();
}

void ModelPage::setTruth(const std::optional<Rigid3>& camera_from_lidar) {
  budget_->setTruth(camera_from_lidar);
  describeSteps();
}

void ModelPage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  work_.start();
}

void ModelPage::takeSteps() {
  const ModelStepPtr step = work_.step();
  const ModelStepPtr base = step ? work_.steps().front() : nullptr;
  const QString told =
      !reason_.empty() ? core_text(reason_)
      : work_.can_start()
          ? tr("The model is not fitted to this calibration yet: press Look again.")
          : tr("Run the calibration to see what its model explains and what it misses.");
  const QString reason =
      work_.busy() ? tr("The measurements are being collected and the model fitted …") : told;
  missing_->setCalibrated(work_.can_start());
  missing_->setReason(core_text(reason_));
  title_->setText(step ? QString() : reason);
  title_->setVisible(!title_->text().isEmpty());
  budget_->setSteps(work_.steps(), work_.current());
  const auto& steps = work_.steps();
  compare_->setVisible(std::count_if(steps.begin(), steps.end(),
                                     [](const ModelStepPtr& s) { return s != nullptr; }) > 1);
  describeSteps();
  if (step != shown_ || !step) {
    shown_ = step;
    source_.setSteps(step, base);
    terms_->setStep(step, base);
    where_->setStep(step, reason);
    what_if_->setStep(step);
  }
  takeRanking();
}

// What the colours mean, and the steps by name with the present one in bold.
void ModelPage::describeSteps() {
  const PlotColors colors = PlotColors::of(palette());
  const auto entry = [this](const QColor& color, const QString& text) {
    return QStringLiteral("%1&nbsp;%2").arg(swatch_html(color, palette()), text);
  };
  QStringList steps;
  for (std::size_t k = 0; k < work_.steps().size(); ++k) {
    const ModelStepPtr& step = work_.steps()[k];
    const QString text = step ? step_text(*step).toHtmlEscaped() : QStringLiteral("…");
    steps << (k == work_.current() ? QStringLiteral("<b>%1</b>").arg(text) : text);
  }
  QStringList legend = {entry(BudgetPlot::noiseColor(colors), tr("within noise")),
                        entry(colors.refused, tr("unexplained")),
                        entry(BudgetPlot::explainedColor(colors), tr("explained")),
                        QStringLiteral("<span style=\"color:%1\">◇</span>&nbsp;%2")
                            .arg(colors.mark.name(), tr("scenes held out"))};
  if (budget_->knowsTruth()) {
    legend << entry(colors.series(0), tr("mm from the truth"))
           << entry(colors.series(1), tr("mrad from the truth"));
  }
  legend_->setText(legend.join(QStringLiteral("&nbsp; ")) +
                   (steps.isEmpty() ? QString()
                                    : QStringLiteral("&nbsp;&nbsp;&nbsp;&nbsp;") +
                                          tr("Steps: %1").arg(steps.join(QStringLiteral(" → ")))));
}

void ModelPage::takeRanking() {
  const auto ranking = work_.ranking();
  budget_->setSomethingMissing(ranking && !ranking->nothing_missing());
  const auto result = work_.result() ? work_.result() : work_.source();
  const bool doubtful = result && !work_.behind() && result->quality != Quality::kGood;
  missing_->setDoubt(doubtful ? result->quality_reason : Message());
  missing_->setRanking(work_.ranking(), work_.step() != nullptr, work_.busy());
}

// Draws the chosen effect's pattern at its estimate, and shows where it is. Nobody asked for one
// that is not suggested and only comes first: who has just added an effect watches its own curve
// fall.
void ModelPage::takeChosen(bool by_user) {
  const EffectProposal* p = missing_->current();
  const EffectPtr effect = p == nullptr ? nullptr : find_effect(p->finding.id);
  if (!effect || p->finding.parameters.empty() || !shown_) {
    missing_->setPattern(nullptr);
    where_->setOverlay(std::nullopt);
    return;
  }
  EffectInUse use{effect, p->finding.shape,
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(p->finding.parameters.size()))};
  for (std::size_t k = 0; k < p->finding.parameters.size(); ++k)
    use.values(static_cast<Eigen::Index>(k)) = p->finding.parameters[k].value;
  where_->setOverlay(use);
  pattern_is_proposal_ = true;
  follow_pattern_ = by_user || p->suggested;
  source_.requestPattern(use);
}

void ModelPage::openDialog(const QString& covariate, std::optional<Channel> channel,
                           const QString& second) {
  if (!shown_) return;
  auto* dialog = new AddEffectDialog(shown_, this);
  if (channel) dialog->suggestCurve(*channel, covariate, second);
  connect(dialog, &AddEffectDialog::addWanted, this, [this](const QString& spec) {
    if (!work_.busy()) work_.add(spec);
  });
  dialog->show();
}

void ModelPage::forward(const std::vector<SelectedSample>& samples) {
  SamplesOfScenes out;
  for (const SelectedSample& s : samples) {
    const auto& scene = shown_->table().scenes[static_cast<std::size_t>(s.scene)];
    SceneSamples& of_scene = out[QString::fromStdString(scene.name)];
    if (s.point_in_lidar_m) of_scene.points_in_lidar_m.push_back(*s.point_in_lidar_m);
    if (s.pixel) of_scene.pixels.push_back(*s.pixel);
  }
  Q_EMIT samplesSelected(out);
}

void ModelPage::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) describeSteps();
  QWidget::changeEvent(event);
}

void ModelPage::retranslate() {
  compare_->setText(tr("Compare steps…"));
  compare_->setToolTip(
      tr("How far the pose moved between two steps, and the residuals of every scene at both"));
  takeSteps();
}

}  // namespace lvcalib::widgets

#include "moc_model_page.cpp"
