// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/methods_pane.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <algorithm>

#include "report/stored_model.h"
#include "style/fitting.h"
#include "style/texts.h"
#include "views/category_plots.h"
#include "words/core_text.h"

namespace lvcalib::widgets {
namespace {

constexpr int kMethodColumns = 8;

QString cell_text(double value, int decimals) {
  return QString::number(value, 'f', decimals);
}

QString cell_text(const std::optional<double>& value, int decimals) {
  return value ? cell_text(*value, decimals) : QStringLiteral("–");
}

double distance_mm(const MethodResult& method, const CalibrationResult& result) {
  return 1e3 * (method.camera_from_lidar.translation -
                result.extrinsic.camera_from_lidar.transform.translation)
                   .norm();
}

double distance_mrad(const MethodResult& method, const CalibrationResult& result) {
  return 1e3 * rotation_distance_rad(method.camera_from_lidar,
                                     result.extrinsic.camera_from_lidar.transform);
}

// By its pose: which method that is depends on whether every return could be solved for.
bool is_the_result(const MethodResult& method, const CalibrationResult& result) {
  constexpr double kSame = 1e-6;  // A nanometre: the same numbers but for rounding.
  return distance_mm(method, result) < kSame && distance_mrad(method, result) < kSame;
}

}  // namespace

QString method_title(const std::string& name) {
  const QString all = QString::fromStdString(name);
  if (name == "forward_model") return MethodsPane::tr("Every return");
  if (name == "joint_paper") return MethodsPane::tr("Joint, as in the paper");
  const QString method = all.section('_', 0, 0);
  const QString centers = all.section('_', 1);
  const QString title = method == "svd"     ? MethodsPane::tr("3D-SVD")
                        : method == "wsvd"  ? MethodsPane::tr("W-SVD")
                        : method == "pnp"   ? MethodsPane::tr("PnP")
                        : method == "joint" ? MethodsPane::tr("Joint")
                                            : QString();
  if (title.isEmpty()) return all;
  if (centers == "raw") return MethodsPane::tr("%1, raw").arg(title);
  return centers == "refined" ? MethodsPane::tr("%1, refined").arg(title) : all;
}

MethodsPane::MethodsPane(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 4, 0, 0);
  grid->setSpacing(4);
  message_ = new QLabel(this);
  message_->setObjectName("methods-message");
  message_->setWordWrap(true);
  table_ = new QTableWidget(0, kMethodColumns, this);
  table_->setObjectName("methods");
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 8);
  // Numbers share the room there is, under titles of some lines: nothing needs to be scrolled to.
  table_->horizontalHeader()->setMinimumSectionSize(30);
  keep_headings_whole(*table_);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignCenter |
                                                  static_cast<Qt::Alignment>(Qt::TextWordWrap));
  table_->horizontalHeader()->setHighlightSections(false);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setTabKeyNavigation(false);
  table_->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
  boxes_px_ = new BoxPlot(this);
  boxes_mm_ = new BoxPlot(this);
  for (BoxPlot* plot : {boxes_px_, boxes_mm_})
    connect(plot->figureActions(), &FigureActions::failed, this, &MethodsPane::failed);
  grid->addWidget(message_, 0, 0, 1, 2);
  grid->addWidget(table_, 1, 0, 1, 2);
  grid->addWidget(boxes_px_, 2, 0);
  grid->addWidget(boxes_mm_, 2, 1);
  grid->setRowStretch(2, 1);
  follow_language(this, [this] { retranslate(); });
  setResult(nullptr);
}

