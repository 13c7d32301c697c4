// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <optional>
#include <string>

#include "runner/runner.h"
#include "target/target.h"

class QComboBox;
class QLabel;
class QTimer;

namespace lvcalib::widgets {

class KeyForm;

/// The keys of target.yaml as a form, with the board that they describe as it would be printed.
class TargetForm : public QWidget {
  Q_OBJECT

 public:
  explicit TargetForm(QWidget* parent = nullptr);
  ~TargetForm() override;

  /// Takes over what a file says; what it lacks stays blank. The text must be a readable target.
  void setText(const std::string& yaml);
  /// The file's content.
  [[nodiscard]] std::string text() const;
  /// What the core's reader makes of it; nothing if it complains.
  [[nodiscard]] const std::optional<Target>& target() const { return target_; }
  [[nodiscard]] const KeyForm& keys() const { return *form_; }

 Q_SIGNALS:
  /// After the text was checked.
  void edited();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void retranslate();
  void chooseType();
  void check();
  void draw();
  void showPicture();

  std::optional<Target> target_;
  QPixmap picture_;
  QLabel* type_label_;
  QComboBox* type_;
  KeyForm* form_;
  QLabel* problem_;
  QLabel* preview_;
  QLabel* size_;
  QTimer* settle_;
  Runner runner_;  // Last: stopped before what it tells goes.
};

}  // namespace lvcalib::widgets
