// SPDX-License-Identifier: MIT
// Captures of packets, and bare payloads: with the metadata of every kind of Ouster.
#include "core/io/packets/packet_cloud_reader.h"
#include "tests/fuzz/clouds.h"
#include "tests/fuzz/ouster_kinds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input.pcap");
  PacketOptions options;
  for (const char* kind : fuzz::kOusterKinds)
    options.ouster_metadata.push_back(fuzz::Metadata(kind));
  const auto& path = file.Write(fuzz::AsText(data, size));
  try {
    PacketCloudReader reader(path, options);
    fuzz::RequireSound(&reader, size);
  } catch (const InputError&) {
  }
  return 0;
}
