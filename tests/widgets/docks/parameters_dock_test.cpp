// SPDX-License-Identifier: GPL-3.0-or-later
#include "docks/parameters_dock.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTest>
#include <QToolButton>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace lvcalib::widgets::parameters_dock_test {
namespace {

class ParametersDockTest : public ::testing::Test {
 protected:
  ParametersDockTest() {
    QObject::connect(
        &dock_, &ParametersDock::option_wanted,
        [this](const OptionDeclaration& option, double value) { wanted_[option.key] = value; });
  }
  ParametersDock dock_;
  std::map<std::string, double> wanted_;
};

TEST_F(ParametersDockTest, EveryOptionHasAFieldWithItsDefaultAndAToolTip) {
  for (const OptionDeclaration& option : option_declarations()) {
    auto* editor = dock_.findChild<QWidget*>(QString::fromStdString(option.key));
    ASSERT_NE(editor, nullptr) << option.key;
    EXPECT_TRUE(editor->toolTip().contains(QString::fromStdString(option.key)));
    if (const auto* box = qobject_cast<QDoubleSpinBox*>(editor)) {
      const OptionDisplay display = display_of(option);
      EXPECT_NEAR(box->value() / display.factor, option.default_value(),
                  1e-9 * (1.0 + std::abs(option.default_value())))
          << option.key;
      EXPECT_NEAR(box->minimum(), option.low * display.factor, std::pow(10.0, -display.decimals))
          << option.key;
    } else {
      ASSERT_NE(qobject_cast<QCheckBox*>(editor), nullptr) << option.key;
    }
  }
  EXPECT_TRUE(wanted_.empty()) << "asked without being touched";
}

TEST_F(ParametersDockTest, EditingAsksInStoredUnitsAndWithinTheRange) {
  auto* step = dock_.findChild<QDoubleSpinBox*>("refinement.max_step_m");
  step->setValue(2.0);
  EXPECT_DOUBLE_EQ(wanted_["refinement.max_step_m"], 0.002);
  for (const OptionDeclaration& option : option_declarations()) {
    auto* box = dock_.findChild<QDoubleSpinBox*>(QString::fromStdString(option.key));
    if (box == nullptr) continue;
    for (const double shown : {box->minimum(), box->maximum()}) {
      box->setValue(shown);
      const double value = wanted_[option.key];
      EXPECT_GE(value, option.low) << option.key;
      EXPECT_LE(value, option.high) << option.key;
    }
  }
}

TEST_F(ParametersDockTest, ChangedOptionsCanBeResetOneByOneAndTogether) {
  auto* reset = dock_.findChild<QToolButton*>("reset refinement.max_bins");
  auto* all = dock_.findChild<QPushButton*>("reset_all");
  EXPECT_FALSE(reset->isEnabled());
  EXPECT_FALSE(all->isEnabled());
  CalibrationOptions options;
  options.refinement.max_bins = 30;
  options.extrinsic.reject_bad_scenes = false;
  dock_.set_options(options);
  EXPECT_EQ(dock_.findChild<QDoubleSpinBox*>("refinement.max_bins")->value(), 30);
  EXPECT_FALSE(dock_.findChild<QCheckBox*>("extrinsic.reject_bad_scenes")->isChecked());
  EXPECT_TRUE(wanted_.empty());
  QTest::mouseClick(reset, Qt::LeftButton);
  EXPECT_EQ(wanted_["refinement.max_bins"], 24);
  int asked = 0;
  QObject::connect(&dock_, &ParametersDock::reset_all_wanted, [&] { ++asked; });
  QTest::mouseClick(all, Qt::LeftButton);
  EXPECT_EQ(asked, 1);
}

}  // namespace
}  // namespace lvcalib::widgets::parameters_dock_test
