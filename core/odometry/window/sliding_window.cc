// SPDX-License-Identifier: MIT
#include "core/odometry/window/sliding_window.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/stopwatch.h"

namespace trajlo {
SlidingWindow::SlidingWindow(const OdometryOptions& options, const MapPyramid* map,
                             ThreadPool* threads, const WindowSolverFactory& make_solver)
    : options_(options),
      map_(map),
      threads_(threads),
      solver_(make_solver(options.solver, threads)),
      evaluator_(threads),
      threshold_(options.threshold),
      balance_(options.weight_balance) {}

void SlidingWindow::Start(std::int64_t t_ns, const SE3& T_world_body, const Vector6d& velocity) {
  segments_.clear();
  front_ns_ = t_ns;
  front_flags_ = 0;
  velocity_before_ = velocity;
  problem_.poses = {T_world_body};
  problem_.prior = MakeAnchor(T_world_body, options_.marginalization.anchor_sigma_translation_m,
                              options_.marginalization.anchor_sigma_rotation_rad);
  problem_.first_estimate_jacobians = options_.marginalization.first_estimate_jacobians;
}

ControlPose SlidingWindow::front_pose() const {
  return {front_ns_, problem_.poses.front(), front_flags_};
}

std::vector<ControlPose> SlidingWindow::poses() const {
  std::vector<ControlPose> poses = {front_pose()};
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    poses.push_back({segments_[k].cloud.end_ns, problem_.poses[k + 1], segments_[k].flags});
  }
  return poses;
}

WindowStatistics SlidingWindow::AddSegment(SegmentCloud cloud) {
  segments_.emplace_back();
  segments_.back().cloud = std::move(cloud);
  Predict();
  const SE3 predicted = problem_.poses.back();
  if (options_.window.deskewing == Deskewing::kPredicted) {
    Segment& newest = segments_.back();
    DeskewToEnd(expected_velocity_.back() * newest.Duration_s(), &newest.cloud);
  }
  const std::vector<SE3> start = problem_.poses;

  WindowStatistics statistics;
  statistics.begin_ns = front_ns_;
  statistics.end_ns = segments_.back().cloud.end_ns;
  statistics.segments = segments();
  statistics.threshold_m = threshold_.threshold_m();
  statistics.kernel_m = KernelWidth();
  bool converged = false;
  bool finite = true;
  const std::vector<RegistrationNormalEquations>* registration_at_solution = nullptr;
  while (statistics.rounds < options_.solver.max_rounds && !converged && finite) {
    Stopwatch watch;
    const auto counts = AssociateAll(statistics.rounds == 0);
    statistics.searched += counts.searched;
    statistics.inliers = counts.associated;
    statistics.milliseconds_associate += watch.Milliseconds();

    BuildProblem();
    const SolveSummary summary = solver_->Solve(&problem_);
    statistics.milliseconds_solve += watch.Milliseconds();
    ++statistics.rounds;
    statistics.iterations += summary.iterations;
    statistics.cost_registration = summary.cost.registration;
    statistics.cost_smoothness = summary.cost.smoothness;
    statistics.cost_prior = summary.cost.prior;
    statistics.rejected_steps += summary.rejected_steps;
    statistics.last_step_m = summary.step.translation_m;
    statistics.last_step_rad = summary.step.rotation_rad;
    finite = summary.finite;
    registration_at_solution = summary.registration;
    // Without a step that lowers the cost, the window is as unsolved as before.
    converged = summary.iterations > 0 && summary.step.IsSmall(options_.solver);
  }
  for (const Segment& segment : segments_) {
    statistics.points += static_cast<int>(segment.cloud.registration_points.size());
  }

  const SE3 correction = predicted.Inverse() * problem_.poses.back();
  const bool jumped = correction.t.norm() > options_.lost.max_correction_m ||
                      so3::Log(correction.q).norm() > options_.lost.max_correction_rad;
  is_reverted_ = !finite || jumped;
  if (is_reverted_) {
    problem_.poses = start;
    statistics.flags |= kFlagReverted;
  } else {
    threshold_.AddPredictionError(correction);
    if (!converged) statistics.flags |= kFlagNotConverged;
  }
  if (segments_.back().association.registration_points().empty()) {
    statistics.flags |= kFlagNoPoints;
  }
  if (is_reverted_) {
    // The planes belong to poses that are not believed.
    registration_.assign(segments_.size(), {});
  } else if (registration_at_solution != nullptr) {
    registration_ = *registration_at_solution;
  } else {
    evaluator_.Evaluate(problem_, problem_.poses, true, &registration_);
  }
  if (options_.weight_balance.enabled && !is_reverted_) {
    balance_.Update(problem_, registration_, segments_.back().Duration_s());
  }
  statistics.smoothness_factor_translation = balance_.translation_factor();
  statistics.smoothness_factor_rotation = balance_.rotation_factor();
  const WindowCondition condition = ConditionOf(problem_, registration_);
  statistics.smallest_eigenvalue = condition.smallest_eigenvalue;
  statistics.weak_direction = condition.weak_direction;
  if (condition.smallest_eigenvalue < options_.lost.degenerate_eigenvalue) {
    statistics.flags |= kFlagDegenerate;
  }
  segments_.back().flags = statistics.flags;
  return statistics;
}

