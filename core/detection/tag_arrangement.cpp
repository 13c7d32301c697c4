// SPDX-License-Identifier: BSD-3-Clause
#include "detection/tag_arrangement.h"

#include <algorithm>
#include <utility>

#include "base/text.h"
#include "detection/board_pose.h"

namespace lvcalib {
namespace {

struct Arrangement {
  int turn = 0;  // Of each tag on its place, in quarters counter-clockwise.
  bool from_right = false;
  bool from_top = false;
};

// The corners with the ids' places exchanged and the tags turned.
std::vector<CornerObservation> rearranged(const std::vector<BoardTag>& tags, const Target& target,
                                          const Arrangement& how) {
  std::vector<CornerObservation> out;
  for (const BoardTag& tag : tags) {
    auto entry = target.tag(tag.id);
    if (!entry) continue;
    const int column = how.from_right ? target.tag_columns - 1 - entry->column : entry->column;
    const int row = how.from_top ? target.tag_rows - 1 - entry->row : entry->row;
    entry = target.tag(target.first_tag_id + row * target.tag_columns + column);
    const auto board = target.tag_corners_m(*entry);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t seen = (k + static_cast<std::size_t>(how.turn)) % 4;
      out.push_back({tag.id, static_cast<int>(k), board[k], tag.corners[seen], tag.sigma_px[seen]});
    }
  }
  return out;
}

// Tags all of whose corners lie where the best pose has them, and their mean square distance from
// there: a spacing that is off shows as a range that is off, and within the gate for outliers.
struct Fit {
  std::size_t count = 0;
  double mean_square_px2 = 0.0;
  [[nodiscard]] bool better_than(const Fit& other) const {
    constexpr double kLike_px2 = 0.1 * 0.1;  // A tenth of a pixel more or less is noise.
    return count > other.count || (count > 0 && count == other.count &&
                                   mean_square_px2 < other.mean_square_px2 - kLike_px2);
  }
};
Fit fitting(const std::vector<CornerObservation>& corners, const Camera& camera,
            const DetectionOptions& options) {
  // Hundreds of boards are tried, and only one that three quarters of the tags fit is named: of
  // four corners all fit it in three samples of ten, so that 60 miss it once in 10¹⁰ images.
  constexpr int kSamples = 60;
  const auto pose = estimate_board_pose(corners, camera, options, kSamples);
  Fit out;
  if (!pose) return out;
  for (std::size_t i = 0; i + 3 < corners.size(); i += 4) {
    bool fits = true;
    double squares = 0.0;
    for (std::size_t k = i; k < i + 4; ++k) {
      fits = fits && pose->residual_px[k] <= options.max_reprojection_px;
      squares += 0.25 * pose->residual_px[k] * pose->residual_px[k];
    }
    if (!fits) continue;
    ++out.count;
    out.mean_square_px2 += squares;
  }
  if (out.count > 0) out.mean_square_px2 /= static_cast<double>(out.count);
  return out;
}

Message described(const Arrangement& how) {
  Message ids;
  if (how.from_top && how.from_right)
    ids = Message("whose ids grow from the top right");
  else if (how.from_top)
    ids = Message("whose ids grow from the top left");
  else if (how.from_right)
    ids = Message("whose ids grow from the bottom right");
  const int turn_deg = 90 * how.turn;
  if (turn_deg != 0) {
    return ids.empty() ? Message("whose tags are each turned by %1°", turn_deg)
                       : Message("%1 and whose tags are each turned by %2°", ids, turn_deg);
  }
  // The same board seen from its other end.
  if (how.from_top && how.from_right)
    return Message("%1, or upside down and whose tags are each turned by 180°", ids);
  return ids;
}

// Tags that lie where a target has them.
Fit fitting_as_is(const std::vector<BoardTag>& tags, const Target& target, const Camera& camera,
                  const DetectionOptions& options) {
  return fitting(to_observations(tags, target), camera, options);
}

bool is_grid(const Target& target) {
  return target.type == TargetType::kAprilGrid || target.type == TargetType::kAprilGridCircles;
}

// A board's columns and rows as target.yaml counts them: of tags, or of a ChArUco board's squares.
struct Count {
  int columns = 0;
  int rows = 0;
};

Count count_of(const Target& target) {
  return is_grid(target) ? Count{target.tag_columns, target.tag_rows}
                         : Count{target.corner_columns + 1, target.corner_rows + 1};
}

void set_count(const Count& count, Target& target) {
  if (is_grid(target)) {
    target.tag_columns = count.columns;
    target.tag_rows = count.rows;
  } else {
    target.corner_columns = count.columns - 1;
    target.corner_rows = count.rows - 1;
  }
}

// The least number of rows that hold the highest id. A ChArUco board keeps whether they are even:
// its colours may depend on it.
int least_rows(int columns, int highest_id, const Target& target) {
  const int ids = highest_id - target.first_tag_id + 1;
  if (is_grid(target)) return (ids - 1) / columns + 1;
  Target other = target;
  int rows = count_of(target).rows % 2 == 0 ? 2 : 3;
  for (set_count({columns, rows}, other); other.tag_count() < ids;
       set_count({columns, rows}, other))
    rows += 2;
  return rows;
}

// The board with another number of columns or another first id that most tags fit. Which rows are
// there the tags say themselves.
std::pair<Fit, Message> best_counting(const std::vector<BoardTag>& tags, const Target& target,
                                      const Camera& camera, const DetectionOptions& options) {
  // No board that fits a sheet has more tags side by side, and no ChArUco board fewer squares.
  constexpr int kMostColumns = 16;
  const int fewest = is_grid(target) ? 1 : 3;
  const Count given = count_of(target);
  const auto [low, high] = std::minmax_element(
      tags.begin(), tags.end(), [](const BoardTag& a, const BoardTag& b) { return a.id < b.id; });
  std::pair<Fit, Message> best;
  for (int columns = fewest; columns <= kMostColumns; ++columns) {
    // Ids that differ by whole rows (of a ChArUco board by two, which hold as many markers as it
    // has columns) lie alike but for a shift of the whole board.
    for (int k = 0; k < columns; ++k) {
      Target other = target;
      other.first_tag_id = low->id - k;
      if (other.first_tag_id < 0) break;
      const int rows = least_rows(columns, high->id, other);
      set_count({columns, rows}, other);
      const Fit fit = fitting_as_is(tags, other, camera, options);
      if (!fit.better_than(best.first)) continue;
      std::string fields;
      const auto say = [&](const char* field, int value, int given) {
        if (value == given) return;
        fields += (fields.empty() ? "" : ", ") + std::string(field) + ": " + std::to_string(value);
      };
      const bool grid = is_grid(target);
      say(grid ? "firstTagId" : "firstMarkerId", other.first_tag_id, target.first_tag_id);
      say(grid ? "tagCols" : "targetCols", columns, given.columns);
      if (rows > given.rows || columns != given.columns)
        say(grid ? "tagRows" : "targetRows", rows, given.rows);
      best = {fit, Message::verbatim(fields)};
    }
  }
  return best;
}

// The spacing that most tags fit, to two per cent: what corners tell within the gate.
std::pair<Fit, Message> best_spacing(const std::vector<BoardTag>& tags, const Target& target,
                                     const Camera& camera, const DetectionOptions& options) {
  constexpr double kStep = 1.02;
  std::pair<Fit, Message> best;
  for (double spacing = 0.05; spacing < 3.0; spacing *= kStep) {
    Target other = target;
    other.tag_spacing = spacing;
    const Fit fit = fitting_as_is(tags, other, camera, options);
    if (fit.better_than(best.first))
      best = {fit, Message("tagSpacing: about %1", formatted("%.2f", spacing))};
  }
  return best;
}

}  // namespace

