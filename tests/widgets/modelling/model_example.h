// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A model of synthetic measurements in which dark print reads 8 mm too far.

#include <QApplication>
#include <QSignalSpy>
#include <QTest>
#include <stdexcept>

#include "selection/proposals.h"
#include "support/synthetic_table.h"

namespace lvcalib::test {

struct ModelExample {
  ModelStepPtr base;                            ///< Without effects.
  ModelStepPtr mended;                          ///< With range walk.
  std::shared_ptr<const ModelRanking> missing;  ///< In the base model.
};

inline ModelExample make_model_example(bool hidden = true) {
  Disturbance wrong;
  if (hidden) wrong.range_m = [](const BeamPoint& beam) { return 0.008 * beam.darkness; };
  auto made = synthetic_table({}, wrong);
  for (RangeRow& row : made.table.range) row.intensity = made.table.level_of(row.print);
  const auto base = start_model(std::move(made.table), made.truth, {}, {});
  if (!base) throw std::runtime_error(base.error().text());
  const auto mended = add_effect(*base, "range_walk", 0.0, {});
  if (!mended) throw std::runtime_error(mended.error().text());
  auto missing = rank_effects(**base, {});
  if (!missing) throw std::runtime_error(missing.error().text());
  return {*base, *mended, std::make_shared<const ModelRanking>(std::move(*missing))};
}

/// The same for all tests of a program.
inline const ModelExample& model_example() {
  static const ModelExample example = make_model_example();
  return example;
}

}  // namespace lvcalib::test
