// SPDX-License-Identifier: BSD-3-Clause
#include "solve/print_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/noise_floor.h"
#include "model/scan_velocity.h"
#include "model/sensor_errors.h"
#include "solve/scene_rows.h"

namespace lvcalib {
namespace {

// The joint solve's variances by the groups of the search; what was not admitted there stays
// absent.
std::vector<double> structure_variances(const ForwardNoise& noise) {
  std::vector<double> out(kAbsentVariance.begin(), kAbsentVariance.end());
  const auto take = [&](VarianceGroup to, SharedError from) {
    if (noise.admitted[static_cast<std::size_t>(from)])
      out[static_cast<std::size_t>(to)] = noise.shared[static_cast<std::size_t>(from)];
  };
  take(VarianceGroup::kRangeShape, SharedError::kRangeShape);
  take(VarianceGroup::kCornerGroup, SharedError::kCornerGroup);
  take(VarianceGroup::kBoardShift, SharedError::kBoardShift);
  take(VarianceGroup::kBoardNormal, SharedError::kBoardNormal);
  take(VarianceGroup::kBoardTilt, SharedError::kBoardTilt);
  take(VarianceGroup::kBoardSpin, SharedError::kBoardSpin);
  take(VarianceGroup::kPrintPatch, SharedError::kPrintPatch);
  take(VarianceGroup::kLineRange, SharedError::kLineRange);
  take(VarianceGroup::kLineGain, SharedError::kLineGain);
  return out;
}

// The same of the sensor's errors.
std::vector<double> sensor_variances(const ForwardNoise& noise) {
  std::vector<double> out;
  for (const SharedError kind :
       {SharedError::kSensorRange, SharedError::kSensorDark, SharedError::kSensorLine}) {
    const auto k = static_cast<std::size_t>(kind);
    out.push_back(noise.admitted[k] ? noise.shared[k] : kAbsentSensorError);
  }
  return out;
}

// One channel's rows of all scenes, in their order; those of the scenes are gone.
template <class Row>
void gather(std::vector<Row> TableRows::*rows, std::vector<TableRows>& scenes,
            std::vector<Row>& to) {
  std::size_t count = 0;
  for (const TableRows& scene : scenes) count += (scene.*rows).size();
  to.reserve(count);
  for (TableRows& scene : scenes) {
    to.insert(to.end(), (scene.*rows).begin(), (scene.*rows).end());
    (scene.*rows) = {};
  }
}

// Makes the table of some scenes, and makes it again for other states and effects in use.
class TableMaker {
 public:
  TableMaker(const TableInput& input, const TableOptions& options, const RunContext& context)
      : input_(input), options_(options), scenes_(input.scenes.size()) {
    parallel_for(scenes_.size(), context.thread_count(), [&](std::size_t s) {
      KeptScene& scene = scenes_[s];
      scene.measured = input.scenes[s];
      scene.cloud = *input.scenes[s].board_points;
      scene.measured.board_points = &scene.cloud;
      scene.scan_rad_s = scan_velocities(scene.cloud);
    });
    input_.scenes.clear();
  }
  TableMaker(const TableMaker&) = delete;
  TableMaker& operator=(const TableMaker&) = delete;

  // Keeps what tables that replace it are like. Incomplete when stopped.
  MeasurementTable first(const ModelState& state, const RunContext& context) {
    MeasurementTable table = without_rows({}, state);
    Rows rows = see(table, {}, nullptr, context);
    if (context.stopped()) return table;
    tell_levels(rows, table);
    seen_.resize(scenes_.size());
    fill(rows, state, &seen_, context, table);
    if (all_have_lines()) tell_lines(table);
    if (!context.stopped()) like_ = table.without_rows();
    return table;
  }

  [[nodiscard]] MeasurementTable again(const ModelState& state,
                                       const std::vector<EffectInUse>& in_use,
                                       const RunContext& context) const {
    MeasurementTable table = without_rows(like_, state);
    Rows rows = see(table, in_use, &seen_, context);
    if (context.stopped()) return table;
    if (table.has_intensity) tell_jitter(state, rows, table);
    fill(rows, state, nullptr, context, table);
    return table;
  }

 private:
  using Rows = std::vector<std::optional<SceneRows>>;
  using Seen = std::vector<std::vector<LocalPrint>>;

  [[nodiscard]] MeasurementTable without_rows(MeasurementTable table,
                                              const ModelState& state) const {
    const ForwardNoise& noise = input_.noise;
    table.scenes.clear();
    table.print = input_.print;
    table.target = input_.print->target();
    table.camera = input_.camera;
    table.placed_by = state;
    table.structure_variances = structure_variances(noise);
    table.sensor_variances = sensor_variances(noise);
    table.has_time = !scenes_.empty();
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      TableScene scene;
      scene.name = scenes_[s].measured.name;
      scene.clock = scene_clock(s, scenes_.size());
      scene.inflation[static_cast<std::size_t>(Channel::kRange)] = noise.scenes[s].range_inflation;
      for (const Channel channel : {Channel::kBoundary, Channel::kIntensity})
        scene.inflation[static_cast<std::size_t>(channel)] = noise.scenes[s].intensity_inflation;
      table.scenes.push_back(std::move(scene));
      table.has_time = table.has_time && scenes_[s].cloud.has_time();
      SceneGeometry(state.camera_from_lidar, state.camera_from_board[s])
          .tell_middle(table.target.outline().center_m(), table.scenes.back());
    }
    return table;
  }

