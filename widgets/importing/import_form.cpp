// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/import_form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <algorithm>

#include "importing/board_choice.h"
#include "style/texts.h"
#include "tools/target_camera_dialog.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// Items of the combo boxes that are no topic and no file.
const QString kNoIntrinsics = QStringLiteral("none");
const QString kCameraFile = QStringLiteral("file:");
const QString kChooseFile = QStringLiteral("choose");
const QString kMakeFile = QStringLiteral("make");

QString name_of_topic(const Recording& recording, std::size_t topic) {
  return QString::fromStdString(recording.topics()[topic].name);
}

// The folder in which a recording lies.
QDir place_of(const Recording& recording) {
  return QFileInfo(QString::fromStdString(recording.path().string())).absoluteDir();
}

}  // namespace

ImportForm::ImportForm(Choices& choices, const QStringList& recent, QWidget* parent)
    : QWidget(parent),
      choices_(choices),
      image_(new QComboBox(this)),
      cloud_(new QComboBox(this)),
      intrinsics_(new QComboBox(this)),
      board_(new BoardChoice(choices, recent, this)),
      least_(new QDoubleSpinBox(this)),
      folder_(new QLineEdit(this)),
      browse_(new QPushButton(this)),
      replace_(new QCheckBox(this)) {
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(8, 0, 0, 0);
  layout->setColumnStretch(1, 1);
  QWidget* const fields[] = {image_, cloud_, intrinsics_, board_, least_, folder_};
  const char* const names[] = {"image_topic", "cloud_topic", "intrinsics",
                               "board",       "min_still",   "dataset_folder"};
  for (int row = 0; row < 6; ++row) {
    labels_[row] = new QLabel(this);
    labels_[row]->setBuddy(fields[row]);
    fields[row]->setObjectName(QString::fromLatin1(names[row]));
    layout->addWidget(labels_[row], row, 0);
    const bool wide = fields[row] != folder_;
    layout->addWidget(fields[row], row, 1, 1, wide ? 2 : 1);
  }
  for (QComboBox* box : {image_, cloud_, intrinsics_}) {
    // Names of topics and files are long; the list shows them in full.
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(18);
  }
  layout->addWidget(browse_, 5, 2);
  layout->addWidget(replace_, 6, 1, 1, 2);
  layout->setRowStretch(7, 1);
  replace_->setObjectName(QStringLiteral("replace_import"));
  replace_->hide();
  browse_->setAutoDefault(false);
  least_->setRange(0.1, 3600.0);
  least_->setDecimals(1);
  least_->setSingleStep(0.1);
  least_->setValue(StillOptions{}.min_still_s);
  connect(image_, &QComboBox::currentIndexChanged, this, [this] {
    fillIntrinsics(false);
    Q_EMIT topicsChanged();
  });
  connect(cloud_, &QComboBox::currentIndexChanged, this, &ImportForm::topicsChanged);
  connect(intrinsics_, &QComboBox::currentIndexChanged, this, &ImportForm::chooseIntrinsics);
  connect(board_, &BoardChoice::boardChanged, this, [this] {
    camera_problem_.clear();
    Q_EMIT boardChanged();
  });
  connect(least_, &QDoubleSpinBox::valueChanged, this, &ImportForm::limitsChanged);
  connect(folder_, &QLineEdit::textChanged, this, &ImportForm::checkFolder);
  connect(browse_, &QPushButton::clicked, this, &ImportForm::browseFolder);
  connect(replace_, &QCheckBox::toggled, this, &ImportForm::changed);
  follow_language(this, [this] { retranslate(); });
}

void ImportForm::clear() {
  opened_.reset();
  camera_.reset();
  camera_path_.clear();
  const QSignalBlocker a(image_), b(cloud_), c(intrinsics_);
  for (QComboBox* box : {image_, cloud_, intrinsics_}) box->clear();
  folder_->clear();
}

void ImportForm::setRecording(const OpenedRecording& opened) {
  clear();
  opened_ = opened;
  fillTopics();
  fillIntrinsics(false);
  board_->setPlace(placeOfFiles());
  folder_->setText(suggestedFolder());
}

void ImportForm::fillTopics() {
  const QSignalBlocker a(image_), b(cloud_);
  const Recording& recording = *opened_->recording;
  for (const std::size_t i : opened_->candidates.images)
    image_->addItem(name_of_topic(recording, i));
  for (const std::size_t i : opened_->candidates.clouds)
    cloud_->addItem(name_of_topic(recording, i));
}

// CameraInfo of the recording, a file, or nothing for now.
void ImportForm::fillIntrinsics(bool keep) {
  if (!opened_) return;
  const QSignalBlocker quiet(intrinsics_);
  const QVariant before = intrinsics_->currentData();
  intrinsics_->clear();
  for (const std::size_t i : opened_->candidates.infos) {
    const QString name = name_of_topic(*opened_->recording, i);
    intrinsics_->addItem(tr("CameraInfo %1").arg(name), name);
  }
  if (!camera_path_.isEmpty())
    intrinsics_->addItem(QDir::toNativeSeparators(camera_path_), kCameraFile);
  const int image = image_->currentIndex();
  std::optional<std::size_t> info;
  if (image >= 0 && static_cast<std::size_t>(image) < opened_->info_of_images.size())
    info = opened_->info_of_images[static_cast<std::size_t>(image)];
  if (!info) intrinsics_->addItem(tr("none yet"), kNoIntrinsics);
  intrinsics_->addItem(tr("Choose a camera file…"), kChooseFile);
  intrinsics_->addItem(tr("Make a camera.yaml…"), kMakeFile);
  QVariant wanted = kNoIntrinsics;
  if (info) wanted = name_of_topic(*opened_->recording, *info);
  if (camera_) wanted = kCameraFile;
  if (keep && before.isValid()) wanted = before;
  intrinsics_->setCurrentIndex(std::max(0, intrinsics_->findData(wanted)));
  last_intrinsics_ = intrinsics_->currentIndex();
}

