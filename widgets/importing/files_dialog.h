// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <optional>

#include "dialogs/choices.h"
#include "runner/files_work.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace lvcalib::widgets {

class BoardChoice;
class ImportFoot;
class ImportWarnings;

/// From folders of images and clouds to a dataset: which belong together, which become scenes.
class FilesDialog : public QDialog {
  Q_OBJECT

 public:
  /// `choices` must outlive this; `recent`: datasets whose boards are offered.
  FilesDialog(Choices& choices, const QStringList& recent, QWidget* parent = nullptr);
  ~FilesDialog() override;

  /// Looks through a folder.
  void openFolder(const QString& folder);
  [[nodiscard]] bool busy() const { return work_.busy(); }
  /// Where and how it looks for pairs, and the names of those that it has found.
  [[nodiscard]] PairOptions pairOptions() const;
  [[nodiscard]] QStringList foundNames() const;

 Q_SIGNALS:
  /// The dataset is complete and can be opened.
  void imported(const QString& dataset, const lvcalib::PairImportSummary& summary);

 private:
  void build();
  void connectParts();
  void retranslate();
  void fillCameras(bool keep);
  void chooseCamera(int index);
  void useCamera(const QString& path);
  void look();
  void takeFound(const PairedFiles& files);
  void takeImported(const PairImportSummary& summary, const QString& dataset);
  void showPictures();
  void showPicture(int pair, const QImage& thumbnail, bool checked, const Message& complaint);
  void showRow(QTreeWidgetItem* item);
  void startImport();
  void refresh();
  void checkFolder();
  [[nodiscard]] std::optional<Camera> camera() const;
  [[nodiscard]] QString imagesFolder() const;
  [[nodiscard]] QString datasetFolder() const;
  [[nodiscard]] QString summaryText() const;

  struct Seen {
    bool checked = false;
    Message complaint;
  };
  Choices& choices_;
  std::optional<PairedFiles> files_;
  std::vector<Seen> seen_;
  std::optional<Error> error_;
  std::optional<Camera> camera_;  // From a file.
  QString camera_path_;
  int last_camera_ = 0;

  QLabel* labels_[7];
  QLineEdit* images_;
  QPushButton* browse_images_;
  QLineEdit* clouds_;
  QPushButton* browse_clouds_;
  QComboBox* rule_;
  QDoubleSpinBox* apart_;
  QComboBox* cameras_;
  BoardChoice* board_;
  QLineEdit* dataset_;
  QPushButton* browse_dataset_;
  QCheckBox* replace_;
  QLabel* layout_text_;
  ImportWarnings* warnings_;
  QTreeWidget* pairs_;
  ImportFoot* foot_;
  FilesWork work_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
