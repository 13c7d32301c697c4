// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "base/error.h"
#include "base/progress.h"

namespace lvcalib::cli {

/// What main() hands to every command: progress, stop token, threads, and a place for warnings.
struct Session {
  RunContext context;
  std::function<void(const Message&)> warn;       ///< One line to standard error.
  std::function<void(const std::string&)> print;  ///< One line to standard output.
  std::function<void(const Message&)> note;       ///< The same, no warning; not with --quiet.
};

/// A command registers its options on the application and returns what to run. The returned
/// function gives the one-line summary for standard output, or an error.
using Action = std::function<Result<std::string>(Session&)>;
struct Command {
  CLI::App* app = nullptr;
  Action run;
};

// One file per command.
Command add_target_command(CLI::App& app);
Command add_simulate_command(CLI::App& app);
Command add_calibrate_command(CLI::App& app);
Command add_discover_command(CLI::App& app);
Command add_check_command(CLI::App& app);
Command add_correct_command(CLI::App& app);
Command add_evaluate_command(CLI::App& app);
Command add_export_command(CLI::App& app);
Command add_import_command(CLI::App& app);
Command add_intrinsics_command(CLI::App& app);
Command add_plan_command(CLI::App& app);
Command add_report_command(CLI::App& app);

}  // namespace lvcalib::cli
