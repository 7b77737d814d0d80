// SPDX-License-Identifier: MIT
#include "core/evaluation/association.h"

#include <algorithm>
#include <cmath>

#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/one_to_one.h"
#include "core/evaluation/stamp_search.h"
#include "core/io/format_text.h"
#include "core/io/scan_stamps.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr double kShortestMaxGap_s = 0.05;
constexpr double kIntervalsOfMaxGap = 2.5;
// Beyond it, two clocks do not count from the same instant.
constexpr double kOtherEpoch_s = 1e7;

std::string Span(const char* name, double begin_s, double end_s) {
  return FormatText("%s %.3f to %.3f s", name, begin_s, end_s);
}

[[noreturn]] void ThrowNoPair(const TimedPoses& estimate, const TimedPoses& truth,
                              std::int64_t offset_ns, const PoseAssociationOptions& options,
                              double max_gap_s) {
  const double begin = Seconds(estimate.t_ns.front() + offset_ns);
  const double end = Seconds(estimate.t_ns.back() + offset_ns);
  const double truth_begin = Seconds(truth.t_ns.front());
  const double truth_end = Seconds(truth.t_ns.back());
  std::string advice;
  if (end < truth_begin || begin > truth_end) {
    advice = std::abs(begin - truth_begin) > kOtherEpoch_s
                 ? "Are the stamps of both in seconds, and do both clocks count from the same "
                   "instant?"
                 : FormatText(
                       "Do both clocks agree? (--time_offset_s=%.3f would let both begin together)",
                       1e-3 * std::round(1e3 * (truth_begin - Seconds(estimate.t_ns.front()))) +
                           0.0);  // not -0
  } else if (options.rule == AssociationRule::kNearest ||
             options.rule == AssociationRule::kOneToOne) {
    advice = FormatText(
        "None is within %g s; --max_time_difference_s allows more, and --association=interpolate "
        "needs no tolerance",
        options.max_time_difference_s);
  } else {
    advice = FormatText("Gaps above %g s are not interpolated; --max_gap_s allows more", max_gap_s);
  }
  throw EvaluationError("no pose of the estimate has a partner in the ground truth: " +
                        Span("the estimate spans", begin, end) + ", " +
                        Span("the truth", truth_begin, truth_end) + "\n  " + advice);
}

std::vector<PosePair> PairLines(const TimedPoses& estimate, const TimedPoses& truth) {
  if (estimate.size() != truth.size()) {
    throw EvaluationError("the estimate has " + std::to_string(estimate.size()) +
                          " poses and the ground truth " + std::to_string(truth.size()) +
                          "; without stamps they are paired line by line and must have the same "
                          "number. trajlo_run --at=scan-end writes a pose for each scan, and "
                          "trajlo_convert RESULT FOLDER a poses.txt with a line for each");
  }
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    pairs.push_back(
        {static_cast<std::int64_t>(i), i, estimate.T_world_body[i], truth.T_world_body[i]});
  }
  return pairs;
}

std::vector<PosePair> PairNearest(const TimedPoses& estimate, const TimedPoses& truth,
                                  std::int64_t offset_ns, double max_difference_s) {
  const std::int64_t tolerance_ns = Nanoseconds(max_difference_s);
  const bool walk_truth = truth.size() < estimate.size();
  const std::size_t count = std::min(truth.size(), estimate.size());
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t e = walk_truth ? Nearest(estimate.t_ns, truth.t_ns[i] - offset_ns) : i;
    const std::size_t t = walk_truth ? i : Nearest(truth.t_ns, estimate.t_ns[i] + offset_ns);
    const std::int64_t t_ns = estimate.t_ns[e] + offset_ns;
    if (std::abs(t_ns - truth.t_ns[t]) > tolerance_ns) continue;
    pairs.push_back({t_ns, e, estimate.T_world_body[e], truth.T_world_body[t]});
  }
  return pairs;
}

