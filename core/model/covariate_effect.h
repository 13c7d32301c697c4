// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/effect.h"
#include "model/row_covariates.h"
#include "model/user_effect.h"

namespace lvcalib {

/// Base of effects that add a function of a row's covariates to one channel's measurements.
class CovariateEffect : public Effect {
 public:
  CovariateEffect(EffectInfo info, Channel channel, std::vector<const RowCovariate*> covariates)
      : info_(std::move(info)), channel_(channel), covariates_(std::move(covariates)) {}

  [[nodiscard]] const EffectInfo& info() const override { return info_; }
  [[nodiscard]] std::vector<EffectParameter> parameters(const MeasurementTable&) const override {
    return parameters_;
  }
  void lidar(const BeamPoint& beam, const MeasurementTable& table, double shape,
             std::span<Eigen::Vector3d> by_parameter) const override;
  void range(const RangeRow& row, const MeasurementTable& table, double shape,
             std::span<double> by_parameter) const override;
  void camera(const CornerRow& row, const Eigen::Vector2d& normalized, const Camera& camera,
              double shape, std::span<Eigen::Vector2d> by_parameter) const override;
  void edge(const BoundaryRow& row, const MeasurementTable& table, double shape,
            std::span<double> by_parameter) const override;
  void intensity(const IntensityRow& row, const MeasurementTable& table, double shape,
                 std::span<double> by_parameter) const override;

  /// Derivative of the added value by every parameter, at values of the covariates.
  virtual void columns(std::span<const double> covariates, double shape,
                       std::span<double> by_parameter) const = 0;

  [[nodiscard]] Channel acts_on() const { return channel_; }
  [[nodiscard]] const std::vector<const RowCovariate*>& covariates() const { return covariates_; }
  /// Values of the effect's covariates at a row.
  [[nodiscard]] std::vector<double> values_at(const MeasurementTable& table,
                                              const CovariateSource& row) const;

 protected:
  /// Needed by parameters(); called once, when the sizes are known.
  void set_parameters(std::vector<EffectParameter> parameters) {
    parameters_ = std::move(parameters);
  }
  EffectInfo info_;

 private:
  void at_row(const MeasurementTable& table, const CovariateSource& row, double shape,
              std::span<double> by_parameter) const;
  [[nodiscard]] bool needs_row() const;

  Channel channel_;
  std::vector<const RowCovariate*> covariates_;
  std::vector<EffectParameter> parameters_;
};

/// What all effects of the users say about themselves.
EffectInfo user_effect_info(const UserEffectSpec& spec,
                            const std::vector<const RowCovariate*>& covariates);

/// A coefficient whose columns have the given RMS over the rows.
EffectParameter user_parameter(const std::string& name, Channel channel, double rms,
                               const UserEffectOptions& options);

}  // namespace lvcalib
