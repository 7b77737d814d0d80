// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/alignment.h"
#include "core/evaluation/association.h"
#include "core/evaluation/divergence.h"
#include "core/evaluation/error_statistics.h"
#include "core/evaluation/kitti_metric.h"
#include "core/evaluation/pose_errors.h"
#include "core/evaluation/relative_error.h"
#include "core/evaluation/time_offset.h"
#include "core/evaluation/timed_poses.h"

namespace trajlo {

/// Whether the rotations of the truth mean anything. kAuto: unless all are exactly the identity.
enum class TruthOrientation { kAuto, kUse, kIgnore };

bool UsesOrientation(const TimedPoses& truth, TruthOrientation orientation);

struct EvaluationOptions {
  PoseAssociationOptions association;
  AlignmentOptions alignment;
  std::vector<RelativeErrorOptions> relative;
  /// The frame that the truth describes, in the body frame of the estimate. A prism at a lever arm
  /// is a translation.
  Eigen::Affine3d T_body_truth = Eigen::Affine3d::Identity();
  TruthOrientation truth_orientation = TruthOrientation::kAuto;
  /// Added to the stamps of the estimate; the middle of the search if the offset is estimated.
  double time_offset_s = 0.0;
  bool estimate_time_offset = false;
  double time_offset_reach_s = 0.5;
  /// The estimate covers what lies between two poses that are at most this far apart.
  double max_estimate_gap_s = 1.0;
  DivergenceOptions divergence;
  /// Warn of odd rotations; of no use where positions alone count.
  bool doubt_rotations = true;
};

/// Statistics of the errors of one kind; a `count` of 0 means that this kind was not computed.
struct PoseErrorStatistics {
  ErrorStatistics translation_m, rotation_deg, rotation_part, full, point_distance_m;
};

struct RelativeEvaluation {
  RelativeErrorOptions options;
  std::size_t pieces = 0;
  /// point_distance_m always; the others if the truth has orientation.
  PoseErrorStatistics statistics;
  /// Why there is no piece; empty if there is one.
  std::string reason;
};

/// What is known about one estimate.
struct Evaluation {
  /// After the alignment.
  std::vector<PosePair> pairs;
  bool has_orientation = true;
  double time_offset_s = 0.0;
  std::optional<TimeOffset> estimated_time_offset;
  Alignment alignment;
  PoseErrors errors;
  PoseErrorStatistics absolute;
  /// False: the absolute rotation errors are mostly a turn that the alignment leaves open.
  bool rotation_determined = true;
  std::vector<RelativeEvaluation> relative;
  /// Nothing, and a reason, without orientation or if the path is too short.
  std::optional<KittiErrors> kitti;
  std::string kitti_reason;
  double completeness = 0.0;
  /// The share of the estimate's poses that have a partner (of the truth's poses if the estimate
  /// is interpolated).
  double paired_share = 0.0;
  /// The share of the estimate's time that the pairs stand for; 1 without stamps.
  double covered_share = 1.0;
  /// Along the truth of the pairs.
  double path_length_m = 0.0;
  /// From the first pair to the last; 0 without stamps.
  double duration_s = 0.0;
  /// Empty: the run succeeded.
  std::string divergence_reason;
  /// It counts as failed for being short alone; where it is, its errors are small.
  bool incomplete = false;
  std::vector<std::string> warnings;
};

/// Compares an estimate with the truth. Throws EvaluationError if that is impossible.
Evaluation Evaluate(const TimedPoses& estimate, const TimedPoses& truth,
                    const EvaluationOptions& options);

}  // namespace trajlo
