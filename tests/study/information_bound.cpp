// SPDX-License-Identifier: GPL-3.0-or-later
#include "information_bound.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace lvcalib::study {
namespace {

// Reflectivities of the simulator's print.
constexpr double kWhite = 0.85;
constexpr double kBlack = 0.07;

using Row6 = Eigen::Matrix<double, 1, 6>;
using Block36 = Eigen::Matrix<double, 3, 6>;

Block36 point_by_pose(const Eigen::Vector3d& p) {
  Block36 j;
  j.leftCols<3>().setIdentity();
  j.rightCols<3>() = -skew(p);
  return j;
}

// Information per pixel of edge about its displacement across: ∫ (C φ(x))²/σ²(x) dx, the noise that
// of the level at x.
double edge_density(const simulation::ImageOptions& image) {
  const double white = image.white_level;
  const double black = white * kBlack / kWhite;
  // The pixel's own width blurs as well.
  const double blur = std::sqrt(image.blur_px * image.blur_px + 1.0 / 12.0);
  double sum = 0.0;
  constexpr double kStep = 0.02;
  for (double x = -5.0 * blur; x <= 5.0 * blur; x += kStep) {
    const double level =
        black + (white - black) * 0.5 * (1.0 + std::erf(x / blur / std::numbers::sqrt2));
    const double slope = (white - black) * std::exp(-0.5 * x * x / (blur * blur)) /
                         (blur * std::sqrt(2.0 * std::numbers::pi));
    const double variance =
        level * 255.0 / image.full_well_e + image.read_noise * image.read_noise + 1.0 / 12.0;
    sum += kStep * slope * slope / variance;
  }
  return sum;
}

Matrix6d camera_information(const simulation::SimulatedRig& rig, const Rigid3& camera_from_board) {
  const Target& target = rig.target;
  const double bit = target.tag_bit_m();
  const double density = edge_density(rig.options.image);
  Matrix6d information = Matrix6d::Zero();
  const auto is_white = [&](const Eigen::Vector2d& p) {
    return target.albedo(p).value_or(1.0) > 0.5;
  };
  // One side of a bit, from a to b in board coordinates.
  const auto add_edge = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const auto image = [&](const Eigen::Vector2d& p) {
      return rig.camera.project(camera_from_board * Eigen::Vector3d(p.x(), p.y(), 0.0));
    };
    const auto pa = image(a);
    const auto pb = image(b);
    const Eigen::Vector2d m = 0.5 * (a + b);
    const Eigen::Vector3d p = camera_from_board * Eigen::Vector3d(m.x(), m.y(), 0.0);
    Eigen::Matrix<double, 2, 3> by_point;
    const auto pixel = rig.camera.project(p, &by_point);
    if (!pa || !pb || !pixel || !rig.camera.in_image(*pixel)) return;
    const Eigen::Vector2d along = *pb - *pa;
    const double length = along.norm();
    const Eigen::RowVector2d normal(-along.y() / length, along.x() / length);
    const Row6 j = normal * by_point * point_by_pose(p);
    information += density * length * j.transpose() * j;
  };
  for (const TargetTag& tag : target.tags()) {
    const int side = static_cast<int>(std::lround(target.tag_size_m / bit));
    const Eigen::Vector2d origin = tag.center_m - 0.5 * target.tag_size_m * Eigen::Vector2d(1, 1);
    for (int i = 0; i <= side; ++i) {
      for (int k = 0; k < side; ++k) {
        const auto at = [&](double x, double y) {
          return Eigen::Vector2d(origin + bit * Eigen::Vector2d(x, y));
        };
        if (is_white(at(i - 0.5, k + 0.5)) != is_white(at(i + 0.5, k + 0.5)))
          add_edge(at(i, k), at(i, k + 1));
        if (is_white(at(k + 0.5, i - 0.5)) != is_white(at(k + 0.5, i + 0.5)))
          add_edge(at(k, i), at(k + 1, i));
      }
    }
  }
  return information;
}

