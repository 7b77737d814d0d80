// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace trajlo {

/// Numbers as they lie in packets: networks send the high byte first, the sensors the low one.
inline std::uint16_t Big16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[0] << 8 | at[1]);
}
inline std::uint32_t Big32(const std::uint8_t* at) {
  return static_cast<std::uint32_t>(Big16(at)) << 16 | Big16(at + 2);
}
inline std::uint16_t Little16(const std::uint8_t* at) {
  return static_cast<std::uint16_t>(at[1] << 8 | at[0]);
}
inline std::uint32_t Little32(const std::uint8_t* at) {
  return static_cast<std::uint32_t>(Little16(at + 2)) << 16 | Little16(at);
}
inline std::uint64_t Little64(const std::uint8_t* at) {
  return static_cast<std::uint64_t>(Little32(at + 4)) << 32 | Little32(at);
}

}  // namespace trajlo
