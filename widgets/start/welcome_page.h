// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>
#include <QWidget>

class QCommandLinkButton;
class QLabel;
class QListWidget;

namespace lvcalib::widgets {

/// What the window shows before anything is open.
class WelcomePage : public QWidget {
  Q_OBJECT

 public:
  explicit WelcomePage(QWidget* parent = nullptr);
  /// Datasets and projects, latest first; those that are gone are greyed.
  void set_recent(const QStringList& paths);

 Q_SIGNALS:
  void open_dataset_wanted();
  void open_project_wanted();
  void import_wanted();
  void import_files_wanted();
  void target_camera_wanted();
  void demo_wanted();
  void guide_wanted();
  void recent_wanted(const QString& path);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void retranslate();

  QLabel* title_;
  QLabel* purpose_;
  QCommandLinkButton* dataset_;
  QCommandLinkButton* project_;
  QCommandLinkButton* import_;
  QCommandLinkButton* import_files_;
  QCommandLinkButton* target_camera_;
  QCommandLinkButton* demo_;
  QCommandLinkButton* guide_;
  QLabel* recent_title_;
  QListWidget* recent_;
};

}  // namespace lvcalib::widgets
