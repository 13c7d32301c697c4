// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>
#include <filesystem>
#include <optional>

#include "base/file_io.h"
#include "cloud/cloud.h"
#include "command.h"
#include "model/correction.h"
#include "overwriting.h"
#include "report/stored_model.h"

namespace lvcalib::cli {
namespace {

struct CorrectArguments {
  std::string cloud;
  std::string result;
  std::string output;
  CorrectionOptions correction;
};

std::string count_text(std::size_t count, std::size_t of, const char* what) {
  char text[240];
  std::snprintf(text, sizeof text, "%zu of %zu points %s", count, of, what);
  return text;
}

const char* why_left(CorrectionState state) {
  switch (state) {
    case CorrectionState::kSkipped:
      return "skipped";
    case CorrectionState::kNoClock:
      return "drifts with time, give --clock";
    case CorrectionState::kBoardOnly:
      return "known on the board only";
    case CorrectionState::kNoPoints:
      return "does not move points";
    case CorrectionState::kTakenOut:
      break;
  }
  return "";
}

std::string summary_text(const CorrectionSummary& summary, const std::string& output) {
  std::string taken;
  std::string left;
  for (const EffectCorrection& e : summary.effects) {
    std::string& list = e.state == CorrectionState::kTakenOut ? taken : left;
    list += (list.empty() ? "" : ", ") + e.id;
    if (e.state == CorrectionState::kTakenOut) {
      char text[80];
      std::snprintf(text, sizeof text, " (%.3g mm RMS, %.3g mm at most)", 1e3 * e.rms_m,
                    1e3 * e.largest_m);
      list += text;
    } else {
      list += std::string(" (") + why_left(e.state) + ")";
    }
  }
  return std::to_string(summary.points) +
         " points; taken out: " + (taken.empty() ? "nothing" : taken) +
         (left.empty() ? "" : "; left: " + left) + " -> " + output;
}

void warn(const CorrectionSummary& summary, const CorrectArguments& options,
          const Session& session) {
  if (summary.effects.empty()) {
    session.warn(
        Message("%1: its model holds no effects; the cloud is written as it is (lvcalib discover "
                "looks for effects)",
                options.result));
  }
  if (summary.no_surface > 0) {
    session.warn(
        Message("%1: %2", options.cloud,
                count_text(summary.no_surface, summary.points,
                           "keep the effects of the incidence: no flat surface about them")));
  }
  if (summary.unknown_line > 0) {
    session.warn(
        Message("%1: %2", options.cloud,
                count_text(summary.unknown_line, summary.points,
                           "keep the effects of single lines: theirs did not cross the board")));
  }
  if (summary.held > 0) {
    session.warn(
        Message("%1: %2", options.cloud,
                count_text(summary.held, summary.points,
                           "are darker, brighter or more slanted than the board was; they get "
                           "the correction at its limits")));
  }
}

Result<std::string> run(const CorrectArguments& options, Session& session) {
  if (Status s = check_output(options.output, {options.cloud, options.result}); !s)
    return s.error();
  const std::filesystem::path name(options.output);
  if (name.has_extension() && name.extension() != ".pcd" && !is_stream(name)) {
    return Error::usage(Message("a corrected cloud is written as PCD"), options.output,
                        Message("end the name in .pcd"));
  }
  const auto model = read_model(options.result);
  if (!model) return model.error();
  session.context.report("load", 0.0, Message("reading the cloud"));
  auto cloud = read_cloud(options.cloud, session.context.stop, PointChoice::kAll);
  if (!cloud) return cloud.error();
  for (const Message& warning : cloud->warnings)
    session.warn(Message("%1: %2", options.cloud, warning));
  const auto summary =
      correct_cloud(*cloud, model->effects, model->scales, options.correction, session.context);
  if (!summary) {
    Error error = summary.error();
    if (error.where.empty() && error.kind == ErrorKind::kInput) error.where = options.cloud;
    return error;
  }
  if (session.context.stopped()) return Error::cancelled();
  if (Status s = write_pcd(options.output, *cloud); !s) return s.error();
  warn(*summary, options, session);
  return summary_text(*summary, options.output);
}

}  // namespace

Command add_correct_command(CLI::App& app) {
  auto options = std::make_shared<CorrectArguments>();
  CLI::App* command =
      app.add_subcommand("correct", "Take the effects found by discover out of a cloud");
  command->add_option("CLOUD", options->cloud, "cloud.pcd or .ply of the same LiDAR")->required();
  command->add_option("--with", options->result, "result.json of lvcalib discover")->required();
  command->add_option("-o,--output", options->output, "the corrected cloud (binary PCD)")
      ->required();
  command->add_option("--skip", options->correction.skip, "an effect to leave in (repeatable)");
  command
      ->add_option("--clock", options->correction.clock,
                   "when the scan was taken, 0 (first scene of the calibration) to 1 (last)")
      ->check(CLI::Range(0.0, 1.0));
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
