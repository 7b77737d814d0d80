// SPDX-License-Identifier: MIT
#include "core/odometry/weights/motion_prior.h"

#include <algorithm>
#include <cmath>

namespace trajlo {
namespace {

/// T_s: over which innovations are summed up.
constexpr double kSumMemory_s = 0.1;
/// T_l: in which the densities follow.
constexpr double kLearning_s = 0.3;
/// The largest step up, in units of what a rest makes a step down.
constexpr double kLargestScore = 8.0;
/// A density above this ties nothing any more.
constexpr double kLargestDensity = 1e4;
/// A component of which the points tell less than this share is left out.
constexpr double kSmallestGain = 1e-3;

/// The paper's term: the velocity of the segment before, as estimated, is taken for known.
SmoothnessTerm PseudoVelocity(const Window& window, int k, const Vector6d& density) {
  const double duration_s = window.segments[static_cast<std::size_t>(k)].Duration_s();
  const double before_s = window.segments[static_cast<std::size_t>(k - 1)].Duration_s();
  const WhiteNoiseAccelerationTerm velocity(density, before_s, duration_s);
  return {window.Velocity(k - 1) * duration_s, velocity.sqrt_information / duration_s};
}

}  // namespace

MotionPrior::MotionPrior(const MotionPriorOptions& options) : options_(options) {
  density_.head<3>().setConstant(options.translation_m2_s3);
  density_.tail<3>().setConstant(options.rotation_rad2_s3);
}

void MotionPrior::Apply(Window* window) const {
  for (int k = 1; k < window->size(); ++k) {
    Segment& segment = window->segments[static_cast<std::size_t>(k)];
    if (options_.kind == MotionPriorKind::kPseudoVelocity) {
      segment.motion = PseudoVelocity(*window, k, density_);
    } else {
      segment.motion = WhiteNoiseAccelerationTerm(
          density_, window->segments[static_cast<std::size_t>(k - 1)].Duration_s(),
          segment.Duration_s());
    }
  }
}

void MotionPrior::Learn(const Innovation& innovation, double duration_s) {
  const double decay = std::exp(-duration_s / kSumMemory_s);
  for (int i = 0; i < 6; ++i) {
    sum_[i] *= decay;
    if (!(innovation.gain[i] > kSmallestGain)) continue;
    sum_[i] += innovation.correction[i] / std::sqrt(innovation.expected_variance[i]);
  }
  const double floor[2] = {options_.min_translation_m2_s3, options_.min_rotation_rad2_s3};
  const double share = 1.0 - std::exp(-duration_s / kLearning_s);
  for (int part = 0; part < 2; ++part) {
    const double surprise = Surprise(innovation, 3 * part, decay);
    surprise_[part] += share * (surprise - surprise_[part]);
    if (!options_.self_tuning) continue;
    const double score = std::min(surprise - 1.0, kLargestScore);
    const double density = density_[3 * part] * std::exp(score * duration_s / kLearning_s);
    density_.segment<3>(3 * part).setConstant(std::clamp(density, floor[part], kLargestDensity));
  }
}

/// u; 1, which changes nothing, where the points tell nothing.
double MotionPrior::Surprise(const Innovation& innovation, int first_component,
                             double decay) const {
  const Eigen::Vector3d s = sum_.segment<3>(first_component);
  Eigen::Vector3d w = innovation.gain.segment<3>(first_component);
  w = w.unaryExpr([](double gain) { return gain > kSmallestGain ? gain : 0.0; });
  if (!(w.sum() > 0.0)) return 1.0;
  return (1.0 - decay * decay) * w.dot(s.cwiseAbs2()) / w.sum();
}

}  // namespace trajlo
