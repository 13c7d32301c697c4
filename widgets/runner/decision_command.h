// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QUndoCommand>
#include <functional>

#include "pipeline/session.h"

namespace lvcalib::widgets {

/// One decision of the user, undoable. Decisions are small, so both sides are kept whole.
class DecisionCommand : public QUndoCommand {
 public:
  using Apply = std::function<void(const Decisions&)>;

  /// What is said of a decision: source text in the catalogues' context "Decisions", and what takes
  /// the place of its %1.
  struct Words {
    const char* source;
    QString about;
  };

  /// Decisions that follow each other with the same `merge_key` count as one; empty: never.
  DecisionCommand(Apply apply, Decisions before, Decisions after, Words words, QString merge_key);

  void undo() override { apply_(before_); }
  void redo() override { apply_(after_); }
  [[nodiscard]] int id() const override { return merge_key_.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* other) override;

  /// In the present language; text() stays in the one of the time of the decision.
  [[nodiscard]] QString description() const;

 private:
  Apply apply_;
  Decisions before_;
  Decisions after_;
  Words words_;
  QString merge_key_;
};

}  // namespace lvcalib::widgets
