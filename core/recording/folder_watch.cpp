// SPDX-License-Identifier: BSD-3-Clause
#include "recording/folder_watch.h"

#include <algorithm>
#include <system_error>

#include "recording/pair_import.h"

namespace lvcalib {
namespace fs = std::filesystem;
namespace {

Status can_be_listed(const fs::path& folder) {
  std::error_code code;
  if (!fs::is_directory(folder, code))
    return Error::input(Message("folder not found"), folder.string());
  const fs::directory_iterator first(folder, code);
  if (code) return Error::input(Message("cannot be listed: %1", code.message()), folder.string());
  return Done{};
}

}  // namespace

FolderLister pair_lister(PairOptions options) {
  return [options = std::move(options)]() -> Result<FolderListing> {
    for (const fs::path& folder : {options.images, options.clouds}) {
      if (folder.empty()) continue;
      if (Status s = can_be_listed(folder); !s) return s.error();
    }
    FolderListing out;
    const auto files = find_pairs(options);
    if (!files) {
      out.incomplete.push_back({"", files.error().message});
      return out;
    }
    out.pairs = files->pairs;
    for (const UnmatchedFile& file : files->unmatched)
      out.incomplete.push_back({file.name, file.reason});
    return out;
  };
}

// Without the files that are gone again, or empty: such a pair is not complete.
FolderWatch::Stamp FolderWatch::stamp_of(const FilePair& pair) {
  Stamp out;
  for (const fs::path& path : {pair.image, pair.cloud, pair.board_points}) {
    if (path.empty()) continue;
    std::error_code code;
    const std::uintmax_t size = fs::file_size(path, code);
    if (code || size == 0) return {};
    const auto time = fs::last_write_time(path, code);
    if (code) return {};
    out.emplace_back(path, size, static_cast<std::int64_t>(time.time_since_epoch().count()));
  }
  return out;
}

Result<FolderLook> FolderWatch::look(const RunContext& context) {
  auto listing = lister_();
  if (!listing) return listing.error();
  FolderLook out;
  std::map<std::string, Stamp> seen;
  for (FilePair& pair : listing->pairs) {
    if (context.stopped()) return Error::cancelled();
    if (known_.contains(pair.name)) continue;
    const Stamp stamp = stamp_of(pair);
    const auto before = last_.find(pair.name);
    if (!stamp.empty()) seen[pair.name] = stamp;
    if (stamp.empty() || before == last_.end() || before->second != stamp) {
      out.pending.push_back({pair.name, Message("is still being written")});
      continue;
    }
    const Message complaint = pair_complaint(pair, context);
    if (context.stopped()) return Error::cancelled();
    // It may have grown on while it was read.
    if (stamp_of(pair) != stamp) {
      out.pending.push_back({pair.name, Message("is still being written")});
    } else if (!complaint.empty()) {
      out.pending.push_back({pair.name, Message("cannot be read yet: %1", complaint)});
    } else {
      known_.insert(pair.name);
      seen.erase(pair.name);
      out.ready.push_back(std::move(pair));
    }
  }
  for (PendingPair& pending : listing->incomplete) {
    if (!known_.contains(pending.name)) out.pending.push_back(std::move(pending));
  }
  last_ = std::move(seen);
  return out;
}

}  // namespace lvcalib
