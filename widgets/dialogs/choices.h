// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QStringList>

class QWidget;

namespace lvcalib::widgets {

/// What the user answers to unsaved decisions.
enum class UnsavedAnswer { kSave, kDiscard, kCancel };

/// Questions that stop the application until they are answered. Virtual, so that tests (and
/// scripts) answer in the user's place. An empty path means: cancelled.
class Choices {
 public:
  Choices() = default;
  Choices(const Choices&) = delete;
  Choices& operator=(const Choices&) = delete;
  virtual ~Choices() = default;

  virtual QString dataset_to_open(QWidget* parent, const QString& folder);
  virtual QString project_to_open(QWidget* parent, const QString& folder);
  /// `suggestion`: path of the project so far, or a good new one.
  virtual QString project_to_save(QWidget* parent, const QString& suggestion);
  /// Images of the board.
  virtual QStringList images_to_add(QWidget* parent, const QString& folder);
  virtual QStringList scenes_to_add(QWidget* parent, const QString& folder);
  virtual QString file_to_export(QWidget* parent, const QString& suggestion, const QString& filter);
  /// A YAML file with T_imu_lidar.
  virtual QString transform_to_open(QWidget* parent, const QString& folder);
  /// A recording's file; of a rosbag2 folder its metadata.yaml.
  virtual QString recording_to_open(QWidget* parent, const QString& folder);
  /// A folder of images and clouds.
  virtual QString files_to_import(QWidget* parent, const QString& folder);
  /// A folder of images of the board, or a dataset.
  virtual QString camera_images_to_open(QWidget* parent, const QString& folder);
  virtual QString target_to_open(QWidget* parent, const QString& folder);
  virtual QString camera_to_open(QWidget* parent, const QString& folder);
  /// The description of a LiDAR.
  virtual QString lidar_to_open(QWidget* parent, const QString& folder);
  /// A folder that need not exist yet.
  virtual QString dataset_to_make(QWidget* parent, const QString& suggestion);
  virtual QString cloud_to_open(QWidget* parent, const QString& folder);
  /// A folder of clouds.
  virtual QString clouds_to_open(QWidget* parent, const QString& folder);
  /// A cloud's file, or the folder for several.
  virtual QString clouds_to_save(QWidget* parent, const QString& suggestion);
  /// A result.json or result.yaml, or the truth of a simulation.
  virtual QString result_to_open(QWidget* parent, const QString& folder);
  virtual UnsavedAnswer unsaved(QWidget* parent, const QString& name);
  /// A project's dataset is not at `old_path`: where is it now?
  virtual QString moved_dataset(QWidget* parent, const QString& old_path);
  /// Decisions about `dataset` were not saved when the program last ended: take them up again?
  virtual bool recover(QWidget* parent, const QString& dataset);
  /// The result has failed: hand its pose on all the same?
  virtual bool hand_on_failed(QWidget* parent);
};

}  // namespace lvcalib::widgets
