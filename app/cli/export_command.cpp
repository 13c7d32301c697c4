// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/file_io.h"
#include "command.h"
#include "overwriting.h"
#include "pipeline/calibration.h"
#include "pipeline/dataset.h"
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
  bool force = false;
};

Result<std::string> run(const ExportArguments& options) {
  for (const std::string& input : {options.result, options.imu}) {
    if (Status s = refuse_overwriting(options.output, input); !s) return s.error();
  }
  auto input = read_export_input(options.result);
  if (!input) return input.error();
  if (input->quality == name_of(Quality::kFailed) && !options.force) {
    return Error::untrusted("the result has failed and is not to be used", options.result,
                            "its warnings say why; --force exports it all the same");
  }
  if (!options.imu.empty()) {
    auto imu = read_transform(options.imu, "T_imu_lidar");
    if (!imu) return imu.error();
    input->imu_from_lidar = *imu;
  }
  if (!options.lidar_frame.empty()) input->lidar_frame = options.lidar_frame;
  if (!options.camera_frame.empty()) input->camera_frame = options.camera_frame;
  auto text = export_result(*input, options.format);
  if (!text) return text.error();
  if (Status s = write_file_atomically(options.output, *text); !s) return s.error();
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
  command->add_option("-o,--output", options->output, "file to write")->required();
  command->add_option("--imu", options->imu,
                      "YAML file with T_imu_lidar (takes a LiDAR point to the IMU frame)");
  command->add_option("--lidar-frame", options->lidar_frame,
                      "what the LiDAR's frame is called (default: lidar)");
  command->add_option("--camera-frame", options->camera_frame,
                      "what the camera's frame is called (default: camera)");
  command->add_flag("--force", options->force, "export a result that has failed, too");
  return {command, [options](Session&) { return run(*options); }};
}

}  // namespace lvcalib::cli
