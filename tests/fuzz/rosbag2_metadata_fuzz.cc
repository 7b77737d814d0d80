// SPDX-License-Identifier: MIT
// metadata.yaml of a folder of rosbag2, with an empty bag beside it.
#include "core/io/errors.h"
#include "core/io/ros2/rosbag2_metadata.h"
#include "tests/fuzz/fuzzing.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("metadata.yaml");
  const std::filesystem::path folder = file.Write(fuzz::AsText(data, size)).parent_path();
  const std::ofstream empty_bag(folder / "input_0.db3");
  try {
    const Rosbag2Folder bag = ReadRosbag2Folder(folder);
    fuzz::Require(!bag.files.empty(), "a folder that is a bag has files");
  } catch (const InputError&) {
  }
  return 0;
}
