// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QComboBox>
#include <QStringList>
#include <optional>

#include "dialogs/choices.h"
#include "target/target.h"

namespace lvcalib::widgets {

/// Which board stands in front of the sensors: a target.yaml beside the data, the standard board,
/// those of recent datasets, another file, or one that is made on the spot.
class BoardChoice : public QComboBox {
  Q_OBJECT

 public:
  /// `choices` must outlive this. `recent`: datasets and projects whose boards are offered.
  BoardChoice(Choices& choices, const QStringList& recent, QWidget* parent = nullptr);

  /// The data's folder: its target.yaml is taken if there is one, and files are asked for there.
  void setPlace(const QString& folder);
  /// The board; nothing if its file cannot be used (problem() says why).
  [[nodiscard]] const std::optional<Target>& target() const { return target_; }
  [[nodiscard]] const QString& problem() const { return problem_; }
  /// Whether somebody said which board it is.
  [[nodiscard]] bool certain() const;

 Q_SIGNALS:
  void boardChanged();

 private:
  void fill();
  void choose(int index);
  void use(const QString& path);
  void read();

  Choices& choices_;
  QStringList recent_;
  QString place_;
  std::optional<Target> target_ = Target{};
  QString problem_;
  bool chosen_ = false;  // By the user.
  int last_ = 0;
};

}  // namespace lvcalib::widgets
