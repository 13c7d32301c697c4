// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "base/file_io.h"
#include "command.h"
#include "overwriting.h"
#include "report/html_report.h"

namespace lvcalib::cli {
namespace {

struct ReportArguments {
  std::string folder;
  std::string output;
};

Result<std::string> run(ReportArguments options, Session& session) {
  // Who names the file itself means its folder.
  const std::filesystem::path named(options.folder);
  if (named.filename() == "result.json") options.folder = (named.parent_path() / ".").string();
  const std::filesystem::path folder(options.folder);
  if (Status s = check_output(options.output,
                              {(folder / "result.json").string(), (folder / "result.yaml").string(),
                               (folder / "discovery.json").string()});
      !s) {
    return s.error();
  }
  auto report = html_report(options.folder, session.context);
  if (!report) return report.error();
  if (session.context.stopped()) return Error::cancelled();
  for (const Message& warning : report->warnings) session.warn(warning);
  if (Status s = write_file_atomically(options.output, report->html); !s) return s.error();
  return "report -> " + options.output;
}

}  // namespace

Command add_report_command(CLI::App& app) {
  auto options = std::make_shared<ReportArguments>();
  CLI::App* command =
      app.add_subcommand("report", "Write a calibration as one self-contained HTML file");
  command->add_option("OUT", options->folder, "folder with result.json")->required();
  command->add_option("-o,--output", options->output, "report.html")->required();
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
