// SPDX-License-Identifier: MIT
#include "core/simulation/simulated_bag.h"

#include <algorithm>

namespace trajlo::simulation {
namespace {

/// What the driver of a sensor writes, by the names of MakeSensor.
CloudLayout LayoutOf(const std::string& sensor) {
  const auto begins_with = [&](const char* prefix) { return sensor.rfind(prefix, 0) == 0; };
  if (begins_with("mid") || begins_with("avia")) return CloudLayout::kLivox;
  if (begins_with("vlp") || begins_with("hdl")) return CloudLayout::kVelodyne;
  return CloudLayout::kOuster;
}

Ros1BagOptions BagOptions(const BagFormat& format) {
  Ros1BagOptions options;
  options.compression = format.compression;
  options.if_exists = IfExists::kReplace;
  return options;
}

}  // namespace

SimulatedBag::SimulatedBag(const Simulator& simulator, const std::filesystem::path& path,
                           const BagFormat& format)
    : simulator_(simulator), bag_(path, BagOptions(format)), next_truth_ns_(simulator.start_ns()) {
  for (const LidarConfig& lidar : simulator.scenario().rig) {
    layouts_.push_back(format.layout.value_or(LayoutOf(lidar.sensor)));
  }
  for (std::size_t i = 0; i < layouts_.size(); ++i) {
    const auto of_kind = [&](std::size_t end) {
      const auto last = layouts_.begin() + static_cast<std::ptrdiff_t>(end);
      return static_cast<std::size_t>(std::count(layouts_.begin(), last, layouts_[i]));
    };
    topics_.push_back(TopicOf(layouts_[i], of_kind(i), of_kind(layouts_.size())));
  }
}

void SimulatedBag::Write(const SimulatedScan& simulated) {
  const auto lidar = static_cast<std::size_t>(simulated.scan.lidar_id);
  const std::int64_t recorded_ns = simulated.RecordedNs();
  WriteTruth(std::min(recorded_ns, simulator_.end_ns()));
  bag_.WriteScan(layouts_.at(lidar), topics_[lidar], "lidar" + std::to_string(lidar),
                 {simulated.scan.stamp_ns, simulated.sweep_start_ns, recorded_ns}, simulated.scan);
}

void SimulatedBag::WriteTruth(std::int64_t until_ns) {
  for (; next_truth_ns_ <= until_ns; next_truth_ns_ += kTruthStepNs) {
    bag_.WritePose("/truth", next_truth_ns_, simulator_.TrueWorldFromBody(next_truth_ns_));
  }
}

void SimulatedBag::Finish(std::int64_t end_ns) {
  WriteTruth(end_ns);
  bag_.Close();
}

}  // namespace trajlo::simulation
