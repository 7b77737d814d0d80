// SPDX-License-Identifier: MIT
#include "core/io/messages/ros_cloud_reader.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "tests/fuzz/clouds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input.bag");
  const auto& path = file.Write(fuzz::AsText(data, size));
  try {
    RosCloudReader reader(std::make_unique<Ros1BagReader>(path), path);
    fuzz::RequireSound(&reader, size);
  } catch (const InputError&) {
  }
  return 0;
}
