// SPDX-License-Identifier: BSD-3-Clause
#include "model/correction.h"

#include <algorithm>
#include <cmath>

#include "model/catalogue_effect.h"
#include "model/scan_velocity.h"

namespace lvcalib {
namespace {

constexpr double kSettled_m = 1e-6;
constexpr int kMostRounds = 20;
constexpr std::size_t kBetweenLooks = 8192;

void set_direction(const Eigen::Vector3d& direction, BeamPoint& beam) {
  beam.direction = direction;
  beam.azimuth_rad = std::atan2(direction.y(), direction.x());
  beam.elevation_rad = std::asin(std::clamp(direction.z(), -1.0, 1.0));
}

// A return to try an effect on: number k of three that differ in everything.
BeamPoint probe(int k, const std::vector<int>& lines) {
  BeamPoint b;
  set_direction(Eigen::Vector3d(2.0, 0.7 - 0.6 * k, 0.3 * k - 0.2).normalized(), b);
  b.range_m = 1.7 + 1.3 * k;
  b.incidence_rad = 0.3 + 0.2 * k;
  b.slope_rad = 0.4 * k;
  b.darkness = 0.3 * k;
  b.time_s = 0.02 * (k + 1);
  b.scan_rad_s = {20.0 - 7.0 * k, 5.0 * k - 8.0};
  b.line = lines[static_cast<std::size_t>(k) % lines.size()];
  return b;
}

Error missing(const std::string& id, const std::string& field) {
  return Error::input(
      Message("the effect '%1' cannot be taken out: there is no %2 in this cloud", id, field), {},
      Message("record the cloud with %1, or leave the effect in with --skip %2", field, id));
}

// An effect to take out.
struct Plan {
  const EffectInUse* use = nullptr;
  std::size_t at = 0;  // in the summary
  CorrectionReads reads;
};

template <class Test>
bool any(const std::vector<Plan>& plans, const Test& test) {
  return std::any_of(plans.begin(), plans.end(), [&](const Plan& p) { return test(p.reads); });
}

Status check(const CorrectionOptions& options, const std::vector<EffectInUse>& model) {
  for (const std::string& id : options.skip) {
    const bool known = std::any_of(model.begin(), model.end(), [&](const EffectInUse& use) {
      return use.effect->info().id == id;
    });
    if (!known) return Error::usage(Message("the effect '%1' to skip is not in the model", id));
  }
  if (options.clock && !(*options.clock >= 0.0 && *options.clock <= 1.0))
    return Error::usage(
        Message("the clock is %1, expected 0 to 1", std::to_string(*options.clock)));
  return Done{};
}

// What becomes of an effect.
CorrectionState state_of(const std::string& id, const CorrectionReads& reads,
                         const CorrectionOptions& options) {
  if (!reads.moves_points)
    return reads.board ? CorrectionState::kBoardOnly : CorrectionState::kNoPoints;
  if (std::find(options.skip.begin(), options.skip.end(), id) != options.skip.end())
    return CorrectionState::kSkipped;
  if (reads.board) return CorrectionState::kBoardOnly;
  if (reads.clock && !options.clock) return CorrectionState::kNoClock;
  return CorrectionState::kTakenOut;
}

// Whether the cloud has what an effect that is taken out needs.
Status check_cloud(const Cloud& cloud, const EffectInfo& info, const CorrectionReads& reads,
                   const ModelScales& scales) {
  if ((reads.time || reads.scan || info.needs.time) && !cloud.has_time())
    return missing(info.id, "time");
  if ((reads.line || info.needs.line) && !cloud.has_line()) return missing(info.id, "line");
  if (reads.darkness && !cloud.has_intensity()) return missing(info.id, "intensity");
  if (reads.darkness && !(scales.log_contrast > 0.0)) {
    return Error::input(Message(
        "the effect '%1' cannot be taken out: the model lacks the calibration's intensities",
        info.id));
  }
  return Done{};
}

// The effects to take out; the summary says what becomes of each.
Result<std::vector<Plan>> plan(const Cloud& cloud, const std::vector<EffectInUse>& model,
                               const ModelScales& scales, const CorrectionOptions& options,
                               CorrectionSummary& summary) {
  std::vector<Plan> out;
  for (const EffectInUse& use : model) {
    const EffectInfo& info = use.effect->info();
    const CorrectionReads reads = correction_reads(use, scales);
    EffectCorrection entry;
    entry.id = info.id;
    entry.state = state_of(info.id, reads, options);
    if (entry.state == CorrectionState::kTakenOut) {
      if (Status s = check_cloud(cloud, info, reads, scales); !s) return s.error();
      out.push_back({&use, summary.effects.size(), reads});
    }
    summary.effects.push_back(entry);
  }
  return out;
}

// What is found out about points before any is moved; empty where no effect asks for it.
struct PointSurroundings {
  std::vector<Eigen::Vector2d> velocities;
  std::vector<Eigen::Vector3f> normals;
};

// Everything but the range, which the correction changes. Nothing where there is no point.
std::optional<BeamPoint> describe(const Cloud& cloud, const PointSurroundings& around,
                                  std::size_t i) {
  const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
  const double range = p.norm();
  if (!std::isfinite(range) || range <= 0.0) return std::nullopt;
  BeamPoint beam;
  set_direction(p / range, beam);
  beam.range_m = range;
  if (cloud.has_time() && std::isfinite(cloud.time_s[i])) beam.time_s = cloud.time_s[i];
  if (cloud.has_line()) beam.line = cloud.line[i];
  if (!around.velocities.empty()) beam.scan_rad_s = around.velocities[i];
  return beam;
}

// True if it lies outside what the calibration saw and is held at its edge.
bool set_darkness(double intensity, const ModelScales& scales, BeamPoint& beam) {
  beam.darkness = scales.darkness_of(intensity);
  // Noise takes the darkest and brightest print a little farther.
  constexpr double kNoise = 0.25;
  const double least = scales.intensity_at(scales.darkness_high + kNoise);
  return !(intensity >= least) || intensity > scales.intensity_at(scales.darkness_low - kNoise);
}

// As set_darkness().
bool set_incidence(const Eigen::Vector3f& normal, const ModelScales& scales, BeamPoint& beam) {
  const double cosine = std::abs(normal.cast<double>().dot(beam.direction));
  beam.incidence_rad = std::acos(std::min(1.0, cosine));
  if (!(scales.incidence_high_rad > 0.0) || beam.incidence_rad <= scales.incidence_high_rad)
    return false;
  beam.incidence_rad = scales.incidence_high_rad;
  return true;
}

// The effects that can be taken out of a point; counts it if there are some that cannot.
std::vector<const Plan*> plans_for(const BeamPoint& beam, bool has_surface,
                                   const std::vector<Plan>& plans, const std::vector<int>& lines,
                                   CorrectionSummary& summary) {
  std::vector<const Plan*> out;
  bool no_surface = false;
  bool unknown_line = false;
  for (const Plan& p : plans) {
    const bool lacks_surface = p.reads.incidence && !has_surface;
    const bool lacks_line =
        p.reads.line && !std::binary_search(lines.begin(), lines.end(), beam.line);
    no_surface = no_surface || lacks_surface;
    unknown_line = unknown_line || lacks_line;
    if (!lacks_surface && !lacks_line) out.push_back(&p);
  }
  summary.no_surface += no_surface ? 1 : 0;
  summary.unknown_line += unknown_line ? 1 : 0;
  return out;
}

// p_true = p − point_movement(range of p_true), by fixed point.
void take_out(const std::vector<const Plan*>& plans, const MeasurementTable& table, BeamPoint& beam,
              Eigen::Vector3f& point, CorrectionSummary& summary) {
  if (plans.empty()) return;
  std::vector<Eigen::Vector3d> scratch;
  const Eigen::Vector3d measured = point.cast<double>();
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Plan* p : plans) sum += point_movement(*p->use, beam, table, scratch);
    const double change = (sum - moved).norm();
    moved = sum;
    beam.range_m = (measured - moved).norm();
    if (change < kSettled_m) break;
  }
  point = (measured - moved).cast<float>();
  for (const Plan* p : plans) {
    EffectCorrection& entry = summary.effects[p->at];
    const double size = point_movement(*p->use, beam, table, scratch).norm();
    entry.points += size > 0.0 ? 1 : 0;
    entry.rms_m += size * size;
    entry.largest_m = std::max(entry.largest_m, size);
  }
  summary.rms_m += moved.squaredNorm();
  summary.largest_m = std::max(summary.largest_m, moved.norm());
}