// The print blurred by a Gaussian along the board's axes, on a raster of a millimetre.
class BlurredRaster {
 public:
  BlurredRaster(const Target& target, double sigma_x, double sigma_y) {
    const BoardOutline o = target.outline();
    low_ = o.lower_left_m;
    columns_ = static_cast<int>(o.size_m().x() / kStep) + 1;
    rows_ = static_cast<int>(o.size_m().y() / kStep) + 1;
    std::vector<double> sharp(static_cast<std::size_t>(columns_ * rows_));
    constexpr int kSub = 4;
    for (int r = 0; r < rows_; ++r) {
      for (int c = 0; c < columns_; ++c) {
        double sum = 0.0;
        for (int s = 0; s < kSub * kSub; ++s) {
          const Eigen::Vector2d p =
              low_ + kStep * Eigen::Vector2d(c + (s % kSub + 0.5) / kSub - 0.5,
                                             r + (s / kSub + 0.5) / kSub - 0.5);
          sum += target.albedo(p).value_or(1.0);
        }
        sharp[place(c, r)] = sum / (kSub * kSub);
      }
    }
    value_.resize(sharp.size());
    std::vector<double> half(sharp.size());
    const auto kernel = [](double sigma) {
      std::vector<double> k;
      const int n = static_cast<int>(std::ceil(4.0 * sigma / kStep));
      double sum = 0.0;
      for (int i = -n; i <= n; ++i)
        k.push_back(std::exp(-0.5 * std::pow(i * kStep / sigma, 2))), sum += k.back();
      for (double& v : k) v /= sum;
      return k;
    };
    const auto kx = kernel(sigma_x);
    const auto ky = kernel(sigma_y);
    const int nx = static_cast<int>(kx.size()) / 2;
    const int ny = static_cast<int>(ky.size()) / 2;
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        double sum = 0.0;
        for (int i = -nx; i <= nx; ++i)
          sum += kx[static_cast<std::size_t>(i + nx)] *
                 sharp[place(std::clamp(c + i, 0, columns_ - 1), r)];
        half[place(c, r)] = sum;
      }
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < columns_; ++c) {
        double sum = 0.0;
        for (int i = -ny; i <= ny; ++i)
          sum += ky[static_cast<std::size_t>(i + ny)] *
                 half[place(c, std::clamp(r + i, 0, rows_ - 1))];
        value_[place(c, r)] = sum;
      }
  }

  [[nodiscard]] double at(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d t = (p - low_) / kStep;
    const int c = std::clamp(static_cast<int>(t.x()), 0, columns_ - 2);
    const int r = std::clamp(static_cast<int>(t.y()), 0, rows_ - 2);
    const double x = t.x() - c;
    const double y = t.y() - r;
    return (1 - y) * ((1 - x) * value_[place(c, r)] + x * value_[place(c + 1, r)]) +
           y * ((1 - x) * value_[place(c, r + 1)] + x * value_[place(c + 1, r + 1)]);
  }
  [[nodiscard]] Eigen::RowVector2d gradient(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d x(0.5 * kStep, 0.0);
    const Eigen::Vector2d y(0.0, 0.5 * kStep);
    return {(at(p + x) - at(p - x)) / kStep, (at(p + y) - at(p - y)) / kStep};
  }

 private:
  static constexpr double kStep = 0.001;
  [[nodiscard]] std::size_t place(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c);
  }
  Eigen::Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<double> value_;
};

