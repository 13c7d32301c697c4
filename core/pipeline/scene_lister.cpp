// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/scene_lister.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "pipeline/dataset.h"

namespace lvcalib {
namespace fs = std::filesystem;

FolderLister scene_lister(fs::path scenes) {
  return [scenes = std::move(scenes)]() -> Result<FolderListing> {
    std::error_code code;
    fs::directory_iterator it(scenes, code);
    if (code) return Error::input(Message("cannot be listed: %1", code.message()), scenes.string());
    std::vector<fs::path> folders;
    for (const fs::directory_iterator end; !code && it != end; it.increment(code)) {
      std::error_code inner;
      if (it->is_directory(inner) && !it->path().filename().string().starts_with('.'))
        folders.push_back(it->path());
    }
    if (code) return Error::input(Message("cannot be listed: %1", code.message()), scenes.string());
    std::sort(folders.begin(), folders.end());
    FolderListing out;
    for (const fs::path& folder : folders) {
      const auto scene = open_scene(folder);
      if (scene) {
        out.pairs.push_back({scene->name, scene->image, scene->cloud, scene->crop, {}});
      } else {
        out.incomplete.push_back({folder.filename().string(), scene.error().message});
      }
    }
    return out;
  };
}

}  // namespace lvcalib
