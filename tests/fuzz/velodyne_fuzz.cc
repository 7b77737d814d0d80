// SPDX-License-Identifier: MIT
// Packets of a Velodyne: the first byte tells model and returns, the rest is cut into packets.
#include "core/io/packets/velodyne_stream.h"
#include "tests/fuzz/clouds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  if (size == 0) return 0;
  VelodyneStreamOptions options;
  options.model = kVelodyneModels[(data[0] & 0x7fU) % std::size(kVelodyneModels)].second;
  options.second_returns = data[0] < 0x80U;
  VelodyneStream stream(options, HourClock(std::nullopt));
  std::vector<CloudMessage> sweeps;
  for (std::size_t at = 1; at + kVelodynePacketSize <= size; at += kVelodynePacketSize) {
    Datagram packet;
    packet.captured_ns = 1'600'000'000'000'000'000 + static_cast<std::int64_t>(at);
    packet.data = data + at;
    packet.size = kVelodynePacketSize;
    stream.Add(packet, &sweeps);
  }
  stream.Finish(&sweeps);
  for (const CloudMessage& sweep : sweeps) fuzz::RequireSound(sweep.table, sweep.stamp_ns);
  return 0;
}
