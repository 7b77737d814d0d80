// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/conversion/scan_bag_writer.h"
#include "core/simulation/simulated_scan.h"
#include "core/simulation/simulator.h"

namespace trajlo::simulation {

/// How a recording becomes a bag.
struct BagFormat {
  /// Of all LiDARs; nothing: each as its own driver.
  std::optional<CloudLayout> layout;
  BagCompression compression = BagCompression::kNone;
};

/// The truth goes into truth.tum and into bags once a millisecond.
constexpr std::int64_t kTruthStepNs = 1'000'000;

/// A ROS 1 bag with the points of each LiDAR on a topic as public recordings name it (see TopicOf),
/// and the true poses of the body as PoseStamped on /truth. Headers have the scenario's stamps;
/// messages are recorded, by a clock that is right, a millisecond after the end of their sweep.
/// Members throw std::runtime_error.
class SimulatedBag {
 public:
  SimulatedBag(const Simulator& simulator, const std::filesystem::path& path,
               const BagFormat& format);

  void Write(const SimulatedScan& simulated);
  /// The truth goes on until then.
  void Finish(std::int64_t end_ns);
  /// In the order of the rig.
  const std::vector<std::string>& topics() const { return topics_; }

 private:
  void WriteTruth(std::int64_t until_ns);

  const Simulator& simulator_;
  std::vector<CloudLayout> layouts_;
  std::vector<std::string> topics_;
  ScanBagWriter bag_;
  std::int64_t next_truth_ns_;
};

}  // namespace trajlo::simulation
