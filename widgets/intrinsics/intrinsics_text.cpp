// SPDX-License-Identifier: GPL-3.0-or-later
#include "intrinsics/intrinsics_text.h"

#include <array>
#include <cmath>

#include "modelling/model_text.h"
#include "pages/page_tr.h"
#include "style/html.h"
#include "style/theme.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr std::array kPinholeNames = {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
constexpr std::array kFisheyeNames = {"k1", "k2", "k3", "k4"};

// One camera of the table, with its standard deviations; below zero: not known.
struct Column {
  QString title;
  const Camera* camera = nullptr;
  IntrinsicsVector sigma = IntrinsicsVector::Constant(-1.0);
};

std::vector<Column> columns_of(const CameraKnowledge& known) {
  std::vector<Column> out;
  if (known.given != nullptr) {
    Column column{tr("given"), known.given, {}};
    column.sigma.setConstant(-1.0);
    if (known.stated != nullptr) column.sigma = *known.stated;
    out.push_back(column);
  }
  if (known.result != nullptr && known.result->intrinsics.mode != IntrinsicsMode::kFixed)
    out.push_back({tr("with the LiDAR"), &known.result->camera, known.result->intrinsics.sigma});
  if (known.alone != nullptr)
    out.push_back({tr("images alone"), &known.alone->camera, known.alone->sigma});
  return out;
}

QString distortion_name(DistortionModel model, int k) {
  const auto at = static_cast<std::size_t>(k);
  return QString::fromLatin1(model == DistortionModel::kEquidistant ? kFisheyeNames.at(at)
                                                                    : kPinholeNames.at(at));
}

// "1234.56 ± 0.12": as many decimals as the standard deviation has a meaning for.
QString value_cell(double value, double sigma, int decimals) {
  if (sigma > 0.0) {
    decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 6);
    return QStringLiteral("%1 ± %2").arg(value, 0, 'f', decimals).arg(sigma, 0, 'f', decimals);
  }
  return QString::number(value, 'f', decimals);
}

QString row_of(const QString& name, const std::vector<Column>& columns, Eigen::Index entry,
               DistortionModel model) {
  QStringList cells = {name};
  for (const Column& column : columns) {
    const bool distortion = entry >= 4;
    const bool has = !distortion || (column.camera->model == model &&
                                     entry - 4 < column.camera->distortion_count());
    cells << (has ? value_cell(intrinsics_of(*column.camera)(entry), column.sigma(entry),
                               distortion ? 6 : 2)
                  : QString());
  }
  return html_row(cells);
}

QString doubt(const QString& text, const QPalette& palette) {
  return QStringLiteral("<p style='color:%1'>%2</p>")
      .arg(state_colors(palette).doubtful.name(), text.toHtmlEscaped());
}

QString paragraph(const QString& text) {
  return html_paragraph(text.toHtmlEscaped());
}

QString unreached(const CameraFigures& figures, const QPalette& palette) {
  if (figures.unreached.empty()) return {};
  QStringList parts;
  for (const Message& part : figures.unreached) parts << core_text(part);
  return doubt(tr("No board reached these parts of the image: %1. The distortion there is "
                  "extrapolated.")
                   .arg(parts.join(QStringLiteral(", "))),
               palette);
}

QString reach(const CameraFigures& figures) {
  const auto reach = figures.projection.reach_px();
  if (!reach) return {};
  return paragraph(tr("A direction falls into the image with a standard deviation of %1 px where "
                      "it is best to %2 px where it is worst.")
                       .arg(reach->first, 0, 'f', 3)
                       .arg(reach->second, 0, 'f', 3));
}

QString mode_text(const IntrinsicsReport& report) {
  switch (report.mode) {
    case IntrinsicsMode::kFixed:
      return tr("The intrinsics are taken as given; the scenes check them.");
    case IntrinsicsMode::kPrior:
      return report.stated
                 ? tr("The intrinsics are estimated with the extrinsic, and drawn to the given "
                      "ones as the standard deviations in camera.yaml say.")
                 : tr("The intrinsics are estimated with the extrinsic, and drawn to the given "
                      "ones as an ordinary calibration deserves.");
    default:
      return tr("The intrinsics are estimated with the extrinsic, by these images alone.");
  }
}

}  // namespace

QString intrinsics_table(const CameraKnowledge& known) {
  const std::vector<Column> columns = columns_of(known);
  if (columns.empty()) return {};
  QStringList titles = {QString()};
  QStringList models = {tr("model")};
  for (const Column& column : columns) {
    titles << column.title;
    models << QString::fromStdString(name_of(column.camera->model));
  }
  QString out = "<table>" + html_row(titles, "th") + html_row(models);
  const std::array names = {tr("fx, px"), tr("fy, px"), tr("cx, px"), tr("cy, px")};
  for (Eigen::Index k = 0; k < 4; ++k)
    out += row_of(names[static_cast<std::size_t>(k)], columns, k, columns.front().camera->model);
  // The entries of each model once, in the order of the columns.
  std::vector<DistortionModel> told;
  for (const Column& column : columns) {
    const DistortionModel model = column.camera->model;
    if (std::find(told.begin(), told.end(), model) != told.end()) continue;
    told.push_back(model);
    for (int k = 0; k < column.camera->distortion_count(); ++k)
      out += row_of(distortion_name(model, k), columns, 4 + k, model);
  }
  return out + "</table>";
}

QString camera_verdict(const CalibrationResult& result, const CameraFigures& figures,
                       const QPalette& palette) {
  const IntrinsicsReport& report = result.intrinsics;
  QString out = paragraph(mode_text(report));
  if (report.contradiction) {
    const IntrinsicsContradiction& found = *report.contradiction;
    QString text = tr("The images contradict the given intrinsics: %1.").arg(core_text(found.what));
    if (found.camera_from_lidar)
      text +=
          QLatin1Char(' ') + (found.better_model ? tr("With it the extrinsic moves by %1.")
                                                 : tr("With that freed the extrinsic moves by %1."))
                                 .arg(move_text(found.move_mm, found.move_mrad));
    out += doubt(text, palette);
  }
  if (!report.spacing.empty())
    out +=
        doubt(tr("The images contradict target.yaml: %1.").arg(core_text(report.spacing)), palette);
  if (!result.verified && !result.unverified.empty())
    out += doubt(core_text(result.unverified), palette);
  return out + reach(figures) + unreached(figures, palette);
}

QString camera_verdict(const CameraCalibration& calibration, const CameraFigures& figures,
                       const QPalette& palette) {
  QString out = paragraph(tr("%1 of %2 images, %3 px RMS; noise of a corner %4 px.")
                              .arg(calibration.used_images())
                              .arg(calibration.images.size())
                              .arg(calibration.rms_px, 0, 'f', 3)
                              .arg(calibration.noise_px, 0, 'f', 3));
  QStringList models;
  for (const ModelPrediction& prediction : calibration.predictions) {
    if (prediction.held_out_px > 0.0)
      models << QStringLiteral("%1 %2 px")
                    .arg(QString::fromStdString(name_of(prediction.model)))
                    .arg(prediction.held_out_px, 0, 'f', 3);
  }
  if (!models.isEmpty())
    out += paragraph(tr("Distortion models by the images that they were not fitted to: %1.")
                         .arg(models.join(QStringLiteral(", "))));
  out += reach(figures);
  for (const Message& warning : calibration.warnings) out += doubt(core_text(warning), palette);
  return out;
}

}  // namespace lvcalib::widgets
