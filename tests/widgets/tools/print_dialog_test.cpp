// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/print_dialog.h"

#include <QComboBox>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "base/file_io.h"
#include "widgets/support/driver.h"

namespace lvcalib::widgets::print_dialog_test {
namespace {

using test::find;

class PrintDialogTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() { EXPECT_TRUE(Runner::wait_for_workers(60'000)); }
  void write(const QString& path) {
    find<QLineEdit>(dialog_, "print_file")->setText(path);
    find<QPushButton>(dialog_, "print_start")->click();
    ASSERT_TRUE(test::wait_until([&] { return !dialog_.busy(); }));
  }
  QString text() { return find<QLabel>(dialog_, "print_text")->text(); }
  QComboBox& paper() { return *find<QComboBox>(dialog_, "print_paper"); }
  QTemporaryDir folder_;
  test::Answers answers_;
  PrintDialog dialog_{std::nullopt, answers_, folder_.path()};
};

TEST_F(PrintDialogTest, WritesTheStandardBoardAsPdf) {
  EXPECT_TRUE(text().contains("pages: 1")) << text().toStdString();
  const QString path = folder_.filePath("board.pdf");
  write(path);
  QFile file(path);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly)) << text().toStdString();
  EXPECT_TRUE(file.read(5) == "%PDF-");
  EXPECT_TRUE(text().contains("board.pdf"));
}

TEST_F(PrintDialogTest, SmallPaperGivesSeveralPagesAndOnlyPdfCanHoldThem) {
  paper().setCurrentIndex(paper().findData("A4"));
  EXPECT_FALSE(text().contains("pages: 1.")) << text().toStdString();
  write(folder_.filePath("board.png"));
  EXPECT_FALSE(QFile::exists(folder_.filePath("board.png")));
  EXPECT_FALSE(text().contains("Written"));
}

TEST_F(PrintDialogTest, AnotherBoardComesFromItsFile) {
  Target small;
  small.tag_columns = small.tag_rows = 2;
  const QString path = folder_.filePath("target.yaml");
  ASSERT_TRUE(write_file_atomically(path.toStdString(), to_yaml(small)).ok());
  const QString before = text();
  answers_.target = path;
  auto* board = find<QComboBox>(dialog_, "print_board");
  board->setCurrentIndex(board->count() - 1);
  EXPECT_NE(text(), before);
  answers_.target = folder_.filePath("nothing.yaml");
  board->setCurrentIndex(board->count() - 1);
  EXPECT_TRUE(text().contains("nothing.yaml")) << text().toStdString();
  EXPECT_EQ(board->currentText(), path);
}

}  // namespace
}  // namespace lvcalib::widgets::print_dialog_test
