// SPDX-License-Identifier: GPL-3.0-or-later
#include "modelling/what_if_pane.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSlider>

#include <gtest/gtest.h>

#include "model_example.h"

namespace lvcalib::widgets::what_if_pane_test {
namespace {

TEST(WhatIfPaneTest, ASliderScalesThePatternOfAnEffect) {
  WhatIfPane pane;
  std::optional<EffectInUse> effect;
  double scale = 0.0;
  QObject::connect(&pane, &WhatIfPane::effectChosen, &pane, [&](const auto& e, double s) {
    effect = e;
    scale = s;
  });
  QObject::connect(&pane, &WhatIfPane::scaleChanged, &pane, [&](double s) { scale = s; });
  pane.setStep(test::model_example().base);
  EXPECT_FALSE(effect);
  auto* effects = pane.findChild<QComboBox*>("what_if_effect");
  effects->setCurrentIndex(effects->findData("range_walk"));
  ASSERT_TRUE(effect);
  EXPECT_DOUBLE_EQ(effect->values(0), 0.002) << "at the size of interest";
  EXPECT_DOUBLE_EQ(scale, 1.0);
  auto* slider = pane.findChild<QSlider*>("what_if_slider");
  auto* size = pane.findChild<QDoubleSpinBox*>("what_if_size");
  slider->setValue(slider->maximum());
  EXPECT_NEAR(scale, 10.0, 1e-6);
  EXPECT_NEAR(size->value(), 20.0, 1e-6);
  EXPECT_EQ(size->suffix(), " mm");
  size->setValue(-4.0);
  EXPECT_NEAR(scale, -2.0, 1e-6);
  EXPECT_EQ(slider->value(), slider->minimum() / 5);
  // Without an effect there is no size, and no number that has lost its unit.
  effects->setCurrentIndex(0);
  EXPECT_FALSE(effect);
  EXPECT_EQ(size->text(), "–");
  effects->setCurrentIndex(effects->findData("range_walk"));
  EXPECT_TRUE(size->text().endsWith(" mm")) << size->text().toStdString();
}

TEST(WhatIfPaneTest, EffectsWithSeveralParametersShowThem) {
  WhatIfPane pane;
  pane.setStep(test::model_example().base);
  auto* effects = pane.findChild<QComboBox*>("what_if_effect");
  const auto* names = pane.findChild<QComboBox*>("what_if_parameter");
  effects->setCurrentIndex(effects->findData("board_bow"));
  EXPECT_EQ(names->count(), 3);
  EXPECT_FALSE(names->isHidden());
  effects->setCurrentIndex(effects->findData("range_walk"));
  EXPECT_TRUE(names->isHidden());
}

}  // namespace
}  // namespace lvcalib::widgets::what_if_pane_test
