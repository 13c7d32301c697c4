// SPDX-License-Identifier: GPL-3.0-or-later
#include "runner/report_writer.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include "widgets/support/calibrated_demo.h"

namespace lvcalib::widgets::report_writer_test {
namespace {

class ReportWriterTest : public ::testing::Test {
 protected:
  [[nodiscard]] QString path() const { return folder_.filePath("report.html"); }
  QTemporaryDir folder_;
  ReportWriter writer_;
  QSignalSpy written_{&writer_, &ReportWriter::written};
  QSignalSpy failed_{&writer_, &ReportWriter::failed};
};

TEST_F(ReportWriterTest, WritesTheReportAndSaysWhatItLacks) {
  QSignalSpy progressed(&writer_, &ReportWriter::progressed);
  writer_.write(test::calibrated_demo().result, nullptr, path());
  EXPECT_TRUE(writer_.busy());
  ASSERT_TRUE(written_.wait(30'000));
  EXPECT_FALSE(writer_.busy());
  EXPECT_EQ(written_[0][0].toString(), path());
  // The demo's photographs are gone with its folder: one warning each.
  EXPECT_EQ(written_[0][1].toStringList().size(), 3);
  QFile file(path());
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  const QByteArray html = file.readAll();
  EXPECT_TRUE(html.contains("Boundary response"));
  EXPECT_TRUE(html.contains("</html>"));
  EXPECT_GT(progressed.size(), 0);
  EXPECT_EQ(failed_.size(), 0);
}

TEST_F(ReportWriterTest, APlaceThatCannotBeWrittenIsNamed) {
  writer_.write(test::calibrated_demo().result, nullptr, folder_.filePath("no/such/report.html"));
  ASSERT_TRUE(failed_.wait(30'000));
  const auto error = failed_[0][0].value<Error>();
  EXPECT_NE(error.text().find("no/such"), std::string::npos) << error.text();
  EXPECT_EQ(written_.size(), 0);
}

TEST_F(ReportWriterTest, CancelledItLeavesNoFile) {
  QSignalSpy cancelled(&writer_, &ReportWriter::cancelled);
  writer_.write(test::calibrated_demo().result, nullptr, path());
  writer_.cancel();
  ASSERT_TRUE(cancelled.wait(1000));
  EXPECT_TRUE(Runner::wait_for_workers(30'000));
  EXPECT_FALSE(QFile::exists(path()));
  EXPECT_EQ(written_.size(), 0);
}

}  // namespace
}  // namespace lvcalib::widgets::report_writer_test
