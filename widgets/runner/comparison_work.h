// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <QString>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "pipeline/calibration.h"
#include "report/result_comparison.h"
#include "runner/runner.h"
#include "selection/model_session.h"

namespace lvcalib::widgets {

/// One of the two results of a comparison.
struct ComparedResult {
  enum class Kind {
    kStep,     ///< What is open, at a step of its model's history.
    kFile,     ///< A result.json or result.yaml, or the truth of a simulation.
    kProject,  ///< Another project, calibrated for this.
  };
  Kind kind = Kind::kStep;
  std::size_t step = 0;
  QString path;
  bool operator==(const ComparedResult&) const = default;
  bool operator<(const ComparedResult& other) const {
    return std::tie(kind, step, path) < std::tie(other.kind, other.step, other.path);
  }
};

/// What is open, as a comparison needs it.
struct ComparisonBasis {
  std::shared_ptr<const CalibrationResult> result;  ///< In force.
  std::shared_ptr<const CalibrationResult> source;  ///< What the steps begin at; null without any.
  std::vector<ModelStepPtr> steps;                  ///< Those that are null cannot be compared.
  std::size_t current = 0;                          ///< The step that `result` belongs to.
  std::vector<SceneFiles> files;                    ///< Of the scenes, for their pictures.
};

/// Two results beside each other.
struct Comparison {
  StatedResult first, second;
  ExtrinsicDifference difference;
  std::vector<SceneComparison> scenes;
  /// As many as scenes: how far the board moves in the picture, for scenes of what is open.
  std::vector<std::optional<ProjectionShift>> shifts;
};

/// Compares results in a worker thread. What was read or calibrated is kept.
class ComparisonWork : public QObject {
  Q_OBJECT

 public:
  explicit ComparisonWork(QObject* parent = nullptr);

  /// A newer question takes the place of an older one. Both must be chosen.
  void request(const ComparisonBasis& basis, const ComparedResult& first,
               const ComparedResult& second);
  /// The next question reads this again.
  void forget(const ComparedResult& what) { kept_.erase(what); }
  void cancel() { runner_.cancel(); }
  [[nodiscard]] bool busy() const { return runner_.running(); }

 Q_SIGNALS:
  void ready(const std::shared_ptr<const lvcalib::widgets::Comparison>& comparison);
  void failed(const lvcalib::Error& error);
  void progressed(double fraction, const QString& text);
  /// The work has ended, however.
  void ended();

 private:
  using Stated = std::shared_ptr<const StatedResult>;
  std::map<ComparedResult, Stated> kept_;
  Runner runner_;
};

}  // namespace lvcalib::widgets
