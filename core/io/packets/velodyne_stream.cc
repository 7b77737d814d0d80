// SPDX-License-Identifier: MIT
#include "core/io/packets/velodyne_stream.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/io/packets/byte_order.h"

namespace trajlo {
namespace {

constexpr double kCdeg = 0.00017453292519943295;
/// Networks reorder packets within a few of them; a time that goes back farther is a new start.
constexpr std::int64_t kReorderingNs = 25'000'000;
/// A longer silence was not made by lost packets.
constexpr std::int64_t kLongestLossNs = 10'000'000'000;

}  // namespace

VelodyneStream::VelodyneStream(const VelodyneStreamOptions& options, const HourClock& clock)
    : options_(options),
      geometry_(GeometryOf(options.model)),
      clock_(clock),
      cutter_(options.cut_deg) {}

void VelodyneStream::Add(const Datagram& packet, std::vector<CloudMessage>* sweeps) {
  ++counts_.packets;
  VelodynePacket head;
  if (!ParseVelodynePacket(packet.data, options_.model, &head)) {
    ++counts_.broken;
    return;
  }
  const std::int64_t packet_ns = clock_.AbsoluteNs(head.time_us, packet.captured_ns);
  if (!IsInOrder(packet_ns, head)) return;
  if (options_.decode) TurnLasers(head);
  for (std::size_t block = 0; block < head.firing_blocks; ++block) {
    const std::int64_t block_ns = packet_ns + static_cast<std::int64_t>(block) * geometry_.block_ns;
    for (std::size_t slot = 0; slot < VelodyneGeometry::kSlots; slot += geometry_.lasers) {
      const std::int64_t after_block_ns = geometry_.after_block_ns[slot];
      const double azimuth_cdeg =
          head.azimuth_cdeg[block] + head.advance_cdeg * static_cast<double>(after_block_ns) /
                                         static_cast<double>(geometry_.block_ns);
      if (cutter_.StartsSweep(azimuth_cdeg, block_ns + after_block_ns)) {
        Close(sweeps);
        points_.Begin(block_ns + after_block_ns);
        ++counts_.sweeps;
      }
      if (options_.decode) DecodeFiring(packet.data, head, block, slot, block_ns);
      points_.SetCaptured(packet.captured_ns.value_or(packet_ns));
    }
  }
}

void VelodyneStream::Finish(std::vector<CloudMessage>* sweeps) { Close(sweeps); }

void VelodyneStream::Close(std::vector<CloudMessage>* sweeps) {
  if (!points_.IsOpen()) return;
  CloudMessage sweep = points_.Finish(options_.topic, "velodyne");
  if (options_.decode) sweeps->push_back(std::move(sweep));
}

bool VelodyneStream::IsInOrder(std::int64_t packet_ns, const VelodynePacket& head) {
  if (last_packet_ns_) {
    const std::int64_t since_ns = packet_ns - *last_packet_ns_;
    if (since_ns == 0) {
      ++counts_.duplicates;
      return false;
    }
    if (since_ns < 0 && since_ns > -kReorderingNs) {
      ++counts_.late;
      return false;
    }
    const std::int64_t packet_length_ns =
        static_cast<std::int64_t>(head.firing_blocks) * geometry_.block_ns;
    if (since_ns > 0 && since_ns < kLongestLossNs) {
      counts_.missing += static_cast<std::uint64_t>(
          std::max<std::int64_t>((since_ns + packet_length_ns / 2) / packet_length_ns - 1, 0));
    }
  }
  last_packet_ns_ = packet_ns;
  return true;
}

void VelodyneStream::TurnLasers(const VelodynePacket& head) {
  const double rad_per_ns = head.advance_cdeg * kCdeg / geometry_.block_ns;
  for (std::size_t slot = 0; slot < VelodyneGeometry::kSlots; ++slot) {
    const double turn_rad =
        geometry_.azimuth_offset_rad[slot] + rad_per_ns * geometry_.after_block_ns[slot];
    turns_[slot] = {static_cast<float>(std::cos(turn_rad)), static_cast<float>(std::sin(turn_rad))};
  }
}

void VelodyneStream::DecodeFiring(const std::uint8_t* data, const VelodynePacket& head,
                                  std::size_t block, std::size_t first_slot,
                                  std::int64_t block_ns) {
  const double azimuth_rad = head.azimuth_cdeg[block] * kCdeg;
  const auto cos_block = static_cast<float>(std::cos(azimuth_rad));
  const auto sin_block = static_cast<float>(std::sin(azimuth_rad));
  const auto after_reference_ns = static_cast<std::int32_t>(block_ns - points_.reference_ns());
  const std::size_t returns = head.dual ? 2 : 1;
  const std::uint8_t* first = VelodyneBlock(data, returns * block);
  SweepPoint* const tail = points_.Tail(returns * geometry_.lasers);
  std::size_t count = 0;
  const auto add = [&](const std::uint8_t* measured, std::size_t slot) {
    const float range_m = static_cast<float>(Little16(measured)) * geometry_.distance_unit_m;
    const float flat_m = range_m * geometry_.cos_elevation[slot];
    SweepPoint& point = tail[count++];
    point.x = flat_m * (cos_block * turns_[slot].cos - sin_block * turns_[slot].sin);
    point.y = -flat_m * (sin_block * turns_[slot].cos + cos_block * turns_[slot].sin);
    point.z = range_m * geometry_.sin_elevation[slot] + geometry_.up_m[slot];
    point.intensity = static_cast<float>(measured[2]);
    point.t = static_cast<std::uint32_t>(after_reference_ns + geometry_.after_block_ns[slot]);
    point.ring = geometry_.ring[slot];
  };
  for (std::size_t slot = first_slot; slot < first_slot + geometry_.lasers; ++slot) {
    // Of a dual return, the even block holds the last one and the odd block the strongest, or the
    // same again if there was one only.
    const std::uint8_t* last = first + 3 * slot;
    if (!head.dual) {
      if (Little16(last) != 0) add(last, slot);
      continue;
    }
    const std::uint8_t* strongest = last + 100;
    if (Little16(strongest) != 0) add(strongest, slot);
    const bool differs = Little16(last) != Little16(strongest);
    if (Little16(last) != 0 && differs && (options_.second_returns || Little16(strongest) == 0)) {
      add(last, slot);
    }
  }
  points_.Grow(count);
}

}  // namespace trajlo
