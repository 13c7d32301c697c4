// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "recording/file_pairs.h"

namespace lvcalib {

/// Something in a watched folder that cannot be taken yet.
struct PendingPair {
  std::string name;  ///< Of the scene that is to become of it; empty: the folder as a whole.
  Message reason;    ///< In words.
};

/// What lies in a folder.
struct FolderListing {
  std::vector<FilePair> pairs;          ///< Image and cloud are both there.
  std::vector<PendingPair> incomplete;  ///< One of the two is missing.
};

/// Lists a folder; called at every look. Error (kInput): it cannot be listed.
using FolderLister = std::function<Result<FolderListing>()>;

/// Lists images and clouds that belong together (see find_pairs()). A folder without any is no
/// error: they are still to come.
FolderLister pair_lister(PairOptions options);

/// What a look found.
struct FolderLook {
  std::vector<FilePair> ready;  ///< Complete since this look; each is told once.
  std::vector<PendingPair> pending;
};

/// Watches a folder that another program writes to, by looking again and again: no notice of the
/// operating system is needed, which network drives do not give. A pair is complete when its files
/// have had the same size and time at two looks and can be read; until then it is looked at again.
/// A value: copies go on separately.
class FolderWatch {
 public:
  /// `known`: names of pairs that are not to be told.
  explicit FolderWatch(FolderLister lister, std::set<std::string> known = {})
      : lister_(std::move(lister)), known_(std::move(known)) {}

  /// A pair of this name is not to be told any more.
  void know(const std::string& name) { known_.insert(name); }

  /// Looks once: lists the folder and reads what may be complete. Errors: the folder cannot be
  /// listed (a later look may succeed); kCancelled.
  Result<FolderLook> look(const RunContext& context);

 private:
  // Of all files of a pair: path, size in bytes, time of the last change in the clock's ticks.
  using Stamp = std::vector<std::tuple<std::filesystem::path, std::uintmax_t, std::int64_t>>;
  static Stamp stamp_of(const FilePair& pair);

  FolderLister lister_;
  std::set<std::string> known_;
  std::map<std::string, Stamp> last_;
};

}  // namespace lvcalib
