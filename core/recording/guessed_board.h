// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include "base/message.h"

namespace lvcalib {

/// Of a dataset whose board was guessed: where some scenes show it, it was guessed well, and those
/// that do not are taken out of `folder` again; where none does, all stay, and a warning says so.
/// `Item` (a stretch, a pair) has `taken`, `reason` and `board_complaint`; `take_scene` says what
/// the scene of one that is taken out was called.
template <class Item>
void judge_guessed_board(const std::filesystem::path& folder, std::vector<Item>& items,
                         const std::function<std::string(Item&)>& take_scene,
                         std::vector<Message>& warnings) {
  const auto shows = [](const Item& i) { return i.taken && i.board_complaint.empty(); };
  if (std::none_of(items.begin(), items.end(), shows)) {
    warnings.push_back(
        Message("no scene shows the default board, which target.yaml describes; put the "
                "description of yours in its place, or import with --target"));
    return;
  }
  for (Item& item : items) {
    if (!item.taken || item.board_complaint.empty()) continue;
    std::error_code code;
    std::filesystem::remove_all(folder / "scenes" / take_scene(item), code);
    item.taken = false;
    item.reason = item.board_complaint;
  }
}

}  // namespace lvcalib
