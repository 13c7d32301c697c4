// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "cli/child_process.h"
#include "cli/good_dataset.h"

namespace lvcalib::testing {

/// One way to spoil a good dataset, and what `lvcalib calibrate` must make of it.
struct BadInput {
  std::string name;  ///< Letters and digits only.
  std::function<void(const std::filesystem::path& dataset)> spoil;
  int status = 3;
  std::vector<std::string> message = {};    ///< What the one error line says, in parts.
  std::vector<std::string> arguments = {};  ///< Besides the dataset and -o.
  bool unprivileged = false;
};
std::ostream& operator<<(std::ostream& stream, const BadInput& input);

/// A spoiled copy of the good dataset and its output folder, both in a folder that is gone with
/// the object.
class SpoiledRun {
 public:
  explicit SpoiledRun(const BadInput& input);

  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] std::filesystem::path output() const { return folder_.path() / "out"; }
  /// The error line; empty if there is not exactly one.
  [[nodiscard]] std::string error() const;

  /// Checks what holds for every failure: the status, one error line and what it says, silence on
  /// standard output, nothing unfinished, and no output at all unless the status is 1.
  void expect_as_described() const;

 private:
  void expect_no_partial_output() const;
  BadInput input_;
  TemporaryFolder folder_;
  Outcome outcome_;
};

}  // namespace lvcalib::testing
