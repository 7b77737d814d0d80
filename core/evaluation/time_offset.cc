// SPDX-License-Identifier: MIT
#include "core/evaluation/time_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/evaluation/alignment.h"
#include "core/evaluation/association.h"
#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr double kGridStep_s = 0.02;
constexpr double kResolution_s = 1e-5;
// More poses would not make the offset better, only slower to find.
constexpr std::size_t kMaxPoses = 2000;
constexpr double kKeptShare = 0.8;
// Errors that vary by less over the whole range say nothing about the offset.
constexpr double kFlat = 1.05;

struct Cost {
  double rmse_m = std::numeric_limits<double>::infinity();
  std::size_t pairs = 0;
};

TimedPoses Thinned(const TimedPoses& poses) {
  const std::size_t step = (poses.size() + kMaxPoses - 1) / kMaxPoses;
  TimedPoses thinned;
  for (std::size_t i = 0; i < poses.size(); i += step) {
    thinned.t_ns.push_back(poses.t_ns[i]);
    thinned.T_world_body.push_back(poses.T_world_body[i]);
  }
  return thinned;
}

Cost CostAt(double offset_s, const TimedPoses& estimate, const TimedPoses& truth,
            const PoseAssociationOptions& association, bool with_scale) {
  Cost cost;
  try {
    const std::vector<PosePair> pairs =
        Associate(estimate, truth, Nanoseconds(offset_s), association);
    cost.rmse_m = AlignedRmse_m(pairs, Umeyama(pairs, with_scale));
    cost.pairs = pairs.size();
  } catch (const EvaluationError&) {
    // Nothing overlaps or the alignment is undetermined at this offset: not a candidate.
  }
  return cost;
}

/// The minimum of a function with one valley between a and b.
template <typename Function>
double GoldenSection(double a, double b, Function&& f) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double left = b - ratio * (b - a), right = a + ratio * (b - a);
  double f_left = f(left), f_right = f(right);
  while (b - a > kResolution_s) {
    if (f_left <= f_right) {
      b = right;
      right = left;
      f_right = f_left;
      left = b - ratio * (b - a);
      f_left = f(left);
    } else {
      a = left;
      left = right;
      f_left = f_right;
      right = a + ratio * (b - a);
      f_right = f(right);
    }
  }
  return 0.5 * (a + b);
}

/// The association of the search: one that interpolates, by gaps of the whole trajectories.
PoseAssociationOptions Interpolating(PoseAssociationOptions association, const TimedPoses& estimate,
                                     const TimedPoses& truth) {
  const bool of_estimate = association.rule == AssociationRule::kInterpolateEstimate;
  if (!of_estimate) association.rule = AssociationRule::kInterpolate;
  if (association.max_gap_s <= 0.0) {
    association.max_gap_s = MaxGap(of_estimate ? estimate.t_ns : truth.t_ns);
  }
  return association;
}

/// The costs of evenly spaced offsets.
struct Grid {
  std::vector<Cost> costs;
  std::size_t most_pairs = 0;
  int best = -1;
  double worst_rmse_m = 0.0;

  /// Infinite where too few pairs are left.
  double Rmse(const Cost& cost) const {
    const bool has_enough = cost.pairs > 0 && static_cast<double>(cost.pairs) >=
                                                  kKeptShare * static_cast<double>(most_pairs);
    return has_enough ? cost.rmse_m : std::numeric_limits<double>::infinity();
  }
  double BestRmse() const { return Rmse(costs[static_cast<std::size_t>(best)]); }
};

template <typename CostAt>
Grid Search(double around_s, double step_s, int half, CostAt&& cost_at) {
  Grid grid;
  for (int k = -half; k <= half; ++k) {
    grid.costs.push_back(cost_at(around_s + k * step_s));
    grid.most_pairs = std::max(grid.most_pairs, grid.costs.back().pairs);
  }
  for (int k = 0; k <= 2 * half; ++k) {
    const double rmse_m = grid.Rmse(grid.costs[static_cast<std::size_t>(k)]);
    if (!std::isfinite(rmse_m)) continue;
    grid.worst_rmse_m = std::max(grid.worst_rmse_m, rmse_m);
    if (grid.best < 0 || rmse_m < grid.BestRmse()) grid.best = k;
  }
  return grid;
}

}  // namespace

TimeOffset EstimateTimeOffset(const TimedPoses& estimate, const TimedPoses& truth,
                              const TimeOffsetOptions& options) {
  if (!estimate.HasStamps() || !truth.HasStamps()) {
    throw EvaluationError("a time offset cannot be estimated without stamps");
  }
  const auto association = Interpolating(options.association, estimate, truth);
  // Only the poses at whose times the other trajectory is interpolated.
  const bool of_estimate = association.rule == AssociationRule::kInterpolateEstimate;
  const TimedPoses thinned = Thinned(of_estimate ? truth : estimate);
  const auto cost_at = [&](double offset_s) {
    return CostAt(offset_s, of_estimate ? estimate : thinned, of_estimate ? thinned : truth,
                  association, options.with_scale);
  };

  const int half = std::max(2, static_cast<int>(std::ceil(options.reach_s / kGridStep_s)));
  const double step_s = options.reach_s / half;
  const Grid grid = Search(options.around_s, step_s, half, cost_at);
  if (grid.best < 0) {
    throw EvaluationError(
        "no time offset was found: estimate and ground truth cannot be compared "
        "anywhere in the range that was searched; --time_offset_reach_s widens it, and "
        "--time_offset_s is its middle");
  }
  TimeOffset result;
  const auto rmse_at = [&](double offset_s) { return grid.Rmse(cost_at(offset_s)); };
  const double centre_s = options.around_s + (grid.best - half) * step_s;
  result.offset_s =
      GoldenSection(std::max(centre_s - step_s, options.around_s - options.reach_s),
                    std::min(centre_s + step_s, options.around_s + options.reach_s), rmse_at);
  // Where the errors have no single valley, the search may end beside it.
  if (!(rmse_at(result.offset_s) <= grid.BestRmse())) result.offset_s = centre_s;
  const auto rmse_of_all = [&](double offset_s) {
    return CostAt(offset_s, estimate, truth, association, options.with_scale).rmse_m;
  };
  result.rmse_m = rmse_of_all(result.offset_s);
  result.rmse_around_m = rmse_of_all(options.around_s);
  if (grid.worst_rmse_m < kFlat * grid.BestRmse()) {
    result.warning = "the error hardly depends on the time offset; the estimated one means little";
  } else if (grid.best == 0 || grid.best == 2 * half) {
    result.warning =
        "the best time offset lies at the end of the range that was searched; "
        "--time_offset_reach_s widens it";
  }
  return result;
}

}  // namespace trajlo
