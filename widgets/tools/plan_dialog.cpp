// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/plan_dialog.h"

#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QGridLayout>
#include <QGuiApplication>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QSplitter>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "modelling/model_text.h"
#include "report/plan_file.h"
#include "style/texts.h"
#include "tools/plan_text.h"
#include "views/board_sketch.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

enum PlanColumn { kNumber, kPlace, kDistance, kTilt, kSigmaMm, kSigmaMrad, kFirstEffect };

// Items of the LiDARs' box that are no description of the program's own.
const QString kPlanScenes = QStringLiteral("scenes");
const QString kPlanFile = QStringLiteral("file");
const QString kPlanChoose = QStringLiteral("choose");
const QString kUnknown = QStringLiteral("–");

// Of those that the program brings along; they are good.
std::optional<LidarDescription> built_in_lidar(const QString& name) {
  QFile file(QStringLiteral(":/lidars/") + name);
  if (!file.open(QIODevice::ReadOnly)) return std::nullopt;
  const auto read = parse_lidar(file.readAll().toStdString(), name.toStdString());
  return read ? std::optional(read->lidar) : std::nullopt;
}

QLabel* file_label(QWidget* parent, const char* name) {
  auto* label = new QLabel(parent);
  label->setObjectName(QString::fromLatin1(name));
  label->setTextFormat(Qt::PlainText);
  // A long name must not make the window wider.
  label->setMinimumWidth(60);
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  return label;
}

}  // namespace

