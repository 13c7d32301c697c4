// SPDX-License-Identifier: BSD-3-Clause
#include "solve/covered_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <Eigen/Cholesky>

#include "base/statistics.h"

namespace lvcalib {
namespace {

constexpr double kCell_m = 0.01;
// Of Gaussian noise, one-sided, beyond kTooNear.
constexpr double kTooNearChance = 3.2e-5;
// That a board with nothing before it or on it is taken for covered somewhere.
constexpr double kFalseCover = 1e-3;

// Counts of places on the board, to be asked for squares about a place.
class PlaceCounts {
 public:
  PlaceCounts(const BoardOutline& outline, const std::vector<PlacedReturn>& returns)
      : low_(outline.lower_left_m),
        columns_(static_cast<int>(std::ceil(outline.size_m().x() / kCell_m)) + 1),
        rows_(static_cast<int>(std::ceil(outline.size_m().y() / kCell_m)) + 1),
        below_(Eigen::ArrayXXd::Zero(columns_ + 1, rows_ + 1)) {
    for (const PlacedReturn& r : returns)
      below_(column(r.board_m.x()) + 1, row(r.board_m.y()) + 1) += 1.0;
    // Sums over all that lies left and below.
    for (int r = 1; r <= rows_; ++r) {
      for (int c = 1; c <= columns_; ++c)
        below_(c, r) += below_(c - 1, r) + below_(c, r - 1) - below_(c - 1, r - 1);
    }
  }
  [[nodiscard]] double about(const Eigen::Vector2d& p, double radius_m) const {
    const int left = column(p.x() - radius_m), right = column(p.x() + radius_m) + 1;
    const int bottom = row(p.y() - radius_m), top = row(p.y() + radius_m) + 1;
    return below_(right, top) - below_(left, top) - below_(right, bottom) + below_(left, bottom);
  }

 private:
  [[nodiscard]] int column(double x) const {
    return std::clamp(static_cast<int>(std::floor((x - low_.x()) / kCell_m)), 0, columns_ - 1);
  }
  [[nodiscard]] int row(double y) const {
    return std::clamp(static_cast<int>(std::floor((y - low_.y()) / kCell_m)), 0, rows_ - 1);
  }
  Eigen::Vector2d low_;
  int columns_, rows_;
  Eigen::ArrayXXd below_;
};

enum class Plain { kWhite, kBlack, kNo };

Plain plain_of(const PlacedReturn& r) {
  // What is left of an edge then shifts neither level by more than a few per cent of the contrast.
  constexpr double kPlain = 0.03;
  if (r.white > 1.0 - kPlain) return Plain::kWhite;
  return r.white < kPlain ? Plain::kBlack : Plain::kNo;
}

// A return on plain print, its range freed from what its line and its print do to all.
struct PlainReturn {
  Eigen::Vector2d board_m;
  double off_m, sigma_m;
  double intensity;
  Plain print;
  std::uint16_t line;
  double reach_m;
};

template <class Key>
void take_out_medians(std::vector<PlainReturn>& returns, const Key& key) {
  constexpr std::size_t kFewest = 8;  // A median of fewer is known little better than one return.
  std::map<int, std::vector<double>> values;
  for (const PlainReturn& r : returns) values[key(r)].push_back(r.off_m);
  std::map<int, double> middle;
  for (const auto& [k, v] : values) {
    if (v.size() >= kFewest) middle[k] = median(v);
  }
  for (PlainReturn& r : returns) {
    const auto found = middle.find(key(r));
    if (found != middle.end()) r.off_m -= found->second;
  }
}

// What the returns of one square of plain print say on average.
struct PatchMean {
  Eigen::Vector2d board_m = Eigen::Vector2d::Zero();
  double count = 0.0;
  double off_m = 0.0;
  double variance_m2 = 0.0;
  double reach_m = 0.0;
  std::array<double, 2> intensity{}, intensity_count{};
};

std::vector<PatchMean> patch_means(const std::vector<PlainReturn>& returns,
                                   const BoardOutline& outline, double side_m) {
  std::map<std::pair<int, int>, PatchMean> cells;
  for (const PlainReturn& r : returns) {
    const Eigen::Vector2d at = (r.board_m - outline.lower_left_m) / side_m;
    PatchMean& cell =
        cells[{static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))}];
    cell.count += 1.0;
    cell.board_m += r.board_m;
    cell.off_m += r.off_m;
    cell.variance_m2 += r.sigma_m * r.sigma_m;
    cell.reach_m = std::max(cell.reach_m, r.reach_m);
    const auto k = static_cast<std::size_t>(r.print);
    cell.intensity[k] += r.intensity;
    cell.intensity_count[k] += 1.0;
  }
  std::vector<PatchMean> out;
  for (auto& [index, cell] : cells) {
    cell.board_m /= cell.count;
    cell.off_m /= cell.count;
    cell.variance_m2 /= cell.count * cell.count;
    for (std::size_t k = 0; k < 2; ++k) {
      if (cell.intensity_count[k] > 0.0) cell.intensity[k] /= cell.intensity_count[k];
    }
    out.push_back(cell);
  }
  return out;
}

