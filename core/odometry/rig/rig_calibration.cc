// SPDX-License-Identifier: MIT
#include "core/odometry/rig/rig_calibration.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/odometry/health/support.h"
#include "core/odometry/window/step_size.h"

namespace trajlo {
namespace {

/// How well a rig is known before it is seen.
constexpr double kPriorSigma_m = 0.03;
constexpr double kPriorSigma_rad = 0.02;
constexpr double kPriorSigma_s = 0.01;
constexpr double kMemory_s = 10.0;
/// Planes are seen from another place when the body has moved this far, or has turned so far that a
/// point at the end of this lever has.
constexpr double kPlace_m = 0.25;
constexpr double kLeverArm_m = 5.0;
/// A LiDAR is known when it has seen the map from this many places: after 2.5 m, or half a radian.
constexpr double kEnoughPlaces = 10.0;
/// Of the points of a LiDAR, this share must have planes to say anything; ...
constexpr double kSayingSo = 0.02;
/// ... and of these, this share of the reference's must lie on them. In a simulated
/// hall, LiDARs at the right place, or found from up to 20 degrees off, have 0.97; those that are
/// not found have at most 0.65.
constexpr double kAsReference = 0.8;
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

/// Of each LiDAR: [rho; theta] of its place, left of the correction, and its clock.
constexpr int kUnknowns = 7;

Eigen::Index Row(std::size_t lidar) { return static_cast<Eigen::Index>(kUnknowns * lidar); }

/// The motion of the body over the oldest segment, [rho; theta] per second, body frame: by v c a
/// point has moved c seconds later. Zero where points have no time of their own.
Vector6d TwistOf(const Window& window) {
  return window.segments.front().cloud.is_instant ? Vector6d(Vector6d::Zero()) : window.Velocity(0);
}

double PlacesPassed(const SE3& T_begin, const SE3& T_end) {
  const StepSize step = MeasureStep(T_begin, T_end);
  return std::min(1.0, (step.translation_m + kLeverArm_m * step.rotation_rad) / kPlace_m);
}

/// What the points of each LiDAR but the reference say of the pose of the oldest segment.
std::vector<RigidEquations> EquationsByLidar(const Window& window, std::size_t reference) {
  const Segment& segment = window.segments.front();
  std::vector<std::vector<RegistrationPoint>> by_lidar(segment.cloud.corrections.size());
  for (const RegistrationPoint& point : segment.points) {
    if (point.lidar != reference) by_lidar[point.lidar].push_back(point);
  }
  const RegistrationNoise noise = window.NoiseOf(segment);
  std::vector<RigidEquations> equations(by_lidar.size());
  for (std::size_t l = 0; l < by_lidar.size(); ++l) {
    if (by_lidar[l].empty()) continue;
    equations[l] = RigidEquations(
        LinearizeSegment(by_lidar[l], window.T_world_begin, segment.T_world_end, noise));
  }
  return equations;
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

RigEvidence RigCalibration::EvidenceFor(std::size_t lidar) const {
  if (!is_learning_ || lidar == reference_) return RigEvidence::kConfirmed;
  return lidar < lidars_.size() ? lidars_[lidar].evidence : RigEvidence::kNotYet;
}

void RigCalibration::Apply(SegmentCloud* cloud) const {
  if (!is_learning_ || !reference_ || cloud->corrections.size() < 2) return;
  for (std::size_t l = 0; l < cloud->corrections.size(); ++l) {
    SE3& C = cloud->corrections[l].T_body;
    C = Correction(l).T_body;
    cloud->lidar_origins_body_m[l] = C * cloud->lidar_origins_body_m[l];
  }
  for (std::vector<SegmentPoint>* points : {&cloud->map_points, &cloud->registration_points}) {
    for (SegmentPoint& point : *points) {
      if (point.lidar == reference_) continue;
      const SE3& C = cloud->corrections[point.lidar].T_body;
      point.p_body_m = (C * point.p_body_m.cast<double>()).cast<float>();
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
  const std::size_t lidars = segment.cloud.corrections.size();
  if (!is_learning_ || !reference_ || lidars < 2 || !window.is_believed) return;
  Add(lidars);
  NotePlaces(window);
  NoteAgreement(window);

  const std::vector<RigidEquations> of = EquationsByLidar(window, *reference_);
  const RigidEquations all(segment.registration);
  const Eigen::LDLT<Matrix6d> pose(all.A + kPoseInformation * Matrix6d::Identity());
  // [I v]: from a change of a LiDAR's place and clock to one of the body's pose.
  Eigen::Matrix<double, 6, kUnknowns> B;
  B << Matrix6d::Identity(), TwistOf(window);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(H_.rows(), H_.cols());
  Eigen::VectorXd s = Eigen::VectorXd::Zero(g_.size());
  for (std::size_t l = 0; l < lidars; ++l) {
    s.segment<kUnknowns>(Row(l)) = B.transpose() * (of[l].g - of[l].A * pose.solve(all.g));
    for (std::size_t m = 0; m < lidars; ++m) {
      Matrix6d block = -of[l].A * pose.solve(of[m].A);
      if (l == m) block += of[l].A;
      S.block<kUnknowns, kUnknowns>(Row(l), Row(m)) = B.transpose() * block * B;
    }
  }
  const double kept = std::exp(-segment.Duration_s() / kMemory_s);
  H_ = kept * H_ + S;
  g_ = kept * g_ + s + S * LearntSince(segment.cloud);
  Update();
}

/// From what the points of a segment were corrected by to what is known now.
Eigen::VectorXd RigCalibration::LearntSince(const SegmentCloud& cloud) const {
  Eigen::VectorXd since = Eigen::VectorXd::Zero(g_.size());
  for (std::size_t l = 0; l < cloud.corrections.size(); ++l) {
    const LidarCorrection& now = lidars_[l].correction;
    const LidarCorrection& then = cloud.corrections[l];
    since.segment<kUnknowns>(Row(l)) << se3::Log(now.T_body * then.T_body.Inverse()),
        now.clock_s - then.clock_s;
  }
  return since;
}

/// The LiDARs that the oldest segment has points of have seen one place more, or a part of it.
void RigCalibration::NotePlaces(const Window& window) {
  const Segment& segment = window.segments.front();
  std::vector<bool> is_seen(lidars_.size());
  for (const SegmentPoint& point : segment.cloud.registration_points) is_seen[point.lidar] = true;
  for (std::size_t l = 0; l < lidars_.size(); ++l) {
    if (is_seen[l]) lidars_[l].places += PlacesPassed(window.T_world_begin, segment.T_world_end);
  }
}

/// How the points of the oldest segment lie on the map, until it has points of their LiDARs.
void RigCalibration::NoteAgreement(const Window& window) {
  const Segment& segment = window.segments.front();
  const double kept = std::exp(-segment.Duration_s() / kMemory_s);
  for (Lidar& lidar : lidars_) {
    for (double* count : {&lidar.points, &lidar.with_plane, &lidar.on_plane}) *count *= kept;
  }
  for (const SegmentPoint& point : segment.cloud.registration_points) ++lidars_[point.lidar].points;
  ForEachPoint(window, segment, 1, [&](const RegistrationPoint& point, bool is_on_plane) {
    ++lidars_[point.lidar].with_plane;
    if (is_on_plane) ++lidars_[point.lidar].on_plane;
  });
  for (Lidar& lidar : lidars_) {
    if (lidar.evidence < RigEvidence::kNone) lidar.evidence = Judge(lidar);
  }
}

RigEvidence RigCalibration::Judge(const Lidar& lidar) const {
  if (lidar.places < kEnoughPlaces) return RigEvidence::kNotYet;
  if (lidar.with_plane <= kSayingSo * lidar.points) return RigEvidence::kNone;
  const Lidar& reference = lidars_[*reference_];
  const bool agrees =
      lidar.on_plane * reference.with_plane >= kAsReference * reference.on_plane * lidar.with_plane;
  return agrees ? RigEvidence::kConfirmed : RigEvidence::kContradicted;
}

/// A Gauss-Newton step of all corrections.
void RigCalibration::Update() {
  Eigen::Matrix<double, kUnknowns, 1> prior;
  prior << Eigen::Vector3d::Constant(1.0 / (kPriorSigma_m * kPriorSigma_m)),
      Eigen::Vector3d::Constant(1.0 / (kPriorSigma_rad * kPriorSigma_rad)),
      1.0 / (kPriorSigma_s * kPriorSigma_s);
  Eigen::MatrixXd H = H_;
  Eigen::VectorXd g = g_;
  for (std::size_t l = 0; l < lidars_.size(); ++l) {
    const LidarCorrection& present = lidars_[l].correction;
    Eigen::Matrix<double, kUnknowns, 1> from_given;
    from_given << se3::Log(present.T_body), present.clock_s;
    H.diagonal().segment<kUnknowns>(Row(l)) += prior;
    g.segment<kUnknowns>(Row(l)) += prior.cwiseProduct(from_given);
  }
  const Eigen::VectorXd step = -H.ldlt().solve(g);
  g_ += H_ * step;
  for (std::size_t l = 0; l < lidars_.size(); ++l) {
    if (l == *reference_) continue;
    LidarCorrection& correction = lidars_[l].correction;
    correction.T_body = se3::Exp(step.segment<6>(Row(l))) * correction.T_body;
    correction.clock_s += step[Row(l) + 6];
  }
}

std::vector<double> RigCalibration::Clocks_s() const {
  std::vector<double> clocks_s;
  for (const Lidar& lidar : lidars_) clocks_s.push_back(lidar.correction.clock_s);
  return clocks_s;
}

}  // namespace trajlo
