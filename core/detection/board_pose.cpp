// SPDX-License-Identifier: BSD-3-Clause
#include "detection/board_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <opencv2/calib3d.hpp>

#include "base/statistics.h"
#include "base/symmetric.h"

namespace lvcalib {
namespace {

constexpr int kPoseUnknowns = 6;
// Distances beyond this many standard deviations are outliers: 2 in 100,000 Gaussian ones are.
constexpr double kGate = 4.685;

Eigen::Vector3d on_board(const CornerObservation& corner) {
  return {corner.board_m.x(), corner.board_m.y(), 0.0};
}

// Standard deviations relative to the typical corner's, with a floor: what is called noise-free
// still has errors of the model of a few hundredths of a pixel.
std::vector<double> relative_sigmas(const std::vector<CornerObservation>& corners,
                                    double& typical) {
  constexpr double kModelError_px = 0.02;
  std::vector<double> sigmas;
  for (const CornerObservation& corner : corners) {
    sigmas.push_back(std::hypot(corner.sigma_px, kModelError_px));
  }
  typical = median(sigmas);
  for (double& sigma : sigmas) sigma /= typical;
  return sigmas;
}

// Least squares of one pose; the corners and their weights are fixed.
class PoseFit {
 public:
  PoseFit(const std::vector<CornerObservation>& corners, const Camera& camera)
      : corners_(corners), camera_(camera), sigmas_(relative_sigmas(corners, typical_)) {}

  /// Distances from the reprojections in units of the relative sigmas; infinite where the camera
  /// does not image the point.
  [[nodiscard]] std::vector<double> distances(const Rigid3& pose) const;
  [[nodiscard]] double relative_sigma(std::size_t i) const { return sigmas_[i]; }
  /// What the corners state, with the model's own error.
  [[nodiscard]] double typical_sigma_px() const { return typical_; }
  /// Robust minimum near a start. False if it fails.
  bool refine(Rigid3& pose) const;
  [[nodiscard]] Matrix6d information(const Rigid3& pose, const std::vector<double>& weights,
                                     Vector6d* gradient) const;

 private:
  enum class Loss { kHuber, kTukey, kGate };
  /// Levenberg–Marquardt with re-weighting.
  bool minimise(Rigid3& pose, Loss loss, int iterations) const;
  [[nodiscard]] std::vector<double> weights(const Rigid3& pose, Loss loss) const;
  [[nodiscard]] double cost(const Rigid3& pose, const std::vector<double>& weights) const;

  const std::vector<CornerObservation>& corners_;
  const Camera& camera_;
  double typical_ = 0.0;  // Set with sigmas_, so before them.
  std::vector<double> sigmas_;
};

std::vector<double> PoseFit::distances(const Rigid3& pose) const {
  std::vector<double> out;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto pixel = camera_.project(pose * on_board(corners_[i]));
    out.push_back(pixel ? (*pixel - corners_[i].pixel).norm() / sigmas_[i]
                        : std::numeric_limits<double>::infinity());
  }
  return out;
}

// The median distance of a two-dimensional Gaussian is √(2 ln 2) = 1.1774 σ; at least a few
// thousandths of a pixel, so that exact data do not divide by zero. Of the four corners of a lone
// tag none can be told to be an outlier: the largest distance is then the scale.
double distance_sigma(const std::vector<double>& distances) {
  constexpr std::size_t kFewestToReject = 6;
  if (distances.size() < kFewestToReject)
    return std::max(*std::max_element(distances.begin(), distances.end()), 0.003);
  return std::max(median(distances) / 1.1774, 0.003);
}

std::vector<double> PoseFit::weights(const Rigid3& pose, Loss loss) const {
  std::vector<double> out = distances(pose);
  const double sigma = distance_sigma(out);
  for (double& value : out) {
    const double ratio = value / sigma;
    if (loss == Loss::kHuber) value = std::isfinite(ratio) ? huber_weight(ratio) : 0.0;
    if (loss == Loss::kTukey) value = tukey_weight(ratio, kGate);
    if (loss == Loss::kGate) value = ratio <= kGate ? 1.0 : 0.0;
  }
  return out;
}

double PoseFit::cost(const Rigid3& pose, const std::vector<double>& weights) const {
  const std::vector<double> all = distances(pose);
  double sum = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (weights[i] > 0.0) sum += weights[i] * all[i] * all[i];
  }
  return sum;
}

