// SPDX-License-Identifier: BSD-3-Clause
#include "report/html_report.h"

#include <array>
#include <chrono>
#include <ctime>
#include <optional>

#include "base/file_io.h"
#include "report/discovery_file.h"
#include "report/json_values.h"
#include "report/report_figures.h"
#include "report/report_sections.h"
#include "report/result_file.h"
#include "report/result_inputs.h"

namespace lvcalib {
namespace {

using nlohmann::json;

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.45 system-ui, sans-serif; color: #1c1c1c; max-width: 60rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: .2rem; } h2 { font-size: 1.2rem; margin-top: 2rem;
  border-bottom: 1px solid #ccc; } h3 { font-size: 1.02rem; margin-bottom: .3rem; }
table { border-collapse: collapse; margin: .5rem 0; font-variant-numeric: tabular-nums; }
th, td { border: 1px solid #ddd; padding: .15rem .5rem; text-align: right; }
th:first-child, td:first-child { text-align: left; } th { background: #f3f5f7; }
tr.best td { background: #e8f3ea; }
.verdict { display: inline-block; padding: .15rem .7rem; border-radius: .3rem; color: #fff;
  font-weight: 600; } .good { background: #23793b; } .doubtful { background: #a86200; }
.failed { background: #ab1f28; }
.figures { display: flex; flex-wrap: wrap; gap: .8rem; align-items: flex-start; }
svg.plot { width: 27rem; max-width: 100%; } svg.photo { width: 100%; max-width: 46rem; }
figure { margin: .3rem 0; } .figures figure { width: 27rem; max-width: 100%; } figcaption, .note { color: #555; font-size: .88rem; }
code, .hash { font: .82rem ui-monospace, monospace; overflow-wrap: anywhere; }
@media screen and (max-width: 45rem) { table { display: block; overflow-x: auto; } }
@page { margin: 16mm; }
@media print { body { max-width: none; margin: 0; font-size: 9.5pt; }
  .verdict { border: 1px solid #000; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  figure, table, svg { break-inside: avoid; } h2, h3 { break-after: avoid; }
  .details, .scene { break-before: page; } svg.plot, .figures figure { width: 8.4cm; } svg.photo { width: 11.5cm; }
  .figures { gap: .4cm; } }
)";

std::string page(const json& result, const std::string& body) {
  const std::string dataset = html_escaped(result.value("dataset", ""));
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         "<title>LiDAR–camera calibration: " +
         dataset + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n" + body +
         "</body>\n</html>\n";
}

// "2026-03-01", by the clock of this place.
std::string day_of(std::chrono::system_clock::time_point when) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(when);
  std::tm parts{};
  std::array<char, 16> text{};
  if (::localtime_r(&seconds, &parts) == nullptr ||
      std::strftime(text.data(), text.size(), "%Y-%m-%d", &parts) == 0)
    return {};
  return text.data();
}

// `text` is a result.json, `where` names it in errors.
Result<HtmlReport> report_of(const std::string& text, const std::string& where,
                             const json& discovery, const std::string& day,
                             const RunContext& context) {
  const json result = parse_json(text);
  if (result.is_discarded() || !result.is_object())
    return Error::input(Message("not a JSON object"), where);
  // The pictures are drawn from the scenes' files: from others than those that the result was made
  // of they would show what it does not say.
  if (Status s = check_result_inputs(result, where, {}, context); !s) return s.error();
  HtmlReport report;
  try {
    const auto model = model_in(text, where);
    const auto use = model ? std::optional(pose_use(*model)) : std::nullopt;
    std::string body = verdict_section(result, use, day) + "<div class=\"details\">\n" +
                       pose_section(result) + uncertainty_section(result) + methods_section(result);
    const json scenes = result.at("scenes");
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      if (context.stopped()) return Error::cancelled();
      context.report("report", static_cast<double>(s) / static_cast<double>(scenes.size()),
                     Message("scene %1", scenes[s].value("name", "")));
      body += scene_section(result, scenes[s], report.warnings);
    }
    body += response_section(result) + model_section(result, discovery) +
            provenance_section(result) + "</div>\n";
    report.html = page(result, body);
  } catch (const json::exception& e) {
    return Error::input(Message("this result lacks what a report shows: %1", e.what()), where,
                        Message("calibrate again with this version"));
  }
  context.report("report", 1.0, Message("done"));
  return report;
}

}  // namespace

Result<HtmlReport> html_report(const std::filesystem::path& folder, const RunContext& context) {
  const std::filesystem::path path = folder / "result.json";
  auto text = read_text_file(path, kMaxResultBytes);
  if (!text) return text.error();
  json discovery;
  const std::filesystem::path beside = folder / "discovery.json";
  std::error_code code;
  if (std::filesystem::exists(beside, code)) {
    auto found = read_text_file(beside, kMaxResultBytes);
    if (!found) return found.error();
    discovery = parse_json(*found);
    if (!discovery.is_object()) {
      return Error::input(Message("not a JSON object"), beside.string(),
                          Message("run lvcalib discover again, or remove the file"));
    }
  }
  const auto changed = std::filesystem::last_write_time(path, code);
  return report_of(
      *text, path.string(), discovery,
      day_of(code ? std::chrono::system_clock::now() : std::chrono::file_clock::to_sys(changed)),
      context);
}

Result<HtmlReport> html_report(const CalibrationResult& result, const Discovery* discovery,
                               const RunContext& context, const FrameNames& frames) {
  const json found = discovery != nullptr ? parse_json(discovery_as_json(*discovery)) : json();
  return report_of(result_as_json(result, frames), "the result", found,
                   day_of(std::chrono::system_clock::now()), context);
}

}  // namespace lvcalib
