// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "base/file_io.h"
#include "command.h"
#include "pipeline/calibration.h"
#include "report/result_file.h"

namespace lvcalib::cli {
namespace {

struct Options {
  std::string dataset;
  std::string output;
  std::string config;
  std::string rough;
  bool crops = false;
  std::vector<std::string> rejected;
};

Result<CalibrationRequest> make_request(const Options& options, const Dataset& dataset,
                                        Session& session) {
  CalibrationRequest request;
  request.use_crops = options.crops;
  request.rejected = options.rejected;
  request.guess = dataset.rough_camera_from_lidar;
  if (!options.config.empty()) {
    auto file = read_options(options.config);
    if (!file) return file.error();
    for (const std::string& warning : file->warnings) session.warn(warning);
    request.options = file->options;
  }
  if (!options.rough.empty()) {
    auto rough = read_rough_extrinsic(options.rough);
    if (!rough) return rough.error();
    request.guess = *rough;
  }
  return request;
}

std::string summary_of(const CalibrationResult& result, const std::string& output) {
  const auto& x = result.extrinsic;
  const Eigen::Vector3d& t = x.camera_from_lidar.transform.translation;
  const Vector6d sigma = x.camera_from_lidar.covariance.diagonal().cwiseSqrt();
  char text[512];
  std::snprintf(text, sizeof text,
                "%s: %d of %zu scenes, t = [%.4f %.4f %.4f] ± [%.2f %.2f %.2f] mm, rotation ± "
                "[%.2f %.2f %.2f] mrad, "
                "%.3f px, %.3f mm -> %s",
                name_of(result.quality).c_str(), x.used_scenes, result.scenes.size(), t.x(), t.y(),
                t.z(), 1e3 * sigma(0), 1e3 * sigma(1), 1e3 * sigma(2), 1e3 * sigma(3),
                1e3 * sigma(4), 1e3 * sigma(5), x.rms_px, x.rms_mm, output.c_str());
  return text;
}

Result<std::string> run(const Options& options, Session& session) {
  if (Status s = check_folder_usable(options.output); !s) return s.error();
  auto dataset = open_dataset(options.dataset);
  if (!dataset) return dataset.error();
  // Said before anything else: what follows may be their consequence.
  for (const std::string& warning : dataset->warnings) session.warn(warning);
  auto request = make_request(options, *dataset, session);
  if (!request) return request.error();
  auto result = calibrate(*dataset, *request, session.context);
  if (!result) return result.error();
  if (session.context.stopped()) return Error::cancelled();
  for (const std::string& warning : result->warnings) {
    const auto& said = dataset->warnings;
    if (std::find(said.begin(), said.end(), warning) == said.end()) session.warn(warning);
  }
  if (Status s = write_results(*result, options.output); !s) return s.error();
  const std::string summary = summary_of(*result, options.output);
  if (result->quality == Quality::kFailed || result->extrinsic.used_scenes < 2) {
    return Error::untrusted("the result cannot be trusted: " + result->quality_reason +
                                "; written for inspection to " + options.output,
                            options.dataset);
  }
  return summary;
}

}  // namespace

Command add_calibrate_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("calibrate", "Find T_camera_lidar from a dataset of board scenes");
  command
      ->add_option("DATASET", options->dataset, "folder with target.yaml, camera.yaml and scenes/")
      ->required();
  command->add_option("-o,--output", options->output, "folder for result.json and result.yaml")
      ->required();
  command->add_option("--config", options->config, "YAML file of options");
  command->add_option("--init", options->rough,
                      "rig.yaml with a rough T_camera_lidar; narrows the search");
  command->add_flag("--crops", options->crops, "use scenes/NAME/board.pcd where present");
  command->add_option("--reject", options->rejected, "leave out this scene (repeatable)");
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
