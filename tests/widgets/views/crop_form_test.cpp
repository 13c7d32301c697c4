// SPDX-License-Identifier: GPL-3.0-or-later
#include "views/crop_form.h"

#include <QDoubleSpinBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include <gtest/gtest.h>

namespace lvcalib::widgets::crop_form_test {
namespace {

TEST(CropForm, GivesBackTheBoxItShows) {
  CropForm form;
  CropBox box;
  box.center_m = {3.25, -0.5, 0.125};
  box.half_size_m = {0.5, 0.75, 0.1};
  box.rotation = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized());
  QSignalSpy edited(&form, &CropForm::edited);
  form.setBox(box);
  EXPECT_EQ(edited.size(), 0);
  const CropBox back = form.box();
  EXPECT_LT((back.center_m - box.center_m).norm(), 1e-3);
  EXPECT_LT((back.half_size_m - box.half_size_m).norm(), 1e-3);
  EXPECT_LT(back.rotation.angularDistance(box.rotation), 2e-4);  // A hundredth of a degree.
}

TEST(CropForm, TypingAndButtonsAnnounce) {
  CropForm form;
  form.setBox({});
  form.show();
  QSignalSpy edited(&form, &CropForm::edited);
  QSignalSpy applied(&form, &CropForm::applied);
  QSignalSpy cleared(&form, &CropForm::cleared);
  auto* first = form.findChildren<QDoubleSpinBox*>().front();
  first->setFocus();
  first->selectAll();
  QTest::keyClicks(first, "2.5");
  QTest::keyClick(first, Qt::Key_Return);
  ASSERT_EQ(edited.size(), 1);
  EXPECT_NEAR(edited[0][0].value<CropBox>().center_m.x(), 2.5, 1e-9);
  QTest::mouseClick(form.findChild<QPushButton*>("crop-use"), Qt::LeftButton);
  ASSERT_EQ(applied.size(), 1);
  EXPECT_NEAR(applied[0][0].value<CropBox>().center_m.x(), 2.5, 1e-9);
  QTest::mouseClick(form.findChild<QPushButton*>("crop-clear"), Qt::LeftButton);
  EXPECT_EQ(cleared.size(), 1);
}

TEST(CropForm, EveryNumberHasANameAndAToolTip) {
  CropForm form;
  for (const QDoubleSpinBox* box : form.findChildren<QDoubleSpinBox*>()) {
    EXPECT_FALSE(box->accessibleName().isEmpty());
    EXPECT_FALSE(box->toolTip().isEmpty());
  }
}

}  // namespace
}  // namespace lvcalib::widgets::crop_form_test
