// SPDX-License-Identifier: MIT
#include "core/io/packets/sweep_points.h"

#include <algorithm>
#include <cstring>

namespace trajlo {

void SweepPoints::Begin(std::int64_t reference_ns) {
  open_ = true;
  reference_ns_ = reference_ns;
  count_ = 0;
}

SweepPoint* SweepPoints::Tail(std::size_t most) {
  if (points_.size() < count_ + most) points_.resize(2 * points_.size() + most);
  return points_.data() + count_;
}

CloudMessage SweepPoints::Finish(std::size_t topic, const char* frame_id) {
  std::int32_t first_ns = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto t_ns = static_cast<std::int32_t>(points_[i].t);
    first_ns = i == 0 ? t_ns : std::min(first_ns, t_ns);
  }
  for (std::size_t i = 0; i < count_; ++i) points_[i].t -= static_cast<std::uint32_t>(first_ns);

  CloudMessage message;
  message.topic = topic;
  message.stamp_ns = reference_ns_ + first_ns;
  message.recorded_ns = captured_ns_;
  message.frame_id = frame_id;
  PointTable& table = message.table;
  constexpr std::size_t kStride = sizeof(SweepPoint);
  table.bytes = FileBytes(count_ * kStride);
  if (count_ > 0) std::memcpy(table.bytes.data(), points_.data(), count_ * kStride);
  table.count = count_;
  table.columns = {
      {"x", ScalarType::kFloat32, offsetof(SweepPoint, x), kStride, false},
      {"y", ScalarType::kFloat32, offsetof(SweepPoint, y), kStride, false},
      {"z", ScalarType::kFloat32, offsetof(SweepPoint, z), kStride, false},
      {"intensity", ScalarType::kFloat32, offsetof(SweepPoint, intensity), kStride, false},
      {"ring", ScalarType::kUint16, offsetof(SweepPoint, ring), kStride, false},
      {"t", ScalarType::kUint32, offsetof(SweepPoint, t), kStride, false}};
  open_ = false;
  count_ = 0;
  return message;
}

}  // namespace trajlo
