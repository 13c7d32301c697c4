// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "model/catalogue_effect.h"

namespace lvcalib {
namespace {

class RangeWalk final : public CatalogueEffect {
 public:
  RangeWalk()
      : CatalogueEffect(
            {.id = "range_walk",
             .group = "LiDAR range",
             .title = "Range walk",
             .physics = "Weak echoes cross the detection threshold later (or earlier), so that "
                        "dark print reads a different range than white print.",
             .formula = "dr = a g(P), g = 0 for the usual white and 1 for the usual black, a power "
                        "of 1/P or ln P; P from the intensity, or from print, range and incidence",
             .source = "Livox HAP and Mid-70 manuals; Laconte 2019",
             .discriminating_pose = "boards at two distances with the same print",
             .needs = {.intensity = true}},
            {{.name = "a",
              .unit = "mm",
              .unit_in_si = 1e-3,
              .size_of_interest = 2e-3,
              .prior_sigma = 0.05}}) {}

  // g is linear in ln P for exponent 0 and in a power of 1/P otherwise. Many LiDARs report
  // intensities that are freed from range and incidence: those shapes put cos θ/r² back, beside
  // white at three metres.
  [[nodiscard]] std::vector<double> shapes(const MeasurementTable&) const override {
    return {0.0, 0.25, 0.5, 1.0, kByGeometry, kByGeometry + 0.25, kByGeometry + 0.5};
  }
  [[nodiscard]] std::string shape_name() const override {
    return "exponent (2 more: power by range and incidence)";
  }

  [[nodiscard]] bool is_about_prints() const override { return true; }

  void lidar(const BeamPoint& beam, const MeasurementTable& table, double shape,
             std::span<Eigen::Vector3d> by) const override {
    double darkness = beam.darkness;
    if (shape >= kByGeometry && table.log_contrast > 0.0) {
      darkness -= log_power(beam.range_m, beam.incidence_rad) / table.log_contrast;
      shape -= kByGeometry;
    }
    const double exponent = shape * table.log_contrast;
    const double g =
        exponent > 1e-6 ? std::expm1(exponent * darkness) / std::expm1(exponent) : darkness;
    by[0] = g * beam.direction;
  }

 private:
  static constexpr double kByGeometry = 2.0;
};

}  // namespace

EffectPtr make_range_walk() {
  return std::make_shared<RangeWalk>();
}

}  // namespace lvcalib
