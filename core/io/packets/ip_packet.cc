// SPDX-License-Identifier: MIT
#include "core/io/packets/ip_packet.h"

#include <arpa/inet.h>
#include <pcap/dlt.h>

#include <algorithm>

#include "core/io/packets/byte_order.h"

namespace trajlo {
namespace {

constexpr std::uint16_t kEtherIpv4 = 0x0800;
constexpr std::uint16_t kEtherIpv6 = 0x86dd;
constexpr std::uint8_t kUdp = 17;
constexpr std::uint8_t kIpv6Fragment = 44;

/// The bytes that are not yet understood.
struct Rest {
  const std::uint8_t* data;
  std::size_t size;

  bool Skip(std::size_t count) {
    if (size < count) return false;
    data += count;
    size -= count;
    return true;
  }
};

bool IsVlan(std::uint16_t ether_type) {
  return ether_type == 0x8100 || ether_type == 0x88a8 || ether_type == 0x9100;
}

/// Behind a link layer whose protocol field stands at `type_at`; skips VLAN tags.
bool SkipEtherTypes(std::size_t type_at, std::size_t header, Rest* rest) {
  if (rest->size < header) return false;
  std::uint16_t type = Big16(rest->data + type_at);
  rest->Skip(header);
  while (IsVlan(type)) {
    if (rest->size < 4) return false;
    type = Big16(rest->data + 2);
    rest->Skip(4);
  }
  return type == kEtherIpv4 || type == kEtherIpv6;
}

bool SkipLinkLayer(int link_type, Rest* rest) {
  switch (link_type) {
    case DLT_EN10MB:
      return SkipEtherTypes(12, 14, rest);
    case DLT_LINUX_SLL:
      return SkipEtherTypes(14, 16, rest);
    case DLT_LINUX_SLL2:
      return SkipEtherTypes(0, 20, rest);
    case DLT_NULL:
    case DLT_LOOP:
      return rest->Skip(4);
    default:
      return true;
  }
}

FrameContent ParseIpv4(Rest rest, IpPacket* packet) {
  if (rest.size < 20) return FrameContent::kOther;
  const std::uint8_t* ip = rest.data;
  const std::size_t header = 4U * (ip[0] & 15U);
  const std::size_t total = Big16(ip + 2);
  if (header < 20 || total < header || ip[9] != kUdp) return FrameContent::kOther;
  if (rest.size < total) return FrameContent::kTruncated;
  std::copy_n(ip + 12, 4, packet->source.bytes.begin());
  std::copy_n(ip + 16, 4, packet->destination.bytes.begin());
  const std::uint16_t fragment = Big16(ip + 6);
  packet->fragment_id = Big16(ip + 4);
  packet->fragment_offset = 8U * (fragment & 0x1fffU);
  packet->more_fragments = (fragment & 0x2000U) != 0;
  // Short frames are padded; the length of the IP packet is the true one.
  packet->data = ip + header;
  packet->size = total - header;
  const bool whole = packet->fragment_offset == 0 && !packet->more_fragments;
  return whole ? FrameContent::kUdp : FrameContent::kFragment;
}

FrameContent ParseIpv6(Rest rest, IpPacket* packet) {
  if (rest.size < 40) return FrameContent::kOther;
  const std::uint8_t* ip = rest.data;
  std::uint8_t next = ip[6];
  if (next != kUdp && next != kIpv6Fragment) return FrameContent::kOther;
  const std::size_t length = Big16(ip + 4);
  packet->source.v6 = packet->destination.v6 = true;
  std::copy_n(ip + 8, 16, packet->source.bytes.begin());
  std::copy_n(ip + 24, 16, packet->destination.bytes.begin());
  rest.Skip(40);
  if (rest.size < length) return FrameContent::kTruncated;
  rest.size = length;
  if (next == kIpv6Fragment) {
    if (rest.size < 8) return FrameContent::kOther;
    next = rest.data[0];
    const std::uint16_t fragment = Big16(rest.data + 2);
    packet->fragment_offset = fragment & 0xfff8U;
    packet->more_fragments = (fragment & 1U) != 0;
    packet->fragment_id = Big32(rest.data + 4);
    rest.Skip(8);
    if (next != kUdp) return FrameContent::kOther;
  }
  packet->data = rest.data;
  packet->size = rest.size;
  const bool whole = packet->fragment_offset == 0 && !packet->more_fragments;
  return whole ? FrameContent::kUdp : FrameContent::kFragment;
}

}  // namespace

std::string IpAddress::ToString() const {
  char text[INET6_ADDRSTRLEN] = "";
  inet_ntop(v6 ? AF_INET6 : AF_INET, bytes.data(), text, sizeof text);
  return text;
}

bool IsKnownLinkType(int link_type) {
  constexpr int kKnown[] = {DLT_EN10MB, DLT_LINUX_SLL, DLT_LINUX_SLL2, DLT_RAW,
                            DLT_IPV4,   DLT_IPV6,      DLT_NULL,       DLT_LOOP};
  return std::find(std::begin(kKnown), std::end(kKnown), link_type) != std::end(kKnown);
}

FrameContent ParseFrame(int link_type, const std::uint8_t* frame, std::size_t size,
                        IpPacket* packet) {
  *packet = {};
  Rest rest{frame, size};
  if (!SkipLinkLayer(link_type, &rest) || rest.size == 0) return FrameContent::kOther;
  const int version = rest.data[0] >> 4;
  if (version == 4) return ParseIpv4(rest, packet);
  return version == 6 ? ParseIpv6(rest, packet) : FrameContent::kOther;
}

bool ParseUdp(const std::uint8_t* data, std::size_t size, Datagram* datagram) {
  if (size < 8) return false;
  const std::size_t length = Big16(data + 4);
  if (length < 8 || length > size) return false;
  datagram->port = Big16(data + 2);
  datagram->data = data + 8;
  datagram->size = length - 8;
  return true;
}

}  // namespace trajlo
