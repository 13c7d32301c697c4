// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "base/file_io.h"
#include "command.h"
#include "overwriting.h"
#include "target/sheet.h"
#include "target/target.h"

namespace lvcalib::cli {
namespace {

struct TargetArguments {
  std::string target_path;
  std::string output;
  SheetOptions sheet;
};

Result<SheetFormat> format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".pdf") return SheetFormat::kPdf;
  if (extension == ".svg") return SheetFormat::kSvg;
  if (extension == ".png") return SheetFormat::kPng;
  return Error::usage(Message("cannot tell the format of '%1'", path), "-o",
                      Message("end the name in .pdf, .svg or .png"));
}

Result<Target> load_target(const TargetArguments& options, const Session& session) {
  if (options.target_path.empty()) return Target{};
  auto file = read_target(options.target_path);
  if (!file) return file.error();
  for (const Message& warning : file->warnings) session.warn(warning);
  return file->target;
}

Result<std::string> run(const TargetArguments& options, Session& session) {
  if (Status s = check_output(options.output, {options.target_path}); !s) return s.error();
  const auto format = format_of(options.output);
  if (!format) return format.error();
  const auto target = load_target(options, session);
  if (!target) return target.error();
  const auto layout = lay_out_sheet(*target, options.sheet);
  if (!layout) return layout.error();
  const auto content = draw_sheet(*target, *format, options.sheet, session.context);
  if (!content) return content.error();
  if (session.context.stopped()) return Error::cancelled();
  if (Status status = write_file_atomically(options.output, *content); !status) {
    return status.error();
  }
  const auto mm = [](double value) { return std::to_string(std::lround(value)); };
  return options.output + ": board of " + mm(layout->board_mm.x()) + " × " +
         mm(layout->board_mm.y()) + " mm on " + std::to_string(layout->page_count()) +
         (layout->page_count() == 1 ? " page" : " pages") + "; print without scaling and measure " +
         "the scale bar";
}

}  // namespace

Command add_target_command(CLI::App& app) {
  auto options = std::make_shared<TargetArguments>();
  CLI::App* command = app.add_subcommand("target", "Draw the board for printing, exactly to scale");
  command->add_option("TARGET", options->target_path,
                      "target.yaml of the board; without it, the default board");
  command->add_option("-o,--output", options->output, "board.pdf, board.svg or board.png")
      ->required();
  CLI::Option* paper =
      command->add_option("--paper", options->sheet.paper,
                          "board (one page of the board's size), A0 … A4, Letter or WxH in mm; a "
                          "smaller paper than the board gives several pages (PDF only)");
  command->add_option("--dpi", options->sheet.dpi, "resolution of a PNG");
  // On one page there is no neighbour.
  command->add_option("--overlap", options->sheet.overlap_mm, "mm that neighbouring pages share")
      ->needs(paper);
  command->add_option("--page-border", options->sheet.page_border_mm,
                      "mm that the printer leaves white");
  return {command, [options](Session& session) { return run(*options, session); }};
}

}  // namespace lvcalib::cli
