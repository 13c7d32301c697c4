// SPDX-License-Identifier: BSD-3-Clause
#include "solve/board_returns.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "solve/surface_noise.h"

namespace lvcalib {
namespace {

// What stands before the board is nearer by more than any range effect moves a return.
constexpr double kCover_m = 0.03;
constexpr double kCoverSpots = 3.0;  // Widths of a Gaussian spot, beyond which 1 % of it lies.

// Returns for the search: places on the board from its middle, intensities less their mean.
struct Samples {
  std::vector<Eigen::Vector2d> from_center_m;
  std::vector<float> intensity;
  double squares = 0.0;
};

struct Trial {
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;
  double correlation = 0.0;
};

// Steps and ceiling of the intensities.
void describe_numbers(BoardReturns& returns) {
  // More different values than this are no steps that matter.
  constexpr std::size_t kMostSteps = 64;
  // Numbers pile up at a ceiling if this share of them is there, many times a value's usual share.
  constexpr double kPile = 0.05;
  constexpr double kPileOverUsual = 8.0;
  std::vector<float> values;
  values.reserve(returns.size());
  for (const std::uint32_t i : returns.index) values.push_back(returns.cloud->intensity[i]);
  std::sort(values.begin(), values.end());
  const float largest = values.back();
  const auto first = std::lower_bound(values.begin(), values.end(), largest);
  const double share =
      static_cast<double>(values.end() - first) / static_cast<double>(values.size());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.size() <= kMostSteps) {
    float step = largest;
    for (std::size_t k = 1; k < values.size(); ++k)
      step = std::min(step, values[k] - values[k - 1]);
    returns.intensity_step = static_cast<double>(step);
  }
  if (share > kPile && share * static_cast<double>(values.size()) > kPileOverUsual)
    returns.saturated = share;
}

}  // namespace

BoardReturns select_returns(const Cloud& cloud, const BlurredPrint& print,
                            const Rigid3& lidar_from_board, const BeamSpread& beam,
                            const RangeNoise& noise, const ReturnSelection& selection) {
  const BoardPredictor predictor(print, lidar_from_board, {}, beam);
  const double beam_rad = std::sqrt(beam.blur_rad2.trace());
  const BoardOutline& outline = print.outline();
  const Eigen::Vector2d center = outline.center_m();
  const double middle_m = (lidar_from_board * Eigen::Vector3d(center.x(), center.y(), 0.0)).norm();
  // One axis of the spot, as the nearest sample of the print need not know better.
  const BlurredPrint::Coarse blurred = print.coarse(beam_rad * middle_m / std::sqrt(2.0));
  BoardReturns out;
  out.cloud = &cloud;
  CoveredCells covered(outline);
  std::vector<PlacedReturn> near;
  std::vector<PlacedReturn> kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p = cloud.points_m[i].cast<double>();
    const double range = p.norm();
    const auto hit = predictor.hit(p / range);
    if (!hit) continue;
    const double inside = print.inside_m(hit->board_m);
    if (inside <= 0.0) continue;
    const double white = blurred.at(hit->board_m);
    const PlacedReturn at{static_cast<std::uint32_t>(i), hit->board_m, range - hit->range_m,
                          noise_between(noise.white_m, noise.black_m, white), white,
                          // One spot is wider than the beam's angles span by 1/cos θ at most.
                          kCoverSpots * beam_rad * range / 0.5};
    const double gate = selection.range_gate * at.sigma_m;
    if (at.off_m < -std::max(kCover_m, 2.0 * gate)) {
      covered.cover(at.board_m, at.reach_m);
      ++out.on_board;
      ++out.refused;
      continue;
    }
    if (at.off_m < -std::max(kCover_m, kTooNear * at.sigma_m)) near.push_back(at);
    if (inside < selection.inside_sigmas * beam_rad * range + selection.place_m) continue;
    ++out.on_board;
    if (std::abs(at.off_m) > gate) {
      ++out.refused;
      continue;
    }
    kept.push_back(at);
  }
  if (selection.covers) {
    cover_crowds(near, kept, outline, covered);
    cover_patches(kept, cloud, outline, covered);
  }
  for (const Eigen::AlignedBox2d& box : covered.patches()) out.covered.push_back({box, 0});
  for (const PlacedReturn& r : kept) {
    if (!covered.covers(r.board_m)) {
      out.index.push_back(r.point);
      continue;
    }
    ++out.refused;
    for (CoveredPatch& patch : out.covered) {
      if (!patch.board_m.contains(r.board_m)) continue;
      ++patch.returns;
      break;
    }
  }
  std::erase_if(out.covered, [](const CoveredPatch& patch) { return patch.returns == 0; });

  // Some drivers fill the field with one number.
  out.has_intensity = cloud.has_intensity() && !out.index.empty() &&
                      std::any_of(out.index.begin(), out.index.end(), [&](std::uint32_t i) {
                        return cloud.intensity[i] != cloud.intensity[out.index.front()];
                      });

  if (out.has_intensity) describe_numbers(out);

  out.successor.assign(out.size(), BoardReturns::kNone);
  std::map<std::uint16_t, std::uint32_t> last;
  for (std::uint32_t k = 0; k < out.index.size(); ++k) {
    const std::uint16_t line = cloud.has_line() ? cloud.line[out.index[k]] : std::uint16_t{0};
    const auto [at, fresh] = last.try_emplace(line, k);
    if (!fresh) {
      out.successor[at->second] = k;
      at->second = k;
    }
  }
  return out;
}

