// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <vector>

#include "core/io/packets/ip_packet.h"

namespace trajlo {

/// Puts UDP packets together that the network had cut into IP fragments, as it does with those of
/// Ouster sensors, which are longer than an Ethernet frame.
class FragmentBuffer {
 public:
  /// Adds a piece; the whole UDP packet if it was the last one missing, else null. What it points
  /// to lives until the next call.
  const std::vector<std::uint8_t>* Add(const IpPacket& piece, std::int64_t captured_ns);

  /// Packets of which pieces came, but never all; those under way count, too.
  std::uint64_t incomplete() const { return given_up_ + pending_.size(); }

 private:
  struct Pending {
    IpAddress source;
    IpAddress destination;
    std::uint32_t id = 0;
    std::int64_t started_ns = 0;
    std::vector<std::uint8_t> bytes;
    /// Size of each piece by where it begins.
    std::map<std::size_t, std::size_t> pieces;
    /// 0 until the last piece came.
    std::size_t total = 0;

    bool IsComplete() const;
  };

  std::list<Pending> pending_;
  std::vector<std::uint8_t> whole_;
  std::uint64_t given_up_ = 0;
};

}  // namespace trajlo
