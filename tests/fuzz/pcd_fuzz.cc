// SPDX-License-Identifier: MIT
#include "core/io/pcd_reader.h"
#include "tests/fuzz/clouds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  try {
    fuzz::RequireSound(ReadPcd("input.pcd", fuzz::AsFileBytes(fuzz::AsText(data, size))), 0);
  } catch (const InputError&) {
  }
  return 0;
}
