// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsics/camera_dialog.h"

#include <QComboBox>
#include <QDir>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "intrinsics/camera_page.h"
#include "pipeline/dataset.h"
#include "style/texts.h"
#include "target/target.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr DistortionModel kModels[] = {DistortionModel::kPlumbBob, DistortionModel::kEquidistant,
                                       DistortionModel::kRationalPolynomial};

}  // namespace

CameraDialog::CameraDialog(Choices& choices, const QString& folder, QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      start_folder_(folder),
      labels_{new QLabel(this), new QLabel(this), new QLabel(this), new QLabel(this)},
      folder_(new QLineEdit(this)),
      choose_folder_(new QPushButton(this)),
      target_(new QLineEdit(this)),
      choose_target_(new QPushButton(this)),
      camera_(new QLineEdit(this)),
      choose_camera_(new QPushButton(this)),
      model_(new QComboBox(this)),
      text_(new QLabel(this)),
      page_(new CameraPage(this, CameraPage::Of::kPhotos)) {
  setObjectName(QStringLiteral("camera_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(1000, 680);
  const std::pair<QWidget*, const char*> named[] = {
      {folder_, "photos_folder"}, {choose_folder_, "photos_choose_folder"},
      {target_, "photos_target"}, {choose_target_, "photos_choose_target"},
      {camera_, "photos_camera"}, {choose_camera_, "photos_choose_camera"},
      {model_, "photos_model"},   {text_, "photos_text"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  model_->addItem(QString());
  for (const DistortionModel model : kModels)
    model_->addItem(QString::fromStdString(name_of(model)));
  auto* form = new QGridLayout;
  QWidget* const fields[] = {folder_, target_, camera_, model_};
  for (int row = 0; row < 4; ++row) {
    labels_[row]->setBuddy(fields[row]);
    form->addWidget(labels_[row], row, 0);
    form->addWidget(fields[row], row, 1);
  }
  form->addWidget(choose_folder_, 0, 2);
  form->addWidget(choose_target_, 1, 2);
  form->addWidget(choose_camera_, 2, 2);
  form->setColumnStretch(1, 1);
  page_->setChoices(choices_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(text_);
  layout->addWidget(page_, 1);
  connectParts();
  follow_language(this, [this] { retranslate(); });
}

CameraDialog::~CameraDialog() {
  runner_.disconnect(this);
}

bool CameraDialog::busy() const {
  return runner_.running() || page_->busy();
}

void CameraDialog::connectParts() {
  connect(choose_folder_, &QPushButton::clicked, this,
          [this] { take(folder_, choices_.camera_images_to_open(this, startFolder())); });
  connect(choose_target_, &QPushButton::clicked, this,
          [this] { take(target_, choices_.target_to_open(this, startFolder())); });
  connect(choose_camera_, &QPushButton::clicked, this,
          [this] { take(camera_, choices_.camera_to_open(this, startFolder())); });
  // Return in a field reads it, and is no click on the first button.
  for (QPushButton* button : findChildren<QPushButton*>()) button->setAutoDefault(false);
  for (QLineEdit* field : {folder_, target_, camera_})
    connect(field, &QLineEdit::editingFinished, this, [this, field] {
      if (!field->isModified()) return;
      field->setModified(false);
      read();
    });
  connect(model_, &QComboBox::currentIndexChanged, this, &CameraDialog::read);
  connect(page_, &CameraPage::failed, this, &CameraDialog::say);
  connect(page_, &CameraPage::saved, this, [this](const QString& path) {
    say(tr("Written: %1").arg(QDir::toNativeSeparators(path)));
    Q_EMIT cameraSaved(path);
  });
}

QString CameraDialog::startFolder() const {
  return folder_->text().isEmpty() ? start_folder_ : folder_->text();
}

void CameraDialog::take(QLineEdit* field, const QString& path) {
  if (path.isEmpty()) return;
  field->setText(QDir::toNativeSeparators(path));
  read();
}

void CameraDialog::read() {
  page_->setPhotos(std::nullopt);
  say({});
  if (folder_->text().isEmpty()) return;
  BoardPhotos wanted;
  wanted.folder = QDir::fromNativeSeparators(folder_->text()).toStdString();
  if (model_->currentIndex() > 0) wanted.options.model = kModels[model_->currentIndex() - 1];
  const std::filesystem::path target = QDir::fromNativeSeparators(target_->text()).toStdString();
  const std::filesystem::path camera = QDir::fromNativeSeparators(camera_->text()).toStdString();
  runner_.start([this, wanted, target, camera](const RunContext&,
                                               const Runner::Post&) mutable -> Runner::Deliver {
    const auto failed = [this](const Error& error) {
      return [this, error] { say(core_text(error)); };
    };
    const auto images = find_camera_images(wanted.folder);
    if (!images) return failed(images.error());
    const auto board = read_target(target.empty() ? images->target : target);
    if (!board) return failed(board.error());
    std::vector<Message> warnings = board->warnings;
    if (!camera.empty()) {
      const auto start = read_camera(camera);
      if (!start) return failed(start.error());
      wanted.options.start = start->camera;
      warnings.insert(warnings.end(), start->warnings.begin(), start->warnings.end());
    }
    wanted.images = images->images;
    wanted.target = board->target;
    return [this, wanted, warnings] {
      QStringList lines = {tr("%n images.", nullptr, static_cast<int>(wanted.images.size()))};
      for (const Message& warning : warnings) lines << core_text(warning);
      say(lines.join(QLatin1Char(' ')));
      page_->setPhotos(wanted);
    };
  });
}

void CameraDialog::say(const QString& text) {
  text_->setText(text);
}

void CameraDialog::retranslate() {
  setWindowTitle(tr("A camera from images of the board"));
  labels_[0]->setText(tr("&Images"));
  labels_[1]->setText(tr("&Board"));
  labels_[2]->setText(tr("&Start from"));
  labels_[3]->setText(tr("Distortion &model"));
  folder_->setPlaceholderText(tr("A folder of images of the board, or a dataset"));
  target_->setPlaceholderText(tr("target.yaml in that folder"));
  camera_->setPlaceholderText(tr("Nothing: all is found from the images"));
  camera_->setToolTip(
      tr("A camera.yaml that is about right, for images in which few corners are seen"));
  choose_folder_->setText(tr("&Folder…"));
  choose_target_->setText(tr("&target.yaml…"));
  choose_camera_->setText(tr("&camera.yaml…"));
  model_->setItemText(0, tr("the one that predicts held-out images best"));
}

}  // namespace lvcalib::widgets

#include "moc_camera_dialog.cpp"