// Information of all returns about the board's pose in the LiDAR frame.
Matrix6d lidar_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene) {
  const simulation::LidarOptions& lidar = rig.options.lidar;
  const Rigid3& pose = scene.lidar_from_board;
  const Rigid3 board_from_lidar = pose.inverse();
  const Eigen::Matrix<double, 2, 3> to_board =
      board_from_lidar.rotation.toRotationMatrix().topRows<2>();
  const Eigen::Vector3d normal = pose.rotation * Eigen::Vector3d::UnitZ();
  const double jitter = lidar.angle_sigma_deg * std::numbers::pi / 180.0;
  const double wide = std::hypot(1e-3 * lidar.beam_horizontal_mrad, jitter);
  const double high = std::hypot(1e-3 * lidar.beam_vertical_mrad, jitter);
  struct Axes {
    Eigen::Vector2d h, v;
  };
  // How a beam's angles move its hit on the board.
  const auto axes = [&](const Eigen::Vector3d& ray, double range) {
    const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(ray).normalized();
    const Eigen::Vector3d up = ray.cross(across);
    const auto moved = [&](const Eigen::Vector3d& d) {
      return Eigen::Vector2d(to_board * (range * (d - ray * normal.dot(d) / normal.dot(ray))));
    };
    return Axes{moved(across), moved(up)};
  };
  const Eigen::Vector2d c = rig.target.outline().center_m();
  const Eigen::Vector3d middle = pose * Eigen::Vector3d(c.x(), c.y(), 0.0);
  const Axes at_middle = axes(middle.normalized(), middle.norm());
  const double sigma_x = std::hypot(wide * at_middle.h.x(), high * at_middle.v.x());
  const double sigma_y = std::hypot(wide * at_middle.h.y(), high * at_middle.v.y());
  const BlurredRaster print(rig.target, sigma_x, sigma_y);
  const BlurredRaster wider(rig.target, 1.05 * sigma_x, sigma_y);
  const BlurredRaster higher(rig.target, sigma_x, 1.05 * sigma_y);
  const double contrast = (kWhite - kBlack) * lidar.intensity_scale;
  const double half = 0.5 * rig.target.outline().size_m().maxCoeff();

  constexpr int kUnknowns = 12;  // Pose, two levels, two slopes, two blurs.
  Eigen::Matrix<double, kUnknowns, kUnknowns> information =
      Eigen::Matrix<double, kUnknowns, kUnknowns>::Zero();
  for (const Eigen::Vector3f& point : scene.cloud.points_m) {
    const Eigen::Vector3d measured = point.cast<double>();
    const Eigen::Vector3d ray = measured.normalized();
    const double along = normal.dot(ray);
    if (along > -0.05) continue;
    const double range = normal.dot(pose.translation) / along;
    if (std::abs(range - measured.norm()) > 0.1) continue;
    const Eigen::Vector3d hit = range * ray;
    const Eigen::Vector2d on_board = (board_from_lidar * hit).head<2>();
    if (!rig.target.albedo(on_board)) continue;
    const double white = print.at(on_board);
    const double reflectivity = kBlack + (kWhite - kBlack) * white;
    const double range_sigma =
        lidar.range_sigma_m * std::pow(kWhite / reflectivity, lidar.range_dark_exponent);
    const Row6 range_row = normal.transpose() * point_by_pose(hit) / along;
    information.topLeftCorner<6, 6>() +=
        range_row.transpose() * range_row / (range_sigma * range_sigma);

    const Eigen::RowVector2d gradient = print.gradient(on_board);
    const Axes beam = axes(ray, range);
    const double variance = lidar.intensity_sigma * lidar.intensity_sigma + 1.0 / 12.0 +
                            std::pow(contrast * jitter, 2) * (std::pow(gradient.dot(beam.h), 2) +
                                                              std::pow(gradient.dot(beam.v), 2));
    const Eigen::Matrix3d relative = ray * normal.transpose() / along - Eigen::Matrix3d::Identity();
    const Eigen::Vector2d place = (on_board - c) / half;
    const double level = contrast * white + kBlack * lidar.intensity_scale;
    Eigen::Matrix<double, 1, kUnknowns> row;
    row << contrast * gradient * to_board * relative * point_by_pose(hit), white, 1.0 - white,
        level * place.x(), level * place.y(), contrast * (wider.at(on_board) - white) / 0.05,
        contrast * (higher.at(on_board) - white) / 0.05;
    information += row.transpose() * row / variance;
  }
  // Light over the board differs by some per cent.
  information(8, 8) += 100.0;
  information(9, 9) += 100.0;
  const Eigen::Matrix<double, 6, 6> own = information.bottomRightCorner<6, 6>();
  const Eigen::Matrix<double, 6, 6> cross = information.bottomLeftCorner<6, 6>();
  return information.topLeftCorner<6, 6>() - cross.transpose() * own.ldlt().solve(cross);
}

}  // namespace

Matrix6d scene_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene) {
  const Matrix6d board_in_lidar = lidar_information(rig, scene).ldlt().solve(Matrix6d::Identity());
  const Matrix6d ad = rig.camera_from_lidar.adjoint();
  const Matrix6d board_in_camera =
      camera_information(rig, scene.camera_from_board).ldlt().solve(Matrix6d::Identity());
  const Matrix6d covariance = board_in_camera + ad * board_in_lidar * ad.transpose();
  return covariance.ldlt().solve(Matrix6d::Identity());
}

Matrix6d board_information(const simulation::SimulatedRig& rig,
                           const simulation::SimulatedScene& scene) {
  return lidar_information(rig, scene);
}

}  // namespace lvcalib::study
