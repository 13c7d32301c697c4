// SPDX-License-Identifier: BSD-3-Clause
#include "solve/print_match.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/paired_moments.h"
#include "base/parallel.h"

namespace lvcalib {
namespace {

// The print is seen where it explains a tenth of the intensities' variance.
constexpr double kPrintSeen = 0.3;

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

// How far to shift and turn, in which steps, under which blur.
struct TrialGrid {
  double sigma_m;
  double reach_m, step_m;
  double turns_rad, turn_rad;
};

// All shifts and turns about a pose, by steps; best first.
std::vector<Trial> trials_about(const Trial& from, const Samples& samples,
                                const BlurredPrint& print, const TrialGrid& grid, int threads = 1) {
  const int n = static_cast<int>(std::ceil(grid.reach_m / grid.step_m));
  const int m = static_cast<int>(std::ceil(grid.turns_rad / grid.turn_rad));
  const BlurredPrint::Coarse blurred = print.coarse(grid.sigma_m);
  const Eigen::Vector2d center = print.outline().center_m();
  const auto side = static_cast<std::size_t>(2 * n + 1);
  const auto turns = static_cast<std::size_t>(2 * m + 1);
  std::vector<Trial> tried(turns * side * side);
  parallel_for(turns, threads, [&](std::size_t k) {
    Trial t = from;
    t.turn_rad += grid.turn_rad * (static_cast<int>(k) - m);
    const TurnedSamples turned(samples, blurred, center, t.turn_rad);
    Trial* at = tried.data() + k * side * side;
    for (int ix = -n; ix <= n; ++ix) {
      for (int iy = -n; iy <= n; ++iy) {
        t.shift_m = from.shift_m + grid.step_m * Eigen::Vector2d(ix, iy);
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
  if (!returns.has_intensity || returns.size() < kFewest) return {};
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  const Samples samples =
      samples_of(returns, predictor, print.outline().center_m(), search.samples);
  // Coarse to fine: the first blur joins what a step parts. Maxima that lie elsewhere are followed
  // by themselves, so that the best can be told from the second best.
  const double radius = 0.5 * print.outline().size_m().norm();
  const auto turn_of = [&](double sigma) { return std::max(0.002, 1.2 * sigma / radius); };
  constexpr double kCoarse_m = 0.016;
  std::vector<Trial> best = distinct(trials_about({}, samples, print,
                                                  {.sigma_m = kCoarse_m,
                                                   .reach_m = search.reach_m,
                                                   .step_m = kCoarse_m,
                                                   .turns_rad = search.turn_rad,
                                                   .turn_rad = turn_of(kCoarse_m)},
                                                  threads),
                                     kOtherPlace_m, search.places);
  // Down to a millimetre: a place is worse than another by its step otherwise. No beam sees finer
  // than the last blur.
  constexpr double kFinest_m = 0.004;
  // At every step to the best of the neighbours until none is better: the step before left one or
  // two to go, and a ridge may take some more.
  constexpr int kMostMoves = 8;
  parallel_for(best.size(), threads, [&](std::size_t k) {
    for (const double step : {0.008, 0.004, 0.002, 0.001}) {
      // The nearest neighbours.
      const TrialGrid grid{.sigma_m = std::max(step, kFinest_m),
                           .reach_m = step,
                           .step_m = step,
                           .turns_rad = turn_of(step),
                           .turn_rad = turn_of(step)};
      for (int move = 0; move < kMostMoves; ++move) {
        const Trial before = best[k];
        best[k] = trials_about(before, samples, print, grid).front();
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
    if (!(t.correlation > kPrintSeen)) break;
    const Eigen::Vector3d shifted = middle + Eigen::Vector3d(t.shift_m.x(), t.shift_m.y(), 0.0);
    const Eigen::Matrix3d spin = so3_exp({0.0, 0.0, t.turn_rad}).toRotationMatrix();
    out.push_back({lidar_from_board * Rigid3::from_matrix(spin, shifted - spin * middle),
                   t.correlation, log_likelihood(t.correlation, samples.intensity.size())});
  }
  return out;
}

namespace {

// Of one scene's intensities and the print under an extrinsic; a blur of 12 mm bridges what the
// votes are still off.
PairedMoments moments_at(const BoardReturns& returns, const BlurredPrint& print,
                         const Rigid3& lidar_from_board) {
  constexpr double kBlur_m = 0.012;
  constexpr std::size_t kSamples = 1500;  // As many as the search slides over the print.
  PairedMoments out;
  if (!returns.has_intensity) return out;
  const BoardPredictor predictor(print, lidar_from_board, {}, {});
  const BlurredPrint::Coarse blurred = print.coarse(kBlur_m);
  const std::size_t stride = std::max<std::size_t>(1, returns.size() / kSamples);
  for (std::size_t k = 0; k < returns.size(); k += stride) {
    const auto hit = predictor.hit(returns.point_m(k).normalized());
    if (hit) out.add(blurred.at(hit->board_m), returns.intensity(k));
  }
  return out;
}

// Correlations of fewer samples are none.
double correlation(const PairedMoments& moments) {
  constexpr double kFewest = 10.0;
  return moments.n > kFewest ? std::clamp(moments.correlation(), 0.0, 0.9999) : 0.0;
}

// Whether some board's middle lies elsewhere under another extrinsic. What is off by less comes
// back in the solve.
bool lies_elsewhere(const Rigid3& a, const Rigid3& b, const std::vector<Rigid3>& camera_from_board,
                    const Eigen::Vector2d& center_m) {
  return std::any_of(camera_from_board.begin(), camera_from_board.end(), [&](const Rigid3& board) {
    const Eigen::Vector3d middle = board * Eigen::Vector3d(center_m.x(), center_m.y(), 0.0);
    return (b.inverse() * middle - a.inverse() * middle).norm() > kOtherPlace_m;
  });
}

}  // namespace

std::optional<PrintVote> vote_on_print(const std::vector<BoardReturns>& returns,
                                       const BlurredPrint& print,
                                       const std::vector<Rigid3>& camera_from_board,
                                       const Rigid3& camera_from_lidar, const PrintSearch& search,
                                       const RunContext& context) {
  PrintVote out;
  out.scenes.resize(returns.size());
  std::vector<Rigid3> votes{camera_from_lidar};
  std::vector<bool> found(returns.size(), false);
  for (std::size_t s = 0; s < returns.size(); ++s) {
    if (context.stopped()) return std::nullopt;
    const auto matches =
        match_print(returns[s], print, camera_from_lidar.inverse() * camera_from_board[s], search,
                    context.thread_count());
    if (matches.empty()) continue;
    found[s] = true;
    out.scenes[s].correlation = matches.front().correlation;
    out.scenes[s].margin =
        matches.front().log_likelihood - (matches.size() > 1 ? matches[1].log_likelihood : 0.0);
    for (const PrintMatch& match : matches)
      votes.push_back(camera_from_board[s] * match.lidar_from_board.inverse());
  }
  const auto moments = [&](std::size_t s, const Rigid3& vote) {
    return moments_at(returns[s], print, vote.inverse() * camera_from_board[s]);
  };
  std::vector<double> likelihood(votes.size(), 0.0);
  parallel_for(votes.size(), context.thread_count(), [&](std::size_t v) {
    for (std::size_t s = 0; s < returns.size(); ++s) {
      const PairedMoments m = moments(s, votes[v]);
      likelihood[v] += log_likelihood(correlation(m), static_cast<std::size_t>(m.n));
    }
  });
  const auto best = static_cast<std::size_t>(
      std::max_element(likelihood.begin(), likelihood.end()) - likelihood.begin());
  const Eigen::Vector2d center = print.outline().center_m();
  double other = 0.0;
  for (std::size_t v = 0; v < votes.size(); ++v) {
    if (lies_elsewhere(votes[v], votes[best], camera_from_board, center))
      other = std::max(other, likelihood[v]);
  }
  out.camera_from_lidar = votes[best];
  out.margin = likelihood[best] - other;
  // What no scene's own search found may be there where the others put it.
  for (std::size_t s = 0; s < returns.size(); ++s) {
    if (!returns[s].has_intensity || found[s]) continue;
    const double rho = correlation(moments(s, votes[best]));
    out.scenes[s].unseen = !(rho > kPrintSeen);
    if (!out.scenes[s].unseen) out.scenes[s].correlation = rho;
  }
  return out;
}

}  // namespace lvcalib
