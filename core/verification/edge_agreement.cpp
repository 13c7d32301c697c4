// SPDX-License-Identifier: BSD-3-Clause
#include "verification/edge_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/text.h"

namespace lvcalib {
namespace {

constexpr int kUnknowns = 7;  // The pose and how far range edges stand outside.
using Vector7d = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix7d = Eigen::Matrix<double, kUnknowns, kUnknowns>;

// Beams are a few mrad wide; what a threshold makes of one is a part of that.
constexpr double kWidening_rad = 2e-3;
// Edges within a part of this many to the image's width share what is wrong with them.
// Things span a sixth of a picture; of sixteenths, the intervals of 12 simulated rooms covered
// half.
constexpr int kParts = 6;
// Of a width; four do, as the next width goes on from there.
constexpr int kIterations = 12;
// A pose further away is taken if its gain is beyond so many σ: by chance in one case of forty.
constexpr double kBetter = 2.0;
// And contradicts beyond so many: by chance in one case of a thousand.
constexpr double kSignificant = 3.1;
// Nor may chance explain the offset itself, which is known less well than the gain: beyond its 95 %
// interval.
constexpr double kOff = 2.0;
// Edges that agree no better than chance at so many σ do not meet: by chance one case in 700.
constexpr double kMeets = 3.0;

// View, and place in its image.
using Part = std::tuple<std::size_t, int, int>;

// An edge of the LiDAR in the picture.
struct Placed {
  const ImageEdges* image = nullptr;
  Eigen::Vector2d pixel;
  Eigen::Vector2d crossing;  // How the scan crosses it there, px per rad.
  Eigen::Matrix<double, 2, 6> by_pose;
  double width_px = 1.0;  // See EdgeScore.
  LidarEdge::Kind kind = LidarEdge::Kind::kRange;
  Part part;
  std::pair<std::size_t, std::size_t> source;  // View and edge.
};

std::vector<Placed> place(const std::vector<EdgeView>& views, const Camera& camera,
                          const Rigid3& pose) {
  std::vector<Placed> out;
  const double side = static_cast<double>(camera.width_px) / kParts;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (std::size_t e = 0; e < views[v].lidar_edges.size(); ++e) {
      const LidarEdge& edge = views[v].lidar_edges[e];
      const Eigen::Vector3d p = pose * edge.point_m;
      Eigen::Matrix<double, 2, 3> by_point;
      const auto pixel = camera.project(p, &by_point);
      if (!pixel || !camera.in_image(*pixel)) continue;
      Placed placed;
      placed.image = views[v].image_edges.get();
      placed.pixel = *pixel;
      placed.crossing = by_point * (pose.rotation * edge.across) * edge.point_m.norm();
      placed.width_px = 2.0 * std::hypot(kImageEdge_px, placed.crossing.norm() * edge.spacing_rad /
                                                            std::sqrt(12.0));
      placed.by_pose << by_point, -by_point * skew(p);
      placed.kind = edge.kind;
      placed.source = {v, e};
      placed.part = {v, static_cast<int>(pixel->x() / side), static_cast<int>(pixel->y() / side)};
      out.push_back(placed);
    }
  }
  return out;
}

double count_of(const Placed& edge, const Eigen::Vector2d& shift) {
  const auto* nearest = edge.image->nearest(edge.pixel + shift, edge.crossing);
  if (nearest == nullptr) return 0.0;
  const double d2 = (edge.pixel + shift - nearest->pixel.cast<double>()).squaredNorm() /
                    (edge.width_px * edge.width_px);
  return std::exp(-0.5 * d2);
}

EdgeScore score_of(const std::vector<Placed>& placed) {
  EdgeScore out;
  out.edges = placed.size();
  if (placed.empty()) return out;
  struct Sums {
    double counts = 0.0, chance = 0.0, number = 0.0;
  };
  std::map<Part, Sums> parts;
  // Shifts beyond what may be the same edge, and not so far that the picture is another one.
  std::array<Eigen::Vector2d, 12> shifts;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / shifts.size();
    const double radius = 6.0 + 3.0 * static_cast<double>(k % 3);
    shifts[k] = radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  Sums all;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const double count = count_of(placed[i], Eigen::Vector2d::Zero());
    // Two shifts an edge, other ones for its neighbours.
    double chance = 0.0;
    int seen = 0;
    for (const std::size_t k : {i % shifts.size(), (i + 7) % shifts.size()}) {
      const Eigen::Vector2d shift = placed[i].width_px * shifts[k];
      if (placed[i].image->nearest(placed[i].pixel + shift, placed[i].crossing) == nullptr)
        continue;
      chance += count_of(placed[i], shift);
      ++seen;
    }
    if (seen > 0) chance /= seen;
    Sums& part = parts[placed[i].part];
    for (Sums* s : {&part, &all}) s->counts += count, s->chance += chance, s->number += 1.0;
  }
  const double share = all.counts / all.number;
  out.chance = all.chance / all.number;
  const double room = std::max(1e-6, 1.0 - out.chance);
  out.score = (share - out.chance) / room;
  // Delta method for a ratio of sums over parts.
  double square = 0.0;
  for (const auto& [key, s] : parts) {
    const double off = (s.counts - s.chance) - out.score * (s.number - s.chance);
    square += off * off;
  }
  const auto n = static_cast<double>(parts.size());
  out.sigma = parts.size() < 2 ? 1.0 : std::sqrt(square * n / (n - 1.0)) / (all.number * room);
  return out;
}

