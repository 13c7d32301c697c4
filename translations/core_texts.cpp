// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the texts that the core library declares in lists and that the window shows, as source
// text for lupdate. See packaging/update-translations.sh.
#include <cstdio>
#include <set>
#include <string>

#include "docks/parameters_dock.h"
#include "model/effect.h"
#include "pipeline/options.h"
#include "report/exports.h"

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace

int main() {
  std::set<std::string> texts;
  for (const lvcalib::OptionDeclaration& option : lvcalib::option_declarations()) {
    texts.insert(option.description);
    texts.insert(lvcalib::widgets::label_of(option).toStdString());
  }
  for (const lvcalib::ExportFormat& format : lvcalib::export_formats())
    texts.insert(format.description);
  for (const lvcalib::EffectPtr& effect : lvcalib::effect_catalogue()) {
    const lvcalib::EffectInfo& info = effect->info();
    for (const std::string& text :
         {info.title, info.physics, info.discriminating_pose, effect->shape_name()}) {
      if (!text.empty()) texts.insert(text);
    }
  }
  std::printf("static const char* const texts[] = {\n");
  for (const std::string& text : texts)
    std::printf("  QT_TRANSLATE_NOOP(\"Core\", %s),\n", quoted(text).c_str());
  std::printf("};\n");
  return 0;
}
