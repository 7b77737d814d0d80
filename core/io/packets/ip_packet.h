// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/io/packets/datagram.h"

namespace trajlo {

/// What a captured frame carries.
enum class FrameContent {
  kUdp,
  /// One piece of a UDP packet that was too long for the network.
  kFragment,
  /// ARP, TCP, an unknown protocol, or nonsense.
  kOther,
  /// IP with UDP, but fewer bytes were captured than the header announces.
  kTruncated
};

/// The IP layer of a frame; `data` is what follows the IP headers.
struct IpPacket {
  IpAddress source;
  IpAddress destination;
  std::uint32_t fragment_id = 0;
  std::size_t fragment_offset = 0;
  bool more_fragments = false;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// True if frames of this link type (a DLT_ number of libpcap) can be read: Ethernet with or
/// without VLAN tags, Linux cooked (SLL, SLL2), raw IP, BSD loopback.
bool IsKnownLinkType(int link_type);

/// Finds the IPv4 or IPv6 packet in a frame of which `size` bytes were captured.
FrameContent ParseFrame(int link_type, const std::uint8_t* frame, std::size_t size,
                        IpPacket* packet);

/// Splits a whole UDP packet (8 bytes of header and the payload) into `datagram`; false if it is
/// shorter than its header says.
bool ParseUdp(const std::uint8_t* data, std::size_t size, Datagram* datagram);

}  // namespace trajlo
