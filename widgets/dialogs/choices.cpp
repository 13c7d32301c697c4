// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/choices.h"

#include <QAbstractItemView>
#include <QCoreApplication>
#include <QFileDialog>
#include <QMessageBox>
#include <QPushButton>

namespace lvcalib::widgets {
namespace {

QString words(const char* text) {
  return QCoreApplication::translate("Choices", text);
}

QString project_filter() {
  return words(QT_TRANSLATE_NOOP("Choices", "Projects (*.lvcalib)"));
}

}  // namespace

QString Choices::dataset_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getExistingDirectory(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a dataset folder")), folder);
}

QString Choices::project_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(parent, words(QT_TRANSLATE_NOOP("Choices", "Open a project")),
                                      folder, project_filter());
}

QString Choices::project_to_save(QWidget* parent, const QString& suggestion) {
  QString path =
      QFileDialog::getSaveFileName(parent, words(QT_TRANSLATE_NOOP("Choices", "Save the project")),
                                   suggestion, project_filter());
  if (!path.isEmpty() && !path.endsWith(QLatin1String(".lvcalib")))
    path += QLatin1String(".lvcalib");
  return path;
}

QStringList Choices::scenes_to_add(QWidget* parent, const QString& folder) {
  QFileDialog dialog(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Add scene folders (image and cloud each)")),
      folder);
  dialog.setFileMode(QFileDialog::Directory);
  // The systems' own dialogs let one choose a single folder only.
  dialog.setOption(QFileDialog::DontUseNativeDialog);
  for (QAbstractItemView* view : dialog.findChildren<QAbstractItemView*>()) {
    if (view->objectName() == QLatin1String("listView") ||
        view->objectName() == QLatin1String("treeView"))
      view->setSelectionMode(QAbstractItemView::ExtendedSelection);
  }
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles() : QStringList();
}

QString Choices::file_to_export(QWidget* parent, const QString& suggestion, const QString& filter) {
  return QFileDialog::getSaveFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Export the result")), suggestion, filter);
}

QString Choices::transform_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a file with T_imu_lidar")), folder,
      words(QT_TRANSLATE_NOOP("Choices", "YAML (*.yaml *.yml)")));
}

QString Choices::recording_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a recording")), folder,
      words(QT_TRANSLATE_NOOP(
          "Choices",
          "Recordings (*.bag *.mcap *.db3 metadata.yaml *.zstd *.zst *.lz4);;All files (*)")));
}

QString Choices::target_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a description of the board")), folder,
      words(QT_TRANSLATE_NOOP("Choices", "YAML (*.yaml *.yml)")));
}

QStringList Choices::images_to_add(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileNames(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Add images of the board")), folder,
      words(QT_TRANSLATE_NOOP("Choices", "Images (*.png *.jpg *.jpeg *.bmp *.tif *.tiff)")));
}

QString Choices::camera_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a camera file")), folder,
      words(QT_TRANSLATE_NOOP("Choices", "YAML (*.yaml *.yml)")));
}

QString Choices::lidar_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open the description of a LiDAR")), folder,
      words(QT_TRANSLATE_NOOP("Choices", "YAML (*.yaml *.yml)")));
}

QString Choices::dataset_to_make(QWidget* parent, const QString& suggestion) {
  return QFileDialog::getSaveFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Folder of the new dataset")), suggestion, {},
      nullptr, QFileDialog::ShowDirsOnly | QFileDialog::DontConfirmOverwrite);
}

QString Choices::cloud_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(parent, words(QT_TRANSLATE_NOOP("Choices", "Open a cloud")),
                                      folder,
                                      words(QT_TRANSLATE_NOOP("Choices", "Clouds (*.pcd *.ply)")));
}

QString Choices::clouds_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getExistingDirectory(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a folder of clouds")), folder);
}

QString Choices::files_to_import(QWidget* parent, const QString& folder) {
  return QFileDialog::getExistingDirectory(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a folder of images and clouds")), folder);
}

QString Choices::camera_images_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getExistingDirectory(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Open a folder of images of the board")), folder);
}

QString Choices::clouds_to_save(QWidget* parent, const QString& suggestion) {
  return QFileDialog::getSaveFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Place of the corrected clouds")), suggestion, {},
      nullptr, QFileDialog::DontConfirmOverwrite);
}

QString Choices::result_to_open(QWidget* parent, const QString& folder) {
  return QFileDialog::getOpenFileName(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Compare with")), folder,
      words(QT_TRANSLATE_NOOP("Choices", "Results and truths (*.json *.yaml)")));
}

UnsavedAnswer Choices::unsaved(QWidget* parent, const QString& name) {
  const auto answer = QMessageBox::question(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Unsaved decisions")),
      words(QT_TRANSLATE_NOOP("Choices", "Save your decisions about %1?")).arg(name),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
  if (answer == QMessageBox::Save) return UnsavedAnswer::kSave;
  return answer == QMessageBox::Discard ? UnsavedAnswer::kDiscard : UnsavedAnswer::kCancel;
}

QString Choices::moved_dataset(QWidget* parent, const QString& old_path) {
  const auto answer = QMessageBox::question(
      parent, words(QT_TRANSLATE_NOOP("Choices", "Dataset not found")),
      words(QT_TRANSLATE_NOOP("Choices",
                              "The project's dataset is not at\n%1\nany more. Where is it now?"))
          .arg(old_path),
      QMessageBox::Open | QMessageBox::Cancel, QMessageBox::Open);
  return answer == QMessageBox::Open ? dataset_to_open(parent, old_path) : QString();
}

bool Choices::recover(QWidget* parent, const QString& dataset) {
  return QMessageBox::question(
             parent, words(QT_TRANSLATE_NOOP("Choices", "Unsaved decisions found")),
             words(QT_TRANSLATE_NOOP("Choices",
                                     "The program ended last time before your decisions about\n"
                                     "%1\nwere saved. Take them up again?"))
                 .arg(dataset),
             QMessageBox::Yes | QMessageBox::No, QMessageBox::Yes) == QMessageBox::Yes;
}

bool Choices::hand_on_failed(QWidget* parent) {
  QMessageBox box(QMessageBox::Warning,
                  words(QT_TRANSLATE_NOOP("Choices", "The result has failed")),
                  words(QT_TRANSLATE_NOOP("Choices",
                                          "This result has failed: it is not to be "
                                          "used, and its warnings say why.")),
                  QMessageBox::Cancel, parent);
  // What a button does stands on it: nobody exports by a hasty Yes.
  auto* all_the_same = box.addButton(words(QT_TRANSLATE_NOOP("Choices", "Export it all the same")),
                                     QMessageBox::AcceptRole);
  all_the_same->setObjectName(QStringLiteral("export_all_the_same"));
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == all_the_same;
}

}  // namespace lvcalib::widgets
