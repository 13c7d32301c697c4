// SPDX-License-Identifier: BSD-3-Clause
#include "solve/intrinsics_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>

#include "base/statistics.h"
#include "base/symmetric.h"
#include "base/text.h"
#include "solve/bundle_adjustment.h"

namespace lvcalib {
namespace {

constexpr std::size_t kFewestReplicates = 10;
// A direction of the intrinsics counts as determined if the data take a tenth of the prior's
// variance off it; those beyond say nothing either way.
constexpr double kDetermined = 0.9;

std::vector<SeenPoints> points_of(const std::vector<CornerView>& views) {
  std::vector<SeenPoints> out;
  for (const CornerView& view : views) add_corners(*view.corners, Rigid3(), out.emplace_back());
  return out;
}

std::vector<Rigid3> poses_of(const std::vector<CornerView>& views) {
  std::vector<Rigid3> out;
  out.reserve(views.size());
  for (const CornerView& view : views) out.push_back(view.camera_from_board);
  return out;
}

std::vector<Eigen::Index> indices_of(IntrinsicsPart part) {
  switch (part) {
    case IntrinsicsPart::kFocalLength:
      return {0, 1};
    case IntrinsicsPart::kPrincipalPoint:
      return {2, 3};
    case IntrinsicsPart::kDistortion:
      break;
  }
  return {4, 5, 6, 7, 8, 9, 10, 11};
}

// Places in sorted distinct values, which differ by more than a micrometre.
std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> out;
  for (const double v : values) {
    if (out.empty() || v - out.back() > 1e-6) out.push_back(v);
  }
  return out;
}

std::size_t place_of(const std::vector<double>& sorted, double value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value - 1e-6) -
                                  sorted.begin());
}

// Mixed second differences of one view's residuals over the smallest rectangles of its grid.
void add_differences(const CornerView& view, const Camera& camera, std::vector<double>& out) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (const CornerObservation& c : *view.corners) {
    xs.push_back(c.board_m.x());
    ys.push_back(c.board_m.y());
  }
  xs = distinct(std::move(xs));
  ys = distinct(std::move(ys));
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Vector2d> residual;
  for (const CornerObservation& c : *view.corners) {
    const auto pixel =
        camera.project(view.camera_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0));
    if (pixel) {
      residual[{place_of(xs, c.board_m.x()), place_of(ys, c.board_m.y())}] = c.pixel - *pixel;
    }
  }
  for (const auto& [at, r00] : residual) {
    const auto r10 = residual.find({at.first + 1, at.second});
    const auto r01 = residual.find({at.first, at.second + 1});
    const auto r11 = residual.find({at.first + 1, at.second + 1});
    if (r10 == residual.end() || r01 == residual.end() || r11 == residual.end()) continue;
    const Eigen::Vector2d z = 0.5 * (r00 - r10->second - r01->second + r11->second);
    out.push_back(z.x());
    out.push_back(z.y());
  }
}

// Of the parts, those whose freeing alone leaves nothing significant: singles first, then pairs.
std::vector<std::vector<IntrinsicsPart>> subsets() {
  using P = IntrinsicsPart;
  return {{P::kFocalLength},
          {P::kPrincipalPoint},
          {P::kDistortion},
          {P::kFocalLength, P::kPrincipalPoint},
          {P::kFocalLength, P::kDistortion},
          {P::kPrincipalPoint, P::kDistortion}};
}

}  // namespace

IntrinsicsVector typical_intrinsics_sigma(const Camera& camera) {
  IntrinsicsVector sigma = IntrinsicsVector::Zero();
  sigma.head<2>().setConstant(1e-3 * camera.fx);
  sigma.segment<2>(2).setConstant(1e-3 * camera.width_px);
  // At the edge of the image, a normalized radius ρ, an error δk moves a point by f·δk·ρ³.
  const double edge = std::max(0.1, 0.5 * camera.width_px / camera.fx);
  const double radial = 0.5 / (camera.fx * edge * edge * edge);
  const double tangential = 0.5 / (camera.fx * edge * edge);
  for (Eigen::Index k = 0; k < camera.distortion_count(); ++k) sigma(4 + k) = radial;
  if (camera.model != DistortionModel::kEquidistant) {
    sigma(6) = sigma(7) = 0.2 * tangential;
    sigma(5) = 2.0 * radial;
    sigma(8) = 2.0 * radial;
  }
  return sigma;
}

