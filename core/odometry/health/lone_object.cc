// SPDX-License-Identifier: MIT
#include "core/odometry/health/lone_object.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/odometry/health/support.h"
#include "core/odometry/segments/choose_evenly.h"
#include "core/odometry/window/cube.h"
#include "core/odometry/window/facing.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// No object holds a direction alone that normals face with more than this share of what faces the
/// one that most of them face: it is below 0.06 behind trucks, and mostly above 0.15 in streets,
/// halls and offices.
constexpr double kWeak = 0.1;
/// About so many points of a segment are asked which way their planes face.
constexpr std::size_t kAsked = 128;
/// The radius of an object: the back of a truck fits in.
constexpr double kObject_m = 3.0;
/// A point this near to its plane agrees with it.
constexpr double kAgrees_m = 0.05;
/// Evidence is lost with this time constant.
constexpr double kMemory_s = 2.0;
/// An object is alone if it has this share of the information.
constexpr double kAlone = 0.8;
/// Fewer other points contradict nothing.
constexpr double kFewest = 30.0;
/// The share of the other points that lie on their planes, over that of the object's points. Behind
/// trucks it is 0.1 to 0.35, with the truth 0.5 to 1.
constexpr double kContradicting = 0.4;

/// The direction that the fewest normals face, if they are few.
std::optional<Eigen::Vector3d> WeaklyFaced(const Window& window) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Segment& segment : window.segments) {
    const std::size_t stride = StrideForAbout(kAsked, segment.points.size());
    for (std::size_t i = 0; i < segment.points.size(); i += stride) {
      const RegistrationPoint& point = segment.points[i];
      sum += static_cast<double>(stride) * point.weight * point.normal_world *
             point.normal_world.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sum);
  if (eigen.eigenvalues()[0] > kWeak * eigen.eigenvalues()[2]) return std::nullopt;
  return eigen.eigenvectors().col(0);
}

/// A point whose plane faces the direction.
struct FacingPoint {
  Eigen::Vector3d p_world;
  double distance_m;   ///< From its plane.
  double information;  ///< About the direction; 0 if it is far from its plane.
};

std::vector<FacingPoint> FacingPoints(const Window& window, int k, const Eigen::Vector3d& u) {
  const SegmentMotion motion = window.Motion(k);
  std::vector<FacingPoint> facing;
  for (const RegistrationPoint& point : window.At(k).points) {
    if (!IsFacing(point, u)) continue;
    const Eigen::Vector3d p_world = motion.ToWorld(point.alpha, point.p_body_m);
    const double distance_m = std::abs(point.DistanceToPlane(p_world));
    const double cosine = point.normal_world.dot(u);
    facing.push_back(
        {p_world, distance_m, distance_m < kOnPlane_m ? point.weight * cosine * cosine : 0.0});
  }
  return facing;
}

/// Where most of the information is: the mean place of the cube that has most.
Eigen::Vector3d Centre(const std::vector<FacingPoint>& points) {
  struct Content {
    double information = 0.0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  };
  std::map<Cube, Content> cubes;
  const Content* most = nullptr;
  for (const FacingPoint& point : points) {
    Content& cube = cubes[CubeAt(point.p_world, kObject_m)];
    cube.information += point.information;
    cube.moment += point.information * point.p_world;
    if (most == nullptr || cube.information > most->information) most = &cube;
  }
  return most->moment / std::max(most->information, 1e-9);
}

}  // namespace

void LoneObjectWatch::Evidence::Fade(double kept) {
  points *= kept;
  on_plane *= kept;
  information *= kept;
}

double LoneObjectWatch::Evidence::ShareOnPlane() const { return on_plane / std::max(points, 1.0); }

bool LoneObjectWatch::IsContradicted(const Window& window) {
  const std::int64_t end_ns = window.EndNs();
  const double kept = std::exp(-Seconds(end_ns - end_ns_.value_or(end_ns)) / kMemory_s);
  end_ns_ = end_ns;
  object_.Fade(kept);
  others_.Fade(kept);

  const std::optional<Eigen::Vector3d> u = WeaklyFaced(window);
  if (!u) return false;
  std::vector<FacingPoint> all, newest;
  for (int k = 0; k < window.size(); ++k) {
    newest = FacingPoints(window, k, *u);
    all.insert(all.end(), newest.begin(), newest.end());
  }
  if (all.empty()) return false;
  const Eigen::Vector3d centre = Centre(all);
  for (const FacingPoint& point : newest) {
    Evidence& evidence = (point.p_world - centre).norm() < kObject_m ? object_ : others_;
    evidence.points += 1.0;
    evidence.on_plane += point.distance_m < kAgrees_m ? 1.0 : 0.0;
    evidence.information += point.information;
  }
  const double alone = object_.information / (object_.information + others_.information);
  return alone > kAlone && others_.points > kFewest &&
         others_.ShareOnPlane() < kContradicting * object_.ShareOnPlane();
}

}  // namespace trajlo