// Takes a surface of second degree out of the patches' offsets: a pose that is a little off, a
// board that is bent. Huber's weights keep what stands out from bending it.
void take_out_surface(std::vector<PatchMean>& patches, const BoardOutline& outline) {
  using Row = Eigen::Matrix<double, 6, 1>;
  const auto row_of = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d u = (p - outline.center_m()).cwiseQuotient(0.5 * outline.size_m());
    return Row(1.0, u.x(), u.y(), u.x() * u.x(), u.x() * u.y(), u.y() * u.y());
  };
  Row x = Row::Zero();
  for (int round = 0; round < 5; ++round) {
    Eigen::Matrix<double, 6, 6> normal = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
    Row gradient = Row::Zero();
    for (const PatchMean& patch : patches) {
      const Row row = row_of(patch.board_m);
      const double sigma = std::sqrt(patch.variance_m2);
      const double w = huber_weight((patch.off_m - row.dot(x)) / sigma, 2.0) / patch.variance_m2;
      normal += w * row * row.transpose();
      gradient += w * patch.off_m * row;
    }
    x = normal.ldlt().solve(gradient);
  }
  for (PatchMean& patch : patches) patch.off_m -= row_of(patch.board_m).dot(x);
}

// Levels of plain white and plain black and the scatter about them; nothing without contrast.
struct PlainLevels {
  std::array<double, 2> level{}, sigma{};
  [[nodiscard]] double middle() const { return 0.5 * (level[0] + level[1]); }
};
std::optional<PlainLevels> plain_levels(const std::vector<PlainReturn>& returns) {
  constexpr std::size_t kFewest = 20;
  PlainLevels out;
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> values;
    for (const PlainReturn& r : returns) {
      if (static_cast<std::size_t>(r.print) == k) values.push_back(r.intensity);
    }
    if (values.size() < kFewest) return std::nullopt;
    out.level[k] = median(values);
    out.sigma[k] = mad_sigma(values);
  }
  // The prints must be told apart by single returns, or a patch's mean says little of what it is.
  if (!(std::abs(out.level[0] - out.level[1]) > 3.0 * (out.sigma[0] + out.sigma[1])))
    return std::nullopt;
  return out;
}

// Whether one print of a patch looks like the other.
bool is_other_print(const PatchMean& patch, const PlainLevels& levels, double gate) {
  constexpr double kFewest = 3.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double n = patch.intensity_count[k];
    if (n < kFewest) continue;
    // Towards the other print, beyond the middle.
    const double beyond =
        (levels.level[k] > levels.middle() ? -1.0 : 1.0) * (patch.intensity[k] - levels.middle());
    const double sigma = std::max(levels.sigma[0], levels.sigma[1]) / std::sqrt(n);
    if (beyond > gate * sigma) return true;
  }
  return false;
}

}  // namespace

CoveredCells::CoveredCells(const BoardOutline& outline)
    : low_(outline.lower_left_m),
      columns_(static_cast<int>(std::ceil(outline.size_m().x() / kCell_m)) + 1),
      rows_(static_cast<int>(std::ceil(outline.size_m().y() / kCell_m)) + 1),
      covered_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void CoveredCells::cover(const Eigen::Vector2d& board_m, double radius_m) {
  any_ = true;
  const Eigen::Vector2d a = (board_m - low_).array() - radius_m;
  const Eigen::Vector2d b = (board_m - low_).array() + radius_m;
  for (int r = row(a.y()); r <= row(b.y()); ++r) {
    for (int c = column(a.x()); c <= column(b.x()); ++c) covered_[place(c, r)] = 1;
  }
}

bool CoveredCells::covers(const Eigen::Vector2d& board_m) const {
  if (!any_) return false;
  const Eigen::Vector2d d = board_m - low_;
  return covered_[place(column(d.x()), row(d.y()))] != 0;
}

std::vector<Eigen::AlignedBox2d> CoveredCells::patches() const {
  std::vector<Eigen::AlignedBox2d> out;
  if (!any_) return out;
  std::vector<std::uint8_t> open = covered_;
  std::vector<std::pair<int, int>> edge;
  for (int r0 = 0; r0 < rows_; ++r0) {
    for (int c0 = 0; c0 < columns_; ++c0) {
      if (open[place(c0, r0)] == 0) continue;
      Eigen::AlignedBox2d box;
      open[place(c0, r0)] = 0;
      edge.assign(1, {c0, r0});
      while (!edge.empty()) {
        const auto [c, r] = edge.back();
        edge.pop_back();
        box.extend(low_ + kCell_m * Eigen::Vector2d(c, r));
        box.extend(low_ + kCell_m * Eigen::Vector2d(c + 1, r + 1));
        for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int nc = c + dc;
          const int nr = r + dr;
          if (nc < 0 || nr < 0 || nc >= columns_ || nr >= rows_ || open[place(nc, nr)] == 0)
            continue;
          open[place(nc, nr)] = 0;
          edge.emplace_back(nc, nr);
        }
      }
      out.push_back(box);
    }
  }
  return out;
}

