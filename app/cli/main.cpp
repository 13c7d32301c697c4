// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/text.h"
#include "base/yaml_file.h"
#include "command.h"
#include "interrupt.h"
#include "progress_printer.h"

namespace lvcalib::cli {
namespace {

constexpr int kMostThreads = 1024;

int exit_status(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUntrusted:
      return 1;
    case ErrorKind::kUsage:
      return 2;
    case ErrorKind::kInput:
    case ErrorKind::kOutput:
      return 3;
    case ErrorKind::kCancelled:
      break;
  }
  return 130;
}

int fail(ProgressPrinter& printer, const Error& error) {
  std::string text = error.text();
  // One message, one line, whatever a file name or a library has put into it.
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  printer.line("lvcalib: error: " + text);
  return exit_status(error.kind);
}

// What was printed must have arrived: a full device, a closed pipe.
int check_printed(ProgressPrinter& printer, int status) {
  std::cout.flush();
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout;
  if (!lost) return status;
  return fail(
      printer,
      Error::output(Message("what was to be printed is lost: standard output cannot be written")));
}

struct CommonOptions {
  int threads = 0;
  bool quiet = false;
};

void add_common_options(CLI::App& command, CommonOptions& common) {
  command.add_option("--threads", common.threads, "worker threads; 0: as many as the machine has")
      ->check(CLI::Range(0, kMostThreads));
  command.add_flag("--quiet", common.quiet, "no progress; only warnings and errors");
  command.set_version_flag("--version", "lvcalib " LVCALIB_VERSION);
}

// The error of a first argument that names no command; nothing if it is none or an option.
std::optional<Error> unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-' || argv[1][0] == '\0') return std::nullopt;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  const std::string asked(argv[1]);
  if (std::find(names.begin(), names.end(), asked) != names.end()) return std::nullopt;
  const std::string near = nearest_word(asked, names);
  return Error::usage(
      Message("there is no command '%1', known are %2", asked.substr(0, 100), joined(names, ", ")),
      {}, near.empty() ? Message("see lvcalib --help") : Message("did you mean %1?", near));
}

// Parses the command line. Returns an exit status when there is nothing to run.
int parse(CLI::App& app, int argc, char** argv, ProgressPrinter& printer) {
  try {
    app.parse(argc, argv);
    return -1;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0)  // --help and --version
      return check_printed(printer, app.exit(e));
    if (const auto error = unknown_command(app, argc, argv)) return fail(printer, *error);
    const auto used = app.get_subcommands();
    const std::string where = used.empty() ? std::string{} : used.front()->get_name();
    return fail(printer, Error::usage(Message::verbatim(e.what()), where,
                                      Message("see lvcalib %1--help",
                                              where.empty() ? Message() : Message("%1 ", where))));
  }
}

int run(int argc, char** argv, ProgressPrinter& printer, const InterruptWatch& interrupt) {
  CLI::App app("LiDAR-camera calibration", "lvcalib");
  app.set_version_flag("--version", "lvcalib " LVCALIB_VERSION);
  app.require_subcommand(1);
  const std::vector<Command> commands = {
      add_calibrate_command(app), add_discover_command(app), add_evaluate_command(app),
      add_export_command(app),    add_report_command(app),   add_target_command(app),
      add_simulate_command(app),  add_plan_command(app),     add_check_command(app),
      add_correct_command(app),   add_import_command(app),   add_intrinsics_command(app),
  };
  CommonOptions common;
  for (const Command& command : commands) add_common_options(*command.app, common);
  if (const int status = parse(app, argc, argv, printer); status >= 0) return status;

  Session session;
  session.context.threads = common.threads;
  session.context.stop = interrupt.token();
  if (!common.quiet) {
    session.context.progress = [&printer](const Progress& progress) { printer.show(progress); };
  }
  session.warn = [&printer](const Message& message) {
    printer.line("lvcalib: warning: " + message.text());
  };
  session.print = [&printer](const std::string& text) {
    printer.finish();
    std::printf("%s\n", printable(text).c_str());
  };
  session.note = [&printer, quiet = common.quiet](const Message& message) {
    if (!quiet) printer.line(message.text());
  };
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    const Result<std::string> summary = command.run(session);
    // A command that failed because it was stopped was stopped, whatever it says.
    if (!summary && interrupt.token().stop_requested()) return fail(printer, Error::cancelled());
    if (!summary) return fail(printer, summary.error());
    printer.finish();
    std::printf("%s\n", printable(*summary).c_str());
  }
  return check_printed(printer, 0);
}

}  // namespace
}  // namespace lvcalib::cli

int main(int argc, char** argv) {
  using lvcalib::Error;
  lvcalib::cli::ProgressPrinter printer;
  try {
    const lvcalib::cli::InterruptWatch interrupt;
    return lvcalib::cli::run(argc, argv, printer, interrupt);
  } catch (const std::bad_alloc&) {
    return lvcalib::cli::fail(printer,
                              Error::input(lvcalib::Message("not enough memory"), {},
                                           lvcalib::Message("use smaller clouds or images")));
  } catch (const std::system_error&) {
    return lvcalib::cli::fail(
        printer,
        Error::input(lvcalib::Message("not enough memory or threads"), {},
                     lvcalib::Message("end other programs, or raise the limits (ulimit)")));
  } catch (const std::exception& e) {
    return lvcalib::cli::fail(printer,
                              Error::input(lvcalib::Message("unexpected failure: %1", e.what())));
  } catch (...) {
    return lvcalib::cli::fail(printer, Error::input(lvcalib::Message("unexpected failure")));
  }
}
