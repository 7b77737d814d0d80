// SPDX-License-Identifier: MIT
#include "core/odometry/weights/fit_kernel.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/odometry/segments/choose_evenly.h"
#include "core/odometry/window/kernel_axes.h"
#include "core/scans/median.h"

namespace trajlo {
namespace {

/// A smaller change is not worth a new linearisation of all segments.
constexpr double kSmallChange = 0.1;
/// The axes stay while one of them has no more information than this multiple of the least.
constexpr double kNearlyLeast = 1.25;
/// About this many points are asked: of a segment, for the axes; of an axis, for its width.
constexpr std::size_t kAskedOfSegment = 128;
constexpr std::size_t kAskedOfAxis = 128;
/// Fewer points have no scatter.
constexpr std::size_t kFewest = 5;

/// sum w n nᵀ, over some of the points.
Eigen::Matrix3d InformationOfNormals(const Window& window) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Segment& segment : window.segments) {
    const std::size_t stride = StrideForAbout(kAskedOfSegment, segment.points.size());
    for (std::size_t i = 0; i < segment.points.size(); i += stride) {
      const RegistrationPoint& point = segment.points[i];
      sum += point.weight * point.normal_world * point.normal_world.transpose();
    }
  }
  return sum;
}

void ForgetLinearizations(Window* window) {
  for (Segment& segment : window->segments) segment.linearization.reset();
}

/// Turns the axes to the principal ones, if the direction with the least information is no longer
/// among them.
void UpdateAxes(Window* window) {
  const Eigen::Matrix3d information = InformationOfNormals(*window);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
  const Eigen::Matrix3d& axes = window->kernel_axes;
  const double least = (axes.transpose() * information * axes).diagonal().minCoeff();
  if (!(least > kNearlyLeast * eigen.eigenvalues()[0])) return;
  window->kernel_axes = eigen.eigenvectors();
  window->noise.widening.fill(1.0);
  for (Segment& segment : window->segments) AssignAxes(window->kernel_axes, &segment.points);
  ForgetLinearizations(window);
}

/// A distance in the units of the kernel, and the weight with which it counts.
using WeighedDistance = std::pair<double, double>;

/// Those of some points of each axis.
std::array<std::vector<WeighedDistance>, 3> DistancesByAxis(const Window& window) {
  std::array<std::size_t, 3> stride = {};
  for (const Segment& segment : window.segments) {
    for (const RegistrationPoint& point : segment.points) ++stride[point.axis];
  }
  for (std::size_t& count : stride) count = StrideForAbout(kAskedOfAxis, count);
  std::array<std::size_t, 3> to_pass = {};
  std::array<std::vector<WeighedDistance>, 3> distances;
  for (int k = 0; k < window.size(); ++k) {
    const Segment& segment = window.At(k);
    const SegmentMotion motion = window.Motion(k);
    for (const RegistrationPoint& point : segment.points) {
      std::size_t& passes = to_pass[point.axis];
      if (point.weight == 0.0 || passes-- > 0) continue;
      passes = stride[point.axis] - 1;
      const double distance_m = point.DistanceToPlane(motion.ToWorld(point.alpha, point.p_body_m));
      distances[point.axis].emplace_back(std::sqrt(point.weight) * std::abs(distance_m),
                                         point.weight);
    }
  }
  return distances;
}

/// Half of the weight has no larger distance.
double WeightedMedian(std::vector<WeighedDistance>* distances) {
  std::sort(distances->begin(), distances->end());
  double left = 0.0;
  for (const WeighedDistance& distance : *distances) left += 0.5 * distance.second;
  for (const WeighedDistance& distance : *distances) {
    left -= distance.second;
    if (left <= 0.0) return distance.first;
  }
  return distances->back().first;
}

}  // namespace

void FitKernel(const RegistrationOptions& options, Window* window) {
  const bool has_kernel = window->noise.kernel.kind != KernelKind::kNone;
  if (!has_kernel || options.kernel_in_spreads == 0.0) return;
  UpdateAxes(window);
  auto distances = DistancesByAxis(*window);
  for (std::size_t axis = 0; axis < distances.size(); ++axis) {
    if (distances[axis].size() < kFewest) continue;
    const double spread_m = kSigmaOfMedian * WeightedMedian(&distances[axis]);
    const double widest_m = kWidestKernel * options.kernel_m;
    const double width_m =
        std::max(options.sigma_m, std::min(options.kernel_in_spreads * spread_m, widest_m));
    double& widening = window->noise.widening[axis];
    const double change = width_m / options.kernel_m - widening;
    if (std::abs(change) <= kSmallChange * widening) continue;
    widening += change;
    ForgetLinearizations(window);
  }
}

}  // namespace trajlo
