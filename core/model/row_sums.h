// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace lvcalib {

/// Sums over rows of a channel: a part of SceneProducts, of the upper triangles alone.
struct ChannelSums {
  Eigen::MatrixXd products;  ///< Nothing without rows.
  Eigen::VectorXd fourth_powers;
  int rows = 0;
};

/// Adds up rows most of whose columns are zero. Those that are not stand beside each other, in the
/// order in which they came up, for as long as most of them go on being used.
class RowSums {
 public:
  /// The last columns are those of `effects` effects and the residual.
  RowSums(int columns, int effects)
      : first_effect_(columns - 1 - effects),
        stride_((static_cast<std::size_t>(columns) + kWide - 1) / kWide * kWide),
        places_(static_cast<std::size_t>(columns), -1),
        values_(kTogether * stride_) {}
  RowSums(RowSums&&) = default;  // Its values stay where they are.
  RowSums(const RowSums&) = delete;

  /// A value of the row that finish() ends.
  void set(int column, double value) {
    if (value == 0.0) return;
    const int place = places_[static_cast<std::size_t>(column)];
    row_[place >= 0 ? place : new_place(column)] = value;
  }
  /// Ends a row that counts with this weight, 1/σ².
  void finish(double weight) {
    weights_[waiting_++] = weight;
    row_ += stride_;
    ++sums_.rows;
    if (waiting_ == kTogether) add_waiting();
  }
  /// Of all rows.
  ChannelSums sums() {
    if (waiting_ > 0) add_waiting();
    if (sums_.rows > 0) pass_on();
    return std::move(sums_);
  }

 private:
  static constexpr std::size_t kTogether = 8;  // Rows added up at a time: sums are passed once.
  static constexpr std::size_t kWide = 4;      // Doubles in a vector register of most processors.
  // Rows that wait to be added up: kTogether of them, their values beside each other, `stride` from
  // one row to the next.
  struct WaitingRows {
    const double* values;
    std::size_t stride, columns;
    const double* weights;  // Of each row.
  };
  // How each processor adds them.
  struct Products;
  using AddProducts = void (*)(const WaitingRows&, double*, double*);
  static AddProducts fastest();

  [[gnu::noinline]] int new_place(int column) {
    const auto place = static_cast<int>(columns_.size());
    columns_.push_back(column);
    places_[static_cast<std::size_t>(column)] = place;
    return place;
  }

  // How many columns rows that wait use.
  [[nodiscard]] std::size_t used() const;
  void add_waiting();
  // Adds the sums to those of all columns and starts again.
  void pass_on();

  int first_effect_;
  std::size_t stride_;
  std::vector<int> places_;     // Of all columns among those in use; −1: not in use.
  std::vector<int> columns_;    // In use, in their places.
  std::vector<double> values_;  // Of rows that wait.
  std::array<double, kTogether> weights_{};
  std::size_t waiting_ = 0;
  double* row_ = values_.data();                  // That of the row at hand.
  std::vector<double> products_, fourth_powers_;  // Of columns in use, not passed on yet.
  ChannelSums sums_;
  AddProducts add_products_ = fastest();
};

}  // namespace lvcalib