// Turns sums of squares into root mean squares.
void finish(CorrectionSummary& summary) {
  for (EffectCorrection& e : summary.effects) {
    if (e.points > 0) e.rms_m = std::sqrt(e.rms_m / static_cast<double>(e.points));
  }
  if (summary.points > 0)
    summary.rms_m = std::sqrt(summary.rms_m / static_cast<double>(summary.points));
}

}  // namespace

Eigen::Vector3d point_movement(const EffectInUse& use, const BeamPoint& beam,
                               const MeasurementTable& table,
                               std::vector<Eigen::Vector3d>& scratch) {
  scratch.assign(static_cast<std::size_t>(use.values.size()), Eigen::Vector3d::Zero());
  use.effect->lidar(beam, table, use.shape, scratch);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < scratch.size(); ++k)
    sum += use.values(static_cast<Eigen::Index>(k)) * scratch[k];
  return sum;
}

CorrectionReads correction_reads(const EffectInUse& use, const ModelScales& scales) {
  // Tries it with one circumstance changed at a time.
  EffectInUse unit = use;
  // Unit values: those estimated may be zero or cancel each other.
  unit.values = Eigen::VectorXd::LinSpaced(use.values.size(), 1.0, 2.0);
  MeasurementTable table = empty_table(scales);
  // A line with a parameter of its own beside one without.
  if (table.lines.empty()) table.lines = {0};
  std::vector<Eigen::Vector3d> scratch;
  const auto movement_of = [&](const BeamPoint& b) {
    return point_movement(unit, b, table, scratch);
  };
  CorrectionReads out;
  for (int k = 0; k < 3; ++k) {
    const BeamPoint base = probe(k, table.lines);
    out.moves_points = out.moves_points || !movement_of(base).isZero(0.0);
    const auto differs = [&](auto change) {
      BeamPoint changed = base;
      change(changed);
      return movement_of(changed) != movement_of(base);
    };
    out.incidence |= differs([](BeamPoint& b) { b.incidence_rad += 0.4; });
    out.darkness |= differs([](BeamPoint& b) { b.darkness += 0.5; });
    out.time |= differs([](BeamPoint& b) { b.time_s += 0.03; });
    out.scan |= differs([](BeamPoint& b) { b.scan_rad_s += Eigen::Vector2d(3.0, -2.0); });
    out.line |= differs([](BeamPoint& b) { b.line += 1000; });
    out.board |= differs([](BeamPoint& b) { b.board_m += Eigen::Vector2d(0.13, 0.21); });
    out.board |= differs([](BeamPoint& b) { b.slope_rad += 0.7; });
    out.board |= differs([](BeamPoint& b) { b.white -= 0.5; });
    out.board |= differs([](BeamPoint& b) { b.edge = NearEdge{0.002, 0.3, 0.01}; });
    table.scenes.front().clock = 0.6;
    const Eigen::Vector3d later = movement_of(base);
    table.scenes.front().clock = 0.0;
    out.clock = out.clock || later != movement_of(base);
  }
  return out;
}

