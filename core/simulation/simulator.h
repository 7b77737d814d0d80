// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/simulation/scenario.h"
#include "core/simulation/scenes/scene.h"
#include "core/simulation/scenes/triangle_mesh.h"
#include "core/simulation/sensors/laser_error.h"
#include "core/simulation/simulated_scan.h"

namespace trajlo::simulation {

/// A scenario brought to life: the scene, the motion, and the sensors in it. Immutable, and safe to
/// use from many threads; what it returns depends on the scenario alone.
class Simulator {
 public:
  /// Throws std::invalid_argument for a scenario that makes no sense.
  explicit Simulator(const Scenario& scenario);
  /// The same with a world and a motion of one's own, for tests.
  Simulator(const Scenario& scenario, Scene scene, PoseFunction T_world_body);

  /// The exact pose of the body at a true time; the world is the frame of the scene, z up.
  SE3 TrueWorldFromBody(std::int64_t t_ns) const;
  /// The sweeps that lie within the recording.
  std::int64_t ScanCount(int lidar_id) const;
  /// One scan before any fault. Every ray is cast from the exact pose at its own time, which the
  /// point tells to 4 ns (see StorableOffsetNs).
  SimulatedScan SimulateScan(int lidar_id, std::int64_t index) const;

  const Scenario& scenario() const { return scenario_; }
  const Scene& scene() const { return scene_; }
  std::int64_t start_ns() const { return start_ns_; }
  std::int64_t end_ns() const { return end_ns_; }

 private:
  struct World;
  Simulator(const Scenario& scenario, World world);

  void CastFirings(int lidar_id, std::int64_t index, int first, int last,
                   std::vector<LidarPoint>* points) const;
  void CorrectMotion(SimulatedScan* simulated) const;

  Scenario scenario_;
  Scene scene_;
  PoseFunction T_world_body_;
  std::vector<SensorModel> sensors_;
  std::vector<std::vector<LaserError>> laser_errors_;  ///< Of each LiDAR.
  std::int64_t start_ns_;
  std::int64_t end_ns_;
};

/// Simulates a whole recording: every scan of a ScanStream, on the calling thread.
void SimulateScans(const Simulator& simulator, int threads,
                   const std::function<void(const SimulatedScan&)>& consume);
void SimulateScans(const Scenario& scenario, int threads,
                   const std::function<void(const SimulatedScan&)>& consume);

}  // namespace trajlo::simulation
