// SPDX-License-Identifier: GPL-3.0-or-later
// Evidence for the statements about methods, bad scenes and boundary weights, as markdown tables.
//
//   evidence_study methods|bad-scenes|downstream [COUNT] [FIRST_SEED] [FOLDER] [CONDITION]
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "evidence_rigs.h"

int main(int argc, char** argv) {
  using namespace lvcalib::study;
  const std::string what = argc > 1 ? argv[1] : "";
  const int count = argc > 2 ? std::atoi(argv[2]) : 100;
  const std::uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  const std::filesystem::path folder = argc > 4 ? argv[4] : std::filesystem::temp_directory_path();
  if (what == "methods") {
    study_methods(count, first, folder, argc > 5 ? argv[5] : "");
  } else if (what == "bad-scenes") {
    study_bad_scenes(count, first, folder);
  } else if (what == "downstream") {
    study_downstream(count, first);
  } else {
    std::fprintf(stderr,
                 "usage: evidence_study methods|bad-scenes|downstream [COUNT] [FIRST_SEED] "
                 "[FOLDER] [CONDITION]\n");
    return 2;
  }
  return 0;
}
