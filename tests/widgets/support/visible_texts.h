// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything that a window says: texts, titles, tool tips, names for screen readers, headings and
// cells of tables, labels of figures, menus.

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QTabBar>
#include <QTextBrowser>
#include <QTextDocument>
#include <QWidget>
#include <utility>
#include <vector>

#include <qcustomplot.h>

namespace lvcalib::test {

/// A text and who says it.
struct SaidText {
  QString where;
  QString text;
};

class TextCollector {
 public:
  explicit TextCollector(const QWidget& window) {
    widget(window);
    for (const QWidget* child : window.findChildren<QWidget*>()) widget(*child);
    for (const QAction* action : window.findChildren<QAction*>()) {
      // Menus of Qt's own text fields come and go with Qt's own catalogue.
      if (action->objectName().startsWith(QLatin1String("qt_"))) continue;
      const QString name = QStringLiteral("action ") + action->objectName();
      add(name, action->text());
      add(name, action->toolTip());
      add(name, action->iconText());
    }
  }
  [[nodiscard]] const std::vector<SaidText>& texts() const { return texts_; }

 private:
  void add(const QString& where, const QString& text) {
    if (!text.isEmpty()) texts_.push_back({where, text});
  }

  void widget(const QWidget& w) {
    // Qt's own buttons for too many tabs; the list of formats holds their names.
    if (w.objectName().startsWith(QLatin1String("Scroll")) ||
        w.objectName() == QLatin1String("formats"))
      return;
    const QString name = QStringLiteral("%1 '%2'").arg(
        QString::fromLatin1(w.metaObject()->className()), w.objectName());
    add(name, w.toolTip());
    add(name, w.accessibleName());
    if (w.isWindow() || w.inherits("QDockWidget") || w.inherits("QToolBar"))
      add(name, w.windowTitle());
    if (const auto* label = qobject_cast<const QLabel*>(&w)) add(name, label->text());
    if (const auto* button = qobject_cast<const QAbstractButton*>(&w)) add(name, button->text());
    if (const auto* menu = qobject_cast<const QMenu*>(&w)) add(name, menu->title());
    if (const auto* box = qobject_cast<const QComboBox*>(&w)) {
      for (int k = 0; k < box->count(); ++k) add(name, box->itemText(k));
    }
    if (const auto* bar = qobject_cast<const QTabBar*>(&w)) {
      for (int k = 0; k < bar->count(); ++k) add(name, bar->tabText(k));
    }
    if (const auto* text = qobject_cast<const QTextBrowser*>(&w)) add(name, text->toPlainText());
    if (const auto* plot = qobject_cast<const QCustomPlot*>(&w)) figure(name, *plot);
    if (const auto* view = qobject_cast<const QAbstractItemView*>(&w)) table(name, *view);
  }

  void figure(const QString& name, const QCustomPlot& plot) {
    for (const QCPAxis* axis : {plot.xAxis, plot.yAxis}) add(name, axis->label());
    for (int k = 0; k < plot.itemCount(); ++k) {
      if (const auto* item = qobject_cast<const QCPItemText*>(plot.item(k)))
        add(name, item->text());
    }
  }

  void table(const QString& name, const QAbstractItemView& view) {
    const QAbstractItemModel* model = view.model();
    if (model == nullptr || qobject_cast<const QHeaderView*>(&view) != nullptr) return;
    for (int c = 0; c < model->columnCount(); ++c) {
      for (const int role : {int(Qt::DisplayRole), int(Qt::ToolTipRole)}) {
        add(name, model->headerData(c, Qt::Horizontal, role).toString());
        for (int r = 0; r < model->rowCount(); ++r)
          add(name, model->index(r, c).data(role).toString());
      }
    }
  }

  std::vector<SaidText> texts_;
};

}  // namespace lvcalib::test
