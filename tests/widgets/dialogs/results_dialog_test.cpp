// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/results_dialog.h"

#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTextBlock>
#include <QTextDocument>
#include <numbers>

#include <gtest/gtest.h>

#include "base/file_io.h"

namespace lvcalib::widgets::results_dialog_test {
namespace {

CalibrationResult example() {
  CalibrationResult result;
  UncertainRigid3& pose = result.extrinsic.camera_from_lidar;
  pose.transform.translation = {0.1, -0.2345, 0.3};
  pose.transform.rotation = so3_exp({0, 0, 0.25 * std::numbers::pi});
  pose.covariance.diagonal() << 1e-6, 4e-6, 9e-6, 1e-8, 4e-8, 9e-8;
  result.quality = Quality::kDoubtful;
  result.quality_reason = Message("only <one> scene");
  result.warnings = {Message("result: take more")};
  result.extrinsic.weak_directions = {Message("rotation about x is weak")};
  return result;
}

TEST(ResultsDialog, ShowsThePoseInAllFormsWithItsUncertainty) {
  QTextDocument document;
  document.setHtml(results_html(example(), {}));
  const QString text = document.toPlainText();
  for (const char* part :
       {"100.000", "-234.500", "300.000",     // mm
        "1.000", "2.000", "3.000",            // ± mm
        "45.0000", "0.3826834", "0.9238795",  // yaw, quaternion
        "0.100", "0.200", "0.300",            // ± mrad
        "doubtful", "only <one> scene", "take more", "rotation about x is weak"}) {
    EXPECT_TRUE(text.contains(QString::fromUtf8(part))) << part;
  }
}

TEST(ResultsDialog, NothingIsCalledGoodWhileTheSearchGoesOn) {
  CalibrationResult result = example();
  result.quality = Quality::kGood;
  const auto head = [&](Missing missing) {
    QTextDocument document;
    document.setHtml(results_html(result, {missing, true}));
    return document.firstBlock().text();
  };
  EXPECT_EQ(head(Missing::kSought), "Quality: good so far; still looking for what is missing");
  EXPECT_EQ(head(Missing::kSomething), "Quality: doubtful");
  EXPECT_EQ(head(Missing::kNothing), "Quality: good");
}

TEST(ResultsDialog, TheMatrixHasItsRowsInOrder) {
  const QStringList rows = matrix_text(example()).trimmed().split('\n');
  ASSERT_EQ(rows.size(), 4);
  EXPECT_EQ(rows[0].simplified(), "0.70710678 -0.70710678 0.00000000 0.10000000");
  EXPECT_EQ(rows[3].simplified(), "0.00000000 0.00000000 0.00000000 1.00000000");
}

class Answers : public Choices {
 public:
  QString save;
  QString file_to_export(QWidget*, const QString&, const QString&) override { return save; }
};

// What the user calls the frames stands in everything that the window hands on.
TEST(ResultsDialog, EveryExportHasTheUsersNamesOfTheFrames) {
  auto result = std::make_shared<CalibrationResult>(example());
  result->camera.fx = result->camera.fy = 800.0;
  result->camera.width_px = 1000;
  result->camera.height_px = 640;
  const QTemporaryDir folder;
  Answers answers;
  auto* dialog = new ResultsDialog(result, answers, folder.path(), nullptr);
  dialog->set_frame_names("velo_x", "front_y");
  for (const char* suffix : {"json", "yaml"}) {
    answers.save = folder.filePath(QStringLiteral("result.") + suffix);
    dialog->findChild<QPushButton*>(QStringLiteral("export_") + suffix)->click();
    const auto text = read_text_file(answers.save.toStdString(), 1 << 20);
    ASSERT_TRUE(text.ok()) << suffix;
    EXPECT_NE(text->find("velo_x"), std::string::npos) << suffix;
    EXPECT_NE(text->find("front_y"), std::string::npos) << suffix;
  }
  auto* formats = dialog->findChild<QListWidget*>("formats");
  auto* preview = dialog->findChild<QPlainTextEdit*>("preview");
  int seen = 0;
  for (int row = 0; row < formats->count(); ++row) {
    formats->setCurrentRow(row);
    if (preview->toPlainText().isEmpty()) continue;  // Needs what this result has not.
    ++seen;
    for (const char* name : {"velo_x", "front_y"})
      EXPECT_TRUE(preview->toPlainText().contains(name))
          << formats->item(row)->text().toStdString();
  }
  EXPECT_GT(seen, 8);
  delete dialog;
}

}  // namespace
}  // namespace lvcalib::widgets::results_dialog_test
