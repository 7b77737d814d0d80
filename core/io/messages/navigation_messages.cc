// SPDX-License-Identifier: MIT
#include "core/io/messages/navigation_messages.h"

#include "core/io/messages/message_writer.h"

namespace trajlo {
namespace {

void PutMatrix(const Matrix6d& matrix, WireWriter* out) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) out->Put(matrix(i, j));
  }
}

/// t_true = t + R rho and R_true = R Exp(theta) = Exp(R theta) R, to first order.
Matrix6d AboutFixedAxes(const SE3& T_world_body, const Matrix6d& covariance) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = T_world_body.q.toRotationMatrix();
  turn.bottomRightCorner<3, 3>() = turn.topLeftCorner<3, 3>();
  return turn * covariance * turn.transpose();
}

}  // namespace

std::string WriteTransforms(const std::vector<StampedTransform>& transforms, Encoding encoding) {
  WireWriter out(encoding);
  out.Put(static_cast<std::uint32_t>(transforms.size()));
  for (const StampedTransform& transform : transforms) {
    PutHeader({0, transform.t_ns, transform.parent}, &out);
    out.PutString(transform.child);
    PutPose(transform.T_parent_child, &out);
  }
  return out.Take();
}

std::string WritePath(const MessageHeader& header, const std::vector<StampedPose>& poses,
                      Encoding encoding) {
  WireWriter out(encoding);
  PutHeader(header, &out);
  out.Put(static_cast<std::uint32_t>(poses.size()));
  for (const StampedPose& pose : poses) {
    PutHeader({0, pose.t_ns, header.frame_id}, &out);
    PutPose(pose.T_world_body, &out);
  }
  return out.Take();
}

std::string WriteOdometry(const MessageHeader& header, const std::string& body_frame,
                          const OdometryState& state, Encoding encoding) {
  const Matrix6d covariance =
      state.covariance ? AboutFixedAxes(state.T_world_body, *state.covariance) : Matrix6d::Zero();
  WireWriter out(encoding);
  PutHeader(header, &out);
  out.PutString(body_frame);
  PutPose(state.T_world_body, &out);
  PutMatrix(covariance, &out);
  for (int i = 0; i < 6; ++i) out.Put(state.velocity[i]);
  PutMatrix(Matrix6d::Zero(), &out);
  return out.Take();
}

}  // namespace trajlo
