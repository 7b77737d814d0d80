// SPDX-License-Identifier: MIT
#include "core/io/packets/ouster_packet.h"

#include "core/io/packets/byte_order.h"

namespace trajlo {
namespace {

constexpr std::uint32_t k15Bits = 0x7fff;
constexpr std::uint32_t k19Bits = 0x7ffff;
constexpr std::uint32_t k20Bits = 0xfffff;
constexpr std::size_t kNewPacketHeader = 32;
constexpr std::size_t kNewPacketFooter = 32;
constexpr std::uint8_t kLidarPacketType = 1;

struct Profile {
  const char* name;
  std::size_t pixel_size;
  std::size_t return_count;
  std::array<OusterReturn, 2> returns;
};

constexpr Profile kProfiles[] = {
    {"LEGACY", 12, 1, {{{0, k20Bits, 1, 4, 0xffff}, {}}}},
    {"RNG19_RFL8_SIG16_NIR16", 12, 1, {{{0, k19Bits, 1, 4, 0xff}, {}}}},
    {"RNG19_RFL8_SIG16_NIR16_DUAL", 16, 2, {{{0, k19Bits, 1, 3, 0xff}, {4, k19Bits, 1, 7, 0xff}}}},
    {"RNG15_RFL8_NIR8", 4, 1, {{{0, k15Bits, 8, 2, 0xff}, {}}}},
    {"RNG15_RFL8_NIR8_DUAL", 8, 2, {{{0, k15Bits, 8, 2, 0xff}, {4, k15Bits, 8, 6, 0xff}}}},
    {"FUSA_RNG15_RFL8_NIR8_DUAL", 8, 2, {{{0, k15Bits, 8, 2, 0xff}, {4, k15Bits, 8, 6, 0xff}}}},
};

}  // namespace

std::uint64_t OusterLayout::TimeNs(const std::uint8_t* column) const { return Little64(column); }

std::uint16_t OusterLayout::MeasurementId(const std::uint8_t* column) const {
  return Little16(column + 8);
}

bool OusterLayout::IsValid(const std::uint8_t* column) const {
  if (legacy) return Little32(column + column_size - 4) == 0xffffffff;
  return (column[10] & 1U) != 0;
}

std::uint32_t OusterLayout::FrameId(const std::uint8_t* packet) const {
  if (fusa) return Little32(packet + 4);
  return Little16(packet + (legacy ? 10 : 2));
}

std::uint64_t OusterLayout::Serial(const std::uint8_t* packet) const {
  return legacy ? 0 : Little64(packet + (fusa ? 11 : 7)) & 0xffffffffff;
}

bool OusterLayout::IsLidarPacket(const std::uint8_t* packet, std::size_t size) const {
  return size == packet_size && (legacy || packet[0] == kLidarPacketType);
}

std::optional<OusterLayout> LayoutOf(const OusterMetadata& metadata) {
  for (const Profile& profile : kProfiles) {
    if (metadata.profile != profile.name) continue;
    OusterLayout layout;
    layout.legacy = metadata.profile == "LEGACY";
    layout.fusa = metadata.fusa_header;
    layout.rows = metadata.rows();
    layout.columns = metadata.columns_per_packet;
    layout.pixel_size = profile.pixel_size;
    layout.returns = profile.returns;
    layout.return_count = profile.return_count;
    layout.packet_header = layout.legacy ? 0 : kNewPacketHeader;
    layout.column_header = layout.legacy ? 16 : 12;
    const std::size_t column_footer = layout.legacy ? 4 : 0;
    const std::size_t packet_footer = layout.legacy ? 0 : kNewPacketFooter;
    layout.column_size = layout.column_header + layout.rows * layout.pixel_size + column_footer;
    layout.packet_size = layout.packet_header + layout.columns * layout.column_size + packet_footer;
    return layout;
  }
  return {};
}

std::string KnownOusterProfiles() {
  std::string names;
  for (const Profile& profile : kProfiles) {
    names += (names.empty() ? "" : ", ") + std::string(profile.name);
  }
  return names;
}

bool LooksLikeOuster(const Datagram& packet) {
  constexpr std::size_t kColumns = 16;
  for (const std::size_t rows : {16U, 32U, 64U, 128U}) {
    if (packet.size == kColumns * (20 + 12 * rows)) return true;
    for (const std::size_t pixel : {4U, 8U, 12U, 16U}) {
      const std::size_t size = kNewPacketHeader + kColumns * (12 + pixel * rows) + kNewPacketFooter;
      if (packet.size == size && packet.data[0] == kLidarPacketType) return true;
    }
  }
  return false;
}

}  // namespace trajlo
