// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/results_dialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QDir>
#include <QFontDatabase>
#include <QGuiApplication>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabWidget>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "base/file_io.h"
#include "base/roll_pitch_yaw.h"
#include "base/units.h"
#include "dialogs/export_pane.h"
#include "report/exports.h"
#include "report/result_file.h"
#include "report/stored_model.h"
#include "style/texts.h"
#include "style/theme.h"
#include "words/core_text.h"
#include "words/total_note.h"

namespace lvcalib::widgets {
namespace {

QString row(const QString& title, const QStringList& values, const QString& unit) {
  QString out = QStringLiteral("<tr><td>%1&nbsp;&nbsp;</td>").arg(title);
  for (const QString& value : values)
    out += QStringLiteral("<td align='right'>&nbsp;%1</td>").arg(value);
  for (qsizetype i = values.size(); i < 4; ++i) out += QStringLiteral("<td></td>");
  return out + QStringLiteral("<td>&nbsp;%1</td></tr>").arg(unit);
}

QStringList numbers(const Eigen::Ref<const Eigen::VectorXd>& values, int decimals) {
  QStringList out;
  for (const double value : values)
    out << (std::isfinite(value) ? QString::number(value, 'f', decimals) : QStringLiteral("∞"));
  return out;
}

QString pose_table(const CalibrationResult& result) {
  const UncertainRigid3& pose = result.extrinsic.camera_from_lidar;
  const UncertainRigid3 total{pose.transform, result.covariance_total};
  const Vector6d sigma = pose.covariance.diagonal().cwiseSqrt();
  const Vector6d sigma_total = total.covariance.diagonal().cwiseSqrt();
  const RollPitchYaw angles = roll_pitch_yaw(pose);
  const QString in_total = ResultsDialog::tr("± in total");
  QString out = QStringLiteral("<table cellpadding='2'>");
  out += row(ResultsDialog::tr("Translation x y z"), numbers(1e3 * pose.transform.translation, 3),
             QStringLiteral("mm"));
  out += row(ResultsDialog::tr("± one standard deviation"), numbers(1e3 * sigma.head<3>(), 3),
             QStringLiteral("mm"));
  out += row(in_total, numbers(1e3 * sigma_total.head<3>(), 3), QStringLiteral("mm"));
  out += row(ResultsDialog::tr("Quaternion x y z w"), numbers(pose.transform.rotation.coeffs(), 7),
             QString());
  out += row(ResultsDialog::tr("Roll, pitch, yaw"), numbers(kDegPerRad * angles.angles_rad, 4),
             QStringLiteral("°"));
  out += row(ResultsDialog::tr("± one standard deviation"),
             numbers(kDegPerRad * angles.sigmas_rad, 4), QStringLiteral("°"));
  out +=
      row(in_total, numbers(kDegPerRad * roll_pitch_yaw(total).sigmas_rad, 4), QStringLiteral("°"));
  out += row(ResultsDialog::tr("Rotation about camera x y z, ± σ"),
             numbers(1e3 * sigma.tail<3>(), 3), QStringLiteral("mrad"));
  out += row(in_total, numbers(1e3 * sigma_total.tail<3>(), 3), QStringLiteral("mrad"));
  return out + QStringLiteral("</table>");
}

QString list(const std::vector<Message>& lines) {
  QString out = QStringLiteral("<ul>");
  for (const Message& line : lines)
    out += QStringLiteral("<li>%1</li>").arg(warning_text(line).toHtmlEscaped());
  return out + QStringLiteral("</ul>");
}

QString quality_line(const CalibrationResult& result, const Standing& standing) {
  const ToldQuality told = told_quality(result, standing);
  const QColor color = color_of(told, QGuiApplication::palette());
  QString line =
      QStringLiteral("<h2 style='color:%1'>%2</h2>")
          .arg(color.name(), ResultsDialog::tr("Quality: %1").arg(told.words).toHtmlEscaped());
  if (!result.quality_reason.empty()) {
    line += QStringLiteral("<p>%1</p>").arg(core_text(result.quality_reason).toHtmlEscaped());
  }
  return line;
}

}  // namespace

QString matrix_text(const CalibrationResult& result) {
  const Eigen::Matrix4d m = result.extrinsic.camera_from_lidar.transform.matrix();
  QString out;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) out += QStringLiteral("%1").arg(m(r, c), c == 0 ? 12 : 13, 'f', 8);
    out += QLatin1Char('\n');
  }
  return out;
}

QString results_html(const CalibrationResult& result, const Standing& standing) {
  const ExtrinsicSolution& x = result.extrinsic;
  QString out = quality_line(result, standing);
  out += QStringLiteral("<p>%1</p>")
             .arg(ResultsDialog::tr(
                      "T_camera_lidar from %1 of %2 scenes; %3 px at the tag corners, %4 mm at "
                      "the LiDAR nodes (root mean square).")
                      .arg(x.used_scenes)
                      .arg(result.scenes.size())
                      .arg(x.rms_px, 0, 'f', 3)
                      .arg(x.rms_mm, 0, 'f', 3));
  const PoseUse use = pose_use(result);
  out += QStringLiteral("<p><b>%1</b> %2<br>%3</p>")
             .arg(ResultsDialog::tr("Model:").toHtmlEscaped(), core_text(use.model).toHtmlEscaped(),
                  core_text(use.clouds).toHtmlEscaped());
  out += pose_table(result);
  out += QStringLiteral("<p>%1</p>").arg(total_note(result).toHtmlEscaped());
  if (!x.weak_directions.empty()) {
    out += QStringLiteral("<h3>%1</h3>").arg(ResultsDialog::tr("Weakly determined"));
    out += list(x.weak_directions);
  }
  out += QStringLiteral("<h3>%1</h3>").arg(ResultsDialog::tr("Warnings"));
  out += result.warnings.empty() ? QStringLiteral("<p>%1</p>").arg(ResultsDialog::tr("None."))
                                 : list(result.warnings);
  return out;
}