// What the result says is set again by whoever owns it.
void MethodsPane::retranslate() {
  const QStringList titles = {tr("Method, centres"),  tr("corners (px)"),      tr("nodes (mm)"),
                              tr("transfer (px)"),    tr("held out (px)"),     tr("held out (mm)"),
                              tr("from result (mm)"), tr("from result (mrad)")};
  const QStringList tips = {
      tr("How the extrinsic is found, and from which circle centres: as initialised (raw) or as "
         "refined"),
      tr("Root mean square of the corners' reprojection residuals"),
      tr("Root mean square of the residuals of the refined nodes"),
      tr("Corners predicted from the LiDAR alone against the corners found: an extrinsic's error "
         "undiminished by the board poses"),
      tr("Corners of scenes that the method has not seen"),
      tr("Nodes of scenes that the method has not seen"),
      tr("Distance of the LiDAR's origin to where the result has it"),
      tr("Rotation against the result")};
  table_->setAccessibleName(tr("Methods side by side"));
  table_->setHorizontalHeaderLabels(titles);
  for (int k = 0; k < kMethodColumns; ++k) table_->horizontalHeaderItem(k)->setToolTip(tips[k]);
  boxes_px_->setValueLabel(tr("corner residual (px)"), "method_residual_px");
  boxes_mm_->setValueLabel(tr("node residual (mm)"), "method_residual_mm");
  boxes_px_->setToolTip(
      tr("What each method leaves at the corners (px): median, quartiles, whiskers to 1.5 box "
         "lengths, circles beyond"));
  boxes_mm_->setToolTip(
      tr("What each method leaves at the refined nodes (mm): median, quartiles, whiskers to 1.5 "
         "box lengths, circles beyond"));
}

void MethodsPane::setResult(const CalibrationResult* result) {
  static const CalibrationResult nothing;
  const CalibrationResult& shown = result != nullptr ? *result : nothing;
  QString text;
  if (result == nullptr) {
    text = tr("Run the calibration to compare the methods.");
  } else if (shown.methods.empty()) {
    text = tr("There is no extrinsic to compare.");
  } else if (!shown.target.has_circles()) {
    text = tr("This board has no circles: there are no nodes for the other methods.");
  } else {
    text = tr("All methods measured alike; scenes: %1.").arg(shown.methods.front().scenes.size());
    text += ' ' + resultText(shown);
    if (!shown.methods.front().heldout_px)
      text += " " + tr("Not enough scenes for held-out residuals: two are needed.");
  }
  message_->setText(text);
  fillTable(shown);
  fillBoxes(shown);
}

// Which row the result is: what stands beside it is read as its rival.
QString MethodsPane::resultText(const CalibrationResult& result) {
  const bool listed = std::any_of(result.methods.begin(), result.methods.end(),
                                  [&](const MethodResult& m) { return is_the_result(m, result); });
  return listed ? tr("Bold: the result.")
                : tr("The result is of another model, %1, which is not among them.")
                      .arg(core_text(pose_use(result).model));
}

void MethodsPane::fillTable(const CalibrationResult& result) {
  const std::vector<MethodResult>& methods = result.methods;
  table_->setRowCount(static_cast<int>(methods.size()));
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const MethodResult& m = methods[k];
    const bool chosen = is_the_result(m, result);
    const QStringList cells = {
        method_title(m.name),
        cell_text(m.rms_px, 3),
        cell_text(m.rms_mm, 2),
        cell_text(m.transfer_px, 3),
        cell_text(m.heldout_px, 3),
        cell_text(m.heldout_mm, 2),
        chosen ? QStringLiteral("–") : cell_text(distance_mm(m, result), 2),
        chosen ? QStringLiteral("–") : cell_text(distance_mrad(m, result), 3)};
    for (int c = 0; c < cells.size(); ++c) {
      auto* item = new QTableWidgetItem(cells[c]);
      item->setTextAlignment((c == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
      QFont font = item->font();
      font.setBold(chosen);
      item->setFont(font);
      table_->setItem(static_cast<int>(k), c, item);
    }
  }
}

void MethodsPane::fillBoxes(const CalibrationResult& result) {
  std::vector<BoxPlot::Box> px;
  std::vector<BoxPlot::Box> mm;
  for (const MethodResult& m : result.methods) {
    const QString name = method_title(m.name);
    px.push_back({name, {}});
    mm.push_back({name, {}});
    for (const MethodScene& scene : m.scenes) {
      px.back().values.insert(px.back().values.end(), scene.errors_px.begin(),
                              scene.errors_px.end());
      mm.back().values.insert(mm.back().values.end(), scene.errors_mm.begin(),
                              scene.errors_mm.end());
    }
  }
  boxes_px_->setBoxes(std::move(px));
  boxes_mm_->setBoxes(std::move(mm));
}

}  // namespace lvcalib::widgets

#include "moc_methods_pane.cpp"
