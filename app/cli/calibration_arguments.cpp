// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration_arguments.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/file_io.h"
#include "base/yaml_file.h"
#include "overwriting.h"
#include "report/exports.h"

namespace lvcalib::cli {
namespace {

// "MM,MRAD" into the options. Who names a tolerance means it, whatever the standard deviation.
Status read_tolerance(const std::string& text, QualityOptions& quality) {
  const std::size_t comma = text.find(',');
  double mm = 0.0;
  double mrad = 0.0;
  if (comma == std::string::npos || !parse_number(text.substr(0, comma), mm) ||
      !parse_number(text.substr(comma + 1), mrad) || !(mm > 0.0) || !(mrad > 0.0) || mm > 1000.0 ||
      mrad > 1000.0) {
    return Error::usage(Message("'%1' is no tolerance; expected millimetres and milliradians above "
                                "0 and up to 1000: 2,1",
                                text.substr(0, 100)),
                        "--tolerance");
  }
  quality.tolerance_m = 1e-3 * mm;
  quality.tolerance_rad = 1e-3 * mrad;
  quality.tolerance_sigmas = 0.0;
  return Done{};
}

UnusableScenes unusable_scenes(const CalibrationArguments& options) {
  return options.skip_unreadable ? UnusableScenes::kLeaveOut : UnusableScenes::kRefuse;
}

Result<CalibrationRequest> make_request(const CalibrationArguments& options, const Dataset& dataset,
                                        Session& session) {
  CalibrationRequest request;
  request.use_crops = options.crops;
  request.rejected = options.rejected;
  for (const std::string& name : options.insisted) {
    if (std::none_of(dataset.scenes.begin(), dataset.scenes.end(),
                     [&](const SceneFiles& files) { return files.name == name; }))
      return Error::usage(Message("there is no scene '%1' to insist on", name), options.dataset);
  }
  request.insisted = options.insisted;
  request.unusable = unusable_scenes(options);
  request.guess = dataset.rough_camera_from_lidar;
  if (!options.config.empty()) {
    auto file = read_options(options.config);
    if (!file) return file.error();
    for (const Message& warning : file->warnings) session.warn(warning);
    request.options = file->options;
  }
  constexpr std::array kModes = {"fixed", "prior", "free"};
  for (std::size_t k = 0; k < kModes.size(); ++k) {
    if (options.intrinsics == kModes[k]) request.options.intrinsics.mode = static_cast<int>(k);
  }
  if (!options.tolerance.empty()) {
    if (Status s = read_tolerance(options.tolerance, request.options.quality); !s) return s.error();
  }
  request.options.ablation = options.ablation;
  if (options.no_intensity) request.options.clouds.use_intensity = false;
  if (!options.rough.empty()) {
    auto rough = read_rough_extrinsic(options.rough);
    if (!rough) return rough.error();
    request.guess = *rough;
  }
  return request;
}

}  // namespace

void add_calibration_arguments(CLI::App& command, CalibrationArguments& arguments,
                               const std::string& output_description) {
  command
      .add_option("DATASET", arguments.dataset, "folder with target.yaml, camera.yaml and scenes/")
      ->required();
  command.add_option("-o,--output", arguments.output, output_description)->required();
  command.add_option("--config", arguments.config, "YAML file of options");
  command.add_option("--init", arguments.rough,
                     "rig.yaml with a rough T_camera_lidar; narrows the search");
  command.add_flag("--crops", arguments.crops, "use scenes/NAME/board.pcd where present");
  command.add_flag("--no-intensity", arguments.no_intensity,
                   "calibrate as if the clouds had no intensity: by planes and corners alone");
  command
      .add_option("--intrinsics", arguments.intrinsics,
                  "the camera's intrinsics: fixed (as given), prior (estimated, with the standard "
                  "deviations in camera.yaml or typical ones), free (estimated)")
      ->check(CLI::IsMember({"fixed", "prior", "free"}));
  command.add_option("--tolerance", arguments.tolerance,
                     "MM,MRAD: by how much the extrinsic may be off before it matters to you "
                     "(default: 0.5,0.2, or half a standard deviation if that is more)");
  command.add_option("--reject", arguments.rejected, "leave out this scene (repeatable)");
  command.add_option("--insist", arguments.insisted,
                     "use this scene though it contradicts the others or shows too few circles "
                     "(repeatable)");
  command.add_option("--lidar-frame", arguments.frames.lidar,
                     "what the LiDAR's frame is called in the results (default: lidar)");
  command.add_option("--camera-frame", arguments.frames.camera,
                     "what the camera's frame is called in the results (default: camera)");
  command.add_flag("--skip-unreadable", arguments.skip_unreadable,
                   "leave out scenes whose files are missing or cannot be read, with a warning; "
                   "otherwise they are an error");
}

Result<CalibrationResult> run_calibration(const CalibrationArguments& arguments, Session& session) {
  // What this command and `discover` write there.
  for (const char* name : {"result.yaml", "result.json", "discovery.json"}) {
    const std::filesystem::path file = std::filesystem::path(arguments.output) / name;
    if (Status s = check_output(file.string(), {arguments.rough, arguments.config}); !s)
      return s.error();
  }
  for (const std::string& name : {arguments.frames.lidar, arguments.frames.camera}) {
    if (Status s = check_frame_name(name); !s) return s.error();
  }
  if (Status s = check_folder_usable(arguments.output); !s) return s.error();
  auto dataset = open_dataset(arguments.dataset, unusable_scenes(arguments));
  if (!dataset) return dataset.error();
  // Said before anything else: what follows may be their consequence.
  for (const Message& warning : dataset->warnings) session.warn(warning);
  auto request = make_request(arguments, *dataset, session);
  if (!request) return request.error();
  auto result = calibrate(*dataset, *request, session.context);
  if (!result) return result.error();
  if (session.context.stopped()) return Error::cancelled();
  for (const Message& warning : result->warnings) {
    const auto& said = dataset->warnings;
    if (std::find(said.begin(), said.end(), warning) == said.end()) session.warn(warning);
  }
  return result;
}

Error untrusted_result(const CalibrationResult& result, const CalibrationArguments& arguments) {
  return Error::untrusted(Message("the result cannot be trusted: %1; written for inspection to %2",
                                  result.quality_reason, arguments.output),
                          arguments.dataset);
}

}  // namespace lvcalib::cli
