// SPDX-License-Identifier: BSD-3-Clause
// Half a million points take 0.15 s of one core. PCL's NormalEstimation over twelve neighbours
// takes 0.88 s (pcl_benchmark), and does not say where a surface is not flat.
#include "cloud/local_normals.h"

#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

#include "base/symmetric.h"

namespace lvcalib {
namespace {

// A cell of a grid whose width doubles with the range.
struct Cell {
  int level = 0;
  std::array<int, 3> at{};
  bool operator==(const Cell&) const = default;
};

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::size_t h = static_cast<std::size_t>(c.level);
    for (const int v : c.at) h = h * 1000003U + static_cast<std::size_t>(v);
    return h ^ (h >> 17U);
  }
};

// Sums of a cell's points, about its own corner so that far cells lose no digits.
struct Sums {
  double n = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
};

class Patches {
 public:
  Patches(const LocalNormalOptions& options) : options_(options) {}

  [[nodiscard]] std::optional<Cell> cell_of(const Eigen::Vector3f& point) const {
    if (!point.allFinite() || point.isZero(0.0F)) return std::nullopt;
    const Eigen::Vector3d p = point.cast<double>();
    Cell cell;
    cell.level = std::ilogb(p.norm());
    const double width = width_of(cell);
    for (int k = 0; k < 3; ++k) {
      const double index = std::floor(p(k) / width);
      if (std::abs(index) > 1e9) return std::nullopt;
      cell.at[static_cast<std::size_t>(k)] = static_cast<int>(index);
    }
    return cell;
  }

  void add(const Cell& cell, const Eigen::Vector3f& point) {
    Sums& sums = cells_[cell];
    const Eigen::Vector3d d = point.cast<double>() - corner_of(cell);
    sums.n += 1.0;
    sums.first += d;
    sums.second += d * d.transpose();
  }

  // Of the cell and those around it; zero if they hold no flat patch.
  [[nodiscard]] Eigen::Vector3f normal_at(const Cell& cell) {
    const auto known = normals_.find(cell);
    if (known != normals_.end()) return known->second;
    return normals_[cell] = fit(cell);
  }

 private:
  // A third of a patch: one cell and its neighbours make it up.
  [[nodiscard]] double width_of(const Cell& cell) const {
    return std::ldexp(options_.patch_rad / 3.0, cell.level);
  }
  [[nodiscard]] Eigen::Vector3d corner_of(const Cell& cell) const {
    return width_of(cell) * Eigen::Vector3d(cell.at[0], cell.at[1], cell.at[2]);
  }

  [[nodiscard]] Eigen::Vector3f fit(const Cell& cell) const {
    const Eigen::Vector3d origin = corner_of(cell);
    Sums sum;
    for (int k = 0; k < 27; ++k) {
      Cell other = cell;
      other.at[0] += k % 3 - 1;
      other.at[1] += k / 3 % 3 - 1;
      other.at[2] += k / 9 - 1;
      const auto at = cells_.find(other);
      if (at == cells_.end()) continue;
      const Sums& s = at->second;
      const Eigen::Vector3d shift = corner_of(other) - origin;
      sum.n += s.n;
      sum.first += s.first + s.n * shift;
      sum.second += s.second + s.first * shift.transpose() + shift * s.first.transpose() +
                    s.n * shift * shift.transpose();
    }
    if (sum.n < options_.min_points) return Eigen::Vector3f::Zero();
    const Eigen::Vector3d mean = sum.first / sum.n;
    const auto axes = axes_of<3>(sum.second / sum.n - mean * mean.transpose());
    if (!(axes.values(0) < options_.flatness * axes.values(1))) return Eigen::Vector3f::Zero();
    const Eigen::Vector3d normal = axes.vectors.col(0);
    return (normal.dot(origin + mean) > 0.0 ? -normal : normal).cast<float>();
  }

  const LocalNormalOptions& options_;
  std::unordered_map<Cell, Sums, CellHash> cells_;
  std::unordered_map<Cell, Eigen::Vector3f, CellHash> normals_;
};

}  // namespace

std::vector<Eigen::Vector3f> local_normals(const Cloud& cloud, const LocalNormalOptions& options,
                                           const RunContext& context) {
  constexpr std::size_t kBetweenLooks = 16384;
  Patches patches(options);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % kBetweenLooks == 0 && context.stopped()) return {};
    if (const auto cell = patches.cell_of(cloud.points_m[i])) patches.add(*cell, cloud.points_m[i]);
  }
  std::vector<Eigen::Vector3f> out(cloud.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i % kBetweenLooks == 0 && context.stopped()) return {};
    if (const auto cell = patches.cell_of(cloud.points_m[i])) out[i] = patches.normal_at(*cell);
  }
  return out;
}

}  // namespace lvcalib
