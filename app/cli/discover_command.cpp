// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "base/file_io.h"
#include "base/text.h"
#include "calibration_arguments.h"
#include "command.h"
#include "pipeline/model_discovery.h"
#include "report/discovery_file.h"
#include "report/result_file.h"
#include "report/stored_model.h"

namespace lvcalib::cli {
namespace {

struct DiscoverArguments {
  CalibrationArguments calibration;
  std::optional<int> max_effects;
  std::vector<std::string> with;
};

// What the verdict was before the effects and is with them: "; doubtful -> good".
std::string verdicts_of(Quality before, Quality after) {
  return "; " + (before == after ? "" : name_of(before) + " -> ") + name_of(after);
}

std::string summary_of(const Discovery& discovery, Quality before, const CalibrationResult& final,
                       const std::string& output) {
  const PoseUse use = pose_use(final);
  std::vector<std::string> missing = discovery.selected;
  if (!discovery.lacking().empty()) missing.push_back(discovery.lacking() + " (not added)");
  // What speaks against the result may be an effect that was not found.
  const std::string nothing = final.quality == Quality::kGood ? "nothing is missing in the model"
                                                              : "no effect is found to be missing";
  std::string text = !missing.empty()            ? "missing: " + joined(missing, ", ")
                     : discovery.unknown.empty() ? nothing
                     : final.unexplained.empty()
                         ? "nothing that matters is missing, though structure is left that no "
                           "known effect explains"
                         : "missing: something that no known effect explains";
  text += verdicts_of(before, final.quality);
  for (const ChannelSummary& before : discovery.channels) {
    for (const ChannelSummary& after : discovery.history.back().channels) {
      if (before.channel != after.channel) continue;
      char part[96];
      std::snprintf(part, sizeof part, "; %s %.3g -> %.3g%s", name_of(before.channel), before.rms,
                    after.rms, behind_number(unit_of(before.channel)).c_str());
      text += part;
    }
  }
  const auto sigma_mm = [](const Matrix6d& m) {
    return 1e3 * std::sqrt(m.diagonal().head<3>().sum());
  };
  char part[96];
  std::snprintf(part, sizeof part, "; sigma %.2g mm, %.2g mm with what effects left out could do",
                sigma_mm(final.extrinsic.camera_from_lidar.covariance),
                sigma_mm(final.covariance_total));
  return text + part +
         (use.corrected ? "; the pose is for corrected clouds (lvcalib correct)" : "") + " -> " +
         output;
}

// Says and writes what was found. `said`: what the calibration without effects was warned of.
Result<std::string> finish(const Discovery& discovery, const CalibrationResult& final,
                           Quality before, const std::vector<Message>& said,
                           const DiscoverArguments& options, Session& session) {
  const std::string& output = options.calibration.output;
  for (const Message& warning : discovery.warnings) session.warn(warning);
  // What the model in force is warned of, beyond what the base model was.
  for (const Message& warning : final.warnings) {
    if (std::find(said.begin(), said.end(), warning) == said.end()) session.warn(warning);
  }
  if (session.context.stopped()) return Error::cancelled();
  if (Status s = write_discovery(discovery, final, output, options.calibration.frames); !s)
    return s.error();
  if (final.quality == Quality::kFailed) return untrusted_result(final, options.calibration);
  return summary_of(discovery, before, final, output);
}

Result<std::string> run(const DiscoverArguments& options, Session& session) {
  const std::string& output = options.calibration.output;
  if (Status s = check_wanted(options.with); !s) return s.error();
  auto result = run_calibration(options.calibration, session);
  if (!result) return result.error();
  DiscoveryOptions how = discovery_options(*result);
  how.max_effects = options.max_effects.value_or(how.max_effects);
  how.with = options.with;
  const Quality before = result->quality;
  const std::vector<Message> said = result->warnings;
  auto explained = explain_refused_scenes(*result, how, session.context);
  if (!explained) return explained.error();
  if (*explained) {
    for (const Message& why : explanations(**explained)) session.warn(why);
    return finish((*explained)->discovery, (*explained)->result, before, said, options, session);
  }
  auto discovery = discover(*result, how, session.context);
  if (!discovery) {
    Error error = discovery.error();
    if (error.where.empty()) error.where = options.calibration.dataset;
    if (error.kind == ErrorKind::kUntrusted && !session.context.stopped()) {
      // Too little to look for effects, but there is a calibration.
      if (Status s = write_results(*result, output, options.calibration.frames); !s)
        return s.error();
      error.message += Message("; the plain calibration is in %1", output);
    }
    return error;
  }
  const CalibrationResult final = with_model(std::move(*result), *discovery);
  return finish(*discovery, final, before, said, options, session);
}

}  // namespace

Command add_discover_command(CLI::App& app) {
  auto options = std::make_shared<DiscoverArguments>();
  CLI::App* command =
      app.add_subcommand("discover", "Find which physical effects the model of a dataset misses");
  add_calibration_arguments(*command, options->calibration,
                            "folder for discovery.json, discovery.txt and result.*");
  command->add_option("--max-effects", options->max_effects, "add no more effects than this")
      ->check(CLI::Range(0, 50));
  command->add_option(
      "--with", options->with,
      "an effect to have in the model from the start (repeatable): an id of the "
      "catalogue, formula:CHANNEL:EXPRESSION or curve:CHANNEL:COVARIATE[,COVARIATE]");
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
