// SPDX-License-Identifier: MIT
// Scans of bare float32 numbers, as KITTI and nuScenes have them.
#include "core/io/point_file.h"
#include "tests/fuzz/clouds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input.bin");
  try {
    fuzz::RequireSound(ReadPointFile(file.Write(fuzz::AsText(data, size))), 0);
  } catch (const InputError&) {
  }
  return 0;
}
