// SPDX-License-Identifier: MIT
#include "core/odometry/rig/rig_calibration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/odometry/window/step_size.h"

namespace trajlo {
namespace {

/// How well a rig is known before it is seen.
constexpr double kPriorSigma_m = 0.03;
constexpr double kPriorSigma_rad = 0.02;
constexpr double kMemory_s = 10.0;
/// Planes are seen from another place when the body has moved by as much, or has turned such that
/// a point at this distance has.
constexpr double kPlace_m = 0.25;
constexpr double kLeverArm_m = 5.0;
/// A LiDAR is known when it was seen from so many places: 2.5 m, or 0.5 rad.
constexpr double kEnoughPlaces = 10.0;
/// Holds the pose where the points of a segment do not.
constexpr double kPoseInformation = 1.0;

/// The normal equations of points for one perturbation of the body at all times, which moves both
/// ends of the segment alike (exactly: T_begin Exp(xi) .. T_end Exp(xi) interpolates to T Exp(xi)).
struct RigidEquations {
  Matrix6d A = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();

  RigidEquations() = default;
  explicit RigidEquations(const RegistrationNormalEquations& segment) {
    Eigen::Matrix<double, 12, 6> both;
    both << Matrix6d::Identity(), Matrix6d::Identity();
    A = both.transpose() * segment.H * both;
    g = both.transpose() * segment.g;
  }
};

Eigen::Index Row(std::size_t lidar) { return static_cast<Eigen::Index>(6 * lidar); }

double PlacesPassed(const SE3& T_begin, const SE3& T_end) {
  const StepSize step = MeasureStep(T_begin, T_end);
  return std::min(1.0, (step.translation_m + kLeverArm_m * step.rotation_rad) / kPlace_m);
}

/// The points of each LiDAR but the reference.
std::vector<std::vector<RegistrationPoint>> PointsByLidar(
    const std::vector<RegistrationPoint>& points, std::size_t lidars, std::size_t reference) {
  std::vector<std::vector<RegistrationPoint>> by_lidar(lidars);
  for (const RegistrationPoint& point : points) {
    const auto lidar = static_cast<std::size_t>(point.lidar);
    if (lidar != reference) by_lidar[lidar].push_back(point);
  }
  return by_lidar;
}

}  // namespace

void RigCalibration::Begin(std::vector<SegmentCloud>* segments) {
  if (!is_learning_) return;
  if (!reference_) {
    std::vector<std::size_t> points;
    for (const SegmentCloud& cloud : *segments) {
      points.resize(std::max(points.size(), cloud.lidar_origins_body_m.size()));
      for (const SegmentPoint& point : cloud.registration_points) ++points[point.lidar];
    }
    const std::size_t most = points.empty() ? 0 : *std::max_element(points.begin(), points.end());
    if (most == 0) return;
    const auto first = std::find_if(points.begin(), points.end(),
                                    [&](std::size_t count) { return 2 * count >= most; });
    reference_ = static_cast<std::size_t>(first - points.begin());
  }
  for (SegmentCloud& cloud : *segments) DropUnknown(&cloud);
}

bool RigCalibration::IsKnown(std::size_t lidar) const {
  if (!is_learning_ || lidar == reference_) return true;
  return lidar < lidars_.size() && lidars_[lidar].places >= kEnoughPlaces;
}

void RigCalibration::Apply(SegmentCloud* cloud) const {
  cloud->rig_corrections.clear();
  for (std::size_t l = 0; l < cloud->lidar_origins_body_m.size(); ++l) {
    cloud->rig_corrections.push_back(Correction(l));
    cloud->lidar_origins_body_m[l] = Correction(l) * cloud->lidar_origins_body_m[l];
  }
  if (!is_learning_ || !reference_) return;
  for (std::vector<SegmentPoint>* points : {&cloud->map_points, &cloud->registration_points}) {
    for (SegmentPoint& point : *points) {
      if (point.lidar == reference_) continue;
      point.p_body_m =
          (cloud->rig_corrections[point.lidar] * point.p_body_m.cast<double>()).cast<float>();
    }
  }
  DropUnknown(cloud);
}

void RigCalibration::DropUnknown(SegmentCloud* cloud) const {
  std::vector<SegmentPoint>& points = cloud->map_points;
  const auto known = std::stable_partition(points.begin(), points.end(),
                                           [&](const SegmentPoint& p) { return IsKnown(p.lidar); });
  if (known != points.begin()) points.erase(known, points.end());
}

void RigCalibration::Add(std::size_t lidars) {
  if (lidars <= lidars_.size()) return;
  lidars_.resize(lidars);
  H_.conservativeResizeLike(Eigen::MatrixXd::Zero(Row(lidars), Row(lidars)));
  g_.conservativeResizeLike(Eigen::VectorXd::Zero(Row(lidars)));
}

void RigCalibration::Learn(const Window& window) {
  const Segment& segment = window.segments.front();
  const std::size_t lidars = segment.cloud.rig_corrections.size();
  if (!is_learning_ || !reference_ || lidars < 2 || !window.is_believed) return;
  Add(lidars);

  std::vector<bool> is_seen(lidars);
  for (const SegmentPoint& point : segment.cloud.registration_points) is_seen[point.lidar] = true;
  for (std::size_t l = 0; l < lidars; ++l) {
    if (is_seen[l]) lidars_[l].places += PlacesPassed(window.T_world_begin, segment.T_world_end);
  }
  const auto by_lidar = PointsByLidar(segment.points, lidars, *reference_);
  std::vector<RigidEquations> of(lidars);
  /// Of each correction, from the one that the points were moved by to the present one.
  Eigen::VectorXd since = Eigen::VectorXd::Zero(g_.size());
  for (std::size_t l = 0; l < lidars; ++l) {
    if (by_lidar[l].empty()) continue;
    of[l] = RigidEquations(
        LinearizeSegment(by_lidar[l], window.T_world_begin, segment.T_world_end, window.noise));
    since.segment<6>(Row(l)) =
        se3::Log(lidars_[l].correction * segment.cloud.rig_corrections[l].Inverse());
  }
  const RigidEquations all(segment.registration);
  const Eigen::LDLT<Matrix6d> pose(all.A + kPoseInformation * Matrix6d::Identity());
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(H_.rows(), H_.cols());
  Eigen::VectorXd s = Eigen::VectorXd::Zero(g_.size());
  for (std::size_t l = 0; l < lidars; ++l) {
    s.segment<6>(Row(l)) = of[l].g - of[l].A * pose.solve(all.g);
    S.block<6, 6>(Row(l), Row(l)) = of[l].A;
    for (std::size_t m = 0; m < lidars; ++m) {
      S.block<6, 6>(Row(l), Row(m)) -= of[l].A * pose.solve(of[m].A);
    }
  }
  const double kept = std::exp(-segment.Duration_s() / kMemory_s);
  H_ = kept * H_ + S;
  g_ = kept * g_ + s + S * since;
  Update();
}

/// A Gauss-Newton step of all corrections.
void RigCalibration::Update() {
  Vector6d prior;
  prior.head<3>().setConstant(1.0 / (kPriorSigma_m * kPriorSigma_m));
  prior.tail<3>().setConstant(1.0 / (kPriorSigma_rad * kPriorSigma_rad));
  Eigen::MatrixXd H = H_;
  Eigen::VectorXd g = g_;
  for (std::size_t l = 0; l < lidars_.size(); ++l) {
    H.diagonal().segment<6>(Row(l)) += prior;
    g.segment<6>(Row(l)) += prior.cwiseProduct(se3::Log(lidars_[l].correction));
  }
  const Eigen::VectorXd step = -H.ldlt().solve(g);
  g_ += H_ * step;
  for (std::size_t l = 0; l < lidars_.size(); ++l) {
    if (l == *reference_) continue;
    lidars_[l].correction = se3::Exp(step.segment<6>(Row(l))) * lidars_[l].correction;
  }
}

}  // namespace trajlo