IntrinsicsVector wide_intrinsics_sigma(const Camera& camera) {
  IntrinsicsVector sigma = IntrinsicsVector::Zero();
  sigma.head<2>().setConstant(0.3 * camera.fx);
  sigma.segment<2>(2).setConstant(0.1 * camera.width_px);
  const double size = 0.3 * std::max(1.0, camera.distortion.cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < camera.distortion_count(); ++k) sigma(4 + k) = size;
  if (camera.model != DistortionModel::kEquidistant) sigma(6) = sigma(7) = 0.02;
  return sigma;
}

IntrinsicsVector intrinsics_of(const Camera& camera) {
  IntrinsicsVector out;
  out << camera.fx, camera.fy, camera.cx, camera.cy, camera.distortion;
  return out;
}

Camera with_intrinsics(Camera camera, const IntrinsicsVector& values) {
  camera.fx = values(0);
  camera.fy = values(1);
  camera.cx = values(2);
  camera.cy = values(3);
  camera.distortion = values.tail<8>();
  return camera;
}

std::optional<IntrinsicsFit> fit_intrinsics(const std::vector<CornerView>& views,
                                            const Camera& camera, const IntrinsicsVector& prior) {
  const auto fit = fit_bundle(points_of(views), poses_of(views), camera, prior);
  if (!fit) return std::nullopt;
  IntrinsicsFit out;
  out.camera = fit->camera;
  out.camera_from_board = fit->poses;
  out.covariance = fit->covariance;
  out.sigma_px = fit->sigma_px;
  out.freedom = fit->freedom;
  std::vector<CornerView> fitted = views;
  for (std::size_t v = 0; v < views.size(); ++v) fitted[v].camera_from_board = fit->poses[v];
  out.replicate_px = replicate_noise(fitted, fit->camera);
  return out;
}

std::optional<IntrinsicsEvidence> intrinsics_evidence(const std::vector<CornerView>& views,
                                                      const Camera& camera, double sigma_px) {
  if (views.empty() || !(sigma_px > 0.0)) return std::nullopt;
  return bundle_evidence(points_of(views), poses_of(views), camera, sigma_px);
}

double replicate_noise(const std::vector<CornerView>& views, const Camera& camera) {
  std::vector<double> z;
  for (const CornerView& view : views) add_differences(view, camera, z);
  if (z.size() < 2 * kFewestReplicates) return 0.0;
  for (double& value : z) value = std::abs(value);
  // Median of |z| of Gaussian data: 0.6745 σ.
  const double first = median(z) / 0.6745;
  if (!(first > 0.0)) return 0.0;
  double squares = 0.0;
  for (const double value : z) squares += std::pow(std::min(value, 3.0 * first), 2);
  // E[min(z², 9)] = 0.9904.
  return std::sqrt(squares / (0.9904 * static_cast<double>(z.size())));
}

