// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/texts.h"

#include <QAbstractButton>
#include <QCoreApplication>
#include <QDockWidget>
#include <QEvent>
#include <QTimer>
#include <QWidget>
#include <utility>
#include <vector>

#include "style/unseen.h"

namespace lvcalib::widgets {
namespace {

constexpr int kLater_ms = 250;  // What is in sight has been drawn by then.

class LanguageFollower : public QObject {
 public:
  LanguageFollower(QWidget* widget, std::function<void()> set_texts)
      : QObject(widget), set_texts_(std::move(set_texts)) {
    widget->installEventFilter(this);
  }
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::LanguageChange) {
      stale_ = true;
      // What is in sight answers the click; all the rest at once with it would keep it waiting.
      if (unseen(*static_cast<QWidget*>(watched))) {
        QTimer::singleShot(kLater_ms, this, &LanguageFollower::catch_up);
      } else {
        catch_up();
      }
    } else if (event->type() == QEvent::Show) {
      catch_up();
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  void catch_up() {
    if (std::exchange(stale_, false)) set_texts_();
  }

  std::function<void()> set_texts_;
  bool stale_ = false;  // In the words of the language before.
};

}  // namespace

void follow_language(QWidget* widget, std::function<void()> set_texts) {
  set_texts();
  new LanguageFollower(widget, std::move(set_texts));
}

void follow_language_in_title(QDockWidget& dock) {
  follow_language(&dock, [&dock] {
    const std::pair<const char*, QString> texts[] = {
        {"qt_dockwidget_floatbutton", QCoreApplication::translate("Docks", "Detach or attach")},
        {"qt_dockwidget_closebutton", QCoreApplication::translate("Docks", "Hide")}};
    for (const auto& [name, text] : texts) {
      auto* button = dock.findChild<QAbstractButton*>(QLatin1String(name));
      if (button == nullptr) continue;
      button->setToolTip(text);
      button->setAccessibleName(text);
    }
  });
}

}  // namespace lvcalib::widgets
