// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QListWidget>
#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace lvcalib::widgets {

/// Warnings about what was recorded, each with its mark; hidden while there are none.
class ImportWarnings : public QListWidget {
  Q_OBJECT

 public:
  explicit ImportWarnings(QWidget* parent = nullptr);
  void setWarnings(const QStringList& warnings);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void showMarks();
};

/// What stands below both ways to a dataset, from a recording and from files: what is in the way,
/// how far the work is, how many scenes come of it, and the buttons that start and stop it.
class ImportFoot : public QWidget {
  Q_OBJECT

 public:
  explicit ImportFoot(QWidget* parent = nullptr);

  /// What is in the way; if nothing is, the note.
  void setProblem(const QString& problem);
  /// That the dataset lies there, but cannot be opened yet for want of intrinsics.
  void noteWithoutCamera(const QString& dataset);
  void setCount(const QString& count);
  /// Whether the import can start.
  void setReady(bool ready);
  /// `again`: where nothing is under way, the button that stops it offers to look again.
  void setBusy(bool busy, bool again = false);
  /// New work begins: nothing of it is done, and no note is left of the last.
  void begin(const QString& text = {});
  void setProgress(double fraction, const QString& text);

 Q_SIGNALS:
  void importWanted();
  /// The work is to stop, or to be done again.
  void stopWanted();
  void closeWanted();

 private:
  void retranslate();

  bool again_ = false;
  QString note_;
  QLabel* problem_;
  QProgressBar* progress_;
  QLabel* progress_text_;
  QPushButton* stop_;
  QLabel* count_;
  QPushButton* import_;
  QPushButton* close_;
};

}  // namespace lvcalib::widgets