std::vector<PosePair> PairClosestFirst(const TimedPoses& estimate, const TimedPoses& truth,
                                       std::int64_t offset_ns, double max_difference_s) {
  std::vector<std::int64_t> estimate_ns = estimate.t_ns;
  for (std::int64_t& t_ns : estimate_ns) t_ns += offset_ns;
  std::vector<PosePair> pairs;
  for (const auto& [t, e] : PairOneToOne(truth.t_ns, estimate_ns, max_difference_s)) {
    pairs.push_back({estimate_ns[e], e, estimate.T_world_body[e], truth.T_world_body[t]});
  }
  return pairs;
}

/// The pose at a fraction of the way from a to b.
Eigen::Affine3d Interpolate(const Eigen::Affine3d& a, const Eigen::Affine3d& b, double fraction) {
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(a.linear()).slerp(fraction, Eigen::Quaterniond(b.linear())).normalized();
  return Eigen::Translation3d((1.0 - fraction) * a.translation() + fraction * b.translation()) * q;
}

/// Interpolates `dense`, whose clock differs by `offset_ns`, at each of `t_ns`.
template <typename Use>
void InterpolateAt(const std::vector<std::int64_t>& t_ns, const TimedPoses& dense,
                   std::int64_t offset_ns, double max_gap_s, Use&& use) {
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    const auto at = FindInterval(dense.t_ns, t_ns[i] + offset_ns, Nanoseconds(max_gap_s));
    if (!at) continue;
    const Eigen::Affine3d& begin = dense.T_world_body[at->begin];
    use(i, at->fraction == 0.0
               ? begin
               : Interpolate(begin, dense.T_world_body[at->begin + 1], at->fraction));
  }
}

}  // namespace

double MaxGap(const std::vector<std::int64_t>& t_ns) {
  return std::max(kShortestMaxGap_s, kIntervalsOfMaxGap * TypicalPeriod(t_ns));
}

std::vector<PosePair> Associate(const TimedPoses& estimate, const TimedPoses& truth,
                                std::int64_t time_offset_ns,
                                const PoseAssociationOptions& options) {
  if (estimate.size() == 0) throw EvaluationError("the estimate has no poses");
  if (truth.size() == 0) throw EvaluationError("the ground truth has no poses");
  if (!estimate.HasStamps() && !truth.HasStamps()) return PairLines(estimate, truth);
  if (!estimate.HasStamps() || !truth.HasStamps()) {
    throw EvaluationError(std::string("the ") + (estimate.HasStamps() ? "truth" : "estimate") +
                          " has no stamps (KITTI's format); give those of its lines by --times");
  }
  std::vector<PosePair> pairs;
  double max_gap_s = options.max_gap_s;
  if (options.rule == AssociationRule::kNearest) {
    pairs = PairNearest(estimate, truth, time_offset_ns, options.max_time_difference_s);
  } else if (options.rule == AssociationRule::kOneToOne) {
    pairs = PairClosestFirst(estimate, truth, time_offset_ns, options.max_time_difference_s);
  } else if (options.rule == AssociationRule::kInterpolate) {
    if (max_gap_s <= 0.0) max_gap_s = MaxGap(truth.t_ns);
    InterpolateAt(
        estimate.t_ns, truth, time_offset_ns, max_gap_s,
        [&](std::size_t i, const Eigen::Affine3d& pose) {
          pairs.push_back({estimate.t_ns[i] + time_offset_ns, i, estimate.T_world_body[i], pose});
        });
  } else {
    if (max_gap_s <= 0.0) max_gap_s = MaxGap(estimate.t_ns);
    InterpolateAt(truth.t_ns, estimate, -time_offset_ns, max_gap_s,
                  [&](std::size_t i, const Eigen::Affine3d& pose) {
                    pairs.push_back({truth.t_ns[i], i, pose, truth.T_world_body[i]});
                  });
  }
  if (pairs.empty()) ThrowNoPair(estimate, truth, time_offset_ns, options, max_gap_s);
  return pairs;
}

}  // namespace trajlo
