// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/decision_command.h"

#include <QCoreApplication>
#include <utility>

#include "words/core_text.h"

namespace lvcalib::widgets {

DescribedCommand::DescribedCommand(const char* context, Words words)
    : context_(context), words_(std::move(words)) {
  setText(description());
}

QString DescribedCommand::description() const {
  const QString text = QCoreApplication::translate(context_, words_.source);
  const QString about = words_.called.empty() ? words_.about : core_text(words_.called);
  return about.isEmpty() ? text : text.arg(about);
}

DecisionCommand::DecisionCommand(Apply apply, Decisions before, Decisions after, Words words,
                                 QString merge_key)
    : DescribedCommand("Decisions", std::move(words)),
      apply_(std::move(apply)),
      before_(std::move(before)),
      after_(std::move(after)),
      merge_key_(std::move(merge_key)) {}

// Turning one spin box is one decision.
bool DecisionCommand::mergeWith(const QUndoCommand* other) {
  const auto* next = dynamic_cast<const DecisionCommand*>(other);
  if (next == nullptr || next->merge_key_ != merge_key_) return false;
  after_ = next->after_;
  return true;
}

}  // namespace lvcalib::widgets
