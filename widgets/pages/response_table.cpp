// SPDX-License-Identifier: GPL-3.0-or-later
#include "pages/response_table.h"

#include <QHeaderView>
#include <QResizeEvent>
#include <QTableWidget>
#include <algorithm>
#include <vector>

#include "base/units.h"
#include "pages/page_tr.h"
#include "style/fitting.h"

namespace lvcalib::widgets {
namespace {

constexpr int kFirstNumber = 2;
constexpr int kNumbers = 6;
constexpr int kResponseColumns = 10;

constexpr double kSmallestLetters = 0.75;  // Of the usual ones.
constexpr int kCellMargin = 8;

// Its spaces do not break: a number and its ± stay on one line.
QString plus_minus(double value, double sigma, int decimals) {
  return QString("%1\u00a0±\u00a0%2")
      .arg(QString::number(value, 'f', decimals).replace('-', QChar(0x2212)))
      .arg(sigma, 0, 'f', decimals);
}

void put(QTableWidget& table, int row, int column, const QString& text) {
  auto* item = new QTableWidgetItem(text);
  item->setTextAlignment(column == 0 ? Qt::AlignLeft | Qt::AlignVCenter
                                     : Qt::AlignRight | Qt::AlignVCenter);
  table.setItem(row, column, item);
}

void put_statistics(QTableWidget& table, int row, const ResponseStatistics& s) {
  const Eigen::Vector3d unit(kDegPerRad, kDegPerRad, kMmPerM);
  const Eigen::Vector3d mean = s.mean.cwiseProduct(unit);
  const Eigen::Vector3d mean_sigma = s.mean_sigma.cwiseProduct(unit);
  const Eigen::Vector3d std_dev = s.std_dev().cwiseProduct(unit);
  const Eigen::Vector3d std_sigma = s.std_sigma.cwiseProduct(unit);
  put(table, row, 1, QString::number(s.n));
  for (int k = 0; k < 3; ++k) {
    const int decimals = k < 2 ? 4 : 2;
    put(table, row, kFirstNumber + k, plus_minus(mean(k), mean_sigma(k), decimals));
    put(table, row, kFirstNumber + 3 + k, plus_minus(std_dev(k), std_sigma(k), decimals));
  }
}

// Every column is as wide as its numbers with their ±. Where the window is too narrow for that the
// letters become smaller, and where that is not enough the table scrolls.
class ResponseTable : public QTableWidget {
 public:
  explicit ResponseTable(QWidget* parent) : QTableWidget(0, kResponseColumns, parent) {
    const auto later = [this] {
      if (pending_) return;
      pending_ = true;
      QMetaObject::invokeMethod(
          this, [this] { fit(); }, Qt::QueuedConnection);
    };
    for (auto signal : {&QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved})
      connect(model(), signal, this, later);
    connect(model(), &QAbstractItemModel::dataChanged, this, later);
    connect(model(), &QAbstractItemModel::headerDataChanged, this, later);
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QTableWidget::resizeEvent(event);
    if (event->size().width() != event->oldSize().width()) fit();
  }
  void showEvent(QShowEvent* event) override {
    QTableWidget::showEvent(event);
    fit();
  }

 private:
  // What the numbers, the names and the longest word of each heading need.
  [[nodiscard]] std::vector<int> needed(const QFontMetrics& metrics) const {
    std::vector<int> widths(kResponseColumns, 0);
    for (int c = 0; c < kResponseColumns; ++c) {
      if (isColumnHidden(c)) continue;
      int& width = widths[static_cast<std::size_t>(c)];
      const QTableWidgetItem* title = horizontalHeaderItem(c);
      for (const QString& word : title == nullptr ? QStringList() : title->text().split(' '))
        width = std::max(width, metrics.horizontalAdvance(word));
      for (int r = 0; r < rowCount(); ++r) {
        // A reason runs over several columns.
        if (item(r, c) != nullptr && columnSpan(r, c) == 1)
          width = std::max(width, metrics.horizontalAdvance(item(r, c)->text()));
      }
      width = std::max(width + kCellMargin, horizontalHeader()->minimumSectionSize());
    }
    return widths;
  }

