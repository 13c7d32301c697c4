// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "overwriting.h"
#include "pipeline/calibration.h"
#include "pipeline/dataset.h"
#include "report/colored_cloud.h"
#include "report/exports.h"

namespace lvcalib::cli {
namespace {

struct ExportArguments {
  std::string result;
  std::string format;
  std::string output;
  std::string imu;
  std::string lidar_frame;
  std::string camera_frame;
  std::string scene;
  bool force = false;
};

bool is_cloud(const std::string& name) {
  for (const ExportFormat& format : export_formats()) {
    if (format.name == name) return format.is_cloud;
  }
  return false;
}

Result<std::string> run(const ExportArguments& options, const RunContext& context) {
  if (Status s = check_output(options.output, {options.result, options.imu}); !s) return s.error();
  auto input = read_export_input(options.result);
  if (!input) return input.error();
  // Nor onto what belongs to the result, or what it was made from.
  const std::filesystem::path folder = std::filesystem::path(options.result).parent_path();
  const std::filesystem::path dataset(input->dataset);
  if (Status s = check_output(
          options.output, {(folder / "result.yaml").string(), (folder / "discovery.json").string(),
                           (dataset / "target.yaml").string(), (dataset / "camera.yaml").string()});
      !s) {
    return s.error();
  }
  if (input->quality == name_of(Quality::kFailed) && !options.force) {
    return Error::untrusted(Message("the result has failed and is not to be used"), options.result,
                            Message("its warnings say why; --force exports it all the same"));
  }
  if (!options.imu.empty()) {
    auto imu = read_transform(options.imu, "T_imu_lidar");
    if (!imu) return imu.error();
    input->imu_from_lidar = *imu;
  }
  if (!options.lidar_frame.empty()) input->lidar_frame = options.lidar_frame;
  if (!options.camera_frame.empty()) input->camera_frame = options.camera_frame;
  if (is_cloud(options.format)) {
    const auto written = write_colored_ply(*input, options.scene, options.output, context);
    if (!written) return written.error();
    return options.format + ": " + std::to_string(written->cloud.size()) + " points, " +
           std::to_string(written->outside) + " outside of the picture, " +
           std::to_string(written->hidden) + " hidden -> " + options.output;
  }
  if (!options.scene.empty())
    return Error::usage(Message("only a coloured cloud is of one scene"), "--scene");
  if (Status s = write_export(*input, options.format, options.output); !s) return s.error();
  return options.format + " -> " + options.output;
}

std::string format_list() {
  std::string text = "one of";
  for (const ExportFormat& format : export_formats())
    text += "\n  " + format.name + ": " + format.description;
  return text;
}

}  // namespace

Command add_export_command(CLI::App& app) {
  auto options = std::make_shared<ExportArguments>();
  CLI::App* command = app.add_subcommand("export", "Write a result in another tool's format");
  command->add_option("RESULT", options->result, "result.json")->required();
  command->add_option("--format", options->format, format_list())->required();
  command->add_option("-o,--output", options->output, "file to write; of colmap a folder")
      ->required();
  command->add_option("--scene", options->scene,
                      "of colored-ply: which scene (default: the first in use)");
  command->add_option("--imu", options->imu,
                      "YAML file with T_imu_lidar (takes a LiDAR point to the IMU frame)");
  command->add_option("--lidar-frame", options->lidar_frame,
                      "what the LiDAR's frame is called (default: as the result says)");
  command->add_option("--camera-frame", options->camera_frame,
                      "what the camera's frame is called (default: as the result says)");
  command->add_flag("--force", options->force, "export a result that has failed, too");
  return {command, [options](Session& session) { return run(*options, session.context); }};
}

}  // namespace lvcalib::cli
