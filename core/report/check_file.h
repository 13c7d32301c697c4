// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "recording/file_pairs.h"
#include "verification/edge_agreement.h"

namespace lvcalib {

/// The text of check.json: the verdict with its reason, the scores, where edges agree best, what
/// would have been noticed, the files, and what speaks against some of them (keys: see
/// resources/guide/files.md).
std::string check_as_json(const EdgeCheck& check, const std::vector<FilePair>& pairs,
                          const std::vector<Message>& warnings);

Status write_check(const EdgeCheck& check, const std::vector<FilePair>& pairs,
                   const std::vector<Message>& warnings, const std::filesystem::path& path);

}  // namespace lvcalib
