// SPDX-License-Identifier: MIT
#include "core/evaluation/evaluation.h"

#include <cmath>
#include <set>
#include <utility>

#include "core/evaluation/absolute_error.h"
#include "core/evaluation/completeness.h"
#include "core/evaluation/coverage.h"
#include "core/evaluation/error_causes.h"
#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/inverse_doubt.h"
#include "core/evaluation/rotation_doubt.h"
#include "core/evaluation/shape_doubt.h"
#include "core/evaluation/stamp_search.h"
#include "core/io/format_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Of an error: what comes from elsewhere is said if it is more.
constexpr double kWorthSaying = 0.5;
/// Clocks that are nearer to each other are not told apart by errors of an estimate.
constexpr double kClockDifference_s = 0.002;

PoseErrorStatistics Statistics(const PoseErrors& errors) {
  return {ComputeStatistics(errors.translation_m), ComputeStatistics(errors.rotation_deg),
          ComputeStatistics(errors.rotation_part), ComputeStatistics(errors.full),
          ComputeStatistics(errors.point_distance_m)};
}

RelativeEvaluation EvaluateRelative(const Evaluation& evaluation,
                                    const std::vector<std::int64_t>& stamps,
                                    const RelativeErrorOptions& options) {
  RelativeEvaluation result;
  result.options = options;
  if (options.unit == DeltaUnit::kSeconds && stamps.empty()) {
    result.reason = "there are no stamps";
    return result;
  }
  const IndexPairs pieces = SelectPieces(evaluation.pairs, stamps, options);
  result.pieces = pieces.size();
  result.statistics =
      Statistics(RelativeErrors(evaluation.pairs, pieces, evaluation.has_orientation));
  if (pieces.empty()) {
    result.reason =
        FormatText("no piece of %g %s was found", options.delta, DeltaUnitName(options.unit));
  }
  return result;
}

void EvaluateKitti(const std::vector<PosePair>& pairs, Evaluation* evaluation) {
  if (!evaluation->has_orientation) {
    evaluation->kitti_reason = "the ground truth has no orientation";
    return;
  }
  KittiErrors errors = ComputeKittiErrors(pairs);
  if (errors.segments.empty()) {
    evaluation->kitti_reason = FormatText("the path of %.1f m is too short: pieces begin at %g m",
                                          evaluation->path_length_m, kKittiLengths_m.front());
    return;
  }
  if (!std::isfinite(errors.translation_percent) || !std::isfinite(errors.rotation_deg_per_m)) {
    evaluation->kitti_reason = "they are not finite";
    return;
  }
  evaluation->kitti = std::move(errors);
}

/// Keeps a warning unless it is empty.
void Warn(std::string warning, Evaluation* evaluation) {
  if (!warning.empty()) evaluation->warnings.push_back(std::move(warning));
}

double FindTimeOffset(const TimedPoses& estimate, const TimedPoses& truth,
                      const EvaluationOptions& options, Evaluation* evaluation) {
  if (!options.estimate_time_offset) return options.time_offset_s;
  TimeOffsetOptions search;
  search.around_s = options.time_offset_s;
  search.reach_s = options.time_offset_reach_s;
  search.association = options.association;
  search.with_scale = HasScale(options.alignment.kind);
  const TimeOffset found =
      EstimateTimeOffset(InFrame(estimate, options.T_body_truth), truth, search);
  Warn(found.warning, evaluation);
  evaluation->estimated_time_offset = found;
  return found.offset_s;
}

/// Says where an error is mostly none of the estimate's.
void WarnOfOtherCauses(const TimedPoses& estimate, const TimedPoses& truth,
                       const PoseAssociationOptions& options, Evaluation* evaluation) {
  const std::int64_t offset_ns = Nanoseconds(evaluation->time_offset_s);
  const double rmse_m = evaluation->absolute.translation_m.rmse;
  if (options.rule == AssociationRule::kInterpolate) {
    const double max_gap_s = options.max_gap_s > 0.0 ? options.max_gap_s : MaxGap(truth.t_ns);
    const double line_m = StraightLineError_m(estimate, truth, offset_ns, max_gap_s);
    if (line_m > kWorthSaying * rmse_m) {
      evaluation->warnings.push_back(FormatText(
          "the truth is sparse: between its poses the body leaves the straight line by %.2g m "
          "(RMS, by the estimate), and the ATE is %.2g m; --association=interpolate_estimate "
          "compares at the truth's own times",
          line_m, rmse_m));
    }
  }
  const ClockDifference clocks = ExplainByClocks(evaluation->pairs);
  if (clocks.share > kWorthSaying && std::abs(clocks.offset_s) > kClockDifference_s) {
    evaluation->warnings.push_back(FormatText(
        "the error goes along with the velocity, as if the clocks differed by some %.1g s; "
        "--estimate_time_offset finds out",
        clocks.offset_s));
  }
}

/// The share of the poses that occur in a pair.
double PairedShare(const std::vector<PosePair>& pairs, const TimedPoses& counted) {
  std::set<std::size_t> indices;
  for (const PosePair& pair : pairs) indices.insert(pair.index);
  return static_cast<double>(indices.size()) / static_cast<double>(counted.size());
}

