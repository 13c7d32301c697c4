// SPDX-License-Identifier: GPL-3.0-or-later
#include "dialogs/about_dialog.h"

#include <QPointer>
#include <QTest>

#include <gtest/gtest.h>

#include "report/result_file.h"

namespace lvcalib::widgets::about_dialog_test {
namespace {

TEST(AboutDialog, NamesVersionAndLicenceAndGoesWhenClosed) {
  QPointer<AboutDialog> dialog = new AboutDialog;
  dialog->show();
  EXPECT_TRUE(dialog->text().contains(QString::fromStdString(version())));
  EXPECT_TRUE(dialog->text().contains("GPL-3.0-or-later"));
  EXPECT_TRUE(dialog->text().contains("BSD-3-Clause"));
  dialog->close();
  EXPECT_TRUE(QTest::qWaitFor([&] { return dialog.isNull(); }, 2000));
}

}  // namespace
}  // namespace lvcalib::widgets::about_dialog_test
