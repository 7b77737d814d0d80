// SPDX-License-Identifier: MIT
// MCAP files, of ROS 1 and of ROS 2.
#include "core/io/messages/ros_cloud_reader.h"
#include "core/io/ros2/rosbag2_reader.h"
#include "tests/fuzz/clouds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input.mcap");
  const auto& path = file.Write(fuzz::AsText(data, size));
  try {
    RosCloudReader reader(std::make_unique<Rosbag2Reader>(path), path);
    fuzz::RequireSound(&reader, size);
  } catch (const InputError&) {
  }
  return 0;
}
