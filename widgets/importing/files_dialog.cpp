// SPDX-License-Identifier: GPL-3.0-or-later
#include "importing/files_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "importing/board_choice.h"
#include "importing/import_foot.h"
#include "style/marks.h"
#include "style/texts.h"
#include "tools/target_camera_dialog.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

enum PairColumn { kPairScene, kPairImage, kPairCloud, kPairApart, kPairBoard, kPairColumns };

// Items of the cameras' box that are no file.
const QString kFound = QStringLiteral("found");
const QString kNone = QStringLiteral("none");
const QString kFile = QStringLiteral("file:");
const QString kChoose = QStringLiteral("choose");
const QString kMake = QStringLiteral("make");

QString file_name(const std::filesystem::path& path) {
  return QString::fromStdString(path.filename().string());
}

}  // namespace

FilesDialog::FilesDialog(Choices& choices, const QStringList& recent, QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      images_(new QLineEdit(this)),
      browse_images_(new QPushButton(this)),
      clouds_(new QLineEdit(this)),
      browse_clouds_(new QPushButton(this)),
      rule_(new QComboBox(this)),
      apart_(new QDoubleSpinBox(this)),
      cameras_(new QComboBox(this)),
      board_(new BoardChoice(choices, recent, this)),
      dataset_(new QLineEdit(this)),
      browse_dataset_(new QPushButton(this)),
      replace_(new QCheckBox(this)),
      layout_text_(new QLabel(this)),
      warnings_(new ImportWarnings(this)),
      pairs_(new QTreeWidget(this)),
      foot_(new ImportFoot(this)) {
  setObjectName(QStringLiteral("files_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  build();
  connectParts();
  follow_language(this, [this] { retranslate(); });
  refresh();
}

FilesDialog::~FilesDialog() {
  // They change while they go.
  for (QObject* part : std::initializer_list<QObject*>{pairs_, board_, cameras_, &work_})
    part->disconnect(this);
}

void FilesDialog::build() {
  resize(980, 680);
  const std::pair<QWidget*, const char*> named[] = {
      {images_, "images_folder"},  {clouds_, "clouds_folder"},     {rule_, "pair_rule"},
      {apart_, "most_apart"},      {cameras_, "files_camera"},     {dataset_, "files_dataset"},
      {replace_, "files_replace"}, {layout_text_, "files_layout"}, {pairs_, "pairs"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  for (int i = 0; i < 3; ++i) rule_->addItem(QString(), i);
  apart_->setRange(0.0, 3600.0);
  apart_->setDecimals(3);
  apart_->setSingleStep(0.01);
  cameras_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  cameras_->setMinimumContentsLength(18);
  replace_->hide();
  pairs_->setColumnCount(kPairColumns);
  pairs_->setRootIsDecorated(false);
  pairs_->setUniformRowHeights(true);
  pairs_->setAllColumnsShowFocus(true);
  pairs_->setIconSize(QSize(84, 56));
  pairs_->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  pairs_->header()->setStretchLastSection(true);
  layout_text_->setWordWrap(true);
  layout_text_->setTextFormat(Qt::PlainText);
  layout_text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  for (QPushButton* button : {browse_images_, browse_clouds_, browse_dataset_})
    button->setAutoDefault(false);

  // Two columns of fields: where the files are, and what becomes of them.
  auto* form = new QGridLayout;
  QWidget* const fields[] = {images_, clouds_, rule_, apart_, cameras_, board_, dataset_};
  QPushButton* const browse[] = {browse_images_, browse_clouds_, nullptr,        nullptr,
                                 nullptr,        nullptr,        browse_dataset_};
  for (int i = 0; i < 7; ++i) {
    const int row = i < 4 ? i : i - 4;
    const int column = i < 4 ? 0 : 3;
    labels_[i] = new QLabel(this);
    labels_[i]->setBuddy(fields[i]);
    form->addWidget(labels_[i], row, column);
    form->addWidget(fields[i], row, column + 1, 1, browse[i] == nullptr ? 2 : 1);
    if (browse[i] != nullptr) form->addWidget(browse[i], row, column + 2);
  }
  form->addWidget(replace_, 3, 4, 1, 2);
  form->setColumnStretch(1, 1);
  form->setColumnStretch(4, 1);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(warnings_);
  layout->addWidget(layout_text_);
  layout->addWidget(pairs_, 1);
  layout->addWidget(foot_);
}

void FilesDialog::connectParts() {
  const auto browse = [this](QLineEdit* line) {
    const QString path = choices_.clouds_to_open(this, imagesFolder());
    if (path.isEmpty()) return;
    line->setText(QDir::toNativeSeparators(path));
    look();
  };
  connect(browse_images_, &QPushButton::clicked, this, [this, browse] { browse(images_); });
  connect(browse_clouds_, &QPushButton::clicked, this, [this, browse] { browse(clouds_); });
  connect(browse_dataset_, &QPushButton::clicked, this, [this] {
    const QString path = choices_.dataset_to_make(this, datasetFolder());
    if (!path.isEmpty()) dataset_->setText(QDir::toNativeSeparators(path));
  });
  for (QLineEdit* line : {images_, clouds_})
    connect(line, &QLineEdit::editingFinished, this, [this, line] {
      if (line->isModified()) look();
      line->setModified(false);
    });
  connect(rule_, &QComboBox::currentIndexChanged, this, &FilesDialog::look);
  connect(apart_, &QDoubleSpinBox::valueChanged, this, &FilesDialog::look);
  connect(cameras_, &QComboBox::currentIndexChanged, this, &FilesDialog::chooseCamera);
  connect(board_, &BoardChoice::boardChanged, this, &FilesDialog::showPictures);
  connect(dataset_, &QLineEdit::textChanged, this, &FilesDialog::checkFolder);
  connect(replace_, &QCheckBox::toggled, this, &FilesDialog::refresh);
  connect(pairs_, &QTreeWidget::itemChanged, this, &FilesDialog::refresh);
  connect(foot_, &ImportFoot::stopWanted, this, [this] { work_.cancel(); });
  connect(foot_, &ImportFoot::importWanted, this, &FilesDialog::startImport);
  connect(foot_, &ImportFoot::closeWanted, this, &QDialog::close);
  connect(this, &QDialog::finished, this, [this] { work_.cancel(); });
  connect(&work_, &FilesWork::found, this, &FilesDialog::takeFound);
  connect(&work_, &FilesWork::pictured, this, &FilesDialog::showPicture);
  connect(&work_, &FilesWork::imported, this, &FilesDialog::takeImported);
  connect(&work_, &FilesWork::failed, this, [this](const Error& error) {
    error_ = error;
    refresh();
  });
  connect(&work_, &FilesWork::cancelled, this, &FilesDialog::refresh);
  connect(&work_, &FilesWork::progressed, foot_, &ImportFoot::setProgress);
}

void FilesDialog::openFolder(const QString& folder) {
  images_->setText(QDir::toNativeSeparators(folder));
  clouds_->clear();
  camera_.reset();
  camera_path_.clear();
  board_->setPlace(folder);
  // Beside the folder, under a name that is free.
  const QFileInfo info(folder);
  const QDir place = info.absoluteDir();
  QString name = info.fileName() + QStringLiteral("-dataset");
  for (int i = 2; place.exists(name); ++i)
    name = QStringLiteral("%1-dataset-%2").arg(info.fileName()).arg(i);
  dataset_->setText(QDir::toNativeSeparators(place.filePath(name)));
  look();
}

QString FilesDialog::imagesFolder() const {
  return QDir::fromNativeSeparators(images_->text().trimmed());
}

QString FilesDialog::datasetFolder() const {
  return QDir::fromNativeSeparators(dataset_->text().trimmed());
}

PairOptions FilesDialog::pairOptions() const {
  PairOptions options;
  options.images = imagesFolder().toStdString();
  options.clouds = QDir::fromNativeSeparators(clouds_->text().trimmed()).toStdString();
  options.rule = static_cast<PairRule>(rule_->currentIndex());
  options.most_apart_s = apart_->value();
  return options;
}

QStringList FilesDialog::foundNames() const {
  QStringList names;
  if (!files_) return names;
  for (const FilePair& pair : files_->pairs) names << QString::fromStdString(pair.name);
  return names;
}

void FilesDialog::look() {
  files_.reset();
  error_.reset();
  const PairOptions options = pairOptions();
  {
    const QSignalBlocker quiet(pairs_);
    pairs_->clear();
  }
  foot_->begin();
  if (!options.images.empty()) work_.find(options);
  refresh();
}

void FilesDialog::takeFound(const PairedFiles& files) {
  files_ = files;
  seen_.assign(files.pairs.size(), {});
  {
    const QSignalBlocker quiet(pairs_);
    pairs_->clear();
    for (const FilePair& pair : files.pairs) {
      auto* item = new QTreeWidgetItem(pairs_);
      item->setFlags(Qt::ItemIsSelectable | Qt::ItemIsEnabled | Qt::ItemIsUserCheckable);
      item->setCheckState(kPairScene, Qt::Checked);
      item->setText(kPairScene, QString::fromStdString(pair.name));
      item->setText(kPairImage, file_name(pair.image));
      item->setText(kPairCloud, file_name(pair.cloud));
      item->setToolTip(kPairImage, QString::fromStdString(pair.image.string()));
      item->setToolTip(kPairCloud, QString::fromStdString(pair.cloud.string()));
      if (pair.apart_s)
        item->setText(kPairApart, QStringLiteral("%1 ms").arg(1e3 * *pair.apart_s, 0, 'f', 1));
    }
  }
  fillCameras(false);
  showPictures();
}

std::optional<Camera> FilesDialog::camera() const {
  const QString chosen = cameras_->currentData().toString();
  if (chosen == kFile) return camera_;
  return chosen == kFound && files_ ? files_->camera : std::nullopt;
}

void FilesDialog::fillCameras(bool keep) {
  const QSignalBlocker quiet(cameras_);
  const QVariant before = cameras_->currentData();
  cameras_->clear();
  if (files_ && files_->camera)
    cameras_->addItem(QString::fromStdString(files_->camera_from), kFound);
  if (camera_) cameras_->addItem(QDir::toNativeSeparators(camera_path_), kFile);
  if (!files_ || !files_->camera) cameras_->addItem(tr("none yet"), kNone);
  cameras_->addItem(tr("Choose a camera file…"), kChoose);
  cameras_->addItem(tr("Make a camera.yaml…"), kMake);
  int index = camera_ ? cameras_->findData(kFile) : 0;
  if (keep && cameras_->findData(before) >= 0) index = cameras_->findData(before);
  cameras_->setCurrentIndex(std::max(0, index));
  last_camera_ = cameras_->currentIndex();
}

void FilesDialog::chooseCamera(int index) {
  const QString chosen = cameras_->itemData(index).toString();
  if (chosen != kChoose && chosen != kMake) {
    last_camera_ = index;
    showPictures();
    return;
  }
  {
    const QSignalBlocker quiet(cameras_);
    cameras_->setCurrentIndex(last_camera_);
  }
  if (chosen == kMake) {
    auto* dialog = new TargetCameraDialog(choices_, imagesFolder(), this);
    connect(dialog, &TargetCameraDialog::cameraSaved, this, &FilesDialog::useCamera);
    dialog->showPage(TargetCameraDialog::Page::kCamera);
    dialog->show();
    return;
  }
  const QString path = choices_.camera_to_open(this, imagesFolder());
  if (!path.isEmpty()) useCamera(path);
}

void FilesDialog::useCamera(const QString& path) {
  const auto file = read_camera(path.toStdString());
  if (!file) {
    error_ = file.error();
    refresh();
    return;
  }
  error_.reset();
  camera_ = file->camera;
  camera_path_ = path;
  fillCameras(false);
  showPictures();
}

void FilesDialog::showPictures() {
  for (Seen& seen : seen_) seen = {};
  if (files_) work_.show_pictures(files_->pairs, board_->target(), camera());
  const QSignalBlocker quiet(pairs_);
  for (int i = 0; i < pairs_->topLevelItemCount(); ++i) showRow(pairs_->topLevelItem(i));
  refresh();
}

void FilesDialog::showPicture(int pair, const QImage& thumbnail, bool checked,
                              const Message& complaint) {
  QTreeWidgetItem* item = pairs_->topLevelItem(pair);
  if (item == nullptr) return;
  seen_[static_cast<std::size_t>(pair)] = {checked, complaint};
  {
    const QSignalBlocker quiet(pairs_);
    item->setIcon(kPairScene, QIcon(QPixmap::fromImage(thumbnail)));
    showRow(item);
  }
  refresh();
}

void FilesDialog::showRow(QTreeWidgetItem* item) {
  const Seen& seen = seen_[static_cast<std::size_t>(pairs_->indexOfTopLevelItem(item))];
  const QString complaint = core_text(seen.complaint);
  item->setText(kPairBoard, !seen.checked            ? QString()
                            : seen.complaint.empty() ? tr("seen")
                                                     : tr("not seen: %1").arg(complaint));
  item->setToolTip(kPairBoard, item->text(kPairBoard));
  item->setData(kPairBoard, Qt::DecorationRole, {});
  if (!seen.checked) return;
  const QIcon mark = mark_icon(seen.complaint.empty() ? Mark::kGood : Mark::kDoubtful, palette());
  item->setData(kPairBoard, Qt::DecorationRole, mark.pixmap(QSize(16, 16), devicePixelRatioF()));
}

void FilesDialog::startImport() {
  if (!files_ || !board_->target()) return;
  PairedFiles wanted = *files_;
  wanted.pairs.clear();
  for (int i = 0; i < pairs_->topLevelItemCount(); ++i) {
    if (pairs_->topLevelItem(i)->checkState(kPairScene) == Qt::Checked)
      wanted.pairs.push_back(files_->pairs[static_cast<std::size_t>(i)]);
  }
  PairImportOptions options;
  options.camera = camera();
  options.board_is_certain = board_->certain();
  options.force = replace_->isVisibleTo(this) && replace_->isChecked();
  error_.reset();
  foot_->begin();
  work_.import(wanted, *board_->target(), options, datasetFolder());
  refresh();
}

void FilesDialog::takeImported(const PairImportSummary& summary, const QString& dataset) {
  if (!summary.has_camera) {
    foot_->noteWithoutCamera(dataset);
    refresh();
    return;
  }
  Q_EMIT imported(dataset, summary);
  close();
}

void FilesDialog::checkFolder() {
  replace_->setVisible(
      QFileInfo(QDir(datasetFolder()).filePath(QStringLiteral("import.json"))).isFile());
  refresh();
}

QString FilesDialog::summaryText() const {
  if (!files_) return {};
  QString text;
  switch (files_->layout) {
    case FileLayout::kSameName:
      text = tr("Matched by their names");
      break;
    case FileLayout::kSameNumber:
      text = tr("Matched by the numbers in their names");
      break;
    case FileLayout::kNearestTime:
      text = tr("Matched by the times that are their names");
      break;
    case FileLayout::kKittiRaw:
    case FileLayout::kCamLidarCalibration:
    case FileLayout::kDirectVisual:
    case FileLayout::kFastCalib:
      text = tr("Files of %1").arg(QString::fromStdString(name_of(files_->layout)));
      break;
  }
  if (!files_->unmatched.empty())
    text += QStringLiteral("; ") +
            tr("without a partner: %1").arg(static_cast<int>(files_->unmatched.size()));
  return text;
}

void FilesDialog::refresh() {
  const bool busy = work_.busy();
  foot_->setBusy(busy);
  layout_text_->setText(summaryText());
  QStringList unmatched;
  if (files_) {
    for (const UnmatchedFile& file : files_->unmatched) unmatched << core_text(file.sentence());
  }
  layout_text_->setToolTip(unmatched.join(QLatin1Char('\n')));
  QStringList warnings;
  if (files_) {
    for (const Message& warning : files_->warnings) warnings << core_text(warning);
  }
  warnings_->setWarnings(warnings);
  int ticked = 0;
  int expected = 0;
  for (int i = 0; i < pairs_->topLevelItemCount(); ++i) {
    if (pairs_->topLevelItem(i)->checkState(kPairScene) != Qt::Checked) continue;
    ++ticked;
    if (seen_[static_cast<std::size_t>(i)].complaint.empty()) ++expected;
  }
  QString problem = error_ ? core_text(*error_) : board_->problem();
  if (problem.isEmpty() && !busy && !files_)
    problem = tr("Choose the folder that holds the images, or all files.");
  if (problem.isEmpty() && files_ && ticked == 0)
    problem = tr("Tick the pairs that are to become scenes.");
  if (problem.isEmpty() && datasetFolder().isEmpty())
    problem = tr("Choose a folder for the dataset.");
  foot_->setProblem(problem);
  foot_->setCount(files_
                      ? tr("%1 of %2 pairs become scenes").arg(expected).arg(files_->pairs.size())
                      : QString());
  foot_->setReady(files_ && ticked > 0 && !busy && board_->target() && !datasetFolder().isEmpty());
}

void FilesDialog::retranslate() {
  setWindowTitle(tr("New from files"));
  const QString names[] = {tr("I&mages in:"),     tr("C&louds in:"),  tr("Matched &by:"),
                           tr("At most a&part:"), tr("I&ntrinsics:"), tr("Boa&rd:"),
                           tr("&Dataset folder:")};
  for (int i = 0; i < 7; ++i) labels_[i]->setText(names[i]);
  browse_images_->setText(tr("B&rowse…"));
  browse_clouds_->setText(tr("Br&owse…"));
  browse_dataset_->setText(tr("Bro&wse…"));
  images_->setToolTip(
      tr("A folder of images, or one that holds all: of KITTI raw, cam_lidar_calibration, "
         "direct_visual_lidar_calibration, FAST-Calib, or two folders"));
  clouds_->setPlaceholderText(tr("the same folder, or one in it"));
  const QString rules[] = {tr("their names, or else their times"), tr("their names"),
                           tr("the times that are their names")};
  for (int i = 0; i < 3; ++i) rule_->setItemText(i, rules[i]);
  apart_->setSuffix(tr(" s"));
  apart_->setSpecialValueText(tr("half of the usual time between two"));
  apart_->setToolTip(tr("Files whose times differ by more do not belong together"));
  cameras_->setToolTip(tr("Intrinsics that lie with the files, or a camera.yaml"));
  replace_->setText(tr("Replace the earlier import"));
  pairs_->setHeaderLabels({tr("Scene"), tr("Image"), tr("Cloud"), tr("Apart"), tr("Board")});
  fillCameras(true);
  const QSignalBlocker quiet(pairs_);
  for (int i = 0; i < pairs_->topLevelItemCount(); ++i) showRow(pairs_->topLevelItem(i));
  refresh();
}

}  // namespace lvcalib::widgets

#include "moc_files_dialog.cpp"
