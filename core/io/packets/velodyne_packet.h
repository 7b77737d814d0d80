// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/io/packets/velodyne_model.h"

namespace trajlo {

constexpr std::size_t kVelodynePacketSize = 1206;
constexpr std::size_t kVelodyneBlocks = 12;

/// True for 1206 bytes that begin as a data packet.
bool IsVelodynePacket(const std::uint8_t* data, std::size_t size);

/// What the blocks and the factory bytes of a data packet say of its kind.
struct VelodyneKind {
  std::uint8_t product_id = 0;
  std::uint8_t return_mode = 0;
  /// All blocks are those of 16 or 32 lasers. HDL-64E and VLS-128 have other blocks between them.
  bool one_bank = false;
};
VelodyneKind KindOf(const std::uint8_t* packet);

/// "HDL-64E needs its own calibration ...": why packets of this kind are not understood.
const char* WhyUnsupported(const VelodyneKind& kind);

/// The head of a data packet: where it looked when. Azimuths grow clockwise seen from above, in
/// 0.01 degrees.
struct VelodynePacket {
  /// Two blocks describe one firing: the last return and the strongest one.
  bool dual = false;
  std::size_t firing_blocks = kVelodyneBlocks;
  std::array<std::int32_t, kVelodyneBlocks> azimuth_cdeg{};
  /// Mean over the packet, from one firing block to the next.
  double advance_cdeg = 0.0;
  /// Microseconds past the hour.
  std::uint32_t time_us = 0;
};

/// Reads the head; false if it contradicts itself, as no sensor's packet does.
bool ParseVelodynePacket(const std::uint8_t* data, VelodyneModel model, VelodynePacket* packet);

/// One of the 32 measurements of a block: two bytes of distance, one of reflectivity.
inline const std::uint8_t* VelodyneBlock(const std::uint8_t* packet, std::size_t block) {
  return packet + 100 * block + 4;
}

}  // namespace trajlo
