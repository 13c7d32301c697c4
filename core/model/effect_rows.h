// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "model/linear_model.h"
#include "model/scene_geometry.h"

namespace lvcalib {

/// What one unit of an effect's parameter does to what is predicted of a return.
struct UnitChange {
  double range_m = 0.0;                               ///< By itself,
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();  ///< and by the print under it: displaced,
  double growth_m = 0.0;                              ///< or its black grown.
  Eigen::Vector3d blur_rad2 = Eigen::Vector3d::Zero();
  double log_intensity = 0.0;
};

/// How a predicted intensity depends on what effects change, in the units of its row.
struct PrintSensitivity {
  Eigen::RowVector2d by_shift = Eigen::RowVector2d::Zero();  ///< Print displaced on the board (m).
  Eigen::RowVector3d by_blur = Eigen::RowVector3d::Zero();   ///< Beam's blur: hh, hv, vv (rad²).
  double by_growth = 0.0;                                    ///< Black that grows all around (m).
  double by_log_intensity = 0.0;

  /// What one unit of each parameter of an effect changes.
  struct Change {
    std::span<const Eigen::Vector2d> shift_m;
    std::span<const double> growth_m;
    std::span<const Eigen::Vector3d> blur_rad2;
    std::span<const double> log_intensity;
  };
  [[nodiscard]] double of(const Change& change, std::size_t k) const {
    return by_shift.dot(change.shift_m[k]) + by_growth * change.growth_m[k] +
           by_blur.dot(change.blur_rad2[k]) + by_log_intensity * change.log_intensity[k];
  }
  [[nodiscard]] double of(const UnitChange& change) const {
    return by_shift.dot(change.shift_m) + by_growth * change.growth_m +
           by_blur.dot(change.blur_rad2) + by_log_intensity * change.log_intensity;
  }
  /// Turns displacements of a measured point (LiDAR frame), or of the board under it, into
  /// displacements of the print as the beam sees it; what happens along the ray does not count.
  struct Moves {
    Moves(const SceneGeometry& geometry, const Eigen::Matrix3d& lidar_from_board,
          const Eigen::Vector3d& direction)
        : rotation(lidar_from_board) {
      const Eigen::Vector3d& n = geometry.normal();
      const Eigen::Matrix3d along =
          Eigen::Matrix3d::Identity() - direction * n.transpose() / n.dot(direction);
      shift_by_move = lidar_from_board.leftCols<2>().transpose() * along;
    }
    Moves(const SceneGeometry&, Eigen::Matrix3d&&,
          const Eigen::Vector3d&) = delete;  // The rotation is referred to, not kept.
    const Eigen::Matrix3d& rotation;
    Eigen::Matrix<double, 2, 3> shift_by_move;
  };
};

/// Tells a scene's returns apart, in the order of the scan, which is a table's. Rows of the same
/// return have the same beam.
struct ReturnKey {
  explicit ReturnKey(const BeamPoint& beam)
      : time_s(beam.time_s),
        line(beam.line),
        azimuth_rad(beam.azimuth_rad),
        elevation_rad(beam.elevation_rad) {}
  double time_s;
  int line;
  double azimuth_rad, elevation_rad;
  auto operator<=>(const ReturnKey&) const = default;
};

/// Turns what effects move into what rows of one scene measure. Every hook is called for every row,
/// or for every return where that is all it sees; effects write nothing where they have nothing to
/// say.
class EffectRows {
 public:
  EffectRows(const MeasurementTable& table, std::span<const EffectColumns> columns)
      : table_(table), columns_(columns) {
    std::size_t most = 1;
    std::size_t all = 0;
    for (const EffectColumns& c : columns) {
      most = std::max(most, c.parameters.size());
      all += c.parameters.size();
    }
    moves_.resize(all);
    shifts_.resize(all);
    board_.resize(most);
    pixels_.resize(most);
    scalars_.resize(most);
    further_.resize(most);
    outward_.resize(most);
    blur_.resize(most);
    spot_.resize(most);
    lit_.resize(most);
  }

