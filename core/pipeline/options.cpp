// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/options.h"

#include <cmath>
#include <type_traits>

#include "base/text.h"
#include "base/yaml_file.h"

namespace lvcalib {
namespace {

struct Limits {
  double low, high;
};

// Where an option is kept.
template <class Section, class Field>
struct OptionPlace {
  Section CalibrationOptions::*section;
  Field Section::*field;
};
template <class Section, class Field>
OptionPlace<Section, Field> at(Section CalibrationOptions::*section, Field Section::*field) {
  return {section, field};
}

template <class Section, class Field>
OptionDeclaration declare(const char* key, const char* unit, const Limits& limits,
                          const char* stage, const char* description,
                          const OptionPlace<Section, Field>& place) {
  OptionDeclaration d;
  d.key = key;
  d.unit = unit;
  d.description = description;
  d.low = limits.low;
  d.high = limits.high;
  d.whole = std::is_integral_v<Field>;
  d.stage = stage;
  d.get = [place](const CalibrationOptions& o) {
    return static_cast<double>(o.*place.section.*place.field);
  };
  d.set = [place](CalibrationOptions& o, double v) {
    o.*place.section.*place.field = static_cast<Field>(v);
  };
  return d;
}

std::vector<OptionDeclaration> make_declarations() {
  using O = CalibrationOptions;
  using D = DetectionOptions;
  using K = CloudOptions;
  using L = BoardSearchOptions;
  using C = ConsensusOptions;
  using R = RefinementOptions;
  using E = ExtrinsicOptions;
  using N = IntrinsicsOptions;
  using F = ForwardOptions;
  using P = ResponseOptions;
  using Q = QualityOptions;
  using M = DiscoveryOptions;
  return {
      declare("detection.quad_decimate", "1", {1, 8}, "detect",
              "Image reduction for the first tag search.", at(&O::detection, &D::quad_decimate)),
      declare("detection.max_reprojection_px", "px", {0.1, 1000}, "detect",
              "A tag that misses the board's pose by more is dropped.",
              at(&O::detection, &D::max_reprojection_px)),
      declare("detection.min_tags", "1", {1, 1000}, "detect", "Fewer tags make an image unusable.",
              at(&O::detection, &D::min_tags)),
      declare("clouds.use_intensity", "0/1", {0, 1}, "localize",
              "Use the clouds' intensities; without them planes and corners have to do.",
              at(&O::clouds, &K::use_intensity)),
      declare("clouds.max_unpacked_mib", "MiB", {1, 4096}, "localize",
              "A compressed cloud that unpacks to more is refused.",
              at(&O::clouds, &K::max_unpacked_mib)),
      declare("localization.min_range_m", "m", {0, 100}, "localize",
              "Closer points (the rig itself) are ignored.", at(&O::localization, &L::min_range_m)),
      declare("localization.max_lever_arm_m", "m", {0.01, 1000}, "localize",
              "Largest believable distance between camera and LiDAR.",
              at(&O::localization, &L::max_lever_arm_m)),
      declare("localization.min_correlation", "1", {0, 1}, "localize",
              "Pattern correlation below this is not the board.",
              at(&O::localization, &L::min_correlation)),
      declare("localization.plane_tolerance_m", "m", {0, 1}, "localize",
              "Flatness of plane candidates; 0: from the measured noise.",
              at(&O::localization, &L::plane_tolerance_m)),
      declare("localization.max_patches", "1", {1, 1000}, "localize",
              "Plane candidates examined at full density.", at(&O::localization, &L::max_patches)),
      declare("localization.search_walls", "0/1", {0, 1}, "localize",
              "Look for the pattern on planes larger than the board from the start.",
              at(&O::localization, &L::search_walls)),
      declare("consensus.systematic_rotation_rad", "rad", {0, 1}, "localize",
              "Systematic rotation error allowed between scenes.",
              at(&O::consensus, &C::systematic_rotation_rad)),
      declare("consensus.systematic_translation_m", "m", {0, 10}, "localize",
              "Systematic translation error allowed between scenes.",
              at(&O::consensus, &C::systematic_translation_m)),
      declare("consensus.guess_translation_m", "m", {0.001, 100}, "localize",
              "How far a rough extrinsic may be off.", at(&O::consensus, &C::guess_translation_m)),
      declare("consensus.guess_rotation_rad", "rad", {0.001, 3.15}, "localize",
              "How far a rough extrinsic may be turned.",
              at(&O::consensus, &C::guess_rotation_rad)),
      declare("refinement.max_bins", "1", {6, 360}, "refine",
              "Angular bins of a densely sampled node.", at(&O::refinement, &R::max_bins)),
      declare("refinement.min_bins", "1", {6, 360}, "refine",
              "Angular bins of a sparsely sampled node.", at(&O::refinement, &R::min_bins)),
      declare("refinement.samples_per_bin", "1", {1, 10000}, "refine",
              "Wanted samples per bin; decides how many bins a node gets.",
              at(&O::refinement, &R::samples_per_bin)),
      declare("refinement.min_bin_samples", "1", {2, 10000}, "refine",
              "A bin with fewer samples is refused.", at(&O::refinement, &R::min_bin_samples)),
      declare("refinement.min_contrast", "1", {0, 1000}, "refine",
              "Smallest level difference in units of the intensity noise.",
              at(&O::refinement, &R::min_contrast)),
      declare("refinement.max_step_m", "m", {1e-4, 1}, "refine",
              "Largest correction of a node in one iteration.", at(&O::refinement, &R::max_step_m)),
      declare("refinement.tolerance_m", "m", {1e-9, 1}, "refine",
              "Done when no node moves by more.", at(&O::refinement, &R::tolerance_m)),
      declare("refinement.max_iterations", "1", {1, 1000}, "refine", "Most iterations.",
              at(&O::refinement, &R::max_iterations)),
      declare("intrinsics.mode", "0/1/2", {0, 2}, "localize",
              "The camera's intrinsics: 0 taken as given, 1 estimated with the standard deviations "
              "in camera.yaml, 2 estimated freely.",
              at(&O::intrinsics, &N::mode)),
      declare("intrinsics.false_alarm", "1", {1e-9, 0.5}, "optimize",
              "How rarely right intrinsics may be taken for contradicted.",
              at(&O::intrinsics, &N::false_alarm)),
      declare("extrinsic.sigma_px_floor", "px", {1e-4, 100}, "optimize",
              "Corner noise is never taken below this.", at(&O::extrinsic, &E::sigma_px_floor)),
      declare("extrinsic.node_sigma_floor_m", "m", {0, 1}, "optimize",
              "Added in quadrature to every node's standard deviation.",
              at(&O::extrinsic, &E::node_sigma_floor_m)),
      declare("extrinsic.plane_sigma_floor_m", "m", {1e-9, 1}, "optimize",
              "Added in quadrature to the plane's height.",
              at(&O::extrinsic, &E::plane_sigma_floor_m)),
      declare("extrinsic.robust_threshold", "1", {0.5, 1000}, "optimize",
              "Huber threshold in standard deviations.", at(&O::extrinsic, &E::robust_threshold)),
      declare("extrinsic.rejection_gate", "1", {1, 1000}, "optimize",
              "A tag or node farther off (in σ) is left out.",
              at(&O::extrinsic, &E::rejection_gate)),
      declare("extrinsic.reject_bad_scenes", "0/1", {0, 1}, "optimize",
              "Leave out scenes that contradict all others.",
              at(&O::extrinsic, &E::reject_bad_scenes)),
      declare("extrinsic.scene_rejection_gain", "1", {1, 1e6}, "optimize",
              "A scene is left out if the rest fits so many times better without it.",
              at(&O::extrinsic, &E::scene_rejection_gain)),
      declare("extrinsic.false_alarm", "1", {1e-9, 0.5}, "optimize",
              "Chance of widening a stated σ though only noise is at work.",
              at(&O::extrinsic, &E::false_alarm)),
      declare("extrinsic.weak_direction_ratio", "1", {1, 1e6}, "optimize",
              "A direction known so many times worse than usual is called weak.",
              at(&O::extrinsic, &E::weak_direction_ratio)),
      declare("extrinsic.max_iterations", "1", {1, 10000}, "optimize",
              "Most iterations of one solve.", at(&O::extrinsic, &E::max_iterations)),
      declare("forward.robust_threshold", "1", {0.5, 1000}, "optimize",
              "Returns and corners farther off (in σ) weigh less.",
              at(&O::forward, &F::robust_threshold)),
      declare("forward.patch_m", "m", {0.02, 10}, "optimize",
              "Side of the patches over which the print may move as one.",
              at(&O::forward, &F::patch_m)),
      declare("forward.false_alarm", "1", {1e-9, 0.5}, "optimize",
              "How rarely chance alone may let errors that measurements share into the model.",
              at(&O::forward, &F::false_alarm)),
      declare("forward.tolerance", "1", {1e-6, 1}, "optimize",
              "Done when the extrinsic moves by less of its σ.", at(&O::forward, &F::tolerance)),
      declare("forward.max_iterations", "1", {1, 1000}, "optimize",
              "Most iterations of the solve over all returns.",
              at(&O::forward, &F::max_iterations)),
      declare("response.overlap_sigmas", "1", {0.1, 100}, "optimize",
              "Half-width of the overlap region in units of the transition's width.",
              at(&O::response, &P::overlap_sigmas)),
      declare("response.min_samples", "1", {3, 1e9}, "optimize",
              "Fewer overlap samples give no statistics.", at(&O::response, &P::min_samples)),
      declare("response.min_node_samples", "1", {1, 1e9}, "optimize",
              "A circle with fewer overlap samples is left out.",
              at(&O::response, &P::min_node_samples)),
      declare("response.min_contrast", "1", {0, 1000}, "optimize",
              "Smallest level difference in units of the intensity noise.",
              at(&O::response, &P::min_contrast)),
      declare("response.max_clipped_share", "1", {0, 1}, "optimize",
              "Share of a level at the end of the intensity scale that counts as clipped.",
              at(&O::response, &P::max_clipped_share)),
      declare("response.range_bin_m", "m", {0.01, 1000}, "optimize",
              "Width of the classes of range.", at(&O::response, &P::range_bin_m)),
      declare("response.incidence_bin_deg", "deg", {0.1, 90}, "optimize",
              "Width of the classes of incidence.", at(&O::response, &P::incidence_bin_deg)),
      declare("quality.scale_warning", "1", {0, 1}, "optimize",
              "Size difference between LiDAR and model worth a warning.",
              at(&O::quality, &Q::scale_warning)),
      declare("quality.scale_failure", "1", {0, 1}, "optimize",
              "Size difference that makes the result untrustworthy.",
              at(&O::quality, &Q::scale_failure)),
      declare("quality.max_sigma_px", "px", {0, 1000}, "optimize",
              "Corner noise above this makes the result doubtful where no replicates tell it.",
              at(&O::quality, &Q::max_sigma_px)),
      declare("quality.max_noise_scale", "1", {1, 1e6}, "optimize",
              "LiDAR residuals this many times their σ make the result doubtful.",
              at(&O::quality, &Q::max_noise_scale)),
      declare("quality.max_dark_offset_m", "m", {0, 10}, "optimize",
              "Range difference of dark and white print that makes the result doubtful.",
              at(&O::quality, &Q::max_dark_offset_m)),
      declare("quality.max_sigma_translation_m", "m", {1e-6, 1e3}, "optimize",
              "A position known worse than this is no result.",
              at(&O::quality, &Q::max_sigma_translation_m)),
      declare("quality.max_sigma_rotation_rad", "rad", {1e-6, 10}, "optimize",
              "A rotation known worse than this is no result.",
              at(&O::quality, &Q::max_sigma_rotation_rad)),
      declare("quality.tolerance_m", "m", {1e-6, 1}, "optimize",
              "A fault that moves the LiDAR by less does not matter.",
              at(&O::quality, &Q::tolerance_m)),
      declare("quality.tolerance_rad", "rad", {1e-6, 1}, "optimize",
              "A fault that turns the extrinsic by less does not matter.",
              at(&O::quality, &Q::tolerance_rad)),
      declare("quality.tolerance_sigmas", "1", {0, 100}, "optimize",
              "Nor does one that moves it by fewer standard deviations.",
              at(&O::quality, &Q::tolerance_sigmas)),
      declare("quality.min_margin", "nat", {0, 1e9}, "optimize",
              "Evidence by which the board assignment must win.", at(&O::quality, &Q::min_margin)),
      declare("discovery.max_effects", "1", {0, 50}, "discover",
              "The search for missing effects adds no more than this.",
              at(&O::discovery, &M::max_effects)),
      declare("discovery.false_alarm", "1", {1e-9, 0.5}, "discover",
              "Chance that an effect which is not there is taken for one, over all candidates.",
              at(&O::discovery, &M::false_alarm)),
      declare("discovery.min_gain", "1", {0, 1}, "discover",
              "Least fall of a channel's held-out squares that earns an effect its place.",
              at(&O::discovery, &M::min_gain)),
      declare("discovery.min_gain_few_scenes", "1", {0, 1}, "discover",
              "The same with three scenes or fewer.", at(&O::discovery, &M::min_gain_few_scenes)),
      declare("discovery.min_extrinsic_move", "1", {0, 1000}, "discover",
              "Or the extrinsic moves by so many standard deviations.",
              at(&O::discovery, &M::min_extrinsic_move)),
      declare("discovery.scenes_improved", "1", {0, 1}, "discover",
              "Share of scenes that must be predicted better.",
              at(&O::discovery, &M::scenes_improved)),
      declare("discovery.informative_nats", "nat", {0, 1000}, "discover",
              "Scenes whose log-density changes by less say nothing.",
              at(&O::discovery, &M::informative_nats)),
      declare("discovery.min_explained", "1", {0, 1}, "discover",
              "Share of what a channel misses by, beyond its noise, that an effect must explain.",
              at(&O::discovery, &M::min_explained)),
      declare("discovery.alias_correlation", "1", {0, 1}, "discover",
              "Effects correlated higher cannot be told apart.",
              at(&O::discovery, &M::alias_correlation)),
      declare("discovery.min_structure", "1", {0, 1}, "discover",
              "Share of the held-out variance from which structure is named.",
              at(&O::discovery, &M::min_structure)),
      declare("discovery.min_sure_structure", "1", {0, 1}, "discover",
              "The same where the scenes agree that it is no chance.",
              at(&O::discovery, &M::min_sure_structure)),
      declare("discovery.min_height", "1", {0, 1000}, "discover",
              "Height of something local, in standard deviations of one range, from which it is "
              "named.",
              at(&O::discovery, &M::min_height)),
  };
}

std::string shown(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

Status read_value(const YamlFile& file, const std::string& key, const YamlValue& value,
                  OptionsFile& out) {
  double number = 0;
  std::string scalar = value.scalar;
  if (scalar == "true") scalar = "1";
  if (scalar == "false") scalar = "0";
  if (value.kind != YamlValue::Kind::kScalar || !parse_number(scalar, number)) {
    return file.error_at(value, Message("'%1' must be a number", key));
  }
  if (Status status = set_option(out.options, key, number); !status) {
    if (status.error().kind == ErrorKind::kUsage) {
      out.warnings.push_back(
          Message("%1:%2: %3", file.name(), value.line, status.error().sentence()));
      return Done{};
    }
    return file.error_at(value, status.error().message);
  }
  return Done{};
}

}  // namespace

const std::vector<OptionDeclaration>& option_declarations() {
  static const std::vector<OptionDeclaration> declarations = make_declarations();
  return declarations;
}

Status set_option(CalibrationOptions& options, const std::string& key, double value) {
  // Its name in files of version 0.1.
  if (key == "discovery.speaking_nats")
    return set_option(options, "discovery.informative_nats", value);
  std::vector<std::string> keys;
  for (const OptionDeclaration& d : option_declarations()) {
    keys.push_back(d.key);
    if (d.key != key) continue;
    if (!(value >= d.low && value <= d.high)) {
      // "0/1" and the like name the choices again.
      const bool choice = d.unit.find('/') != std::string::npos;
      return Error::input(Message("'%1' must be between %2 and %3, found %4", key, shown(d.low),
                                  shown(d.high) + (choice ? "" : behind_number(d.unit)),
                                  shown(value)));
    }
    if (d.whole && value != std::floor(value)) {
      return Error::input(Message("'%1' must be a whole number, found %2", key, shown(value)));
    }
    d.set(options, value);
    return Done{};
  }
  const std::string nearest = nearest_word(key, keys);
  return Error::usage(
      nearest.empty() ? Message("unknown option '%1' ignored", key)
                      : Message("unknown option '%1' ignored; did you mean '%2'?", key, nearest));
}

Result<OptionsFile> read_options(const std::filesystem::path& path) {
  auto file = YamlFile::load(path);
  if (!file) return file.error();
  OptionsFile out;
  for (const auto& [key, value] : file->root().map) {
    if (value.kind == YamlValue::Kind::kMap) {
      for (const auto& [name, inner] : value.map) {
        if (Status s = read_value(*file, key + "." + name, inner, out); !s) return s.error();
      }
    } else if (Status s = read_value(*file, key, value, out); !s) {
      return s.error();
    }
  }
  return out;
}

}  // namespace lvcalib
