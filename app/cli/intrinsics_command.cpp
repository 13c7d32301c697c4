// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <map>

#include "base/file_io.h"
#include "camera/camera_deviations.h"
#include "command.h"
#include "overwriting.h"
#include "pipeline/camera_calibration.h"
#include "pipeline/dataset.h"
#include "solve/uncertainty_report.h"

namespace lvcalib::cli {
namespace {
namespace fs = std::filesystem;

struct IntrinsicsArguments {
  std::string folder;
  std::string output;
  std::string target;
  std::string camera;
  std::string model;
};

const std::map<std::string, DistortionModel>& models_by_name() {
  static const std::map<std::string, DistortionModel> models = [] {
    std::map<std::string, DistortionModel> out;
    for (const auto model : {DistortionModel::kPlumbBob, DistortionModel::kRationalPolynomial,
                             DistortionModel::kEquidistant})
      out.emplace(name_of(model), model);
    return out;
  }();
  return models;
}

// What held-out images said of the models; nothing if the model was given.
std::string comparison(const CameraCalibration& result) {
  std::string text;
  for (const ModelPrediction& prediction : result.predictions) {
    if (!(prediction.held_out_px > 0.0)) continue;
    char part[96];
    std::snprintf(part, sizeof part, "%s%s %.3f", text.empty() ? "" : ", ",
                  name_of(prediction.model).c_str(), prediction.held_out_px);
    text += part;
  }
  return text.empty() ? text : " (held-out images: " + text + " px)";
}

// How well the camera images a direction, where it does so best and where worst.
std::string certainty(const CameraCalibration& result) {
  const auto reach = project_intrinsics(result.camera, result.covariance).reach_px();
  if (!reach) return {};
  char text[96];
  std::snprintf(text, sizeof text, ", directions known to %.3f px at best and %.3f px at worst",
                reach->first, reach->second);
  return text;
}

std::string summary_of(const CameraCalibration& result, const std::string& output) {
  char text[256];
  std::snprintf(text, sizeof text,
                "%zu of %zu images, %.3f px rms, fx = %.2f ± %.2f px, fy = %.2f ± %.2f px, %s",
                result.used_images(), result.images.size(), result.rms_px, result.camera.fx,
                result.sigma(0), result.camera.fy, result.sigma(1),
                name_of(result.camera.model).c_str());
  return text + comparison(result) + certainty(result) + " -> " + output;
}

Result<Target> load_board(const fs::path& path, bool given, const Session& session) {
  std::error_code code;
  if (!given && !fs::exists(path, code)) {
    return Error::input(Message("file not found; expected the description of the board"),
                        path.string(), Message("put it there, or name one with --target"));
  }
  auto file = read_target(path);
  if (!file) return file.error();
  for (const Message& warning : file->warnings) session.warn(warning);
  return file->target;
}

// What is read stays, whatever -o says; camera.yaml of a dataset is not read, and may be written.
Status check_camera_output(const IntrinsicsArguments& options, const CameraImages& images,
                           const fs::path& target) {
  std::vector<std::string> inputs = {target.string(), options.camera};
  for (const fs::path& image : images.images) inputs.push_back(image.string());
  if (Status s = check_output(options.output, inputs, DatasetFiles::kWritten); !s) return s;
  std::error_code code;
  if (fs::is_directory(options.output, code))
    return Error::usage(Message("the output is a folder"), options.output,
                        Message("name a file: camera.yaml"));
  const fs::path parent = fs::path(options.output).parent_path();
  return parent.empty() ? Status(Done{}) : check_folder_usable(parent);
}

Result<std::string> run(const IntrinsicsArguments& options, Session& session) {
  const auto images = find_camera_images(options.folder);
  if (!images) return images.error();
  const bool given = !options.target.empty();
  const fs::path target_path = given ? fs::path(options.target) : images->target;
  if (Status s = check_camera_output(options, *images, target_path); !s) return s.error();
  const auto target = load_board(target_path, given, session);
  if (!target) return target.error();
  CameraCalibrationOptions how;
  if (!options.model.empty()) how.model = models_by_name().at(options.model);
  if (!options.camera.empty()) {
    const auto camera = read_camera(options.camera);
    if (!camera) return camera.error();
    for (const Message& warning : camera->warnings) session.warn(warning);
    how.start = camera->camera;
  }
  const auto result = calibrate_camera(images->images, *target, how, session.context);
  if (!result) {
    Error error = result.error();
    if (error.where.empty()) error.where = options.folder;
    return error;
  }
  for (const Message& warning : result->warnings) session.warn(warning);
  if (session.context.stopped()) return Error::cancelled();
  const fs::path parent = fs::path(options.output).parent_path();
  if (!parent.empty()) {
    if (Status s = create_folder(parent); !s) return s.error();
  }
  const std::string yaml = to_yaml(result->camera, CameraDeviations(result->sigma));
  if (Status s = write_file_atomically(options.output, yaml); !s) return s.error();
  return summary_of(*result, options.output);
}

}  // namespace

Command add_intrinsics_command(CLI::App& app) {
  auto options = std::make_shared<IntrinsicsArguments>();
  CLI::App* command =
      app.add_subcommand("intrinsics", "Calibrate a camera alone from images of the board");
  command
      ->add_option("FOLDER", options->folder,
                   "a folder of images (png, jpg, bmp, tiff) with target.yaml, or a dataset: the "
                   "images of its scenes and of intrinsics/")
      ->required();
  command
      ->add_option("-o,--output", options->output, "camera.yaml to write, with standard deviations")
      ->required();
  command->add_option("--target", options->target,
                      "target.yaml of the board (default: FOLDER/target.yaml)");
  command->add_option("--camera", options->camera,
                      "camera.yaml to start from; without it everything is found from the images");
  std::vector<std::string> names;
  for (const auto& [name, model] : models_by_name()) names.push_back(name);
  command
      ->add_option("--model", options->model,
                   "distortion model (default: the one that predicts held-out images best)")
      ->check(CLI::IsMember(names));
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
