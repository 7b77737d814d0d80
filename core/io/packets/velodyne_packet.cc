// SPDX-License-Identifier: MIT
#include "core/io/packets/velodyne_packet.h"

#include "core/io/packets/byte_order.h"

namespace trajlo {
namespace {

constexpr std::uint16_t kFirstBank = 0xffee;
constexpr std::uint8_t kDualReturn = 0x39;
constexpr std::int32_t kTurn = 36000;
/// Between two firings the fastest sensor turns by 0.8 degrees, and the encoder jitters by 0.02.
constexpr std::int32_t kLargestAdvance = 500;
constexpr std::int32_t kLargestRetreat = -50;
constexpr std::uint32_t kHourUs = 3'600'000'000U;

/// The way from one azimuth to another, between -180 and 180 degrees.
std::int32_t Advance(std::int32_t from, std::int32_t to) {
  const std::int32_t forward = (to - from + kTurn) % kTurn;
  return forward > kTurn / 2 ? forward - kTurn : forward;
}

}  // namespace

bool IsVelodynePacket(const std::uint8_t* data, std::size_t size) {
  return size == kVelodynePacketSize && Big16(data) == kFirstBank;
}

VelodyneKind KindOf(const std::uint8_t* packet) {
  VelodyneKind kind;
  kind.return_mode = packet[1204];
  kind.product_id = packet[1205];
  kind.one_bank = true;
  for (std::size_t block = 0; block < kVelodyneBlocks; ++block) {
    kind.one_bank = kind.one_bank && Big16(packet + 100 * block) == kFirstBank;
  }
  return kind;
}

const char* WhyUnsupported(const VelodyneKind& kind) {
  if (kind.product_id == 0xa1 || kind.product_id == 0x63) {
    return "packets of a VLS-128 (Alpha Prime), which is not supported";
  }
  if (!kind.one_bank) {
    return "packets of an HDL-64E: every unit needs its own calibration, which is not in the "
           "packets' points; convert the capture with a tool that knows it, to PCD for instance";
  }
  return "Velodyne packets that do not say of which model they are (old firmware, or a model that "
         "is not supported); name it with input.velodyne_model: VLP-16, Puck-Hi-Res, HDL-32E or "
         "VLP-32C (--set=input.velodyne_model=VLP-16)";
}

bool ParseVelodynePacket(const std::uint8_t* data, VelodyneModel model, VelodynePacket* packet) {
  const VelodyneKind kind = KindOf(data);
  if (!kind.one_bank) return false;
  // Old firmware wrote other things here; only a clear contradiction counts.
  const std::optional<VelodyneModel> named = VelodyneModelOf(kind.product_id);
  if (named && *named != model) return false;
  packet->dual = kind.return_mode == kDualReturn;
  const std::size_t step = packet->dual ? 2 : 1;
  packet->firing_blocks = kVelodyneBlocks / step;
  std::int32_t total = 0;
  for (std::size_t i = 0; i < packet->firing_blocks; ++i) {
    const std::uint8_t* block = data + 100 * step * i;
    const std::int32_t azimuth = Little16(block + 2);
    if (azimuth >= kTurn) return false;
    if (packet->dual && Little16(block + 102) != azimuth) return false;
    packet->azimuth_cdeg[i] = azimuth;
    if (i == 0) continue;
    const std::int32_t advance = Advance(packet->azimuth_cdeg[i - 1], azimuth);
    if (advance < kLargestRetreat || advance > kLargestAdvance) return false;
    total += advance;
  }
  packet->advance_cdeg = total / static_cast<double>(packet->firing_blocks - 1);
  packet->time_us = Little32(data + 1200);
  return packet->time_us < kHourUs;
}

}  // namespace trajlo