// What the score gains from one pose to another, over the edges that are in the picture at both.
struct Gain {
  double value = 0.0;
  double sigma = 1.0;
};

Gain gain_of(const std::vector<Placed>& from, const std::vector<Placed>& to) {
  std::map<Part, std::pair<double, double>> parts;
  double sum = 0.0, number = 0.0;
  auto at = to.begin();
  for (const Placed& edge : from) {
    // Both are in the order of their sources.
    while (at != to.end() && at->source < edge.source) ++at;
    if (at == to.end()) break;
    if (at->source != edge.source) continue;
    const Eigen::Vector2d here = Eigen::Vector2d::Zero();
    const double gain = count_of(*at, here) - count_of(edge, here);
    parts[edge.part].first += gain;
    parts[edge.part].second += 1.0;
    sum += gain;
    number += 1.0;
  }
  if (parts.size() < 2) return {};
  Gain out;
  out.value = sum / number;
  double square = 0.0;
  for (const auto& [part, s] : parts) square += std::pow(s.first - out.value * s.second, 2);
  const auto n = static_cast<double>(parts.size());
  out.sigma = std::sqrt(square * n / (n - 1.0)) / number;
  return out;
}

// What the score would lose if the edges that meet were all off by a distance.
double loss_of(const std::vector<Placed>& placed, double distance_px) {
  double sum = 0.0;
  for (const Placed& edge : placed) {
    const double x = distance_px / edge.width_px;
    sum += count_of(edge, Eigen::Vector2d::Zero()) * (1.0 - std::exp(-0.5 * x * x));
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, placed.size()));
}

struct Estimate {
  Vector7d unknowns = Vector7d::Zero();
  Rigid3 pose;
  Matrix7d covariance = Matrix7d::Zero();
  std::size_t parts = 0;
};

// Row of one edge: its distance from the image's along that one's normal, and what each unknown
// does to it.
struct Row {
  double distance = 0.0;
  Vector7d by = Vector7d::Zero();
  double weight = 0.0;
  double width_px = 1.0;
};

// `least_px`: width at least.
std::optional<Row> row_of(const Placed& edge, double widening, double least_px) {
  const double width_px = std::max(least_px, edge.width_px);
  const Eigen::Vector2d outward = edge.kind == LidarEdge::Kind::kRange
                                      ? edge.crossing
                                      : Eigen::Vector2d(Eigen::Vector2d::Zero());
  const Eigen::Vector2d pixel = edge.pixel - widening * outward;
  const auto* nearest = edge.image->nearest(pixel, edge.crossing);
  if (nearest == nullptr) return std::nullopt;
  const Eigen::Vector2d normal = nearest->normal.cast<double>();
  const Eigen::Vector2d off = pixel - nearest->pixel.cast<double>();
  if (off.squaredNorm() > 16.0 * width_px * width_px) return std::nullopt;
  Row row;
  row.distance = normal.dot(off);
  row.by.head<6>() = edge.by_pose.transpose() * normal;
  row.by(6) = -normal.dot(outward);
  row.width_px = width_px;
  row.weight = std::exp(-0.5 * off.squaredNorm() / (width_px * width_px));
  return row;
}

class Fit {
 public:
  Fit(const std::vector<EdgeView>& views, const Camera& camera, const Rigid3& start,
      const EdgeCheckOptions& options)
      : views_(views), camera_(camera), start_(start) {
    Vector7d sigma;
    sigma << Eigen::Vector3d::Constant(options.reach_m),
        Eigen::Vector3d::Constant(options.reach_rad), kWidening_rad;
    prior_ = sigma.cwiseInverse().cwiseAbs2();
    estimate_.pose = start;
  }