  /// What one unit of each parameter of an effect does to a range: by itself, and by displacing the
  /// print whose edges pull the range, or by letting its black grow.
  struct RangeChange {
    std::span<const double> range_m;
    std::span<const Eigen::Vector2d> shift_m;
    std::span<const double> growth_m;
  };
  /// Movements of a beam's measured point and of the board under it, projected on the row. `edge`:
  /// that in whose blur the return is, if any. What moves the light alone leaves the range.
  template <class Sink>
  void range(const RangeRow& r, const Eigen::Vector3d& row, const PrintSensitivity::Moves& moves,
             const BoundaryRow* edge, Sink&& sink) {
    follow(r.beam, moves);
    for (const EffectColumns& c : columns_) {
      const std::size_t n = c.parameters.size();
      const auto further = cleared(further_, n);
      const auto outward = cleared(outward_, n);
      c.effect->range(r, table_, c.shape, further);
      if (edge != nullptr && !c.print_contrast) c.effect->edge(*edge, table_, c.shape, outward);
      const double sign = c.print_contrast && r.print != Print::kWhite ? -1.0 : 1.0;
      const auto own = of(c, moves_);
      for (std::size_t k = 0; k < n; ++k) scalars_[k] = sign * (row.dot(own[k]) + further[k]);
      sink(c, RangeChange{std::span(scalars_).first(n), of(c, shifts_), outward});
    }
  }

  /// Two rows at once: u and v.
  template <class Sink>
  void corner(const CornerRow& r, const Eigen::Vector2d& normalized,
              const Eigen::Matrix<double, 2, 3>& by_board_move, Sink&& sink) {
    for (const EffectColumns& c : columns_) {
      if (c.print_contrast) continue;
      const std::size_t n = c.parameters.size();
      const auto board = cleared(board_, n);
      const auto pixels = cleared(pixels_, n);
      c.effect->board({r.board_m, r.from_tag_m}, table_.target, c.shape, board);
      c.effect->camera(r, normalized, table_.camera, c.shape, pixels);
      for (std::size_t k = 0; k < n; ++k) pixels[k] += by_board_move * board[k];
      sink(c, pixels);
    }
  }

  /// Of a return beside the print's prediction; `edge`: its row, if it is in the blur of one.
  template <class Sink>
  void reading(const IntensityRow& r, const BoundaryRow* edge, const PrintSensitivity::Moves& moves,
               Sink&& sink) {
    follow(r.beam, moves);
    for (const EffectColumns& c : columns_) {
      const std::size_t n = c.parameters.size();
      const auto log_intensity = cleared(scalars_, n);
      const auto outward = cleared(outward_, n);
      const auto blur = cleared(blur_, n);
      std::span<const Eigen::Vector2d> shifts = of(c, shifts_);
      c.effect->intensity(r, table_, c.shape, log_intensity);
      if (c.print_contrast) {
        // A difference between the prints: edges have both.
        const bool plain = edge == nullptr || (edge->beam.edge && edge->beam.edge->plain);
        for (std::size_t k = 0; k < n; ++k)
          log_intensity[k] *= !plain ? 0.0 : r.print == Print::kWhite ? 1.0 : -1.0;
      } else {
        c.effect->blur(r.beam, table_, c.shape, blur);
        if (edge != nullptr) c.effect->edge(*edge, table_, c.shape, outward);
        // What moves the light alone adds to what moves the whole return.
        const auto spot = cleared(spot_, n);
        c.effect->spot(r.beam, table_, c.shape, spot);
        if (std::any_of(spot.begin(), spot.end(),
                        [](const auto& move) { return !move.isZero(0.0); })) {
          for (std::size_t k = 0; k < n; ++k) lit_[k] = shift_of(of(c, moves_)[k] + spot[k], moves);
          shifts = std::span(lit_).first(n);
        }
      }
      sink(c, PrintSensitivity::Change{shifts, outward, blur, log_intensity});
    }
  }