Matrix6d PoseFit::information(const Rigid3& pose, const std::vector<double>& weights,
                              Vector6d* gradient) const {
  Matrix6d out = Matrix6d::Zero();
  if (gradient != nullptr) gradient->setZero();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector3d point = pose * on_board(corners_[i]);
    Eigen::Matrix<double, 2, 3> by_point;
    const auto pixel = weights[i] > 0.0 ? camera_.project(point, &by_point) : std::nullopt;
    if (!pixel) continue;
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian << by_point, -by_point * skew(point);
    jacobian /= sigmas_[i];
    out += weights[i] * jacobian.transpose() * jacobian;
    if (gradient == nullptr) continue;
    *gradient += weights[i] * jacobian.transpose() * (corners_[i].pixel - *pixel) / sigmas_[i];
  }
  return out;
}

// Huber's loss first, which has a single minimum; from there Tukey's finds the outliers; plain
// least squares over the rest loses nothing to the weights.
bool PoseFit::refine(Rigid3& pose) const {
  return minimise(pose, Loss::kHuber, 6) && minimise(pose, Loss::kTukey, 20) &&
         minimise(pose, Loss::kGate, 20);
}

bool PoseFit::minimise(Rigid3& pose, Loss loss, int iterations) const {
  double damping = 1e-4;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<double> w = weights(pose, loss);
    Vector6d gradient;
    const Matrix6d normal = information(pose, w, &gradient);
    const double before = cost(pose, w);
    double step_norm = 0.0;
    bool better = false;
    for (int attempt = 0; attempt < 10 && !better; ++attempt) {
      Matrix6d damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Vector6d step = damped.ldlt().solve(gradient);
      if (!step.allFinite()) return false;
      const Rigid3 next = se3_exp(step) * pose;
      better = cost(next, w) <= before;
      damping = better ? std::max(0.1 * damping, 1e-12) : 10.0 * damping;
      if (!better) continue;
      pose = next;
      step_norm = step.norm();
    }
    if (!better || step_norm < 1e-10) break;
  }
  return pose.translation.allFinite() && pose.rotation.coeffs().allFinite();
}

// Starts: the two poses of the homography of the corners that agree on one.
std::vector<Rigid3> planar_poses(const std::vector<CornerObservation>& corners,
                                 const Camera& camera, double tolerance_px, int samples) {
  std::vector<cv::Point2d> board, image;
  for (const CornerObservation& corner : corners) {
    const auto ray = camera.unproject(corner.pixel);
    if (!ray || !(ray->z() > 0.05)) continue;
    board.emplace_back(corner.board_m.x(), corner.board_m.y());
    image.emplace_back(ray->x() / ray->z(), ray->y() / ray->z());
  }
  if (board.size() < 4) return {};
  std::vector<Rigid3> out;
  try {
    cv::Mat mask;
    const double tolerance = tolerance_px / (0.5 * (camera.fx + camera.fy));
    cv::findHomography(board, image, cv::RANSAC, tolerance, mask, samples, 0.9999);
    std::vector<cv::Point3d> agreeing_board;
    std::vector<cv::Point2d> agreeing_image;
    for (std::size_t i = 0; i < board.size(); ++i) {
      if (mask.empty() || mask.at<unsigned char>(static_cast<int>(i)) == 0) continue;
      agreeing_board.emplace_back(board[i].x, board[i].y, 0.0);
      agreeing_image.push_back(image[i]);
    }
    if (agreeing_board.size() < 4) return {};
    std::vector<cv::Mat> rotations, translations;
    cv::solvePnPGeneric(agreeing_board, agreeing_image, cv::Mat::eye(3, 3, CV_64F), cv::Mat(),
                        rotations, translations, false, cv::SOLVEPNP_IPPE);
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      const cv::Mat& r = rotations[i];
      const cv::Mat& t = translations[i];
      const Eigen::Vector3d rotation(r.at<double>(0), r.at<double>(1), r.at<double>(2));
      out.push_back({so3_exp(rotation), {t.at<double>(0), t.at<double>(1), t.at<double>(2)}});
    }
  } catch (const cv::Exception&) {
    return {};  // degenerate corners, for example all on one line
  }
  return out;
}

