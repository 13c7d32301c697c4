// SPDX-License-Identifier: BSD-3-Clause
#include "model/linear_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "model/catalogue_effect.h"
#include "model/effect_rows.h"
#include "model/fitted_model.h"
#include "model/print_rows.h"
#include "model/row_sums.h"
#include "model/scene_geometry.h"

namespace lvcalib {
namespace {

constexpr double kPatch_m = 0.2;  // As in the joint solve: about a tag's size.

int index_in(const std::vector<int>& list, int value) {
  const auto at = std::find(list.begin(), list.end(), value);
  return at == list.end() ? -1 : static_cast<int>(at - list.begin());
}

LocalLayout layout_of(const MeasurementTable& table, std::size_t scene) {
  LocalLayout layout;
  layout.patches = BoardPatches(table.print->outline(), kPatch_m);
  layout.lines = table.lines.size() > 1 ? static_cast<int>(table.lines.size()) : 0;
  layout.corner_groups = table.target.has_tags()
                             ? static_cast<int>(table.scenes[scene].features.size())
                             : layout.patches.count();
  return layout;
}

// How many of the columns, from the first on, are those of the effects in use: what these do is
// told with the rows' predictions.
std::size_t columns_of_effects_in_use(const std::vector<EffectColumns>& columns,
                                      const std::vector<EffectInUse>& in_use) {
  if (columns.size() < in_use.size()) return 0;
  for (std::size_t k = 0; k < in_use.size(); ++k) {
    const EffectColumns& c = columns[k];
    if (c.effect != in_use[k].effect || c.shape != in_use[k].shape || c.print_contrast) return 0;
  }
  return in_use.size();
}

int scene_of(const CornerRow& row) {
  return row.scene;
}
template <class Row>
int scene_of(const Row& row) {
  return row.beam.scene;
}

// Rows are grouped by scene, in the order of the scenes: only the scene's own are touched.
template <class Row>
std::span<const Row> rows_of(const std::vector<Row>& rows, int scene) {
  const auto first = std::partition_point(rows.begin(), rows.end(),
                                          [&](const Row& row) { return scene_of(row) < scene; });
  const auto last = std::partition_point(first, rows.end(),
                                         [&](const Row& row) { return scene_of(row) == scene; });
  return {first, last};
}

// Rows of a scene, or a part of them.
struct PartRows {
  std::span<const RangeRow> range;
  std::span<const BoundaryRow> boundary;
  std::span<const IntensityRow> intensity;
  std::span<const CornerRow> corner;

  [[nodiscard]] std::size_t of_returns() const {
    return range.size() + boundary.size() + intensity.size();
  }
  [[nodiscard]] std::size_t size() const { return of_returns() + corner.size(); }
  // The return that comes first.
  [[nodiscard]] ReturnKey next_return() const {
    std::optional<ReturnKey> out;
    const auto ask = [&out](const auto& rows) {
      if (rows.empty()) return;
      const ReturnKey key(rows.front().beam);
      if (!out || key < *out) out = key;
    };
    ask(range);
    ask(boundary);
    ask(intensity);
    return *out;
  }
  // Corners, and the returns before one: these are the others from then on.
  PartRows take_before(const ReturnKey& end) {
    const auto take = [&end](auto& rows) {
      const auto at = std::partition_point(
          rows.begin(), rows.end(), [&](const auto& row) { return ReturnKey(row.beam) < end; });
      const auto out = rows.first(static_cast<std::size_t>(at - rows.begin()));
      rows = rows.subspan(out.size());
      return out;
    };
    return {take(range), take(boundary), take(intensity), std::exchange(corner, {})};
  }
};

PartRows rows_of(const MeasurementTable& table, int scene, const ChannelMask& channels) {
  const auto take = [&](Channel channel, const auto& rows, auto& to) {
    if (channels[static_cast<std::size_t>(channel)]) to = rows_of(rows, scene);
  };
  PartRows out;
  take(Channel::kRange, table.range, out.range);
  take(Channel::kBoundary, table.boundary, out.boundary);
  take(Channel::kIntensity, table.intensity, out.intensity);
  take(Channel::kCorner, table.corner, out.corner);
  return out;
}

// Accumulates rows of one scene.
class SceneAccumulator {
 public:
  // The model must outlive it.
  SceneAccumulator(const FittedModel& model, const EffectColumnsList& columns,
                   const LocalLayout& layout, std::size_t scene, PrintMemory* memory)
      : table_(model.table),
        memory_(memory),
        scene_(static_cast<int>(scene)),
        geometry_(model.state.camera_from_lidar, model.state.camera_from_board[scene]),
        camera_from_board_(model.state.camera_from_board[scene]),
        rotation_(geometry_.lidar_from_board().rotation.toRotationMatrix()),
        in_use_(model.effects),
        in_use_columns_(columns_in_use(model.effects, model.table)),
        used_rows_(model.table, in_use_columns_.list()),
        told_(columns_of_effects_in_use(columns.list(), model.effects)),
        candidate_rows_(model.table, std::span(columns.list()).subspan(told_)),
        corner_rows_(model.table, columns.list()),
        // Others than those in use may let black grow.
        print_(model.table, model.state, scene, model.effects,
               columns.list().size() > model.effects.size()),
        log_contrast_(log_contrast(model.state.levels[scene])),
        layout_(layout),
        extrinsic_(layout.size()),
        effects_(extrinsic_ + 6),
        residual_(effects_ + columns.columns()) {
    for (std::size_t c = 0; c < kChannels; ++c)
      sums_.emplace_back(residual_ + 1, columns.columns());
  }

