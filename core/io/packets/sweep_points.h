// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/io/messages/cloud_message.h"

namespace trajlo {

/// A row of the tables that this reader makes.
struct SweepPoint {
  /// m, in the sensor's frame: x forward, y left, z up.
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  /// The sensor's calibrated reflectivity.
  float intensity = 0.0F;
  /// ns since the sweep's stamp; while the sweep grows, since its first packet, modulo 2^32.
  std::uint32_t t = 0;
  std::uint16_t ring = 0;
  std::uint16_t unused = 0;
};

/// The points of a sweep while it grows.
class SweepPoints {
 public:
  /// A new sweep; times are given relative to this one, and must lie within a second of it.
  void Begin(std::int64_t reference_ns);
  bool IsOpen() const { return open_; }
  std::int64_t reference_ns() const { return reference_ns_; }

  /// Space for that many further points behind the last; `Grow` says how many were written.
  SweepPoint* Tail(std::size_t most);
  void Grow(std::size_t count) { count_ += count; }
  void SetCaptured(std::int64_t captured_ns) { captured_ns_ = captured_ns; }

  /// Closes the sweep. Its stamp is the time of its first point, or the reference if it has none.
  CloudMessage Finish(std::size_t topic, const char* frame_id);

 private:
  bool open_ = false;
  std::int64_t reference_ns_ = 0;
  std::int64_t captured_ns_ = 0;
  std::vector<SweepPoint> points_;
  std::size_t count_ = 0;
};

}  // namespace trajlo
