// SPDX-License-Identifier: MIT
#include "core/evaluation/alignment.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Ratio of the second singular value to the first. Rounding alone leaves about 1e-16 on a line.
constexpr double kUndetermined = 1e-13;

std::vector<PosePair> FirstPairs(const std::vector<PosePair>& pairs,
                                 const AlignmentOptions& options) {
  std::size_t count = pairs.size();
  if (options.first_pairs > 0) count = std::min(count, options.first_pairs);
  if (options.first_seconds > 0.0) {
    const std::int64_t end_ns = pairs.front().t_ns + Nanoseconds(options.first_seconds);
    std::size_t within = 0;
    while (within < count && pairs[within].t_ns <= end_ns) ++within;
    count = within;
  }
  return {pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::string PositionsText(std::size_t pairs) {
  if (pairs == 1) return "it rests on a single pair of poses";
  return "the positions of the " + std::to_string(pairs) +
         " pairs that it rests on are a single place or lie on a straight line";
}

}  // namespace

Eigen::Affine3d Alignment::operator*(const Eigen::Affine3d& pose) const {
  Eigen::Affine3d aligned = Eigen::Affine3d::Identity();
  aligned.linear() = R * pose.linear();
  aligned.translation() = R * (scale * pose.translation()) + t;
  return aligned;
}

Alignment Umeyama(const std::vector<PosePair>& pairs, bool with_scale) {
  const double n = static_cast<double>(pairs.size());
  Vector3d mean_estimate = Vector3d::Zero();
  Vector3d mean_truth = Vector3d::Zero();
  for (const PosePair& pair : pairs) {
    mean_estimate += pair.estimate.translation();
    mean_truth += pair.truth.translation();
  }
  mean_estimate /= n;
  mean_truth /= n;
  Matrix3d covariance = Matrix3d::Zero();
  double variance = 0.0;
  for (const PosePair& pair : pairs) {
    const Vector3d e = pair.estimate.translation() - mean_estimate;
    covariance += (pair.truth.translation() - mean_truth) * e.transpose();
    variance += e.squaredNorm();
  }
  covariance /= n;
  variance /= n;

  Alignment alignment;
  alignment.kind = with_scale ? AlignmentKind::kSim3 : AlignmentKind::kSe3;
  if (!covariance.allFinite() || !std::isfinite(variance)) {
    alignment.warning = "positions are too far out to be squared; nothing is aligned";
    return alignment;
  }
  const Eigen::JacobiSVD<Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d& d = svd.singularValues();
  if (!(d[1] > std::max(kUndetermined * d[0], std::numeric_limits<double>::epsilon()))) {
    throw EvaluationError(
        "the alignment is undetermined: " + PositionsText(pairs.size()) +
        "\n  "
        "--alignment=origin aligns by the attitude of the first pose, --alignment=none not at all");
  }
  Vector3d s = Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) s.z() = -1.0;
  alignment.R = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
  if (with_scale) alignment.scale = d.dot(s) / variance;
  alignment.t = mean_truth - alignment.scale * alignment.R * mean_estimate;
  alignment.pairs_used = pairs.size();
  // Turned by a small angle about axis i, the positions move by that times the root of this.
  const Vector3d reach = d.cwiseProduct(s);
  const double residual = AlignedRmse_m(pairs, alignment);
  alignment.rotation_axes = svd.matrixU();
  for (int i = 0; i < 3; ++i) {
    alignment.rotation_sigma_rad[i] =
        residual / std::sqrt(std::max(alignment.scale * (reach.sum() - reach[i]),
                                      std::numeric_limits<double>::min()));
  }
  return alignment;
}

double AlignedRmse_m(const std::vector<PosePair>& pairs, const Alignment& alignment) {
  double sum = 0.0;
  for (const PosePair& pair : pairs) {
    sum += ((alignment * pair.estimate).translation() - pair.truth.translation()).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

std::optional<double> RotationSigmaDeg(const Alignment& alignment) {
  const bool by_positions =
      alignment.kind == AlignmentKind::kSe3 || alignment.kind == AlignmentKind::kSim3;
  if (!by_positions) return std::nullopt;
  return alignment.rotation_sigma_rad.maxCoeff() * (180.0 / M_PI);
}

Alignment ComputeAlignment(const std::vector<PosePair>& pairs, const AlignmentOptions& options) {
  Alignment alignment;
  switch (options.kind) {
    case AlignmentKind::kNone:
      break;
    case AlignmentKind::kOrigin:
      alignment.R = pairs.front().truth.linear() * pairs.front().estimate.linear().transpose();
      alignment.t =
          pairs.front().truth.translation() - alignment.R * pairs.front().estimate.translation();
      alignment.pairs_used = 1;
      break;
    case AlignmentKind::kSe3:
      alignment = Umeyama(FirstPairs(pairs, options), false);
      break;
    case AlignmentKind::kSim3:
      alignment = Umeyama(FirstPairs(pairs, options), true);
      break;
    case AlignmentKind::kScale:
      alignment = Umeyama(FirstPairs(pairs, options), true);
      alignment.R.setIdentity();
      alignment.t.setZero();
      alignment.rotation_sigma_rad.setZero();
      break;
  }
  alignment.kind = options.kind;
  return alignment;
}

}  // namespace trajlo
