// SPDX-License-Identifier: MIT
#include "core/evaluation/rotation_doubt.h"

#include <Eigen/SVD>
#include <cmath>
#include <optional>

#include "core/evaluation/pose_errors.h"
#include "core/io/format_text.h"

namespace trajlo {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegrees = 180.0 / M_PI;
// Standard deviations within which the alignment leaves a turn open.
constexpr double kOpenSigmas = 3.0;
// What is known no better is not known.
constexpr double kNoRotation_deg = 60.0;
// A smaller turn misleads nobody.
constexpr double kNoticed_deg = 0.1;
// A turn is constant if what is left without it is smaller by this.
constexpr double kConstantRatio = 10.0;
// No frame is forgotten for less. A mounting that is off by as much is a matter of calibration.
constexpr double kFrame_deg = 2.0;
// A flat path that is mirrored is one that is turned over.
constexpr double kMirrored_deg = 150.0;
// The other order of a quaternion is meant if rotations agree better by this.
constexpr double kOrderRatio = 4.0;

/// Rotations as one turn that they share, and what is left without it.
struct Turn {
  Vector3d mean_rad = Vector3d::Zero();
  double rms_deg = 0.0, rest_deg = 0.0;
};

Turn TurnOf(const std::vector<Matrix3d>& rotations) {
  Turn turn;
  Matrix3d sum = Matrix3d::Zero();
  for (const Matrix3d& R : rotations) sum += R;
  const Eigen::JacobiSVD<Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d s = Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) s.z() = -1.0;
  const Matrix3d mean = svd.matrixU() * s.asDiagonal() * svd.matrixV().transpose();
  const Eigen::AngleAxisd angle_axis(mean);
  turn.mean_rad = angle_axis.angle() * angle_axis.axis();
  for (const Matrix3d& R : rotations) {
    turn.rms_deg += std::pow(RotationAngleDeg(R), 2);
    turn.rest_deg += std::pow(RotationAngleDeg(mean.transpose() * R), 2);
  }
  const double n = static_cast<double>(rotations.size());
  turn.rms_deg = std::sqrt(turn.rms_deg / n);
  turn.rest_deg = std::sqrt(turn.rest_deg / n);
  return turn;
}

/// The turns from the estimate's attitudes to the truth's, in the world or in the body.
std::vector<Matrix3d> Turns(const std::vector<PosePair>& pairs, bool in_world) {
  std::vector<Matrix3d> turns;
  for (const PosePair& pair : pairs) {
    const Matrix3d& truth = pair.truth.linear();
    const Matrix3d estimate_back = pair.estimate.linear().transpose();
    turns.emplace_back(in_world ? truth * estimate_back : estimate_back * truth);
  }
  return turns;
}

/// Where the truth's file would have w if it kept to its format, and where a file that does not
/// has it, with the order that is right. A KITTI file has no quaternions.
struct ScalarPlace {
  const char* other;
  const char* mend;
};

std::optional<ScalarPlace> PlaceOfScalar(TrajectoryFormat format) {
  if (format == TrajectoryFormat::kKitti) return {};
  if (format == TrajectoryFormat::kEuroc) return ScalarPlace{"last", "EuRoC's csv has qw qx qy qz"};
  return ScalarPlace{"first", "trajectories need qx qy qz qw"};
}

/// The pairs as they were had the truth's file meant the other order.
std::vector<PosePair> WithScalarMoved(std::vector<PosePair> pairs, TrajectoryFormat format) {
  for (PosePair& pair : pairs) {
    const Eigen::Quaterniond q(pair.truth.linear());
    const bool is_first = format == TrajectoryFormat::kEuroc;
    pair.truth.linear() = is_first ? Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).matrix()
                                   : Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).matrix();
  }
  return pairs;
}

/// The part of a turn that the alignment leaves open, rad.
double OpenPart(const Vector3d& turn_rad, const Alignment& alignment) {
  double squared = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double part = alignment.rotation_axes.col(i).dot(turn_rad);
    if (std::abs(part) <= kOpenSigmas * alignment.rotation_sigma_rad[i]) squared += part * part;
  }
  return std::sqrt(squared);
}

}  // namespace

RotationDoubt JudgeRotations(const std::vector<PosePair>& aligned, const Alignment& alignment,
                             TrajectoryFormat truth_format) {
  RotationDoubt doubt;
  const Turn in_world = TurnOf(Turns(aligned, true));
  if (!std::isfinite(in_world.rms_deg)) return doubt;
  const std::optional<ScalarPlace> scalar = PlaceOfScalar(truth_format);
  if (scalar) {
    const Turn moved = TurnOf(Turns(WithScalarMoved(aligned, truth_format), true));
    if (kOrderRatio * moved.rest_deg < in_world.rest_deg) {
      doubt.warnings.push_back(FormatText(
          "the rotations of the ground truth seem to have w %s (without a constant turn, they "
          "differ from the estimate's by %.3g deg then, by %.3g deg as they are): %s",
          scalar->other, moved.rest_deg, in_world.rest_deg, scalar->mend));
      return doubt;
    }
  }
  const double open_deg = kDegrees * OpenPart(in_world.mean_rad, alignment);
  const double sigma_deg = RotationSigmaDeg(alignment).value_or(0.0);
  if (open_deg > kNoticed_deg && 2.0 * std::pow(open_deg, 2) > std::pow(in_world.rms_deg, 2)) {
    doubt.determined = false;
    doubt.warnings.push_back(FormatText(
        "ATE [deg] says little: it is mostly one turn of %.3g deg of the whole estimate, and the "
        "alignment leaves that open. Positions close together or nearly on a line %s. RPE [deg] "
        "does not depend on it, and --alignment=origin aligns by the attitude of the first pose",
        open_deg,
        sigma_deg < kNoRotation_deg
            ? FormatText("fix the rotation to %.2g deg only", sigma_deg).c_str()
            : "do not fix the rotation"));
    return doubt;
  }
  // Without an alignment by positions a turn may be one between the two worlds.
  const bool by_positions = RotationSigmaDeg(alignment).has_value();
  const Turn in_body = TurnOf(Turns(aligned, false));
  const double constant_deg = kDegrees * in_body.mean_rad.norm();
  if (by_positions && constant_deg > kConstantRatio * in_body.rest_deg &&
      constant_deg > kOpenSigmas * sigma_deg && constant_deg > kFrame_deg) {
    doubt.warnings.push_back(FormatText(
        "ATE [deg] is the same turn of %.3g deg at every pose, to within %.2g deg: the ground "
        "truth may be that of another frame on the body (--T_body_truth)%s%s",
        constant_deg, in_body.rest_deg,
        scalar ? FormatText(", or have quaternions with w %s", scalar->other).c_str() : "",
        constant_deg > kMirrored_deg
            ? ", or left-handed axes: a flat path in a mirror is the path turned over"
            : ""));
  } else if (by_positions && in_world.rms_deg > kMirrored_deg) {
    doubt.warnings.push_back(FormatText(
        "positions fit where the attitudes differ by nearly half a turn (%.3g deg): the ground "
        "truth may have left-handed axes, since a flat path in a mirror is the path turned over",
        in_world.rms_deg));
  }
  return doubt;
}

}  // namespace trajlo
