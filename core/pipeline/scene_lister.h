// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "recording/folder_watch.h"

namespace lvcalib {

/// Lists a folder of scene folders (DATASET/scenes) for a watch: each with image and cloud is a
/// pair of the folder's name, each without one of them is incomplete. Names that begin with a dot
/// are left out.
FolderLister scene_lister(std::filesystem::path scenes);

}  // namespace lvcalib