  // Draws the pose to where the edges agree within their widths, or a larger one.
  void draw(double least_px, const RunContext& context) {
    for (int k = 0; k < kIterations && !context.stopped(); ++k) {
      Matrix7d h = Matrix7d::Zero();
      Vector7d g = Vector7d::Zero();
      for (const Placed& edge : place(views_, camera_, estimate_.pose)) {
        const auto row = row_of(edge, estimate_.unknowns(6), least_px);
        if (!row) continue;
        const double variance = row->width_px * row->width_px;
        h.noalias() += row->weight / variance * row->by * row->by.transpose();
        g.noalias() -= row->weight / variance * row->distance * row->by;
      }
      g -= prior_.cwiseProduct(estimate_.unknowns);
      h.diagonal() += prior_;
      const Vector7d step = h.ldlt().solve(g);
      move(step);
      if (step.cwiseProduct(prior_.cwiseSqrt()).norm() < 1e-6) break;
    }
  }

  // What scatters between parts of the image says of the errors.
  const Estimate& finish() {
    Matrix7d h = Matrix7d::Zero();
    struct Sums {
      Vector7d off = Vector7d::Zero();
      Vector7d shared = Vector7d::Zero();  // What one pixel does that all its edges are off by.
    };
    std::map<Part, Sums> parts;
    for (const Placed& edge : place(views_, camera_, estimate_.pose)) {
      const auto row = row_of(edge, estimate_.unknowns(6), 0.0);
      if (!row) continue;
      const double variance = row->width_px * row->width_px;
      // Derivative of the weighted distance; along the normal the weight falls with it.
      const double slope =
          row->weight * (1.0 - row->distance * row->distance / variance) / variance;
      h.noalias() += slope * row->by * row->by.transpose();
      Sums& part = parts[edge.part];
      part.off += row->weight / variance * row->distance * row->by;
      part.shared += row->weight / variance * row->by;
    }
    Matrix7d scatter = prior_.asDiagonal();
    const auto n = static_cast<double>(parts.size());
    for (const auto& [key, sums] : parts) {
      scatter.noalias() += n / std::max(1.0, n - kUnknowns) * sums.off * sums.off.transpose();
      scatter.noalias() += kImageEdge_px * kImageEdge_px * sums.shared * sums.shared.transpose();
    }
    h.diagonal() += prior_;
    const Matrix7d inverse = h.ldlt().solve(Matrix7d::Identity());
    estimate_.covariance = inverse * scatter * inverse.transpose();
    estimate_.parts = parts.size();
    return estimate_;
  }

 private:
  void move(const Vector7d& step) {
    estimate_.pose = se3_exp(Vector6d(step.head<6>())) * estimate_.pose;
    estimate_.unknowns.head<6>() = se3_log(estimate_.pose * start_.inverse());
    estimate_.unknowns(6) += step(6);
  }

  const std::vector<EdgeView>& views_;
  const Camera& camera_;
  Rigid3 start_;
  Vector7d prior_;
  Estimate estimate_;
};

// What an offset, or its covariance, does in the picture: root mean square over the edges.
std::pair<double, double> in_picture(const std::vector<Placed>& placed, const Vector6d& offset,
                                     const Matrix6d& covariance) {
  double square = 0.0, variance = 0.0;
  for (const Placed& edge : placed) {
    square += (edge.by_pose * offset).squaredNorm();
    variance += (edge.by_pose * covariance * edge.by_pose.transpose()).trace();
  }
  const auto n = static_cast<double>(std::max<std::size_t>(1, placed.size()));
  return {std::sqrt(square / n), std::sqrt(variance / n)};
}

EdgeVerdict judge(const EdgeCheck& check, double tolerance_px) {
  if (check.given.edges < kLeastEdges || check.parts < kLeastEdgeParts)
    return EdgeVerdict::kFewEdges;
  if (check.best.score < kMeets * check.best.sigma) return EdgeVerdict::kNoMeeting;
  if (check.gain > kSignificant * check.gain_sigma && check.gain > check.gain_that_matters &&
      check.offset_px > kOff * check.offset_sigma_px)
    return EdgeVerdict::kContradicts;
  return check.offset_sigma_px > 3.0 * tolerance_px ? EdgeVerdict::kUncertain
                                                    : EdgeVerdict::kAgrees;
}

}  // namespace

Result<EdgeView> edge_view(std::string name, const GrayImage& image, const Cloud& cloud,
                           const Camera& camera, const Rigid3& rough_camera_from_lidar) {
  if (image.width_px != camera.width_px || image.height_px != camera.height_px) {
    return Error::input(Message("its image has %1 × %2 px, the camera's have %3 × %4",
                                image.width_px, image.height_px, camera.width_px, camera.height_px),
                        name, Message("take an image of this camera, not cropped or scaled"));
  }
  EdgeView view;
  view.name = std::move(name);
  view.lidar_edges =
      lidar_edges(cloud, rough_camera_from_lidar.rotation.conjugate() * Eigen::Vector3d::UnitZ());
  view.image_edges = std::make_shared<const ImageEdges>(image);
  if (view.lidar_edges.empty())
    return Error::input(Message("the cloud shows no edge"), view.name,
                        Message("take a place with things before others"));
  if (view.image_edges->edges().empty())
    return Error::input(Message("the image shows no edge"), view.name,
                        Message("see whether it is black or blurred"));
  return view;
}