PlanDialog::PlanDialog(PlanBasis basis, Choices& choices, QString folder, QWidget* parent)
    : QDialog(parent),
      basis_(std::move(basis)),
      choices_(choices),
      folder_(std::move(folder)),
      target_(basis_.target),
      camera_(basis_.camera) {
  setObjectName(QStringLiteral("plan_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(1120, 640);
  auto* split = new QSplitter(Qt::Horizontal, this);
  split->addWidget(createForm());
  split->addWidget(createPlan());
  split->setChildrenCollapsible(false);
  split->setStretchFactor(1, 1);
  split->setSizes({290, 830});
  message_ = new QLabel(this);
  message_->setObjectName(QStringLiteral("plan_message"));
  message_->setWordWrap(true);
  message_->setTextFormat(Qt::PlainText);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  save_ = new QPushButton(this);
  copy_ = new QPushButton(this);
  close_ = new QPushButton(this);
  save_->setObjectName(QStringLiteral("plan_save"));
  copy_->setObjectName(QStringLiteral("plan_copy"));
  auto* foot = new QHBoxLayout;
  foot->addStretch();
  for (QPushButton* button : {copy_, save_, close_}) foot->addWidget(button);
  for (QPushButton* button : {browse_board_, browse_camera_, cancel_, save_, copy_, close_})
    button->setAutoDefault(false);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(message_);
  layout->addWidget(split, 1);
  layout->addLayout(foot);
  fillEffects();
  connectParts();
  follow_language(this, [this] { retranslate(); });
}

PlanDialog::~PlanDialog() {
  // They change while they go.
  for (QObject* part : std::initializer_list<QObject*>{lidars_, effects_, table_, &work_})
    part->disconnect(this);
}

QWidget* PlanDialog::createForm() {
  auto* form = new QWidget(this);
  board_label_ = new QLabel(form);
  camera_label_ = new QLabel(form);
  lidar_label_ = new QLabel(form);
  scenes_label_ = new QLabel(form);
  effects_label_ = new QLabel(form);
  board_ = file_label(form, "plan_board");
  camera_name_ = file_label(form, "plan_camera");
  browse_board_ = new QPushButton(form);
  browse_board_->setObjectName(QStringLiteral("plan_browse_board"));
  browse_camera_ = new QPushButton(form);
  browse_camera_->setObjectName(QStringLiteral("plan_browse_camera"));
  lidars_ = new QComboBox(form);
  lidars_->setObjectName(QStringLiteral("plan_lidar"));
  lidars_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  lidars_->setMinimumContentsLength(14);
  scenes_ = new QSpinBox(form);
  scenes_->setObjectName(QStringLiteral("plan_scenes"));
  scenes_->setRange(1, 100);
  scenes_->setValue(PlanOptions{}.scenes);
  go_on_ = new QCheckBox(form);
  go_on_->setObjectName(QStringLiteral("plan_go_on"));
  go_on_->setChecked(basis_.result != nullptr);
  effects_ = new QListWidget(form);
  effects_->setObjectName(QStringLiteral("plan_effects"));
  start_ = new QPushButton(form);
  start_->setObjectName(QStringLiteral("plan_start"));
  start_->setDefault(true);
  cancel_ = new QPushButton(form);
  cancel_->setObjectName(QStringLiteral("plan_cancel"));
  progress_ = new QProgressBar(form);
  progress_->setObjectName(QStringLiteral("plan_progress"));
  progress_->setRange(0, 1000);
  lidar_label_->setBuddy(lidars_);
  scenes_label_->setBuddy(scenes_);
  effects_label_->setBuddy(effects_);
  auto* grid = new QGridLayout;
  grid->addWidget(board_label_, 0, 0);
  grid->addWidget(board_, 0, 1);
  grid->addWidget(browse_board_, 0, 2);
  grid->addWidget(camera_label_, 1, 0);
  grid->addWidget(camera_name_, 1, 1);
  grid->addWidget(browse_camera_, 1, 2);
  grid->addWidget(lidar_label_, 2, 0);
  grid->addWidget(lidars_, 2, 1, 1, 2);
  grid->addWidget(scenes_label_, 3, 0);
  grid->addWidget(scenes_, 3, 1, 1, 2);
  grid->addWidget(go_on_, 4, 0, 1, 3);
  grid->setColumnStretch(1, 1);
  auto* busy = new QHBoxLayout;
  busy->addWidget(progress_, 1);
  busy->addWidget(cancel_);
  auto* layout = new QVBoxLayout(form);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addLayout(grid);
  layout->addWidget(effects_label_);
  layout->addWidget(effects_, 1);
  layout->addWidget(start_);
  layout->addLayout(busy);
  return form;
}

QWidget* PlanDialog::createPlan() {
  auto* split = new QSplitter(Qt::Vertical, this);
  table_ = new QTreeWidget(split);
  table_->setObjectName(QStringLiteral("plan_table"));
  table_->setRootIsDecorated(false);
  table_->setUniformRowHeights(true);
  table_->setAllColumnsShowFocus(true);
  table_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->header()->setStretchLastSection(false);
  auto* picture = new QWidget(split);
  pose_ = new QLabel(picture);
  pose_->setObjectName(QStringLiteral("plan_pose"));
  pose_->setTextFormat(Qt::PlainText);
  pose_->setWordWrap(true);
  sketch_ = new BoardSketch(picture);
  auto* layout = new QVBoxLayout(picture);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(pose_);
  layout->addWidget(sketch_, 1);
  split->addWidget(table_);
  split->addWidget(picture);
  split->setChildrenCollapsible(false);
  split->setSizes({230, 300});
  return split;
}

void PlanDialog::connectParts() {
  connect(browse_board_, &QPushButton::clicked, this, &PlanDialog::chooseTarget);
  connect(browse_camera_, &QPushButton::clicked, this, &PlanDialog::chooseCamera);
  connect(lidars_, &QComboBox::currentIndexChanged, this, &PlanDialog::chooseLidar);
  connect(start_, &QPushButton::clicked, this, &PlanDialog::start);
  connect(cancel_, &QPushButton::clicked, this, [this] { work_.cancel(); });
  connect(table_, &QTreeWidget::currentItemChanged, this, &PlanDialog::showPose);
  connect(save_, &QPushButton::clicked, this, &PlanDialog::save);
  connect(copy_, &QPushButton::clicked, this, &PlanDialog::copy);
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  connect(&work_, &PlanWork::ready, this, &PlanDialog::take);
  connect(&work_, &PlanWork::failed, this, [this](const Error& error) {
    error_ = error;
    refresh();
  });
  connect(&work_, &PlanWork::progressed, this, [this](double fraction, const QString& text) {
    progress_->setValue(static_cast<int>(1000.0 * fraction));
    progress_->setFormat(text);
  });
  connect(&work_, &PlanWork::cancelled, this, [this] { note_ = tr("Cancelled"); });
  connect(&work_, &PlanWork::ended, this, &PlanDialog::refresh);
}

// Whether the scenes taken belong to the board and the camera that are planned for.
bool PlanDialog::ofResult() const {
  return basis_.result && target_path_.isEmpty() && camera_path_.isEmpty();
}

void PlanDialog::fillLidars() {
  const QSignalBlocker quiet(lidars_);
  const QVariant before = lidars_->currentData();
  lidars_->clear();
  if (ofResult()) lidars_->addItem(tr("that of the scenes taken"), kPlanScenes);
  for (const QString& name : QDir(QStringLiteral(":/lidars")).entryList(QDir::Files, QDir::Name)) {
    const auto lidar = built_in_lidar(name);
    if (lidar) lidars_->addItem(lidar_name(lidar->name), name);
  }
  if (lidar_) {
    const QString name = lidar_name(lidar_->name);
    lidars_->addItem(name.isEmpty() ? QFileInfo(lidar_path_).fileName() : name, kPlanFile);
  }
  lidars_->addItem(tr("Choose a description…"), kPlanChoose);
  lidars_->setCurrentIndex(std::max(0, lidars_->findData(before)));
  last_lidar_ = lidars_->currentIndex();
}

void PlanDialog::fillEffects() {
  for (const EffectPtr& effect : effect_catalogue()) {
    if (effect->is_gauge()) continue;  // No scene could show it.
    auto* item = new QListWidgetItem(effects_);
    item->setData(Qt::UserRole, QString::fromStdString(effect->info().id));
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(Qt::Unchecked);
  }
}

void PlanDialog::chooseTarget() {
  const QString path = choices_.target_to_open(this, folder_);
  if (path.isEmpty()) return;
  const auto file = read_target(path.toStdString());
  if (file) {
    target_ = file->target;
    target_path_ = path;
  }
  takeFile(path, file ? std::nullopt : std::optional(file.error()));
}

void PlanDialog::chooseCamera() {
  const QString path = choices_.camera_to_open(this, folder_);
  if (path.isEmpty()) return;
  const auto file = read_camera(path.toStdString());
  if (file) {
    camera_ = file->camera;
    camera_path_ = path;
  }
  takeFile(path, file ? std::nullopt : std::optional(file.error()));
}

// Board or camera are now another file's, or not: the old plan is none of theirs.
void PlanDialog::takeFile(const QString& path, const std::optional<Error>& error) {
  error_ = error;
  if (!error) {
    folder_ = QFileInfo(path).absolutePath();
    take(nullptr);
  }
  fillLidars();
  refresh();
}

void PlanDialog::chooseLidar(int index) {
  if (lidars_->itemData(index).toString() != kPlanChoose) {
    last_lidar_ = index;
    refresh();
    return;
  }
  {
    const QSignalBlocker quiet(lidars_);
    lidars_->setCurrentIndex(last_lidar_);
  }
  const QString path = choices_.lidar_to_open(this, folder_);
  if (path.isEmpty()) return;
  const auto file = read_lidar(path.toStdString());
  error_.reset();
  if (file) {
    lidar_ = file->lidar;
    lidar_path_ = path;
    folder_ = QFileInfo(path).absolutePath();
    fillLidars();
    lidars_->setCurrentIndex(lidars_->findData(kPlanFile));
    note_.clear();
    for (const Message& warning : file->warnings) note_ += core_text(warning) + QLatin1Char(' ');
  } else {
    error_ = file.error();
  }
  refresh();
}

void PlanDialog::start() {
  if (!target_ || !camera_) return;
  PlanRequest request;
  request.target = *target_;
  request.camera = *camera_;
  const QString chosen = lidars_->currentData().toString();
  if (chosen == kPlanFile) {
    request.lidar = lidar_;
  } else if (chosen != kPlanScenes) {
    request.lidar = built_in_lidar(chosen);
  }
  if (ofResult()) {
    request.result = basis_.result;
    request.camera = basis_.result->camera;  // As the scenes have it.
    request.cloud = basis_.cloud;
    request.go_on = go_on_->isChecked();
  } else if (request.lidar && !request.lidar->camera_from_lidar && camera_path_.isEmpty()) {
    request.lidar->camera_from_lidar = basis_.rough_camera_from_lidar;
  }
  request.options.scenes = scenes_->value();
  for (int i = 0; i < effects_->count(); ++i) {
    if (effects_->item(i)->checkState() == Qt::Checked)
      request.options.effects.push_back(
          effects_->item(i)->data(Qt::UserRole).toString().toStdString());
  }
  take(nullptr);
  error_.reset();
  note_.clear();
  progress_->setValue(0);
  progress_->setFormat({});
  work_.request(request);
  refresh();
}

void PlanDialog::take(const std::shared_ptr<const ScenePlan>& plan) {
  plan_ = plan;
  showPlan();
  refresh();
}

void PlanDialog::showPlan() {
  const int row = table_->indexOfTopLevelItem(table_->currentItem());
  const QSignalBlocker quiet(table_);
  table_->clear();
  QStringList heads = {tr("Scene"), tr("Board"),      tr("Distance"),
                       tr("Tilt"),  tr("σ position"), tr("σ rotation")};
  if (plan_ && !plan_->scenes.empty()) {
    for (const EffectVisibility& e : plan_->scenes.front().effects) heads << effect_title(e.id);
  }
  table_->setColumnCount(static_cast<int>(heads.size()));
  table_->setHeaderLabels(heads);
  table_->headerItem()->setToolTip(kSigmaMm, tr("Of the extrinsic's position once the scene is "
                                                "taken: root of the sum over three axes, from the "
                                                "measurements' noise alone"));
  table_->headerItem()->setToolTip(kSigmaMrad, tr("Of the extrinsic's rotation once the scene is "
                                                  "taken: root of the sum over three axes, from "
                                                  "the measurements' noise alone"));
  for (int c = kFirstEffect; c < heads.size(); ++c)
    table_->headerItem()->setToolTip(c, tr("By how many σ its size of interest stands above zero"));
  // The places give way to a few effects; what they lose is in their tool tips and below. More
  // effects are scrolled to.
  constexpr int kFew = 3;
  table_->header()->setSectionResizeMode(kPlace, heads.size() <= kFirstEffect + kFew
                                                     ? QHeaderView::Stretch
                                                     : QHeaderView::ResizeToContents);
  if (!plan_) return showPose();
  const auto add = [this](const QStringList& texts) {
    auto* item = new QTreeWidgetItem(table_, texts);
    item->setToolTip(kPlace, texts[kPlace]);
    for (int c = kDistance; c < texts.size(); ++c)
      item->setTextAlignment(c, Qt::AlignRight | Qt::AlignVCenter);
    return item;
  };
  const auto sigmas = [](const Matrix6d& covariance) {
    return QStringList{QStringLiteral("%1 mm").arg(sigma_text(sigma_mm(covariance))),
                       QStringLiteral("%1 mrad").arg(sigma_text(sigma_mrad(covariance)))};
  };
  if (plan_->known) {
    QTreeWidgetItem* item =
        add(QStringList{QString(), tr("the scenes taken"), QString(), QString()} +
            sigmas(*plan_->known));
    item->setData(0, Qt::UserRole, -1);
  }
  for (std::size_t k = 0; k < plan_->scenes.size(); ++k) {
    const PlannedScene& scene = plan_->scenes[k];
    QStringList texts = {QString::number(k + 1),
                         board_place_parts(scene.pose).mid(1).join(tr(", ")),
                         QStringLiteral("%1 m").arg(scene.pose.distance_m, 0, 'f', 1),
                         QStringLiteral("%1°").arg(board_tilt_deg(scene.pose), 0, 'f', 0)};
    texts += scene.determined ? sigmas(scene.covariance) : QStringList{kUnknown, kUnknown};
    for (const EffectVisibility& e : scene.effects)
      texts << QStringLiteral("%1 σ").arg(e.sigmas, 0, 'f', 1);
    add(texts)->setData(0, Qt::UserRole, static_cast<int>(k));
  }
  const int first = plan_->known ? 1 : 0;
  const int wanted = row >= 0 && row < table_->topLevelItemCount() ? row : first;
  table_->setCurrentItem(table_->topLevelItem(wanted));
  showPose();
}

void PlanDialog::showPose() {
  const QTreeWidgetItem* item = table_->currentItem();
  const int index = item == nullptr ? -1 : item->data(0, Qt::UserRole).toInt();
  const bool has_pose = plan_ && index >= 0;
  pose_->setText(has_pose
                     ? tr("Scene %1: %2")
                           .arg(item->text(kNumber),
                                board_place(plan_->scenes[static_cast<std::size_t>(index)].pose))
                     : tr("The board as the camera will see it:"));
  if (!target_ || !camera_) return sketch_->clear();
  sketch_->setPose(
      *target_, *camera_,
      has_pose
          ? std::optional(plan_->scenes[static_cast<std::size_t>(index)].pose.camera_from_board)
          : std::nullopt);
}

QString PlanDialog::problem() const {
  if (error_) return core_text(*error_);
  if (!target_) return tr("Choose the description of the board (target.yaml).");
  if (!camera_) return tr("Choose the intrinsics of the camera (camera.yaml).");
  return {};
}

void PlanDialog::refresh() {
  const bool busy = work_.busy();
  const auto name = [](const QString& path, bool open) {
    if (!path.isEmpty()) return QFileInfo(path).fileName();
    return open ? tr("of what is open") : tr("none yet");
  };
  board_->setText(name(target_path_, target_.has_value()));
  board_->setToolTip(QDir::toNativeSeparators(target_path_));
  camera_name_->setText(name(camera_path_, camera_.has_value()));
  camera_name_->setToolTip(QDir::toNativeSeparators(camera_path_));
  go_on_->setVisible(basis_.result != nullptr);
  go_on_->setEnabled(ofResult());
  start_->setEnabled(!busy && target_ && camera_);
  progress_->setVisible(busy);
  cancel_->setVisible(busy);
  save_->setEnabled(plan_ != nullptr);
  copy_->setEnabled(plan_ != nullptr);
  QString text = problem();
  if (text.isEmpty()) text = note_;
  if (text.isEmpty() && plan_) {
    text = tr("Chosen one after the other from %1 poses that camera and LiDAR both see. σ is by "
              "noise alone.")
               .arg(plan_->poses_tried);
    for (const Message& warning : plan_->warnings) {
      QString words = core_text(warning);
      if (!words.isEmpty()) words[0] = words[0].toUpper();
      text += QLatin1Char('\n') + words + tr(".");
    }
  }
  if (text.isEmpty() && !busy)
    text =
        tr("Plans where to hold the board: each scene is the one that tells most about the "
           "extrinsic after those before it.");
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  message_->setText(text);
}

QString PlanDialog::planText() const {
  QString out;
  for (int r = 0; r < table_->topLevelItemCount(); ++r) {
    const QTreeWidgetItem* item = table_->topLevelItem(r);
    const int index = item->data(0, Qt::UserRole).toInt();
    QString line = index < 0
                       ? item->text(kPlace)
                       : QStringLiteral("%1. %2").arg(
                             item->text(kNumber),
                             board_place(plan_->scenes[static_cast<std::size_t>(index)].pose));
    line += tr("; then σ %1, %2").arg(item->text(kSigmaMm), item->text(kSigmaMrad));
    for (int c = kFirstEffect; c < table_->columnCount(); ++c)
      if (!item->text(c).isEmpty())
        line += QStringLiteral("; %1 %2").arg(table_->headerItem()->text(c), item->text(c));
    out += line + QLatin1Char('\n');
  }
  return out;
}

void PlanDialog::copy() {
  if (!plan_) return;
  QGuiApplication::clipboard()->setText(planText());
  note_ = tr("Copied.");
  refresh();
  note_.clear();
}

void PlanDialog::save() {
  if (!plan_) return;
  QString path = choices_.file_to_export(this, QDir(folder_).filePath(QStringLiteral("plan.json")),
                                         tr("Plan (*.json)"));
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".json");
  if (Status s = write_plan(*plan_, path.toStdString()); !s) {
    error_ = s.error();
    refresh();
    error_.reset();
    return;
  }
  note_ = tr("Written to %1.").arg(QDir::toNativeSeparators(path));
  refresh();
  note_.clear();
}

void PlanDialog::retranslate() {
  setWindowTitle(tr("Plan scenes"));
  board_label_->setText(tr("Board:"));
  camera_label_->setText(tr("Camera:"));
  lidar_label_->setText(tr("&LiDAR:"));
  scenes_label_->setText(tr("&Scenes:"));
  browse_board_->setText(tr("Ch&oose…"));
  browse_board_->setToolTip(tr("The target.yaml of another board"));
  browse_camera_->setText(tr("C&hoose…"));
  browse_camera_->setToolTip(tr("The camera.yaml of another camera"));
  lidars_->setToolTip(
      tr("Field of view, density and noise; rough T_camera_lidar where the "
         "description has one, else x forward, y left, z up at the camera"));
  go_on_->setText(tr("&Go on from the scenes taken"));
  go_on_->setToolTip(
      tr("Begin with what the present result knows of the extrinsic, instead of "
         "with nothing"));
  effects_label_->setText(tr("Effects to become &testable:"));
  for (int i = 0; i < effects_->count(); ++i) {
    QListWidgetItem* item = effects_->item(i);
    const std::string id = item->data(Qt::UserRole).toString().toStdString();
    item->setText(effect_title(id));
    item->setToolTip(core_text(Message::listed(find_effect(id)->info().physics)));
  }
  start_->setText(tr("&Plan"));
  cancel_->setText(tr("&Cancel"));
  save_->setText(tr("Sa&ve plan.json…"));
  copy_->setText(tr("Cop&y as text"));
  close_->setText(tr("Close"));
  sketch_->setTopWord(tr("top"));
  sketch_->setToolTip(tr("The board as the camera will see it, its upper edge marked"));
  fillLidars();
  showPlan();
  refresh();
}

}  // namespace lvcalib::widgets

#include "moc_plan_dialog.cpp"