  // Sums the rows into the upper triangles. Those of one return follow each other: what its beam
  // says is asked once.
  std::array<ChannelSums, kChannels> sums_of(PartRows rows) {
    for (const CornerRow& row : rows.corner) corner(row);
    while (rows.of_returns() > 0) {
      const ReturnKey next = rows.next_return();
      const auto visit = [&next](auto& left, const auto& add) {
        for (; !left.empty() && !(next < ReturnKey(left.front().beam)); left = left.subspan(1))
          add(left.front());
      };
      visit(rows.range, [&](const RangeRow& row) { range(row); });
      visit(rows.boundary, [&](const BoundaryRow& row) {
        const Print side = row.beam.darkness < 0.5 ? Print::kWhite : Print::kBlack;
        reading({row.beam, side, 0.0, row.sigma_m, row.reading}, &row);
      });
      visit(rows.intensity, [&](const IntensityRow& row) { reading(row, nullptr); });
    }
    std::array<ChannelSums, kChannels> out;
    for (std::size_t c = 0; c < kChannels; ++c) out[c] = sums_[c].sums();
    return out;
  }

 private:
  void set_pose(const Vector6d& by_pose) {
    for (int k = 0; k < 6; ++k) row_->set(k, by_pose(k));
  }
  void finish(double residual, double sigma) {
    row_->set(residual_, residual);
    row_->finish(1.0 / (sigma * sigma));
  }

  void range(const RangeRow& r) {
    const auto row = print_.range(r, seen(r, table_.range, &PrintMemory::range));
    if (!row) return;
    begin(Channel::kRange, *row);
    BoardPolynomials z{};
    board_polynomials(on_unit_square(r.beam.board_m, table_.target), z);
    for (int k = 0; k < LocalLayout::kRangeTerms; ++k)
      row_->set(LocalLayout::kFixed + k, z[static_cast<std::size_t>(3 + k)]);
    const int line = line_of(r.beam);
    if (line >= 0) row_->set(layout_.line_column() + line, 1.0);
    const auto edge = edge_beside(r.beam, log_contrast_);
    const BoundaryRow* const beside = edge ? &*edge : nullptr;
    const PrintSensitivity::Moves moves(geometry_, rotation_, r.beam.direction);
    for (std::size_t k = 0; k < parameters_told(); ++k) {
      const UnitChange& by = print_.by_parameters()[k];
      row_->set(effects_ + static_cast<int>(k), by.range_m + row->range_by_shift.dot(by.shift_m) +
                                                    row->range_by_growth * by.growth_m);
    }
    candidate_rows_.range(r, geometry_.range_row(r.beam.direction), moves, beside,
                          [&](const EffectColumns& c, const EffectRows::RangeChange& by) {
                            for (std::size_t k = 0; k < by.range_m.size(); ++k) {
                              row_->set(effects_ + c.first + static_cast<int>(k),
                                        by.range_m[k] + row->range_by_shift.dot(by.shift_m[k]) +
                                            row->range_by_growth * by.growth_m[k]);
                            }
                          });
    finish(row->residual, r.sigma_m);
  }

