// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/io/packets/datagram.h"
#include "core/io/packets/ouster_metadata.h"

namespace trajlo {

/// Where range and reflectivity of a return stand in a pixel.
struct OusterReturn {
  std::size_t range_at = 0;
  std::uint32_t range_mask = 0;
  /// mm of one unit of range.
  std::uint32_t range_unit_mm = 1;
  std::size_t reflectivity_at = 0;
  std::uint32_t reflectivity_mask = 0xff;
};

/// How the bytes of a lidar packet are laid out. Source: Ouster's firmware user manual, chapter
/// "Lidar data packet format".
struct OusterLayout {
  bool legacy = false;
  bool fusa = false;
  std::size_t packet_header = 0;
  std::size_t column_header = 0;
  std::size_t pixel_size = 0;
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t column_size = 0;
  std::size_t packet_size = 0;
  std::array<OusterReturn, 2> returns{};
  std::size_t return_count = 1;

  const std::uint8_t* Column(const std::uint8_t* packet, std::size_t column) const {
    return packet + packet_header + column * column_size;
  }
  std::uint64_t TimeNs(const std::uint8_t* column) const;
  /// The column's number in the frame.
  std::uint16_t MeasurementId(const std::uint8_t* column) const;
  bool IsValid(const std::uint8_t* column) const;

  std::uint32_t FrameId(const std::uint8_t* packet) const;
  /// The sensor's serial number; 0 in the legacy profile, which has none.
  std::uint64_t Serial(const std::uint8_t* packet) const;
  bool IsLidarPacket(const std::uint8_t* packet, std::size_t size) const;
};

/// None if the profile is not known.
std::optional<OusterLayout> LayoutOf(const OusterMetadata& metadata);
/// "LEGACY, RNG15_RFL8_NIR8, ..."
std::string KnownOusterProfiles();

/// True for what is probably a lidar packet, though the metadata are not there that would tell.
bool LooksLikeOuster(const Datagram& packet);

}  // namespace trajlo
