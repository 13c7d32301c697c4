// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace lvcalib {

/// The whole file as text. Errors: missing, a folder, unreadable, larger than `max_bytes`.
Result<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes);

/// Whether a name stands for a device, a pipe or what a shell has opened: such is written to, and
/// never replaced by a file.
bool is_stream(const std::filesystem::path& path);

/// The place that a link leads to, where its new content belongs; any other path as it is.
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Writes a file so that a reader, a crash or an interruption never sees half of it: the text
/// goes to a temporary file beside it, is flushed to disk, and then takes the name. Links stay, and
/// streams are written to.
Status write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// Writes several files of one folder that belong together, each as above: whatever interrupts it,
/// those that are there are all of this call or all of an earlier one. All are written in full
/// before any takes its name, so that a full disk leaves the earlier ones as they are.
Status write_files_together(const std::filesystem::path& folder,
                            const std::vector<std::pair<std::string, std::string>>& files);

/// Creates a folder and its parents. Error if a file is in the way or it cannot be created.
Status create_folder(const std::filesystem::path& path);

/// Whether create_folder and writing into it can succeed, as far as names and rights tell; creates
/// nothing. Asked before long work whose result would be lost.
Status check_folder_usable(const std::filesystem::path& path);

}  // namespace lvcalib