  [[nodiscard]] std::size_t parameters_told() const {
    return told_ > 0 ? print_.by_parameters().size() : 0;
  }
  void begin(Channel channel) { row_ = &sums_[static_cast<std::size_t>(channel)]; }
  void begin(Channel channel, const PrintRow& row) {
    begin(channel);
    set_pose(row.by_board_pose);
    for (int k = 0; k < LocalLayout::kLevels; ++k)
      row_->set(LocalLayout::kPose + k, row.by_levels(k));
  }
  [[nodiscard]] int line_of(const BeamPoint& beam) const {
    return layout_.lines > 0 ? index_in(table_.lines, beam.line) : -1;
  }
  [[nodiscard]] int patch_of(const Eigen::Vector2d& board_m) const {
    return layout_.patches.of(table_.print->outline(), board_m);
  }

  void reading(const IntensityRow& r, const BoundaryRow* edge) {
    const auto row = edge != nullptr
                         ? print_.edge(*edge, seen(*edge, table_.boundary, &PrintMemory::boundary))
                         : print_.intensity(r, seen(r, table_.intensity, &PrintMemory::intensity));
    if (!row) return;
    begin(edge != nullptr ? Channel::kBoundary : Channel::kIntensity, *row);
    const int patch = layout_.patch_column() + 2 * patch_of(r.beam.board_m);
    row_->set(patch, row->print.by_shift(0));
    row_->set(patch + 1, row->print.by_shift(1));
    const int line = line_of(r.beam);
    if (line >= 0)
      row_->set(layout_.line_column() + layout_.lines + line, row->print.by_log_intensity);
    const auto trace = edge == nullptr ? edge_beside(r.beam, log_contrast_) : std::nullopt;
    if (trace) edge = &*trace;
    const PrintSensitivity::Moves moves(geometry_, rotation_, r.beam.direction);
    for (std::size_t k = 0; k < parameters_told(); ++k) {
      const UnitChange& by = print_.by_parameters()[k];
      row_->set(effects_ + static_cast<int>(k), row->print.of(by));
    }
    candidate_rows_.reading(
        r, edge, moves, [&](const EffectColumns& c, const PrintSensitivity::Change& by) {
          for (std::size_t k = 0; k < by.shift_m.size(); ++k)
            row_->set(effects_ + c.first + static_cast<int>(k), row->print.of(by, k));
        });
    finish(row->residual, r.sigma);
  }

  void corner(const CornerRow& r) {
    const auto p = predict(r, table_.camera, camera_from_board_);
    if (!p) return;
    Eigen::Vector2d residual = p->residual;
    used_rows_.corner(r, p->normalized, p->by_board_move,
                      [&](const EffectColumns& c, std::span<const Eigen::Vector2d> by) {
                        const auto& use =
                            in_use_[static_cast<std::size_t>(&c - in_use_columns_.list().data())];
                        for (std::size_t k = 0; k < by.size(); ++k)
                          residual -= by[k] * use.values(static_cast<Eigen::Index>(k));
                      });
    // Corners of one tag err together; without tags those of one patch.
    const int group =
        table_.target.has_tags()
            ? index_in(table_.scenes[static_cast<std::size_t>(scene_)].features, r.feature)
            : patch_of(r.board_m);
    for (int axis = 0; axis < 2; ++axis) {
      begin(Channel::kCorner);
      set_pose(p->by_pose.row(axis).transpose());
      row_->set(layout_.corner_column() + 2 * group + axis, 1.0);
      corner_rows_.corner(r, p->normalized, p->by_board_move,
                          [&](const EffectColumns& c, std::span<const Eigen::Vector2d> by) {
                            for (std::size_t k = 0; k < by.size(); ++k)
                              row_->set(effects_ + c.first + static_cast<int>(k), by[k](axis));
                          });
      finish(residual(axis), r.sigma_px);
    }
  }

