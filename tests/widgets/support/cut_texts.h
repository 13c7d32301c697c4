// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a window shows and its reader cannot read whole: texts that are wider than their place,
// sentences with more lines than room, columns out of sight, widgets that lie beyond their window.

#include <QAbstractButton>
#include <QAbstractScrollArea>
#include <QCheckBox>
#include <QComboBox>
#include <QGroupBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QRadioButton>
#include <QScrollBar>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QTabBar>
#include <QTableView>
#include <QToolButton>
#include <QTreeView>
#include <QWidget>
#include <algorithm>
#include <vector>

#include <qcustomplot.h>

#include "models/scene_model.h"

namespace lvcalib::test {

class CutTexts {
 public:
  explicit CutTexts(const QWidget& window) {
    for (const QWidget* child : window.findChildren<QWidget*>()) {
      // Of another window, or on another page.
      if (child->window() == &window && child->isVisible()) look(*child);
    }
  }
  /// Each as "who: what".
  [[nodiscard]] const QStringList& found() const { return found_; }

 private:
  static constexpr int kSlack_px = 1;  // Widths are rounded.

  void cut(const QWidget& w, const QString& text) {
    QString name = w.objectName();
    for (const QWidget* up = w.parentWidget(); name.isEmpty() && up != nullptr;
         up = up->parentWidget())
      name = up->objectName().isEmpty() ? QString() : QStringLiteral("… in ") + up->objectName();
    found_ << QStringLiteral("%1 '%2' (%3×%4): %5")
                  .arg(QString::fromLatin1(w.metaObject()->className()), name)
                  .arg(w.width())
                  .arg(w.height())
                  .arg(text);
  }

  static bool scrolls(const QWidget& w) {
    for (const QWidget* up = w.parentWidget(); up != nullptr; up = up->parentWidget()) {
      if (qobject_cast<const QAbstractScrollArea*>(up) != nullptr) return true;
    }
    return false;
  }

  static int wide(const QWidget& w, const QString& text) {
    return w.fontMetrics().size(Qt::TextShowMnemonic, text).width();
  }

  void look(const QWidget& w) {
    if (const auto* label = qobject_cast<const QLabel*>(&w)) return look_at(*label);
    if (const auto* button = qobject_cast<const QAbstractButton*>(&w)) return look_at(*button);
    if (const auto* box = qobject_cast<const QComboBox*>(&w)) return look_at(*box);
    if (const auto* bar = qobject_cast<const QTabBar*>(&w)) return look_at(*bar);
    if (const auto* header = qobject_cast<const QHeaderView*>(&w)) return look_at(*header);
    if (const auto* tree = qobject_cast<const QTreeView*>(&w)) return look_at(*tree);
    if (const auto* table = qobject_cast<const QTableView*>(&w)) return look_at(*table);
    if (const auto* line = qobject_cast<const QLineEdit*>(&w)) return look_at(*line);
    if (const auto* plot = qobject_cast<const QCustomPlot*>(&w)) return look_at(*plot);
  }

  void look_at(const QLabel& label) {
    if (label.text().isEmpty()) return;
    if (!scrolls(label) && label.visibleRegion().boundingRect() != label.rect())
      cut(label, QStringLiteral("lies beneath or beyond: ") + label.text());
    if (label.wordWrap()) {
      if (label.heightForWidth(label.width()) > label.height() + kSlack_px)
        cut(label, label.text());
      return;
    }
    // Whatever has little room by intent says all in its tool tip.
    if (label.sizePolicy().horizontalPolicy() == QSizePolicy::Ignored && !label.toolTip().isEmpty())
      return;
    if (label.sizeHint().width() > label.width() + kSlack_px) cut(label, label.text());
  }

  void look_at(const QAbstractButton& button) {
    if (button.text().isEmpty()) return;
    if (!scrolls(button) && button.visibleRegion().boundingRect() != button.rect())
      cut(button, QStringLiteral("lies beneath or beyond: ") + button.text());
    int needed = wide(button, button.text());
    const QStyle* style = button.style();
    if (qobject_cast<const QCheckBox*>(&button) != nullptr)
      needed += style->pixelMetric(QStyle::PM_IndicatorWidth, nullptr, &button) +
                style->pixelMetric(QStyle::PM_CheckBoxLabelSpacing, nullptr, &button);
    if (qobject_cast<const QRadioButton*>(&button) != nullptr)
      needed += style->pixelMetric(QStyle::PM_ExclusiveIndicatorWidth, nullptr, &button) +
                style->pixelMetric(QStyle::PM_RadioButtonLabelSpacing, nullptr, &button);
    if (needed > button.width() + kSlack_px) cut(button, button.text());
  }

