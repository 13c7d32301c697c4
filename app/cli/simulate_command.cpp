// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <iomanip>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

#include "base/yaml_file.h"
#include "command.h"
#include "simulation/dataset_writer.h"
#include "simulation/disturbances/registry.h"
#include "simulation/simulator.h"
#include "target/target.h"

namespace lvcalib::cli {
namespace {

using simulation::LidarKind;
using simulation::SimulationOptions;

// What a word on the command line stands for.
const std::map<std::string, LidarKind>& lidar_kinds() {
  static const std::map<std::string, LidarKind> kinds = {{"rosette", LidarKind::kRosette},
                                                         {"avia", LidarKind::kAvia},
                                                         {"spinning", LidarKind::kSpinning}};
  return kinds;
}

const std::map<std::string, DistortionModel>& camera_models() {
  static const std::map<std::string, DistortionModel> models = {
      {"plumb_bob", DistortionModel::kPlumbBob},
      {"rational_polynomial", DistortionModel::kRationalPolynomial},
      {"equidistant", DistortionModel::kEquidistant}};
  return models;
}

struct SimulateArguments {
  SimulationOptions simulation;
  std::string lidar = "avia";
  std::string camera_model = "plumb_bob";
  std::string output;
  bool force = false;
  std::string target_path;
  std::string image_size;
  std::string distance_m;
  std::vector<std::string> effects;
  bool absent = false;
};

// Splits "A:B" at the separator.
std::optional<std::pair<std::string, std::string>> split(const std::string& text, char separator) {
  const auto at = text.find(separator);
  if (at == std::string::npos) return std::nullopt;
  return std::pair{text.substr(0, at), text.substr(at + 1)};
}

Status read_image_size(const std::string& text, simulation::ImageOptions& image) {
  if (text.empty()) return Done{};
  const auto parts = split(text, 'x');
  double width = 0.0;
  double height = 0.0;
  // The simulation checks the range; here only what an int can hold.
  const auto is_whole = [](double x) { return std::abs(x) < 1e6 && x == std::trunc(x); };
  if (!parts || !parse_number(parts->first, width) || !parse_number(parts->second, height) ||
      !is_whole(width) || !is_whole(height)) {
    return Error::usage(Message("'%1' is no image size, expected WIDTHxHEIGHT", text), "--image");
  }
  image.width_px = static_cast<int>(width);
  image.height_px = static_cast<int>(height);
  return Done{};
}

Status read_distance(const std::string& text, simulation::PlacementOptions& placement) {
  if (text.empty()) return Done{};
  const auto parts = split(text, ':');
  if (!parts || !parse_number(parts->first, placement.min_distance_m) ||
      !parse_number(parts->second, placement.max_distance_m)) {
    return Error::usage(Message("'%1' is no range of distances, expected MIN:MAX in metres", text),
                        "--distance");
  }
  return Done{};
}

Status read_effects(const std::vector<std::string>& texts, std::map<std::string, double>& effects) {
  for (const std::string& text : texts) {
    const auto parts = split(text, '=');
    double value = 0.0;
    if (!parts || parts->first.empty() || !parse_number(parts->second, value)) {
      return Error::usage(Message("'%1' is no effect, expected ID=VALUE with a number", text),
                          "--effect");
    }
    if (!effects.emplace(parts->first, value).second) {
      return Error::usage(Message("'%1' is given twice", parts->first), "--effect");
    }
  }
  return Done{};
}

Result<SimulationOptions> complete(const SimulateArguments& options, const Session& session) {
  SimulationOptions out = options.simulation;
  out.placement.board = !options.absent;
  out.lidar.kind = lidar_kinds().at(options.lidar);
  out.image.distortion = camera_models().at(options.camera_model);
  if (Status s = read_image_size(options.image_size, out.image); !s) return s.error();
  if (Status s = read_distance(options.distance_m, out.placement); !s) return s.error();
  if (Status s = read_effects(options.effects, out.effects); !s) return s.error();
  if (!options.target_path.empty()) {
    auto file = read_target(options.target_path);
    if (!file) return file.error();
    for (const Message& warning : file->warnings) session.warn(warning);
    out.target = file->target;
  }
  return out;
}

Result<std::string> run(const SimulateArguments& options, Session& session) {
  const auto complete_options = complete(options, session);
  if (!complete_options) return complete_options.error();
  const auto simulator = simulation::Simulator::create(*complete_options);
  if (!simulator) return simulator.error();
  auto writer = simulation::DatasetWriter::create(simulator->rig(), options.output, options.force);
  if (!writer) return writer.error();
  const Status simulated = simulation::simulate_each(
      *simulator, session.context,
      [&](int, const simulation::SimulatedScene& scene) { return writer->add(scene); });
  if (!simulated) return simulated.error();
  if (session.context.stopped()) return Error::cancelled();
  if (Status status = writer->finish(); !status) return status.error();
  const int scenes = complete_options->scenes;
  return options.output + ": " + std::to_string(scenes) + (scenes == 1 ? " scene" : " scenes") +
         ", truth in " + writer->truth_path().filename().string();
}

void add_scene_options(CLI::App& command, SimulateArguments& options) {
  auto& placement = options.simulation.placement;
  command.add_option("--target", options.target_path, "target.yaml of the board");
  command.add_option("--distance", options.distance_m,
                     "MIN:MAX from the LiDAR to the board's centre, m (default 2:4)");
  command.add_option("--tilt", placement.max_tilt_deg, "largest tilt of the board, degrees")
      ->capture_default_str();
  command.add_option("--roll", placement.max_roll_deg, "largest roll of the board, degrees")
      ->capture_default_str();
  command.add_flag("--decoy,!--no-decoy", placement.decoy,
                   "a panel of the board's size with another print (default: yes)");
  command.add_flag("--clutter,!--no-clutter", placement.clutter,
                   "boxes on the floor (default: yes)");
  command.add_flag("--absent", options.absent, "leave the board out");
  command.add_flag("--partial", placement.partial,
                   "the board partly outside the LiDAR's field of view");
  command.add_flag("--on-wall", placement.flush_on_wall, "the board flush on a wall");
}

void add_sensor_options(CLI::App& command, SimulateArguments& options) {
  auto& lidar = options.simulation.lidar;
  auto& image = options.simulation.image;
  command.add_option("--lidar", options.lidar, "rosette, avia or spinning")
      ->check(CLI::IsMember({"rosette", "avia", "spinning"}))
      ->capture_default_str();
  command.add_option("--points", lidar.points, "points per scene; 0: what suits the LiDAR");
  command.add_option("--lines", lidar.lines, "lines of a spinning LiDAR: 16, 32, 64 or 128")
      ->capture_default_str();
  command.add_option("--range-noise", lidar.range_sigma_m, "range noise on white, m, one sigma")
      ->capture_default_str();
  command.add_option("--angle-noise", lidar.angle_sigma_deg, "direction noise, degrees, one sigma")
      ->capture_default_str();
  command.add_option("--intensity-noise", lidar.intensity_sigma, "intensity noise, one sigma")
      ->capture_default_str();
  command
      .add_option("--camera-model", options.camera_model,
                  "plumb_bob, rational_polynomial or equidistant")
      ->check(CLI::IsMember({"plumb_bob", "rational_polynomial", "equidistant"}))
      ->capture_default_str();
  command.add_option("--image", options.image_size, "WIDTHxHEIGHT (default 1440x900)");
  command.add_option("--blur", image.blur_px, "lens blur, px, one sigma")->capture_default_str();
}

// Ids, units and meanings of the disturbances, for the help text.
std::string effect_table() {
  std::ostringstream table;
  table << "EFFECTS (id, unit of the value, typical value, what it is):\n";
  for (const simulation::Disturbance& disturbance : simulation::disturbances()) {
    table << "  " << std::left << std::setw(23) << disturbance.id << std::setw(5)
          << disturbance.unit << std::setw(6) << disturbance.typical << disturbance.sentence
          << '\n';
  }
  return table.str();
}

}  // namespace

Command add_simulate_command(CLI::App& app) {
  auto options = std::make_shared<SimulateArguments>();
  CLI::App* command =
      app.add_subcommand("simulate", "Make a dataset whose true calibration is known");
  command
      ->add_option("-o,--output", options->output,
                   "folder of the dataset; its truth goes to FOLDER-truth.json")
      ->required();
  command->add_option("--seed", options->simulation.seed, "everything random follows from it")
      ->capture_default_str();
  command->add_option("--scenes", options->simulation.scenes, "number of board poses")
      ->capture_default_str();
  add_sensor_options(*command, *options);
  add_scene_options(*command, *options);
  command->add_option("--effect", options->effects,
                      "ID=VALUE, a disturbance to plant; once for each, ids and units below");
  command->footer(effect_table());
  command->add_flag("--force", options->force, "replace an earlier simulated dataset");
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
