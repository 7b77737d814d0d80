// SPDX-License-Identifier: MIT
#include "core/odometry/weights/motion_prior.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace trajlo {
namespace {

/// T_s: over which innovations are summed up.
constexpr double kSumMemory_s = 0.1;
/// T_l: in which the densities follow.
constexpr double kLearning_s = 0.3;
/// The largest step up, as a multiple of a step down at rest.
constexpr double kLargestScore = 8.0;
/// The noise of the points is taken to be as small as this share of what is assumed, in squares.
constexpr double kLeastScatter = 0.2;
/// Noise lasts longer than a jerk: the time over which the lasting scatter is averaged.
constexpr double kLasting_s = 2.0;
/// T_k.
constexpr double kNoiseLearning_s = 1.0;
/// A larger z² counts as this one.
constexpr double kLargestScatter = 4.0;
constexpr double kLargestNoiseFactor = 50.0;
/// A density above this no longer ties anything; the largest that may be set.
constexpr double kLargestDensity = 1e4;
/// A component with less than this gain is left out.
constexpr double kSmallestGain = 1e-3;

/// The paper's term: the estimated velocity of the segment before is taken as known.
SmoothnessTerm PseudoVelocity(const Window& window, int k, const Vector6d& density) {
  const double duration_s = window.At(k).Duration_s();
  const double before_s = window.At(k - 1).Duration_s();
  const WhiteNoiseAccelerationTerm velocity(density, before_s, duration_s);
  return {window.Velocity(k - 1) * duration_s, velocity.sqrt_information / duration_s};
}

/// z: each component in standard deviations; 0 where the points tell nothing.
Vector6d Normalized(const Innovation& innovation) {
  Vector6d z = Vector6d::Zero();
  for (int i = 0; i < 6; ++i) {
    if (!(innovation.gain[i] > kSmallestGain)) continue;
    z[i] = innovation.correction[i] / std::sqrt(innovation.expected_variance[i]);
  }
  return z;
}

/// The mean square of three components, weighted by what the points tell; nothing where they tell
/// nothing.
std::optional<double> MeanSquare(const Vector6d& values, const Innovation& innovation,
                                 int first_component) {
  Eigen::Vector3d w = innovation.gain.segment<3>(first_component);
  w = w.unaryExpr([](double gain) { return gain > kSmallestGain ? gain : 0.0; });
  if (!(w.sum() > 0.0)) return std::nullopt;
  return w.dot(values.segment<3>(first_component).cwiseAbs2()) / w.sum();
}

}  // namespace

MotionPrior::MotionPrior(const MotionPriorOptions& options) : options_(options) {
  density_.head<3>().setConstant(options.translation_m2_s3);
  density_.tail<3>().setConstant(options.rotation_rad2_s3);
}

void MotionPrior::UntieRotation(Window* window) const {
  Vector6d density = density_;
  density.tail<3>().setConstant(kLargestDensity);
  Apply(density, window);
}

void MotionPrior::Apply(const Vector6d& density, Window* window) const {
  for (int k = 1; k < window->size(); ++k) {
    Segment& segment = window->At(k);
    if (options_.kind == MotionPriorKind::kNone) {
      segment.motion = std::monostate();
    } else if (options_.kind == MotionPriorKind::kPseudoVelocity) {
      segment.motion = PseudoVelocity(*window, k, density);
    } else {
      const double before_s = window->At(k - 1).Duration_s(), duration_s = segment.Duration_s();
      WhiteNoiseAccelerationTerm term(density, before_s, duration_s);
      term.persistence = persistence_.Over(0.5 * (before_s + duration_s));
      term.mean_velocity = persistence_.mean_velocity();
      segment.motion = term;
    }
  }
}

Vector6d MotionPrior::Predict(const Window& window, double duration_s) const {
  const Vector6d velocity = window.EndVelocity();
  if (window.size() == 0 || options_.kind == MotionPriorKind::kPseudoVelocity) return velocity;
  const Vector6d& mean = persistence_.mean_velocity();
  const double apart_s = 0.5 * (window.segments.back().Duration_s() + duration_s);
  return mean + persistence_.Over(apart_s).cwiseProduct(velocity - mean);
}

double MotionPrior::Bend_m2(const SegmentCloud& cloud) const {
  if (options_.kind == MotionPriorKind::kPseudoVelocity || cloud.is_instant) return 0.0;
  const double duration_s = cloud.Duration_s();
  return density_[0] * duration_s * duration_s * duration_s / 90.0;
}

void MotionPrior::Follow(const Innovation& innovation) {
  if (!options_.self_tuning) return;
  const Vector6d z = Normalized(innovation);
  for (int part = 0; part < 2; ++part) {
    const double surprise = std::max(1.0, MeanSquare(z, innovation, 3 * part).value_or(1.0));
    const double density = density_[3 * part] * surprise;
    density_.segment<3>(3 * part).setConstant(std::min(density, kLargestDensity));
  }
}

void MotionPrior::NoteGap() {
  sum_.setZero();
  persistence_.NoteGap();
}

void MotionPrior::LearnPersistence(const Innovation& innovation, const Vector6d& velocity,
                                   double duration_s) {
  if (options_.self_tuning) persistence_.Learn(velocity, innovation.gain, duration_s);
}

void MotionPrior::LearnNoise(double scatter, double surprise, double duration_s) {
  const double z2 = std::min(scatter, kLargestScatter);
  lasting_scatter_ += (1.0 - std::exp(-duration_s / kLasting_s)) * (z2 - lasting_scatter_);
  log_noise_factor_ += duration_s / kNoiseLearning_s * (z2 - std::max(1.0, surprise));
  log_noise_factor_ = std::clamp(log_noise_factor_, 0.0, std::log(kLargestNoiseFactor));
}

void MotionPrior::Learn(const Innovation& innovation, double duration_s) {
  const double decay = std::exp(-duration_s / kSumMemory_s);
  const Vector6d z = Normalized(innovation);
  sum_ = decay * sum_ + z;
  const double floor[2] = {options_.translation_m2_s3, options_.rotation_rad2_s3};
  const double share = 1.0 - std::exp(-duration_s / kLearning_s);
  for (int part = 0; part < 2; ++part) {
    const std::optional<double> scatter = MeanSquare(z, innovation, 3 * part);
    if (!scatter) continue;
    const double surprise = (1.0 - decay * decay) * *MeanSquare(sum_, innovation, 3 * part);
    scatter_[part] += share * (*scatter - scatter_[part]);
    if (!options_.self_tuning) continue;
    double noise = 1.0;
    if (part == 0) {
      LearnNoise(*scatter, surprise, duration_s);
      noise = std::clamp(scatter_[part], kLeastScatter, std::max(1.0, lasting_scatter_));
    }
    const double score = std::min(surprise / noise - 1.0, kLargestScore);
    const double density = density_[3 * part] * std::exp(score * duration_s / kLearning_s);
    density_.segment<3>(3 * part).setConstant(
        std::max(floor[part], std::min(density, kLargestDensity)));
  }
}

}  // namespace trajlo