  // Where a row remembers the print.
  template <class Row>
  LocalPrint* seen(const Row& row, const std::vector<Row>& rows,
                   std::vector<LocalPrint> PrintMemory::*places) const {
    if (memory_ == nullptr) return nullptr;
    return &(memory_->*places)[static_cast<std::size_t>(&row - rows.data())];
  }

  const MeasurementTable& table_;
  PrintMemory* memory_;
  int scene_;
  SceneGeometry geometry_;
  Rigid3 camera_from_board_;
  Eigen::Matrix3d rotation_;
  const std::vector<EffectInUse>& in_use_;
  EffectColumnsList in_use_columns_;
  EffectRows used_rows_;
  std::size_t told_;           // Columns whose derivatives come with a row's prediction;
  EffectRows candidate_rows_;  // the others'.
  EffectRows corner_rows_;
  PrintRows print_;
  double log_contrast_;
  const LocalLayout& layout_;
  int extrinsic_;  // First columns.
  int effects_;
  int residual_;
  std::vector<RowSums> sums_;  // By channel.
  RowSums* row_ = nullptr;     // That of the row at hand.
};

// What one thread does at a time.
struct Task {
  std::size_t scene;
  PartRows rows;
  std::array<ChannelSums, kChannels> sums = {};
};

// Parts of a scene's rows that are long beside what adding them up costs: sums over many columns
// are some megabytes each, and wait for the others.
void add_tasks(std::size_t scene, PartRows rows, std::vector<Task>& tasks) {
  constexpr std::size_t kRows = 65536;  // Halves of 26 000 hold 100 MB more in a search, for 3 %.
  const std::size_t parts = rows.range.empty() ? 1 : 1 + rows.size() / kRows;
  const std::span<const RangeRow> range = rows.range;
  for (std::size_t k = 1; k < parts; ++k)
    tasks.push_back({scene, rows.take_before(ReturnKey(range[k * range.size() / parts].beam))});
  tasks.push_back({scene, rows});
}

// Turns a derivative by the board's pose into that by the board's motion between camera and LiDAR
// about its middle, board axes: shift (2), along the normal, tilt (2), spin.
Matrix6d board_motion_by_pose(const SceneGeometry& geometry, const Eigen::Vector2d& center_m) {
  Matrix6d by_camera;
  for (int k = 0; k < 6; ++k)
    by_camera.col(k) = geometry.by_camera_pose(Vector6d::Unit(static_cast<Eigen::Index>(k)));
  return board_motion(geometry.lidar_from_board(), center_m).transpose() * by_camera.inverse();
}

// What the LiDAR measures depends on the extrinsic and on the board's motion through the board's
// pose in its frame alone: these columns are the pose's, transformed, and need no sums of their
// own.
void fill_what_follows_from_the_pose(const LocalLayout& layout, const Matrix6d& motion,
                                     Eigen::MatrixXd& products) {
  const int board = layout.board_column();
  const int extrinsic = layout.size();
  products.middleRows<6>(extrinsic) = -products.topRows<6>();
  products.middleRows<6>(board) = motion * products.topRows<6>();
  products.middleCols<6>(extrinsic) = -products.leftCols<6>();
  products.middleCols<6>(board) = products.leftCols<6>() * motion.transpose();
}

void add(std::array<ChannelSums, kChannels>&& parts, SceneProducts& out) {
  for (std::size_t c = 0; c < kChannels; ++c) {
    ChannelSums& part = parts[c];
    if (part.rows == 0) continue;
    if (out.rows[c] == 0) {
      out.products[c] = std::move(part.products);
      out.fourth_powers[c] = std::move(part.fourth_powers);
    } else {
      out.products[c] += part.products;
      out.fourth_powers[c] += part.fourth_powers;
    }
    out.rows[c] += part.rows;
  }
}

// From the upper triangles of the sums over rows.
void complete(const SceneGeometry& geometry, const Eigen::Vector2d& center_m, int effects,
              SceneProducts& out) {
  const Matrix6d motion = board_motion_by_pose(geometry, center_m);
  for (const Channel channel : kAllChannels) {
    const auto at = static_cast<std::size_t>(channel);
    Eigen::MatrixXd& products = out.products[at];
    if (out.rows[at] == 0) {
      products.setZero(out.layout.size() + 6 + effects + 1, out.layout.size() + 6 + effects + 1);
      out.fourth_powers[at].setZero(effects);
      continue;
    }
    products.triangularView<Eigen::StrictlyLower>() = products.transpose();
    if (channel != Channel::kCorner) fill_what_follows_from_the_pose(out.layout, motion, products);
  }
}

}  // namespace

BoardPatches::BoardPatches(const BoardOutline& outline, double side_m)
    : columns(std::max(1, static_cast<int>(std::ceil(outline.size_m().x() / side_m)))),
      rows(std::max(1, static_cast<int>(std::ceil(outline.size_m().y() / side_m)))) {}

int BoardPatches::of(const BoardOutline& outline, const Eigen::Vector2d& board_m) const {
  const Eigen::Vector2d t = (board_m - outline.lower_left_m).cwiseQuotient(outline.size_m());
  const int x = std::clamp(static_cast<int>(t.x() * columns), 0, columns - 1);
  const int y = std::clamp(static_cast<int>(t.y() * rows), 0, rows - 1);
  return y * columns + x;
}

void board_polynomials(const Eigen::Vector2d& unit, BoardPolynomials& out) {
  const auto legendre = [](double x) {
    const double x2 = x * x;
    return std::array<double, 5>{1.0, x, 0.5 * (3 * x2 - 1), 0.5 * x * (5 * x2 - 3),
                                 0.125 * (35 * x2 * x2 - 30 * x2 + 3)};
  };
  const auto px = legendre(unit.x());
  const auto py = legendre(unit.y());
  std::size_t k = 0;
  for (std::size_t degree = 0; degree <= 4; ++degree) {
    for (std::size_t j = 0; j <= degree; ++j) out[k++] = px[degree - j] * py[j];
  }
}

void EffectColumnsList::add(const EffectPtr& effect, double shape, const MeasurementTable& table) {
  add({effect, shape, effect->parameters(table), 0, effect->zero_sums(table)});
}

void EffectColumnsList::add(EffectColumns columns) {
  columns.first = columns_;
  columns_ += columns.count();
  list_.push_back(std::move(columns));
}

void EffectColumnsList::add_print_contrast(const EffectPtr& effect, double shape,
                                           const MeasurementTable& table) {
  add(effect, shape, table);
  list_.back().print_contrast = true;
}

std::pair<int, int> LocalLayout::columns_of(VarianceGroup group) const {
  switch (group) {
    case VarianceGroup::kRangeShape:
      return {kFixed, kRangeTerms};
    case VarianceGroup::kCornerGroup:
      return {corner_column(), 2 * corner_groups};
    case VarianceGroup::kBoardShift:
      return {board_column(), 2};
    case VarianceGroup::kBoardNormal:
      return {board_column() + 2, 1};
    case VarianceGroup::kBoardTilt:
      return {board_column() + 3, 2};
    case VarianceGroup::kBoardSpin:
      return {board_column() + 5, 1};
    case VarianceGroup::kPrintPatch:
      return {patch_column(), 2 * patches.count()};
    case VarianceGroup::kLineRange:
      return {line_column(), lines};
    case VarianceGroup::kLineGain:
      break;
  }
  return {line_column() + lines, lines};
}

PrintMemory::PrintMemory(const MeasurementTable& table) {
  range.reserve(table.range.size());
  boundary.reserve(table.boundary.size());
  intensity.reserve(table.intensity.size());
  for (const RangeRow& row : table.range) range.push_back(row.seen);
  for (const BoundaryRow& row : table.boundary) boundary.push_back(row.reading.seen);
  for (const IntensityRow& row : table.intensity) intensity.push_back(row.reading.seen);
}

Linearization linearize(const MeasurementTable& table, const ModelState& state,
                        const std::vector<EffectInUse>& in_use, const EffectColumnsList& columns,
                        const RunContext& context, const RowsTaken& rows) {
  const FittedModel model{table, state, in_use};
  Linearization out;
  out.columns = columns;
  out.scenes.resize(table.scenes.size());
  for (std::size_t s = 0; s < out.scenes.size(); ++s) {
    out.scenes[s].layout = layout_of(table, s);
    out.scenes[s].inflation = table.scenes[s].inflation;
  }
  std::vector<Task> tasks;
  for (std::size_t s = 0; s < out.scenes.size(); ++s)
    add_tasks(s, rows_of(table, static_cast<int>(s), rows.channels), tasks);
  // The longest first, so that all threads end together.
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return tasks[a].rows.size() > tasks[b].rows.size();
  });
  parallel_for(tasks.size(), context.thread_count(), [&](std::size_t k) {
    Task& task = tasks[order[k]];
    if (context.stopped()) return;
    task.sums =
        SceneAccumulator(model, columns, out.scenes[task.scene].layout, task.scene, rows.memory)
            .sums_of(task.rows);
  });
  for (Task& task : tasks) add(std::move(task.sums), out.scenes[task.scene]);
  parallel_for(out.scenes.size(), context.thread_count(), [&](std::size_t s) {
    complete(SceneGeometry(state.camera_from_lidar, state.camera_from_board[s]),
             table.print->outline().center_m(), columns.columns(), out.scenes[s]);
  });
  if (context.stopped()) out.scenes.assign(table.scenes.size(), {});
  return out;
}

