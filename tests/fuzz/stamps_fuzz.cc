// SPDX-License-Identifier: MIT
// Files of stamps, one a line.
#include <cmath>

#include "core/io/errors.h"
#include "core/io/scan_stamps.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("timestamps.txt");
  try {
    const std::vector<std::int64_t> stamps = ReadStampsFile(file.Write(fuzz::AsText(data, size)));
    fuzz::Require(stamps.size() <= size, "a stamp takes a byte at least");
    fuzz::Require(std::isfinite(TypicalPeriod(stamps)), "the period is a number");
  } catch (const InputError&) {
  }
  return 0;
}