 private:
  // What all rows of a return have in common: how it moves, and the print under it.
  void follow(const BeamPoint& beam, const PrintSensitivity::Moves& moves) {
    const ReturnKey key(beam);
    if (last_ == key) return;
    last_ = key;
    std::fill(moves_.begin(), moves_.end(), Eigen::Vector3d::Zero());
    for (const EffectColumns& c : columns_) {
      const auto own = of(c, moves_);
      c.effect->lidar(beam, table_, c.shape, own);
      const auto board = cleared(board_, own.size());
      c.effect->board({beam.board_m, Eigen::Vector2d::Zero()}, table_.target, c.shape, board);
      const auto shifts = of(c, shifts_);
      for (std::size_t k = 0; k < own.size(); ++k) {
        if (!board[k].isZero(0.0)) own[k] += moves.rotation * board[k];
        shifts[k].setZero();
        if (!c.print_contrast && !own[k].isZero(0.0)) shifts[k] = shift_of(own[k], moves);
      }
    }
  }
  // Room for what an effect's hook writes. Most write nothing: it is mostly zero as it is.
  template <class T>
  static std::span<T> cleared(std::vector<T>& room, std::size_t count) {
    const std::span<T> out = std::span(room).first(count);
    for (T& value : out) {
      if constexpr (std::is_arithmetic_v<T>) {
        if (value != T{}) value = T{};
      } else {
        if (!value.isZero(0.0)) value.setZero();
      }
    }
    return out;
  }
  // An effect's own of what is kept for all columns.
  template <class T>
  std::span<T> of(const EffectColumns& c, std::vector<T>& all) const {
    return std::span(all).subspan(static_cast<std::size_t>(c.first - columns_.front().first),
                                  c.parameters.size());
  }
  static Eigen::Vector2d shift_of(const Eigen::Vector3d& move,
                                  const PrintSensitivity::Moves& moves) {
    Eigen::Vector2d shift = moves.shift_by_move * move;
    // What is left of a move along the ray is rounding.
    if (shift.squaredNorm() < 1e-18 * move.squaredNorm()) shift.setZero();
    return shift;
  }

  const MeasurementTable& table_;
  std::span<const EffectColumns> columns_;
  // Of all columns, as the last return moves, and which that was.
  std::vector<Eigen::Vector3d> moves_;
  std::vector<Eigen::Vector2d> shifts_;
  std::optional<ReturnKey> last_;
  // Of one effect.
  std::vector<Eigen::Vector3d> board_;
  std::vector<Eigen::Vector2d> pixels_;
  std::vector<double> scalars_;
  std::vector<double> outward_;
  std::vector<double> further_;
  std::vector<Eigen::Vector3d> blur_;
  std::vector<Eigen::Vector3d> spot_;
  std::vector<Eigen::Vector2d> lit_;
};

/// A corner's prediction and derivatives.
struct CornerPrediction {
  Eigen::Vector2d residual;
  Eigen::Vector2d normalized;
  Eigen::Matrix<double, 2, 3> by_board_move;
  Eigen::Matrix<double, 2, 6> by_pose;
};

/// Measured minus predicted; nothing if the camera cannot image the corner.
std::optional<CornerPrediction> predict(const CornerRow& row, const Camera& camera,
                                        const Rigid3& camera_from_board);

/// Black that returns next to nothing has no logarithm: this share of white stands for it.
inline constexpr double kLeastShare = 0.01;

/// ln(white / black) of a scene's levels.
double log_contrast(const BoardLevels& levels);

/// The edge in whose blur a return is, as the hooks of effects see it; its reading is left empty.
std::optional<BoundaryRow> edge_beside(const BeamPoint& beam, double log_contrast);

/// The columns of effects in use, in their order.
EffectColumnsList columns_in_use(const std::vector<EffectInUse>& in_use,
                                 const MeasurementTable& table);

}  // namespace lvcalib
