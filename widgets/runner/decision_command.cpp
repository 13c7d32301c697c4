// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/decision_command.h"

#include <QCoreApplication>
#include <utility>

namespace lvcalib::widgets {

DecisionCommand::DecisionCommand(Apply apply, Decisions before, Decisions after, Words words,
                                 QString merge_key)
    : apply_(std::move(apply)),
      before_(std::move(before)),
      after_(std::move(after)),
      words_(std::move(words)),
      merge_key_(std::move(merge_key)) {
  setText(description());
}

// Turning one spin box is one decision.
bool DecisionCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = dynamic_cast<const DecisionCommand*>(other);
  if (next == nullptr || next->merge_key_ != merge_key_) return false;
  after_ = next->after_;
  return true;
}

QString DecisionCommand::description() const {
  const QString text = QCoreApplication::translate("Decisions", words_.source);
  return words_.about.isEmpty() ? text : text.arg(words_.about);
}

}  // namespace lvcalib::widgets
