// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/export_pane.h"

#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QFontDatabase>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "pipeline/calibration.h"
#include "pipeline/dataset.h"
#include "report/colored_cloud.h"
#include "style/texts.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

ExportPane::ExportPane(ExportInput input, Choices& choices, QString folder, QWidget* parent)
    : QWidget(parent), input_(std::move(input)), choices_(choices), folder_(std::move(folder)) {
  auto* layout = new QHBoxLayout(this);
  auto* splitter = new QSplitter(Qt::Horizontal, this);
  splitter->setChildrenCollapsible(false);
  splitter->addWidget(createList());
  splitter->addWidget(createPreview());
  splitter->setStretchFactor(1, 1);
  splitter->setSizes({170, 500});
  layout->setContentsMargins(0, 4, 0, 0);
  layout->addWidget(splitter);
  connect(formats_, &QListWidget::currentRowChanged, this, &ExportPane::preview);
  connect(&runner_, &Runner::finished, this, &ExportPane::preview);
  connect(&runner_, &Runner::failed, this, [this](quint64, const QString& message) {
    Q_EMIT failed(Runner::unexpected(message));
    preview();
  });
  follow_language(this, [this] { retranslate(); });
  formats_->setCurrentRow(0);
}

void ExportPane::retranslate() {
  formats_->setAccessibleName(tr("Formats"));
  for (int row = 0; row < formats_->count(); ++row) {
    const ExportFormat& format = export_formats()[static_cast<std::size_t>(row)];
    formats_->item(row)->setToolTip(core_text(Message::listed(format.description)));
  }
  text_->setAccessibleName(tr("Preview"));
  imu_->setToolTip(
      tr("A YAML file with T_imu_lidar, which takes a LiDAR point to the IMU frame: a matrix, or "
         "translation_m and quaternion_xyzw"));
  frames_->setText(tr("Frames:"));
  lidar_->setToolTip(tr("What the LiDAR's frame is called in exports"));
  lidar_->setAccessibleName(tr("LiDAR frame"));
  camera_->setToolTip(tr("What the camera's frame is called in exports"));
  camera_->setAccessibleName(tr("Camera frame"));
  scene_->setToolTip(tr("The scene whose cloud is written"));
  copy_->setText(tr("Copy"));
  save_->setText(tr("Save…"));
  preview();
}

QWidget* ExportPane::createList() {
  formats_ = new QListWidget(this);
  formats_->setObjectName(QStringLiteral("formats"));
  for (const ExportFormat& format : export_formats())
    formats_->addItem(QString::fromStdString(format.name));
  return formats_;
}

QWidget* ExportPane::createPreview() {
  auto* page = new QWidget(this);
  about_ = new QLabel(page);
  about_->setObjectName(QStringLiteral("format_about"));
  about_->setWordWrap(true);
  text_ = new QPlainTextEdit(page);
  text_->setObjectName(QStringLiteral("preview"));
  text_->setReadOnly(true);
  text_->setTabChangesFocus(true);
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  imu_ = new QPushButton(QStringLiteral("T_imu_lidar…"), page);
  imu_->setObjectName(QStringLiteral("choose_imu"));
  copy_ = new QPushButton(page);
  copy_->setObjectName(QStringLiteral("copy_export"));
  save_ = new QPushButton(page);
  save_->setObjectName(QStringLiteral("save_export"));
  connect(imu_, &QPushButton::clicked, this, &ExportPane::readImu);
  connect(copy_, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(text_->toPlainText()); });
  connect(save_, &QPushButton::clicked, this, &ExportPane::save);
  auto* buttons = new QHBoxLayout;
  scene_ = new QComboBox(page);
  scene_->setObjectName(QStringLiteral("export_scene"));
  fillScenes();
  buttons->addWidget(imu_);
  buttons->addWidget(scene_);
  buttons->addStretch(1);
  buttons->addWidget(copy_);
  buttons->addWidget(save_);
  frames_ = new QLabel(page);
  lidar_ = new QLineEdit(page);
  lidar_->setObjectName(QStringLiteral("lidar_frame"));
  camera_ = new QLineEdit(page);
  camera_->setObjectName(QStringLiteral("camera_frame"));
  lidar_->setText(QString::fromStdString(input_.lidar_frame));
  camera_->setText(QString::fromStdString(input_.camera_frame));
  auto* names = new QHBoxLayout;
  names->addWidget(frames_);
  for (QLineEdit* field : {lidar_, camera_}) {
    names->addWidget(field, 1);
    connect(field, &QLineEdit::textEdited, this, &ExportPane::takeFrameNames);
  }
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(about_);
  layout->addLayout(names);
  layout->addWidget(text_, 1);
  layout->addLayout(buttons);
  return page;
}

