// SPDX-License-Identifier: MIT
#include "core/graph/reweigh.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace trajlo {
namespace {

void RequirePositive(const std::optional<double>& value, const char* name) {
  if (value && !(*value > 0.0 && std::isfinite(*value))) {
    throw std::invalid_argument(std::string(name) + ": must be a positive number");
  }
}

void Check(const Window& window, const Reweighing& reweighing) {
  RequirePositive(reweighing.sigma_m, "sigma_m");
  RequirePositive(reweighing.kernel_m, "kernel_m");
  RequirePositive(reweighing.translation_m2_s3, "translation_m2_s3");
  RequirePositive(reweighing.rotation_rad2_s3, "rotation_rad2_s3");
  const double factor = reweighing.prior_factor.value_or(1.0);
  if (!(factor >= 0.0 && std::isfinite(factor))) {
    throw std::invalid_argument("prior_factor: must be zero or a positive number");
  }
  std::size_t points = 0;
  for (const Segment& segment : window.segments) points += segment.points.size();
  const std::vector<double>& weights = reweighing.point_weights;
  if (!weights.empty() && weights.size() != points) {
    throw std::invalid_argument("point_weights: there are " + std::to_string(weights.size()) +
                                " for " + std::to_string(points) + " points");
  }
  for (const double weight : weights) {
    if (!(weight >= 0.0 && std::isfinite(weight))) {
      throw std::invalid_argument("point_weights: must be zero or positive numbers");
    }
  }
}

/// A kernel's width is in units of sigma: in metres it stays, unless another one is asked for.
void ChangeNoise(const Reweighing& reweighing, RegistrationNoise* noise) {
  if (reweighing.kernel) noise->kernel.kind = *reweighing.kernel;
  if (reweighing.sigma_m) {
    noise->kernel.width *= noise->sigma_m / *reweighing.sigma_m;
    noise->sigma_m = *reweighing.sigma_m;
  }
  if (!reweighing.kernel_m) return;
  noise->kernel.width = *reweighing.kernel_m / noise->sigma_m;
  noise->widening = {1.0, 1.0, 1.0};
}

/// 1/sigma of what ties segment k by these densities; a component without one stays.
void ChangeDensity(const Window& window, const Reweighing& reweighing, int k, MotionTerm* motion) {
  if (k == 0) return;  // The prior ties it.
  const double before_s = window.At(k - 1).Duration_s(), duration_s = window.At(k).Duration_s();
  const auto change = [&](double unit_s, Vector6d* sqrt_information) {
    const auto set = [&](const std::optional<double>& density, int first) {
      if (!density) return;
      const WhiteNoiseAccelerationTerm term(Vector6d::Constant(*density), before_s, duration_s);
      sqrt_information->segment<3>(first) = term.sqrt_information.segment<3>(first) / unit_s;
    };
    set(reweighing.translation_m2_s3, 0);
    set(reweighing.rotation_rad2_s3, 3);
  };
  if (auto* free = std::get_if<WhiteNoiseAccelerationTerm>(motion)) {
    change(1.0, &free->sqrt_information);
  } else if (auto* known = std::get_if<SmoothnessTerm>(motion)) {
    change(duration_s, &known->sqrt_information);  // Its residual is a motion, not a velocity.
  }
}

}  // namespace

Window Reweigh(Window window, const Reweighing& reweighing) {
  Check(window, reweighing);
  ChangeNoise(reweighing, &window.noise);
  const double scale = std::sqrt(reweighing.prior_factor.value_or(1.0));
  window.prior.sqrt_information *= scale;
  window.prior.offset *= scale;
  auto weight = reweighing.point_weights.begin();
  for (int k = 0; k < window.size(); ++k) {
    Segment& segment = window.At(k);
    ChangeDensity(window, reweighing, k, &segment.motion);
    segment.linearization.reset();
    if (reweighing.point_weights.empty()) continue;
    for (RegistrationPoint& point : segment.points) point.weight = *weight++;
  }
  return window;
}

SolvedWindow SolveToTheEnd(Window window, const WindowSolverFactory& make_solver,
                           SolverOptions options, int max_iterations) {
  options.iterations_per_round = max_iterations;
  options.step_tolerance = {1e-9, 1e-10};
  ThreadPool threads(1);
  for (Segment& segment : window.segments) segment.linearization.reset();
  SolvedWindow solved{std::move(window), {}};
  solved.summary = make_solver(options, &threads)->Solve(&solved.window);
  return solved;
}

}  // namespace trajlo
