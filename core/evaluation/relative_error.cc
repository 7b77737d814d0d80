// SPDX-License-Identifier: MIT
#include "core/evaluation/relative_error.h"

#include <cmath>
#include <limits>

namespace trajlo {
namespace {

constexpr std::size_t kNoPartner = std::numeric_limits<std::size_t>::max();

/// Pieces between stamps as pieces between pairs, without those that have no partner, and turned
/// round in time.
IndexPairs OfPairs(const IndexPairs& of_stamps, std::size_t stamps,
                   const std::vector<PosePair>& pairs) {
  std::vector<std::size_t> pair_of(stamps, kNoPartner);
  for (std::size_t k = pairs.size(); k-- > 0;) pair_of[pairs[k].index] = k;
  IndexPairs pieces;
  for (const auto& [i, j] : of_stamps) {
    if (pair_of[i] == kNoPartner || pair_of[j] == kNoPartner) continue;
    pieces.push_back({pair_of[j], pair_of[i]});
  }
  return pieces;
}

}  // namespace

const char* DeltaUnitName(DeltaUnit unit) {
  switch (unit) {
    case DeltaUnit::kMetres:
      return "m";
    case DeltaUnit::kSeconds:
      return "s";
    case DeltaUnit::kFrames:
      return "f";
    case DeltaUnit::kDegrees:
      break;
  }
  return "d";
}

IndexPairs SelectPieces(const std::vector<PosePair>& aligned,
                        const std::vector<std::int64_t>& estimate_t_ns,
                        const RelativeErrorOptions& options) {
  if (options.unit == DeltaUnit::kFrames) {
    return PairsOverFrames(aligned.size(), static_cast<std::size_t>(options.delta),
                           options.all_pairs);
  }
  if (options.unit == DeltaUnit::kSeconds) {
    return OfPairs(AllPairsOverTime(estimate_t_ns, options.delta, options.tolerance),
                   estimate_t_ns.size(), aligned);
  }
  std::vector<Eigen::Affine3d> along;
  for (const PosePair& pair : aligned) {
    along.push_back(options.along_truth ? pair.truth : pair.estimate);
  }
  if (options.unit == DeltaUnit::kDegrees) return ConsecutivePairsOverAngle(along, options.delta);
  return options.all_pairs ? AllPairsOverDistance(along, options.delta, options.tolerance)
                           : ConsecutivePairsOverDistance(along, options.delta);
}

PoseErrors RelativeErrors(const std::vector<PosePair>& aligned, const IndexPairs& pieces,
                          bool with_orientation) {
  PoseErrors errors;
  for (const auto& [i, j] : pieces) {
    const PosePair& first = aligned[i];
    const PosePair& last = aligned[j];
    const double distance_truth = (last.truth.translation() - first.truth.translation()).norm();
    const double distance_estimate =
        (last.estimate.translation() - first.estimate.translation()).norm();
    errors.point_distance_m.push_back(std::abs(distance_truth - distance_estimate));
    if (!with_orientation) continue;
    const Eigen::Affine3d delta_truth = RigidInverse(first.truth) * last.truth;
    const Eigen::Affine3d delta_estimate = RigidInverse(first.estimate) * last.estimate;
    const Eigen::Affine3d E = RigidInverse(delta_truth) * delta_estimate;
    errors.translation_m.push_back(E.translation().norm());
    AppendRotationErrors(E, &errors);
  }
  return errors;
}

}  // namespace trajlo
