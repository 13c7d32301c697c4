// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "pipeline/calibration.h"

namespace lvcalib {

/// Collects the warnings of a result and keeps the worst verdict with its first reason; goes on
/// with what the result says of itself already.
class Verdict {
 public:
  explicit Verdict(CalibrationResult& result) : result_(result) {}
  /// Takes back what was said before: of a result that is good.
  void start() {
    std::erase_if(result_.warnings, [&](const Message& warning) {
      const std::vector<Message>& before = result_.verdict_warnings;
      return std::find(before.begin(), before.end(), warning) != before.end();
    });
    result_.verdict_warnings.clear();
    result_.quality = Quality::kGood;
    result_.quality_reason = {};
    result_.quality_reasons.clear();
  }
  void note(const Message& text) {
    result_.warnings.push_back(Message("result: %1", text));
    result_.verdict_warnings.push_back(result_.warnings.back());
  }
  void doubtful(const Message& text) {
    become(Quality::kDoubtful, text);
    note(text);
  }
  void failed(const Message& text) {
    become(Quality::kFailed, text);
    note(text);
  }

 private:
  void become(Quality quality, const Message& reason) {
    result_.quality_reasons.push_back(reason);
    if (result_.quality >= quality) return;
    result_.quality = quality;
    result_.quality_reason = reason;
  }
  CalibrationResult& result_;
};

/// What the intensities say about the print, and what keeps them from saying it.
void judge_print(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict);
/// Whether the intensities show a print of another size than the target's, beyond what the model in
/// force says of it: by four standard deviations and more than options.scale_warning.
bool print_size_contradicts(const CalibrationResult& result, const QualityOptions& options);
/// Whether it does so alike in both axes, as a print of another size does and angles of the LiDAR
/// that are off do not. Camera and scans then contradict the target as well, for that reason.
bool print_is_scaled(const CalibrationResult& result, const QualityOptions& options);

// Scenes against each other, and what is within one of them.

/// Scenes on which the result rests alone: without one the extrinsic moves by more than three of
/// its standard deviations, and by more than the scene's weight explains.
void judge_leverage(const CalibrationResult& result, Verdict& verdict);
/// Whether a scene's extrinsic differs from that of the others by no more than they differ among
/// themselves (F-test, one in a thousand), or by less than the tolerance. By every corner and
/// return, to first order about the solution; `scene` counts those in it. False as well where it,
/// or the others together, do not determine the extrinsic.
bool agrees_with_others(const ForwardSolution& forward, std::size_t scene,
                        const QualityOptions& options);
/// Whether what scenes contradict each other in is a motion: scenes before some moment agree among
/// themselves and those after it too, or all but one agree, or the extrinsic moves steadily.
/// F-tests against what scenes differ by otherwise, so that an effect that is missing is not taken
/// for one.
void judge_bump(const CalibrationResult& result, Verdict& verdict);
/// What moved while the scans were taken, or trails along them, where the clouds' times tell.
/// Returns whether anything is told.
bool judge_scans(const CalibrationResult& result, const QualityOptions& options, Verdict& verdict);
/// Halves of the scenes that contradict each other: something depends on what parts them.
void judge_splits(const CalibrationResult& result, Verdict& verdict);
/// Two boards with the same print, in every cloud, are two extrinsics that all scenes agree on.
void judge_second_board(const CalibrationResult& result, Verdict& verdict);
/// The joint solve ends where the boards were localized, or it has locked onto something else.
void judge_place(const CalibrationResult& result, Verdict& verdict);

}  // namespace lvcalib
