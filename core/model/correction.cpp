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

// Tries an effect with one circumstance changed at a time.
class Probe {
 public:
  Probe(const EffectInUse& use, const ModelScales& scales)
      : use_(use), table_(empty_table(scales)) {
    // Unit values: those estimated may be zero or cancel each other.
    use_.values = Eigen::VectorXd::LinSpaced(use.values.size(), 1.0, 2.0);
    // A line with a parameter of its own beside one without.
    if (table_.lines.empty()) table_.lines = {0};
  }

  CorrectionReads run() {
    CorrectionReads out;
    for (int k = 0; k < 3; ++k) {
      const BeamPoint base = beam(k);
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
      table_.scenes.front().clock = 0.6;
      const Eigen::Vector3d later = movement_of(base);
      table_.scenes.front().clock = 0.0;
      out.clock = out.clock || later != movement_of(base);
    }
    return out;
  }

 private:
  [[nodiscard]] BeamPoint beam(int k) const {
    BeamPoint b;
    set_direction(Eigen::Vector3d(2.0, 0.7 - 0.6 * k, 0.3 * k - 0.2).normalized(), b);
    b.range_m = 1.7 + 1.3 * k;
    b.incidence_rad = 0.3 + 0.2 * k;
    b.slope_rad = 0.4 * k;
    b.darkness = 0.3 * k;
    b.time_s = 0.02 * (k + 1);
    b.scan_rad_s = {20.0 - 7.0 * k, 5.0 * k - 8.0};
    b.line = table_.lines[static_cast<std::size_t>(k) % table_.lines.size()];
    return b;
  }
  Eigen::Vector3d movement_of(const BeamPoint& b) {
    return point_movement(use_, b, table_, scratch_);
  }

  EffectInUse use_;
  MeasurementTable table_;
  std::vector<Eigen::Vector3d> scratch_;
};

Error missing(const std::string& id, const std::string& field) {
  return Error::input(
      Message("the effect '%1' cannot be taken out: there is no %2 in this cloud", id, field), {},
      Message("record the cloud with %1, or leave the effect in with --skip %2", field, id));
}

class Corrector {
 public:
  Corrector(Cloud& cloud, const std::vector<EffectInUse>& model, const ModelScales& scales,
            const CorrectionOptions& options, const RunContext& context)
      : cloud_(cloud),
        model_(model),
        scales_(scales),
        options_(options),
        context_(context),
        table_(empty_table(scales)) {}

  Result<CorrectionSummary> run() {
    if (Status s = check_options(); !s) return s.error();
    for (const EffectInUse& use : model_) {
      if (Status s = plan(use); !s) return s.error();
    }
    if (any([](const CorrectionReads& r) { return r.scan; })) velocities_ = scan_velocities(cloud_);
    if (any([](const CorrectionReads& r) { return r.incidence; })) {
      context_.report("normals", 0.1, Message("estimating surfaces"));
      normals_ = local_normals(cloud_, options_.normals, context_);
    }
    for (std::size_t i = 0; i < cloud_.size(); ++i) {
      if (i % kBetweenLooks == 0) {
        if (context_.stopped()) return Error::cancelled();
        context_.report("correct", 0.3 + 0.7 * static_cast<double>(i) / cloud_.size(),
                        Message("taking effects out"));
      }
      correct(i);
    }
    return finished();
  }

 private:
  struct Plan {
    const EffectInUse* use = nullptr;
    std::size_t at = 0;  // in the summary
    CorrectionReads reads;
  };

  template <class Test>
  [[nodiscard]] bool any(const Test& test) const {
    return std::any_of(plans_.begin(), plans_.end(), [&](const Plan& p) { return test(p.reads); });
  }

  Status check_options() {
    for (const std::string& id : options_.skip) {
      const bool known = std::any_of(model_.begin(), model_.end(), [&](const EffectInUse& use) {
        return use.effect->info().id == id;
      });
      if (!known) return Error::usage(Message("the effect '%1' to skip is not in the model", id));
    }
    if (!options_.clock) return Done{};
    if (!(*options_.clock >= 0.0 && *options_.clock <= 1.0))
      return Error::usage(
          Message("the clock is %1, expected 0 to 1", std::to_string(*options_.clock)));
    table_.scenes.front().clock = *options_.clock;
    return Done{};
  }

  // Decides what becomes of an effect; an error if the cloud lacks what it needs.
  Status plan(const EffectInUse& use) {
    const EffectInfo& info = use.effect->info();
    const CorrectionReads reads = correction_reads(use, scales_);
    EffectCorrection entry;
    entry.id = info.id;
    const bool skipped =
        std::find(options_.skip.begin(), options_.skip.end(), info.id) != options_.skip.end();
    if (!reads.moves_points) {
      entry.state = reads.board ? CorrectionState::kBoardOnly : CorrectionState::kNoPoints;
    } else if (skipped) {
      entry.state = CorrectionState::kSkipped;
    } else if (reads.board) {
      entry.state = CorrectionState::kBoardOnly;
    } else if (reads.clock && !options_.clock) {
      entry.state = CorrectionState::kNoClock;
    }
    if (entry.state == CorrectionState::kTakenOut) {
      if ((reads.time || reads.scan || info.needs.time) && !cloud_.has_time())
        return missing(info.id, "time");
      if ((reads.line || info.needs.line) && !cloud_.has_line()) return missing(info.id, "line");
      if (reads.darkness && !cloud_.has_intensity()) return missing(info.id, "intensity");
      if (reads.darkness && !(scales_.log_contrast > 0.0)) {
        return Error::input(Message(
            "the effect '%1' cannot be taken out: the model lacks the calibration's intensities",
            info.id));
      }
      plans_.push_back({&use, summary_.effects.size(), reads});
    }
    summary_.effects.push_back(entry);
    return Done{};
  }