double Linearization::acting_share(Channel channel, int effect_column) const {
  const auto at = static_cast<std::size_t>(channel);
  double squares = 0.0;
  double fourth = 0.0;
  double rows = 0.0;
  for (const SceneProducts& s : scenes) {
    const int column = s.layout.size() + 6 + effect_column;
    squares += s.products[at](column, column);
    fourth += s.fourth_powers[at](effect_column);
    rows += s.rows[at];
  }
  if (!(fourth > 0.0)) return 0.0;
  return std::min(1.0, 3.0 * squares * squares / (rows * fourth));
}

double Linearization::squares(Channel channel, int effect_column) const {
  double sum = 0.0;
  for (const SceneProducts& s : scenes) {
    const int column = s.layout.size() + 6 + effect_column;
    sum += s.products[static_cast<std::size_t>(channel)](column, column);
  }
  return sum;
}

Linearization picked(const Linearization& linear, const std::vector<std::size_t>& effects) {
  Linearization out;
  std::vector<int> columns;
  for (const std::size_t k : effects) {
    EffectColumns c = linear.columns.list()[k];
    for (int p = 0; p < c.count(); ++p) columns.push_back(c.first + p);
    out.columns.add(std::move(c));
  }
  for (const SceneProducts& from : linear.scenes) {
    SceneProducts& to = out.scenes.emplace_back();
    to.layout = from.layout;
    to.rows = from.rows;
    to.inflation = from.inflation;
    const int effects_at = from.layout.size() + 6;
    std::vector<int> places(static_cast<std::size_t>(effects_at));
    std::iota(places.begin(), places.end(), 0);
    for (const int column : columns) places.push_back(effects_at + column);
    places.push_back(effects_at + linear.effect_columns());  // The residual.
    for (std::size_t c = 0; c < kChannels; ++c) {
      to.products[c] = from.products[c](places, places);
      to.fourth_powers[c] = from.fourth_powers[c](columns);
    }
  }
  return out;
}

ModelState moved(const ModelState& state, const Vector6d& extrinsic,
                 const std::vector<Vector6d>& boards) {
  ModelState out = state;
  out.camera_from_lidar = se3_exp(extrinsic) * state.camera_from_lidar;
  out.camera_from_board.clear();
  for (std::size_t s = 0; s < boards.size(); ++s)
    out.camera_from_board.push_back(se3_exp(boards[s]) * state.camera_from_board[s]);
  return out;
}

}  // namespace lvcalib