Result<CorrectionSummary> correct_cloud(Cloud& cloud, const std::vector<EffectInUse>& model,
                                        const ModelScales& scales, const CorrectionOptions& options,
                                        const RunContext& context) {
  if (Status s = check(options, model); !s) return s.error();
  CorrectionSummary summary;
  const auto plans = plan(cloud, model, scales, options, summary);
  if (!plans) return plans.error();
  MeasurementTable table = empty_table(scales);
  if (options.clock) table.scenes.front().clock = *options.clock;
  PointSurroundings around;
  if (any(*plans, [](const CorrectionReads& r) { return r.scan; }))
    around.velocities = scan_velocities(cloud);
  if (any(*plans, [](const CorrectionReads& r) { return r.incidence; })) {
    context.report("normals", 0.1, Message("estimating surfaces"));
    around.normals = local_normals(cloud, options.normals, context);
  }
  const bool reads_darkness = any(*plans, [](const CorrectionReads& r) { return r.darkness; });
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % kBetweenLooks == 0) {
      if (context.stopped()) return Error::cancelled();
      context.report("correct", 0.3 + 0.7 * static_cast<double>(i) / cloud.size(),
                     Message("taking effects out"));
    }
    std::optional<BeamPoint> beam = describe(cloud, around, i);
    if (!beam) continue;
    ++summary.points;
    const bool has_surface = !around.normals.empty() && !around.normals[i].isZero(0.0F);
    bool held = reads_darkness && set_darkness(cloud.intensity[i], scales, *beam);
    if (has_surface) held = set_incidence(around.normals[i], scales, *beam) || held;
    summary.held += held ? 1 : 0;
    take_out(plans_for(*beam, has_surface, *plans, table.lines, summary), table, *beam,
             cloud.points_m[i], summary);
  }
  finish(summary);
  return summary;
}

}  // namespace lvcalib
