// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "pipeline/calibration.h"
#include "report/frame_names.h"

namespace lvcalib::cli {

/// Arguments of the commands that calibrate first.
struct CalibrationArguments {
  std::string dataset;
  std::string output;
  std::string config;
  std::string rough;
  std::string intrinsics;  ///< fixed, prior or free; empty: as the options say.
  std::string tolerance;   ///< MM,MRAD; empty: as the options say.
  bool crops = false;
  bool no_intensity = false;
  bool ablation = false;         ///< See CalibrationOptions::ablation; of calibrate alone.
  bool skip_unreadable = false;  ///< Leave out scenes whose files are missing or unreadable.
  std::vector<std::string> rejected;
  std::vector<std::string> insisted;
  FrameNames frames;
};

void add_calibration_arguments(CLI::App& command, CalibrationArguments& arguments,
                               const std::string& output_description);

/// Opens the dataset and calibrates; warnings go to the session. Says beforehand if the output
/// folder cannot be written.
Result<CalibrationResult> run_calibration(const CalibrationArguments& arguments, Session& session);

/// The error of a result that was written but cannot be trusted.
Error untrusted_result(const CalibrationResult& result, const CalibrationArguments& arguments);

}  // namespace lvcalib::cli