std::optional<Message> other_grid(const std::vector<BoardTag>& tags, const Target& target,
                                  const Camera& camera, const DetectionOptions& options) {
  if ((!is_grid(target) && target.type != TargetType::kCharuco) || tags.size() < 4)
    return std::nullopt;
  const std::size_t given = fitting_as_is(tags, target, camera, options).count;
  constexpr std::size_t kMore = 3;  // One or two tags fit another grid by chance of their place.
  const auto better = [&](const std::pair<Fit, Message>& found) {
    return !found.second.empty() && found.first.count >= given + kMore &&
           4 * found.first.count >= 3 * tags.size();
  };
  if (const auto found = best_counting(tags, target, camera, options); better(found))
    return found.second;
  if (!is_grid(target)) return std::nullopt;
  if (const auto found = best_spacing(tags, target, camera, options); better(found))
    return found.second;
  return std::nullopt;
}

std::optional<Message> other_arrangement(const std::vector<BoardTag>& tags, const Target& target,
                                         const Camera& camera, const DetectionOptions& options) {
  if (!is_grid(target)) return std::nullopt;
  std::size_t best = 2;
  std::optional<Message> out;
  for (int turn = 0; turn < 4; ++turn) {
    for (const bool from_right : {false, true}) {
      for (const bool from_top : {false, true}) {
        const Arrangement how{turn, from_right, from_top};
        // Nothing changed, or the whole board turned.
        if (turn == 0 && !from_right && !from_top) continue;
        if (turn == 2 && from_right && from_top) continue;
        const std::size_t count = fitting(rearranged(tags, target, how), camera, options).count;
        if (count <= best || 4 * count < 3 * tags.size()) continue;
        best = count;
        out = described(how);
      }
    }
  }
  return out;
}

}  // namespace lvcalib