EdgeScore edge_score(const std::vector<EdgeView>& views, const Camera& camera,
                     const Rigid3& camera_from_lidar) {
  return score_of(place(views, camera, camera_from_lidar));
}

std::vector<ProjectedEdge> projected_edges(const EdgeView& view, const Camera& camera,
                                           const Rigid3& camera_from_lidar) {
  std::vector<ProjectedEdge> out;
  for (const Placed& edge : place({view}, camera, camera_from_lidar))
    out.push_back({edge.pixel, count_of(edge, Eigen::Vector2d::Zero())});
  return out;
}

Result<EdgeCheck> check_edges(const std::vector<EdgeView>& views, const Camera& camera,
                              const Rigid3& camera_from_lidar, const EdgeCheckOptions& options,
                              const RunContext& context) {
  if (views.empty()) return Error::usage(Message("there is no image with a cloud to check"));
  EdgeCheck check;
  const auto placed = place(views, camera, camera_from_lidar);
  check.given = score_of(placed);
  check.best = check.given;
  check.best_pose = camera_from_lidar;
  // Once from where the pose is given, and from widths of what it may be off by, each halved until
  // it is that of the edges. A pose further away must agree better beyond chance.
  Estimate estimate;
  std::vector<Placed> reached;
  constexpr int kStarts = 3;
  for (int start = 0; start < kStarts; ++start) {
    context.report("check", static_cast<double>(start) / kStarts, Message("comparing edges"));
    Fit fit(views, camera, camera_from_lidar, options);
    double width = start == 0 ? 1.0 : options.reach_rad * camera.fx / (start == 1 ? 4.0 : 1.0);
    for (; width > 0.5; width *= 0.5) fit.draw(width, context);
    if (context.stopped()) return Error::cancelled();
    const Estimate& found = fit.finish();
    auto there = place(views, camera, found.pose);
    if (start > 0) {
      const Gain gain = gain_of(reached, there);
      if (gain.value < kBetter * gain.sigma) continue;
    }
    estimate = found;
    reached = std::move(there);
  }
  check.offset = estimate.unknowns.head<6>();
  check.covariance = estimate.covariance.topLeftCorner<6, 6>();
  check.best_pose = estimate.pose;
  check.best = score_of(reached);
  const Gain gain = gain_of(placed, reached);
  check.gain = gain.value;
  check.gain_sigma = gain.sigma;
  check.gain_that_matters = loss_of(reached, options.tolerance_px);
  check.widening_mrad = 1e3 * estimate.unknowns(6);
  Matrix6d both = check.covariance;
  if (options.covariance) both += *options.covariance;
  std::tie(check.offset_px, check.offset_sigma_px) = in_picture(placed, check.offset, both);
  // Beyond the gate by 1.28 σ: nine cases of ten, for a turn about one axis with the others free.
  for (int k = 0; k < 3; ++k) {
    check.noticed_turn_rad(k) = (kSignificant + 1.28) * std::sqrt(both(3 + k, 3 + k));
  }
  check.parts = estimate.parts;
  check.verdict = judge(check, options.tolerance_px);
  return check;
}

std::string name_of(EdgeVerdict verdict) {
  switch (verdict) {
    case EdgeVerdict::kAgrees:
      return "agrees";
    case EdgeVerdict::kContradicts:
      return "contradicts";
    default:
      return "cannot tell";
  }
}

Message reason_of(const EdgeCheck& check) {
  switch (check.verdict) {
    case EdgeVerdict::kAgrees:
      return Message("edges agree to %1 ± %2 px", formatted("%.1f", check.offset_px),
                     formatted("%.1f", check.offset_sigma_px));
    case EdgeVerdict::kContradicts:
      return Message(
          "edges agree better after a turn by %1 mrad and a shift by %2 mm: they are %3 px off",
          formatted("%.2g", 1e3 * check.offset.tail<3>().norm()),
          formatted("%.2g", 1e3 * check.offset.head<3>().norm()),
          formatted("%.2g", check.offset_px));
    case EdgeVerdict::kNoMeeting:
      return Message(
          "the edges of LiDAR and image meet no better than by chance, here and nearby: the pose "
          "is wrong by more than what is searched, or the two do not show the same");
    case EdgeVerdict::kUncertain:
      return Message(
          "where the edges agree is known to %1 px only: take a place with more edges, near and "
          "far and all over the picture",
          formatted("%.2g", check.offset_sigma_px));
    default:
      return Message(
          "too few edges of the LiDAR are in the picture: %1 in %2 parts of it, where %3 in %4 are "
          "needed",
          check.given.edges, check.parts, kLeastEdges, kLeastEdgeParts);
  }
}

}  // namespace lvcalib
