// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "command.h"
#include "overwriting.h"
#include "pipeline/fresh_data.h"
#include "report/check_file.h"
#include "report/exports.h"
#include "report/result_file.h"

namespace lvcalib::cli {
namespace {

struct CheckArguments {
  std::string result;
  std::vector<std::string> folders;
  std::string output;
  double tolerance_px = EdgeCheckOptions{}.tolerance_px;
};

std::string summary_of(const EdgeCheck& check) {
  char text[320];
  std::snprintf(text, sizeof text,
                "%s; score %.2f ± %.2f of %zu edges (0 chance, 1 all); a turn by %.1f, %.1f, %.1f "
                "mrad about the camera's x, y, z would be noticed",
                reason_of(check).text().c_str(), check.given.score, check.given.sigma,
                check.given.edges, 1e3 * check.noticed_turn_rad.x(),
                1e3 * check.noticed_turn_rad.y(), 1e3 * check.noticed_turn_rad.z());
  return text;
}

Result<std::string> run(const CheckArguments& options, Session& session) {
  const auto input = read_export_input(options.result);
  if (!input) return input.error();
  const auto stored = read_result(options.result);
  if (!stored) return stored.error();
  std::vector<FilePair> pairs;
  for (const std::string& folder : options.folders) {
    auto found = find_fresh_data(folder);
    if (!found) return found.error();
    pairs.insert(pairs.end(), found->begin(), found->end());
  }
  if (!options.output.empty()) {
    std::vector<std::string> inputs = {options.result};
    for (const FilePair& pair : pairs) {
      inputs.push_back(pair.image.string());
      inputs.push_back(pair.cloud.string());
    }
    if (Status s = check_output(options.output, inputs); !s) return s.error();
  }
  const auto read =
      read_fresh_views(pairs, input->camera, input->camera_from_lidar, session.context);
  if (!read) return read.error();
  std::vector<Message> warnings = read->warnings;
  warnings.insert(warnings.end(), read->cloud_warnings.begin(), read->cloud_warnings.end());
  for (const Message& warning : warnings) session.warn(warning);
  EdgeCheckOptions check_options;
  check_options.covariance = stored->covariance;
  check_options.tolerance_px = options.tolerance_px;
  const auto check = check_edges(read->views, input->camera, input->camera_from_lidar,
                                 check_options, session.context);
  if (!check) return check.error();
  if (!options.output.empty()) {
    if (Status s = write_check(*check, pairs, warnings, options.output); !s) return s.error();
  }
  if (check->verdict == EdgeVerdict::kAgrees)
    return name_of(check->verdict) + ": " + summary_of(*check);
  return Error::untrusted(Message("%1: %2", name_of(check->verdict), summary_of(*check)),
                          options.result);
}

}  // namespace

Command add_check_command(CLI::App& app) {
  auto options = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand(
      "check", "Check a calibration on fresh images and clouds without a board, by their edges");
  command->add_option("RESULT", options->result, "result.json")->required();
  command
      ->add_option("FOLDERS", options->folders,
                   "folders of images and clouds that belong together, or datasets")
      ->required();
  command->add_option("-o,--output", options->output, "check.json to write");
  command
      ->add_option("--tolerance", options->tolerance_px,
                   "edges that agree to so many pixels are taken to agree")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
