// SPDX-License-Identifier: MIT
#include "core/evaluation/time_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/evaluation/alignment.h"
#include "core/evaluation/association.h"
#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/stamp_search.h"

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
    const Alignment alignment = Umeyama(pairs, with_scale);
    double squares = 0.0;
    for (const PosePair& pair : pairs) {
      const Eigen::Affine3d aligned = alignment * pair.estimate;
      squares += (aligned.translation() - pair.truth.translation()).squaredNorm();
    }
    cost.pairs = pairs.size();
    cost.rmse_m = std::sqrt(squares / static_cast<double>(pairs.size()));
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

}  // namespace

TimeOffset EstimateTimeOffset(const TimedPoses& estimate, const TimedPoses& truth,
                              const TimeOffsetOptions& options) {
  if (!estimate.HasStamps() || !truth.HasStamps()) {
    throw EvaluationError("a time offset cannot be estimated without stamps");
  }
  PoseAssociationOptions association;
  association.max_gap_s = options.max_gap_s > 0.0 ? options.max_gap_s : MaxGap(truth.t_ns);
  const TimedPoses thinned = Thinned(estimate);
  const auto cost_at = [&](double offset_s) {
    return CostAt(offset_s, thinned, truth, association, options.with_scale);
  };

  const int half = std::max(2, static_cast<int>(std::ceil(options.reach_s / kGridStep_s)));
  const double step_s = options.reach_s / half;
  std::vector<Cost> grid;
  std::size_t most_pairs = 0;
  for (int k = -half; k <= half; ++k) {
    grid.push_back(cost_at(options.around_s + k * step_s));
    most_pairs = std::max(most_pairs, grid.back().pairs);
  }
  int best = -1;
  double worst_rmse = 0.0;
  for (int k = 0; k <= 2 * half; ++k) {
    const Cost& cost = grid[static_cast<std::size_t>(k)];
    if (cost.pairs == 0 ||
        static_cast<double>(cost.pairs) < kKeptShare * static_cast<double>(most_pairs)) {
      continue;
    }
    worst_rmse = std::max(worst_rmse, cost.rmse_m);
    if (best < 0 || cost.rmse_m < grid[static_cast<std::size_t>(best)].rmse_m) best = k;
  }
  if (best < 0) {
    throw EvaluationError(
        "no time offset was found: estimate and ground truth cannot be compared "
        "anywhere in the range that was searched; --time_offset_reach_s widens it, and "
        "--time_offset_s is its middle");
  }
  TimeOffset result;
  const double centre_s = options.around_s + (best - half) * step_s;
  result.offset_s = GoldenSection(std::max(centre_s - step_s, options.around_s - options.reach_s),
                                  std::min(centre_s + step_s, options.around_s + options.reach_s),
                                  [&](double offset_s) { return cost_at(offset_s).rmse_m; });
  const auto rmse_of_all = [&](double offset_s) {
    return CostAt(offset_s, estimate, truth, association, options.with_scale).rmse_m;
  };
  result.rmse_m = rmse_of_all(result.offset_s);
  result.rmse_around_m = rmse_of_all(options.around_s);
  if (worst_rmse < kFlat * grid[static_cast<std::size_t>(best)].rmse_m) {
    result.warning = "the error hardly depends on the time offset; the estimated one means little";
  } else if (best == 0 || best == 2 * half) {
    result.warning =
        "the best time offset lies at the end of the range that was searched; "
        "--time_offset_reach_s widens it";
  }
  return result;
}

}  // namespace trajlo
