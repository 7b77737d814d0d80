// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/simulation/faults.h"
#include "core/simulation/simulated_scan.h"
#include "core/simulation/simulator.h"

namespace trajlo::simulation {

/// All scans of all LiDARs of a recording, one at a time, in the order in which their sweeps end,
/// with the faults applied. `threads` <= 0 takes all processors; the scans do not depend on it.
class ScanStream {
 public:
  /// The simulator must outlive the stream.
  ScanStream(const Simulator& simulator, int threads);

  /// Simulates the next scan; false at the end.
  bool Next(SimulatedScan* simulated);

 private:
  struct Sweep {
    std::int64_t end_ns;
    int lidar_id;
    std::int64_t index;
  };

  const Simulator& simulator_;
  int threads_;
  FaultInjector faults_;
  std::vector<Sweep> sweeps_;
  std::size_t next_ = 0;
  std::optional<SimulatedScan> repeated_;
};

}  // namespace trajlo::simulation