struct Candidate {
  Rigid3 pose;
  double cost = 0.0;
};

// Sum of squares with every corner limited, so that both poses are judged on all corners.
double limited_cost(const std::vector<double>& distances, double limit) {
  double sum = 0.0;
  for (const double distance : distances) sum += std::pow(std::min(distance, limit), 2);
  return sum;
}

std::vector<Candidate> refined_candidates(const PoseFit& fit, const std::vector<Rigid3>& starts) {
  std::vector<Candidate> out;
  double sigma = std::numeric_limits<double>::infinity();
  for (const Rigid3& start : starts) {
    Rigid3 pose = start;
    if (!fit.refine(pose)) continue;
    sigma = std::min(sigma, distance_sigma(fit.distances(pose)));
    out.push_back({pose, 0.0});
  }
  for (Candidate& candidate : out) {
    candidate.cost = limited_cost(fit.distances(candidate.pose), kGate * sigma);
  }
  std::sort(out.begin(), out.end(),
            [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  return out;
}

// Two poses are the same when the motion between them is far below their uncertainty.
bool same_pose(const Rigid3& a, const Rigid3& b, const Matrix6d& covariance) {
  const Vector6d motion = se3_log(a * b.inverse());
  return squared_mahalanobis(motion, covariance) < 1.0;
}

}  // namespace

Result<BoardPose> estimate_board_pose(const std::vector<CornerObservation>& corners,
                                      const Camera& camera, const DetectionOptions& options,
                                      int samples) {
  if (corners.size() < 4) {
    return Error::input(Message("a board's pose needs four corners, found %1", corners.size()));
  }
  const PoseFit fit(corners, camera);
  const auto candidates =
      refined_candidates(fit, planar_poses(corners, camera, options.max_reprojection_px, samples));
  if (candidates.empty()) {
    return Error::input(Message("the corners fit no pose of a flat board"), {},
                        Message("check the intrinsics and the target's description"));
  }
  BoardPose out;
  const Rigid3 pose = candidates.front().pose;
  const std::vector<double> distances = fit.distances(pose);
  const double gate = kGate * distance_sigma(distances);
  std::vector<double> weights;
  double squares = 0.0, pixel_squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool agrees = distances[i] <= gate;
    out.agrees.push_back(agrees);
    weights.push_back(agrees ? 1.0 : 0.0);
    out.residual_px.push_back(distances[i] * fit.relative_sigma(i));
    if (!agrees) continue;
    ++count;
    squares += distances[i] * distances[i];
    pixel_squares += out.residual_px[i] * out.residual_px[i];
  }
  if (2 * count <= kPoseUnknowns)
    return Error::input(Message("the corners fit no pose of a flat board"));
  // With two or four degrees of freedom left the residuals alone may say next to nothing: the
  // corners' stated σ then counts as much as six more.
  constexpr double kFewDegrees = 12.0;
  constexpr double kPriorDegrees = 6.0;
  const double degrees = 2.0 * count - kPoseUnknowns;
  const double prior = degrees < kFewDegrees ? kPriorDegrees : 0.0;
  const double stated = fit.typical_sigma_px();
  out.sigma_px = std::sqrt((squares + prior * stated * stated) / (degrees + prior));
  out.rms_px = std::sqrt(pixel_squares / (2 * count));
  const Matrix6d normal = fit.information(pose, weights, nullptr);
  out.camera_from_board = {pose, out.sigma_px * out.sigma_px * symmetric_inverse(normal)};
  if (!out.camera_from_board.covariance.allFinite()) {
    return Error::input(Message("the corners do not determine the board's pose"));
  }
  if (candidates.size() < 2) return out;
  const Candidate& other = candidates[1];
  // Gaussian likelihood with its σ estimated: −2 ln Λ = N ln(cost ratio) for N coordinates.
  const double n = 2.0 * static_cast<double>(corners.size());
  const double ratio = n * std::log(other.cost / std::max(candidates[0].cost, 1e-12));
  if (ratio < chi_square_gate(1, options.ambiguity_tail) &&
      !same_pose(other.pose, pose, out.camera_from_board.covariance)) {
    out.alternative_pose = other.pose;
  }
  return out;
}

}  // namespace lvcalib