  // `known`: the print as every return saw it before; may be null.
  [[nodiscard]] Rows see(const MeasurementTable& table, const std::vector<EffectInUse>& in_use,
                         const Seen* known, const RunContext& context) const {
    Rows rows(scenes_.size());
    parallel_for(scenes_.size(), context.thread_count(), [&](std::size_t s) {
      if (context.stopped()) return;
      rows[s].emplace(scenes_[s], static_cast<int>(s), input_.noise.scenes[s], table, in_use,
                      known != nullptr ? &(*known)[s] : nullptr);
    });
    return rows;
  }

  static void tell_levels(const Rows& rows, MeasurementTable& table) {
    std::vector<double> white;
    std::vector<double> black;
    table.has_intensity = !rows.empty();
    for (const auto& scene : rows) {
      table.has_intensity = table.has_intensity && scene->has_intensity();
      white.push_back(scene->levels().white);
      black.push_back(std::max(scene->levels().black, kLeastShare * scene->levels().white));
    }
    if (!table.has_intensity) return;
    table.level = {median(white), median(black)};
    table.log_contrast = std::log(table.level[0] / table.level[1]);
  }

  // What an effect explains is no jitter.
  static void tell_jitter(const ModelState& state, Rows& rows, MeasurementTable& table) {
    JitterRegression jitter;
    for (const auto& scene : rows) jitter.add(scene->scatter());
    const auto found = jitter.jitter_rad2(state.beam.blur_rad2);
    if (!found) return;
    table.placed_by.beam.jitter_rad2 = *found;
    for (auto& scene : rows) scene->set_jitter(*found);
  }

  [[nodiscard]] bool all_have_lines() const {
    return !scenes_.empty() && std::all_of(scenes_.begin(), scenes_.end(),
                                           [](const KeptScene& s) { return s.cloud.has_line(); });
  }

  static void tell_lines(MeasurementTable& table) {
    for (const RangeRow& row : table.range) table.lines.push_back(row.beam.line);
    std::sort(table.lines.begin(), table.lines.end());
    table.lines.erase(std::unique(table.lines.begin(), table.lines.end()), table.lines.end());
  }

  // Every row; `seen`, if wanted, becomes the print as every return saw it.
  void fill(Rows& rows, const ModelState& state, Seen* seen, const RunContext& context,
            MeasurementTable& table) const {
    std::vector<TableRows> lidar(rows.size());
    parallel_for(rows.size(), context.thread_count(), [&](std::size_t s) {
      lidar[s] = rows[s]->rows(table, static_cast<std::size_t>(options_.max_rows_per_scene));
      if (seen != nullptr) (*seen)[s] = rows[s]->seen();
      rows[s].reset();
    });
    for (std::size_t s = 0; s < scenes_.size(); ++s)
      add_corners(scenes_[s].measured, static_cast<int>(s), state, input_.sigma_px, table);
    const std::array<std::function<void()>, 3> channels{
        [&] { gather(&TableRows::range, lidar, table.range); },
        [&] { gather(&TableRows::boundary, lidar, table.boundary); },
        [&] { gather(&TableRows::intensity, lidar, table.intensity); }};
    parallel_for(channels.size(), context.thread_count(), [&](std::size_t k) { channels[k](); });
    const double noise_px = corner_noise(table, state, input_.sigma_px);
    for (CornerRow& row : table.corner) row.sigma_px = noise_px;
  }

  TableInput input_;  // But for its scenes:
  TableOptions options_;
  std::vector<KeptScene> scenes_;
  // The first table without its rows, to whose usual levels and lines effects in use refer,
  MeasurementTable like_;
  Seen seen_;  // and the print as its returns saw it.
};

}  // namespace

void add_corners(const SceneMeasurements& input, int scene, const ModelState& state,
                 double sigma_px, MeasurementTable& table) {
  TableScene& out = table.scenes[static_cast<std::size_t>(scene)];
  const Rigid3& camera_from_board = state.camera_from_board[static_cast<std::size_t>(scene)];
  for (const CornerObservation& c : input.corners) {
    CornerRow row;
    row.scene = scene;
    row.feature = c.feature_id;
    row.corner = c.corner;
    row.board_m = c.board_m;
    row.pixel = c.pixel;
    row.sigma_px = sigma_px;
    if (const auto tag = table.target.tag(c.feature_id); table.target.has_tags() && tag) {
      row.from_tag_m = c.board_m - tag->center_m;
      const auto center = table.camera.project(
          camera_from_board * Eigen::Vector3d(tag->center_m.x(), tag->center_m.y(), 0.0));
      if (center) row.from_tag_px = c.pixel - *center;
    }
    if (std::find(out.features.begin(), out.features.end(), c.feature_id) == out.features.end())
      out.features.push_back(c.feature_id);
    table.corner.push_back(row);
  }
}

MeasurementTable print_table(const TableInput& input, const ModelState& state,
                             const TableOptions& options, const RunContext& context) {
  const auto maker = std::make_shared<TableMaker>(input, options, context);
  MeasurementTable table = maker->first(state, context);
  if (context.stopped()) return table;
  table.again = [maker = std::shared_ptr<const TableMaker>(maker)](
                    const ModelState& at, const std::vector<EffectInUse>& in_use,
                    const RunContext& now) { return maker->again(at, in_use, now); };
  return table;
}

}  // namespace lvcalib