double intensity_structure(const BoardReturns& returns) {
  constexpr double kFewest = 20.0;
  double n = 0, sum = 0, squares = 0, pairs = 0, differences = 0;
  for (std::size_t k = 0; k < returns.size(); ++k) {
    const double i = returns.intensity(k);
    n += 1;
    sum += i;
    squares += i * i;
    const std::uint32_t next = returns.successor[k];
    if (next == BoardReturns::kNone) continue;
    pairs += 1;
    differences += std::pow(returns.intensity(next) - i, 2);
  }
  if (n < kFewest || pairs < kFewest || !(differences > 0.0)) return 1.0;
  return (squares / n - std::pow(sum / n, 2)) / (0.5 * differences / pairs);
}

namespace {

// Likelihood with the levels fitted: −n/2·ln(1 − ρ²).
double log_likelihood(double correlation, std::size_t samples) {
  const double r = std::clamp(correlation, 0.0, 0.9999);
  return -0.5 * static_cast<double>(samples) * std::log(1.0 - r * r);
}

bool better(const Trial& a, const Trial& b) {
  return a.correlation > b.correlation;
}

Samples samples_of(const BoardReturns& returns, const BoardPredictor& predictor,
                   const Eigen::Vector2d& center_m, std::size_t most) {
  Samples out;
  const std::size_t stride = std::max<std::size_t>(1, returns.size() / most);
  double sum = 0.0;
  for (std::size_t k = 0; k < returns.size(); k += stride) {
    const auto hit = predictor.hit(returns.point_m(k).normalized());
    if (!hit) continue;
    out.from_center_m.push_back(hit->board_m - center_m);
    out.intensity.push_back(static_cast<float>(returns.intensity(k)));
    sum += returns.intensity(k);
  }
  const auto mean = static_cast<float>(sum / static_cast<double>(out.intensity.size()));
  for (float& i : out.intensity) {
    i -= mean;
    out.squares += static_cast<double>(i) * static_cast<double>(i);
  }
  return out;
}

// Samples turned about the board's middle, as places on the raster of a blurred print.
struct TurnedSamples {
  TurnedSamples(const Samples& samples, const BlurredPrint::Coarse& print,
                const Eigen::Vector2d& center_m, double turn_rad) {
    turn = Eigen::Rotation2Dd(-turn_rad).toRotationMatrix();
    const Eigen::Vector2f center = print.in_samples(center_m).cast<float>();
    const Eigen::Matrix2f to_raster = (print.per_m() * turn).cast<float>();
    for (const Eigen::Vector2d& p : samples.from_center_m) {
      const Eigen::Vector2f at = center + to_raster * p.cast<float>();
      column.push_back(at.x());
      row.push_back(at.y());
    }
  }
  Eigen::Matrix2d turn;
  std::vector<float> column, row;
};

// Correlation of the samples with the print when the board is shifted and turned.
double correlation(const Samples& samples, const TurnedSamples& turned,
                   const BlurredPrint::Coarse& print, const Eigen::Vector2d& shift_m) {
  const Eigen::Vector2f shift = (print.per_m() * (turned.turn * shift_m)).cast<float>();
  double a = 0.0;
  double aa = 0.0;
  double ai = 0.0;
  for (std::size_t k = 0; k < samples.intensity.size(); ++k) {
    const double white = static_cast<double>(
        print.at_sample(turned.column[k] - shift.x(), turned.row[k] - shift.y()));
    a += white;
    aa += white * white;
    ai += white * static_cast<double>(samples.intensity[k]);
  }
  const double va = aa - a * a / static_cast<double>(samples.intensity.size());
  return va > 0.0 && samples.squares > 0.0 ? ai / std::sqrt(va * samples.squares) : 0.0;
}

// All shifts and turns about a pose, by steps; best first.
std::vector<Trial> trials_about(const Trial& from, const Samples& samples,
                                const BlurredPrint& print, double sigma_m, double reach_m,
                                double turns_rad, double step_m, double turn_rad, int threads = 1) {
  const int n = static_cast<int>(std::ceil(reach_m / step_m));
  const int m = static_cast<int>(std::ceil(turns_rad / turn_rad));
  const BlurredPrint::Coarse blurred = print.coarse(sigma_m);
  const Eigen::Vector2d center = print.outline().center_m();
  const auto side = static_cast<std::size_t>(2 * n + 1);
  const auto turns = static_cast<std::size_t>(2 * m + 1);
  std::vector<Trial> tried(turns * side * side);
  parallel_for(turns, threads, [&](std::size_t k) {
    Trial t = from;
    t.turn_rad += turn_rad * (static_cast<int>(k) - m);
    const TurnedSamples turned(samples, blurred, center, t.turn_rad);
    Trial* at = tried.data() + k * side * side;
    for (int ix = -n; ix <= n; ++ix) {
      for (int iy = -n; iy <= n; ++iy) {
        t.shift_m = from.shift_m + step_m * Eigen::Vector2d(ix, iy);
        t.correlation = correlation(samples, turned, blurred, t.shift_m);
        *at++ = t;
      }
    }
  });
  std::sort(tried.begin(), tried.end(), better);
  return tried;
}

// The best of those that are at least so far apart.
std::vector<Trial> distinct(const std::vector<Trial>& tried, double apart_m, std::size_t most) {
  std::vector<Trial> out;
  for (const Trial& t : tried) {
    const bool taken = std::any_of(out.begin(), out.end(), [&](const Trial& other) {
      return (t.shift_m - other.shift_m).norm() < apart_m;
    });
    if (!taken) out.push_back(t);
    if (out.size() == most) break;
  }
  return out;
}

}  // namespace