  void look_at(const QComboBox& box) {
    QStyleOptionComboBox option;
    option.initFrom(&box);
    option.editable = box.isEditable();
    const QRect room = box.style()->subControlRect(QStyle::CC_ComboBox, &option,
                                                   QStyle::SC_ComboBoxEditField, &box);
    if (wide(box, box.currentText()) > room.width() + kSlack_px) cut(box, box.currentText());
  }

  void look_at(const QTabBar& bar) {
    for (int k = 0; k < bar.count(); ++k) {
      if (!bar.isTabVisible(k)) continue;
      if (bar.tabRect(k).right() > bar.width() || bar.tabRect(k).left() < 0)
        cut(bar, QStringLiteral("out of sight: ") + bar.tabText(k));
      else if (wide(bar, bar.tabText(k)) > bar.tabRect(k).width() + kSlack_px)
        cut(bar, bar.tabText(k));
    }
  }

  void look_at(const QHeaderView& header) {
    if (header.model() == nullptr || header.orientation() != Qt::Horizontal) return;
    for (int k = 0; k < header.count(); ++k) {
      if (header.isSectionHidden(k) || header.sectionSize(k) == 0) continue;
      const QString text = header.model()->headerData(k, Qt::Horizontal).toString();
      const int room = header.sectionSize(k) - 4;
      if (wide(header, text) <= room + kSlack_px) continue;
      constexpr int kInLines =
          static_cast<int>(Qt::AlignCenter) | static_cast<int>(Qt::TextWordWrap);
      const QRect lines =
          header.fontMetrics().boundingRect(QRect(0, 0, std::max(1, room), 10'000), kInLines, text);
      const bool wraps =
          (static_cast<int>(header.defaultAlignment()) & static_cast<int>(Qt::TextWordWrap)) != 0;
      if (!wraps || lines.height() > header.height() || lines.width() > room + kSlack_px)
        cut(header, QStringLiteral("heading ") + text);
    }
  }

  template <class View>
  void look_at_cells(const View& view) {
    const QAbstractItemModel* model = view.model();
    if (model == nullptr) return;
    if (view.horizontalScrollBar()->maximum() > 0)
      cut(view, QStringLiteral("columns out of sight by %1 px")
                    .arg(view.horizontalScrollBar()->maximum()));
    const QAbstractItemView& cells = view;
    for (int r = 0; r < model->rowCount(); ++r) {
      for (int c = 0; c < model->columnCount(); ++c) {
        const QModelIndex at = model->index(r, c);
        const QRect room = cells.visualRect(at);
        const QString text = at.data().toString();
        if (text.isEmpty() || room.isEmpty() || view.isColumnHidden(c)) continue;
        if (cells.indexWidget(at) != nullptr) continue;
        const QSize needed = cells.sizeHintForIndex(at);
        // A state is one word; a part of it says nothing, and nobody looks for the rest.
        if (view.objectName() == QLatin1String("scenes") && c == widgets::SceneModel::kState) {
          if (needed.width() > room.width() + kSlack_px)
            cut(view, QStringLiteral("state of row %1: %2").arg(r).arg(text));
          continue;
        }
        if (needed.width() > room.width() + kSlack_px && needed.height() >= room.height() &&
            at.data(Qt::ToolTipRole).toString().isEmpty())
          cut(view, QStringLiteral("row %1, column %2: %3").arg(r).arg(c).arg(text));
      }
    }
  }
  void look_at(const QTreeView& tree) { look_at_cells(tree); }
  void look_at(const QTableView& table) { look_at_cells(table); }

  void look_at(const QLineEdit& line) {
    if (!line.hasFrame() && line.parentWidget() != nullptr &&
        wide(line, line.text()) > line.contentsRect().width() + kSlack_px)
      cut(line, line.text());
  }

  void look_at(const QCustomPlot& plot) {
    for (int k = 0; k < plot.itemCount(); ++k) {
      const auto* item = qobject_cast<const QCPItemText*>(plot.item(k));
      if (item == nullptr || item->text().isEmpty() || !item->visible()) continue;
      const QSize size = QFontMetrics(item->font()).size(0, item->text());
      const QPointF a = item->topLeft->pixelPosition();
      const QPointF b = item->bottomRight->pixelPosition();
      if (size.width() > plot.width() || std::min(a.x(), b.x()) < -kSlack_px ||
          std::max(a.x(), b.x()) > plot.width() + kSlack_px)
        cut(plot, item->text());
    }
    for (const QCPAxis* axis : {plot.xAxis, plot.yAxis, plot.xAxis2, plot.yAxis2}) {
      if (!axis->visible() || axis->label().isEmpty()) continue;
      const bool across = axis->orientation() == Qt::Horizontal;
      const int room = across ? plot.width() : plot.height();
      if (QFontMetrics(axis->labelFont()).size(0, axis->label()).width() > room)
        cut(plot, QStringLiteral("axis ") + axis->label());
    }
  }

  QStringList found_;
};

}  // namespace lvcalib::test