void ImportForm::chooseIntrinsics(int index) {
  if (intrinsics_->itemData(index) == kMakeFile) {
    {
      const QSignalBlocker quiet(intrinsics_);
      intrinsics_->setCurrentIndex(last_intrinsics_);
    }
    auto* dialog = new TargetCameraDialog(choices_, placeOfFiles(), this);
    dialog->showPage(TargetCameraDialog::Page::kCamera);
    dialog->show();
    connect(dialog, &TargetCameraDialog::cameraSaved, this, &ImportForm::useCamera);
    return;
  }
  if (intrinsics_->itemData(index) != kChooseFile) {
    const bool topic_before = intrinsics_->itemData(last_intrinsics_).toString().startsWith('/');
    const QString now = intrinsics_->itemData(index).toString();
    last_intrinsics_ = index;
    // Another CameraInfo must be read; a file is there already.
    if (now.startsWith('/') || topic_before) Q_EMIT topicsChanged();
    Q_EMIT boardChanged();
    return;
  }
  const QString path = choices_.camera_to_open(this, placeOfFiles());
  const QSignalBlocker quiet(intrinsics_);
  intrinsics_->setCurrentIndex(last_intrinsics_);
  if (!path.isEmpty()) useCamera(path);
}

void ImportForm::useCamera(const QString& path) {
  const auto camera = read_camera(path.toStdString());
  if (!camera) {
    camera_problem_ = core_text(camera.error());
    Q_EMIT changed();
    return;
  }
  camera_problem_.clear();
  camera_ = camera->camera;
  camera_path_ = path;
  fillIntrinsics(false);
  Q_EMIT boardChanged();
}

// Beside the recording.
QString ImportForm::placeOfFiles() const {
  return opened_ ? place_of(*opened_->recording).absolutePath() : QDir::homePath();
}

const std::optional<Target>& ImportForm::target() const {
  return board_->target();
}

ImportOptions ImportForm::options() const {
  ImportOptions out;
  out.topics.image = image_->currentText().toStdString();
  out.topics.cloud = cloud_->currentText().toStdString();
  const QString intrinsics = intrinsics_->currentData().toString();
  if (intrinsics == kCameraFile) {
    out.camera = camera_;
  } else if (intrinsics != kNoIntrinsics) {
    out.topics.info = intrinsics.toStdString();
  }
  out.still.min_still_s = least_->value();
  out.board_is_certain = board_->certain();
  out.force = replace_->isVisibleTo(this) && replace_->isChecked();
  return out;
}

QString ImportForm::folder() const {
  return QDir::fromNativeSeparators(folder_->text().trimmed());
}

QString ImportForm::problem() const {
  if (!board_->problem().isEmpty()) return board_->problem();
  if (!camera_problem_.isEmpty()) return camera_problem_;
  if (folder().isEmpty()) return tr("Choose a folder for the dataset.");
  return {};
}

// Beside the recording, under a name that is free.
QString ImportForm::suggestedFolder() const {
  const QFileInfo recording(QString::fromStdString(opened_->recording->path().string()));
  const QDir place = recording.absoluteDir();
  const QString stem = recording.isDir() ? recording.fileName() : recording.baseName();
  QString name = stem + QStringLiteral("-dataset");
  for (int i = 2; place.exists(name); ++i) name = QStringLiteral("%1-dataset-%2").arg(stem).arg(i);
  return QDir::toNativeSeparators(place.filePath(name));
}

void ImportForm::browseFolder() {
  const QString path = choices_.dataset_to_make(this, folder());
  if (!path.isEmpty()) folder_->setText(QDir::toNativeSeparators(path));
}

void ImportForm::checkFolder() {
  replace_->setVisible(QFileInfo(QDir(folder()).filePath(QStringLiteral("import.json"))).isFile());
  Q_EMIT changed();
}

void ImportForm::retranslate() {
  const QString names[] = {tr("&Images:"), tr("C&louds:"),           tr("I&ntrinsics:"),
                           tr("&Board:"),  tr("Shortest &stretch:"), tr("&Dataset folder:")};
  for (int row = 0; row < 6; ++row) labels_[row]->setText(names[row]);
  browse_->setText(tr("B&rowse…"));
  replace_->setText(tr("Re&place the earlier import"));
  least_->setSuffix(tr(" s"));
  least_->setToolTip(tr("Stretches in which everything stands still for less give no scene"));
  intrinsics_->setToolTip(tr("CameraInfo of the recording, or a camera.yaml"));
  if (!opened_) return;
  fillIntrinsics(true);
}

}  // namespace lvcalib::widgets

#include "moc_import_form.cpp"