/// `counted` is the trajectory whose poses the pairs' indices count.
void PairUp(const TimedPoses& estimate, const TimedPoses& truth, const TimedPoses& counted,
            const EvaluationOptions& options, Evaluation* evaluation) {
  const std::int64_t offset_ns = Nanoseconds(evaluation->time_offset_s);
  std::vector<PosePair>& pairs = evaluation->pairs;
  pairs = Associate(estimate, truth, offset_ns, options.association);
  // After the association: between two poses the body moves, and the lever arm turns with it.
  for (PosePair& pair : pairs) pair.estimate = pair.estimate * options.T_body_truth;

  std::vector<Eigen::Affine3d> truth_of_pairs;
  for (const PosePair& pair : pairs) truth_of_pairs.push_back(pair.truth);
  evaluation->path_length_m = PathLength(truth_of_pairs);
  if (estimate.HasStamps() && truth.HasStamps()) {
    evaluation->duration_s = Seconds(pairs.back().t_ns - pairs.front().t_ns);
  }
  evaluation->completeness = Completeness(estimate, truth, offset_ns, options.max_estimate_gap_s);
  evaluation->paired_share = PairedShare(pairs, counted);
  const Coverage coverage = CoverageOf(estimate, pairs);
  evaluation->covered_share = coverage.Share();
  Warn(JudgeCoverage(coverage), evaluation);
}

void AlignPairs(const AlignmentOptions& options, Evaluation* evaluation) {
  evaluation->alignment = ComputeAlignment(evaluation->pairs, options);
  Warn(evaluation->alignment.warning, evaluation);
  for (PosePair& pair : evaluation->pairs) pair.estimate = evaluation->alignment * pair.estimate;
}

void DoubtRotations(TrajectoryFormat truth_format, Evaluation* evaluation) {
  RotationDoubt doubt = JudgeRotations(evaluation->pairs, evaluation->alignment, truth_format);
  evaluation->rotation_determined = doubt.determined;
  for (std::string& warning : doubt.warnings) Warn(std::move(warning), evaluation);
}

/// Says what the truth seems to be other than the poses of the body in metres, by the clock of the
/// estimate. Inverted poses explain all else that is odd about them.
void DoubtTruth(const TimedPoses& estimate, const TimedPoses& truth,
                const EvaluationOptions& options, Evaluation* evaluation) {
  const bool with_scale = HasScale(options.alignment.kind);
  if (evaluation->has_orientation) {
    const std::string inverse = JudgeInverse(evaluation->pairs, with_scale);
    Warn(inverse, evaluation);
    if (!inverse.empty()) return;
  }
  for (std::string& warning : JudgeShape(evaluation->pairs, with_scale)) {
    Warn(std::move(warning), evaluation);
  }
  if (estimate.HasStamps() && truth.HasStamps()) {
    WarnOfOtherCauses(estimate, truth, options.association, evaluation);
  }
  if (evaluation->has_orientation && options.doubt_rotations) {
    DoubtRotations(truth.format, evaluation);
  }
}

}  // namespace

bool UsesOrientation(const TimedPoses& truth, TruthOrientation orientation) {
  return orientation == TruthOrientation::kUse ||
         (orientation == TruthOrientation::kAuto && HasOrientation(truth));
}

Evaluation Evaluate(const TimedPoses& estimate, const TimedPoses& truth,
                    const EvaluationOptions& options) {
  Evaluation evaluation;
  evaluation.has_orientation = UsesOrientation(truth, options.truth_orientation);
  if (!evaluation.has_orientation && options.alignment.kind == AlignmentKind::kOrigin) {
    throw EvaluationError("the first pose cannot be aligned: the ground truth has no orientation");
  }
  const bool timed = estimate.HasStamps() && truth.HasStamps();
  if (!timed && options.alignment.first_seconds > 0.0) {
    throw EvaluationError("without stamps the first seconds cannot be told");
  }
  // The trajectory whose poses the pairs' indices count.
  const TimedPoses& counted =
      timed && options.association.rule == AssociationRule::kInterpolateEstimate ? truth : estimate;
  evaluation.time_offset_s = FindTimeOffset(estimate, truth, options, &evaluation);
  PairUp(estimate, truth, counted, options, &evaluation);
  // Of the estimate as it is: neither aligned nor scaled.
  EvaluateKitti(evaluation.pairs, &evaluation);

  AlignPairs(options.alignment, &evaluation);
  evaluation.errors = AbsoluteErrors(evaluation.pairs, evaluation.has_orientation);
  evaluation.absolute = Statistics(evaluation.errors);
  DoubtTruth(estimate, truth, options, &evaluation);
  for (const RelativeErrorOptions& relative : options.relative) {
    evaluation.relative.push_back(EvaluateRelative(evaluation, counted.t_ns, relative));
  }
  evaluation.divergence_reason =
      DivergenceReason(evaluation.absolute.translation_m, evaluation.path_length_m,
                       evaluation.completeness, options.divergence);
  evaluation.incomplete = IsIncomplete(evaluation.absolute.translation_m, evaluation.path_length_m,
                                       evaluation.completeness, options.divergence);
  return evaluation;
}

}  // namespace trajlo
