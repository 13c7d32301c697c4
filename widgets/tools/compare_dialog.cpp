// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/compare_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QProgressBar>
#include <QPushButton>
#include <QSplitter>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "modelling/model_text.h"
#include "runner/scene_data.h"
#include "style/swatch.h"
#include "style/texts.h"
#include "tools/projection_overlay.h"
#include "views/image_view.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// Differences that happen by chance less often contradict each other.
constexpr double kContradiction = 0.001;
constexpr double kDoubt = 0.05;
// Arrows are enlarged at first so that the longest has this length in the picture.
constexpr double kArrow_px = 60.0;
constexpr double kLargestFactor = 10'000.0;

QString nothing() {
  return QStringLiteral("–");
}

// Half of the last digit shown, and less, is zero without a sign.
QString number_text(double value, bool stated, int decimals = 3) {
  if (!stated) return nothing();
  const double least = 0.5 * std::pow(10.0, -decimals);
  return QString::number(std::abs(value) < least ? 0.0 : value, 'f', decimals);
}

QString number_text(const std::optional<double>& value, int decimals) {
  return number_text(value.value_or(0.0), value.has_value(), decimals);
}

QTreeWidget* make_table(QWidget* parent, const char* name) {
  auto* table = new QTreeWidget(parent);
  table->setObjectName(QString::fromLatin1(name));
  table->setRootIsDecorated(false);
  table->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table->header()->setStretchLastSection(false);
  table->header()->setMinimumSectionSize(30);
  return table;
}

QTreeWidgetItem* add_row(QTreeWidget* table, const QStringList& texts) {
  auto* item = new QTreeWidgetItem(table, texts);
  for (int c = 1; c < texts.size(); ++c)
    item->setTextAlignment(c, Qt::AlignRight | Qt::AlignVCenter);
  return item;
}

// One, two or five times a power of ten, not above a number.
double round_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value) return digit * power;
  }
  return power;
}

}  // namespace