  // Everything but the range, which the correction changes.
  [[nodiscard]] bool describe(std::size_t i, BeamPoint& beam) {
    const Eigen::Vector3d p = cloud_.points_m[i].cast<double>();
    const double range = p.norm();
    if (!std::isfinite(range) || range <= 0.0) return false;
    ++summary_.points;
    set_direction(p / range, beam);
    beam.range_m = range;
    if (cloud_.has_time() && std::isfinite(cloud_.time_s[i])) beam.time_s = cloud_.time_s[i];
    if (cloud_.has_line()) beam.line = cloud_.line[i];
    if (!velocities_.empty()) beam.scan_rad_s = velocities_[i];
    return true;
  }

  void set_darkness(std::size_t i, BeamPoint& beam, bool& held) const {
    const double intensity = cloud_.intensity[i];
    beam.darkness = scales_.darkness_of(intensity);
    // Noise takes the darkest and brightest print a little farther.
    constexpr double kNoise = 0.25;
    const double least = scales_.intensity_at(scales_.darkness_high + kNoise);
    held = held || !(intensity >= least) ||
           intensity > scales_.intensity_at(scales_.darkness_low - kNoise);
  }

  // False where no surface is known.
  [[nodiscard]] bool set_incidence(std::size_t i, BeamPoint& beam, bool& held) const {
    if (normals_.empty() || normals_[i].isZero(0.0F)) return false;
    const double cosine = std::abs(normals_[i].cast<double>().dot(beam.direction));
    beam.incidence_rad = std::acos(std::min(1.0, cosine));
    if (scales_.incidence_high_rad > 0.0 && beam.incidence_rad > scales_.incidence_high_rad) {
      beam.incidence_rad = scales_.incidence_high_rad;
      held = true;
    }
    return true;
  }

  void correct(std::size_t i) {
    BeamPoint beam;
    if (!describe(i, beam)) return;
    bool held = false;
    bool sloped = false;
    if (any([](const CorrectionReads& r) { return r.darkness; })) set_darkness(i, beam, held);
    if (!normals_.empty()) sloped = set_incidence(i, beam, held);
    active_.clear();
    bool no_surface = false;
    bool unknown_line = false;
    for (const Plan& p : plans_) {
      const bool lacks_surface = p.reads.incidence && !sloped;
      const bool lacks_line =
          p.reads.line && !std::binary_search(table_.lines.begin(), table_.lines.end(), beam.line);
      no_surface = no_surface || lacks_surface;
      unknown_line = unknown_line || lacks_line;
      if (!lacks_surface && !lacks_line) active_.push_back(&p);
    }
    summary_.no_surface += no_surface ? 1 : 0;
    summary_.unknown_line += unknown_line ? 1 : 0;
    summary_.held += held ? 1 : 0;
    take_out(i, beam);
  }

  // p_true = p − point_movement(range of p_true), by fixed point.
  void take_out(std::size_t i, BeamPoint& beam) {
    if (active_.empty()) return;
    const Eigen::Vector3d measured = cloud_.points_m[i].cast<double>();
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (int round = 0; round < kMostRounds; ++round) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Plan* p : active_) sum += point_movement(*p->use, beam, table_, scratch_);
      const double change = (sum - moved).norm();
      moved = sum;
      beam.range_m = (measured - moved).norm();
      if (change < kSettled_m) break;
    }
    cloud_.points_m[i] = (measured - moved).cast<float>();
    for (const Plan* p : active_) {
      EffectCorrection& entry = summary_.effects[p->at];
      const double size = point_movement(*p->use, beam, table_, scratch_).norm();
      entry.points += size > 0.0 ? 1 : 0;
      entry.rms_m += size * size;
      entry.largest_m = std::max(entry.largest_m, size);
    }
    summary_.rms_m += moved.squaredNorm();
    summary_.largest_m = std::max(summary_.largest_m, moved.norm());
  }

  CorrectionSummary finished() {
    for (EffectCorrection& e : summary_.effects) {
      if (e.points > 0) e.rms_m = std::sqrt(e.rms_m / static_cast<double>(e.points));
    }
    if (summary_.points > 0)
      summary_.rms_m = std::sqrt(summary_.rms_m / static_cast<double>(summary_.points));
    return std::move(summary_);
  }

  Cloud& cloud_;
  const std::vector<EffectInUse>& model_;
  const ModelScales& scales_;
  const CorrectionOptions& options_;
  const RunContext& context_;
  MeasurementTable table_;
  std::vector<Plan> plans_;
  std::vector<const Plan*> active_;
  std::vector<Eigen::Vector2d> velocities_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<Eigen::Vector3d> scratch_;
  CorrectionSummary summary_;
};

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
  return Probe(use, scales).run();
}

Result<CorrectionSummary> correct_cloud(Cloud& cloud, const std::vector<EffectInUse>& model,
                                        const ModelScales& scales, const CorrectionOptions& options,
                                        const RunContext& context) {
  return Corrector(cloud, model, scales, options, context).run();
}

}  // namespace lvcalib