void ResultsDialog::set_frame_names(const QString& lidar, const QString& camera) {
  exports_->setFrameNames(lidar, camera);
}

ResultsDialog::ResultsDialog(std::shared_ptr<const CalibrationResult> result, Choices& choices,
                             QString folder, QWidget* parent)
    : QDialog(parent), result_(std::move(result)), choices_(choices), folder_(std::move(folder)) {
  setAttribute(Qt::WA_DeleteOnClose);
  setObjectName(QStringLiteral("results_dialog"));
  resize(800, 660);
  auto* tabs = new QTabWidget(this);
  tabs->setObjectName(QStringLiteral("results_tabs"));
  tabs->setDocumentMode(true);
  tabs->addTab(create_pose(), {});
  exports_ = new ExportPane(export_input_of(*result_), choices_, folder_, tabs);
  connect(exports_, &ExportPane::exported, this, &ResultsDialog::exported);
  connect(exports_, &ExportPane::failed, this, &ResultsDialog::failed);
  connect(exports_, &ExportPane::frameNamesChanged, this,
          [this](const QString& lidar, const QString& camera) {
            frames_ = {lidar.toStdString(), camera.toStdString()};
            Q_EMIT frame_names_changed(lidar, camera);
          });
  tabs->addTab(exports_, {});
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  const auto add = [&](const char* name) {
    QPushButton* button = buttons->addButton(QString(), QDialogButtonBox::ActionRole);
    button->setObjectName(QString::fromLatin1(name));
    return button;
  };
  QPushButton* copy = add("copy");
  QPushButton* yaml = add("export_yaml");
  QPushButton* json = add("export_json");
  connect(copy, &QPushButton::clicked, this,
          [this] { QGuiApplication::clipboard()->setText(matrix_text(*result_)); });
  connect(yaml, &QPushButton::clicked, this, [this] {
    export_file(QStringLiteral("yaml"), tr("YAML (*.yaml)"), result_as_yaml(*result_, frames_));
  });
  connect(json, &QPushButton::clicked, this, [this] {
    export_file(QStringLiteral("json"), tr("JSON (*.json)"), result_as_json(*result_, frames_));
  });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(tabs, 1);
  layout->addWidget(buttons);
  follow_language(this, [this, tabs, copy, yaml, json] {
    setWindowTitle(tr("Results"));
    tabs->setTabText(0, tr("Pose"));
    tabs->setTabText(1, tr("For other tools"));
    copy->setText(tr("Copy matrix"));
    yaml->setText(tr("Export YAML…"));
    json->setText(tr("Export JSON…"));
  });
}

void ResultsDialog::set_result(std::shared_ptr<const CalibrationResult> result,
                               const Standing& standing) {
  if (result == result_ && standing == standing_) return;
  const bool another = result != result_;
  result_ = std::move(result);
  standing_ = standing;
  fill_pose();
  if (another) exports_->setInput(export_input_of(*result_));
}

void ResultsDialog::fill_pose() {
  text_->setHtml(results_html(*result_, standing_));
  matrix_->setPlainText(matrix_text(*result_));
}

QWidget* ResultsDialog::create_pose() {
  auto* page = new QWidget(this);
  text_ = new QTextBrowser(page);
  text_->setObjectName(QStringLiteral("results"));
  matrix_ = new QPlainTextEdit(page);
  matrix_->setObjectName(QStringLiteral("matrix"));
  matrix_->setReadOnly(true);
  matrix_->setLineWrapMode(QPlainTextEdit::NoWrap);
  matrix_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  matrix_->setFixedHeight(6 * matrix_->fontMetrics().lineSpacing());
  follow_language(page, [this] {
    fill_pose();
    matrix_->setToolTip(
        tr("Takes a point from the LiDAR frame to the camera frame (x right, y down, "
           "z forward); lengths in metres"));
  });
  matrix_->setTabChangesFocus(true);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 4, 0, 0);
  layout->addWidget(text_, 1);
  layout->addWidget(matrix_);
  return page;
}

void ResultsDialog::export_file(const QString& suffix, const QString& filter,
                                const std::string& text) {
  const QString suggestion = QDir(folder_).filePath(QStringLiteral("result.") + suffix);
  QString path = choices_.file_to_export(this, suggestion, filter);
  if (path.isEmpty()) return;
  if (!path.contains(QLatin1Char('.'))) path += QLatin1Char('.') + suffix;
  if (Status s = write_file_atomically(path.toStdString(), text); !s) {
    Q_EMIT failed(s.error());
    return;
  }
  Q_EMIT exported(path);
}

}  // namespace lvcalib::widgets

#include "moc_results_dialog.cpp"