CompareDialog::CompareDialog(ComparisonBasis basis, Choices& choices, const QString& folder,
                             QWidget* parent)
    : QDialog(parent),
      basis_(std::move(basis)),
      choices_(choices),
      folder_(folder),
      file_(new QPushButton(this)),
      project_(new QPushButton(this)),
      progress_(new QProgressBar(this)),
      cancel_(new QPushButton(this)),
      verdict_(new QLabel(this)),
      pose_(make_table(this, "compare_table")),
      scenes_(make_table(this, "compare_scenes")),
      close_(new QPushButton(this)) {
  setObjectName(QStringLiteral("compare_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(1120, 640);
  file_->setObjectName(QStringLiteral("compare_file"));
  project_->setObjectName(QStringLiteral("compare_project"));
  verdict_->setObjectName(QStringLiteral("compare_verdict"));
  verdict_->setWordWrap(true);
  verdict_->setTextFormat(Qt::PlainText);
  verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  pose_->setSelectionMode(QAbstractItemView::NoSelection);
  progress_->setRange(0, 1000);
  for (QPushButton* button : {file_, project_, cancel_, close_}) button->setAutoDefault(false);
  auto* head = new QGridLayout;
  for (int k = 0; k < 2; ++k) {
    labels_[k] = new QLabel(this);
    boxes_[k] = new QComboBox(this);
    boxes_[k]->setObjectName(k == 0 ? QStringLiteral("compare_from")
                                    : QStringLiteral("compare_to"));
    // A long path must not make the window wider than the screen.
    boxes_[k]->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    boxes_[k]->setMinimumContentsLength(24);
    labels_[k]->setBuddy(boxes_[k]);
    head->addWidget(labels_[k], k, 0);
    head->addWidget(boxes_[k], k, 1);
  }
  head->addWidget(file_, 0, 2);
  head->addWidget(project_, 1, 2);
  head->setColumnStretch(1, 1);
  auto* busy = new QHBoxLayout;
  busy->addWidget(progress_, 1);
  busy->addWidget(cancel_);
  auto* tables = new QSplitter(Qt::Vertical, this);
  tables->addWidget(pose_);
  tables->addWidget(scenes_);
  tables->setChildrenCollapsible(false);
  auto* split = new QSplitter(Qt::Horizontal, this);
  split->addWidget(tables);
  createPicture(split);
  split->addWidget(picture_);
  split->setChildrenCollapsible(false);
  split->setSizes({620, 500});
  auto* foot = new QHBoxLayout;
  foot->addStretch();
  foot->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(head);
  layout->addLayout(busy);
  layout->addWidget(verdict_);
  layout->addWidget(split, 1);
  layout->addLayout(foot);
  if (basis_.steps.empty()) results_.push_back({ComparedResult::Kind::kStep, 0, {}});
  for (std::size_t s = 0; s < basis_.steps.size(); ++s) {
    if (basis_.steps[s]) results_.push_back({ComparedResult::Kind::kStep, s, {}});
  }
  for (QComboBox* box : boxes_) {
    for (std::size_t k = 0; k < results_.size(); ++k) box->addItem(QString());
    box->setCurrentIndex(-1);
  }
  // What the model in force changed; without one, this result stands first and waits for another.
  const auto index_of = [this](std::size_t step) {
    for (std::size_t k = 0; k < results_.size(); ++k) {
      if (results_[k].step == step) return static_cast<int>(k);
    }
    return 0;
  };
  boxes_[0]->setCurrentIndex(index_of(0));
  if (basis_.current > 0) boxes_[1]->setCurrentIndex(index_of(basis_.current));
  connectParts();
  follow_language(this, [this] { retranslate(); });
  ask();
}

void CompareDialog::createPicture(QWidget* parent) {
  picture_ = new QWidget(parent);
  image_ = new ImageView(picture_);
  legend_ = new QLabel(picture_);
  legend_->setTextFormat(Qt::RichText);
  factor_label_ = new QLabel(picture_);
  factor_ = new QDoubleSpinBox(picture_);
  factor_->setObjectName(QStringLiteral("compare_factor"));
  factor_->setRange(1.0, kLargestFactor);
  factor_->setDecimals(0);
  factor_->setPrefix(QStringLiteral("×"));
  factor_label_->setBuddy(factor_);
  points_ = new QCheckBox(picture_);
  points_->setObjectName(QStringLiteral("compare_points"));
  auto* row = new QHBoxLayout;
  row->addWidget(legend_, 1);
  row->addWidget(points_);
  row->addWidget(factor_label_);
  row->addWidget(factor_);
  auto* layout = new QVBoxLayout(picture_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addLayout(row);
  layout->addWidget(image_, 1);
}

void CompareDialog::connectParts() {
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(cancel_, &QPushButton::clicked, this, [this] { work_.cancel(); });
  for (QComboBox* box : boxes_)
    connect(box, &QComboBox::currentIndexChanged, this, &CompareDialog::ask);
  connect(file_, &QPushButton::clicked, this, [this] {
    const QString path = choices_.result_to_open(this, folder_);
    if (!path.isEmpty()) add(ComparedResult::Kind::kFile, path);
  });
  connect(project_, &QPushButton::clicked, this, [this] {
    const QString path = choices_.project_to_open(this, folder_);
    if (!path.isEmpty()) add(ComparedResult::Kind::kProject, path);
  });
  connect(&work_, &ComparisonWork::ready, this, &CompareDialog::take);
  connect(&work_, &ComparisonWork::failed, this, [this](const Error& error) {
    error_ = error;
    showState();
  });
  connect(&work_, &ComparisonWork::progressed, this, [this](double fraction, const QString& text) {
    progress_->setValue(static_cast<int>(1000.0 * fraction));
    progress_->setFormat(text);
  });
  connect(&work_, &ComparisonWork::ended, this, &CompareDialog::showState);
  connect(scenes_, &QTreeWidget::currentItemChanged, this, &CompareDialog::chooseScene);
  connect(factor_, &QDoubleSpinBox::valueChanged, this, &CompareDialog::showFactor);
  connect(points_, &QCheckBox::toggled, this, &CompareDialog::showFactor);
  showFactor();
}

void CompareDialog::add(ComparedResult::Kind kind, const QString& path) {
  const ComparedResult added{kind, 0, QFileInfo(path).absoluteFilePath()};
  folder_ = QFileInfo(path).absolutePath();
  work_.forget(added);  // It may have been written anew.
  auto at = std::find(results_.begin(), results_.end(), added);
  if (at == results_.end()) {
    at = results_.insert(results_.end(), added);
    for (QComboBox* box : boxes_) {
      box->addItem(nameOf(added));
      box->setItemData(box->count() - 1, QDir::toNativeSeparators(added.path), Qt::ToolTipRole);
    }
  }
  const int index = static_cast<int>(at - results_.begin());
  if (boxes_[1]->currentIndex() == index) return ask();
  boxes_[1]->setCurrentIndex(index);
}

std::optional<ComparedResult> CompareDialog::chosen(int side) const {
  const int index = boxes_[side]->currentIndex();
  if (index < 0) return std::nullopt;
  return results_[static_cast<std::size_t>(index)];
}

void CompareDialog::ask() {
  comparison_ = nullptr;
  error_.reset();
  const auto first = chosen(0);
  const auto second = chosen(1);
  if (first && second) {
    progress_->setValue(0);
    progress_->setFormat({});
    work_.request(basis_, *first, *second);
  }
  showState();
  showPose();
  showScenes();
}

void CompareDialog::take(const std::shared_ptr<const Comparison>& comparison) {
  comparison_ = comparison;
  double largest = 0.0;
  for (const auto& shift : comparison_->shifts)
    largest = std::max(largest, shift ? shift->largest_px : 0.0);
  factor_->setValue(largest > kArrow_px / kLargestFactor
                        ? std::clamp(round_down(kArrow_px / largest), 1.0, kLargestFactor)
                        : 1.0);
  showState();
  showPose();
  showScenes();
}

void CompareDialog::showState() {
  verdict_->setText(verdict());
  const bool busy = work_.busy() && !comparison_ && !error_;
  progress_->setVisible(busy);
  cancel_->setVisible(busy);
}

QString CompareDialog::nameOf(const ComparedResult& what) const {
  const QFileInfo file(what.path);
  switch (what.kind) {
    case ComparedResult::Kind::kFile:
      return tr("File %1").arg(file.dir().dirName() + QLatin1Char('/') + file.fileName());
    case ComparedResult::Kind::kProject:
      return tr("Project %1").arg(file.completeBaseName());
    default:
      if (what.step >= basis_.steps.size()) return tr("This project");
      return tr("This project, step %1: %2")
          .arg(what.step)
          .arg(step_text(*basis_.steps[what.step]));
  }
}

QString CompareDialog::verdict() const {
  if (error_) return core_text(*error_);
  if (!comparison_) {
    if (work_.busy()) return tr("Being compared …");
    return chosen(1) ? tr("Cancelled")
                     : tr("Choose another result, the truth of a simulation, or another project to "
                          "compare with.");
  }
  const ExtrinsicDifference& d = comparison_->difference;
  QString out =
      tr("They differ by %1 mm and %2 mrad.")
          .arg(QString::number(d.translation_mm, 'f', 3), QString::number(d.rotation_mrad, 'f', 3));
  if (share_scenes(comparison_->first, comparison_->second)) {
    return out + QLatin1Char(' ') +
           tr("Both rest on the same scenes: chance moves both alike, and what differs is what was "
              "decided or the model. The ± of the difference would hold for results from data of "
              "their own.");
  }
  if (!d.probability) return out + QLatin1Char(' ') + tr("One of them states no uncertainty.");
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
  if (!comparison_->first.extrinsic.is_truth && !comparison_->second.extrinsic.is_truth)
    out += QLatin1Char(' ') + tr("This holds for results from data of their own.");
  return out;
}

void CompareDialog::showPose() {
  pose_->clear();
  pose_->setHeaderLabels({tr("In the camera's axes"), tr("Difference"), tr("± from"), tr("± to"),
                          tr("± of the difference"), tr("In ±")});
  if (!comparison_) return;
  const ExtrinsicDifference& d = comparison_->difference;
  const QString names[] = {tr("translation x, mm"),      tr("translation y, mm"),
                           tr("translation z, mm"),      tr("rotation about x, mrad"),
                           tr("rotation about y, mrad"), tr("rotation about z, mrad")};
  const auto states = [](const StatedExtrinsic& x) { return x.states_errors() && !x.is_truth; };
  const bool first = states(comparison_->first.extrinsic);
  const bool second = states(comparison_->second.extrinsic);
  const bool both = !d.sigma.isZero();
  for (int k = 0; k < 6; ++k) {
    // Both mm and mrad are a thousandth.
    add_row(
        pose_,
        {names[k], number_text(1e3 * d.by_axis(k), true),
         number_text(1e3 * d.sigma_first(k), first), number_text(1e3 * d.sigma_second(k), second),
         number_text(1e3 * d.sigma(k), both),
         number_text(d.by_axis(k) / std::max(d.sigma(k), 1e-300), both && d.sigma(k) > 0.0, 2)});
  }
}

void CompareDialog::showScenes() {
  const QString wanted = scene_;
  const QSignalBlocker blocked(scenes_);
  scenes_->clear();
  scenes_->setHeaderLabels(
      {tr("Scene"), tr("px from"), tr("px to"), tr("mm from"), tr("mm to"), tr("Moves, px")});
  scenes_->headerItem()->setToolTip(1, tr("Root mean square of the corners' residuals"));
  scenes_->headerItem()->setToolTip(2, scenes_->headerItem()->toolTip(1));
  scenes_->headerItem()->setToolTip(3, tr("Root mean square of the LiDAR's residuals"));
  scenes_->headerItem()->setToolTip(4, scenes_->headerItem()->toolTip(3));
  scenes_->headerItem()->setToolTip(
      5, tr("How far the board of the scene moves in the picture, root mean square over it"));
  for (std::size_t k = 0; comparison_ && k < comparison_->scenes.size(); ++k) {
    const SceneComparison& row = comparison_->scenes[k];
    const auto text = [](const std::optional<StatedScene>& scene,
                         std::optional<double> StatedScene::*value, int decimals) {
      return number_text(scene ? (*scene).*value : std::nullopt, decimals);
    };
    const auto& shift = comparison_->shifts[k];
    auto* item = add_row(
        scenes_,
        {QString::fromStdString(row.name), text(row.first, &StatedScene::rms_px, 4),
         text(row.second, &StatedScene::rms_px, 4), text(row.first, &StatedScene::rms_mm, 3),
         text(row.second, &StatedScene::rms_mm, 3),
         number_text(shift ? std::optional(shift->rms_px) : std::nullopt, 3)});
    const bool unused = (row.first && !row.first->used) || (row.second && !row.second->used);
    if (unused) item->setToolTip(0, tr("Left out of one result, or of both"));
    if (scenes_->currentItem() == nullptr || item->text(0) == wanted) scenes_->setCurrentItem(item);
  }
  chooseScene();
}

// Reads the picture and projects in the background.
void CompareDialog::chooseScene() {
  const QTreeWidgetItem* item = scenes_->currentItem();
  scene_ = item != nullptr ? item->text(0) : scene_;
  showLegend();
  const auto found = std::find_if(
      basis_.result->scenes.begin(), basis_.result->scenes.end(),
      [&](const SceneResult& s) { return item != nullptr && s.name == scene_.toStdString(); });
  const bool known = comparison_ && found != basis_.result->scenes.end();
  image_->setImage({});
  image_->overlay().setOverlay({});
  image_->setMessage(item == nullptr ? QString()
                     : known         ? tr("The image is being loaded …")
                                     : tr("This scene is not in the project that is open."));
  if (!known) {
    loader_.cancel();
    return;
  }
  SceneFiles files;
  for (const SceneFiles& f : basis_.files) {
    if (f.name == found->name) files = f;
  }
  loader_.start([this, result = basis_.result, name = found->name, files, both = comparison_](
                    const RunContext&, const Runner::Post&) -> Runner::Deliver {
    auto image = read_scene_image(files.image);
    for (const SceneResult& scene : result->scenes) {
      if (scene.name != name) continue;
      ImageOverlay overlay =
          projection_overlay(*result, scene, both->first.extrinsic.camera_from_lidar,
                             both->second.extrinsic.camera_from_lidar);
      return [this, overlay, image] {
        image_->setMessage(image ? QString()
                                 : tr("There is no image: %1").arg(core_text(image.error())));
        image_->setImage(image ? *image : QImage());
        image_->overlay().setOverlay(overlay);
        image_->fit();
      };
    }
    return {};
  });
}

void CompareDialog::showLegend() {
  const auto swatch = [this](const QColor& color, const QString& text) {
    return QStringLiteral("%1&nbsp;%2").arg(swatch_html(color, palette()), text);
  };
  const auto arrow = QStringLiteral("<span style=\"color:%1\">→</span>&nbsp;%2")
                         .arg(OverlayItem::shiftColor().name(), tr("shift of the board"));
  legend_->setText(scene_.isEmpty() ? QString()
                                    : QStringLiteral("<b>%1</b> %2 %3 %4")
                                          .arg(scene_.toHtmlEscaped(),
                                               swatch(first_projection_color(), tr("from")),
                                               swatch(second_projection_color(), tr("to")), arrow));
}

// The swatches' edges are of the palette's.
void CompareDialog::changeEvent(QEvent* event) {
  QDialog::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && legend_ != nullptr) showLegend();
}

void CompareDialog::showFactor() {
  OverlayParts parts = image_->overlay().parts();
  parts.points = points_->isChecked();
  image_->overlay().setParts(parts);
  image_->overlay().setResidualFactor(factor_->value());
}

void CompareDialog::retranslate() {
  setWindowTitle(tr("Compare results"));
  labels_[0]->setText(tr("&From"));
  labels_[1]->setText(tr("&To"));
  for (QComboBox* box : boxes_) {
    box->setPlaceholderText(tr("nothing chosen yet"));
    for (std::size_t k = 0; k < results_.size(); ++k)
      box->setItemText(static_cast<int>(k), nameOf(results_[k]));
  }
  file_->setText(tr("&Result file…"));
  file_->setToolTip(tr("A result.json or result.yaml, or the truth of a simulation"));
  project_->setText(tr("&Project…"));
  project_->setToolTip(tr("Another project: it is calibrated for this"));
  cancel_->setText(tr("Cancel"));
  points_->setText(tr("Points"));
  points_->setToolTip(tr("The LiDAR's points on the board, as either projects them"));
  factor_label_->setText(tr("&Arrows"));
  factor_->setToolTip(
      tr("How much longer than they are the arrows are drawn, which lead from where "
         "the one projects the board to where the other does"));
  factor_->setAccessibleName(tr("Enlargement of the arrows"));
  close_->setText(tr("Close"));
  showState();
  showPose();
  showScenes();
}

}  // namespace lvcalib::widgets

#include "moc_compare_dialog.cpp"
