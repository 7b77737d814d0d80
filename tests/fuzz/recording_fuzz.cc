// SPDX-License-Identifier: MIT
// Any file as a recording, its kind told by its bytes, through to the scans: all LiDARs that it
// has, if the first alone cannot be told.
#include "core/io/errors.h"
#include "core/io/recording/open_recording.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input");
  const auto& path = file.Write(fuzz::AsText(data, size));
  RecordingOptions options;
  for (const char* topic : {"", "/points"}) {
    if (*topic != '\0') options.topics = {topic};
    try {
      const auto source = OpenRecording({path.string()}, options);
      LidarScan scan;
      std::size_t scans = 0;
      while (source->Next(&scan)) fuzz::Require(++scans <= 100 * size, "a recording ends");
      fuzz::Require(source->report().scans_read == scans, "every scan is counted");
    } catch (const InputError&) {
    }
  }
  return 0;
}
