// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the pictures of the README from a dataset.
//
//   figures DATASET FOLDER
//
// Writes overlay.png and refinement.png into the folder.
#include <cstdio>
#include <filesystem>

#include "base/file_io.h"
#include "overlay_figure.h"
#include "pipeline/calibration.h"
#include "refinement_figure.h"

namespace lvcalib::study {
namespace {

Status draw(const std::filesystem::path& source, const std::filesystem::path& folder) {
  const auto dataset = open_dataset(source);
  if (!dataset) return dataset.error();
  const auto result = calibrate(*dataset, {}, {});
  if (!result) return result.error();
  if (Status s = create_folder(folder); !s) return s;
  if (Status s = draw_overlay(*dataset, *result, folder / "overlay.png"); !s) return s;
  return draw_refinement(*result, folder / "refinement.png");
}

}  // namespace
}  // namespace lvcalib::study

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: figures DATASET FOLDER\n");
    return 2;
  }
  const lvcalib::Status status = lvcalib::study::draw(argv[1], argv[2]);
  if (!status) {
    std::fprintf(stderr, "figures: %s\n", status.error().text().c_str());
    return 1;
  }
  return 0;
}
