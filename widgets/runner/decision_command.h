// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QUndoCommand>
#include <functional>

#include "base/message.h"
#include "pipeline/session.h"

namespace lvcalib::widgets {

/// A decision that the Edit menu names, in the present language.
class DescribedCommand : public QUndoCommand {
 public:
  /// What is said of a decision: source text in a context of the catalogues, and what takes the
  /// place of its %1: a name, or what the core calls it.
  struct Words {
    const char* source = nullptr;
    QString about = {};
    Message called = {};
  };

  DescribedCommand(const char* context, Words words);
  /// In the present language; text() stays in the one of the time of the decision.
  [[nodiscard]] QString description() const;

 private:
  const char* context_;
  Words words_;
};

/// One decision of the user, undoable. Decisions are small, so both sides are kept whole. Its words
/// are of the catalogues' context "Decisions".
class DecisionCommand : public DescribedCommand {
 public:
  using Apply = std::function<void(const Decisions&)>;

  /// Decisions that follow each other with the same `merge_key` count as one; empty: never.
  DecisionCommand(Apply apply, Decisions before, Decisions after, Words words, QString merge_key);

  void undo() override { apply_(before_); }
  void redo() override { apply_(after_); }
  [[nodiscard]] int id() const override { return merge_key_.isEmpty() ? -1 : 1; }
  bool mergeWith(const QUndoCommand* other) override;

 private:
  Apply apply_;
  Decisions before_;
  Decisions after_;
  QString merge_key_;
};

}  // namespace lvcalib::widgets
