// SPDX-License-Identifier: MIT
#include "core/simulation/motions/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/simulation/motions/smooth.h"

namespace trajlo::simulation {

using Eigen::Vector3d;

namespace {

constexpr double kSpacing = 0.1;

std::vector<Vector3d> Resample(const std::vector<Vector3d>& corners) {
  std::vector<Vector3d> samples;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double length = (corners[i + 1] - corners[i]).norm();
    const int steps = std::max(1, static_cast<int>(std::lround(length / kSpacing)));
    for (int k = 0; k < steps; ++k) {
      samples.emplace_back(corners[i] + (corners[i + 1] - corners[i]) * k / steps);
    }
  }
  samples.push_back(corners.back());
  return samples;
}

/// The mean over 2 * radius + 1 neighbours, around the loop or held at the ends.
std::vector<Vector3d> BoxFilter(const std::vector<Vector3d>& in, int radius, bool closed) {
  const int n = static_cast<int>(in.size());
  std::vector<Vector3d> out(in.size());
  for (int i = 0; i < n; ++i) {
    // The window shrinks towards the ends of an open route, which keeps the ends in place.
    const int reach = closed ? radius : std::min({radius, i, n - 1 - i});
    Vector3d sum = Vector3d::Zero();
    for (int k = i - reach; k <= i + reach; ++k) {
      sum += in[static_cast<std::size_t>(((k % n) + n) % n)];
    }
    out[static_cast<std::size_t>(i)] = sum / (2 * reach + 1);
  }
  return out;
}

double Unwrapped(double angle, double reference) {
  return angle - 2.0 * M_PI * std::round((angle - reference) / (2.0 * M_PI));
}

}  // namespace

RoutePath::RoutePath(const Route& route, double rounding_m) : closed_(route.closed) {
  if (route.points.size() < 2) throw std::invalid_argument("a route needs two points");
  std::vector<Vector3d> corners = route.points;
  if (closed_) corners.push_back(corners.front());
  samples_ = Resample(corners);
  if (closed_) samples_.pop_back();
  const int radius = std::max(1, static_cast<int>(std::lround(0.5 * rounding_m / kSpacing)));
  for (int pass = 0; pass < 2; ++pass) samples_ = BoxFilter(samples_, radius, closed_);
  if (closed_) samples_.push_back(samples_.front());

  // Rounding shortens the way a little; spacing it out again keeps speeds true.
  samples_ = Resample(samples_);
  length_m_ = kSpacing * static_cast<double>(samples_.size() - 1);
  const std::size_t n = samples_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d& next = i + 1 < n ? samples_[i + 1] : (closed_ ? samples_[1] : samples_[i]);
    const Vector3d& previous = i > 0 ? samples_[i - 1] : (closed_ ? samples_[n - 2] : samples_[0]);
    const Vector3d ahead = next - previous;
    const double heading = std::atan2(ahead.y(), ahead.x());
    headings_.push_back(headings_.empty() ? heading : Unwrapped(heading, headings_.back()));
  }
  winding_rad_ = closed_ ? headings_.back() - headings_.front() : 0.0;
}

RoutePath::Place RoutePath::Locate(double arc_length_m) const {
  const double lap = std::floor(arc_length_m / length_m_);
  double along = arc_length_m - lap * length_m_;
  const bool backwards = !closed_ && std::fmod(std::abs(lap), 2.0) == 1.0;
  if (backwards) along = length_m_ - along;
  const double x = std::clamp(along / kSpacing, 0.0, static_cast<double>(samples_.size() - 1));
  const auto sample = std::min(static_cast<std::size_t>(x), samples_.size() - 2);
  return {sample, x - static_cast<double>(sample), static_cast<int>(lap), backwards};
}

Vector3d RoutePath::PositionAt(double arc_length_m) const {
  const Place p = Locate(arc_length_m);
  return (1.0 - p.fraction) * samples_[p.sample] + p.fraction * samples_[p.sample + 1];
}

double RoutePath::HeadingAt(double arc_length_m) const {
  const Place p = Locate(arc_length_m);
  const double heading =
      (1.0 - p.fraction) * headings_[p.sample] + p.fraction * headings_[p.sample + 1];
  if (closed_) return heading + p.lap * winding_rad_;
  // Half a turn at the end of every lap. Before the first lap there is none to come back from.
  const double reach = std::min(2.0, 0.25 * length_m_);
  const double next_turn = (arc_length_m - (p.lap + 1) * length_m_) / reach;
  const double last_turn = (arc_length_m - p.lap * length_m_) / reach;
  const double turns = p.lap + SmoothStep(0.5 * (next_turn + 1.0)) -
                       (p.lap > 0 ? 1.0 - SmoothStep(0.5 * (last_turn + 1.0)) : 0.0);
  return heading + M_PI * turns;
}

double RoutePath::DistanceToTurn(double arc_length_m) const {
  if (closed_) return std::numeric_limits<double>::infinity();
  const double nearest = std::max(1.0, std::round(arc_length_m / length_m_)) * length_m_;
  return std::abs(arc_length_m - nearest);
}

}  // namespace trajlo::simulation
