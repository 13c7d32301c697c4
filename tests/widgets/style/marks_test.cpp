// SPDX-License-Identifier: GPL-3.0-or-later
#include "style/marks.h"

#include <QImage>
#include <vector>

#include <gtest/gtest.h>

namespace lvcalib::widgets::marks_test {
namespace {

TEST(Marks, AreToldApartWithoutColours) {
  const QPalette palette;
  std::vector<QImage> images;
  for (const Mark mark :
       {Mark::kGood, Mark::kDoubtful, Mark::kBad, Mark::kIdle, Mark::kLeftOut, Mark::kMissing}) {
    images.push_back(mark_icon(mark, palette)
                         .pixmap(32, 32)
                         .toImage()
                         .convertToFormat(QImage::Format_Grayscale8));
  }
  for (std::size_t a = 0; a < images.size(); ++a) {
    for (std::size_t b = a + 1; b < images.size(); ++b) {
      int different = 0;
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x)
          different += std::abs(qGray(images[a].pixel(x, y)) - qGray(images[b].pixel(x, y))) > 60;
      }
      EXPECT_GT(different, 15) << a << " and " << b;
    }
  }
}

TEST(Marks, ToolsAreDrawnAndGreyWhenDisabled) {
  for (const ToolIcon tool :
       {ToolIcon::kRun, ToolIcon::kStop, ToolIcon::kUndo, ToolIcon::kRedo, ToolIcon::kTable}) {
    const QIcon icon = tool_icon(tool, QPalette());
    EXPECT_FALSE(icon.pixmap(24, 24).isNull());
    EXPECT_NE(icon.pixmap(24, 24, QIcon::Normal).toImage(),
              icon.pixmap(24, 24, QIcon::Disabled).toImage());
  }
}

}  // namespace
}  // namespace lvcalib::widgets::marks_test
