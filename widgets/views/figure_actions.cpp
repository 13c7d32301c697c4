// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/figure_actions.h"

#include <QBuffer>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QPageLayout>
#include <QPainter>
#include <QPdfWriter>
#include <QPointer>

#include "base/file_io.h"
#include "words/core_text.h"

namespace lvcalib::widgets {

QByteArray image_as_pdf(const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  constexpr int kDotsPerInch = 144;
  writer.setResolution(kDotsPerInch);
  const QSizeF points = QSizeF(image.size()) * 72.0 / kDotsPerInch;
  writer.setPageSize(QPageSize(points, QPageSize::Point));
  writer.setPageMargins(QMarginsF(0, 0, 0, 0));
  QPainter painter(&writer);
  painter.drawImage(QRectF(0, 0, writer.width(), writer.height()), image);
  painter.end();
  return bytes;
}

FigureActions::FigureActions(QWidget* view, Figure figure)
    : QObject(view), view_(view), figure_(std::move(figure)) {
  chooser_ = [](QWidget* parent, const QString& suggested, const QString& filter) {
    return QFileDialog::getSaveFileName(parent, tr("Save figure"), suggested, filter);
  };
}

void FigureActions::addTo(QMenu* menu) {
  if (figure_.image) {
    menu->addAction(tr("Save as PNG…"), this, [this] { choose("png", tr("PNG image (*.png)")); });
  }
  if (figure_.pdf) {
    menu->addAction(tr("Save as PDF…"), this, [this] { choose("pdf", tr("PDF (*.pdf)")); });
  }
  if (figure_.csv) {
    menu->addAction(tr("Save data as CSV…"), this,
                    [this] { choose("csv", tr("Comma-separated values (*.csv)")); });
  }
}

void FigureActions::choose(const QString& suffix, const QString& filter) {
  // The figure may go while the user looks for a place.
  const QPointer<FigureActions> self(this);
  QString path = chooser_(view_->window(), figure_.name + "." + suffix, filter);
  if (self == nullptr || path.isEmpty()) return;
  if (QFileInfo(path).suffix().toLower() != suffix) path += "." + suffix;
  if (const Status saved = save(path); !saved) {
    Q_EMIT failed(core_text(saved.error()));
  }
}

Status FigureActions::save(const QString& path) const {
  const QString suffix = QFileInfo(path).suffix().toLower();
  QByteArray bytes;
  if (suffix == "png" && figure_.image) {
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    figure_.image().save(&buffer, "PNG");
  } else if (suffix == "pdf" && figure_.pdf) {
    bytes = figure_.pdf();
  } else if (suffix == "csv" && figure_.csv) {
    bytes = figure_.csv();
  } else {
    return Error::usage(Message("figures cannot be saved as '%1'", suffix.toStdString()),
                        path.toStdString(), Message("use a name that ends in .png, .pdf or .csv"));
  }
  if (bytes.isEmpty()) {
    return Error::output(Message("there is nothing in this figure to save"), path.toStdString());
  }
  return write_file_atomically(path.toStdString(),
                               {bytes.constData(), static_cast<std::size_t>(bytes.size())});
}

}  // namespace lvcalib::widgets

#include "moc_figure_actions.cpp"
