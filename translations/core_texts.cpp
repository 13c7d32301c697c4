// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the texts that the core library declares in lists and that the window shows, as source
// text for lupdate. See packaging/update-translations.sh.
#include <cctype>
#include <cstdio>
#include <set>
#include <string>

#include "docks/parameters_dock.h"
#include "model/effect.h"
#include "model/row_covariates.h"
#include "pipeline/options.h"
#include "report/exports.h"
#include "words/core_text.h"

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// Besides letters, functions and the names of movements, which are the same in every language.
bool has_words(const std::string& formula) {
  static const std::set<std::string> signs = {"sin", "cos", "tan", "sec", "exp",
                                              "daz", "del", "out", "diag"};
  constexpr std::size_t kShortestWord = 3;
  std::string run;
  for (const char c : formula + ' ') {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      run += c;
      continue;
    }
    if (run.size() >= kShortestWord && signs.count(run) == 0) return true;
    run.clear();
  }
  return false;
}

}  // namespace

int main() {
  std::set<std::string> texts;
  for (const lvcalib::OptionDeclaration& option : lvcalib::option_declarations()) {
    texts.insert(option.description);
    texts.insert(lvcalib::widgets::option_name(option).id());
  }
  for (const lvcalib::ExportFormat& format : lvcalib::export_formats())
    texts.insert(format.description);
  for (const lvcalib::EffectPtr& effect : lvcalib::effect_catalogue()) {
    const lvcalib::EffectInfo& info = effect->info();
    for (const std::string& text :
         {info.title, info.physics, info.discriminating_pose, effect->shape_name()}) {
      if (!text.empty()) texts.insert(text);
    }
    if (has_words(info.formula)) texts.insert(info.formula);
  }
  for (const lvcalib::Channel channel : lvcalib::kAllChannels) {
    for (const lvcalib::RowCovariate& c : lvcalib::row_covariates(channel))
      texts.insert(lvcalib::covariates_named({c.name}).id());
  }
  const std::set<std::string>& names = lvcalib::widgets::parameter_words();
  texts.insert(names.begin(), names.end());
  std::printf("static const char* const texts[] = {\n");
  for (const std::string& text : texts)
    std::printf("  QT_TRANSLATE_NOOP(\"Core\", %s),\n", quoted(text).c_str());
  std::printf("};\n");
  return 0;
}