int CoveredCells::column(double x) const {
  return std::clamp(static_cast<int>(std::floor(x / kCell_m)), 0, columns_ - 1);
}

int CoveredCells::row(double y) const {
  return std::clamp(static_cast<int>(std::floor(y / kCell_m)), 0, rows_ - 1);
}

std::size_t CoveredCells::place(int c, int r) const {
  return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(c);
}

// As many others about one that chance, at the rate of what is not covered, brings them together
// once in a thousand boards. Where a board lies off its plane all of it is too near, and nothing
// stands out.
void cover_crowds(const std::vector<PlacedReturn>& near, const std::vector<PlacedReturn>& kept,
                  const BoardOutline& outline, CoveredCells& covered) {
  if (near.size() < 2) return;
  const PlaceCounts near_counts(outline, near);
  const PlaceCounts counts(outline, kept);
  std::vector<PlacedReturn> left = near;
  for (bool found = true; found;) {
    std::erase_if(left, [&](const PlacedReturn& r) { return covered.covers(r.board_m); });
    const auto uncovered =
        static_cast<double>(std::count_if(kept.begin(), kept.end(), [&](const PlacedReturn& r) {
          return !covered.covers(r.board_m);
        }));
    const double rate =
        std::max(kTooNearChance, static_cast<double>(left.size()) / std::max(1.0, uncovered));
    found = false;
    for (const PlacedReturn& r : left) {
      const double others = near_counts.about(r.board_m, r.reach_m) - 1.0;
      const double about = std::max(others, counts.about(r.board_m, r.reach_m));
      if (others < 1.0 ||
          poisson_tail(others, rate * about) > kFalseCover / static_cast<double>(near.size()))
        continue;
      covered.cover(r.board_m, r.reach_m);
      found = true;
    }
  }
}

void cover_patches(const std::vector<PlacedReturn>& kept, const Cloud& cloud,
                   const BoardOutline& outline, CoveredCells& covered) {
  // A finger's thickness: more than prints and shapes that are not known yet do to a small part of
  // a board once the whole board's share is out.
  constexpr double kThick_m = 0.01;
  constexpr double kRowsWanted = 12.0;  // In a patch: its mean is then known to 0.3 σ.
  constexpr double kFewest = 5.0;
  constexpr double kSmallest_m = 0.03;  // Smaller hides an edge or two.
  constexpr double kLargest_m = 0.15;   // Larger is a tag or a hand and a half.
  constexpr double kMostCovered = 0.25;
  std::vector<PlainReturn> plain;
  for (const PlacedReturn& r : kept) {
    const Plain print = plain_of(r);
    if (print == Plain::kNo || covered.covers(r.board_m)) continue;
    plain.push_back({r.board_m, r.off_m, r.sigma_m,
                     cloud.has_intensity() ? static_cast<double>(cloud.intensity[r.point]) : 0.0,
                     print, cloud.has_line() ? cloud.line[r.point] : std::uint16_t{0}, r.reach_m});
  }
  const double area = outline.size_m().prod();
  const double side =
      std::max(kSmallest_m, std::sqrt(kRowsWanted * area / std::max<double>(1.0, plain.size())));
  if (side > kLargest_m) return;
  for (int sweep = 0; sweep < 2; ++sweep) {
    take_out_medians(plain, [](const PlainReturn& r) { return static_cast<int>(r.print); });
    if (cloud.has_line())
      take_out_medians(plain, [](const PlainReturn& r) { return static_cast<int>(r.line); });
  }
  std::vector<PatchMean> patches = patch_means(plain, outline, side);
  std::erase_if(patches, [&](const PatchMean& p) { return p.count < kFewest; });
  if (patches.size() < 20) return;
  take_out_surface(patches, outline);
  // Neighbours err alike and noise has tails: the patches' own scatter, where it is larger.
  std::vector<double> sizes;
  for (const PatchMean& p : patches) sizes.push_back(p.off_m / std::sqrt(p.variance_m2));
  const double scatter = std::max(1.0, mad_sigma(sizes));
  const double gate = -normal_quantile(0.5 * kFalseCover / static_cast<double>(patches.size()));
  const auto levels = cloud.has_intensity() ? plain_levels(plain) : std::nullopt;
  std::vector<const PatchMean*> other;
  for (const PatchMean& p : patches) {
    const bool stands_out =
        std::abs(p.off_m) > std::max(kThick_m, gate * scatter * std::sqrt(p.variance_m2));
    if (stands_out || (levels && is_other_print(p, *levels, gate))) other.push_back(&p);
  }
  if (static_cast<double>(other.size()) > kMostCovered * static_cast<double>(patches.size()))
    return;
  for (const PatchMean* p : other) covered.cover(p->board_m, 0.5 * side + p->reach_m);
}

}  // namespace lvcalib