IntrinsicsContrast contrast_intrinsics(const IntrinsicsVector& estimated,
                                       const IntrinsicsVector& given,
                                       const Eigen::MatrixXd& covariance,
                                       const IntrinsicsVector& prior, double noise_freedom,
                                       double false_alarm) {
  IntrinsicsContrast out;
  const bool joint = covariance.rows() >= kGlobals;
  const Eigen::Index first = joint ? kFirstIntrinsic : 0;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < kIntrinsics; ++i) {
    if (prior(i) > 0.0) free.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(free.size());
  if (n == 0) return out;
  const IntrinsicsVector d = estimated - given;
  Eigen::VectorXd scaled(n);
  Eigen::MatrixXd c(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = free[static_cast<std::size_t>(i)];
    scaled(i) = d(a) / prior(a);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index b = free[static_cast<std::size_t>(j)];
      c(i, j) = covariance(first + a, first + b) / (prior(a) * prior(b));
    }
  }
  const auto axes = axes_of(c);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double variance = axes.values(k);
    if (!(variance > 0.0) || variance > kDetermined) continue;
    const double along = axes.vectors.col(k).dot(scaled);
    out.chi_square += along * along / (variance * (1.0 - variance));
    ++out.dof;
  }
  if (out.dof == 0) return out;
  out.gate = f_gate(out.dof, noise_freedom, false_alarm);

  // Frees some parts and holds the rest as given. What that costs (χ², and two for each number that
  // is free, after Akaike), if it is chance.
  const auto hold = [&](const std::vector<IntrinsicsPart>& parts,
                        IntrinsicsContrast& into) -> std::optional<double> {
    std::vector<bool> freed(static_cast<std::size_t>(kIntrinsics), false);
    for (const IntrinsicsPart part : parts) {
      for (const Eigen::Index i : indices_of(part)) freed[static_cast<std::size_t>(i)] = true;
    }
    std::vector<Eigen::Index> held;
    for (const Eigen::Index i : free) {
      if (!freed[static_cast<std::size_t>(i)]) held.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(held.size());
    Eigen::VectorXd off(m);
    Eigen::MatrixXd own(m, m);
    Eigen::MatrixXd to(covariance.rows(), m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index a = held[static_cast<std::size_t>(i)];
      off(i) = d(a) / prior(a);
      to.col(i) = covariance.col(first + a) / prior(a);
      for (Eigen::Index j = 0; j < m; ++j)
        own(i, j) = covariance(first + a, first + held[static_cast<std::size_t>(j)]) /
                    (prior(a) * prior(held[static_cast<std::size_t>(j)]));
    }
    const Eigen::LDLT<Eigen::MatrixXd> factor(own);
    const double chi = m > 0 ? off.dot(factor.solve(off)) : 0.0;
    Eigen::VectorXd correction = Eigen::VectorXd::Zero(covariance.rows());
    Eigen::MatrixXd rest = covariance;
    if (m > 0) {
      correction = -to * factor.solve(off);
      rest -= to * factor.solve(to.transpose());
    }
    into.parts = parts;
    into.difference = IntrinsicsVector::Zero();
    into.sigma = IntrinsicsVector::Zero();
    for (const Eigen::Index i : free) {
      if (!freed[static_cast<std::size_t>(i)]) continue;
      into.difference(i) = d(i) + correction(first + i);
      into.sigma(i) = std::sqrt(std::max(0.0, rest(first + i, first + i)));
    }
    if (joint) {
      into.correction = correction.head<6>();
      into.covariance = rest.topLeftCorner<6, 6>();
    }
    if (chi > f_gate(static_cast<int>(std::max<Eigen::Index>(1, m)), noise_freedom, false_alarm))
      return std::nullopt;
    return chi + 2.0 * static_cast<double>(n - m);
  };
  std::multimap<double, IntrinsicsContrast> mended;
  for (const auto& parts : subsets()) {
    if (!mended.empty() && parts.size() > mended.begin()->second.parts.size()) break;
    IntrinsicsContrast tried = out;
    if (const auto cost = hold(parts, tried)) mended.emplace(*cost, std::move(tried));
  }
  if (!mended.empty()) {
    out = mended.begin()->second;
    for (auto other = std::next(mended.begin()); other != mended.end(); ++other)
      out.alternatives.push_back(other->second);
    return out;
  }
  hold({IntrinsicsPart::kFocalLength, IntrinsicsPart::kPrincipalPoint, IntrinsicsPart::kDistortion},
       out);
  return out;
}

