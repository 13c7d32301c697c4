// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "detection/board_view.h"
#include "localization/board_search.h"
#include "pipeline/crop_box.h"
#include "pipeline/dataset.h"
#include "pipeline/options.h"
#include "refinement/board_refinement.h"

namespace lvcalib {

/// A stage's result with the key of everything it was made from: files, options, earlier stages.
/// Shared and never changed, so copies are cheap and may go to other threads.
template <class T>
struct Kept {
  std::string key;
  std::shared_ptr<const T> value;

  /// The value if it was made from the same things, else null.
  [[nodiscard]] const T* find(const std::string& wanted) const {
    return value && key == wanted ? value.get() : nullptr;
  }
  void keep(std::string made_from, T made) {
    key = std::move(made_from);
    value = std::make_shared<const T>(std::move(made));
  }
};

/// What the image stage found: a view of the board or the reason why there is none.
struct SeenBoard {
  std::optional<BoardView> view;
  Message reason;
};

/// What a LiDAR that does not find the board measures at the place where the image has it.
enum class BoardPlace {
  kOpen,    ///< Nothing that speaks against the board, or too little.
  kPast,    ///< The rays go on behind the place.
  kHidden,  ///< Something nearer stands in their way.
  kTaken,   ///< Something stands there, and shows no print: too few lines or points, as far away.
};

/// What the search in a region found.
struct SecondLook {
  BoardSearchResult search;
  BoardPlace place = BoardPlace::kOpen;
};

/// Everything kept of one scene. Board points are kept (in the searches' patches), full clouds not.
struct SceneStages {
  Kept<SeenBoard> seen;
  Kept<BoardSearchResult> search;             ///< First look.
  Kept<std::vector<Message>> cloud_warnings;  ///< Of the file that the first look read.
  Kept<SecondLook> second_look;               ///< Where the other scenes put the board.
  Kept<BoardRefinement> refinement;
  Kept<std::vector<RefinedNode>> paper_nodes;  ///< Of the same points, as the paper refines them.
};

/// Stage results of a dataset's scenes between runs. A changed option, crop box, guess or file
/// changes the keys of the first stage it touches and of all later ones, which then run again.
/// Entries of different scenes may be used from different threads at the same time.
class StageCache {
 public:
  /// Makes an entry for every scene and every extra image; must come before scene().
  void prepare(const Dataset& dataset);
  SceneStages& scene(const std::string& name) { return scenes_.at(name); }
  /// Forgets one scene, so that all its stages run again.
  void forget(const std::string& name) { scenes_.erase(name); }
  [[nodiscard]] bool empty() const { return scenes_.empty(); }

 private:
  std::map<std::string, SceneStages> scenes_;
};

/// Name under which the cache keeps an image of intrinsics/; no scene can have it.
std::string extra_image_name(const std::filesystem::path& image);

struct CalibrationRequest;

/// Key of the image stage: target, camera, image file (name, size, time) and its options.
std::string detection_key(const Dataset& dataset, const SceneFiles& files,
                          const CalibrationOptions& options);
/// Key of the search: the image stage's, the cloud file, crop box, guess and its options.
std::string search_key(const Dataset& dataset, const SceneFiles& files,
                       const CalibrationRequest& request);
/// Key of a search in a region (after another search).
std::string second_look_key(const std::string& search_key, const BoardSearchRegion& region);
/// Key of the refinement: the search that it follows, the candidate and its options.
std::string refinement_key(const std::string& search_key, std::size_t candidate,
                           const CalibrationOptions& options);

}  // namespace lvcalib
