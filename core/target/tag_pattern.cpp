// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <string>

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h10.h>
#include <apriltag/tag36h11.h>

#include "target/target.h"

namespace lvcalib {
namespace {

std::vector<TagPattern> read_family(apriltag_family_t* (*create)(),
                                    void (*destroy)(apriltag_family_t*)) {
  apriltag_family_t* family = create();
  std::vector<TagPattern> patterns;
  const int width = family->width_at_border - 2;
  const unsigned bits = family->nbits;
  for (unsigned id = 0; id < family->ncodes; ++id) {
    TagPattern pattern{width, std::vector<bool>(static_cast<std::size_t>(width * width), false)};
    for (unsigned i = 0; i < bits; ++i) {
      // Bit positions count from the outer edge of a one-bit border.
      const unsigned column = family->bit_x[i] - 1U;
      const unsigned row = family->bit_y[i] - 1U;
      pattern.white[row * static_cast<unsigned>(width) + column] =
          ((family->codes[id] >> (bits - i - 1U)) & 1U) != 0;
    }
    patterns.push_back(std::move(pattern));
  }
  destroy(family);
  return patterns;
}

// Built on first use; constant afterwards.
const std::vector<TagPattern>* family_patterns(const std::string& name) {
  static const std::map<std::string, std::vector<TagPattern>> families = [] {
    std::map<std::string, std::vector<TagPattern>> all;
    all["tag36h11"] = read_family(tag36h11_create, tag36h11_destroy);
    all["tag36h10"] = read_family(tag36h10_create, tag36h10_destroy);
    all["tag25h9"] = read_family(tag25h9_create, tag25h9_destroy);
    all["tag16h5"] = read_family(tag16h5_create, tag16h5_destroy);
    return all;
  }();
  const auto found = families.find(name);
  return found == families.end() ? nullptr : &found->second;
}

}  // namespace

const TagPattern* tag_pattern(const std::string& family, int id) {
  const auto* patterns = family_patterns(family);
  if (patterns == nullptr || id < 0 || static_cast<std::size_t>(id) >= patterns->size()) {
    return nullptr;
  }
  return &(*patterns)[static_cast<std::size_t>(id)];
}

int tag_family_size(const std::string& family) {
  const auto* patterns = family_patterns(family);
  return patterns == nullptr ? 0 : static_cast<int>(patterns->size());
}

}  // namespace lvcalib