void SlidingWindow::Predict() {
  const int n = segments();
  // The pseudo-velocities of the whole window are those of the previous solve.
  std::vector<Vector6d> velocity(static_cast<std::size_t>(n));
  velocity[0] = velocity_before_;
  for (int k = 1; k < n; ++k) {
    velocity[k] = Minus(problem_.poses[k], problem_.poses[k - 1]) / segments_[k - 1].Duration_s();
  }
  expected_velocity_ = velocity;
  problem_.poses.push_back(
      Plus(problem_.poses.back(), velocity.back() * segments_.back().Duration_s()));
}

double SlidingWindow::KernelWidth() const {
  return std::clamp(options_.weights.kernel_in_thresholds * threshold_.threshold_m(),
                    options_.weights.min_kernel_m, options_.weights.max_kernel_m);
}

SegmentAssociation::Counts SlidingWindow::AssociateAll(bool renew) {
  SegmentAssociation::Counts sum;
  for (int k = 0; k < segments(); ++k) {
    const auto counts = segments_[k].association.Associate(
        segments_[k].cloud.registration_points, segments_[k].cloud.lidar_origins_body_m,
        problem_.poses[k], problem_.poses[k + 1], *map_, renew, threads_);
    sum.searched += counts.searched;
    sum.associated += counts.associated;
  }
  return sum;
}

void SlidingWindow::BuildProblem() {
  const WeightOptions& weights = options_.weights;
  problem_.noise = {weights.registration_sigma_m,
                    {weights.kernel, KernelWidth() / weights.registration_sigma_m}};
  problem_.points.clear();
  problem_.smoothness.clear();
  for (int k = 0; k < segments(); ++k) {
    const Segment& segment = segments_[k];
    problem_.points.push_back(&segment.association.registration_points());
    SmoothnessTerm term;
    term.tau_expected = expected_velocity_[k] * segment.Duration_s();
    const double ratio = std::max(1.0, segment.Duration_s() / weights.smoothness_interval_s);
    term.sqrt_information.head<3>().setConstant(
        1.0 / (balance_.translation_factor() * weights.smoothness_sigma_translation_m));
    term.sqrt_information.tail<3>().setConstant(
        1.0 / (balance_.rotation_factor() * weights.smoothness_sigma_rotation_rad));
    if (weights.smoothness_scales_with_points) {
      double points = 0.0;
      for (const RegistrationPoint& point : *problem_.points.back()) points += point.weight;
      term.sqrt_information *= std::sqrt(std::max(points, 1.0));
    }
    term.sqrt_information /= ratio * ratio;
    problem_.smoothness.push_back(term);
  }
}

Matrix6d SlidingWindow::front_covariance() const {
  WindowNormalEquations window;
  AssembleWindow(problem_, problem_.poses, registration_, &window);
  return FirstPoseCovariance(window);
}

SlidingWindow::Left SlidingWindow::Marginalize() {
  const MarginalizationOptions& marginalization = options_.marginalization;
  MarginalizationPrior prior =
      marginalization.enabled
          ? MarginalizeOldest(problem_, registration_.front(), marginalization.use_qr)
          : MakeAnchor(problem_.poses[1], marginalization.anchor_sigma_translation_m,
                       marginalization.anchor_sigma_rotation_rad);

  // The poses of a reverted window are no minimum: what is left of their gradient would pull at the
  // windows that follow.
  if (is_reverted_) prior.offset.setZero();

  Segment& oldest = segments_.front();
  Left left{std::move(oldest.cloud), problem_.poses[0], problem_.poses[1]};
  velocity_before_ = Minus(left.T_end, left.T_begin) /
                     (static_cast<double>(left.cloud.end_ns - left.cloud.begin_ns) * 1e-9);
  front_ns_ = left.cloud.end_ns;
  front_flags_ = oldest.flags;
  segments_.pop_front();
  expected_velocity_.erase(expected_velocity_.begin());
  problem_.poses.erase(problem_.poses.begin());
  problem_.points.erase(problem_.points.begin());
  problem_.smoothness.erase(problem_.smoothness.begin());
  registration_.erase(registration_.begin());
  problem_.prior = prior;
  return left;
}

}  // namespace trajlo
