// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/progress.h"
#include "report/frame_names.h"

namespace lvcalib {

struct CalibrationResult;
struct Discovery;

/// A report, and what it had to do without (images that are gone).
struct HtmlReport {
  std::string html;
  std::vector<Message> warnings;
};

/// One self-contained HTML file of a calibration: verdict and reasons, pose, uncertainty, methods,
/// a section per scene with its image, boundary response, the model with its missing effects
/// (`folder`/discovery.json, if it is there), conventions, versions, the inputs'
/// hashes. Figures are inline SVG, photographs data URIs; nothing is loaded from anywhere. Prints
/// on A4. `folder` holds result.json; photographs come from the dataset it names.
/// Errors: kInput for a missing or malformed result; kCancelled.
Result<HtmlReport> html_report(const std::filesystem::path& folder, const RunContext& context);

/// The same of a calibration that is not stored. `discovery` may be null.
Result<HtmlReport> html_report(const CalibrationResult& result, const Discovery* discovery,
                               const RunContext& context, const FrameNames& frames = {});

}  // namespace lvcalib
