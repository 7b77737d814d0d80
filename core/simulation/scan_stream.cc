// SPDX-License-Identifier: MIT
#include "core/simulation/scan_stream.h"

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/scans/nanoseconds.h"

namespace trajlo::simulation {

ScanStream::ScanStream(const Simulator& simulator, int threads)
    : simulator_(simulator),
      threads_(threads),
      faults_(simulator.scenario().faults, simulator.scenario().seed, simulator.start_ns()) {
  const Scenario& scenario = simulator.scenario();
  for (int id = 0; id < static_cast<int>(scenario.rig.size()); ++id) {
    const LidarConfig& lidar = scenario.rig[static_cast<std::size_t>(id)];
    const std::int64_t period_ns = MakeSensor(lidar.sensor, lidar.columns).pattern->period_ns();
    const std::int64_t phase_ns = Nanoseconds(lidar.phase_s);
    for (std::int64_t i = 0; i < simulator.ScanCount(id); ++i) {
      sweeps_.push_back({phase_ns + (i + 1) * period_ns, id, i});
    }
  }
  std::sort(sweeps_.begin(), sweeps_.end(), [](const Sweep& a, const Sweep& b) {
    return std::tie(a.end_ns, a.lidar_id) < std::tie(b.end_ns, b.lidar_id);
  });
}

bool ScanStream::Next(SimulatedScan* simulated) {
  if (repeated_) {
    *simulated = *std::exchange(repeated_, std::nullopt);
    return true;
  }
  // More threads than processors would only make oneTBB complain.
  const int processors = tbb::info::default_concurrency();
  tbb::task_arena arena(threads_ > 0 ? std::min(threads_, processors) : processors);
  while (next_ < sweeps_.size()) {
    const Sweep& sweep = sweeps_[next_++];
    arena.execute([&] { *simulated = simulator_.SimulateScan(sweep.lidar_id, sweep.index); });
    if (!faults_.Apply(simulated)) continue;
    if (faults_.Repeats(*simulated)) repeated_ = *simulated;
    return true;
  }
  return false;
}

}  // namespace trajlo::simulation
