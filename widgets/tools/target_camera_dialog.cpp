// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/target_camera_dialog.h"

#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTabWidget>
#include <QVBoxLayout>

#include "base/file_io.h"
#include "style/texts.h"
#include "tools/camera_form.h"
#include "tools/target_form.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

// What is read of a file to be edited; the core's readers take no more either.
constexpr std::size_t kMostBytes = 4U << 20U;

}  // namespace

TargetCameraDialog::TargetCameraDialog(Choices& choices, const QString& folder, QWidget* parent)
    : QDialog(parent),
      choices_(choices),
      folder_(folder),
      tabs_(new QTabWidget(this)),
      target_(new TargetForm(this)),
      camera_(new CameraForm(this)),
      place_(new QLabel(this)),
      problem_(new QLabel(this)),
      open_(new QPushButton(this)),
      save_(new QPushButton(this)),
      save_as_(new QPushButton(this)),
      close_(new QPushButton(this)) {
  setObjectName(QStringLiteral("target_camera_dialog"));
  setAttribute(Qt::WA_DeleteOnClose);
  resize(900, 640);
  const std::pair<QWidget*, const char*> named[] = {
      {tabs_, "target_camera_tabs"},       {place_, "target_camera_file"},
      {problem_, "target_camera_problem"}, {open_, "target_camera_open"},
      {save_, "target_camera_save"},       {save_as_, "target_camera_save_as"}};
  for (const auto& [widget, name] : named) widget->setObjectName(QString::fromLatin1(name));
  tabs_->addTab(target_, QString());
  tabs_->addTab(camera_, QString());
  problem_->setWordWrap(true);
  for (QLabel* text : {place_, problem_}) {
    text->setTextFormat(Qt::PlainText);
    text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  place_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  for (QPushButton* button : {open_, save_as_, close_}) button->setAutoDefault(false);
  save_->setDefault(true);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(open_);
  buttons->addWidget(place_, 1);
  buttons->addWidget(save_);
  buttons->addWidget(save_as_);
  buttons->addWidget(close_);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(tabs_, 1);
  layout->addWidget(problem_);
  layout->addLayout(buttons);

  const QString target = QDir(folder).filePath(QStringLiteral("target.yaml"));
  const QString camera = QDir(folder).filePath(QStringLiteral("camera.yaml"));
  if (QFileInfo(target).isFile()) openTarget(target);
  if (QFileInfo(camera).isFile()) openCamera(camera);
  connect(tabs_, &QTabWidget::currentChanged, this, &TargetCameraDialog::refresh);
  const auto changed = [this](int which) {
    if (textOf(which) != files_[which].text) {
      files_[which].written.clear();
      files_[which].error.reset();
    }
    refresh();
  };
  connect(target_, &TargetForm::edited, this, [changed] { changed(0); });
  connect(camera_, &CameraForm::edited, this, [changed] { changed(1); });
  connect(open_, &QPushButton::clicked, this, &TargetCameraDialog::browse);
  connect(save_, &QPushButton::clicked, this, [this] { save(false); });
  connect(save_as_, &QPushButton::clicked, this, [this] { save(true); });
  connect(close_, &QPushButton::clicked, this, &QDialog::close);
  follow_language(this, [this] { retranslate(); });
  for (int which : {0, 1}) files_[which].text = textOf(which);
  refresh();
}

std::string TargetCameraDialog::textOf(int which) const {
  return which == 0 ? target_->text() : camera_->text();
}

bool TargetCameraDialog::onTarget() const {
  return tabs_->currentIndex() == 0;
}

void TargetCameraDialog::showPage(Page page) {
  tabs_->setCurrentIndex(page == Page::kTarget ? 0 : 1);
}

void TargetCameraDialog::openTarget(const QString& path) {
  File f{path, {}, {}, {}};
  const auto read = read_target(path.toStdString());
  const auto text = read_text_file(path.toStdString(), kMostBytes);
  if (!read) {
    f = files_[0];
    f.error = read.error();
  } else if (!text) {
    f = files_[0];
    f.error = text.error();
  } else {
    target_->setText(*text);
    f.text = textOf(0);
    if (!read->warnings.empty()) f.written = core_text(read->warnings.front());
  }
  files_[0] = f;
  refresh();
}

void TargetCameraDialog::openCamera(const QString& path) {
  File f{path, {}, {}, {}};
  const auto read = read_camera(path.toStdString());
  if (!read) {
    f = files_[1];
    f.error = read.error();
  } else {
    const auto deviations = read_camera_deviations(path.toStdString(), read->camera);
    camera_->setCamera(read->camera, deviations ? *deviations : std::nullopt);
    f.text = textOf(1);
    if (!deviations) f.error = deviations.error();
    if (!read->warnings.empty()) f.written = core_text(read->warnings.front());
  }
  files_[1] = f;
  refresh();
}

void TargetCameraDialog::browse() {
  const QString folder = file().path.isEmpty() ? folder_ : QFileInfo(file().path).absolutePath();
  const bool target = onTarget();
  const QString path =
      target ? choices_.target_to_open(this, folder) : choices_.camera_to_open(this, folder);
  if (path.isEmpty()) return;
  target ? openTarget(path) : openCamera(path);
}

void TargetCameraDialog::save(bool ask) {
  File& f = file();
  QString path = f.path;
  if (ask || path.isEmpty()) {
    const QString name = onTarget() ? QStringLiteral("target.yaml") : QStringLiteral("camera.yaml");
    path = choices_.file_to_export(this, path.isEmpty() ? QDir(folder_).filePath(name) : path,
                                   tr("YAML (*.yaml *.yml)"));
    if (path.isEmpty()) return;
    if (QFileInfo(path).suffix().isEmpty()) path += QStringLiteral(".yaml");
  }
  const std::string text = textOf(onTarget() ? 0 : 1);
  if (Status s = write_file_atomically(path.toStdString(), text); !s) {
    f.error = s.error();
    refresh();
    return;
  }
  f = {path, text, tr("Written: %1").arg(QDir::toNativeSeparators(path)), {}};
  refresh();
  if (onTarget()) {
    Q_EMIT targetSaved(path);
  } else {
    Q_EMIT cameraSaved(path);
  }
}

void TargetCameraDialog::refresh() {
  const File& f = file();
  QString place = f.path.isEmpty() ? tr("Not saved yet") : QDir::toNativeSeparators(f.path);
  const bool changed = textOf(onTarget() ? 0 : 1) != f.text;
  if (changed && !f.path.isEmpty()) place = tr("%1 (changed)").arg(place);
  place_->setText(place);
  place_->setToolTip(place);
  QString text = f.error ? core_text(*f.error) : f.written;
  if (f.error && !text.isEmpty()) text[0] = text[0].toUpper();
  problem_->setText(text);
  problem_->setVisible(!text.isEmpty());
  const bool sound = onTarget() ? target_->target().has_value() : camera_->camera().has_value();
  save_->setEnabled(sound && (changed || f.path.isEmpty()));
  save_as_->setEnabled(sound);
}

void TargetCameraDialog::retranslate() {
  setWindowTitle(tr("Target and camera"));
  tabs_->setTabText(0, tr("Target"));
  tabs_->setTabText(1, tr("Camera"));
  open_->setText(tr("&Open…"));
  save_->setText(tr("&Save"));
  save_as_->setText(tr("Save &as…"));
  close_->setText(tr("Close"));
  refresh();
}

}  // namespace lvcalib::widgets

#include "moc_target_camera_dialog.cpp"