void ExportPane::fillScenes() {
  const QString before = scene_->currentText();
  scene_->clear();
  for (const ExportScene& scene : input_.scenes) {
    if (!scene.cloud.empty() && !scene.image.empty())
      scene_->addItem(QString::fromStdString(scene.name));
  }
  scene_->setCurrentIndex(std::max(0, scene_->findText(before)));
}

void ExportPane::setInput(ExportInput input) {
  input.lidar_frame = std::move(input_.lidar_frame);
  input.camera_frame = std::move(input_.camera_frame);
  if (input_.imu_from_lidar) input.imu_from_lidar = input_.imu_from_lidar;
  input_ = std::move(input);
  fillScenes();
  preview();
}

void ExportPane::chooseFormat(const QString& name) {
  const auto found = formats_->findItems(name, Qt::MatchExactly);
  if (!found.isEmpty()) formats_->setCurrentItem(found.first());
}

void ExportPane::preview() {
  const int row = formats_->currentRow();
  if (row < 0) return;
  const ExportFormat& format = export_formats()[static_cast<std::size_t>(row)];
  const bool lacks_imu = format.needs_imu && !input_.imu_from_lidar;
  const auto text =
      lacks_imu ? Result<std::string>(std::string()) : export_result(input_, format.name);
  QString about = core_text(Message::listed(format.description));
  if (lacks_imu) {
    about += QLatin1Char('\n') + tr("Needs T_imu_lidar: choose the YAML file that holds it.");
  } else if (!text) {
    about += QLatin1Char('\n') + core_text(text.error());
  }
  const bool usable = text.ok() && !lacks_imu;
  about_->setText(about);
  text_->setPlainText(usable ? QString::fromStdString(*text) : QString());
  imu_->setVisible(format.needs_imu);
  scene_->setVisible(format.is_cloud);
  copy_->setEnabled(usable && !format.is_cloud);
  save_->setEnabled(usable && !runner_.running() && (!format.is_cloud || scene_->count() > 0));
}

void ExportPane::setFrameNames(const QString& lidar, const QString& camera) {
  lidar_->setText(lidar);
  camera_->setText(camera);
  takeFrameNames();
}

void ExportPane::takeFrameNames() {
  input_.lidar_frame = lidar_->text().toStdString();
  input_.camera_frame = camera_->text().toStdString();
  preview();
  if (check_frame_name(input_.lidar_frame) && check_frame_name(input_.camera_frame))
    Q_EMIT frameNamesChanged(lidar_->text(), camera_->text());
}

void ExportPane::readImu() {
  const QString path = choices_.transform_to_open(this, folder_);
  if (path.isEmpty()) return;
  auto imu = read_transform(path.toStdString(), "T_imu_lidar");
  if (!imu) {
    Q_EMIT failed(imu.error());
    return;
  }
  input_.imu_from_lidar = *imu;
  preview();
}

void ExportPane::save() {
  if (input_.quality == name_of(Quality::kFailed) && !choices_.hand_on_failed(this)) return;
  const ExportFormat& format = export_formats()[static_cast<std::size_t>(formats_->currentRow())];
  if (format.write_files != nullptr) {
    const QString folder =
        choices_.dataset_to_make(this, QDir(folder_).filePath(QString::fromStdString(format.name)));
    if (folder.isEmpty()) return;
    const Status status = write_export(input_, format.name, folder.toStdString());
    if (status) {
      Q_EMIT exported(folder);
    } else {
      Q_EMIT failed(status.error());
    }
    return;
  }
  const QString name = QString::fromStdString(format.name + "." + format.suffix);
  const QString path = choices_.file_to_export(
      this, QDir(folder_).filePath(name),
      tr("%1 (*.%2);;All files (*)")
          .arg(formats_->currentItem()->text(), QString::fromStdString(format.suffix)));
  if (path.isEmpty()) return;
  if (format.is_cloud) return saveCloud(path);
  // The format's own text: what the preview shows may have other ends of lines.
  const Status status = write_export(input_, format.name, path.toStdString());
  if (status) {
    Q_EMIT exported(path);
  } else {
    Q_EMIT failed(status.error());
  }
}

// Reads the scene's image and cloud, which takes a moment.
void ExportPane::saveCloud(const QString& path) {
  runner_.start([this, input = input_, scene = scene_->currentText().toStdString(), path](
                    const RunContext& context, const Runner::Post&) -> Runner::Deliver {
    const auto written = write_colored_ply(input, scene, path.toStdString(), context);
    if (written) return [this, path] { Q_EMIT exported(path); };
    if (written.error().kind == ErrorKind::kCancelled) return {};
    return [this, error = written.error()] { Q_EMIT failed(error); };
  });
  preview();
}

}  // namespace lvcalib::widgets

#include "moc_export_pane.cpp"
