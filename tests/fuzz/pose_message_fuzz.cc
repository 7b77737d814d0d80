// SPDX-License-Identifier: MIT
// Serialised poses: the first byte tells message and encoding.
#include <cmath>

#include "core/io/messages/pose_decoder.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  if (size == 0) return 0;
  constexpr const char* kTypes[] = {
      "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped",
      "geometry_msgs/TransformStamped", "geometry_msgs/PointStamped", "nav_msgs/Odometry"};
  const char* type = kTypes[(data[0] >> 1U) % std::size(kTypes)];
  fuzz::Require(IsPoseType(type), "the type is known");
  const Encoding encoding = (data[0] & 1U) == 0 ? Encoding::kRos1 : Encoding::kCdr;
  if (const auto pose = DecodePose(type, encoding, fuzz::AsText(data + 1, size - 1))) {
    fuzz::Require(pose->T_world_body.IsFinite(), "a pose is finite");
    fuzz::Require(std::abs(pose->T_world_body.q.norm() - 1.0) < 1e-9, "a rotation is one");
  }
  return 0;
}
