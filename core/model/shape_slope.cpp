// SPDX-License-Identifier: BSD-3-Clause
#include "model/shape_slope.h"

#include <algorithm>
#include <cmath>

namespace lvcalib {
namespace {

class ShapeSlope final : public Effect {
 public:
  ShapeSlope(const EffectInUse& in_use, const MeasurementTable& table)
      : effect_(in_use.effect), values_(in_use.values) {
    const std::vector<double> shapes = effect_->shapes(table);
    const auto [low, high] = std::minmax_element(shapes.begin(), shapes.end());
    const double width = *high - *low;
    const double step = 1e-4 * std::max(width, std::abs(in_use.shape));
    low_ = std::max(*low, in_use.shape - step);
    high_ = std::min(std::max(*high, low_ + step), in_use.shape + step);
    info_ = effect_->info();
    info_.id += ".shape";
    parameter_ = {.name = effect_->shape_name(),
                  .unit = "",
                  .size_of_interest = width,
                  .prior_sigma = std::max(width, 10.0 * step)};
  }

  [[nodiscard]] const EffectInfo& info() const override { return info_; }
  [[nodiscard]] std::vector<EffectParameter> parameters(const MeasurementTable&) const override {
    return {parameter_};
  }
  void lidar(const BeamPoint& beam, const MeasurementTable& table, double,
             std::span<Eigen::Vector3d> by) const override {
    difference<Eigen::Vector3d>(Eigen::Vector3d::Zero(), by, [&](double shape, auto out) {
      effect_->lidar(beam, table, shape, out);
    });
  }
  void range(const RangeRow& row, const MeasurementTable& table, double,
             std::span<double> by) const override {
    difference<double>(0.0, by,
                       [&](double shape, auto out) { effect_->range(row, table, shape, out); });
  }
  void board(const PrintPoint& point, const Target& target, double,
             std::span<Eigen::Vector3d> by) const override {
    difference<Eigen::Vector3d>(Eigen::Vector3d::Zero(), by, [&](double shape, auto out) {
      effect_->board(point, target, shape, out);
    });
  }
  void camera(const CornerRow& row, const Eigen::Vector2d& normalized, const Camera& camera, double,
              std::span<Eigen::Vector2d> by) const override {
    difference<Eigen::Vector2d>(Eigen::Vector2d::Zero(), by, [&](double shape, auto out) {
      effect_->camera(row, normalized, camera, shape, out);
    });
  }
  void edge(const BoundaryRow& row, const MeasurementTable& table, double,
            std::span<double> by) const override {
    difference<double>(0.0, by,
                       [&](double shape, auto out) { effect_->edge(row, table, shape, out); });
  }
  void spot(const BeamPoint& beam, const MeasurementTable& table, double,
            std::span<Eigen::Vector3d> by) const override {
    difference<Eigen::Vector3d>(Eigen::Vector3d::Zero(), by, [&](double shape, auto out) {
      effect_->spot(beam, table, shape, out);
    });
  }
  void blur(const BeamPoint& beam, const MeasurementTable& table, double,
            std::span<Eigen::Vector3d> by) const override {
    difference<Eigen::Vector3d>(Eigen::Vector3d::Zero(), by, [&](double shape, auto out) {
      effect_->blur(beam, table, shape, out);
    });
  }
  void intensity(const IntensityRow& row, const MeasurementTable& table, double,
                 std::span<double> by) const override {
    difference<double>(0.0, by,
                       [&](double shape, auto out) { effect_->intensity(row, table, shape, out); });
  }

 private:
  template <class T, class Hook>
  void difference(const T& zero, std::span<T> by, Hook&& hook) const {
    const auto n = static_cast<std::size_t>(values_.size());
    std::vector<T> below(n, zero);
    std::vector<T> above(n, zero);
    hook(low_, std::span<T>(below));
    hook(high_, std::span<T>(above));
    by[0] = zero;
    for (std::size_t k = 0; k < n; ++k) {
      by[0] += values_(static_cast<Eigen::Index>(k)) / (high_ - low_) * (above[k] - below[k]);
    }
  }

  EffectPtr effect_;
  Eigen::VectorXd values_;
  double low_ = 0.0;
  double high_ = 0.0;
  EffectInfo info_;
  EffectParameter parameter_;
};

}  // namespace

EffectPtr make_shape_slope(const EffectInUse& in_use, const MeasurementTable& table) {
  return std::make_shared<ShapeSlope>(in_use, table);
}

}  // namespace lvcalib
