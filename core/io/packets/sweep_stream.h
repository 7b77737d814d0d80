// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/packets/datagram.h"

namespace trajlo {

/// What one stream of packets brought so far.
struct StreamCounts {
  std::uint64_t packets = 0;
  std::uint64_t sweeps = 0;
  /// Packets that are no sensor's: they contradict themselves.
  std::uint64_t broken = 0;
  /// Columns of Ouster packets whose number or time is impossible.
  std::uint64_t broken_columns = 0;
  std::uint64_t duplicates = 0;
  /// They came after their sweep had ended.
  std::uint64_t late = 0;
  /// Gaps between packets (Velodyne) or columns that never came (Ouster).
  std::uint64_t missing = 0;
};

/// Cuts the packets of one sensor into sweeps.
class SweepStream {
 public:
  virtual ~SweepStream() = default;

  /// Appends to `sweeps` those that this packet completes. The packet has the stream's size.
  virtual void Add(const Datagram& packet, std::vector<CloudMessage>* sweeps) = 0;
  /// The end of the recording completes the last sweep.
  virtual void Finish(std::vector<CloudMessage>* sweeps) = 0;
  virtual const StreamCounts& counts() const = 0;
};

}  // namespace trajlo