std::vector<PrintMatch> match_print(const BoardReturns& returns, const BlurredPrint& print,
                                    const Rigid3& lidar_from_board, const PrintSearch& search,
                                    int threads) {
  constexpr std::size_t kFewest = 30;  // A correlation of 0.3, asked for below, is then 1.6 σ.
  constexpr double kLeastCorrelation = 0.3;
  if (!returns.has_intensity || returns.size() < kFewest) return {};
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  const Samples samples =
      samples_of(returns, predictor, print.outline().center_m(), search.samples);
  // Coarse to fine: the first blur joins what a step parts. Maxima that lie elsewhere are followed
  // by themselves, so that the best can be told from the second best.
  const double radius = 0.5 * print.outline().size_m().norm();
  const auto turn_of = [&](double sigma) { return std::max(0.002, 1.2 * sigma / radius); };
  constexpr double kCoarse_m = 0.016;
  std::vector<Trial> best =
      distinct(trials_about({}, samples, print, kCoarse_m, search.reach_m, search.turn_rad,
                            kCoarse_m, turn_of(kCoarse_m), threads),
               kOtherPlace_m, search.places);
  // Down to a millimetre: a place is worse than another by its step otherwise. No beam sees finer
  // than the last blur.
  constexpr double kFinest_m = 0.004;
  // At every step to the best of the neighbours until none is better: the step before left one or
  // two to go, and a ridge may take some more.
  constexpr int kMostMoves = 8;
  parallel_for(best.size(), threads, [&](std::size_t k) {
    for (const double step : {0.008, 0.004, 0.002, 0.001}) {
      const double sigma = std::max(step, kFinest_m);
      for (int move = 0; move < kMostMoves; ++move) {
        const Trial before = best[k];
        best[k] =
            trials_about(before, samples, print, sigma, step, turn_of(step), step, turn_of(step))
                .front();
        if (best[k].shift_m == before.shift_m && best[k].turn_rad == before.turn_rad) break;
      }
    }
  });
  std::sort(best.begin(), best.end(), better);
  // Two may have come together.
  best = distinct(best, kOtherPlace_m, search.places);
  std::vector<PrintMatch> out;
  const Eigen::Vector2d center = print.outline().center_m();
  const Eigen::Vector3d middle(center.x(), center.y(), 0.0);
  for (const Trial& t : best) {
    if (!(t.correlation > kLeastCorrelation)) break;
    const Eigen::Vector3d shifted = middle + Eigen::Vector3d(t.shift_m.x(), t.shift_m.y(), 0.0);
    const Eigen::Matrix3d spin = so3_exp({0.0, 0.0, t.turn_rad}).toRotationMatrix();
    out.push_back({lidar_from_board * Rigid3::from_matrix(spin, shifted - spin * middle),
                   t.correlation, log_likelihood(t.correlation, samples.intensity.size())});
  }
  return out;
}

}  // namespace lvcalib
