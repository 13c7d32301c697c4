// SPDX-License-Identifier: BSD-3-Clause
#include "model/row_sums.h"

#include <algorithm>

namespace lvcalib {

struct RowSums::Products {
  // Adds a lower triangle of products of the columns, `stride` from one to the next, and each
  // column's fourth powers. What lies beyond a triangle's row in its last kWide is not to be used.
  [[gnu::always_inline]] static void add(const WaitingRows& rows, double* __restrict products,
                                         double* __restrict fourth_powers) {
    for (std::size_t j = 0; j < rows.columns; ++j) {
      std::array<double, kTogether> whitened;
      for (std::size_t k = 0; k < kTogether; ++k) {
        const double value = rows.values[k * rows.stride + j];
        whitened[k] = rows.weights[k] * value;
        fourth_powers[j] += whitened[k] * value * (whitened[k] * value);
      }
      double* __restrict to = products + j * rows.stride;
      const std::size_t end = (j / kWide + 1) * kWide;
      for (std::size_t i = 0; i < end; ++i) {
        double sum = to[i];
        for (std::size_t k = 0; k < kTogether; ++k)
          sum += whitened[k] * rows.values[k * rows.stride + i];
        to[i] = sum;
      }
    }
  }
  static void anywhere(const WaitingRows& rows, double* products, double* fourth_powers) {
    add(rows, products, fourth_powers);
  }
#if defined(__x86_64__)
  [[gnu::target("avx2,fma")]] static void wide(const WaitingRows& rows, double* products,
                                               double* fourth_powers) {
    add(rows, products, fourth_powers);
  }
#endif
};

// What suits the processor at hand: a search spends an eighth of its time there.
RowSums::AddProducts RowSums::fastest() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Products::wide;
#endif
  return Products::anywhere;
}

std::size_t RowSums::used() const {
  std::size_t out = 0;
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    bool any = false;
    for (std::size_t k = 0; k < kTogether; ++k) any |= values_[k * stride_ + j] != 0.0;
    out += any ? 1 : 0;
  }
  return out;
}

void RowSums::add_waiting() {
  const std::size_t count = columns_.size();
  // Passing sums on costs about as much as adding rows.
  const std::size_t in_use = used();
  const bool last = count > in_use + in_use / 4 + kWide;
  if (products_.empty()) {
    products_.resize(stride_ * stride_);
    fourth_powers_.resize(stride_);
  }
  add_products_({values_.data(), stride_, count, weights_.data()}, products_.data(),
                fourth_powers_.data());
  for (std::size_t k = 0; k < kTogether; ++k) std::fill_n(&values_[k * stride_], count, 0.0);
  weights_.fill(0.0);
  waiting_ = 0;
  row_ = values_.data();
  if (last) pass_on();
}

void RowSums::pass_on() {
  const auto size = static_cast<Eigen::Index>(places_.size());
  if (sums_.products.size() == 0) {
    sums_.products.setZero(size, size);
    sums_.fourth_powers.setZero(size - 1 - first_effect_);
  }
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    double* const products = &products_[j * stride_];
    for (std::size_t i = 0; i <= j; ++i) {
      const auto [row, column] = std::minmax(columns_[i], columns_[j]);
      sums_.products(row, column) += products[i];
    }
    std::fill_n(products, (j / kWide + 1) * kWide, 0.0);
    const int effect = columns_[j] - first_effect_;
    if (effect >= 0 && effect < sums_.fourth_powers.size())
      sums_.fourth_powers(effect) += fourth_powers_[j];
    fourth_powers_[j] = 0.0;
    places_[static_cast<std::size_t>(columns_[j])] = -1;
  }
  columns_.clear();
}

}  // namespace lvcalib
