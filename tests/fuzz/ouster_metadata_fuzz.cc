// SPDX-License-Identifier: MIT
// The metadata that an Ouster serves as JSON, and what is computed from them.
#include "core/io/errors.h"
#include "core/io/packets/ouster_geometry.h"
#include "core/io/packets/ouster_metadata.h"
#include "core/io/packets/ouster_packet.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input.json");
  try {
    const OusterMetadata metadata = ReadOusterMetadata(file.Write(fuzz::AsText(data, size)));
    const auto layout = LayoutOf(metadata);
    fuzz::Require(metadata.window() <= metadata.columns_per_frame, "a window is within a frame");
    if (!layout) return 0;
    fuzz::Require(layout->rows == metadata.rows(), "a column has all rows");
    const OusterGeometry geometry(metadata);
  } catch (const InputError&) {
  }
  return 0;
}