namespace {

// How far apart two cameras put a corner of the boards at most, px.
double farthest_px(const Camera& one, const Camera& other, const std::vector<CornerView>& views) {
  double most = 0.0;
  for (const CornerView& view : views) {
    for (const CornerObservation& c : *view.corners) {
      const Eigen::Vector3d p =
          view.camera_from_board * Eigen::Vector3d(c.board_m.x(), c.board_m.y(), 0.0);
      const auto a = one.project(p);
      const auto b = other.project(p);
      if (a && b) most = std::max(most, (*a - *b).norm());
    }
  }
  return most;
}

// Programs list the coefficients of Brown's model (k1 k2 p1 p2 k3 here) in other orders: the one
// that brings the given camera to a tenth of its distance from the fitted one, if any does.
const char* order_that_fits(const Camera& given, const Camera& fitted, double apart_px,
                            const std::vector<CornerView>& views) {
  if (given.model != DistortionModel::kPlumbBob) return nullptr;
  struct Order {
    const char* name;
    std::array<int, 5> at;  // Where each of k1 k2 p1 p2 k3 stands.
  };
  constexpr std::array<Order, 4> kOrders = {{{"p1 p2 k1 k2 k3", {2, 3, 0, 1, 4}},
                                             {"k2 k1 p1 p2 k3", {1, 0, 2, 3, 4}},
                                             {"k1 k2 k3 p1 p2", {0, 1, 3, 4, 2}},
                                             {"k1 p1 k2 p2 k3", {0, 2, 1, 3, 4}}}};
  for (const Order& order : kOrders) {
    Camera listed = given;
    for (std::size_t k = 0; k < order.at.size(); ++k)
      listed.distortion(static_cast<Eigen::Index>(k)) = given.distortion(order.at[k]);
    if (farthest_px(listed, fitted, views) < 0.1 * apart_px) return order.name;
  }
  return nullptr;
}

// The parts of one alternative.
Message describe_parts(const IntrinsicsContrast& contrast, const Camera& given,
                       const std::vector<CornerView>& views) {
  std::vector<Message> words;
  for (const IntrinsicsPart part : contrast.parts) {
    switch (part) {
      case IntrinsicsPart::kFocalLength: {
        // The given one against what the data say.
        const double truth = given.fx + contrast.difference(0);
        const double off = 50.0 * (-contrast.difference(0) / truth -
                                   contrast.difference(1) / (given.fy + contrast.difference(1)));
        const double sigma_percent = 100.0 * contrast.sigma(0) / given.fx;
        // Freed with what is wrong, it need not be wrong itself.
        if (contrast.parts.size() > 1 && std::abs(off) < 2.0 * sigma_percent) break;
        const char* const digits = sigma_percent < 0.005 ? "%.4f" : "%.2f";
        const std::string size = formatted(digits, std::abs(off));
        const std::string sigma = formatted(digits, sigma_percent);
        words.push_back(off > 0 ? Message("the focal length is %1 ± %2 % too long", size, sigma)
                                : Message("the focal length is %1 ± %2 % too short", size, sigma));
        break;
      }
      case IntrinsicsPart::kPrincipalPoint: {
        const double cx = given.cx + contrast.difference(2);
        const double cy = given.cy + contrast.difference(3);
        const Message off = Message("the principal point is off by %1 px across and %2 px down",
                                    formatted("%.1f", -contrast.difference(2)),
                                    formatted("%.1f", -contrast.difference(3)));
        // Lenses are off the middle by some per cent of the image.
        const double usual_px = 0.02 * given.width_px;
        const bool exchanged = std::abs(cx - given.cy) < usual_px &&
                               std::abs(cy - given.cx) < usual_px &&
                               std::abs(given.cx - given.cy) > 2.0 * usual_px;
        words.push_back(exchanged ? Message("%1, as if cx and cy were exchanged", off) : off);
        break;
      }
      case IntrinsicsPart::kDistortion: {
        Camera other = given;
        other.distortion += contrast.difference.tail<8>();
        const double most = farthest_px(given, other, views);
        const Message off =
            Message("the distortion is off by up to %1 px on the boards", formatted("%.1f", most));
        const char* const order = order_that_fits(given, other, most, views);
        words.push_back(order == nullptr
                            ? off
                            : Message("%1, as if its coefficients were listed as %2", off, order));
        break;
      }
    }
  }
  return all_of(words);
}

}  // namespace

Message describe(const IntrinsicsContrast& contrast, const Camera& given,
                 const std::vector<CornerView>& views) {
  Message out = describe_parts(contrast, given, views);
  for (const IntrinsicsContrast& other : contrast.alternatives)
    out = Message("%1, or %2", out, describe_parts(other, given, views));
  return out;
}

}  // namespace lvcalib
