// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QByteArray>
#include <QImage>
#include <QObject>
#include <QString>
#include <functional>

#include "base/error.h"

class QMenu;
class QPaintDevice;
class QWidget;

namespace lvcalib::widgets {

/// How a view turns into files. A function that is not set is not offered.
struct Figure {
  QString name;  ///< Suggested file name without suffix.
  std::function<QImage()> image;
  std::function<QByteArray()> pdf;
  std::function<QByteArray()> csv;  ///< UTF-8, comma separated, one header line with units.
};

/// Asks where to save; an empty answer means no. Takes the suggested file name and a filter like
/// "PNG image (*.png)". Tests replace it.
using FileChooser = std::function<QString(QWidget*, const QString&, const QString&)>;

/// A picture as a one-page PDF of its own size.
QByteArray image_as_pdf(const QImage& image);

/// "Save as PNG/PDF/CSV…" for a view: a menu, and the saving behind it. Files are written
/// atomically.
class FigureActions : public QObject {
  Q_OBJECT

 public:
  /// The view is the parent. `figure` is asked when something is saved, not before.
  FigureActions(QWidget* view, Figure figure);

  void setFileChooser(FileChooser chooser) { chooser_ = std::move(chooser); }
  void setName(const QString& name) { figure_.name = name; }

  /// Adds the actions to a menu.
  void addTo(QMenu* menu);

  /// Saves by the file's suffix: png, pdf or csv. Errors: kOutput; kUsage for another suffix.
  [[nodiscard]] Status save(const QString& path) const;

 Q_SIGNALS:
  /// What went wrong when a menu's save failed, for the user.
  void failed(const QString& message);

 private:
  void choose(const QString& suffix, const QString& filter);

  QWidget* view_;
  Figure figure_;
  FileChooser chooser_;
};

}  // namespace lvcalib::widgets
