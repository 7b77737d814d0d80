// SPDX-License-Identifier: MIT
#include "core/graph/window_graph.h"

#include <cmath>

#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

/// What RegistrationNoise says of one point.
PointFactor Evaluate(const RegistrationPoint& point, const SegmentMotion& motion,
                     const RegistrationNoise& noise) {
  PointFactor factor;
  factor.point = point;
  factor.x_world = motion.ToWorld(point.alpha, point.p_body_m);
  factor.distance_m = point.DistanceToPlane(factor.x_world);
  const double information = point.weight / (noise.sigma_m * noise.sigma_m);
  const double s = information * factor.distance_m * factor.distance_m;
  factor.kernel_weight = noise.KernelOf(point.axis).Weight(s);
  factor.information = information * factor.kernel_weight;
  return factor;
}

std::int64_t TimeOf(const RegistrationPoint& point, const SegmentCloud& cloud) {
  const auto duration_ns = static_cast<double>(cloud.end_ns - cloud.begin_ns);
  return cloud.begin_ns + std::llround(point.alpha * duration_ns);
}

SegmentFactors DescribeSegment(const Window& window, int k) {
  const Segment& segment = window.At(k);
  const RegistrationNoise noise = window.NoiseOf(segment);
  SegmentFactors factors;
  factors.points = static_cast<int>(segment.points.size());
  factors.sigma_m = noise.sigma_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    factors.kernel_m[axis] = noise.KernelOf(axis).width * noise.sigma_m;
  }
  factors.registration =
      LinearizeSegment(segment.points, window.Pose(k), window.Pose(k + 1), noise);
  return factors;
}

}  // namespace

WindowGraph MakeWindowGraph(const Window& window) {
  const std::vector<SE3> poses = window.Poses();
  WindowGraph graph;
  std::vector<RegistrationNormalEquations> registration;
  for (int k = 0; k < window.size(); ++k) {
    const Segment& segment = window.At(k);
    const SegmentMotion motion(window.Pose(k), window.Pose(k + 1));
    const RegistrationNoise noise = window.NoiseOf(segment);
    for (const RegistrationPoint& point : segment.points) {
      graph.points.push_back(Evaluate(point, motion, noise));
      graph.points.back().segment = k;
      graph.points.back().t_ns = TimeOf(point, segment.cloud);
    }
    graph.segments.push_back(DescribeSegment(window, k));
    registration.push_back(graph.segments.back().registration);
    graph.motion.push_back(LinearizeMotion(window, poses, k));
  }
  graph.prior = {window.prior.Residual(poses), window.prior.Jacobian(poses)};
  AssembleWindow(window, poses, registration, &graph.equations);
  return graph;
}

}  // namespace trajlo
