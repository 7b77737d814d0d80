// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace trajlo {

/// An IPv4 address (the first four bytes) or an IPv6 address.
struct IpAddress {
  std::array<std::uint8_t, 16> bytes{};
  bool v6 = false;

  /// "192.168.1.201"
  std::string ToString() const;
  bool operator<(const IpAddress& other) const { return bytes < other.bytes; }
  bool operator==(const IpAddress& other) const { return bytes == other.bytes; }
};

/// The payload of one UDP packet. The bytes live until the next one is read.
struct Datagram {
  /// When it was captured, ns since 1970; none if the file does not tell.
  std::optional<std::int64_t> captured_ns;
  IpAddress source;
  /// To which it was sent.
  std::uint16_t port = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

}  // namespace trajlo
