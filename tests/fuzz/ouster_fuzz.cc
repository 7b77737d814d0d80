// SPDX-License-Identifier: MIT
// Packets of an Ouster: the first byte tells the kind, the rest is cut into packets of its size.
#include <array>

#include "core/io/packets/ouster_stream.h"
#include "tests/fuzz/clouds.h"
#include "tests/fuzz/ouster_kinds.h"

namespace {

constexpr std::size_t kKinds = std::size(trajlo::fuzz::kOusterKinds);

const trajlo::OusterMetadata& MetadataOf(std::size_t kind) {
  static const std::array<trajlo::OusterMetadata, kKinds> all = [] {
    std::array<trajlo::OusterMetadata, kKinds> read;
    for (std::size_t i = 0; i < kKinds; ++i) {
      read[i] = trajlo::ReadOusterMetadata(trajlo::fuzz::Metadata(trajlo::fuzz::kOusterKinds[i]));
    }
    return read;
  }();
  return all[kind];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  if (size == 0) return 0;
  const OusterMetadata& metadata = MetadataOf(data[0] % kKinds);
  const OusterLayout layout = *LayoutOf(metadata);
  OusterStream stream(metadata, layout, {});
  std::vector<CloudMessage> sweeps;
  for (std::size_t at = 1; at + layout.packet_size <= size; at += layout.packet_size) {
    Datagram packet;
    packet.captured_ns = 1'600'000'000'000'000'000 + static_cast<std::int64_t>(at);
    packet.data = data + at;
    packet.size = layout.packet_size;
    // The reader hands on nothing else.
    if (layout.IsLidarPacket(packet.data, packet.size)) stream.Add(packet, &sweeps);
  }
  stream.Finish(&sweeps);
  for (const CloudMessage& sweep : sweeps) fuzz::RequireSound(sweep.table, sweep.stamp_ns);
  return 0;
}
