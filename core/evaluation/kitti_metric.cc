// SPDX-License-Identifier: MIT
#include "core/evaluation/kitti_metric.h"

#include <algorithm>
#include <cmath>

namespace trajlo {
namespace {

constexpr std::size_t kFrameStep = 10;

/// The kit inverts the whole matrix, whether its rotation is orthonormal or not.
Eigen::Affine3d Between(const Eigen::Affine3d& a, const Eigen::Affine3d& b) {
  return a.inverse(Eigen::Affine) * b;
}

KittiSegment Segment(const PosePair& first, const PosePair& last, std::size_t first_frame,
                     double length_m) {
  const Eigen::Affine3d E =
      Between(Between(first.estimate, last.estimate), Between(first.truth, last.truth));
  const double angle = std::acos(std::clamp(0.5 * (E.linear().trace() - 1.0), -1.0, 1.0));
  return {first_frame, length_m, E.translation().norm() / length_m, angle / length_m};
}

}  // namespace

KittiErrors ComputeKittiErrors(const std::vector<PosePair>& pairs) {
  std::vector<double> path(pairs.size(), 0.0);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    path[i] =
        path[i - 1] + (pairs[i].truth.translation() - pairs[i - 1].truth.translation()).norm();
  }
  KittiErrors errors;
  for (std::size_t first = 0; first < pairs.size(); first += kFrameStep) {
    for (const double length_m : kKittiLengths_m) {
      const auto last = std::upper_bound(path.begin(), path.end(), path[first] + length_m);
      if (last == path.end()) continue;
      errors.segments.push_back(Segment(
          pairs[first], pairs[static_cast<std::size_t>(last - path.begin())], first, length_m));
    }
  }
  const auto means = [&](double length_m) {
    KittiLength mean;
    mean.length_m = length_m;
    for (const KittiSegment& segment : errors.segments) {
      if (length_m > 0.0 && segment.length_m != length_m) continue;
      ++mean.segments;
      mean.translation_percent += 100.0 * segment.translation_m_per_m;
      mean.rotation_deg_per_m += segment.rotation_rad_per_m * (180.0 / M_PI);
    }
    const double n = static_cast<double>(std::max<std::size_t>(1, mean.segments));
    mean.translation_percent /= n;
    mean.rotation_deg_per_m /= n;
    return mean;
  };
  for (const double length_m : kKittiLengths_m) errors.per_length.push_back(means(length_m));
  const KittiLength all = means(0.0);
  errors.translation_percent = all.translation_percent;
  errors.rotation_deg_per_m = all.rotation_deg_per_m;
  return errors;
}

}  // namespace trajlo