  void fit() {
    pending_ = false;
    const QFont usual = parentWidget() != nullptr ? parentWidget()->font() : QFont();
    QFont letters = usual;
    std::vector<int> widths;
    const int room = viewport()->width();
    int sum = 0;
    for (double share = 1.0; share >= kSmallestLetters; share -= 0.05) {
      letters.setPointSizeF(share * usual.pointSizeF());
      widths = needed(QFontMetrics(letters));
      sum = 0;
      for (const int width : widths) sum += width;
      if (sum <= room) break;
    }
    if (font() != letters) setFont(letters);
    verticalHeader()->setMinimumSectionSize(QFontMetrics(letters).height() + 8);
    // What is left over goes to the numbers.
    int numbers = 0;
    for (int c = kFirstNumber; c < kResponseColumns; ++c) numbers += isColumnHidden(c) ? 0 : 1;
    int left = std::max(0, room - sum);
    for (int c = 0; c < kResponseColumns; ++c) {
      int width = widths[static_cast<std::size_t>(c)];
      if (c >= kFirstNumber && !isColumnHidden(c)) {
        const int more = left / numbers--;
        left -= more;
        width += more;
      }
      if (width > 0) setColumnWidth(c, width);
    }
  }

  bool pending_ = false;
};

}  // namespace

QTableWidget* new_response_table(QWidget* parent) {
  auto* table = new ResponseTable(parent);
  keep_headings_whole(*table);
  table->verticalHeader()->hide();
  table->setWordWrap(true);  // A reason may be longer than its columns.
  table->setTextElideMode(Qt::ElideNone);
  table->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table->horizontalHeader()->setMinimumSectionSize(30);
  table->horizontalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  table->horizontalHeader()->setDefaultAlignment(Qt::AlignCenter |
                                                 static_cast<Qt::Alignment>(Qt::TextWordWrap));
  table->horizontalHeader()->setHighlightSections(false);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setSelectionMode(QAbstractItemView::SingleSelection);
  table->setTabKeyNavigation(false);
  return table;
}

void hide_transition(QTableWidget& table) {
  for (int column = kFirstNumber + kNumbers; column < kResponseColumns; ++column)
    table.setColumnHidden(column, true);
}

void title_response_table(QTableWidget& table, const QString& name_title) {
  const QStringList titles = {name_title,
                              tr("N"),
                              tr("mean pitch (°)"),
                              tr("mean yaw (°)"),
                              tr("mean range (mm)"),
                              tr("σ pitch (°)"),
                              tr("σ yaw (°)"),
                              tr("σ range (mm)"),
                              tr("δ (mm)"),
                              tr("σ transition (mm)")};
  table.setHorizontalHeaderLabels(titles);
  const QString mean = tr("Mean of the residuals to the nearest ideal boundary points");
  const QString sigma = tr("Standard deviation of a beam on the edge");
  for (int k = 0; k < kNumbers; ++k)
    table.horizontalHeaderItem(kFirstNumber + k)->setToolTip(k < 3 ? mean : sigma);
  table.horizontalHeaderItem(1)->setToolTip(tr("Samples of the overlap region"));
  table.horizontalHeaderItem(8)->setToolTip(
      tr("Where the intensity is half way, from the circle's edge, outside positive"));
  table.horizontalHeaderItem(9)->setToolTip(tr("Width of the error function on the board"));
  table.setToolTip(tr("Numbers are given ± their own standard deviation."));
}

void add_response_row(QTableWidget& table, const QString& name,
                      const std::optional<ResponseStatistics>& statistics,
                      const std::optional<TransitionFit>& transition, const QString& reason) {
  const int row = table.rowCount();
  table.insertRow(row);
  put(table, row, 0, name);
  if (statistics) {
    put_statistics(table, row, *statistics);
  } else {
    put(table, row, 1, QStringLiteral("–"));
    put(table, row, kFirstNumber, reason.isEmpty() ? tr("no statistics") : reason);
    table.item(row, kFirstNumber)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table.item(row, kFirstNumber)->setToolTip(reason);
    table.setSpan(row, kFirstNumber, 1, kNumbers);
  }
  if (transition) {
    put(table, row, 8,
        plus_minus(kMmPerM * transition->delta_m, kMmPerM * transition->delta_sigma_m, 3));
    put(table, row, 9,
        plus_minus(kMmPerM * transition->sigma_m, kMmPerM * transition->sigma_sigma_m, 3));
  }
}

}  // namespace lvcalib::widgets
